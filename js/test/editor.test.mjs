// Axes that follow edits: after each the graph is that of axis(), here and in a native build.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { test } from "node:test";

import * as medial from "../index.mjs";
import { inWorker } from "../worker.mjs";

const { MEDIAL_PROGRAM: program, MEDIAL_DATA: data } = process.env;
const box = [[0, 0], [4, 0], [4, 2], [0, 2]];

/** The graph by the places of what its edges touch, whatever the order of nodes, edges and sites. */
function graph_of({ nodes, edges, sites }) {
  const site = (i) => [sites.kind[i], sites.startX[i], sites.startY[i], sites.endX[i], sites.endY[i]].join(" ");
  const around = Array.from({ length: nodes.length }, () => []);
  const names = Array.from(edges.left, (left, e) => [site(left), site(edges.right[e])].sort().join(" | "));
  names.forEach((name, e) => [edges.from[e], edges.to[e]].forEach((node) => around[node].push(name)));
  return around.map((all) => all.sort().join("; ")).sort();
}

/** Numbers that look random, the same each time. */
function random(seed) {
  let state = seed;
  return () => (state = (48271 * state) % 0x7fffffff) / 0x7fffffff;
}

function star(count, next) {
  return Array.from({ length: count }, (_, i) => {
    const [angle, radius] = [(2 * Math.PI * i) / count, 5 + 5 * next()];
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });
}

/** A random edit; a refusal changes nothing, and is the only error. */
function edit(editor, vertices, next) {
  const at = Math.floor(vertices.length * next());
  const [x, y] = editor.vertex(vertices[at]);
  const to = [x + next() - 0.5, y + next() - 0.5];
  const kind = next();
  try {
    if (kind < 0.7) return editor.move(vertices[at], to);
    if (kind < 0.8) return editor.undo();
    const change = kind < 0.9 ? editor.insert(vertices[at], to) : editor.remove(vertices[at]);
    return change;
  } catch (error) {
    assert.ok(error instanceof medial.MedialError);
    return null;
  }
}

test("after each edit the graph is that of axis()", () => {
  const next = random(7);
  let [repaired, all] = [0, 0];
  for (let k = 0; k < 12; ++k) {
    const editor = new medial.Editor(star(8 + 3 * k, next));
    for (let step = 0; step < 12; ++step) {
      const vertices = Array.from({ length: 80 }, (_, i) => i).filter((i) => editor.vertex(i));
      const change = edit(editor, vertices, next);
      ++all;
      if (change && !change.everything) ++repaired;
      const axis = editor.axis;
      const expected = medial.axis(axis.shape);
      assert.deepEqual(graph_of(axis), graph_of(expected));
      [axis, expected].forEach((one) => one.free());
    }
    editor.free();
  }
  assert.ok(3 * repaired > all, `${repaired} of ${all} were repaired`);
});

test("a change names what to remove and to draw", () => {
  const editor = new medial.Editor(box);
  const axis = editor.axis;
  const drawn = new Map(axis.edges.from.entries()); // a new editor counts as its axis does
  assert.deepEqual([...editor.edges([...drawn.keys()]).from], [...drawn.values()]);
  for (const change of [editor.move(2, [5, 2.5]), editor.insert(0, [2, -1]), editor.remove(1), editor.undo()]) {
    for (const number of change.removedEdges) assert.ok(drawn.delete(number));
    const { from, left, controlX, weight } = editor.edges(change.addedEdges);
    change.addedEdges.forEach((number, i) => drawn.set(number, from[i]));
    assert.ok(controlX.every(Number.isFinite) && weight.every((w) => w > 0));
    assert.equal(editor.nodes(from).x.length, from.length);
    assert.ok(editor.sites(left).startX.every(Number.isFinite));
  }
  assert.equal(drawn.size, editor.axis.edges.length);
  assert.deepEqual(editor.vertex(4), [2, -1]);
  assert.equal(editor.vertex(99), null);
});

