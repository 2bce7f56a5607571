// Diagrams of random points beside delaunator (npm), on one thread.
//
//     node bench/points.mjs MEDIAL [COUNT]
//
// Prints seconds of processor time: of the first of five rounds, and the least. delaunator finds the
// triangulation alone, and all of its rounds run in one process. medial finds the whole diagram; each
// round is a new process of its command line, and reading the points is left out.

import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import Delaunator from "delaunator";

const [, , program, given] = process.argv;
const count = Number(given ?? 1e6), rounds = 5;

let state = 1;
function random() {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return state / 2 ** 32;
}
const coordinates = Float64Array.from({ length: 2 * count }, random);

function measured(work) {
  const times = Array.from({ length: rounds }, work);
  return [times[0], Math.min(...times)];
}
function delaunator() {
  const begin = process.cpuUsage();
  new Delaunator(coordinates);
  const { user, system } = process.cpuUsage(begin);
  return (user + system) / 1e6;
}
const folder = mkdtempSync(join(tmpdir(), "points-"));
const file = join(folder, "points.csv");
const rows = Array.from({ length: count }, (_, i) => `${coordinates[2 * i]},${coordinates[2 * i + 1]}`);
writeFileSync(file, `x,y\n${rows.join("\n")}\n`);
function medial() {
  const words = ["voronoi", file, "--threads", "1", "--json", "--stats"];
  const { processor } = JSON.parse(execFileSync(program, words));
  return processor.voronoi;
}
console.log(`${count} points | first | least\n---|--:|--:`);
for (const [name, work] of Object.entries({ delaunator, "medial voronoi": medial })) {
  const [first, least] = measured(work);
  console.log(`${name} | ${first.toFixed(3)} | ${least.toFixed(3)}`);
}
rmSync(folder, { recursive: true });
