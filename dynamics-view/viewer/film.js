// A film: the poses of all bodies as they were recorded.
const times = decoded(data.time.row, data.count, data.time.unit);
const START = times[0], END = times[data.count - 1];
for (const body of data.bodies) {
  body.place = body.place.map((row, k) => decoded(row, data.count, k < 3 ? data.unit : data.turn));
}
const otherPoses = [];

// The poses of all bodies at a time: between frames positions and quaternions go the straight way.
function posesAt(t) {
  const k = before(times, t), next = Math.min(k + 1, data.count - 1);
  const part = next > k ? Math.min(1, Math.max(0, (t - times[k]) / (times[next] - times[k]))) : 0;
  const poses = [];
  for (const body of data.bodies) {
    const [x, y, z, i, j, l, w] = body.place.map((row) => row[k] + part * (row[next] - row[k]));
    const parent = body.parent === null ? WORLD : poses[body.parent];
    poses.push(composed(parent, { p: [x, y, z], r: rotation(i, j, l, w) }));
  }
  return poses;
}
