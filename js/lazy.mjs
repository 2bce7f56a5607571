// The same package, whose module is compiled when init() is called.

export { MedialError, begin, complete, init, startThreads, threads } from "./lib/core.mjs";
export { NODE_KINDS, NO_SITE, SITE_KINDS, Records } from "./lib/records.mjs";
export { Contour } from "./lib/read.mjs";
export { MedialAxis, Shape, axis, methods } from "./lib/axis.mjs";
export {
  Field, Line, buffer, carve, centerline, centerlines, centreline, centrelines, collapse, compare,
  curveAxis, distance, features, field, inscribedCircles, legality, maximumInscribedCircle, meanWidth,
  necks, offset, prune, pruneMeasures, rebuild, smooth, transects, verify, voronoi, widestPath,
  widthProfile,
} from "./lib/operations.mjs";
export { Editor } from "./lib/editor.mjs";
export { dumps, loads } from "./lib/native.mjs";
