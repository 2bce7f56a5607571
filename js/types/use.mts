// Compiled by `tsc --noEmit`: what a program with types writes.

import * as medial from "../index.js";
import { inWorker } from "../worker.js";

const axis: medial.MedialAxis = medial.axis([[0, 0], [4, 0], [4, 2], [0, 2]], { method: "disks", exact: true });
const radii: Float64Array = axis.nodes.radius;
const first: Record<"x" | "y" | "radius" | "component" | "kind", number> = axis.nodes.at(0);
const line: number[][] = medial.centerline(axis, { extend: true }).coordinates();
const regions: medial.Region[] = medial.offset(axis, [0.25, 0.5]);
const gcode: string = medial.carve(axis, { angle: 60, depth: 1 }).toGcode({ feed: 800 });
for (const row of medial.compare(axis, ["disks", "lee"])) if (row.error) throw row.error;
else console.log(row.nodes, row.seconds);
const { passed }: medial.Certificate = medial.verify(axis);
const worker = await inWorker({ threads: 0 });
const counts: number[] = [await medial.startThreads(2), medial.threads(), await worker.threads()];
const { lines } = await worker.axis("POLYGON ((0 0, 1 0, 1 1, 0 0))", { method: "lee" });
const editor = new medial.Editor([[0, 0], [4, 0], [4, 2], [0, 2]], { tolerance: 1e-9 });
const { addedEdges, everything }: medial.Change = editor.move(2, [5, 2]);
const ends: Uint32Array = editor.edges(addedEdges).from;
const remote = await worker.Editor([[0, 0], [4, 0], [4, 2], [0, 2]]);
const moved: medial.Change = await remote.insert(0, [2, -1]);
const control: Float64Array = (await remote.edges(moved.addedEdges)).controlX;
console.log(counts, everything, ends.length, control.length, (await remote.axis).length);
console.log(radii.length, first.radius, line.length, regions[0]?.area, gcode.length, passed, lines.length);
// @ts-expect-error: there is no such method
medial.axis("", { method: "voronoi" });
worker.terminate();
