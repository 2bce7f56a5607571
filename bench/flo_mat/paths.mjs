// Shapes as path data that both programs read alike: absolute M, L, Q, C and Z. flo-mat takes arcs for chords.

import { readFileSync } from 'node:fs';
import { gunzipSync } from 'node:zlib';

const counts = { M: 2, L: 2, H: 1, V: 1, C: 6, S: 4, Q: 4, T: 2, A: 7, Z: 0 };

/** Commands with their numbers, one set each. The flags of arcs need no space around them. */
function* commandsOf(data) {
  const number = /[\s,]*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)/y, flag = /[\s,]*([01])/y;
  for (const [, first, text] of data.matchAll(/([MLHVCSQTAZmlhvcsqtaz])([^MLHVCSQTAZmlhvcsqtaz]*)/g)) {
    let letter = first;
    const count = counts[letter.toUpperCase()];
    for (let at = 0, sets = 0;; ++sets) {
      const values = [];
      while (values.length < count) {
        const token = letter.toUpperCase() === 'A' && [3, 4].includes(values.length) ? flag : number;
        token.lastIndex = at;
        const found = token.exec(text);
        if (!found) break;
        at = token.lastIndex;
        values.push(Number(found[1]));
      }
      if (values.length < count || (count === 0 && sets > 0)) break;
      yield [letter, values];
      if (first === 'M') letter = 'L';
      if (first === 'm') letter = 'l';
    }
  }
}

/** An elliptic arc as cubic curves of at most a quarter turn. */
function cubicsOf([x0, y0], [rx, ry, degrees, large, sweep, x, y]) {
  const turn = degrees * Math.PI / 180, cos = Math.cos(turn), sin = Math.sin(turn);
  if (rx === 0 || ry === 0) return [[x0, y0, x, y, x, y]];
  // In the frame where the ellipse is the unit circle.
  const flat = (px, py) => [(cos * px + sin * py) / Math.abs(rx), (cos * py - sin * px) / Math.abs(ry)];
  const back = ([u, v]) => [cos * u * Math.abs(rx) - sin * v * Math.abs(ry),
    sin * u * Math.abs(rx) + cos * v * Math.abs(ry)];
  const [u, v] = flat(0.5 * (x - x0), 0.5 * (y - y0));
  const half = Math.hypot(u, v), scale = Math.max(1, half);
  const off = Math.sqrt(Math.max(0, scale * scale - half * half)) / half * (large === sweep ? -1 : 1);
  const centre = [-off * v, off * u];
  const begin = Math.atan2(-v - centre[1], -u - centre[0]);
  let angle = Math.atan2(v - centre[1], u - centre[0]) - begin;
  if (sweep && angle < 0) angle += 2 * Math.PI;
  if (!sweep && angle > 0) angle -= 2 * Math.PI;
  const pieces = Math.max(1, Math.ceil(Math.abs(angle) / (0.5 * Math.PI) - 1e-9));
  const step = angle / pieces, reach = 4 / 3 * Math.tan(step / 4);
  const [mx, my] = [0.5 * (x0 + x), 0.5 * (y0 + y)];
  const place = (t, along) => {
    const [px, py] = back([centre[0] + scale * (Math.cos(t) - along * Math.sin(t)),
      centre[1] + scale * (Math.sin(t) + along * Math.cos(t))]);
    return [mx + px, my + py];
  };
  return Array.from({ length: pieces }, (_, i) => {
    const t = begin + i * step;
    const end = i + 1 === pieces ? [x, y] : place(t + step, 0);
    return [...place(t, reach), ...place(t + step, -reach), ...end];
  });
}

/** Path data with absolute commands M, L, Q, C and Z alone. */
export function plain(data) {
  const words = [];
  let here = [0, 0], start = [0, 0], handle = null, before = '';
  for (const [letter, values] of commandsOf(data)) {
    const command = letter.toUpperCase();
    const relative = letter !== command;
    const from = here;
    const absolute = values.map((value, i) => (relative ? value + from[i % 2] : value));
    const mirrored = kinds => (kinds.includes(before) && handle ? [0, 1].map(k => 2 * from[k] - handle[k]) : from);
    const put = (name, points) => {
      words.push(name + points.join(' '));
      here = points.slice(-2);
      handle = points.length > 2 ? points.slice(-4, -2) : null;
    };
    if (command === 'Z') { words.push('Z'); here = start; handle = null; }
    if (command === 'M') { put('M', absolute); start = here; }
    if (command === 'L' || command === 'C' || command === 'Q') put(command, absolute);
    if (command === 'H') put('L', [relative ? from[0] + values[0] : values[0], from[1]]);
    if (command === 'V') put('L', [from[0], relative ? from[1] + values[0] : values[0]]);
    if (command === 'S') put('C', [...mirrored('CS'), ...absolute]);
    if (command === 'T') put('Q', [...mirrored('QT'), ...absolute]);
    if (command === 'A') {
      const end = [0, 1].map(k => (relative ? from[k] : 0) + values[5 + k]);
      if (end[0] !== from[0] || end[1] !== from[1]) {
        for (const cubic of cubicsOf(from, [...values.slice(0, 5), ...end])) put('C', cubic);
      }
    }
    before = command;
  }
  return words.join('');
}

/** The paths of an SVG, without view box and transforms. */
export function pathsOf(file) {
  return [...readFileSync(file, 'utf8').matchAll(/\sd="([^"]+)"/g)].map(match => plain(match[1]));
}

/** The polygons of a well-known text that have as many vertices as is asked for. */
export function polygonsOf(file, fewest, most) {
  const bytes = readFileSync(file);
  const text = (file.endsWith('.gz') ? gunzipSync(bytes) : bytes).toString();
  const polygons = text.match(/\(\s*\([^()]+\)(\s*,\s*\([^()]+\))*\s*\)/g) ?? [];
  return polygons
    .map(polygon => polygon.match(/\([^()]+\)/g).map(ring => ring.slice(1, -1).split(',').slice(0, -1)
      .map(point => point.trim().split(/\s+/).slice(0, 2))))
    .filter(rings => {
      const count = rings.reduce((sum, ring) => sum + ring.length, 0);
      return count >= fewest && count <= most;
    })
    .map(rings => rings.map((ring, i) => 'M' + (i > 0 ? against(rings[0], ring) : ring)
      .map(point => point.join(' ')).join('L') + 'Z').join(''));
}

/** A hole's ring, against its polygon's: both programs fill by the non-zero rule. */
function against(outer, hole) {
  const area = ring => ring.reduce((sum, [x, y], i) => {
    const [nextX, nextY] = ring[(i + 1) % ring.length];
    return sum + x * nextY - y * nextX;
  }, 0);
  return area(outer) * area(hole) > 0 ? [...hole].reverse() : hole;
}
