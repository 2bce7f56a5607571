// The axis of a coast in Node on 1 and 2 threads (or other numbers), in turns. Prints Markdown: medians of wall time in
// milliseconds, and how many times as fast.
//
//   node web/bench/threads.mjs PACKAGE [THREADS]

import { loadavg } from "node:os";
import { join, resolve } from "node:path";

import { coast } from "./coast.mjs";

const [, , folder, count = "2"] = process.argv;
const medial = await import(join(resolve(folder), "index.mjs"));

const median = (times) => times.sort((a, b) => a - b)[times.length >> 1];
const began = loadavg()[0];
const threads = [1, await medial.startThreads?.(+count)].filter(Boolean);
console.log(`| vertices | ${threads.map((one) => `${one} threads`).join(" | ")} | ratio |\n|${"--:|".repeat(threads.length + 2)}`);
for (const n of [1e3, 1e4, 1e5, 1e6]) {
  const shape = new medial.Shape(coast(n));
  const times = threads.map(() => []);
  for (let turn = 0; turn < Math.min(101, Math.max(7, 1e6 / n)); ++turn)
    threads.forEach((one, k) => {
      const begin = performance.now();
      medial.axis(shape, threads.length > 1 ? { threads: one } : {}).free();
      times[k].push(performance.now() - begin);
    });
  const [first, last] = [times[0], times.at(-1)].map(median);
  console.log(`| 1e${Math.log10(n)} | ${times.map((some) => median(some).toFixed(1)).join(" | ")} | ${(first / last).toFixed(2)} |`);
  shape.free();
}
console.log(`\nLoad ${began.toFixed(1)} to ${loadavg()[0].toFixed(1)}, Node ${process.versions.node}.`);
