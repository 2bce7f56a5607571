// Types of the package `medial-axis`.

export type Position = [number, number] | number[];
export type Points = Position[] | Float64Array | number[];

/** An object of GeoJSON that has polygons. */
export interface GeoJSONLike {
  type: string;
  coordinates?: unknown;
  geometry?: unknown;
  geometries?: unknown;
  features?: unknown;
}

/**
 * A ring of points; rings of points (holes by the even-odd rule); GeoJSON, as an object or as text;
 * well-known text; the path data of SVG; contours; a shape.
 */
export type Geometry = Points | Points[] | GeoJSONLike | string | Contour | Contour[] | Shape;

export type Method =
  | "disks" | "biarc-dc" | "lee" | "auto" | "ridge" | "brushfire" | "potential" | "curve-axis";
export type PruneMeasure =
  | "prominence" | "significance" | "length" | "ratio" | "radius" | "angle" | "erosion" | "potential"
  | "residual" | "area" | "lambda" | "scale-axis";
export type Repair = "make_valid" | "even_odd" | "non_zero";

export interface ShapeOptions {
  /** The bulge of the edge after each vertex: the tangent of a quarter of its angle; 0: straight. */
  bulges?: ArrayLike<number>;
  /** The fill rule where rings cross; without it, crossing rings are an error. */
  repair?: Repair;
  /** The largest distance of arcs from free-form curves, as a share of the diagonal. */
  arcTolerance?: number;
  /** Replaces boundaries by smooth curves within this distance; 0 keeps them. */
  fit?: number;
}

export interface AxisOptions extends ShapeOptions {
  method?: Method;
  /** A disk touches a site if it is closer than this share of the diagonal; 0: chosen by rounding. */
  tolerance?: number;
  /** A convex joint with an arc is a corner if it turns by more than this, in degrees. */
  cornerAngle?: number;
  /** Keeps apart nodes closer than the tolerance; `disks` then computes the axis for `lee` and `biarc-dc`, too. */
  exact?: boolean;
  /** Computes the axis of the exterior: around the shape and in its holes. */
  exterior?: boolean;
  margin?: number;
  /** The largest number of threads to use; 0: all, for 4,000 points and more. */
  threads?: number;
  /** For `ridge` and `brushfire`: the side of a pixel, or the number along the longer side. */
  resolution?: number;
  pixels?: number;
  collinear?: number;
  search?: "tree" | "sorted-list";
  rule?: "crossing" | "difference";
  family?: "sequential" | "sides" | "marking" | "simultaneous";
  /** For `biarc-dc`. */
  seed?: number;
  /** For `potential`. */
  order?: number;
  /** Compute only the branch that the force line from `start` reaches; or only the part in a box. */
  start?: [number, number];
  within?: [number, number, number, number];
  baseOrder?: number;
  coarse?: number;
  angle?: number;
  movement?: number;
  /** For `potential` and `curve-axis`. */
  step?: number;
  firstMaximum?: number;
}

/** Thrown for an input or an option that cannot be computed. */
export class MedialError extends Error {
  constructor(text: string, code?: string, place?: object);
  /** A stable name, such as "crossing" or "invalid_option". */
  readonly code: string;
  readonly text: string;
  readonly feature?: number;
  readonly ring?: number;
  readonly vertex?: number;
  readonly point?: [number, number];
}

/** Owns memory of the module. The garbage collector frees it; free() does so at once. */
export class Handle {
  free(): void;
}

