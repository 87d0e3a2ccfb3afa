"use strict";
// What is embedded, read back: rows of second differences, in quanta.
const data = JSON.parse(document.getElementById("data").textContent);

function decoded(row, count, unit, from = 0) {
  const out = new Float64Array(count);
  if (!Array.isArray(row)) return out.fill(from + row * unit);
  for (let k = 0, value = 0, step = 0; k < count; k++) {
    if (k === 0) value = row[0];
    else { step = k === 1 ? row[1] : step + row[k]; value += step; }
    out[k] = from + value * unit;
  }
  return out;
}

// The last index whose time is not after t.
function before(list, t) {
  let low = 0, high = list.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (list[middle] <= t) low = middle; else high = middle - 1;
  }
  return low;
}

// A value between two samples.
function between(list, values, t) {
  const k = before(list, t);
  if (k + 1 >= list.length) return values[k];
  const part = Math.max(0, (t - list[k]) / (list[k + 1] - list[k]));
  return values[k] + part * (values[k + 1] - values[k]);
}

// Poses are { p, r }: a position, and a rotation by rows.
const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const scale = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const size = (a) => Math.hypot(a[0], a[1], a[2]);
const turned = (r, x) => r.map((row) => dot(row, x));
const at = (pose, x) => add(pose.p, turned(pose.r, x));
const WORLD = { p: [0, 0, 0], r: [[1, 0, 0], [0, 1, 0], [0, 0, 1]] };

function rotation(i, j, k, w) {
  const n = 2 / (i * i + j * j + k * k + w * w || 1);
  return [
    [1 - n * (j * j + k * k), n * (i * j - k * w), n * (i * k + j * w)],
    [n * (i * j + k * w), 1 - n * (i * i + k * k), n * (j * k - i * w)],
    [n * (i * k - j * w), n * (j * k + i * w), 1 - n * (i * i + j * j)],
  ];
}

// A pose seen from where another one is.
function composed(a, b) {
  const columns = [0, 1, 2].map((c) => turned(a.r, b.r.map((row) => row[c])));
  return { p: at(a, b.p), r: [0, 1, 2].map((c) => columns.map((column) => column[c])) };
}
