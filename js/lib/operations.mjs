// Results derived from an axis: parts of it, lines, widths, offsets, tool paths, checks.

import { Handle, MedialError, answer_json, call, encoded, options, table } from "./core.mjs";
import { MedialAxis, Shape, axis, axis_of, flat_points, rows, shape_of, split } from "./axis.mjs";
import { chains_of } from "./read.mjs";
import { gcode } from "./gcode.mjs";

// Parts of an axis.

export function prune(x, measure, threshold, given) {
  return axis_of(x).prune(measure, threshold, given);
}

/** The measures of prune() with their default thresholds. */
export function pruneMeasures() {
  call("prune_measures");
  return answer_json();
}

export function rebuild(x, { by, points, chord, cornerAngle } = {}) {
  return Shape.of(call("rebuild", x.address, options({ by, points, chord, cornerAngle })), x.ofShape);
}

/** The shape without the parts that pruning its axis drops. */
export function smooth(x, measure, threshold, given) {
  return rebuild(prune(x, measure, threshold, given));
}

/** The parts narrower than `width` become lines, the rest stays polygons. */
export function collapse(x, width, { trim = 1 } = {}) {
  const of = axis_of(x);
  const shape = Shape.of(call("collapse", of.address, width, trim), of.ofShape);
  const lines = new MedialAxis(table()[0], shape, true);
  return { polygons: shape.points.length ? shape : null, lines };
}

// Lines along an axis.

class Path extends Handle {
  constructor(address) {
    super(address, "path");
  }
}

/** A line along an axis, such as a centre line. */
export class Line {
  constructor(of, path, { extend = false, smooth: radii = 0 } = {}) {
    const address = call("centre_line", of.address, path.address, extend, radii);
    const [length, narrowest, closed] = table();
    Object.assign(this, { axis: new MedialAxis(address, of.ofShape, true), length, narrowest, closed: closed > 0 });
    Object.defineProperty(this, "along", { value: { of, path } });
  }

  /** Points of x, y and radius along the line. */
  coordinates(given) {
    const lines = this.axis.sample(given).map((line) => rows(line, 3));
    return lines.flatMap((line, i) => (i ? line.slice(1) : line));
  }

  /** The width at places evenly along the line, or at the given lengths. */
  widths(samples = 100) {
    const count = Number(samples);
    const at = Array.isArray(samples)
      ? samples
      : Array.from({ length: count }, (_, i) => (count > 1 ? (i * this.length) / (count - 1) : 0));
    if (!Array.isArray(samples) && count > 1) at[count - 1] = this.length;
    const { of, path } = this.along;
    call("widths", of.address, path.address, Float64Array.from(at), at.length);
    return rows(table(), 8).map(([along, x, y, radius, ...feet]) => {
      const [left, right] = [feet.slice(0, 2), feet.slice(2)];
      const span = Math.hypot(left[0] - right[0], left[1] - right[1]);
      return { along, x, y, radius, left, right, width: 2 * radius, span };
    });
  }

  toGeoJSON(chord) {
    return { type: "LineString", coordinates: this.coordinates(chord ? { chord } : {}) };
  }
}

function main_paths(of, { trim, route }, longest) {
  call("main_paths", of.address, options({ trim, route, longest }));
  return Array.from(table(), (address) => new Path(address));
}

/** The main path of each connected part. */
export function centerlines(x, given = {}) {
  const of = axis_of(x);
  return main_paths(of, given).map((path) => new Line(of, path, given));
}

/** The centre line of a shape: of several parts the longest, or from `start` to `end`. */
export function centerline(x, given = {}) {
  const of = axis_of(x);
  const { start, end, route = "roomy" } = given;
  if (!start !== !end) throw new MedialError("start and end go together");
  if (!start) return new Line(of, main_paths(of, given, true)[0], given);
  return new Line(of, new Path(call("path_between", of.address, ...start, ...end, encoded(route))), given);
}

/** The path between two places that lets the largest disk pass. */
export function widestPath(x, start, end, given) {
  const of = axis_of(x);
  return new Line(of, new Path(call("path_between", of.address, ...start, ...end, encoded("widest"))), given);
}

export const centreline = centerline;
export const centrelines = centerlines;

const line_of = (x, given) => (x instanceof Line ? x : centerline(x, given));

