// The drawing: rings of vertices whose edges are straight, arcs or cubic Bézier curves, and its history.
//
// A ring is { xy: Float64Array, edges: Map }. Edge i leads from vertex i to the next one; in `edges` it
// is a number, the bulge of an arc, or an array [x1, y1, x2, y2], the control points of a curve. A change
// makes a new ring, so that history shares all others; but where the axis follows edits of single vertices,
// a ring itself changes, and history has the edits.

export const size_of = (ring) => ring.xy.length / 2;
export const point_of = (ring, i) => [ring.xy[2 * i], ring.xy[2 * i + 1]];
export const next_of = (ring, i) => (i + 1) % size_of(ring);
export const count_of = (rings) => rings.reduce((sum, ring) => sum + size_of(ring), 0);

export function ring_of(points, edges = []) {
  return { xy: Float64Array.from(points.flat()), edges: new Map(edges) };
}

/** A ring with vertex i moved; the control points beside it move along. */
export function moved_vertex(ring, i, [x, y]) {
  const xy = ring.xy.slice();
  const [dx, dy] = [x - xy[2 * i], y - xy[2 * i + 1]];
  xy[2 * i] = x;
  xy[2 * i + 1] = y;
  const edges = new Map(ring.edges);
  const before = (i + size_of(ring) - 1) % size_of(ring);
  const shift = (e, at) => {
    const curve = edges.get(e);
    if (!Array.isArray(curve)) return;
    edges.set(e, curve.map((v, k) => (k === at ? v + dx : k === at + 1 ? v + dy : v)));
  };
  shift(i, 0);
  shift(before, 2);
  return { xy, edges };
}

export function moved_edge(ring, i, dx, dy) {
  const j = next_of(ring, i);
  const [a, b] = [point_of(ring, i), point_of(ring, j)];
  return moved_vertex(moved_vertex(ring, i, [a[0] + dx, a[1] + dy]), j, [b[0] + dx, b[1] + dy]);
}

export function moved_ring(ring, dx, dy) {
  const shift = (v, k) => v + (k % 2 ? dy : dx);
  const edges = [...ring.edges].map(([i, e]) => [i, Array.isArray(e) ? e.map(shift) : e]);
  return { xy: ring.xy.map(shift), edges: new Map(edges) };
}

export function with_edge(ring, i, edge) {
  const edges = new Map(ring.edges);
  if (edge === 0 || edge === undefined) edges.delete(i);
  else edges.set(i, edge);
  return { xy: ring.xy, edges };
}

/** A ring whose edge i is a cubic curve instead of a line or an arc, or a line instead of a curve. */
export function with_curve(ring, i) {
  const edge = ring.edges.get(i);
  if (Array.isArray(edge)) return with_edge(ring, i, 0);
  const [a, b] = [point_of(ring, i), point_of(ring, next_of(ring, i))];
  if (edge === undefined) return with_edge(ring, i, [1, 2].flatMap((k) => [0, 1].map((d) => a[d] + ((b[d] - a[d]) * k) / 3)));
  const { begin, angle, radius } = arc_of(a, b, edge);
  const reach = (4 / 3) * edge * radius;
  const along = (at, sign) => [-sign * Math.sin(at) * reach, sign * Math.cos(at) * reach];
  const [from, to] = [along(begin, 1), along(begin + angle, -1)];
  return with_edge(ring, i, [a[0] + from[0], a[1] + from[1], b[0] + to[0], b[1] + to[1]]);
}

/** A ring whose edge i is bent further to its right by a share of its length, a negative one to its left. */
export function with_bend(ring, i, share) {
  const edge = ring.edges.get(i);
  if (!Array.isArray(edge)) {
    const bulge = Math.min(1, Math.max(-1, (edge ?? 0) + 2 * share));
    return with_edge(ring, i, Math.abs(bulge) < 1e-9 ? 0 : bulge);
  }
  const [a, b] = [point_of(ring, i), point_of(ring, next_of(ring, i))];
  const by = [(b[1] - a[1]) * share, (a[0] - b[0]) * share];
  return with_edge(ring, i, edge.map((v, k) => v + by[k % 2]));
}

