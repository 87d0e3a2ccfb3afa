// The page of a report: joints that are moved by hand, or by the swing.
const surfaces = [...document.querySelectorAll("canvas.scene")];
const hand = { q: [...data.start], moving: false };
const degrees = (x) => minus(((x * 180) / Math.PI).toFixed(1)) + "°";

// One row of the form for each number that can be changed; a quaternion is changed by three angles.
const knobs = [];
for (const handle of data.handles) {
  const single = (name, q, unit, low, high) => knobs.push({ name, unit, low, high, get: () => hand.q[q], set: (x) => { hand.q[q] = x; } });
  const angle = (part, name, q) => knobs.push({
    name, unit: "rad", low: part === 1 ? -Math.PI / 2 : -Math.PI, high: part === 1 ? Math.PI / 2 : Math.PI,
    get: () => anglesOf(...hand.q.slice(q, q + 4))[part],
    // The angles that are set stay as they are: those of a quaternion may be others that turn as far.
    set: (x, all) => { hand.q.splice(q, 4, ...quaternionOf(...all.map((other, k) => (k === part ? x : other)))); },
    group: q, part,
  });
  if (handle.kind === "angle" || handle.kind === "distance") {
    single(handle.name, handle.q, handle.kind === "angle" ? "rad" : "m", handle.low, handle.high);
    continue;
  }
  const turns = handle.kind === "free" ? handle.q + 3 : handle.q;
  if (handle.kind === "free") ["x", "y", "z"].forEach((axis, k) => single(`${handle.name} ${axis}`, handle.q + k, "m", handle.low, handle.high));
  ["roll", "pitch", "yaw"].forEach((name, part) => angle(part, `${handle.name} ${name}`, turns));
}
knobs.forEach((knob, k) => {
  const line = document.createElement("div");
  line.className = "knob";
  line.innerHTML = `<label for="knob-${k}"></label><output for="knob-${k}"></output>`
    + `<input type="range" id="knob-${k}" step="any"><input type="number" step="any"><span class="unit"></span>`;
  const [slide, number] = line.querySelectorAll("input");
  line.querySelector("label").textContent = knob.name;
  line.querySelector(".unit").textContent = knob.unit;
  number.setAttribute("aria-label", `${knob.name}, ${knob.unit}`);
  [slide.min, slide.max] = [knob.low, knob.high];
  Object.assign(knob, { slide, number, degrees: line.querySelector("output") });
  const change = (x) => {
    if (!Number.isFinite(x)) return;
    play(false);
    hand.moving = false;
    const all = knobs.filter((other) => other.group !== undefined && other.group === knob.group).map((other) => other.value);
    knob.set(x, all);
    show(knob, x);
    soon();
  };
  slide.oninput = () => change(Number(slide.value));
  number.onchange = () => change(Number(number.value));
  slide.onkeydown = (event) => {
    // A step of the keys is a hundredth of the way, with shift a thousandth.
    const way = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
    if (!way) return;
    event.preventDefault();
    const step = ((knob.high - knob.low) / (event.shiftKey ? 1000 : 100)) * way;
    change(Math.min(knob.high, Math.max(knob.low, knob.value + step)));
  };
  element("knobs").append(line);
});
function show(knob, x) {
  knob.value = x;
  knob.slide.value = x;
  if (document.activeElement !== knob.number) knob.number.value = Number(x.toFixed(4));
  knob.degrees.textContent = knob.unit === "rad" ? degrees(x) : "";
  knob.slide.setAttribute("aria-valuetext", knob.unit === "rad" ? degrees(x) : `${Number(x.toFixed(3))} m`);
}
const showAll = () => knobs.forEach((knob) => show(knob, knob.get()));
element("opening").onclick = () => {
  play(false);
  Object.assign(hand, { q: [...data.start], moving: false });
  showAll();
  soon();
};

