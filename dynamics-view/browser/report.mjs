// A page of `dynamics report` in a browser: `node dynamics-view/browser/report.mjs DYNAMICS FILE.urdf OPTION…`, where
// DYNAMICS is the binary. With SHOTS=FOLDER it leaves pictures there.
//
// Sliders move every frame to where `dynamics eval` says; equations have a size; nothing is asked of the network, nothing
// complained about; all is there from 360 to 1600 pixels, by keys, in print, and without scripts but for what moves.
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";

import { pause, tried } from "./chrome.mjs";

const [program, file, ...options] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), "report-")), page = join(folder, "page.html");
execFileSync(program, ["report", file, ...options, "-o", page]);
const name = basename(dirname(file));

// What `eval` is not asked: that is about the page.
const OWN = ["--q", "--v", "--time", "--step", "--state", "--title"];
const robot = options.filter((option, k) => !OWN.includes(option) && !OWN.includes(options[k - 1]));
const evaluated = (q) => JSON.parse(execFileSync(program, ["eval", file, ...robot, "--frame", "*", "--only", "mass", "--state", JSON.stringify({ q })]));

// The same on every run: the fractional parts of multiples of the golden ratio.
let turn = 0;
const fraction = () => (turn += 0.6180339887498949) % 1;

const NAMELESS = `[...document.querySelectorAll("canvas,svg,input,select,button,a,math")].filter((e) => {
  const label = e.labels?.length || e.getAttribute("aria-label") || e.querySelector("title") || e.textContent.trim() || e.getAttribute("aria-labelledby");
  return !label && e.getClientRects().length;
}).map((e) => e.outerHTML.slice(0, 80))`;
const HIDDEN_MATH = `[...document.querySelectorAll("math")].filter((e) => { const b = e.getBoundingClientRect(); return b.width < 10 || b.height < 10; }).length`;
const sizes = (selector) => `[...document.querySelectorAll(${JSON.stringify(selector)})].map((e) => e.getBoundingClientRect()).filter((b) => b.width > 0 && b.height > 0).length`;
const PICTURE = `document.getElementById("view").toDataURL()`;
const CLOCK = `document.getElementById("clock").textContent`;

async function shot(browser, kind, width) {
  if (!process.env.SHOTS) return;
  const height = Math.min(16000, await browser.value("document.documentElement.scrollHeight"));
  const { data } = await browser.send("Page.captureScreenshot", { format: "png", captureBeyondViewport: true, clip: { x: 0, y: 0, width, height, scale: 1 } });
  writeFileSync(join(process.env.SHOTS, `${name}-${kind}.png`), Buffer.from(data, "base64"));
}

