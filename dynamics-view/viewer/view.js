// The robot, drawn from back to front.
let canvas = document.getElementById("view");
let pen = canvas.getContext("2d");
// Which canvas is drawn on, where there are several.
function aim(at) {
  canvas = at;
  pen = at.getContext("2d");
}
const shown = { masses: true, inertias: false, axes: false, trace: data.trace !== null, follow: false };
const FIELD = Math.tan((32 / 2) * (Math.PI / 180));
let colours = {};

function readColours() {
  const style = getComputedStyle(document.documentElement);
  const rgb = (name) => {
    const hex = style.getPropertyValue(name).trim().slice(1);
    return [0, 2, 4].map((k) => parseInt(hex.slice(k, k + 2), 16));
  };
  for (const name of ["paper", "ink", "muted", "line", "grid", "c0", "c1", "c2", "c3", "c4", "c5"]) {
    colours[name] = rgb("--" + name);
  }
  colours.dark = colours.paper[0] < 128;
  colours.link = colours.dark ? [124, 138, 152] : [134, 148, 162];
}
const mix = (a, b, part) => a.map((x, k) => x + part * (b[k] - x));
const css = (c, alpha = 1) => `rgba(${c.map(Math.round).join(",")},${alpha})`;

// Joints have the colour of their lines in the charts.
const joints = data.bodies.filter((body) => body.kind);
function jointColour(body) {
  for (const chart of data.charts) {
    const k = chart.lines.findIndex((line) => line.name === body.joint);
    if (k >= 0) return colours["c" + (k % 6)];
  }
  return colours["c" + (joints.indexOf(body) % 6)];
}

// How large everything is: the robot itself, and all places where it is.
const children = data.bodies.map((_, k) => data.bodies.filter((body) => body.parent === k));
const extent = { low: [Infinity, Infinity, Infinity], high: [-Infinity, -Infinity, -Infinity], robot: 0, points: [], near: [] };
(() => {
  const step = Math.max(1, Math.floor(data.count / 200)), seen = [...otherPoses];
  for (let k = 0; k < data.count + step - 1; k += step) seen.push(posesAt(times[Math.min(k, data.count - 1)]));
  for (const poses of seen) {
    const points = poses.map((pose) => pose.p);
    data.bodies.forEach((body, b) => { if (body.mass) points.push(at(poses[b], body.com)); });
    const low = [0, 1, 2].map((c) => Math.min(...points.map((p) => p[c])));
    const high = [0, 1, 2].map((c) => Math.max(...points.map((p) => p[c])));
    extent.robot = Math.max(extent.robot, size(sub(high, low)));
    const middle = center(poses);
    extent.points.push(...points);
    extent.near.push(...points.map((p) => sub(p, middle)));
    extent.low = extent.low.map((x, c) => Math.min(x, low[c]));
    extent.high = extent.high.map((x, c) => Math.max(x, high[c]));
  }
  const heaviest = data.bodies.map((body) => (body.ellipsoid ? Math.sqrt(Math.max(...body.ellipsoid.slice(0, 3), 0)) : 0));
  extent.robot = Math.max(extent.robot, 2 * Math.max(0, ...heaviest));
  extent.all = Math.max(size(sub(extent.high, extent.low)), extent.robot);
  if (!(extent.robot > 0)) extent.robot = extent.all > 0 ? 0.1 * extent.all : 1;
  if (!(extent.all > 0)) extent.all = extent.robot;
  shown.follow = extent.all > 3 * extent.robot;
})();
const mostMass = Math.max(0, ...data.bodies.map((body) => body.mass || 0));
const THICK = 0.02 * extent.robot;
// The ground is where the world says, unless something is below it.
const lowest = extent.low[2] < -0.02 * extent.all ? extent.low[2] - 0.06 * extent.robot : 0;
let ground = lowest;
const cell = (() => {
  const rough = (shown.follow ? 3 * extent.robot : extent.all) / 8, decade = 10 ** Math.floor(Math.log10(rough));
  return decade * [1, 2, 5, 10].find((k) => k * decade >= rough * 0.999);
})();

// The centre of mass.
function center(poses) {
  let [sum, mass] = [[0, 0, 0], 0];
  data.bodies.forEach((body, k) => {
    if (body.mass) { sum = add(sum, scale(at(poses[k], body.com), body.mass)); mass += body.mass; }
  });
  return mass > 0 ? scale(sum, 1 / mass) : poses[0].p;
}