test("refusals have a place and change nothing; objects are freed", () => {
  const editor = new medial.Editor([[0, 0], [4, 0], [4, 4], [2, 1], [0, 4]]);
  const before = graph_of(editor.axis);
  assert.throws(() => editor.move(3, [2, -1]), (error) => {
    assert.ok(error instanceof medial.MedialError);
    assert.deepEqual([error.code, error.point[1]], ["crossing", 0]);
    return true;
  });
  assert.deepEqual(graph_of(editor.axis), before);
  assert.throws(() => editor.move(77, [0, 0]), { code: "invalid_option" });
  assert.throws(() => editor.move(-1, [0, 0]), { code: "malformed" });
  assert.throws(() => editor.move(0, [NaN, 0]), { code: "not_finite" });
  assert.throws(() => editor.move(0, [1]), { code: "malformed" });
  assert.throws(() => editor.edges([12345]), { code: "invalid_option" });
  assert.throws(() => new medial.Editor(box, { exact: true }), { code: "invalid_option" });
  const other = editor.copy();
  other.move(3, [2, 2]);
  assert.deepEqual(editor.vertex(3), [2, 1]);
  assert.throws(() => new medial.Editor(box).remove(0) && new medial.Editor(box.slice(1)).remove(0), { code: "too_few_points" });
  editor.free();
  assert.throws(() => editor.move(3, [2, 2]), { code: "invalid_option" });
  assert.deepEqual(other.vertex(3), [2, 2]);
});

test("loops and arcs follow", () => {
  const editor = new medial.Editor([[0, 0], [9, 0], [9, 2], [5, 2], [5, 4], [0, 4]]);
  const same = () => {
    const axis = editor.axis;
    const expected = medial.axis(axis.shape);
    assert.deepEqual(graph_of(axis), graph_of(expected));
    [axis, expected].forEach((one) => one.free());
  };
  const { vertex } = editor.insertLoop([[1, 1], [2, 1], [2, 2], [1, 2], [1, 1]]);
  same();
  editor.moveLoop(vertex + 1, [0.5, 0.25]);
  assert.deepEqual(editor.vertex(vertex), [1.5, 1.25]);
  same();
  editor.setBulge(1, 0.25);
  assert.equal(editor.bulge(1), 0.25);
  same();
  const circle = editor.insertLoop(new Float64Array([3, 0.5, 3.5, 0.5]), [1, 1]);
  same();
  assert.throws(() => editor.moveLoop(vertex, [0, 2]), { code: "crossing" });
  editor.removeLoop(circle.vertex);
  editor.removeLoop(vertex);
  same();
  for (let k = 0; k < 6; ++k) editor.undo();
  assert.equal(editor.bulge(1), 0);
  same();
  assert.throws(() => editor.setBulge(0, "1"), { code: "malformed" });
  assert.throws(() => editor.insertLoop([[0, 0]], [1, 2]), { code: "malformed" });
  assert.throws(() => editor.removeLoop(99), { code: "invalid_option" });
  editor.free();
});

test("in a worker", async () => {
  const worker = await inWorker();
  try {
    const editor = await worker.Editor(box);
    const { addedEdges } = await editor.move(2, [5, 2]);
    assert.equal((await editor.edges(addedEdges)).controlX.length, addedEdges.length);
    assert.equal((await editor.insertLoop([[1, 0.5], [2, 0.5], [1, 1.5]])).vertex, 4);
    await editor.undo();
    const copy = await editor.copy();
    await copy.undo();
    assert.deepEqual([await editor.vertex(2), await copy.vertex(2)], [[5, 2], [4, 2]]);
    assert.equal((await editor.axis).edges.from.length, 5);
    await assert.rejects(editor.move(2, [-1, 1]), { code: "crossing" });
    await editor.free();
    await assert.rejects(editor.undo(), { code: "invalid_option" });
    const unanswered = assert.rejects(copy.move(2, [6, 2]), /terminated/);
    worker.terminate();
    await unanswered;
    await assert.rejects(copy.undo(), /terminated/);
  } finally {
    worker.terminate();
  }
});

test("as native: edits of the maze", { skip: !(program && existsSync(program) && data) && "there is no native build" }, () => {
  const editor = new medial.Editor(readFileSync(`${data}/maze.wkt`).toString());
  const next = random(3);
  const vertices = Array.from({ length: 500 }, (_, i) => i).filter((i) => editor.vertex(i));
  for (let k = 0; k < 300; ++k) {
    const at = vertices[Math.floor(vertices.length * next())];
    const [x, y] = editor.vertex(at);
    editor.move(at, [x + 0.2 * (next() - 0.5), y + 0.2 * (next() - 0.5)]);
  }
  const axis = editor.axis;
  const input = JSON.stringify(axis.shape.toGeoJSON());
  const output = execFileSync(program, ["axis", "-", "-o", "-", "--format", "json"], { input, maxBuffer: 1 << 30 });
  const native = medial.loads(output.toString())[0].axis;
  assert.deepEqual(graph_of(axis), graph_of(native));
});