/** A ring with one more vertex, inside edge i. */
export function with_vertex(ring, i, [x, y]) {
  const xy = new Float64Array(ring.xy.length + 2);
  xy.set(ring.xy.subarray(0, 2 * i + 2));
  xy.set([x, y], 2 * i + 2);
  xy.set(ring.xy.subarray(2 * i + 2), 2 * i + 4);
  const edges = new Map();
  for (const [e, value] of ring.edges) if (e !== i) edges.set(e > i ? e + 1 : e, value);
  return { xy, edges };
}

/** A ring without a vertex; null if too few vertices would remain. */
export function without_vertex(ring, i) {
  const count = size_of(ring);
  if (count <= 3) return null;
  const xy = new Float64Array(ring.xy.length - 2);
  xy.set(ring.xy.subarray(0, 2 * i));
  xy.set(ring.xy.subarray(2 * i + 2), 2 * i);
  const edges = new Map();
  const before = (i + count - 1) % count;
  for (const [e, value] of ring.edges) if (e !== i && e !== before) edges.set(e > i ? e - 1 : e, value);
  return { xy, edges };
}

export function bounds_of(rings) {
  let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
  const add = (x, y) => {
    if (x < x0) x0 = x;
    if (x > x1) x1 = x;
    if (y < y0) y0 = y;
    if (y > y1) y1 = y;
  };
  for (const ring of rings) {
    for (let k = 0; k < ring.xy.length; k += 2) add(ring.xy[k], ring.xy[k + 1]);
    for (const [i, edge] of ring.edges) for (const [x, y] of samples(ring, i, edge)) add(x, y);
  }
  return x0 <= x1 ? [x0, y0, x1, y1] : [0, 0, 1, 1];
}

/** Center, radius and angles of an arc. */
export function arc_of([x0, y0], [x1, y1], bulge) {
  const across = (1 - bulge * bulge) / (4 * bulge);
  const [dx, dy] = [x1 - x0, y1 - y0];
  const [cx, cy] = [x0 + 0.5 * dx - across * dy, y0 + 0.5 * dy + across * dx];
  const begin = Math.atan2(y0 - cy, x0 - cx);
  return { cx, cy, radius: Math.hypot(x0 - cx, y0 - cy), begin, angle: 4 * Math.atan(bulge) };
}

/** An arc as a line within a quarter of a pixel at a scale: x and y of its points, from a to b. */
export function chords_of(a, b, bulge, scale) {
  const { cx, cy, radius, begin, angle } = arc_of(a, b, bulge);
  const step = Math.max(0.02, 2 * Math.acos(Math.max(0, 1 - 0.25 / (radius * scale))));
  const count = Math.ceil(Math.abs(angle) / step);
  const line = [...a];
  for (let k = 1; k < count; ++k) {
    const at = begin + (k / count) * angle;
    line.push(cx + radius * Math.cos(at), cy + radius * Math.sin(at));
  }
  line.push(...b);
  return line;
}

/** Points along a bent edge without its ends, to hit and to bound it. */
export function samples(ring, i, edge, count = 16) {
  const [a, b] = [point_of(ring, i), point_of(ring, next_of(ring, i))];
  const arc = typeof edge === "number" ? arc_of(a, b, edge) : null;
  return Array.from({ length: count - 1 }, (_, k) => {
    const t = (k + 1) / count;
    if (arc) {
      const at = arc.begin + t * arc.angle;
      return [arc.cx + arc.radius * Math.cos(at), arc.cy + arc.radius * Math.sin(at)];
    }
    const s = 1 - t;
    const w = [s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t];
    return [0, 1].map((d) => w[0] * a[d] + w[1] * edge[d] + w[2] * edge[2 + d] + w[3] * b[d]);
  });
}