await tried(async (browser, wrong) => {
  const expect = (holds, what) => holds || wrong.push(`${name}: ${what}`);
  const quiet = (where) => {
    browser.said.forEach((said) => wrong.push(`${where}: ${said}`));
    browser.asked.filter((url) => !url.endsWith("/page.html")).forEach((url) => wrong.push(`${where}: it asks for ${url}`));
  };
  const changes = async (what, act, expression = PICTURE) => {
    const before = await browser.value(expression);
    await act();
    await pause(200);
    expect((await browser.value(expression)) !== before, `${what} changes nothing`);
  };

  for (const [width, height, scheme] of [[1600, 1000, "light"], [1100, 900, "dark"], [360, 740, "light"]]) {
    await browser.show(page, width, height, scheme);
    const where = `${name}, ${width} wide, ${scheme}`;
    expect(await browser.value("document.documentElement.scrollWidth <= innerWidth"), `${where}: it is wider than the page`);
    expect((await browser.value(HIDDEN_MATH)) === 0, `${where}: an equation has no size`);
    for (const element of await browser.value(NAMELESS)) wrong.push(`${where}: no name for ${element}`);
    await shot(browser, `${width}-${scheme}`, width);
    quiet(where);
  }

  // By hand: every slider somewhere, and every frame where the compiler's own programs have it.
  await browser.show(page, 1300, 900, "light");
  const equations = await browser.value("document.querySelectorAll('math').length");
  const count = await browser.value("knobs.length");
  for (let trial = 0; trial < 4; trial++) {
    const parts = Array.from({ length: count }, fraction);
    await browser.value(`${JSON.stringify(parts)}.forEach((part, k) => {
      const { slide, low, high } = knobs[k];
      slide.value = low + part * (high - low);
      slide.dispatchEvent(new Event("input"));
    })`);
    await pause(120);
    const q = await browser.value("[...hand.q]");
    const found = await browser.value(`Object.fromEntries(posesOf(hand.q).map((pose, k) => [data.bodies[k].name, pose]))`);
    const { frames } = evaluated(q);
    for (const [frame, { rotation, translation }] of Object.entries(frames)) {
      const off = Math.max(...translation.map((x, k) => Math.abs(x - found[frame].p[k])), ...rotation.flat().map((x, k) => Math.abs(x - found[frame].r.flat()[k])));
      // Some ten products of rotations, at a reach of some metres.
      expect(off < 1e-12, `trial ${trial}: the frame ${frame} is off by ${off}`);
    }
    const tip = await browser.value("data.bodies[data.trace].name"), shown = await browser.value(`document.getElementById("place").textContent`);
    const read = shown.replaceAll("−", "-").split(/\s+/).map(Number);
    expect(read.every((x, k) => Math.abs(x - frames[tip].translation[k]) < 6e-5), `trial ${trial}: ${tip} is said to be at ${shown}`);
  }
  if (count > 0) {
    await changes("a key on a slider", async () => { await browser.value("knobs[0].slide.focus()"); await browser.key("ArrowLeft"); }, "hand.q.join()");
    await changes("a number", () => browser.value(`{ const { number } = knobs[0]; number.value = 0.1234; number.dispatchEvent(new Event("change")); }`), "hand.q.join()");
    await changes("as it was", () => browser.value(`document.getElementById("opening").click()`), "hand.q.join()");
    expect(await browser.value("hand.q.join() === data.start.join()"), "it does not stand as it was");
  }
  await browser.value(`document.getElementById("view").focus()`);
  await changes("an arrow key", () => browser.key("ArrowLeft"));
  await changes("the key i", () => browser.key("i", "KeyI"));
  await changes("dragging", async () => {
    const { x, y } = await browser.value(`(() => { const b = document.getElementById("view").getBoundingClientRect(); return { x: b.x + 100, y: b.y + 200 }; })()`);
    await browser.mouse("mousePressed", x, y);
    for (let k = 1; k <= 4; k++) await browser.mouse("mouseMoved", x + 20 * k, y);
    await browser.mouse("mouseReleased", x + 80, y);
  });
  if (await browser.value("END > START")) {
    await changes("playing", async () => { await browser.value(`document.querySelector("#stage .swing").click()`); await pause(300); }, `${CLOCK} + hand.q.join()`);
    await browser.value("play(false)");
    await changes("winding", () => browser.value(`{ const s = document.getElementById("time"); s.value = (+s.min + +s.max) / 2; s.dispatchEvent(new Event("input")); }`), "hand.q.join()");
    const [t, q] = await browser.value("[state.t, [...hand.q]]");
    const expected = await browser.value(`[...configurationAt(${t})]`);
    expect(q.every((x, k) => x === expected[k]), "the robot is not where the swing has it");
    await browser.value(`document.getElementById("swing").scrollIntoView()`);
    await pause(200);
    expect(await browser.value(`{ const c = document.getElementById("second"), d = c.getContext("2d").getImageData(0, 0, c.width, c.height).data; d.some((x) => x > 0); }`), "the second picture is empty");
  }
  quiet(`${name}, by hand`);

  await browser.send("Emulation.setEmulatedMedia", { media: "print" });
  const charts = await browser.value("data.charts.length");
  expect((await browser.value(sizes(".still svg"))) === charts, "not all charts are printed");
  expect((await browser.value(sizes("#knobs"))) === 0, "sliders are printed");
  await browser.send("Emulation.setEmulatedMedia", { media: "" });

  await browser.send("Emulation.setScriptExecutionDisabled", { value: true });
  await browser.show(page, 900, 900, "light");
  expect((await browser.value(sizes("math"))) === equations, "without scripts equations are missing");
  expect((await browser.value(sizes(".still svg"))) === charts, "without scripts charts are missing");
  expect((await browser.value(sizes(".hand, #controls, button"))) === 0, "without scripts there are buttons that do nothing");
  expect((await browser.value(sizes("noscript p"))) > 0, "without scripts nothing says why");
  await shot(browser, "no-script", 900);
  await browser.send("Emulation.setScriptExecutionDisabled", { value: false });
}, `The page of ${name} is as it should be.`).finally(() => rmSync(folder, { recursive: true, force: true }));
