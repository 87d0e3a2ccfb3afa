// Time, and who asks for it: buttons, mouse, touch and keys.
const element = (id) => document.getElementById(id);
const state = { t: START, playing: false, speed: 1, last: 0, rested: 0 };
const decimals = END - START < 1 ? 3 : 2;
let waiting = false;

function redraw() {
  drawScene(state.t);
  plots.forEach((plot) => drawCursor(plot, state.t));
  element("time").value = state.t;
  element("clock").textContent = `${state.t.toFixed(decimals)} / ${END.toFixed(decimals)} s`;
}
function soon() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame((now) => {
    waiting = false;
    if (state.playing) {
      const passed = Math.min(0.1, (now - (state.last || now)) / 1000);
      if (state.t >= END) {
        // A moment of rest at the end, and again.
        state.rested += passed;
        if (state.rested > 0.8) [state.t, state.rested] = [START, 0];
      } else state.t = Math.min(END, state.t + passed * state.speed);
      state.last = now;
      soon();
    }
    redraw();
  });
}
function seek(t) {
  state.t = Math.min(END, Math.max(START, t));
  state.rested = 0;
  soon();
}
function play(on) {
  state.playing = on && END > START;
  state.last = 0;
  if (state.playing && state.t >= END) state.t = START;
  element("play").textContent = state.playing ? "❚❚" : "▶";
  element("play").setAttribute("aria-label", state.playing ? "Pause" : "Play");
  soon();
}
function step(count) {
  play(false);
  seek(times[Math.min(data.count - 1, Math.max(0, before(times, state.t + 1e-9) + count))]);
}

// What may be shown or not.
const TOGGLES = [["masses", "m"], ["inertias", "i"], ["axes", "a"], ["trace", "t"], ["follow", "f"]];
for (const [what, key] of TOGGLES) {
  if (what === "trace" && data.trace === null) continue;
  const button = document.createElement("button");
  button.textContent = what;
  button.title = `key ${key.toUpperCase()}`;
  button.id = "show-" + what;
  button.onclick = () => toggle(what);
  element("toggles").append(button);
}
function toggle(what) {
  if (!element("show-" + what)) return;
  shown[what] = !shown[what];
  press();
  soon();
}
function press() {
  for (const [what] of TOGGLES) element("show-" + what)?.setAttribute("aria-pressed", shown[what]);
}

element("play").onclick = () => play(!state.playing);
element("speed").onchange = (event) => (state.speed = Number(event.target.value));
const slider = element("time");
[slider.min, slider.max, slider.value] = [START, END, START];
slider.disabled = element("play").disabled = !(END > START);
slider.oninput = () => { play(false); seek(Number(slider.value)); };

// One finger turns, two move and zoom; with the mouse, shift or the right button move.
const fingers = new Map();
canvas.onpointerdown = (event) => {
  canvas.setPointerCapture(event.pointerId);
  fingers.set(event.pointerId, [event.clientX, event.clientY]);
};
canvas.onpointerup = canvas.onpointercancel = (event) => fingers.delete(event.pointerId);
canvas.oncontextmenu = (event) => event.preventDefault();
canvas.onpointermove = (event) => {
  const last = fingers.get(event.pointerId);
  if (!last) return;
  const now = [event.clientX, event.clientY], [dx, dy] = [now[0] - last[0], now[1] - last[1]];
  const spread = () => {
    const [a, b] = [...fingers.values()];
    return Math.hypot(a[0] - b[0], a[1] - b[1]);
  };
  const pan = (part) => {
    const meters = (part * eye.distance * eye.ratio) / eye.focus;
    camera.shift = add(camera.shift, add(scale(eye.right, -dx * meters), scale(eye.up, dy * meters)));
  };
  if (fingers.size === 2) {
    const wide = spread();
    fingers.set(event.pointerId, now);
    zoom(wide / Math.max(1, spread()));
    pan(0.5);
  } else if (event.shiftKey || event.buttons & 2) pan(1);
  else turn(-0.008 * dx, 0.008 * dy);
  fingers.set(event.pointerId, now);
  soon();
};
function turn(azimuth, height) {
  camera.azimuth += azimuth;
  camera.height = Math.min(1.55, Math.max(-1.55, camera.height + height));
  soon();
}
function zoom(factor) {
  camera.zoom = Math.min(20, Math.max(0.05, camera.zoom * factor));
  soon();
}
canvas.addEventListener("wheel", (event) => {
  event.preventDefault();
  zoom(Math.exp(0.0012 * event.deltaY * (event.deltaMode ? 20 : 1)));
}, { passive: false });
canvas.ondblclick = () => { resetCamera(); soon(); };

