// The path data of SVG, as rows of curves (see contours_from() in src/shapes.cpp).

import { MedialError } from "./core.mjs";

const TOKEN = /([MmLlHhVvCcSsQqTtAaZz])|([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)|[\s,]+/y;
const COUNT = { M: 2, L: 2, H: 1, V: 1, C: 6, S: 4, Q: 4, T: 2, A: 7, Z: 0 };
const WINDING = 3;
const malformed = (text) => new MedialError(text, "malformed");

/** Commands with their numbers. */
function tokens(text) {
  const commands = [];
  for (let at = 0; at < text.length; ) {
    TOKEN.lastIndex = at;
    const found = TOKEN.exec(text);
    if (!found) throw malformed(`an SVG path cannot have '${text[at]}' at place ${at}`);
    at = TOKEN.lastIndex;
    if (found[1]) commands.push([found[1], []]);
    if (!found[2]) continue;
    if (!commands.length) throw malformed("an SVG path begins with M");
    const [name, numbers] = commands.at(-1);
    let value = found[2];
    if ("Aa".includes(name) && [3, 4].includes(numbers.length % 7)) {
      if (!"01".includes(value[0])) throw malformed("a flag of an arc in an SVG path is 0 or 1");
      at = found.index + 1; // flags need no separator
      value = value[0];
    }
    numbers.push(Number(value));
  }
  return commands;
}

/** A command for each set of numbers. */
function sets(commands) {
  return commands.flatMap(([letter, numbers]) => {
    const count = COUNT[letter.toUpperCase()];
    if (count === 0 && numbers.length === 0) return [[letter, []]];
    if (count === 0 || !numbers.length || numbers.length % count)
      throw malformed(`${letter} needs ${count} numbers each time in an SVG path`);
    return Array.from({ length: numbers.length / count }, (_, i) => [
      i === 0 ? letter : ({ M: "L", m: "l" }[letter] ?? letter),
      numbers.slice(i * count, (i + 1) * count),
    ]);
  });
}

/** An elliptical arc by its end points, as appendix B.2 of SVG 2 converts it. */
function arc([x0, y0], [rx0, ry0, degrees, large, sweep], [x1, y1]) {
  if (x0 === x1 && y0 === y1) return [];
  let rx = Math.abs(rx0);
  let ry = Math.abs(ry0);
  if (rx === 0 || ry === 0) return [1, x1, y1];
  const c = Math.cos((degrees * Math.PI) / 180);
  const s = Math.sin((degrees * Math.PI) / 180);
  const hx = (c * (x0 - x1) + s * (y0 - y1)) / 2;
  const hy = (c * (y0 - y1) - s * (x0 - x1)) / 2;
  let size = (hx / rx) ** 2 + (hy / ry) ** 2;
  if (size > 1) {
    rx *= Math.sqrt(size);
    ry *= Math.sqrt(size);
    size = 1;
  }
  const away = Math.sqrt(Math.max(0, 1 / size - 1)) * (Boolean(large) === Boolean(sweep) ? -1 : 1);
  const cx = (away * rx * hy) / ry;
  const cy = (-away * ry * hx) / rx;
  const begin = Math.atan2((hy - cy) / ry, (hx - cx) / rx);
  let angle = Math.atan2((-hy - cy) / ry, (-hx - cx) / rx) - begin;
  if (sweep && angle < 0) angle += 2 * Math.PI;
  if (!sweep && angle > 0) angle -= 2 * Math.PI;
  const mx = c * cx - s * cy + (x0 + x1) / 2;
  const my = s * cx + c * cy + (y0 + y1) / 2;
  if (rx !== ry) return [5, mx, my, c * rx, s * rx, -s * ry, c * ry, begin, begin + angle];
  const pieces = Math.ceil(Math.abs(angle) / Math.PI - 1e-9) || 1; // a circle: exact arcs
  const rows = [];
  for (let i = 1; i <= pieces; ++i) {
    const at = begin + (angle * i) / pieces;
    const [dx, dy] = [rx * Math.cos(at), rx * Math.sin(at)];
    const end = i === pieces ? [x1, y1] : [mx + c * dx - s * dy, my + s * dx + c * dy];
    rows.push(2, ...end, Math.tan(angle / pieces / 4));
  }
  return rows;
}

/** Follows the commands of a path. */
class Pen {
  rows = [];
  at = [0, 0];
  start = [0, 0];
  control = [0, 0];
  open = false;
  begun = false;

  begin(point) {
    this.start = point;
    this.at = point;
    this.open = false;
    this.begun = true;
  }

  add(row, end) {
    if (!row.length) return;
    if (!this.open) this.rows.push(0, WINDING, ...this.start);
    this.open = true;
    this.rows.push(...row);
    this.at = end;
  }

  step(letter, numbers, before) {
    const name = letter.toUpperCase();
    const [bx, by] = letter === name ? [0, 0] : this.at;
    const points = [];
    for (let i = 0; i + 1 < numbers.length; i += 2) points.push([bx + numbers[i], by + numbers[i + 1]]);
    if (name === "M") return this.begin(points[0]);
    if (!this.begun) throw malformed("an SVG path begins with M");
    if (name === "Z") return this.begin(this.start);
    const mirrored = [2 * this.at[0] - this.control[0], 2 * this.at[1] - this.control[1]];
    if (name === "S") points.unshift("CS".includes(before) ? mirrored : this.at);
    if (name === "T") points.unshift("QT".includes(before) ? mirrored : this.at);
    if ("CSQT".includes(name)) {
      this.control = points.at(-2);
      return this.add([3, points.length, ...points.flat()], points.at(-1));
    }
    let end = points[0];
    if (name === "H") end = [bx + numbers[0], this.at[1]];
    if (name === "V") end = [this.at[0], by + numbers[0]];
    if (name === "A") end = [bx + numbers[5], by + numbers[6]];
    if (name === "A") return this.add(arc(this.at, numbers, end), end);
    if (end[0] !== this.at[0] || end[1] !== this.at[1]) this.add([1, ...end], end);
  }
}

/** The subpaths of an SVG path, each a closed contour of the non-zero rule. */
export function curves_of_path(text) {
  const pen = new Pen();
  let before = "M";
  for (const [letter, numbers] of sets(tokens(text))) {
    pen.step(letter, numbers, before);
    before = letter.toUpperCase();
    if (!"CSQT".includes(before)) pen.control = pen.at;
  }
  return Float64Array.from(pen.rows);
}