/** The width along the centre line. */
export const widthProfile = (x, samples, given) => line_of(x, given).widths(samples);

/** Lines from side to side, evenly along the centre line. */
export function transects(x, count = 10, given = {}) {
  const line = line_of(x, given);
  return line.widths(Array.from({ length: count }, (_, i) => ((i + 0.5) * line.length) / count));
}

/** Mean widths: by length, by area, and area by length. */
export function meanWidth(x, given) {
  const { of, path } = line_of(x, given).along;
  call("mean_width", of.address, path.address);
  return answer_json();
}

/** Necks: places that are narrower than the shape on both sides of them. */
export function necks(x, widening = 1.1) {
  call("necks", axis_of(x).address, widening);
  return rows(table(), 10).map((r) => ({
    x: r[1],
    y: r[2],
    radius: r[3],
    width: 2 * r[3],
    left: r.slice(4, 6),
    right: r.slice(6, 8),
    opensTo: r[8],
    prominence: 2 * (r[8] - r[3]),
    aroundHole: r[9] > 0,
  }));
}

const circle = ([x, y, radius]) => ({ x, y, radius });

export function maximumInscribedCircle(x) {
  call("deepest_disk", axis_of(x).address);
  return circle(table());
}

/** The largest disjoint circles, by decreasing radius. */
export function inscribedCircles(x, count, smallest = 0) {
  call("disjoint_disks", shape_of(x).address, count, smallest);
  return rows(table(), 3).map(circle);
}

// Offsets.

function regions() {
  const [points, bulges, begin, parts] = [0, 1, 2, 3].map(table);
  const all = split(points, begin, 2).map((ring, i) => ({
    points: rows(ring, 2),
    bulges: Array.from(bulges.subarray(begin[i], begin[i + 1])),
  }));
  return rows(parts, 5).map(([first, distance, parent, area, length], i) => {
    const end = 5 * (i + 1) < parts.length ? parts[5 * (i + 1)] : all.length;
    return { distance, rings: all.slice(first, end), parent, area, length };
  });
}

const numbers = (values) => Float64Array.from(typeof values === "number" ? [values] : values);

/** Offset curves with true arcs, at distances that are positive inwards and negative outwards. */
export function offset(x, distances) {
  const values = numbers(distances);
  const walk = x instanceof MedialAxis && values.every((d) => d > 0) && !x.exterior && !x.resolution;
  const of = walk ? x : shape_of(x);
  call(walk ? "inward_offsets" : "offsets", of.address, values, values.length);
  return regions();
}

const chain_arguments = ({ coordinates, begin, closed }) => [coordinates, begin, closed.length, closed, null];

/** The points within given distances of points and lines. */
export function buffer(x, distances, { nodeCrossings = false } = {}) {
  const values = numbers(distances);
  call("buffer", ...chain_arguments(chains_of(x)), nodeCrossings, values, values.length);
  return regions().map((region) => ({ ...region, distance: -region.distance }));
}

// Tool paths.

const PATH_KINDS = ["clearing", "wall", "groove", "ramp", "plunge"];

/** Tool paths that carve a shape with a cone. */
export function carve(x, given = {}) {
  call("carve", axis_of(x).address, options(given));
  const [points, begin, kinds] = [0, 1, 2].map(table);
  const result = answer_json();
  const pairs = rows(kinds, 2);
  const paths = split(points, begin, 4).map((path, i) => ({
    kind: PATH_KINDS[pairs[i][0]],
    pass: pairs[i][1],
    points: rows(path, 4),
  }));
  return { paths, ...result, toGcode: (settings) => gcode(paths, settings) };
}

// Checks, and the features of a shape.

/** Checks an axis against its shape, or another one. */
export function verify(x, { shape, tolerance, samples, cornerAngle, part = x.part } = {}) {
  const against = shape ? shape_of(shape).address : 0;
  call("verify", x.address, against, options({ tolerance, samples, cornerAngle, part }));
  return answer_json();
}

const BRANCH = [
  "branch", "nodeFrom", "nodeTo", "fromKind", "toKind", "closed", "length", "radiusMin", "radiusMax",
  "meanWidth", "turning", "absoluteTurning", "area", "significance",
];
const RUN = [
  "primitive", "variation", "length", "meanRadius", "slope", "bend", "turning", "xFrom", "yFrom",
  "radiusFrom", "xTo", "yTo", "radiusTo",
];

