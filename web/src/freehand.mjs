// A line drawn by hand as a closed smooth curve.

/** Drops points within `reach` of the simplified line (Douglas and Peucker). */
export function simplified(points, reach) {
  const keep = new Uint8Array(points.length);
  keep[0] = keep[points.length - 1] = 1;
  const open = [[0, points.length - 1]];
  while (open.length) {
    const [from, to] = open.pop();
    const [a, b] = [points[from], points[to]];
    const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    const length = Math.hypot(dx, dy);
    let [worst, at] = [reach, -1];
    for (let i = from + 1; i < to; ++i) {
      const [x, y] = [points[i][0] - a[0], points[i][1] - a[1]];
      const away = length > 0 ? Math.abs(dx * y - dy * x) / length : Math.hypot(x, y);
      if (away > worst) [worst, at] = [away, i];
    }
    if (at < 0) continue;
    keep[at] = 1;
    open.push([from, at], [at, to]);
  }
  return points.filter((_, i) => keep[i]);
}

/** A closed curve of cubics through a few of the points (Catmull and Rom). */
export function smooth_ring(points, reach) {
  if (points.length < 8) return null;
  const kept = simplified([...points, points[0]], reach).slice(0, -1);
  if (kept.length < 3) return null;
  const n = kept.length;
  const edges = kept.map((p, i) => {
    const [before, q, after] = [kept[(i + n - 1) % n], kept[(i + 1) % n], kept[(i + 2) % n]];
    const third = Math.hypot(q[0] - p[0], q[1] - p[1]) / 3;
    const out = toward(before, q, third);
    const back = toward(p, after, third);
    return [i, [p[0] + out[0], p[1] + out[1], q[0] - back[0], q[1] - back[1]]];
  });
  return { xy: Float64Array.from(kept.flat()), edges: new Map(edges) };
}

function toward([x0, y0], [x1, y1], length) {
  const d = Math.hypot(x1 - x0, y1 - y0) || 1;
  return [((x1 - x0) * length) / d, ((y1 - y0) * length) / d];
}
