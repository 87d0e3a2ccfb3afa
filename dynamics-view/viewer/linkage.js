// A linkage: the poses of all bodies at a configuration, and the configuration over time.
document.documentElement.classList.add("script");
const times = decoded(data.time.row, data.count, data.time.unit);
const START = times[0], END = times[data.count - 1];
const recorded = data.q.map((line) => decoded(line.row, data.count, line.unit, line.from));
const placed = ([x, y, z, ...r]) => ({ p: [x, y, z], r: [r.slice(0, 3), r.slice(3, 6), r.slice(6)] });
for (const part of [...data.links, ...data.bodies]) part.at = placed(part.at);

// Between frames coordinates go the straight way, quaternions too: `rotation` makes them of length one.
function configurationAt(t) {
  const k = before(times, t), next = Math.min(k + 1, data.count - 1);
  const part = next > k ? Math.min(1, Math.max(0, (t - times[k]) / (times[next] - times[k]))) : 0;
  return recorded.map((row) => row[k] + part * (row[next] - row[k]));
}

// What a joint adds to its placement: about its z a turn, along it a slide; a quaternion; a position and a quaternion.
function moved(link, q) {
  const from = link.q, x = link.ratio * q[from] + link.offset;
  const [s, c] = [Math.sin(x), Math.cos(x)];
  switch (link.motion) {
    case "turn": return { p: [0, 0, 0], r: [[c, -s, 0], [s, c, 0], [0, 0, 1]] };
    case "slide": return { p: [0, 0, x], r: WORLD.r };
    case "ball": return { p: [0, 0, 0], r: rotation(...q.slice(from, from + 4)) };
    default: return { p: q.slice(from, from + 3), r: rotation(...q.slice(from + 3, from + 7)) };
  }
}
function posesOf(q) {
  const links = [];
  const pose = (k) => (k === null ? WORLD : links[k]);
  for (const link of data.links) links.push(composed(composed(pose(link.parent), link.at), moved(link, q)));
  return data.bodies.map((body) => composed(pose(body.link), body.at));
}
const posesAt = (t) => posesOf(configurationAt(t));
const otherPoses = [posesOf(data.start)];

// Angles about the fixed axes x, y and z, as URDF has them, of the rotation of a quaternion, and back.
function anglesOf(i, j, k, w) {
  const r = rotation(i, j, k, w);
  return [Math.atan2(r[2][1], r[2][2]), Math.asin(Math.min(1, Math.max(-1, -r[2][0]))), Math.atan2(r[1][0], r[0][0])];
}
function quaternionOf(roll, pitch, yaw) {
  const [sr, sp, sy] = [roll, pitch, yaw].map((x) => Math.sin(x / 2)), [cr, cp, cy] = [roll, pitch, yaw].map((x) => Math.cos(x / 2));
  return [sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy];
}