// From how far away all places are seen, in a view so many times as wide as high.
let fitted = {};
function fit(aspect) {
  const key = `${aspect.toFixed(3)} ${shown.follow} ${camera.home}`;
  if (fitted.key === key) return fitted.distance;
  const { ahead, right, up } = axes(...camera.home);
  const points = shown.follow ? extent.near : extent.points.map((p) => sub(p, camera.target));
  const room = 4 * THICK;
  const needed = points.map((p) => {
    const across = Math.max((Math.abs(dot(p, right)) + room) / aspect, Math.abs(dot(p, up)) + room);
    return across / (0.84 * FIELD) - dot(p, ahead);
  });
  fitted = { key, distance: Math.max(...needed, 0.6 * extent.robot / FIELD) };
  return fitted.distance;
}
function axes(a, b) {
  const ahead = [-Math.cos(b) * Math.cos(a), -Math.cos(b) * Math.sin(a), -Math.sin(b)];
  const right = [-Math.sin(a), Math.cos(a), 0];
  return { ahead, right, up: cross(right, ahead) };
}

const camera = {};
function resetCamera() {
  const [x, y] = [0, 1].map((c) => extent.high[c] - extent.low[c]);
  // What moves in a plane is seen from before it.
  const azimuth = y < 0.25 * x ? -70 : x < 0.25 * y ? 20 : -52;
  camera.home = [(azimuth * Math.PI) / 180, (16 * Math.PI) / 180];
  [camera.azimuth, camera.height] = camera.home;
  camera.target = scale(add(extent.low, extent.high), 0.5);
  camera.zoom = 1;
  camera.shift = [0, 0, 0];
}

// The camera's axes and place, and what is where on the canvas.
let eye = {};
function look(poses) {
  const ratio = devicePixelRatio || 1, box = canvas.getBoundingClientRect();
  const [w, h] = [Math.round(box.width * ratio), Math.round(box.height * ratio)];
  if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
  const { ahead, right, up } = axes(camera.azimuth, camera.height);
  const target = add(shown.follow ? center(poses) : camera.target, camera.shift);
  const distance = camera.zoom * fit(w / h);
  eye = {
    ahead, right, up, target, distance, ratio, w, h,
    place: sub(target, scale(ahead, distance)), focus: h / 2 / FIELD, near: 0.02 * distance,
  };
}
const deep = (p) => dot(sub(p, eye.place), eye.ahead);
function projected(p) {
  const d = sub(p, eye.place), z = Math.max(dot(d, eye.ahead), eye.near);
  return [eye.w / 2 + (eye.focus * dot(d, eye.right)) / z, eye.h / 2 - (eye.focus * dot(d, eye.up)) / z, eye.focus / z];
}
// A segment without what is behind the eye; nothing, if all of it is.
function visible(p, q) {
  const [a, b] = [deep(p), deep(q)];
  if (a < eye.near && b < eye.near) return null;
  const cut = (x, y, dx, dy) => add(x, scale(sub(y, x), (eye.near - dx) / (dy - dx)));
  return [a < eye.near ? cut(p, q, a, b) : p, b < eye.near ? cut(q, p, b, a) : q];
}
function segment(p, q) {
  const seen = visible(p, q);
  if (!seen) return;
  const [a, b] = seen.map(projected);
  pen.moveTo(a[0], a[1]);
  pen.lineTo(b[0], b[1]);
}

function drawGround() {
  // Who follows a fall far above the ground sees a grid that stays below, and moves up by whole cells.
  const below = Math.floor((eye.target[2] - extent.robot) / (2 * cell)) * 2 * cell;
  ground = shown.follow ? Math.max(lowest, below) : lowest;
  const [cx, cy] = [0, 1].map((c) => Math.round(eye.target[c] / cell));
  const count = Math.ceil((shown.follow ? 4 * extent.robot : 0.95 * extent.all) / cell);
  pen.lineWidth = eye.ratio;
  for (let k = -count; k <= count; k++) {
    const fade = 1 - 0.75 * (Math.abs(k) / count);
    for (const [along, middle, other] of [[0, cx, cy], [1, cy, cx]]) {
      const point = (s) => {
        const p = [0, 0, ground];
        p[along] = (middle + k) * cell;
        p[1 - along] = (other + s) * cell;
        return p;
      };
      pen.beginPath();
      segment(point(-count), point(count));
      pen.strokeStyle = css(middle + k === 0 ? colours.line : colours.grid, fade);
      pen.stroke();
    }
  }
}

function drawTriad(pose, length, alpha = 1) {
  ["c1", "c2", "c0"].forEach((name, c) => {
    const unit = [0, 0, 0];
    unit[c] = length;
    pen.beginPath();
    segment(pose.p, at(pose, unit));
    pen.strokeStyle = css(colours[name], alpha);
    pen.lineWidth = 1.8 * eye.ratio;
    pen.lineCap = "round";
    pen.stroke();
  });
}

