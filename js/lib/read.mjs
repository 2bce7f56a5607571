// Reads polygons of any supported format as rings of coordinates or rows of curves.

import { MedialError } from "./core.mjs";
import { curves_of_path } from "./svg_path.mjs";

const ANY = 0;
const OUTER = 1;
const HOLE = 2;

const malformed = () => new MedialError("coordinates are pairs of x and y", "malformed");

/** Calls a reader; turns errors of its input into a MedialError. */
function checked(reader, x) {
  try {
    return reader(x);
  } catch (error) {
    if (error instanceof MedialError) throw error;
    throw new MedialError(`the geometry cannot be read: ${error.message}`, "malformed");
  }
}

/** Rings by their coordinates: ring i is from begin[i] to begin[i + 1]. */
export function rings_of_lists(lists, role) {
  const begin = new Uint32Array(lists.length + 1);
  lists.forEach((list, i) => (begin[i + 1] = begin[i] + count_of(list)));
  const coordinates = new Float64Array(2 * begin[lists.length]);
  lists.forEach((list, i) => fill(coordinates, 2 * begin[i], list));
  const roles = new Uint8Array(lists.length).map((_, i) => role(i));
  return { coordinates, begin, roles };
}

const is_flat = (list) => typeof list[0] === "number";

function count_of(list) {
  if (!is_flat(list)) return list.length;
  if (list.length % 2) throw malformed();
  return list.length / 2;
}

function fill(coordinates, at, list) {
  if (is_flat(list)) return coordinates.set(list, at);
  for (const point of list) {
    if (typeof point?.[0] !== "number" || typeof point[1] !== "number") throw malformed();
    coordinates[at++] = point[0];
    coordinates[at++] = point[1];
  }
}

function of_polygons(polygons) {
  const role = polygons.flatMap((polygon) => polygon.map((_, i) => (i ? HOLE : OUTER)));
  return rings_of_lists(polygons.flat(), (i) => role[i]);
}

/** The polygons of a geometry, a feature or a collection of GeoJSON, as lists of rings. */
export function polygons_of(geometry) {
  switch (geometry?.type) {
    case "Feature":
      return geometry.geometry ? polygons_of(geometry.geometry) : [];
    case "FeatureCollection":
      return geometry.features.flatMap(polygons_of);
    case "GeometryCollection":
      return geometry.geometries.flatMap(polygons_of);
    case "Polygon":
      return [geometry.coordinates];
    case "MultiPolygon":
      return geometry.coordinates;
    default:
      throw new MedialError(`the geometry is a ${geometry?.type}, not a polygon`, "unsupported");
  }
}

