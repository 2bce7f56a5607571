// The module's two parts: the first one computes axes, what needs the second one waits for it.

import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { test } from "node:test";

import * as medial from "../lazy.mjs";

const second = new URL("../lib/medial-rest.wasm", import.meta.url);
const skip = !existsSync(second) && "the module is in one part";

test("axes need only the first part", { skip }, async (t) => {
  // On a page's own thread browsers refuse these for large modules: Chrome once above 4 KB, now above 8 MB.
  for (const name of ["Module", "Instance"])
    t.mock.method(WebAssembly, name, new Proxy(WebAssembly[name], { construct: () => assert.fail(name) }));
  let read_second;
  await medial.begin(undefined, new Promise((use) => (read_second = () => use(second))));
  const axis = medial.axis([[0, 0], [4, 0], [4, 2], [0, 2]]);
  assert.equal(axis.edges.length, 5);
  assert.throws(() => medial.verify(axis), { name: "MedialError", code: "incomplete" });
  assert.throws(() => new medial.Editor(axis.shape), { name: "MedialError", code: "incomplete" });
  assert.equal(medial.axis(axis.shape).edges.length, 5); // the error changed nothing
  read_second();
  await medial.complete();
  assert.ok(medial.verify(axis).passed);
  assert.equal(medial.offset(axis, 0.5)[0].area, 3);
});

test("the module asks for nothing but what js/lib gives it, and what is never called", async () => {
  const first = new WebAssembly.Module(await readFile(new URL("../lib/medial.wasm", import.meta.url)));
  const names = WebAssembly.Module.imports(first).filter((one) => one.module !== "placeholder").map((one) => one.name);
  const never = ["emscripten_notify_memory_growth", "fd_write", "proc_exit"];
  assert.deepEqual(names.sort(), ["can_wait", "clock_time_get", "memory", "start_thread", ...never].sort());
});