/** The features of a shape: counts and sums, its branches and their runs. */
export function features(x) {
  call("features", axis_of(x).address);
  const tables = [table(0), table(1)];
  const result = answer_json();
  call("feature_names");
  const names = answer_json();
  const named = (keys, row) => Object.fromEntries(keys.map((key, i) => [key, row[i]]));
  result.branches = rows(tables[0], BRANCH.length).map((row) => {
    const branch = named(BRANCH, row);
    const [fromKind, toKind] = [names.points[branch.fromKind], names.points[branch.toKind]];
    return { ...branch, fromKind, toKind, closed: branch.closed > 0 };
  });
  result.runs = rows(tables[1], RUN.length).map((row) => {
    const run = named(RUN, row);
    const [primitive, variation] = [names.primitives[run.primitive], names.variations[run.variation]];
    return { ...run, primitive, variation };
  });
  return result;
}

/** The axes of one shape by several methods: counts, lengths, seconds, and errors. */
export function compare(x, methods = ["disks", "lee", "biarc-dc"], given = {}) {
  const shape = shape_of(x);
  return methods.map((method) => {
    try {
      const own = axis(shape, { ...given, method });
      const { seconds } = own.statistics;
      return { method, axis: own, nodes: own.nodes.length, edges: own.edges.length, length: own.length, seconds };
    } catch (error) {
      if (!(error instanceof MedialError)) throw error;
      return { method, error };
    }
  });
}

/** The areas of two shapes and the Hausdorff distance of their boundaries, measured. */
export function distance(a, b, samples = 7) {
  call("distance", shape_of(a).address, shape_of(b).address, samples);
  return answer_json();
}

/** By how much each branch violates two conditions that hold for every axis; 0 or less: not at all. */
export function legality(x, samples = 8) {
  call("legality", x.address, samples);
  return rows(table(), 2).map(([steepness, bend]) => ({ steepness, bend }));
}

// Other diagrams.

/** The Voronoi diagram of points and lines. */
export function voronoi(x, { margin = 0, nodeCrossings = false, chord } = {}) {
  const chains = chains_of(x);
  const { coordinates: c } = chains;
  let [low, high] = [Infinity, -Infinity];
  for (const value of c) [low, high] = [Math.min(low, value), Math.max(high, value)];
  call("voronoi", ...chain_arguments(chains), nodeCrossings, margin, chord ?? 1e-4 * (high - low || 1));
  const [sites, nodes, edges, lines, line_begin, faces, face_begin, box] = [0, 1, 2, 3, 4, 5, 6, 7].map(table);
  const edge_lines = split(lines, line_begin, 3);
  return {
    sites: rows(sites, 8).map(([kind, x0, y0, x1, y1, chain, vertex, bulge]) => ({
      kind: ["segment", "vertex", "arc"][kind], start: [x0, y0], end: [x1, y1], chain, vertex, bulge,
    })),
    nodes: rows(nodes, 3).map(circle),
    edges: rows(edges, 6).map(([from, to, left, right, spoke, enclosure], i) => ({
      from, to, left, right, spoke: spoke > 0, onEnclosure: enclosure > 0, line: rows(edge_lines[i], 3),
    })),
    cells: split(faces, face_begin, 2).map((ring) => rows(ring, 2)),
    enclosure: Array.from(box),
  };
}

/** The generalised potential of a charged border. */
export class Field extends Handle {
  constructor(address) {
    super(address, "field");
  }

  /** Logarithm of the potential, direction of the force, clearance; NaN outside. */
  sample(points) {
    const flat = flat_points(points);
    call("field_sample", this.address, flat, flat.length / 2);
    return rows(table(), 4).map(([logPotential, dx, dy, clearance]) => ({
      logPotential, direction: [dx, dy], clearance,
    }));
  }

  /** The force line from a point. */
  streamline([x, y], step, most = 1000) {
    call("streamline", this.address, x, y, step, most);
    return rows(table(), 2);
  }
}

/** The integral of 1 / r^order along the border of a shape. */
export function field(x, order = 2) {
  return new Field(call("field", shape_of(x).address, order));
}

/** The axis of closed curves, followed from maxima of curvature and corners. */
export const curveAxis = (x, given = {}) => axis(x, { ...given, method: "curve-axis" });
