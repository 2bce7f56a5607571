// The package in Node: values that are known, errors, memory, the worker.

import assert from "node:assert/strict";
import { test } from "node:test";

import * as medial from "../index.mjs";
import { inWorker } from "../worker.mjs";

const close = (a, b, within = 1e-12) => assert.ok(Math.abs(a - b) <= within * Math.max(1, Math.abs(b)), `${a} is not ${b}`);
const box = (width, height) => [[0, 0], [width, 0], [width, height], [0, height]];

test("the axis of a rectangle", () => {
  const axis = medial.axis(box(4, 2));
  assert.deepEqual([axis.nodes.length, axis.edges.length, axis.sites.length], [6, 5, 4]);
  assert.equal(axis.branchCount, 5);
  close(axis.length, 2 + 4 * Math.SQRT2);
  close(axis.edgeLengths.reduce((a, b) => a + b), axis.length);
  assert.equal(axis.method, "disks");
  close(Math.max(...axis.nodes.radius), 1);
  assert.equal(axis.nodes.at(0).radius, axis.nodes.radius[0]);
  assert.equal(medial.NODE_KINDS[axis.nodes.kind[axis.nodes.radius.indexOf(0)]], "leaf");
});

test("every way to give a shape", () => {
  const ring = [...box(6, 2), [0, 0]];
  const ways = [
    box(6, 2),
    [0, 0, 6, 0, 6, 2, 0, 2],
    Float64Array.of(0, 0, 6, 0, 6, 2, 0, 2),
    [box(6, 2)],
    { type: "Polygon", coordinates: [ring] },
    { type: "Feature", properties: {}, geometry: { type: "Polygon", coordinates: [ring] } },
    JSON.stringify({ type: "MultiPolygon", coordinates: [[ring]] }),
    "POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))",
    "M 0 0 h 6 v 2 h -6 z",
    new medial.Contour([0, 0]).lineTo([6, 0]).lineTo([6, 2]).lineTo([0, 2]),
    new medial.Shape(box(6, 2)),
  ];
  for (const way of ways) close(medial.axis(way).length, 4 + 4 * Math.SQRT2);
});

test("holes, arcs and curves", () => {
  const holed = medial.axis([box(10, 10), [[4, 4], [6, 4], [6, 6], [4, 6]]]);
  assert.equal(medial.verify(holed).cycles, 1);
  assert.equal(holed.shape.holeCount, 1);
  close(holed.shape.area, 96);
  const stadium = new medial.Contour([0, 0]).lineTo([4, 0]).arcTo([4, 2], 1).lineTo([0, 2]).arcTo([0, 0], 1);
  close(medial.axis(stadium).length, 4);
  close(medial.axis("M 0 0 h 4 a 1 1 0 0 1 0 2 h -4 a 1 1 0 0 1 0 -2 z").length, 4);
  const blob = medial.axis("M 0 0 C 2 -3 6 -3 8 0 S 2 6 0 0 z");
  assert.ok(medial.verify(blob).passed);
});

test("every exact method gives the same graph", () => {
  const shape = new medial.Shape([[0, 0], [7, 1], [9, 6], [5, 4], [3, 8], [1, 5]]);
  const rows = medial.compare(shape, ["disks", "lee", "biarc-dc", "auto"]);
  for (const row of rows) close(row.length, rows[0].length, 1e-9);
  assert.ok(medial.methods().length >= 8);
  assert.equal(medial.compare("M 0 0 C 4 0 4 3 2 3 C 0 3 2 0 0 0 z", ["curve-axis"])[0].error.code, "unsupported");
});

test("a part of an axis by a potential", () => {
  const part = medial.axis(box(8, 2), { method: "potential", within: [2, 0, 6, 2] });
  assert.ok(part.length > 2 && part.length < 5, `${part.length}`);
  assert.throws(() => medial.axis(box(8, 2), { method: "potential", start: [1] }), /2 numbers/);
});

