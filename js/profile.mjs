// What an axis calls, for tools/wasm.sh, which divides the module by it.
//
//   node js/profile.mjs MODULE PROFILE DATA     MODULE: made by wasm-split --instrument

import { readFile, writeFile } from "node:fs/promises";

import { loaded, memory } from "./lib/core.mjs";
import * as medial from "./lazy.mjs";

const [, , path, out, data] = process.argv;
await medial.init(await readFile(path));

const leaf = "M 3 52 C 12 18 44 0 78 6 C 96 9 112 22 118 44 C 104 38 96 40 90 46 C 98 50 104 58 104 70 C 94 62 84 60 76 64 C 72 84 50 96 24 86 C 34 82 38 76 36 70 C 26 70 10 66 3 52 Z";
const texts = await Promise.all(["plan", "gear", "maze", "bumps"].map((name) => readFile(`${data}/${name}.wkt`, "utf8")));
const drawn = new medial.Contour([0, 0]);
drawn.lineTo([6, 0]);
drawn.arcTo([6, 4], 0.3);
drawn.bezierTo([[4, 5], [2, 3], [0, 4]]);

/** Reads all properties of an object of the package. */
function read(object) {
  for (const name of Object.getOwnPropertyNames(Object.getPrototypeOf(object))) object[name];
}

// As the studio draws it, whose y points up.
const upright = leaf.replace(/(\d+) (\d+)/g, "$1 -$2");
for (const input of [leaf, upright, [drawn], [Float64Array.of(0, 0, 3, 0, 3, 2, 0, 2)], ...texts]) {
  const given = new medial.Shape(input);
  const axis = medial.axis(given, { method: "disks" });
  const { shape } = axis;
  [given, axis, shape].forEach(read);
  const place = axis.placeAt([50, 50]);
  axis.diskAt(place.edge, place.t);
  axis.clearance([[50, 50]]);
  [given, axis, shape].forEach((one) => one.free());
}

const module = loaded();
const size = module.__write_profile(0, 0);
const at = module.malloc(size) >>> 0;
module.__write_profile(at, size);
await writeFile(out, new Uint8Array(memory(), at, size));