/** Points along an edge, bent as given or straight, including its ends. */
export function line_of(ring, i, edge) {
  return [point_of(ring, i), ...(edge ? samples(ring, i, edge) : []), point_of(ring, next_of(ring, i))];
}

/** Points of a ring with bent edges as chords. */
export function outline(ring, count = 24) {
  const points = [];
  for (let i = 0; i < size_of(ring); ++i) {
    points.push(point_of(ring, i));
    if (ring.edges.has(i)) points.push(...samples(ring, i, ring.edges.get(i), count));
  }
  return points;
}

export function contains(ring, [x, y]) {
  const points = ring.edges.size ? outline(ring) : null;
  const n = points ? points.length : size_of(ring);
  const px = (k) => (points ? points[k][0] : ring.xy[2 * k]);
  const py = (k) => (points ? points[k][1] : ring.xy[2 * k + 1]);
  let inside = false;
  for (let i = 0, j = n - 1; i < n; j = i++)
    if (py(i) > y !== py(j) > y && x < ((px(j) - px(i)) * (y - py(i))) / (py(j) - py(i)) + px(i)) inside = !inside;
  return inside;
}

/** The rings as the package takes them, and the options that go with them. */
export function input_of(rings, medial) {
  const curved = rings.some((ring) => [...ring.edges.values()].some(Array.isArray));
  if (curved) return { x: rings.map((ring) => contour_of(ring, medial)), options: {} };
  if (!rings.some((ring) => ring.edges.size)) return { x: rings.map((ring) => ring.xy), options: {} };
  const bulges = rings.flatMap((ring) => Array.from({ length: size_of(ring) }, (_, i) => ring.edges.get(i) ?? 0));
  return { x: rings.map((ring) => ring.xy), options: { bulges } };
}

function contour_of(ring, medial) {
  const contour = new medial.Contour(point_of(ring, 0));
  for (let i = 0; i < size_of(ring); ++i) {
    const edge = ring.edges.get(i);
    const end = point_of(ring, next_of(ring, i));
    if (typeof edge === "number") contour.arcTo(end, edge);
    else if (edge) contour.bezierTo([edge.slice(0, 2), edge.slice(2), end]);
    else contour.lineTo(end);
  }
  return contour;
}

/**
 * Moves, inserts or removes a vertex of a ring: { kind, ring, index, point }; an inserted one comes before
 * the vertex `index`. Or bends an edge: { kind: "bend", ring, index, edge }, or moves a ring:
 * { kind: "ring", ring, xy }. Gives the edit that takes it back.
 */
export function apply_edit(rings, { kind, ring: r, index, point, xy, edge }) {
  const ring = rings[r];
  if (kind === "bend") {
    const old = ring.edges.get(index) ?? 0;
    Object.assign(ring, with_edge(ring, index, edge));
    return { kind, ring: r, index, edge: old };
  }
  if (kind === "ring") {
    const old = ring.xy;
    ring.xy = xy;
    return { kind, ring: r, xy: old };
  }
  if (kind === "insert") {
    Object.assign(ring, with_vertex(ring, index - 1, point));
    return { kind: "remove", ring: r, index };
  }
  const old = point_of(ring, index);
  if (kind === "remove") {
    Object.assign(ring, without_vertex(ring, index));
    return { kind: "insert", ring: r, index, point: old };
  }
  ring.xy.set(point, 2 * index);
  return { kind, ring: r, index, point: old };
}

/** Steps of the drawing, to go back and forth without limit: each two states, or edits and their inverses. */
export class History {
  #steps = [];
  #at = 0;

  get canUndo() {
    return this.#at > 0;
  }
  get canRedo() {
    return this.#at < this.#steps.length;
  }
  add(step) {
    this.#steps.length = this.#at++;
    this.#steps.push(step);
  }
  undo() {
    return this.canUndo ? this.#steps[--this.#at] : null;
  }
  redo() {
    return this.canRedo ? this.#steps[this.#at++] : null;
  }
}
