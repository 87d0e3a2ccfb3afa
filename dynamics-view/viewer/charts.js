// The charts: drawn once, with a cursor over them.
function niceTicks(low, high, wanted) {
  const rough = (high - low) / Math.max(wanted, 1), decade = 10 ** Math.floor(Math.log10(rough));
  const steps = [0.5, 1, 2, 5, 10].map((k) => k * decade);
  const ends = (step) => [Math.ceil(low / step - 1e-9), Math.floor(high / step + 1e-9)];
  // One tick is no scale: then the next finer step.
  const chosen = steps.findIndex((step) => step >= 0.75 * rough), [from, to] = ends(steps[chosen]);
  const step = steps[from < to ? chosen : Math.max(chosen - 1, 0)], [first, last] = ends(step);
  const ticks = [];
  for (let k = first; k <= last; k++) ticks.push(k * step);
  return { ticks, step };
}
const superscript = (n) => String(n).replace(/./g, (c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]));
const minus = (text) => (/^-0\.?0*$/.test(text) ? text.slice(1) : text.replace("-", "−"));

for (const chart of data.charts) {
  chart.times = chart.time ? decoded(chart.time.row, chart.count, chart.time.unit) : times;
  for (const line of chart.lines) line.values = decoded(line.row, chart.count, line.unit, line.from);
}

const plots = data.charts.map((chart) => {
  const figure = document.createElement("figure");
  figure.innerHTML = "<figcaption></figcaption><div class=legend></div><canvas></canvas>";
  document.getElementById("charts").append(figure);
  let low = Infinity, high = -Infinity;
  for (const line of chart.lines) for (const y of line.values) [low, high] = [Math.min(low, y), Math.max(high, y)];
  const large = Math.max(Math.abs(low), Math.abs(high));
  if (!(high - low > 1e-9 * large) || high - low < 1e-90) {
    const middle = (low + high) / 2, half = large > 1e-90 ? 0.1 * large : 1;
    [low, high] = [middle - half, middle + half];
  }
  const more = 0.06 * (high - low);
  [low, high] = [low - more, high + more];
  const power = large < 1e-3 || large >= 1e5 ? 3 * Math.floor(Math.log10(Math.max(Math.abs(low), Math.abs(high))) / 3) : 0;
  const unit = (power ? "10" + superscript(power) + " " : "") + chart.unit;
  figure.querySelector("figcaption").textContent = chart.quantity + (unit.trim() ? ", " + unit.trim() : "");
  const scaled = (y) => y / 10 ** power;
  const digits = Math.max(0, Math.min(12, 3 - Math.floor(Math.log10(scaled(high) - scaled(low)))));
  const values = chart.lines.map((line, k) => {
    const item = document.createElement("span"), swatch = document.createElement("i"), value = document.createElement("span");
    swatch.style.borderColor = `var(--c${k % 6})`;
    swatch.className = ["", "d1", "d2"][Math.floor(k / 6) % 3];
    value.className = "v";
    item.append(swatch, line.name, value);
    figure.querySelector(".legend").append(item);
    return value;
  });
  const surface = figure.querySelector("canvas");
  surface.setAttribute("role", "img");
  surface.setAttribute("aria-label", chart.quantity + " over time");
  return { chart, surface, values, low, high, scaled, digits, still: document.createElement("canvas") };
});

