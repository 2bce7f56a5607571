// Threads: the same bytes on any number, memory, errors, workers that end.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { promisify } from "node:util";

import * as medial from "../index.mjs";
import { loaded } from "../lib/core.mjs";
import { with_memory } from "../lib/threads.mjs";
import { inWorker } from "../worker.mjs";

const here = (path) => new URL(path, import.meta.url);

/** A ring whose radius wanders. */
function coast(n) {
  let state = 1;
  const random = () => (state = (48271 * state) % 0x7fffffff) / 0x7fffffff - 0.5;
  let height = 0;
  const xy = new Float64Array(2 * n);
  for (let i = 0; i < n; ++i) {
    height = 0.995 * height + 0.02 * random();
    const [angle, radius] = [(2 * Math.PI * i) / n, 1000 * Math.exp(height)];
    xy.set([radius * Math.cos(angle), radius * Math.sin(angle)], 2 * i);
  }
  return xy;
}

/** The doubles bit for bit, and the graph; between records lies what memory held. */
const bytes = (axis) =>
  Buffer.concat([axis.nodes, axis.edges, axis.sites].flatMap((records) =>
    Object.values({ ...records }).filter(ArrayBuffer.isView).map(({ buffer }) => Buffer.from(buffer))));

test("before threads start there is one", () => {
  assert.equal(medial.threads(), 1);
  assert.equal(medial.axis(coast(2000), { threads: 4 }).exterior, 0);
});

test("any number of threads gives the same bytes", async () => {
  assert.equal(await medial.startThreads(4), 4);
  assert.equal(await medial.startThreads(2), 4); // none ends
  assert.equal(medial.threads(), 4);
  const maze = await readFile(`${process.env.MEDIAL_DATA}/maze.wkt`, "utf8");
  const ways = [
    [coast(20000), {}], [maze, {}], [coast(3000), { method: "lee" }], [maze, { method: "biarc-dc" }],
    [coast(3000), { exact: true }], [coast(300), { method: "ridge", pixels: 400 }], [coast(3000), { exterior: true }],
    [coast(40), { method: "potential" }],
  ];
  for (const [input, options] of ways) {
    const shape = new medial.Shape(input);
    const one = medial.axis(shape, { ...options, threads: 1 });
    for (const threads of [2, 3, 4, 0, 1024])
      assert.ok(bytes(medial.axis(shape, { ...options, threads })).equals(bytes(one)), `${options.method} on ${threads}`);
  }
  for (const threads of [-1, 1025, 1.5])
    assert.throws(() => medial.axis(maze, { threads }), { code: "invalid_option" });
});

test("each thread catches its own exceptions", () => {
  for (let time = 0; time < 20; ++time) assert.equal(loaded().medial_tasks_that_catch(1000), 1000);
});

test("what is made of axes is the same", async () => {
  const lone = await inWorker();
  const shape = coast(5000);
  const rest = async (of) => [
    await of.offset(shape, [5, 20]), await of.verify(shape), await of.features(shape),
    await of.voronoi(Array.from({ length: 900 }, (_, i) => [shape[2 * i], shape[2 * i + 1]])),
  ];
  const seen = async (of) => JSON.stringify(await rest(of), (key, value) => (key === "seconds" ? 0 : value));
  const threaded = await inWorker({ threads: 4 });
  try {
    assert.deepEqual([await lone.threads(), await threaded.threads()], [1, 4]);
    assert.equal(await seen(threaded), await seen(lone));
  } finally {
    lone.terminate();
    threaded.terminate();
  }
});

test("memory stays, and errors come, while threads work", () => {
  const shape = new medial.Shape(coast(4000));
  const size = () => {
    const axis = medial.axis(shape, { threads: 4 });
    const { byteLength } = axis.nodes.view(Uint8Array).buffer;
    axis.free();
    return byteLength;
  };
  for (let i = 0; i < 50; ++i) size();
  const before = size();
  for (let i = 0; i < 300; ++i) {
    size();
    assert.throws(() => medial.axis([[0, 0], [2, 2], [2, 0], [0, 2]]), { code: "crossing" });
  }
  assert.equal(size(), before, "the module's memory grew");
});

test("a compiled module has the memory that it asks for", async () => {
  const parts = ["medial.wasm", "medial-rest.wasm"].map((name) => readFile(here(`../lib/${name}`)));
  for (const [shared, expected] of [[false, 1], [true, 2]]) {
    const [first, second] = (await Promise.all(parts)).map((part) => new WebAssembly.Module(with_memory(part, shared)));
    const again = await import(here(`../lib/core.mjs?${expected}`));
    await again.init(first, second);
    assert.equal(await again.startThreads(2), expected);
  }
});

test("a process ends that has threads, and one whose worker has them", { timeout: 60000 }, async () => {
  const run = async (program) => (await promisify(execFile)(process.execPath, ["-e", `(async () => {${program}})()`])).stdout;
  const from = (path) => `await import(${JSON.stringify(here(path).href)})`;
  const shape = "'POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))', { threads: 3 }";
  const own = `const medial = ${from("../index.mjs")}; await medial.startThreads(3);
    console.log(medial.threads(), medial.axis(${shape}).branchCount);`;
  assert.equal(await run(own), "3 5\n");
  const of_worker = `const medial = await (${from("../worker.mjs")}).inWorker({ threads: 3 });
    console.log(await medial.threads(), (await medial.axis(${shape})).branchCount); await medial.terminate();`;
  assert.equal(await run(of_worker), "3 5\n");
});
