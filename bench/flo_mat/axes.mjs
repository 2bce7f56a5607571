// Axes as Bezier curves, whoever computed them: distances between them, branches as pairs of ends.

export const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);

/** A rational Bezier curve of degree 1 to 3 at t: the point and the derivative. `points` are [x, y, weight]. */
export function evaluate(points, t) {
  const s = 1 - t, degree = points.length - 1;
  const all = [0, 0, 0], slopes = [0, 0, 0];
  points.forEach(([px, py, w = 1], i) => {
    const choose = i === 0 || i === degree ? 1 : degree;
    const value = choose * w * s ** (degree - i) * t ** i;
    const slope = choose * w * ((i > 0 ? i * t ** (i - 1) * s ** (degree - i) : 0) -
                                (i < degree ? (degree - i) * t ** i * s ** (degree - i - 1) : 0));
    [px, py, 1].forEach((factor, k) => { all[k] += value * factor; slopes[k] += slope * factor; });
  });
  const [x, y, w] = all;
  return { point: [x / w, y / w], slope: [0, 1].map(k => (slopes[k] - slopes[2] * all[k] / w) / w) };
}

/** The curves of a native file's axes. */
export function curvesOf(native) {
  return native.items.flatMap(({ axis: { nodes, edges } }) => edges.map(([from, to, , , cx, cy, , weight = 1]) => {
    const a = nodes[from].slice(0, 2), b = nodes[to].slice(0, 2);
    return cx === undefined ? [a, b] : [a, [cx, cy, weight], b];
  }));
}

/** The nodes of a native file. */
export function nodesOf(native) {
  return native.items.flatMap(({ axis }) => axis.nodes.map(node => node.slice(0, 2)));
}

/** The diagonal of the box around a native file's vertices. */
export function diagonalOf(native) {
  let low = [Infinity, Infinity], high = [-Infinity, -Infinity];
  for (const [x, y] of native.items.flatMap(({ shape }) => shape.points)) {
    low = [Math.min(low[0], x), Math.min(low[1], y)];
    high = [Math.max(high[0], x), Math.max(high[1], y)];
  }
  return distance(low, high);
}

/** `count` points on the curves, as many on each as it is long, and their ends. */
export function samplesOf(curves, count) {
  const pieces = 8;  // of a curve, measured by their chords
  const chords = curves.flatMap(curve => {
    const n = curve.length === 2 ? 1 : pieces;
    const at = Array.from({ length: n + 1 }, (_, i) => evaluate(curve, i / n).point);
    return at.slice(1).map((point, i) => ({ curve, t: i / n, step: 1 / n, length: distance(at[i], point) }));
  });
  const step = chords.reduce((sum, { length }) => sum + length, 0) / count;
  const points = [];
  let left = 0.5 * step;
  for (const { curve, t, step: part, length } of chords) {
    for (; left < length; left += step) points.push(evaluate(curve, t + part * left / length).point);
    left -= length;
  }
  return points;
}

/** Distances to a set of curves: the nearest chord by a grid, then the nearest point of its curve. */
export class Distances {
  constructor(curves, diagonal) {
    this.size = diagonal / Math.max(16, Math.min(2048, Math.sqrt(curves.length) * 4));
    this.cells = new Map();
    this.low = [Infinity, Infinity];
    this.high = [-Infinity, -Infinity];
    for (const curve of curves) this.add(curve);
  }

  add(curve) {
    const ends = [0, 0.25, 0.5, 0.75, 1].map(t => evaluate(curve, t).point);
    const length = ends.slice(1).reduce((sum, point, i) => sum + distance(ends[i], point), 0);
    const n = Math.max(curve.length === 2 ? 1 : 4, Math.ceil(length / this.size));
    let a = ends[0];
    for (let i = 0; i < n; ++i) {
      const b = evaluate(curve, (i + 1) / n).point;
      const chord = { curve, a, b, from: i / n, step: 1 / n };
      for (let x = this.cell(Math.min(a[0], b[0])); x <= this.cell(Math.max(a[0], b[0])); ++x) {
        for (let y = this.cell(Math.min(a[1], b[1])); y <= this.cell(Math.max(a[1], b[1])); ++y) {
          const name = `${x},${y}`;
          if (!this.cells.has(name)) this.cells.set(name, []);
          this.cells.get(name).push(chord);
          this.low = [Math.min(this.low[0], x), Math.min(this.low[1], y)];
          this.high = [Math.max(this.high[0], x), Math.max(this.high[1], y)];
        }
      }
      a = b;
    }
  }

