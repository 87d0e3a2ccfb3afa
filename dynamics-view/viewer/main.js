// The page of a film: keys, and what there is in words.
function redraw() {
  drawScene(posesAt(state.t), state.t);
  plots.forEach((plot) => drawCursor(plot, state.t));
  element("time").value = state.t;
  element("clock").textContent = `${state.t.toFixed(decimals)} / ${END.toFixed(decimals)} s`;
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
watch(canvas, false);
press();
restyle();
redraw();
play(!matchMedia("(prefers-reduced-motion: reduce)").matches && !location.hash.includes("still"));
if (location.hash.startsWith("#t=")) { play(false); seek(Number(location.hash.slice(3))); }
