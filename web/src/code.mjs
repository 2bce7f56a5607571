// Programs that compute what the studio shows.

import { wkt_of } from "./files.mjs";
import { count_of } from "./model.mjs";

const number = (x) => String(+x.toPrecision(6));

/** The shape as text: short ones in place, long ones in a file. */
function shape_text(studio) {
  return count_of(studio.rings) <= 60 ? wkt_of(studio.rings) : null;
}

const writers = {
  python({ settings, deepest }, wkt) {
    const given = [settings.method !== "disks" && `"${settings.method}"`, settings.exact && "exact=True", settings.exterior && "exterior=True"];
    const rows = ["import medial", ""];
    rows.push(wkt ? `shape = "${wkt}"` : 'shape = open("shape.wkt").read()  # saved by the studio, or your own');
    rows.push(`axis = medial.axis(${["shape", ...given.filter(Boolean)].join(", ")})`);
    if (settings.threshold) rows.push(`axis = axis.prune("${settings.measure}", ${number(settings.threshold)})`);
    if (settings.offset) rows.push(`regions = medial.offset(axis, ${number(settings.offset * deepest)})`);
    if (settings.center) rows.push("line = medial.centerline(axis)");
    if (settings.carve) rows.push(`print(medial.carve(axis, angle=${settings.carve}).to_gcode())`);
    return [...rows, "print(axis)", "axis.plot()"];
  },
  javascript({ settings, deepest }, wkt) {
    const given = [settings.method !== "disks" && `method: "${settings.method}"`, settings.exact && "exact: true", settings.exterior && "exterior: true"].filter(Boolean);
    const rows = ['import * as medial from "medial-axis";', ""];
    rows.push(wkt ? `const shape = "${wkt}";` : 'const shape = await (await fetch("shape.wkt")).text();');
    rows.push(`let axis = medial.axis(shape${given.length ? `, { ${given.join(", ")} }` : ""});`);
    if (settings.threshold) rows.push(`axis = axis.prune("${settings.measure}", ${number(settings.threshold)});`);
    if (settings.offset) rows.push(`const regions = medial.offset(axis, ${number(settings.offset * deepest)});`);
    if (settings.center) rows.push("const line = medial.centerline(axis);");
    if (settings.carve) rows.push(`console.log(medial.carve(axis, { angle: ${settings.carve} }).toGcode());`);
    return [...rows, "console.log(axis.branchCount, axis.length);"];
  },
  cpp(studio) {
    const { settings, rings } = studio;
    const rows = ["#include <iostream>", "#include <medial/medial.h>", "", "int main() {"];
    rows.push("  const std::vector<medial::Ring> rings{");
    for (const ring of count_of(rings) <= 60 ? rings : []) {
      const points = Array.from({ length: ring.xy.length / 2 }, (_, i) => `{${number(ring.xy[2 * i])}, ${number(ring.xy[2 * i + 1])}}`);
      const bulges = [...ring.edges].some(([, e]) => typeof e === "number")
        ? `, medial::RingRole::any, {${points.map((_, i) => number(Number(ring.edges.get(i)) || 0)).join(", ")}}` : "";
      rows.push(`      {{${points.join(", ")}}${bulges}},`);
    }
    if (count_of(rings) > 60) rows.push("      // the rings' points");
    rows.push("  };", "  const auto shape = medial::build_shape(rings);", "  if (!shape) return std::cerr << to_string(shape.error()) << '\\n', 2;");
    const options = settings.exact || settings.exterior || settings.method !== "disks";
    if (options) rows.push("  medial::Options options;");
    if (settings.method !== "disks") rows.push(`  options.method = *medial::method_from("${settings.method}");`);
    if (settings.exact) rows.push("  options.exact = true;");
    if (settings.exterior) rows.push("  options.exterior = true;");
    rows.push(`  auto axis = medial::compute(*shape${options ? ", options" : ""});`, "  if (!axis) return std::cerr << to_string(axis.error()) << '\\n', 2;");
    if (settings.threshold) rows.push(`  axis = medial::prune(*axis, {medial::PruneMeasure::${settings.measure}, ${number(settings.threshold)}});`);
    return [...rows, "  std::cout << axis->edges.size() << \" edges, length \" << total_length(*axis) << '\\n';", "}"];
  },
  shell({ settings, deepest }, wkt) {
    const rows = wkt ? [`echo '${wkt}' > shape.wkt`] : ["# save the shape as shape.wkt, or take your own file"];
    const given = [settings.method !== "disks" && `--method ${settings.method}`, settings.exact && "--exact", settings.exterior && "--exterior"];
    rows.push(["medial axis shape.wkt", ...given.filter(Boolean), "-o axis.json"].join(" "));
    if (settings.threshold) rows.push(`medial prune axis.json --${settings.measure} ${number(settings.threshold)} -o pruned.json`);
    if (settings.offset) rows.push(`medial offset shape.wkt --distance ${number(settings.offset * deepest)} -o offsets.svg`);
    if (settings.center) rows.push("medial centreline shape.wkt -o line.geojson");
    if (settings.carve) rows.push(`medial carve shape.wkt --angle ${settings.carve} -o carve.nc`);
    return [...rows, "medial draw axis.json -o axis.svg"];
  },
};

export const code_for = (language, studio) => writers[language](studio, shape_text(studio)).join("\n");