/** A table whose columns are typed arrays. */
export class Records<Column extends string = string> implements Iterable<Record<Column, number>> {
  readonly length: number;
  /** Record i as an object. */
  at(i: number): Record<Column, number>;
  /** The records in the module's memory, valid until it grows or is freed. */
  view(Type?: Float64ArrayConstructor | Uint32ArrayConstructor | Uint8ArrayConstructor): Float64Array | Uint32Array | Uint8Array;
  [Symbol.iterator](): Iterator<Record<Column, number>>;
}
export interface Nodes extends Records<"x" | "y" | "radius" | "component" | "kind"> {
  readonly x: Float64Array;
  readonly y: Float64Array;
  readonly radius: Float64Array;
  readonly component: Uint32Array;
  /** Index of NODE_KINDS. */
  readonly kind: Uint8Array;
}
/** Rational quadratic Bézier curves in (x, y, radius) with the weights 1, `weight`, 1. */
export interface Edges
  extends Records<"from" | "to" | "left" | "right" | "controlX" | "controlY" | "controlRadius" | "weight"> {
  readonly from: Uint32Array;
  readonly to: Uint32Array;
  /** The sites on both sides, or NO_SITE. */
  readonly left: Uint32Array;
  readonly right: Uint32Array;
  readonly controlX: Float64Array;
  readonly controlY: Float64Array;
  readonly controlRadius: Float64Array;
  readonly weight: Float64Array;
}
export interface Sites
  extends Records<"startX" | "startY" | "endX" | "endY" | "ring" | "vertex" | "kind" | "bulge"> {
  readonly startX: Float64Array;
  readonly startY: Float64Array;
  readonly endX: Float64Array;
  readonly endY: Float64Array;
  readonly ring: Uint32Array;
  readonly vertex: Uint32Array;
  /** Index of SITE_KINDS. */
  readonly kind: Uint8Array;
  readonly bulge: Float64Array;
}
export const NODE_KINDS: readonly ["leaf", "site_change", "branching"];
export const SITE_KINDS: readonly ["segment", "vertex", "arc"];
export const NO_SITE: number;

/** A closed curve of pieces end to end. If its ends differ, a straight piece closes it. */
export class Contour {
  constructor(start: Position, role?: "any" | "outer" | "hole" | "winding");
  lineTo(end: Position): this;
  /** `bulge` is the tangent of a quarter of the arc's angle, positive to the left. */
  arcTo(end: Position, bulge: number): this;
  /** Takes the control points except the first; rational with `weights`. */
  bezierTo(control: Position[], weights?: number[]): this;
  ellipseTo(center: Position, u: Position, v: Position, begin: number, end: number): this;
}

/** A bounded region of the plane, of straight and circular edges. */
export class Shape extends Handle {
  constructor(x: Geometry, options?: ShapeOptions);
  /** x and y of the vertices of all loops, loop by loop. */
  readonly points: Float64Array;
  readonly bulges: Float64Array;
  readonly sources: Uint32Array;
  readonly loopBegin: Uint32Array;
  readonly component: Uint32Array;
  readonly hole: boolean[];
  readonly bounds: [number, number, number, number];
  readonly diagonal: number;
  readonly area: number;
  readonly componentCount: number;
  readonly holeCount: number;
  /** The attributes in a native file, by name; loads() fills them, dumps() writes them. */
  readonly attributes: Map<string, string>;
  /** The reference system as WKT, the unit of lengths, and whether y points down. */
  readonly document: { crs?: string; unit?: string; yDown?: boolean };
  /** The distance of points to the boundary, negative outside. */
  clearance(points: Points): Float64Array;
  polygons(chord?: number): Position[][][];
  toGeoJSON(chord?: number): GeoJSONLike;
}

export interface Place { edge: number; t: number; x: number; y: number; radius: number }

/** The medial axis transform of a shape: a graph of exact curves in (x, y, radius). */
export class MedialAxis extends Handle {
  readonly nodes: Nodes;
  readonly edges: Edges;
  readonly sites: Sites;
  readonly shape: Shape;
  /** Whether it is only a part of the axis of its shape: pruned, cut or smoothed. */
  readonly part: boolean;
  readonly method: string;
  readonly tolerance: number;
  readonly resolution: number;
  readonly exterior: number;
  readonly statistics: { method: string; seconds: number; [count: string]: number | string };
  readonly length: number;
  readonly branchCount: number;
  readonly edgeLengths: Float64Array;
  /** Each branch as rows of x, y, radius. */
  sample(options?: { chord?: number; step?: number }): Float64Array[];
  nearest(points: Points): (Place & { distance: number })[];
  radiusAt(points: Points): Float64Array;
  clearance(points: Points): Float64Array;
  diskAt(edge: number, t: number): { x: number; y: number; radius: number; feet: Position[] };
  placeAt(point: Position): Place | null;
  prune(measure?: PruneMeasure, threshold?: number, options?: PruneOptions): MedialAxis;
  clearancePart(clearance: number): MedialAxis;
  significance(measure?: PruneMeasure): Float64Array;
  toGeoJSON(chord?: number): GeoJSONLike;
}