for (const plot of plots) {
  const go = (event) => { play(false); seek(plot.t(event.clientX - plot.surface.getBoundingClientRect().left)); };
  plot.surface.onpointerdown = (event) => { plot.surface.setPointerCapture(event.pointerId); go(event); };
  plot.surface.onpointermove = (event) => event.buttons && go(event);
}

const KEYS = [
  ["space", "play or pause", () => play(!state.playing)],
  ["← →", "a frame back or on; with shift, ten", null],
  ["home, end", "the first and the last frame", null],
  ["+ −", "zoom", null],
  ["R", "the first view again", () => { resetCamera(); soon(); }],
];
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "SELECT") return;
  if (event.key === " " && event.target.tagName === "BUTTON") return;
  const frames = event.shiftKey ? 10 : 1;
  const action = {
    " ": KEYS[0][2], ArrowLeft: () => step(-frames), ArrowRight: () => step(frames), Home: () => { play(false); seek(START); },
    End: () => { play(false); seek(END); }, "+": () => zoom(0.9), "=": () => zoom(0.9), "-": () => zoom(1 / 0.9), r: KEYS[4][2],
  }[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  const found = TOGGLES.find(([, key]) => key === event.key.toLowerCase());
  if (!action && !found) return;
  event.preventDefault();
  if (action) action(); else toggle(found[0]);
});

// What there is, in words.
function row(table, cells, tag = "td") {
  const line = document.createElement("tr");
  cells.forEach(([text, isNumber]) => {
    const cell = document.createElement(tag);
    cell.textContent = text;
    if (isNumber) cell.className = "n";
    line.append(cell);
  });
  table.append(line);
}
row(element("bodies"), [["body"], ["hangs on"], ["by"], ["which is"], ["mass, kg", true]], "th");
for (const body of data.bodies) {
  const parent = body.parent === null ? "world" : data.bodies[body.parent].name;
  row(element("bodies"), [[body.name], [parent], [body.joint || ""], [body.kind || "welded"], [body.mass || "", true]]);
}
const pointers = [["drag", "turn; one finger"], ["shift and drag", "move; two fingers"], ["wheel", "zoom; two fingers"], ["double click", "the first view again"]];
for (const [key, does] of [...pointers, ...KEYS, ...TOGGLES.map(([what, key]) => [key.toUpperCase(), "show or hide: " + what])]) {
  row(element("keys"), [[key], [does]]);
}
const mass = data.bodies.reduce((sum, body) => sum + (body.mass || 0), 0);
const counted = (n, word) => `${n} ${word}${n === 1 ? "" : "s"}`;
element("facts").textContent = [
  counted(joints.length, "joint"), mass > 0 ? `${Number(mass.toPrecision(4))} kg` : "", END > START ? `${Number((END - START).toPrecision(4))} s` : "",
].filter(Boolean).join(" · ");
element("corner").textContent = `grid ${Number(cell.toPrecision(3))} m`
  + (data.trace !== null ? ` · path of ${data.bodies[data.trace].name}` : "");

function restyle() {
  readColours();
  plots.forEach(drawStill);
  soon();
}
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", restyle);
new ResizeObserver(restyle).observe(document.body);
resetCamera();
press();
restyle();
redraw();
play(!matchMedia("(prefers-reduced-motion: reduce)").matches && !location.hash.includes("still"));
if (location.hash.startsWith("#t=")) { play(false); seek(Number(location.hash.slice(3))); }
