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

/** The size of the module's memory after `times` axes. */
function memory_after(times, shape, options) {
  for (let i = 1; i < times; ++i) medial.axis(shape, options).free();
  const axis = medial.axis(shape, options);
  const { byteLength } = axis.nodes.view(Uint8Array).buffer;
  axis.free();
  return byteLength;
}

/** What a program prints in a process of its own, with the package as `medial`. */
async function run(program) {
  const text = `(async () => {const medial = await import(${JSON.stringify(here("../index.mjs").href)}); ${program}})()`;
  return (await promisify(execFile)(process.execPath, ["-e", text])).stdout;
}

test("before threads start there is one", () => {
  assert.equal(medial.threads(), 1);
  const shape = new medial.Shape(coast(2000));
  const before = memory_after(10, shape, { threads: 8 });
  assert.equal(memory_after(200, shape, { threads: 8 }), before, "the module's memory grew");
});

test("what is not the module is an error", async () => {
  const again = await import(here("../lib/core.mjs?refused"));
  const module = await readFile(here("../lib/medial.wasm"));
  const cut = [0, 8, 9, 20, 200, 2000].map((size) => module.subarray(0, size));
  for (const source of [...cut, Buffer.from("<!doctype html><title>Not found</title>")])
    await assert.rejects(again.init(source), Error);
  await again.init(module);
});

test("threads start as far as there is memory and workers are allowed", { timeout: 60000 }, async () => {
  const axis = "medial.axis('POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))', { threads: 3 }).branchCount";
  const full = `const { malloc, free } = (await import(${JSON.stringify(here("../lib/core.mjs").href)})).loaded();
    const taken = [];
    for (let size = 2 ** 30; size >= 2 ** 20; size /= 2) for (let at; (at = malloc(size)); ) taken.push(at);
    console.log(await medial.startThreads(3));
    taken.forEach((at) => free(at));
    console.log(${axis}, await medial.startThreads(3), ${axis});`;
  assert.equal(await run(full), "1\n5 3 5\n");
  const forbidden = `const workers = require("node:worker_threads");
    workers.Worker = function () { throw new Error("forbidden"); };
    require("node:module").syncBuiltinESMExports();
    console.log(await medial.startThreads(3), await medial.startThreads(3), medial.threads(), ${axis});`;
  assert.equal(await run(forbidden), "1 1 1 5\n");
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
  const before = memory_after(50, shape, { threads: 8 });
  for (let i = 0; i < 300; ++i) {
    memory_after(1, shape, { threads: 8 });
    assert.throws(() => medial.axis([[0, 0], [2, 2], [2, 0], [0, 2]]), { code: "crossing" });
  }
  assert.equal(memory_after(1, shape, { threads: 8 }), before, "the module's memory grew");
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
  const shape = "'POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))', { threads: 3 }";
  const own = `await medial.startThreads(3);
    console.log(medial.threads(), medial.axis(${shape}).branchCount);`;
  assert.equal(await run(own), "3 5\n");
  const of_worker = `const { inWorker } = await import(${JSON.stringify(here("../worker.mjs").href)});
    const apart = await inWorker({ threads: 3 });
    console.log(await apart.threads(), (await apart.axis(${shape})).branchCount); await apart.terminate();`;
  assert.equal(await run(of_worker), "3 5\n");
});