function drawStill(plot) {
  const ratio = devicePixelRatio || 1, box = plot.surface.getBoundingClientRect();
  for (const layer of [plot.surface, plot.still]) {
    [layer.width, layer.height] = [Math.max(1, Math.round(box.width * ratio)), Math.max(1, Math.round(box.height * ratio))];
  }
  const ink = plot.still.getContext("2d"), { chart } = plot;
  ink.scale(ratio, ratio);
  ink.font = "11px system-ui, sans-serif";
  const vertical = niceTicks(plot.low, plot.high, Math.floor(box.height / 34));
  const places = Math.max(0, Math.min(12, -Math.floor(Math.log10(plot.scaled(vertical.step)) + 0.001)));
  const labels = vertical.ticks.map((y) => minus(plot.scaled(y).toFixed(places)));
  const left = Math.max(20, ...labels.map((label) => ink.measureText(label).width)) + 8;
  const [right, top, bottom] = [box.width - 10, 8, box.height - 20];
  const first = chart.times[0], last = chart.times[chart.count - 1];
  const [from, to] = last > first ? [first, last] : [first - 0.5, first + 0.5];
  plot.x = (t) => left + ((t - from) / (to - from)) * (right - left);
  plot.y = (y) => bottom - ((y - plot.low) / (plot.high - plot.low)) * (bottom - top);
  plot.t = (x) => from + ((x - left) / (right - left)) * (to - from);
  Object.assign(plot, { top, bottom });
  const rule = (x0, y0, x1, y1, colour) => {
    ink.beginPath();
    ink.moveTo(x0, y0);
    ink.lineTo(x1, y1);
    ink.strokeStyle = css(colour);
    ink.lineWidth = 1;
    ink.stroke();
  };
  ink.fillStyle = css(colours.muted);
  ink.textAlign = "right";
  ink.textBaseline = "middle";
  vertical.ticks.forEach((y, k) => {
    rule(left, plot.y(y), right, plot.y(y), y === 0 ? colours.line : colours.grid);
    ink.fillText(labels[k], left - 6, plot.y(y));
  });
  const horizontal = niceTicks(from, to, Math.floor((right - left) / 70));
  const decimals = Math.max(0, Math.min(12, -Math.floor(Math.log10(horizontal.step) + 0.001)));
  ink.textBaseline = "top";
  for (const t of horizontal.ticks) {
    rule(plot.x(t), top, plot.x(t), bottom, colours.grid);
    const label = minus(t.toFixed(decimals)) + " s", half = ink.measureText(label).width / 2;
    ink.textAlign = plot.x(t) + half > box.width ? "right" : "center";
    ink.fillText(label, ink.textAlign === "right" ? box.width : plot.x(t), bottom + 5);
  }
  rule(left, bottom, right, bottom, colours.line);
  ink.lineJoin = "round";
  for (let k = chart.lines.length - 1; k >= 0; k--) {
    ink.beginPath();
    const values = chart.lines[k].values;
    for (let i = 0; i < chart.count; i++) ink.lineTo(plot.x(chart.times[i]), plot.y(values[i]));
    ink.setLineDash([[], [7, 4], [2, 3]][Math.floor(k / 6) % 3]);
    ink.strokeStyle = css(colours["c" + (k % 6)]);
    ink.lineWidth = 1.6;
    ink.stroke();
  }
}

function drawCursor(plot, t) {
  const ratio = devicePixelRatio || 1, ink = plot.surface.getContext("2d"), { chart } = plot;
  ink.setTransform(1, 0, 0, 1, 0, 0);
  ink.clearRect(0, 0, plot.surface.width, plot.surface.height);
  ink.drawImage(plot.still, 0, 0);
  ink.scale(ratio, ratio);
  const x = plot.x(Math.min(Math.max(t, chart.times[0]), chart.times[chart.count - 1]));
  ink.beginPath();
  ink.moveTo(x, plot.top);
  ink.lineTo(x, plot.bottom);
  ink.strokeStyle = css(colours.muted, 0.8);
  ink.lineWidth = 1;
  ink.stroke();
  for (let k = chart.lines.length - 1; k >= 0; k--) {
    const value = between(chart.times, chart.lines[k].values, t);
    plot.values[k].textContent = minus(plot.scaled(value).toFixed(plot.digits));
    ink.beginPath();
    ink.arc(x, plot.y(value), 3.2, 0, 2 * Math.PI);
    ink.fillStyle = css(colours["c" + (k % 6)]);
    ink.fill();
  }
}