function strokeBetween(a, b, width, style) {
  pen.beginPath();
  pen.moveTo(a[0], a[1]);
  pen.lineTo(b[0], b[1]);
  pen.lineWidth = width;
  pen.strokeStyle = style;
  pen.stroke();
}

function drawCapsule(p, q, radius, colour) {
  const seen = visible(p, q);
  if (!seen) return;
  const [a, b] = seen.map(projected);
  const width = Math.max(2 * eye.ratio, radius * (a[2] + b[2]));
  pen.lineCap = "round";
  const edge = colours.dark ? [8, 10, 12] : [60, 70, 80];
  strokeBetween(a, b, width + 1.2 * eye.ratio, css(mix(colour, edge, 0.75)));
  strokeBetween(a, b, width, css(mix(colour, edge, 0.22)));
  // Light comes from above.
  const lift = -0.16 * width;
  const up = ([x, y]) => [x, y + lift];
  strokeBetween(up(a), up(b), 0.6 * width, css(colour));
  strokeBetween(up(a), up(b), 0.25 * width, css(mix(colour, [255, 255, 255], 0.35)));
}

function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (list) => {
    const out = [];
    for (const p of list) {
      while (out.length > 1) {
        const [a, b] = out.slice(-2);
        if ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) > 0) break;
        out.pop();
      }
      out.push(p);
    }
    return out.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}
function polygon(points, fill, edge) {
  pen.beginPath();
  points.forEach((p, k) => (k ? pen.lineTo(p[0], p[1]) : pen.moveTo(p[0], p[1])));
  pen.closePath();
  pen.fillStyle = fill;
  pen.fill();
  pen.lineWidth = eye.ratio;
  pen.lineJoin = "round";
  pen.strokeStyle = edge;
  pen.stroke();
}

function drawCylinder(middle, axis, radius, half, colour) {
  const side = Math.abs(axis[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
  const u = scale(cross(axis, side), 1 / size(cross(axis, side))), v = cross(axis, u);
  const ring = (s) => Array.from({ length: 24 }, (_, k) => {
    const angle = (k * Math.PI) / 12;
    const out = add(scale(u, radius * Math.cos(angle)), scale(v, radius * Math.sin(angle)));
    return projected(add(add(middle, scale(axis, s * half)), out));
  });
  const facing = dot(axis, sub(eye.place, middle)) > 0 ? 1 : -1;
  const edge = css(mix(colour, colours.dark ? [0, 0, 0] : [40, 40, 40], 0.5));
  polygon(hull([...ring(1), ...ring(-1)]), css(mix(colour, colours.dark ? [0, 0, 0] : [60, 60, 60], 0.18)), edge);
  polygon(ring(facing), css(mix(colour, [255, 255, 255], 0.28)), edge);
}

function drawBall(p, radius, colour, alpha) {
  const [x, y, s] = projected(p), r = Math.max(2.5 * eye.ratio, radius * s);
  const shade = pen.createRadialGradient(x - 0.35 * r, y - 0.4 * r, 0.1 * r, x, y, r);
  shade.addColorStop(0, css(mix(colour, [255, 255, 255], 0.55), alpha));
  shade.addColorStop(0.7, css(colour, alpha));
  shade.addColorStop(1, css(mix(colour, [0, 0, 0], 0.35), alpha));
  pen.beginPath();
  pen.arc(x, y, r, 0, 2 * Math.PI);
  pen.fillStyle = shade;
  pen.fill();
}

// The outline of an ellipsoid { c + x : xᵀ S⁻¹ x = 1 }: the ellipse of J S Jᵀ, where J is the projection about c.
function drawEllipsoid(pose, body, colour) {
  const [xx, yy, zz, xy, xz, yz] = body.ellipsoid;
  const S = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]], c = at(pose, body.com);
  const [x, y, s] = projected(c), d = sub(c, eye.place), z = dot(d, eye.ahead);
  if (z < eye.near) return;
  const row = (axis, sign) => scale(sub(axis, scale(eye.ahead, dot(d, axis) / z)), sign * s);
  const J = [row(eye.right, 1), row(eye.up, -1)].map((r) => [0, 1, 2].map((k) => dot(r, pose.r.map((line) => line[k]))));
  const M = J.map((a) => J.map((b) => dot(a, turned(S, b))));
  const mean = (M[0][0] + M[1][1]) / 2, off = Math.hypot((M[0][0] - M[1][1]) / 2, M[0][1]);
  const radii = [mean + off, mean - off].map((square) => Math.max(1.5 * eye.ratio, Math.sqrt(Math.max(0, square))));
  pen.beginPath();
  pen.ellipse(x, y, radii[0], radii[1], Math.atan2(2 * M[0][1], M[0][0] - M[1][1]) / 2, 0, 2 * Math.PI);
  pen.fillStyle = css(colour, 0.16);
  pen.fill();
  pen.lineWidth = 1.2 * eye.ratio;
  pen.strokeStyle = css(colour, 0.75);
  pen.stroke();
}

