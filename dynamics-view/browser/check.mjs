// Pictures in a browser: `node dynamics-view/browser/check.mjs FILE.svg FILE.html …`.
//
// Of SVG: no text on another text or beyond the page, light and dark. Of HTML: no word of complaint on the console; it
// plays, pauses, winds by slider and keys, turns by mouse, zooms, and fits a telephone. Chromium is spoken to by a pipe;
// without it nothing is checked, and that is said.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const FLAGS = "--headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking "
  + "--disable-component-update --disable-sync --hide-scrollbars --remote-debugging-pipe";

class Browser {
  constructor(program) {
    this.folder = mkdtempSync(join(tmpdir(), "pictures-"));
    const flags = [...FLAGS.split(" "), `--user-data-dir=${this.folder}`, "about:blank"];
    this.process = spawn(program, flags, { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    this.failed = new Promise((_, fail) => this.process.on("error", fail));
    this.failed.catch(() => {});
    this.next = 1;
    this.waiting = new Map();
    this.said = [];
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
    for (const domain of ["Page", "Runtime", "Log"]) await this.send(domain + ".enable");
  }
  async show(file, width, height, scheme) {
    this.said = [];
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

const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));
const wrong = [];
const expect = (holds, what) => holds || wrong.push(what);

const OVERLAPS = `(() => {
  const page = document.documentElement.getBoundingClientRect(), found = [];
  const texts = [...document.querySelectorAll("text")].map((text) => [text.textContent, text.getBoundingClientRect()]);
  texts.forEach(([name, a], k) => {
    if (a.left < 0 || a.right > page.width || a.top < 0 || a.bottom > page.height) found.push(name + " is beyond the page");
    for (const [other, b] of texts.slice(k + 1)) {
      const [w, h] = [Math.min(a.right, b.right) - Math.max(a.left, b.left), Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top)];
      if (w > 1 && h > 3) found.push(name + " is on " + other);
    }
  });
  return found;
})()`;
const PICTURE = `document.getElementById("view").toDataURL()`;
const SHOWN = `[...document.querySelectorAll("#toggles button")].map((button) => button.getAttribute("aria-pressed")).join()`;
const CLOCK = `document.getElementById("clock").textContent`;

async function checkChart(browser, file) {
  for (const scheme of ["light", "dark"]) {
    await browser.show(file, 760, 1200, scheme);
    for (const found of await browser.value(OVERLAPS)) wrong.push(`${file}: ${found}`);
  }
}

async function checkFilm(browser, file) {
  for (const [width, height, scheme] of [[1100, 1000, "light"], [390, 800, "dark"]]) {
    await browser.show(file, width, height, scheme);
    const where = `${file}, ${width} wide`;
    const changes = async (what, act, expression = PICTURE) => {
      const before = await browser.value(expression);
      await act();
      await pause(150);
      expect((await browser.value(expression)) !== before, `${where}: ${what} changes nothing`);
    };
    expect(await browser.value("document.documentElement.scrollWidth <= innerWidth"), `${where}: it is wider than the page`);
    await changes("playing", () => pause(300), CLOCK);
    await browser.key(" ", "Space");
    const paused = await browser.value(CLOCK);
    await pause(250);
    expect((await browser.value(CLOCK)) === paused, `${where}: space does not pause`);
    await browser.key("Home");
    await changes("the arrow key", () => browser.key("ArrowRight"), CLOCK);
    await changes("the slider", () => browser.value(`{ const s = document.getElementById("time"); s.value = (+s.min + +s.max) / 2; s.dispatchEvent(new Event("input")); }`));
    await changes("dragging", async () => {
      await browser.mouse("mousePressed", 200, 300);
      for (let k = 1; k <= 4; k++) await browser.mouse("mouseMoved", 200 + 20 * k, 300 + 5 * k);
      await browser.mouse("mouseReleased", 280, 320);
    });
    await changes("the wheel", () => browser.mouse("mouseWheel", 200, 300, { deltaX: 0, deltaY: -300, button: "none", buttons: 0 }));
    for (const key of ["m", "i", "a", "f"]) await changes(`the key ${key}`, () => browser.key(key, "Key" + key.toUpperCase()), SHOWN);
    await changes("the first view", () => browser.key("r", "KeyR"));
    const chart = `(() => { const c = document.querySelector("figure canvas"); return c && c.toDataURL(); })()`;
    if (await browser.value(chart)) await changes("a chart's cursor", () => browser.key("End"), chart);
    browser.said.forEach((said) => wrong.push(`${where}: ${said}`));
  }
}

const files = process.argv.slice(2);
const browser = new Browser(process.env.CHROMIUM || "chromium");
try {
  await browser.open();
} catch (why) {
  console.log(`NOT CHECKED, there is no chromium (${why.message}); its path may be in CHROMIUM.`);
  process.exit(0);
}
try {
  for (const file of files) await (file.endsWith(".svg") ? checkChart : checkFilm)(browser, file);
} catch (why) {
  wrong.push(String(why.stack));
}
await browser.close();
console.log(wrong.length ? wrong.join("\n") : `${files.length} pictures are as they should be.`);
process.exit(wrong.length ? 1 : 0);