const WORD = /\s*(?:([A-Za-z]+)|([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)|([(),]))/y;

/** Reads POLYGON, MULTIPOLYGON and collections of them. */
class WellKnownText {
  constructor(text) {
    this.text = text.replace(/^\s*SRID=\d+;/, "").trimEnd();
    this.at = 0;
  }

  fail() {
    return new MedialError(`this is no well-known text at place ${this.at}`, "malformed");
  }

  next() {
    WORD.lastIndex = this.at;
    const found = WORD.exec(this.text);
    if (!found) throw this.fail();
    this.at = WORD.lastIndex;
    return found[1] ?? found[2] ?? found[3];
  }

  list(item) {
    let word = this.next();
    if (/^Z?M?$/i.test(word)) word = this.next();
    if (/^empty$/i.test(word)) return [];
    if (word !== "(") throw this.fail();
    const items = [];
    do {
      items.push(item());
      word = this.next();
    } while (word === ",");
    if (word !== ")") throw this.fail();
    return items;
  }

  point() {
    const numbers = [];
    for (;;) {
      const { at } = this;
      const word = this.next();
      if (/^[(),A-Za-z]/.test(word)) {
        this.at = at;
        break;
      }
      numbers.push(Number(word));
    }
    if (numbers.length < 2) throw this.fail();
    return numbers.slice(0, 2);
  }

  polygon() {
    return this.list(() => this.list(() => this.point()));
  }

  geometry() {
    const name = this.next().toUpperCase().replace(/(ZM|Z|M)$/, "");
    if (name === "POLYGON") return [this.polygon()];
    if (name === "MULTIPOLYGON") return this.list(() => this.polygon());
    if (name === "GEOMETRYCOLLECTION") return this.list(() => this.geometry()).flat();
    throw new MedialError(`the geometry is a ${name}, not a polygon`, "unsupported");
  }

  polygons() {
    const polygons = this.geometry();
    if (this.at < this.text.length) throw this.fail();
    return polygons.filter((polygon) => polygon.length);
  }
}

/** A closed curve: pieces end to end. A straight piece closes it where its ends differ. */
export class Contour {
  static roles = ["any", "outer", "hole", "winding"];

  constructor([x, y], role = "any") {
    const index = Contour.roles.indexOf(role);
    if (index < 0) throw new MedialError(`role must be one of ${Contour.roles.join(", ")}`);
    this.numbers = [0, index, x, y];
  }

  lineTo([x, y]) {
    this.numbers.push(1, x, y);
    return this;
  }

  /** A circular arc; `bulge` is the tangent of a quarter of its angle, positive to the left. */
  arcTo([x, y], bulge) {
    this.numbers.push(2, x, y, bulge);
    return this;
  }

  /** A Bézier curve, rational with `weights`, by its control points but the first. */
  bezierTo(control, weights) {
    this.numbers.push(weights ? 4 : 3, control.length);
    control.forEach(([x, y], i) => this.numbers.push(x, y, ...(weights ? [weights[i]] : [])));
    return this;
  }

  /** An elliptical arc around a center, with conjugate half axes, from angle to angle. */
  ellipseTo(center, u, v, begin, end) {
    this.numbers.push(5, ...center, ...u, ...v, begin, end);
    return this;
  }
}

function of_text(text) {
  if (/^\s*[Mm][\s\d.+-]/.test(text)) return { curves: curves_of_path(text) };
  if (/^\s*\{/.test(text)) return of_polygons(polygons_of(JSON.parse(text)));
  return of_polygons(new WellKnownText(text).polygons());
}

const is_array = (x) => Array.isArray(x) || (ArrayBuffer.isView(x) && !(x instanceof DataView));

/** Whether rows of four or five numbers are points with z and m, not flat rings of two, which only bulges hold open. */
const are_points = (rows, bulge_count) =>
  (bulge_count ? bulge_count === rows.length : rows.length > 2) &&
  rows.every((row) => Array.isArray(row) && row.length === rows[0].length && row.length < 6);

/** Rings ({coordinates, begin, roles}) or curves ({curves}) of anything that axis() takes with so many bulges. */
export const read = (x, bulge_count) => checked(() => rings_or_curves(x, bulge_count), x);

function rings_or_curves(x, bulge_count) {
  if (typeof x === "string") return of_text(x);
  if (x instanceof Contour) return { curves: Float64Array.from(x.numbers) };
  if (is_array(x) && x.length) {
    if (x[0] instanceof Contour) return { curves: Float64Array.from(x.flatMap((one) => one.numbers)) };
    const points = typeof x[0] === "number" || typeof x[0]?.[0] === "number";
    const flat_rings = points && is_array(x[0]) && x[0].length > 3 && !are_points(x, bulge_count);
    return rings_of_lists(points && !flat_rings ? [x] : [...x], () => ANY);
  }
  if (x && x.type) return of_polygons(polygons_of(x));
  throw new MedialError("this has no polygon", "unsupported");
}

/** Points and lines: coordinates, where chains begin, whether they are closed. */
export const chains_of = (x) => checked(chains, x);

function chains(x) {
  const lists = [];
  const closed = [];
  const add = (list, ring) => {
    const first = list[0];
    const last = list.at(-1);
    const shut = list.length > 2 && first[0] === last[0] && first[1] === last[1];
    lists.push(shut ? list.slice(0, -1) : list);
    closed.push(shut || ring ? 1 : 0);
  };
  const geometry = (g) => {
    const at = g.coordinates;
    if (g.type === "Feature") geometry(g.geometry);
    else if (g.type === "FeatureCollection") g.features.forEach(geometry);
    else if (g.type === "GeometryCollection") g.geometries.forEach(geometry);
    else if (g.type === "Point") add([at], false);
    else if (g.type === "MultiPoint") at.forEach((point) => add([point], false));
    else if (g.type === "LineString") add(at, false);
    else if (g.type === "MultiLineString") at.forEach((line) => add(line, false));
    else polygons_of(g).flat().forEach((ring) => add(ring, true));
  };
  if (x?.type) geometry(x);
  else if (typeof x?.[0]?.[0] === "number") x.forEach((point) => add([point], false));
  else if (is_array(x)) x.forEach((one) => (one.type ? geometry(one) : add(one, false)));
  else throw new MedialError("this has no points and lines", "unsupported");
  const { coordinates, begin } = rings_of_lists(lists, () => ANY);
  return { coordinates, begin, closed: Uint8Array.from(closed) };
}