  cell(value) { return Math.floor(value / this.size); }

  of(p) {
    const x = this.cell(p[0]), y = this.cell(p[1]);
    const last = Math.max(this.high[0] - x, x - this.low[0], this.high[1] - y, y - this.low[1]);
    let least = Infinity;
    // Ring by ring: what is not within `ring` of them is farther away than that many cells.
    for (let ring = 0; ring <= last && (ring - 1) * this.size < least; ++ring) {
      for (let i = -ring; i <= ring; ++i) {
        for (let j = -ring; j <= ring; j += Math.abs(i) === ring ? 1 : Math.max(1, 2 * ring)) {
          for (const chord of this.cells.get(`${x + i},${y + j}`) ?? []) {
            const along = place(p, chord.a, chord.b);
            const foot = [0, 1].map(k => chord.a[k] + along * (chord.b[k] - chord.a[k]));
            // A chord is off its curve by less than a quarter of its length, all the more so where it is short.
            if (distance(p, foot) - 0.25 * distance(chord.a, chord.b) < least) {
              least = Math.min(least, nearest(p, chord, along));
            }
          }
        }
      }
    }
    return least;
  }
}

/** The place of p's foot along a segment, from 0 to 1. */
function place(p, a, b) {
  const d = [b[0] - a[0], b[1] - a[1]];
  const squared = d[0] * d[0] + d[1] * d[1];
  const t = squared > 0 ? ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / squared : 0;
  return Math.min(1, Math.max(0, t));
}

/** The distance to a chord's piece of its curve, by Newton's method from the foot on the chord. */
function nearest(p, { curve, from, step }, along) {
  let t = from + step * along, least = Infinity;
  for (let round = 0; round < 8; ++round) {
    const { point, slope } = evaluate(curve, t);
    least = Math.min(least, distance(p, point));
    const squared = slope[0] * slope[0] + slope[1] * slope[1];
    if (curve.length === 2 || !(squared > 0)) break;
    const next = t + ((p[0] - point[0]) * slope[0] + (p[1] - point[1]) * slope[1]) / squared;
    const inside = Math.min(from + step, Math.max(from, next));
    if (Math.abs(inside - t) < 1e-12) break;
    t = inside;
  }
  return least;
}

/** The values that 99 of 100 stay below, and the largest. */
export function spread(values) {
  const sorted = Float64Array.from(values).sort();
  const at = share => sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] ?? Infinity;
  return { most: at(0.99), largest: at(1) };
}

/** The branches of a native file as pairs of ends. */
export function branchesOf(native) {
  const branches = [];
  for (const { axis } of native.items) {
    const around = axis.nodes.map(() => []);
    axis.edges.forEach(([from, to], i) => { around[from].push([i, to]); around[to].push([i, from]); });
    const taken = new Set();
    around.forEach((edges, start) => {
      if (edges.length === 2) return;
      for (let [edge, at] of edges) {
        if (taken.has(edge)) continue;
        taken.add(edge);
        while (around[at].length === 2) {
          [edge, at] = around[at].find(([other]) => other !== edge);
          taken.add(edge);
        }
        branches.push([axis.nodes[start].slice(0, 2), axis.nodes[at].slice(0, 2)]);
      }
    });
  }
  return branches;
}

/** How many of `wanted`, leaving out short ones, have their two ends at those of one of `found`. */
export function matched(wanted, found, radius) {
  const cells = new Map();
  const key = (x, y) => `${x},${y}`;
  const cell = value => Math.floor(value / radius);
  const put = (a, b) => {
    const name = key(cell(a[0]), cell(a[1]));
    if (!cells.has(name)) cells.set(name, []);
    cells.get(name).push([a, b]);
  };
  for (const [a, b] of found) { put(a, b); put(b, a); }
  let count = 0, long = 0;
  for (const [a, b] of wanted) {
    if (distance(a, b) <= radius) continue;
    ++long;
    let here = false;
    for (let i = -1; i <= 1 && !here; ++i) {
      for (let j = -1; j <= 1 && !here; ++j) {
        here = (cells.get(key(cell(a[0]) + i, cell(a[1]) + j)) ?? [])
          .some(([c, d]) => distance(a, c) <= radius && distance(b, d) <= radius);
      }
    }
    if (here) ++count;
  }
  return { count, long };
}