// Where a body is.
for (const [k, body] of data.bodies.entries()) element("frame").append(new Option(body.name, k));
if (data.trace !== null) element("frame").value = data.trace;
element("frame").onchange = (event) => { data.trace = Number(event.target.value); soon(); };
function readOut(poses) {
  const { p, r } = poses[data.trace ?? 0], write = (id, list) => { element(id).textContent = list.join("  "); };
  const number = (x) => minus((Math.abs(x) < 5e-5 ? 0 : x).toFixed(4));
  write("place", p.map((x) => number(x)));
  const pitch = Math.asin(Math.min(1, Math.max(-1, -r[2][0])));
  write("turned", [Math.atan2(r[2][1], r[2][2]), pitch, Math.atan2(r[1][0], r[0][0])].map((x) => degrees(Math.abs(x) < 1e-4 ? 0 : x)));
  write("center", center(poses).map((x) => number(x)));
}

function redraw() {
  if (hand.moving) { hand.q = configurationAt(state.t); showAll(); }
  const poses = posesOf(hand.q);
  for (const surface of surfaces) {
    const box = surface.getBoundingClientRect();
    if (box.bottom < 0 || box.top > innerHeight || box.width === 0) continue;
    aim(surface);
    drawScene(poses, hand.moving ? state.t : null);
  }
  plots.forEach((plot) => drawCursor(plot, state.t));
  readOut(poses);
  element("time").value = state.t;
  element("clock").textContent = `${state.t.toFixed(decimals)} / ${END.toFixed(decimals)} s`;
  for (const button of document.querySelectorAll("button.swing")) button.textContent = state.playing ? "❚❚ pause" : "▶ swing";
}
// Whoever plays or winds wants to see the swing.
function bySwing() { hand.moving = true; }
element("play").addEventListener("click", bySwing);
element("time").addEventListener("input", bySwing);
plots.forEach((plot) => plot.surface.addEventListener("pointerdown", bySwing));
for (const button of document.querySelectorAll("button.swing")) {
  button.onclick = () => { bySwing(); play(!state.playing); };
  button.disabled = !(END > START);
}

for (const surface of surfaces) {
  watch(surface, true);
  surface.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const action = {
      " ": () => { bySwing(); play(!state.playing); },
      ArrowLeft: () => turn(-0.1, 0), ArrowRight: () => turn(0.1, 0), ArrowUp: () => turn(0, 0.1), ArrowDown: () => turn(0, -0.1),
      "+": () => zoom(0.9), "=": () => zoom(0.9), "-": () => zoom(1 / 0.9), r: () => { resetCamera(); soon(); },
    }[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    const found = TOGGLES.find(([, key]) => key === event.key.toLowerCase());
    if (!action && !found) return;
    event.preventDefault();
    if (action) action(); else toggle(found[0]);
  });
}

for (const button of document.querySelectorAll("button.copy")) {
  button.onclick = async () => {
    const source = element(button.dataset.of), said = button.textContent;
    try {
      await navigator.clipboard.writeText(source.textContent);
      button.textContent = "copied";
    } catch {
      // Where there is no clipboard the source is shown and selected, to be copied by hand.
      source.closest("details").open = true;
      getSelection().selectAllChildren(source);
      button.textContent = "selected";
    }
    setTimeout(() => (button.textContent = said), 1500);
  };
}

// The section that is read, in the contents.
const entries = [...document.querySelectorAll("nav a")];
const seen = new IntersectionObserver((changes) => {
  for (const { target, isIntersecting } of changes) target.classList.toggle("seen", isIntersecting);
  const first = document.querySelector("main > section.seen");
  entries.forEach((entry) => entry.setAttribute("aria-current", first && entry.hash === "#" + first.id ? "true" : "false"));
}, { rootMargin: "-15% 0px -55% 0px" });
document.querySelectorAll("main > section").forEach((section) => seen.observe(section));

element("corner").textContent = `grid ${Number(cell.toPrecision(3))} m`;
function restyle() {
  readColours();
  plots.forEach(drawStill);
  soon();
}
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", restyle);
new ResizeObserver(restyle).observe(document.body);
addEventListener("scroll", soon, { passive: true });
// Details that are closed are not printed.
let closed = [];
addEventListener("beforeprint", () => { closed = [...document.querySelectorAll("details.also-in-print:not([open])")]; closed.forEach((part) => (part.open = true)); });
addEventListener("afterprint", () => closed.forEach((part) => (part.open = false)));
// Who falls is followed.
shown.follow = shown.follow || data.bodies.some((body) => body.kind === "free");
resetCamera();
press();
showAll();
restyle();
