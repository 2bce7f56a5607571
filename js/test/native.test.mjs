// The same results as a native build: MEDIAL_PROGRAM is its command line, MEDIAL_DATA the examples. The
// graph is the same, and so is every byte, but for a node in 50,000 that needs functions of libm.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { gunzipSync } from "node:zlib";

import * as medial from "../index.mjs";

const { MEDIAL_PROGRAM: program, MEDIAL_DATA: data } = process.env;
const known = program && existsSync(program) && data;

/** All numbers of an axis: the graph, and the doubles bit for bit. */
const numbers = (axis) =>
  ["nodes", "edges", "sites"].flatMap((kind) => Object.keys(axis[kind]).map((name) => [kind, name, axis[kind][name]]));

function native(text, options) {
  const output = execFileSync(program, ["axis", "-", "-o", "-", "--format", "json", ...options], {
    input: text, maxBuffer: 1 << 30,
  });
  return medial.loads(output.toString())[0].axis;
}

for (const [name, given, options] of [
  ["plan.wkt", {}, []],
  ["plan.wkt", { exact: true }, ["--exact"]],
  ["plan.wkt", { exterior: true }, ["--exterior"]],
  ["gear.wkt", {}, []],
  ["maze.wkt", {}, []],
  ["bumps.wkt", { method: "lee" }, ["--method", "lee"]],
  ["bumps.wkt", { method: "biarc-dc" }, ["--method", "biarc-dc"]],
  ["newfoundland.wkt.gz", {}, []],
])
  test(`as native: ${name} ${options.join(" ")}`, { skip: !known && "there is no native build" }, () => {
    const file = readFileSync(`${data}/${name}`);
    const text = (name.endsWith(".gz") ? gunzipSync(file) : file).toString();
    const other = native(text, options);
    const [theirs, { tolerance }] = [numbers(other), other];
    let others = 0;
    for (const [i, [kind, column, values]] of numbers(medial.axis(text, given)).entries()) {
      const expected = theirs[i][2];
      assert.equal(values.length, expected.length);
      for (let k = 0; k < values.length; ++k) {
        if (values[k] === expected[k]) continue;
        assert.ok(values instanceof Float64Array, `${kind}.${column}`);
        assert.ok(Math.abs(values[k] - expected[k]) <= 2 * tolerance, `${kind}.${column}`);
        ++others;
      }
    }
    assert.ok(others <= (name.startsWith("newfoundland") ? 20 : 0), `${others} numbers differ`);
  });
