// The outlines of a picture's dark parts, between its pixels (marching squares), simplified.

import { simplified } from "./freehand.mjs";
import { ring_of } from "./model.mjs";
import { area_of } from "./tools.mjs";

/** How dark a pixel is, in [0, 1], over white. */
function darkness({ data, width, height }) {
  const values = new Float32Array((width + 2) * (height + 2));
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x) {
      const k = 4 * (y * width + x);
      const light = (0.299 * data[k] + 0.587 * data[k + 1] + 0.114 * data[k + 2]) / 255;
      values[(y + 1) * (width + 2) + x + 1] = (1 - light) * (data[k + 3] / 255);
    }
  return { values, width: width + 2, height: height + 2 };
}

export function trace(image, level = 0.5) {
  const grid = darkness(image);
  const { next, place } = crossings(grid, level);
  const rings = [];
  while (next.size) {
    const [start] = next.keys();
    const points = [];
    for (let at = start; next.has(at); ) {
      points.push(place(at));
      const to = next.get(at);
      next.delete(at);
      at = to;
    }
    const few = simplified([...points, points[0]], 0.35).slice(0, -1);
    const ring = few.length > 2 ? ring_of(few) : null;
    if (ring && area_of(ring) > 12) rings.push(ring);
  }
  return rings;
}

// A crossing lies on an edge between two pixels: 2 k is the edge from pixel k to the right, 2 k + 1 the
// one down. Each square of four pixels leads from crossing to crossing, with the dark on the left.
const TURNS = {
  1: [["l", "t"]], 2: [["t", "r"]], 3: [["l", "r"]], 4: [["r", "b"]], 5: [["l", "t"], ["r", "b"]], 6: [["t", "b"]],
  7: [["l", "b"]], 8: [["b", "l"]], 9: [["b", "t"]], 10: [["t", "r"], ["b", "l"]], 11: [["b", "r"]], 12: [["r", "l"]],
  13: [["r", "t"]], 14: [["t", "l"]],
};

function crossings({ values, width, height }, level) {
  const next = new Map();
  for (let y = 0; y + 1 < height; ++y)
    for (let x = 0; x + 1 < width; ++x) {
      const k = y * width + x;
      const dark = (at) => (values[at] > level ? 1 : 0);
      const kind = dark(k) + 2 * dark(k + 1) + 4 * dark(k + width + 1) + 8 * dark(k + width);
      const side = { t: 2 * k, b: 2 * (k + width), l: 2 * k + 1, r: 2 * (k + 1) + 1 };
      for (const [from, to] of TURNS[kind] ?? []) next.set(side[from], side[to]);
    }
  const place = (edge) => {
    const k = edge >> 1;
    const other = edge & 1 ? k + width : k + 1;
    const share = Math.min(0.98, Math.max(0.02, (level - values[k]) / (values[other] - values[k])));
    const [x, y] = [k % width, Math.floor(k / width)];
    return edge & 1 ? [x, -(y + share)] : [x + share, -y];
  };
  return { next, place };
}