// The path: what has been gone by a time, and what is to come; all of it, at no time.
function drawPath(t) {
  const points = tracePoints();
  const now = t === null ? 0 : before(times, t);
  const stroke = (from, to, alpha, last) => {
    pen.beginPath();
    for (let k = from; k < to; k++) segment(points[k], points[k + 1]);
    if (last) segment(points[to], last);
    pen.strokeStyle = css(colours.c1, alpha);
    pen.lineWidth = 1.8 * eye.ratio;
    pen.lineCap = "butt";
    pen.stroke();
  };
  stroke(now, points.length - 1, 0.28);
  if (t !== null) stroke(0, now, 0.95, posesAt(t)[data.trace].p);
}
let traced = {};
function tracePoints() {
  if (traced.body !== data.trace) traced = { body: data.trace, points: Array.from(times, (t) => posesAt(t)[data.trace].p) };
  return traced.points;
}

// What a body is drawn as: lines from its origin to those whom it carries, or to its centre of mass.
function boneEnds(k, poses) {
  const far = (p) => size(sub(p, poses[k].p)) > 0.01 * extent.robot;
  const ends = data.bodies.flatMap((body, c) => (body.parent === k && far(poses[c].p) ? [poses[c].p] : []));
  const body = data.bodies[k];
  if (ends.length === 0 && body.mass) ends.push(at(poses[k], body.com));
  return ends.filter(far);
}

// The robot in its poses; with the path of a body as far as it has come by a time, or all of it at none.
function drawScene(poses, t) {
  look(poses);
  pen.clearRect(0, 0, eye.w, eye.h);
  drawGround();
  drawTriad(WORLD, 0.16 * Math.min(extent.robot, 3 * cell));
  const things = [], shadows = [];
  const put = (p, draw, nearer = 0) => things.push([deep(p) - nearer, draw]);
  const bone = (p, q, radius, colour) => {
    put(scale(add(p, q), 0.5), () => drawCapsule(p, q, radius, colour));
    shadows.push([p, q, radius]);
  };
  data.bodies.forEach((body, k) => {
    const pose = poses[k];
    if (body.parent === null && body.kind !== "free" && size(pose.p) > 0.01 * extent.robot) {
      bone([0, 0, 0], pose.p, 0.8 * THICK, mix(colours.link, colours.paper, 0.45));
    }
    for (const end of boneEnds(k, poses)) bone(pose.p, end, THICK, colours.link);
    if (body.kind && body.kind !== "free") {
      const colour = jointColour(body);
      for (const motion of body.motions) {
        const along = turned(pose.r, motion.along);
        const far = motion.through && size(motion.through) > 0.5 * extent.robot;
        const middle = motion.through && !far ? at(pose, motion.through) : pose.p;
        const [r, half] = motion.through ? [1.75 * THICK, 2 * THICK] : [1.15 * THICK, 4 * THICK];
        put(middle, () => drawCylinder(middle, along, r, half, colour), 2 * THICK);
      }
      if (body.kind === "ball") put(pose.p, () => drawBall(pose.p, 2 * THICK, colour, 1), 2 * THICK);
    }
    if (body.mass) {
      const middle = at(pose, body.com);
      const radius = Math.max(0.9 * THICK, 2.3 * THICK * Math.cbrt(body.mass / mostMass));
      if (shown.masses) put(middle, () => drawBall(middle, radius, colours.ink.map((x) => (colours.dark ? x * 0.8 : x + 30)), 0.82), 3 * THICK);
      if (shown.inertias && body.ellipsoid) put(middle, () => drawEllipsoid(pose, body, colours.c4), -1e3);
    }
    if (shown.axes) put(pose.p, () => drawTriad(pose, 5 * THICK), 1e3);
  });
  pen.lineCap = "round";
  const flat = (p) => [p[0], p[1], ground];
  if (eye.place[2] > ground) {
    for (const [p, q, radius] of shadows) {
      const seen = visible(flat(p), flat(q));
      if (!seen) continue;
      const [a, b] = seen.map(projected);
      strokeBetween(a, b, Math.max(2 * eye.ratio, radius * (a[2] + b[2])), css(colours.dark ? [0, 0, 0] : colours.muted, colours.dark ? 0.3 : 0.13));
    }
  }
  if (shown.trace && data.trace !== null) drawPath(t);
  things.sort((a, b) => b[0] - a[0]).forEach(([, draw]) => draw());
}