export interface PruneOptions { keep?: number; tips?: boolean }
export interface LineOptions {
  start?: Position;
  end?: Position;
  trim?: number;
  route?: "roomy" | "shortest";
  extend?: boolean;
  smooth?: number;
}
export interface Width {
  along: number; x: number; y: number; radius: number; left: Position; right: Position; width: number; span: number;
}
/** A line along an axis, such as a centre line. */
export class Line {
  readonly axis: MedialAxis;
  readonly length: number;
  readonly narrowest: number;
  readonly closed: boolean;
  coordinates(options?: { chord?: number; step?: number }): number[][];
  widths(samples?: number | number[]): Width[];
  toGeoJSON(chord?: number): GeoJSONLike;
}
export interface Circle { x: number; y: number; radius: number }
export interface Neck {
  x: number; y: number; radius: number; width: number; left: Position; right: Position;
  opensTo: number; prominence: number; aroundHole: boolean;
}
export interface Region {
  distance: number;
  rings: { points: Position[]; bulges: number[] }[];
  parent: number;
  area: number;
  length: number;
}
export interface CarveOptions {
  angle?: number; depth?: number; tool?: number; tip?: number; passDepth?: number; step?: number;
  chord?: number; ramp?: number;
}
export interface GcodeOptions { safe?: number; feed?: number; plunge?: number; spindle?: number; yDown?: boolean }
export interface Carving {
  paths: { kind: "clearing" | "wall" | "groove" | "ramp" | "plunge"; pass: number; points: number[][] }[];
  deepest: number; flatFrom?: number; tipRadius: number; slope: number; step: number;
  cutLength: number; travelLength: number;
  toGcode(options?: GcodeOptions): string;
}
export interface Certificate {
  passed: boolean; failures: string[]; tolerance: number; largestResidual: number; largestIntrusion: number;
  largestContactGap: number; largestUncovered: number; shapeArea: number; disksArea: number;
  disksChecked: number; components: number; graphParts: number; holes: number; cycles: number;
  convexCorners: number; cornersWithoutLeaf: number; reflexVertices: number; reflexWithoutContact: number;
  worst: Position; resolution: number; worstLegality: number;
}
export interface Features {
  ends: number; branchings: number; closedBranches: number; components: number; cycles: number;
  length: number; area: number; boundary: number; largestRadius: number; meanWidth: number;
  branches: { branch: number; fromKind: string; toKind: string; closed: boolean; [number: string]: number | string | boolean | undefined }[];
  runs: { primitive: string; variation: string; length: number; [number: string]: number | string }[];
}
export interface Voronoi {
  sites: { kind: string; start: Position; end: Position; chain: number; vertex: number; bulge: number }[];
  nodes: Circle[];
  edges: { from: number; to: number; left: number; right: number; spoke: boolean; onEnclosure: boolean; line: number[][] }[];
  cells: Position[][];
  enclosure: number[];
}
export interface MethodInfo {
  name: Method; summary: string; exact: boolean; exterior: boolean;
}

