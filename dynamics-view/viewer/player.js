// Time, and who asks for it: the buttons and the slider.
const element = (id) => document.getElementById(id);
const state = { t: START, playing: false, speed: 1, last: 0, rested: 0 };
const decimals = END - START < 1 ? 3 : 2;
let waiting = false;

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

