// Pictures in a browser: `node dynamics-view/browser/check.mjs FILE.svg FILE.html …`.
//
// Of SVG: no text on another text or beyond the page, light and dark. Of HTML: no word of complaint on the console; it
// plays, pauses, winds by slider and keys, turns by mouse, zooms, and fits a telephone. Chromium is spoken to by a pipe;
// without it nothing is checked, and that is said.
import { pause, tried } from "./chrome.mjs";

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
await tried(async (browser, complaints) => {
  for (const file of files) await (file.endsWith(".svg") ? checkChart : checkFilm)(browser, file);
  complaints.push(...wrong);
}, `${files.length} pictures are as they should be.`);
