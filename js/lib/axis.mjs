// Shapes and their medial axes.

import { Handle, MedialError, answer_json, answer_text, call, encoded, memory, number_of, options, table } from "./core.mjs";
import { NO_SITE, Records } from "./records.mjs";
import { read, rings_of_lists } from "./read.mjs";

/** The largest distance of chords from curves, as a share of the diagonal. */
const CHORD = 1e-4;

/** Rows of `width` numbers, each as an array. */
export function rows(numbers, width) {
  return Array.from({ length: numbers.length / width }, (_, i) =>
    Array.from(numbers.subarray(i * width, (i + 1) * width)),
  );
}

/** Divides an array of rows into pieces, given their first rows. */
export function split(numbers, begin, width) {
  return Array.from({ length: begin.length - 1 }, (_, i) =>
    numbers.subarray(begin[i] * width, begin[i + 1] * width),
  );
}

/** Points, as a flat array of coordinates. */
export function flat_points(points) {
  if (ArrayBuffer.isView(points) || typeof points[0] === "number") return Float64Array.from(points);
  return rings_of_lists([points], () => 0).coordinates;
}

const SHAPE_OPTIONS = ["repair", "arcTolerance", "fit"];
const MADE = Symbol("an address in place of a geometry");

/** A bounded region of the plane, of straight and circular edges. */
export class Shape extends Handle {
  #numbers;
  #arrays;
  #attributes;
  #document;

  constructor(x, given = {}) {
    super(given === MADE ? x : load(x, given), "shape");
    if (x instanceof Shape) this.#take(x);
  }

  /** The result of a call as a shape, with the attributes of another one. */
  static of(address, like) {
    const shape = new Shape(address, MADE);
    if (like) shape.#take(like);
    return shape;
  }

