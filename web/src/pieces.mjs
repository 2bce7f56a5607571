// The edges of an axis as pieces to draw: each a conic (a rational quadratic Bézier curve with the
// weights 1, w, 1) of about one colour.

export const SHADES = 64;
const STRIDE = 7; // x0 y0 cx cy x1 y1 w

/** Pieces in the order of their shades; shade s is [begin[s], begin[s + 1]). */
export class Pieces {
  constructor(axis, fine = axis.edges.length < 6000) {
    const { nodes, edges } = axis;
    const { x, y, radius } = nodes;
    const { from, to, controlX, controlY, controlRadius, weight } = edges;
    let largest = 0;
    for (const r of radius) if (r > largest) largest = r;
    this.largest = largest || 1;
    const factor = (SHADES - 1) / this.largest;
    const rows = [];
    const shades = [];
    for (let e = 0; e < from.length; ++e) {
      const [a, b] = [from[e], to[e]];
      const difference = Math.abs(radius[a] - radius[b]) * factor;
      const parts = fine ? Math.min(24, Math.max(1, Math.ceil(difference / 1.5))) : 1;
      if (parts === 1) {
        rows.push(x[a], y[a], controlX[e], controlY[e], x[b], y[b], weight[e]);
        shades.push(((radius[a] + radius[b]) / 2) * factor);
        continue;
      }
      const curve = [x[a], y[a], radius[a], controlX[e], controlY[e], controlRadius[e], x[b], y[b], radius[b], weight[e]];
      for (let k = 0; k < parts; ++k) add_part(rows, shades, curve, k / parts, (k + 1) / parts, factor);
    }
    this.#sort(rows, shades);
  }

  #sort(rows, shades) {
    const count = shades.length;
    this.begin = new Uint32Array(SHADES + 1);
    const bin = Uint8Array.from(shades, (s) => Math.min(SHADES - 1, Math.max(0, Math.round(s))));
    for (let i = 0; i < count; ++i) ++this.begin[bin[i] + 1];
    for (let s = 0; s < SHADES; ++s) this.begin[s + 1] += this.begin[s];
    const next = this.begin.slice();
    this.numbers = new Float64Array(count * STRIDE);
    for (let i = 0; i < count; ++i) {
      let to = next[bin[i]]++ * STRIDE;
      for (let k = i * STRIDE; k < (i + 1) * STRIDE; ++k) this.numbers[to++] = rows[k];
    }
  }

  /** Adds the visible pieces of a shade to a path of the screen. */
  trace(path, shade, camera) {
    const { cx, cy, dx, dy, scale } = camera.transform;
    const [right, bottom] = [camera.width + 4, camera.height + 4];
    const n = this.numbers;
    for (let k = this.begin[shade] * STRIDE; k < this.begin[shade + 1] * STRIDE; k += STRIDE) {
      const x0 = (n[k] - cx) * scale + dx;
      const y0 = (cy - n[k + 1]) * scale + dy;
      const x1 = (n[k + 4] - cx) * scale + dx;
      const y1 = (cy - n[k + 5]) * scale + dy;
      const x = (n[k + 2] - cx) * scale + dx;
      const y = (cy - n[k + 3]) * scale + dy;
      if (Math.max(x0, x1, x) < -4 || Math.min(x0, x1, x) > right) continue;
      if (Math.max(y0, y1, y) < -4 || Math.min(y0, y1, y) > bottom) continue;
      conic(path, x0, y0, x, y, x1, y1, n[k + 6], right, bottom);
    }
  }
}

/** The part of a rational quadratic between two parameters, in the form with weights 1, w, 1. */
export function add_part(rows, shades, curve, s, t, factor) {
  const [x0, y0, r0, cx, cy, cr, x1, y1, r1, w] = curve;
  const blend = (a, b) => {
    const [f, g, h] = [(1 - a) * (1 - b), a * (1 - b) + b * (1 - a), a * b];
    const weight = f + g * w + h;
    return [f * x0 + g * w * cx + h * x1, f * y0 + g * w * cy + h * y1, f * r0 + g * w * cr + h * r1, weight];
  };
  const [p, q, r] = [blend(s, s), blend(s, t), blend(t, t)];
  rows.push(p[0] / p[3], p[1] / p[3], q[0] / q[3], q[1] / q[3], r[0] / r[3], r[1] / r[3], q[3] / Math.sqrt(p[3] * r[3]));
  shades.push(((p[2] / p[3] + r[2] / r[3]) / 2) * factor);
}

/** Draws a conic by parabolas that are a tenth of a pixel away at most; of weight 1 it is one itself. */
export function conic(path, x0, y0, x, y, x1, y1, w, right, bottom) {
  const bend = Math.hypot(x0 - 2 * x + x1, y0 - 2 * y + y1);
  if (bend < 0.2 || w === 1) {
    // Clips pieces that extend far beyond the screen: canvases store coordinates with few digits.
    if (Math.max(Math.abs(x0), Math.abs(y0), Math.abs(x1), Math.abs(y1), Math.abs(x), Math.abs(y)) > 2e4)
      return cut(path, x0, y0, x, y, x1, y1, w, right, bottom);
    path.moveTo(x0, y0);
    if (bend < 0.2) path.lineTo(x1, y1);
    else path.quadraticCurveTo(x, y, x1, y1);
    return;
  }
  if (Math.abs(w - 1) * bend < 0.4) return conic(path, x0, y0, x, y, x1, y1, 1, right, bottom);
  halves(path, x0, y0, x, y, x1, y1, w, right, bottom);
}

function halves(path, x0, y0, x, y, x1, y1, w, right, bottom) {
  const d = 1 / (1 + w);
  const [ax, ay] = [(x0 + w * x) * d, (y0 + w * y) * d];
  const [bx, by] = [(w * x + x1) * d, (w * y + y1) * d];
  const [mx, my] = [(ax + bx) / 2, (ay + by) / 2];
  const half = Math.sqrt((1 + w) / 2);
  const seen = (p, q, r, limit) => Math.max(p, q, r) >= -4 && Math.min(p, q, r) <= limit;
  if (seen(x0, ax, mx, right) && seen(y0, ay, my, bottom)) conic(path, x0, y0, ax, ay, mx, my, half, right, bottom);
  if (seen(mx, bx, x1, right) && seen(my, by, y1, bottom)) conic(path, mx, my, bx, by, x1, y1, half, right, bottom);
}

function cut(path, x0, y0, x, y, x1, y1, w, right, bottom) {
  const bend = Math.hypot(x0 - 2 * x + x1, y0 - 2 * y + y1);
  if (bend >= 0.2) return halves(path, x0, y0, x, y, x1, y1, w, right, bottom);
  const line = clipped(x0, y0, x1, y1, -50, -50, right + 50, bottom + 50);
  if (!line) return;
  path.moveTo(line[0], line[1]);
  path.lineTo(line[2], line[3]);
}

/** The part of a segment inside a box (Liang and Barsky). */
export function clipped(x0, y0, x1, y1, left, top, right, bottom) {
  let [from, to] = [0, 1];
  const [dx, dy] = [x1 - x0, y1 - y0];
  for (const [p, q] of [[-dx, x0 - left], [dx, right - x0], [-dy, y0 - top], [dy, bottom - y0]]) {
    if (p === 0 && q < 0) return null;
    if (p < 0) from = Math.max(from, q / p);
    if (p > 0) to = Math.min(to, q / p);
  }
  return from <= to ? [x0 + from * dx, y0 + from * dy, x0 + to * dx, y0 + to * dy] : null;
}
