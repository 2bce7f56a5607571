// The path data of SVG as rings: the same curves as the package reads, from its rows of numbers.

import { curves_of_path } from "medial-axis/lib/svg_path.mjs";
import { size_of } from "./model.mjs";

/** Rings of path data; `map` maps its points to the plane. */
export function flat_path(text, map) {
  const rows = curves_of_path(text);
  const rings = [];
  let ring = null;
  const flip = Math.sign(turn_of(map));
  for (let k = 0; k < rows.length; ) {
    const kind = rows[k++];
    const take = () => map([rows[k++], rows[k++]]);
    if (kind === 0) {
      ++k;
      ring = { points: [take()], edges: [] };
      rings.push(ring);
    } else if (kind === 1) ring.points.push(take());
    else if (kind === 2) {
      const end = take();
      ring.edges.push([ring.points.length - 1, flip * rows[k++]]);
      ring.points.push(end);
    } else if (kind === 3) {
      const degree = rows[k++];
      const control = Array.from({ length: degree }, take);
      add_curve(ring, degree, control);
    } else {
      const [center, u, v] = [0, 1, 2].map(() => [rows[k++], rows[k++]]);
      add_ellipse(ring, center, u, v, rows[k++], rows[k++], map);
    }
  }
  return rings.map(closed).filter((one) => one && size_of(one) > 1);
}

const turn_of = (map) => {
  const [o, x, y] = [map([0, 0]), map([1, 0]), map([0, 1])];
  return (x[0] - o[0]) * (y[1] - o[1]) - (x[1] - o[1]) * (y[0] - o[0]);
};

function add_curve(ring, degree, control) {
  const [x0, y0] = ring.points.at(-1);
  ring.edges.push([ring.points.length - 1, degree === 3 ? control.slice(0, 2).flat() : raised([x0, y0], ...control)]);
  ring.points.push(control.at(-1));
}
/** A quadratic curve as a cubic one. */
function raised(a, q, b) {
  return [0, 1].flatMap((end) => [0, 1].map((d) => (2 * q[d] + (end ? b : a)[d]) / 3));
}
/** Quarters of an ellipse at most, as cubic curves. */
function add_ellipse(ring, center, u, v, begin, end, map) {
  const pieces = Math.ceil(Math.abs(end - begin) / (Math.PI / 4) - 1e-9);
  const step = (end - begin) / pieces;
  const arm = (4 / 3) * Math.tan(step / 4);
  for (let i = 0; i < pieces; ++i) {
    const at = (t, along) => {
      const [c, s] = [Math.cos(t), Math.sin(t)];
      return [0, 1].map((d) => center[d] + (c - along * s) * u[d] + (s + along * c) * v[d]);
    };
    const [t0, t1] = [begin + i * step, begin + (i + 1) * step];
    ring.edges.push([ring.points.length - 1, [...map(at(t0, arm)), ...map(at(t1, -arm))]]);
    ring.points.push(map(at(t1, 0)));
  }
}

function closed({ points, edges }) {
  const [first, last] = [points[0], points.at(-1)];
  const reach = 1e-9 * (1 + Math.abs(first[0]) + Math.abs(first[1]));
  const shut = points.length > 1 && Math.hypot(first[0] - last[0], first[1] - last[1]) <= reach;
  const kept = shut ? points.slice(0, -1) : points;
  return kept.length > 1 ? { xy: Float64Array.from(kept.flat()), edges: new Map(edges) } : null;
}