  #take({ attributes, document }) {
    this.#attributes = new Map(attributes);
    this.#document = { ...document };
  }

  /** Attributes from a native file: texts by name; crs, unit, yDown. */
  get attributes() {
    return (this.#attributes ??= new Map());
  }
  get document() {
    return (this.#document ??= {});
  }

  #number(i) {
    if (!this.#numbers) {
      call("shape_numbers", this.address);
      this.#numbers = table();
    }
    return this.#numbers[i];
  }

  get bounds() {
    return [0, 1, 2, 3].map((i) => this.#number(i));
  }
  get diagonal() {
    const [x0, y0, x1, y1] = this.bounds;
    return Math.hypot(x1 - x0, y1 - y0);
  }
  get area() {
    return this.#number(4);
  }
  get componentCount() {
    return this.#number(6);
  }
  get holeCount() {
    return this.#number(7);
  }

  #array(i) {
    if (!this.#arrays) {
      call("shape_arrays", this.address);
      this.#arrays = [0, 1, 2, 3, 4, 5].map(table);
    }
    return this.#arrays[i];
  }

  get points() {
    return this.#array(0);
  }
  get bulges() {
    return this.#array(1);
  }
  /** Ring and vertex of the input, for each point. */
  get sources() {
    return Uint32Array.from(this.#array(2));
  }
  get loopBegin() {
    return Uint32Array.from(this.#array(3));
  }
  get component() {
    return Uint32Array.from(this.#array(4));
  }
  get hole() {
    return Array.from(this.#array(5), Boolean);
  }

  /** The distance of points to the boundary, negative outside. */
  clearance(points) {
    const flat = flat_points(points);
    call("clearances", this.address, flat, flat.length / 2);
    return table();
  }

  /** The components as lists of closed rings, the outer one first; arcs are chords. */
  polygons(chord = CHORD * (this.diagonal || 1)) {
    call("outline", this.address, chord);
    const rings = split(table(0), table(1), 2);
    const polygons = Array.from({ length: this.componentCount }, () => []);
    const { component, hole } = this;
    rings.forEach((ring, i) => {
      const polygon = polygons[component[i]];
      if (hole[i]) polygon.push(rows(ring, 2));
      else polygon.unshift(rows(ring, 2));
    });
    return polygons;
  }

  toGeoJSON(chord) {
    const polygons = this.polygons(chord);
    if (polygons.length === 1) return { type: "Polygon", coordinates: polygons[0] };
    return { type: "MultiPolygon", coordinates: polygons };
  }
}

/** The address of a geometry as a shape, by build_shape() or, if options require it, load_shapes(). */
function load(x, given) {
  const given_bulges = given.bulges?.length ? Float64Array.from(given.bulges) : null;
  const bulges = given_bulges ?? (x instanceof Shape && x.bulges.length ? x.bulges : null);
  const { coordinates, begin, roles, curves } = x instanceof Shape ? rings_of(x) : read(x, bulges?.length);
  if (bulges && 2 * bulges.length !== coordinates?.length)
    throw new MedialError("a bulge goes with each point", "malformed");
  const wanted = Object.fromEntries(SHAPE_OPTIONS.map((name) => [name, given[name]]));
  const text = options({ ...wanted, keepContours: given.keepContours });
  const is_plain = text.length === 1; // the end of the text
  const none = new Float64Array(0);
  const count = begin ? begin.length - 1 : 0;
  const rings = [coordinates ?? none, begin ?? new Uint32Array(1), count, roles ?? null, bulges];
  if (!curves && is_plain) return call("shape", ...rings);
  return call("load", ...rings, curves ?? none, curves?.length ?? 0, text);
}

function rings_of(shape) {
  const count = shape.loopBegin.length - 1;
  return { coordinates: shape.points, begin: shape.loopBegin, roles: new Uint8Array(Math.max(count, 0)) };
}

/** The medial axis transform of a shape: a graph of exact curves in (x, y, radius). */
export class MedialAxis extends Handle {
  #numbers;
  #text;
  #tables = {};

  constructor(address, shape, part = false) {
    super(address, "axis");
    this.ofShape = shape;
    /** Whether it is only a part of the axis of its shape: pruned, cut or smoothed. */
    this.part = part;
  }

  #number(i) {
    if (!this.#numbers) {
      call("axis_numbers", this.address);
      this.#numbers = table();
      this.#text = answer_json();
    }
    return this.#numbers[i];
  }
  #records(kind, i) {
    const [address, length] = [this.#number(i), this.#number(i + 1)];
    return (this.#tables[kind] ??= new Records(kind, length, (Type) => {
      void this.address; // an error once it is freed
      return new Type(memory(), address);
    }));
  }

  get nodes() {
    return this.#records("node", 0);
  }
  get edges() {
    return this.#records("edge", 2);
  }
  get sites() {
    return this.#records("site", 4);
  }
  get tolerance() {
    return this.#number(6);
  }
  /** The step of a sampled axis; 0 for an exact one. */
  get resolution() {
    return this.#number(7);
  }
  get exterior() {
    return this.#number(8);
  }
  get method() {
    return this.statistics.method;
  }
  get statistics() {
    this.#number(0);
    return this.#text;
  }
  /** The shape of the axis. */
  get shape() {
    return (this.ofShape ??= Shape.of(call("shape_of", this.address)));
  }
  get length() {
    return number_of("total_length", this.address);
  }
  get branchCount() {
    return number_of("branch_count", this.address);
  }
  get edgeLengths() {
    call("edge_lengths", this.address);
    return table();
  }

  /** Each branch as rows of x, y, radius in one flat array; chords at most `chord` away. */
  sample({ chord = CHORD * (this.shape.diagonal || 1), step = 0 } = {}) {
    call("lines", this.address, chord, step);
    return split(table(0), table(1), 3);
  }

  /** The place of the axis nearest to each point. */
  nearest(points) {
    const flat = flat_points(points);
    call("nearest", this.address, flat, flat.length / 2);
    return rows(table(), 6).map(([x, y, radius, distance, t, edge]) => ({ x, y, radius, distance, t, edge }));
  }
  radiusAt(points) {
    return Float64Array.from(this.nearest(points), (place) => place.radius);
  }
  clearance(points) {
    return this.shape.clearance(points);
  }

  /** The disk at a parameter in [0, 1] of an edge, and its feet on the boundary. */
  diskAt(edge, t) {
    call("disk_at", this.address, edge, t);
    const [x, y, radius, ...feet] = table();
    return { x, y, radius, feet: rows(Float64Array.from(feet), 2) };
  }

  /** The place of the maximal disk that touches the boundary nearest to a point. */
  placeAt([x, y]) {
    call("place_at", this.address, x, y);
    const [edge, t, ...disk] = table();
    return edge === undefined ? null : { edge, t, x: disk[0], y: disk[1], radius: disk[2] };
  }

  prune(measure, threshold, { keep, tips } = {}) {
    const address = call("prune", this.address, options({ measure, threshold, keep, tips }));
    return new MedialAxis(address, this.ofShape, true);
  }

  /** The part where a disk of radius `clearance` has room, cut exactly. */
  clearancePart(clearance) {
    return new MedialAxis(call("clearance_part", this.address, clearance), this.ofShape, true);
  }

  /** The significance of each edge: the largest threshold of prune() that keeps some of it. */
  significance(measure = "prominence") {
    call("significance", this.address, encoded(measure));
    return table();
  }

  /** A MultiLineString of all branches. */
  toGeoJSON(chord) {
    const lines = this.sample(chord ? { chord } : {});
    return { type: "MultiLineString", coordinates: lines.map((line) => rows(line, 3)) };
  }
}

/** The medial axis of a shape. */
export function axis(x, given = {}) {
  const { bulges, repair, arcTolerance, fit, ...others } = given;
  const keepContours = given.method === "curve-axis" || undefined;
  const plain = x instanceof Shape && !repair && !fit;
  const shape = plain ? x : new Shape(x, { bulges, repair, arcTolerance, fit, keepContours });
  if (keepContours && fit) others.fit = fit; // the contours are those before the fit
  return new MedialAxis(call("axis", shape.address, options(others)), shape);
}

export const axis_of = (x) => (x instanceof MedialAxis ? x : axis(x));
export const shape_of = (x) => (x instanceof MedialAxis ? x.shape : x instanceof Shape ? x : new Shape(x));

/** The methods of axis(): what each supports. */
export function methods() {
  call("methods");
  return answer_text().trim().split("\n").map((line) => JSON.parse(line));
}

export { NO_SITE };