test("operations", () => {
  const bar = medial.axis([[0, 0], [9, 0], [9, 2], [5, 2], [4.5, 2.1], [4, 2], [0, 2]]);
  assert.deepEqual([bar.branchCount, bar.prune("erosion", 0.5).branchCount], [7, 1]);
  assert.ok("prominence" in medial.pruneMeasures());
  const line = medial.centerline(box(10, 2), { extend: true });
  close(line.length, 8);
  const ends = line.coordinates().map(([x, y]) => [x, y]);
  close(Math.min(...ends.map(([x]) => x)), 0);
  close(Math.max(...ends.map(([x]) => x)), 10);
  for (const { width, span } of medial.widthProfile(box(10, 2), 3)) {
    close(width, 2);
    close(span, 2);
  }
  close(medial.maximumInscribedCircle([[0, 0], [4, 0], [0, 4]]).radius, 4 - 2 * Math.SQRT2);
  assert.equal(medial.inscribedCircles(box(4, 2), 2).length, 2);
  close(medial.offset(box(4, 4), 1)[0].area, 4);
  close(medial.offset(box(4, 4), -1)[0].area, 16 + 16 + Math.PI);
  close(medial.buffer([[0, 0]], 1)[0].area, Math.PI);
  close(medial.rebuild(medial.axis(box(4, 2))).area, 8);
  assert.equal(medial.features(box(4, 2)).ends, 4);
  assert.equal(medial.features(box(4, 2)).branches.length, 5);
  assert.equal(medial.necks([[0, 0], [4, 0], [4, 1], [6, 1], [6, 0], [9, 0], [9, 4], [6, 4], [6, 2], [4, 2], [4, 4], [0, 4]]).length, 1);
  const carving = medial.carve(box(4, 2));
  close(carving.deepest, 1, 1e-4);
  assert.match(carving.toGcode(), /^\(medial carve[^]*M2\n$/);
  close(medial.distance(box(4, 2), box(4, 3)).hausdorff, 1);
  close(medial.field(box(4, 2)).sample([[2, 0.25]])[0].clearance, 0.25);
  const diagram = medial.voronoi([[0, 0], [2, 0], [1, 2]]);
  assert.equal(diagram.cells.length, 3);
  const collapsed = medial.collapse([[0, 0], [4, 0], [4, 1.8], [9, 1.8], [9, 2.2], [4, 2.2], [4, 4], [0, 4]], 1);
  assert.ok(collapsed.polygons.area > 15 && collapsed.lines.length > 4);
});

test("questions to an axis", () => {
  const axis = medial.axis(box(4, 2));
  const [place] = axis.nearest([[2, 1.5]]);
  close(place.x, 2);
  close(place.radius, 1);
  const disk = axis.diskAt(place.edge, place.t);
  assert.equal(disk.feet.length, 2);
  for (const [x, y] of disk.feet) close(Math.hypot(x - disk.x, y - disk.y), disk.radius);
  assert.deepEqual([...axis.clearance([[2, 1], [9, 1]])], [1, -5]);
});

test("errors have a code and a place", () => {
  const crossing = () => medial.axis([[0, 0], [2, 2], [2, 0], [0, 2]]);
  assert.throws(crossing, (error) => {
    assert.ok(error instanceof medial.MedialError);
    assert.equal(error.code, "crossing");
    assert.deepEqual(error.point, [1, 1]);
    assert.equal(error.ring, 0);
    return true;
  });
  const code = (work) => {
    try {
      work();
    } catch (error) {
      return error.code;
    }
    return "none";
  };
  assert.equal(code(() => medial.axis([[0, 0], [NaN, 1], [1, 1]])), "not_finite");
  assert.equal(code(() => medial.axis("LINESTRING (0 0, 1 1)")), "unsupported");
  assert.equal(code(() => medial.axis("POLYGON ((0 0, 1 1")), "malformed");
  assert.equal(code(() => medial.axis([["a", "b"]])), "malformed");
  assert.equal(code(() => medial.axis(box(1, 1), { method: "none" })), "invalid_option");
  assert.equal(code(() => medial.axis(box(1, 1), { seed: 3 })), "invalid_option");
  assert.equal(code(() => medial.prune(box(1, 1), "none")), "invalid_option");
  const ridge = (given) => () => medial.axis(box(2, 1), { method: "ridge", pixels: 32, ...given });
  assert.equal(code(ridge({ search: "list" })), "invalid_option");
  assert.equal(code(ridge({ rule: "differences" })), "invalid_option");
  assert.equal(ridge({ search: "sorted-list" })().length, ridge()().length);
  assert.equal(code(() => medial.axis([])), "unsupported");
  assert.equal(medial.axis([[0, 0], [2, 2], [2, 0], [0, 2]], { repair: "even_odd" }).shape.componentCount, 2);
});

test("exact decisions", () => {
  const plain = medial.axis(box(3, 1));
  const exact = medial.axis(box(3, 1), { exact: true });
  assert.equal(exact.edges.length, plain.edges.length);
});

test("the native format", () => {
  const shape = [box(10, 10), [[4, 4], [6, 4], [6, 6], [4, 6]]];
  const axis = medial.axis(shape);
  const [item] = medial.loads(medial.dumps(axis));
  for (const kind of ["nodes", "edges", "sites"])
    for (const name of Object.keys(axis[kind])) assert.deepEqual(item.axis[kind][name], axis[kind][name]);
  assert.ok(medial.verify(item.axis).passed);
  assert.throws(() => medial.loads("{}"), { code: "malformed" });
  assert.throws(() => medial.loads('{"medial":1,"items":[{"shape":{"points":[]}}]}'), { code: "malformed" });
});

test("a native file keeps what it says", () => {
  const part = medial.axis(box(4, 2)).prune("erosion", 0.5);
  assert.ok(part.part && !medial.axis(box(4, 2)).part && medial.centerline(box(4, 2)).axis.part);
  assert.ok(medial.verify(part).passed);
  const file = JSON.parse(medial.dumps(part));
  assert.equal(file.items[0].part, true);
  file.items[0].attributes = [["name", "Mürren"], ["2", "b"], ["1", "a"]];
  Object.assign(file, { crs: 'GEOGCRS["x"]', unit: "mm", y_down: true });
  const [{ shape, axis }] = medial.loads(JSON.stringify(file));
  assert.equal(shape.attributes.get("name"), "Mürren");
  assert.ok(axis.part);
  const editor = new medial.Editor(shape);
  for (const kept of [
    axis, medial.axis(shape), medial.axis(new medial.Shape(shape)), axis.prune("length", 0), editor.axis, editor.copy().axis,
  ]) {
    const { items, ...rest } = JSON.parse(medial.dumps(kept));
    assert.deepEqual(items[0].attributes, file.items[0].attributes);
    assert.deepEqual(rest, { medial: 2, crs: 'GEOGCRS["x"]', unit: "mm", y_down: true });
  }
});

test("what is no geometry, no file and no option", () => {
  let deep = { type: "Polygon", coordinates: [] };
  for (let i = 0; i < 1e5; ++i) deep = { type: "GeometryCollection", geometries: [deep] };
  for (const x of ["{bad", { type: "FeatureCollection" }, { type: "Polygon" }, deep, [null], [[null]]])
    for (const read of [medial.axis, medial.voronoi]) assert.throws(() => read(x), { name: "MedialError" });
  for (const x of ["{", "null", "{}", '{"medial":1}', '{"medial":1,"items":{}}', '{"medial":1,"items":[null]}'])
    assert.throws(() => medial.loads(x), { code: "malformed" });
  assert.throws(() => medial.loads('{"medial":3,"items":[]}'), { code: "unsupported" });
  for (const given of [
    { exterior: 1 }, { exterior: "yes" }, { exterior: "" }, { tolerance: "" }, { tolerance: "a" }, { repair: "" },
    { method: "disks;exterior=true" }, { "exact=true;method": "disks" }, { method: "disks\0" }, { method: "a\tb\u0001" },
  ])
    assert.throws(() => medial.axis(box(4, 2), given), { code: "invalid_option" }, JSON.stringify(given));
  for (const call of [
    () => medial.centerline(box(4, 2), { extend: "no" }), () => medial.centerline(box(4, 2), { smooth: "1" }),
    () => medial.axis(box(4, 2)).clearancePart("a"), () => medial.axis(box(4, 2)).sample({ chord: {} }),
    () => medial.collapse(box(4, 2), "1"), () => medial.axis(box(4, 2)).diskAt("0", 0.5),
  ])
    assert.throws(call, { code: "invalid_option" });
  assert.throws(() => medial.axis(box(4, 2), { method: "a\tb" }), { text: "there is no method 'a\tb'" });
  assert.equal(medial.axis(box(4, 2), { exterior: false, exact: true }).exterior, 0);
});

test("points with z and m", () => {
  const ring = box(6, 2);
  for (const way of [
    ring.map((p) => [...p, 7]), ring.map((p) => [...p, 7, 8]), [ring.map((p) => [...p, 7, 8])], [ring.flat()],
    "POLYGONZ ((0 0 1, 6 0 1, 6 2 1, 0 2 1))", "MULTIPOLYGONZM(((0 0 1 2,6 0 1 2,6 2 1 2,0 2 1 2)))",
    "PolygonM((0 0 1,6 0 1,6 2 1,0 2 1))",
  ])
    close(medial.axis(way).length, 4 + 4 * Math.SQRT2);
  // Flat rings of two points: a disk beside a square, and three disks.
  const disk = (x, Type = Array) => Type.from([x, 0, x + 2, 0]);
  close(new medial.Shape([disk(0), [4, 0, 6, 0, 6, 2, 4, 2]], { bulges: [1, 1, 0, 0, 0, 0] }).area, Math.PI + 4);
  const bulges = [1, 1, 1, 1, 1, 1];
  for (const Type of [Array, Float64Array]) {
    const three = new medial.Shape([0, 4, 8].map((x) => disk(x, Type)), { bulges });
    close(three.area, 3 * Math.PI);
    assert.equal(three.componentCount, 3);
  }
  // As many bulges as rows: points with z and m.
  close(new medial.Shape([[0, 0, 7, 8], [2, 0, 7, 8]], { bulges: [1, 1] }).area, Math.PI);
  close(new medial.Shape(ring.map((p) => [...p, 7, 8]), { bulges: [0, 1, 0, 1] }).area, 12 + Math.PI);
});

test("a bulge goes with each point", () => {
  const contour = new medial.Contour([0, 0]).lineTo([6, 0]).lineTo([6, 2]);
  for (const x of [box(6, 2), box(6, 2).flat(), [box(6, 2), box(1, 1)], new medial.Shape(box(6, 2)), contour])
    for (const bulges of [[1], [0, 1, 0, 1, 0]])
      assert.throws(() => new medial.Shape(x, { bulges }), { code: "malformed" }, JSON.stringify(x));
  close(new medial.Shape(box(6, 2), { bulges: [] }).area, 12);
});

test("memory", () => {
  const axis = medial.axis(box(4, 2));
  const { shape } = axis;
  const view = axis.nodes.view();
  assert.equal(view.length, 6 * 4);
  assert.equal(view[2], axis.nodes.radius[0]);
  axis.free();
  axis.free();
  assert.throws(() => axis.edgeLengths, { code: "invalid_option" });
  close(shape.area, 8);
  const size = () => axis.constructor && medial.axis(box(4, 2)).nodes.view(Uint8Array).buffer.byteLength;
  const before = size();
  for (let i = 0; i < 20000; ++i) medial.axis(box(4, 2 + i * 1e-6)).free();
  assert.equal(size(), before, "the module's memory grew");
});

test("a worker", async () => {
  const worker = await inWorker();
  try {
    const { nodes, lines, length } = await worker.axis(box(4, 2));
    close(length, 2 + 4 * Math.SQRT2);
    assert.equal(nodes.x.length, 6);
    assert.equal(lines.length, 5);
    await assert.rejects(worker.axis([[0, 0], [2, 2], [2, 0], [0, 2]]), { code: "crossing", point: [1, 1] });
    close((await worker.offset(box(4, 4), 1))[0].area, 4);
  } finally {
    worker.terminate();
  }
});