export function axis(x: Geometry, options?: AxisOptions): MedialAxis;
export function methods(): MethodInfo[];
export function prune(x: MedialAxis | Geometry, measure?: PruneMeasure, threshold?: number, options?: PruneOptions): MedialAxis;
export function pruneMeasures(): Record<PruneMeasure, number>;
export function rebuild(x: MedialAxis, options?: { by?: "outline" | "tangents" | "hulls"; points?: number; chord?: number; cornerAngle?: number }): Shape;
export function smooth(x: MedialAxis | Geometry, measure?: PruneMeasure, threshold?: number, options?: PruneOptions): Shape;
export function collapse(x: MedialAxis | Geometry, width: number, options?: { trim?: number }): { polygons: Shape | null; lines: MedialAxis };
export function centerline(x: MedialAxis | Geometry, options?: LineOptions): Line;
export function centerlines(x: MedialAxis | Geometry, options?: LineOptions): Line[];
export const centreline: typeof centerline;
export const centrelines: typeof centerlines;
export function widestPath(x: MedialAxis | Geometry, start: Position, end: Position, options?: LineOptions): Line;
export function widthProfile(x: MedialAxis | Geometry | Line, samples?: number | number[], options?: LineOptions): Width[];
export function transects(x: MedialAxis | Geometry | Line, count?: number, options?: LineOptions): Width[];
export function meanWidth(x: MedialAxis | Geometry | Line, options?: LineOptions): Record<"length" | "area" | "byLength" | "byArea" | "areaByLength", number>;
export function necks(x: MedialAxis | Geometry, widening?: number): Neck[];
export function maximumInscribedCircle(x: MedialAxis | Geometry): Circle;
export function inscribedCircles(x: MedialAxis | Geometry, count: number, smallest?: number): Circle[];
export function offset(x: MedialAxis | Geometry, distances: number | ArrayLike<number>): Region[];
export function buffer(x: GeoJSONLike | Position[] | Position[][], distances: number | ArrayLike<number>, options?: { nodeCrossings?: boolean }): Region[];
export function carve(x: MedialAxis | Geometry, options?: CarveOptions): Carving;
export function verify(x: MedialAxis, options?: { shape?: Geometry; tolerance?: number; samples?: number; cornerAngle?: number; part?: boolean }): Certificate;
export function features(x: MedialAxis | Geometry): Features;
export function compare(x: MedialAxis | Geometry, methods?: Method[], options?: AxisOptions): ({ method: Method } & ({ axis: MedialAxis; nodes: number; edges: number; length: number; seconds: number; error?: undefined } | { error: MedialError }))[];
export function distance(a: MedialAxis | Geometry, b: MedialAxis | Geometry, samples?: number): { area: number; otherArea: number; fromFirst: number; fromSecond: number; hausdorff: number; worst: Position };
export function legality(x: MedialAxis, samples?: number): { steepness: number; bend: number }[];
export function voronoi(x: GeoJSONLike | Position[] | Position[][], options?: { margin?: number; nodeCrossings?: boolean; chord?: number }): Voronoi;
export class Field extends Handle {
  sample(points: Points): { logPotential: number; direction: Position; clearance: number }[];
  streamline(point: Position, step: number, most?: number): Position[];
}
export function field(x: MedialAxis | Geometry, order?: number): Field;
export function curveAxis(x: Geometry, options?: AxisOptions): MedialAxis;
/** The effect of an edit. Apply removals first: new nodes and edges may reuse their numbers. */
export interface Change {
  removedNodes: Uint32Array;
  removedEdges: Uint32Array;
  addedNodes: Uint32Array;
  addedEdges: Uint32Array;
  /** The vertex moved, inserted or removed. */
  vertex: number;
  /** Everything was recomputed, and all earlier nodes and edges are removed. */
  everything: boolean;
}
/**
 * A shape and its axis, which follows when vertices, edges and loops change. Vertices keep
 * their numbers; so do sites, nodes and edges, unless `Change.everything` is set. A new editor
 * numbers vertices, nodes and edges as its shape and its axis do. An edit that makes edges cross throws a
 * MedialError with the place, and changes nothing.
 */
export class Editor extends Handle {
  constructor(x: Geometry, options?: { tolerance?: number });
  move(vertex: number, to: Position): Change;
  /** Inserts a vertex on the edge that begins at the vertex `before`. */
  insert(before: number, point: Position): Change;
  remove(vertex: number): Change;
  /** Sets the bulge of the edge that begins at a vertex: the tangent of a quarter of its angle, 0: straight. */
  setBulge(vertex: number, bulge: number): Change;
  /** Inserts a hole or an outer loop, depending on its place. Its vertices are numbered from `Change.vertex` on. */
  insertLoop(points: Position[] | ArrayLike<number>, bulges?: ArrayLike<number>): Change;
  /** Removes the loop of a vertex. */
  removeLoop(vertex: number): Change;
  moveLoop(vertex: number, by: Position): Change;
  /** Undoes the last edit that is not undone yet; without one, changes nothing. */
  undo(): Change;
  /** An independent editor in the same state. */
  copy(): Editor;
  vertex(number: number): [number, number] | null;
  /** The bulge of the edge that begins at a vertex. */
  bulge(vertex: number): number | null;
  nodes(numbers: ArrayLike<number>): Nodes;
  edges(numbers: ArrayLike<number>): Edges;
  sites(numbers: ArrayLike<number>): Sites;
  /** The current axis with its shape; nodes and edges are numbered from 0 without gaps. */
  readonly axis: MedialAxis;
}

/**
 * Lets the module compute on `count` threads, the caller's among them, at most 64; 0: as many as the machine has.
 * Returns how many there are: 1 where workers cannot start, or cannot share memory, as in pages that are not isolated
 * from other sites.
 */
export function startThreads(count?: number): Promise<number>;
/** How many threads the module has: 1 until startThreads(). */
export function threads(): number;

/** An axis with its shape as the text of a native file; and the items of such a text. */
export function dumps(axis: MedialAxis): string;
export function loads(text: string): { shape: Shape; axis?: MedialAxis }[];
