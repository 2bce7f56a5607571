// The native format: a shape and its axis as JSON, without loss (docs/format.md).

import { MedialError, call, encoded } from "./core.mjs";
import { MedialAxis, Shape } from "./axis.mjs";
import { packed } from "./records.mjs";

const malformed = () => new MedialError("this is not the native format of medial", "malformed");
const pairs = (flat) => Array.from({ length: flat.length / 2 }, (_, i) => [flat[2 * i], flat[2 * i + 1]]);

function shape_object(shape) {
  const { bulges } = shape;
  return {
    points: pairs(shape.points),
    ...(bulges.length ? { bulges: Array.from(bulges) } : {}),
    sources: pairs(shape.sources),
    loop_begin: Array.from(shape.loopBegin),
    component: Array.from(shape.component),
    hole: shape.hole,
  };
}

/** An axis with its shape, as the text of a native file. */
export function dumps(axis) {
  const sites = [...axis.sites].map((s) => [
    s.kind, s.startX, s.startY, s.endX, s.endY, s.ring, s.vertex, ...(s.kind === 2 ? [s.bulge] : []),
  ]);
  const nodes = [...axis.nodes].map((n) => [n.x, n.y, n.radius, n.component, n.kind]);
  const edges = [...axis.edges].map((e) => [
    e.from, e.to, e.left, e.right, e.controlX, e.controlY, e.controlRadius, ...(e.weight === 1 ? [] : [e.weight]),
  ]);
  const { method, tolerance, resolution, exterior } = axis;
  const table = {
    method, tolerance, resolution, ...(exterior ? { exterior } : {}), sites, nodes, edges, statistics: {},
  };
  const { attributes, document } = axis.shape;
  const part = axis.part ? { part: true } : {};
  const item = { attributes: [...attributes], shape: shape_object(axis.shape), axis: table, ...part };
  const { crs, unit, yDown } = document;
  return JSON.stringify({ medial: 2, crs, unit, y_down: yDown, items: [item] });
}

function shape_from(o, like) {
  const bulges = o.bulges ? Float64Array.from(o.bulges) : null;
  const address = call(
    "restored_shape", Float64Array.from(o.points.flat()), o.points.length, bulges,
    Uint32Array.from(o.sources.flat()), Uint32Array.from(o.loop_begin), Uint32Array.from(o.component),
    Uint8Array.from(o.hole, Number), o.component.length,
  );
  return Shape.of(address, like);
}

/** The site of a row, which may name a point of the shape instead of coordinates. */
function site_from(row, shape, next) {
  const [kind, point] = row;
  if (row.length > 2) {
    const [, startX, startY, endX, endY, ring, vertex, bulge = 0] = row;
    return { kind, startX, startY, endX, endY, ring, vertex, bulge };
  }
  const [startX, startY] = shape.points[point];
  const [endX, endY] = kind === 1 ? [startX, startY] : shape.points[next[point]];
  const [ring, vertex] = shape.sources[point];
  return { kind, startX, startY, endX, endY, ring, vertex, bulge: kind === 2 ? shape.bulges[point] : 0 };
}

function next_points(shape) {
  const next = shape.points.map((_, i) => i + 1);
  shape.loop_begin.slice(1).forEach((end, i) => (next[end - 1] = shape.loop_begin[i]));
  return next;
}

const middle = (a, b) => a + 0.5 * (b - a);

function edge_from(row, nodes) {
  const [from, to, left, right, ...control] = row;
  const [a, b] = [nodes[from], nodes[to]];
  const [controlX, controlY, controlRadius] = control.length ? control : [0, 1, 2].map((i) => middle(a[i], b[i]));
  return { from, to, left, right, controlX, controlY, controlRadius, weight: control[3] ?? 1 };
}

function item_from({ attributes = [], shape: stored, axis, part = false }, document) {
  if (!stored) throw new MedialError("the item has no shape", "unsupported");
  const shape = shape_from(stored, { attributes, document });
  if (!axis) return { shape };
  const next = next_points(stored);
  const sites = packed("site", axis.sites.map((row) => site_from(row, stored, next)));
  const nodes = packed("node", axis.nodes.map(([x, y, radius, component, kind]) => ({ x, y, radius, component, kind })));
  const edges = packed("edge", axis.edges.map((row) => edge_from(row, axis.nodes)));
  const address = call(
    "restored_axis", shape.address, encoded(axis.method), axis.tolerance, axis.resolution, axis.exterior ?? 0,
    sites, axis.sites.length, nodes, axis.nodes.length, edges, axis.edges.length,
  );
  return { shape, axis: new MedialAxis(address, shape, part) };
}

/** The items of a native file: their shapes, and their axes where it has them. */
export function loads(text) {
  try {
    const { medial, crs, unit, y_down: yDown, items } = JSON.parse(text);
    if (medial > 2) throw new MedialError("the file is of a newer version of the format", "unsupported");
    if (!(medial >= 1)) throw malformed();
    return items.map((item) => item_from(item, { crs, unit, yDown }));
  } catch (error) {
    throw error instanceof MedialError ? error : malformed();
  }
}
