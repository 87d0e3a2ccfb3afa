// Chromium, spoken to by a pipe.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const FLAGS = "--headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking "
  + "--disable-component-update --disable-sync --hide-scrollbars --remote-debugging-pipe";

export class Browser {
  constructor(program) {
    this.folder = mkdtempSync(join(tmpdir(), "pictures-"));
    const flags = [...FLAGS.split(" "), `--user-data-dir=${this.folder}`, "about:blank"];
    this.process = spawn(program, flags, { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    this.failed = new Promise((_, fail) => this.process.on("error", fail));
    this.failed.catch(() => {});
    this.next = 1;
    this.waiting = new Map();
    this.said = [];
    this.asked = [];
    let rest = "";
    this.process.stdio[4].on("data", (bytes) => {
      const parts = (rest + bytes).split("\0");
      rest = parts.pop();
      parts.map((part) => JSON.parse(part)).forEach((message) => this.hear(message));
    });
    this.process.stdio[3].on("error", () => {});
  }
  hear(message) {
    const waiting = this.waiting.get(message.id);
    if (waiting) {
      this.waiting.delete(message.id);
      message.error ? waiting.fail(new Error(message.error.message)) : waiting.done(message.result);
    } else if (message.method === "Runtime.exceptionThrown") {
      this.said.push(message.params.exceptionDetails.exception?.description ?? message.params.exceptionDetails.text);
    } else if (message.method === "Network.requestWillBeSent") {
      this.asked.push(message.params.request.url);
    } else if (message.method === "Log.entryAdded" || message.method === "Runtime.consoleAPICalled") {
      this.said.push(JSON.stringify(message.params));
    }
  }
  send(method, params = {}) {
    const id = this.next++;
    const answer = new Promise((done, fail) => this.waiting.set(id, { done, fail }));
    this.process.stdio[3].write(JSON.stringify({ id, method, params, sessionId: this.session }) + "\0");
    return Promise.race([answer, this.failed]);
  }
  async open() {
    const { targetInfos } = await this.send("Target.getTargets");
    const { targetId } = targetInfos.find((target) => target.type === "page");
    this.session = (await this.send("Target.attachToTarget", { targetId, flatten: true })).sessionId;
    for (const domain of ["Page", "Runtime", "Log", "Network"]) await this.send(domain + ".enable");
  }
  async show(file, width, height, scheme) {
    [this.said, this.asked] = [[], []];
    await this.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: scheme }] });
    await this.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
    await this.send("Page.navigate", { url: pathToFileURL(resolve(file)).href });
    await pause(400);
  }
  async value(expression) {
    const { result, exceptionDetails } = await this.send("Runtime.evaluate", { expression, returnByValue: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }
  async mouse(type, x, y, more = {}) {
    await this.send("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons: type === "mouseReleased" ? 0 : 1, clickCount: 1, ...more });
  }
  async key(key, code = key) {
    for (const type of ["keyDown", "keyUp"]) await this.send("Input.dispatchKeyEvent", { type, key, code, text: key.length === 1 && type === "keyDown" ? key : undefined });
    await pause(120);
  }
  async close() {
    const gone = new Promise((done) => this.process.on("exit", done));
    await Promise.race([this.send("Browser.close").then(() => gone), pause(5000)]);
    this.process.kill();
    rmSync(this.folder, { recursive: true, force: true, maxRetries: 20, retryDelay: 100 });
  }
}

export const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));

// A browser for a task, which says what is wrong; the process ends with that.
export async function tried(task, done) {
  const wrong = [];
  const browser = new Browser(process.env.CHROMIUM || "chromium");
  try {
    await browser.open();
  } catch (why) {
    console.log(`NOT CHECKED, there is no chromium (${why.message}); its path may be in CHROMIUM.`);
    return;
  }
  try {
    await task(browser, wrong);
  } catch (why) {
    wrong.push(String(why.stack));
  }
  await browser.close();
  console.log(wrong.length ? wrong.join("\n") : done);
  process.exitCode = wrong.length ? 1 : 0;
}
