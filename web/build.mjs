// Builds the studio: one page with its style, its program, the examples and the module in it, so that it
// runs from a server as from a folder, and loads nothing afterwards.
//
//   node web/build.mjs TREE      reads TREE/package and TREE/npm, writes TREE/studio/index.html

import { existsSync } from "node:fs";
import { copyFile, mkdir, readFile, readdir, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { gzipSync } from "node:zlib";

const tree = resolve(process.argv[2]);
const web = import.meta.dirname;
const data = join(web, "../data");
const out = join(tree, "studio");
const npm = join(tree, "npm/node_modules");
const { build } = createRequire(join(npm, "/"))("esbuild");

const text = (path) => readFile(path, "utf8");

/** Shapes of data/ that a page can hold, and one drawn for it. */
async function examples() {
  const drawn = {
    name: "Leaf", note: "curves, drawn by hand",
    text: "M 3 52 C 12 18 44 0 78 6 C 96 9 112 22 118 44 C 104 38 96 40 90 46 C 98 50 104 58 104 70 C 94 62 84 60 76 64 C 72 84 50 96 24 86 C 34 82 38 76 36 70 C 26 70 10 66 3 52 Z",
  };
  const spanner = /<path[^>]*\sd="([^"]+)"/s.exec(await text(join(data, "spanner.svg")))?.[1];
  const read = async (name) => (await text(join(data, name))).trim();
  return [
    drawn,
    { name: "Bow tie", note: "two bumps of one size, after Volkmann and St. Clair", text: await read("bumps.wkt") },
    { name: "Spanner", note: "arcs and cubic curves", text: spanner },
    { name: "Plan", note: "one storey of a building", text: await read("plan.wkt") },
    { name: "Gear", note: "24 involute teeth", text: await read("gear.wkt") },
    { name: "Maze", note: "32 by 24 cells", text: await read("maze.wkt") },
    { name: "Switzerland", note: "Natural Earth, public domain", text: await read("switzerland.geojson") },
  ];
}

/** Readers of files, which the page holds as text until one is opened. */
const later = ["opentype.js", "dxf-parser"];
const later_only = new RegExp(`^(${later.join("|")})$`);
async function later_script(name) {
  const contents = `import * as all from "${name}"; export default all.default ?? all;`;
  const options = { bundle: true, format: "esm", minify: true, write: false, legalComments: "inline", nodePaths: [npm] };
  const { outputFiles } = await build({ ...options, stdin: { contents, resolveDir: npm } });
  return `<script type="text/plain" id="${name}">${outputFiles[0].text.replaceAll("</script", "<\\/script")}</script>`;
}

/** The modules of the page that are made here. */
const made = (list) => ({
  name: "made",
  setup(builder) {
    builder.onResolve({ filter: /examples\.mjs$/ }, () => ({ path: "examples", namespace: "made" }));
    builder.onLoad({ filter: /.*/, namespace: "made" }, () => ({
      contents: `export const examples = ${JSON.stringify(list)};`,
    }));
    builder.onResolve({ filter: later_only }, ({ path }) => ({ path, namespace: "later" }));
    builder.onLoad({ filter: /.*/, namespace: "later" }, ({ path }) => ({
      contents: `const code = new Blob([document.getElementById("${path}").textContent], { type: "text/javascript" });
        const all = await import(URL.createObjectURL(code));
        export default all.default;`,
    }));
    builder.onResolve({ filter: /^medial-axis\// }, ({ path }) => ({
      path: join(tree, "package", path.slice("medial-axis/".length)),
    }));
    builder.onResolve({ filter: /^node:/ }, ({ path }) => ({ path, external: true }));
  },
});

const bundle = await build({
  entryPoints: [join(web, "src/main.mjs")],
  bundle: true, format: "esm", target: "es2022", minify: true, write: false, legalComments: "inline",
  define: { "import.meta.url": "document.baseURI" }, nodePaths: [npm], plugins: [made(await examples())], logLevel: "warning",
});
const [style, start] = await Promise.all(
  ["style.css", "src/start.js"].map((name) => build({ entryPoints: [join(web, name)], minify: true, write: false })),
);

/** A part of the module, packed, as text that the page does not run; the second part, if there is one, comes last. */
async function packed(part) {
  const path = join(tree, `package/lib/${part}.wasm`);
  if (!existsSync(path)) return "";
  return `<script type="text/plain" id="${part}">${gzipSync(await readFile(path), { level: 9 }).toString("base64")}</script>`;
}
// Not as a module: that would wait for the page to be painted.
const script = `(async()=>{"use strict";${bundle.outputFiles[0].text}})()`.replaceAll("</script", "<\\/script");
const parts = await Promise.all(["medial", "medial-rest"].map(packed));
const readers = await Promise.all(later.map(later_script));
const page = (await text(join(web, "index.html")))
  .replace('<link rel="stylesheet" href="style.css">', () => `<style>${style.outputFiles[0].text}</style>`)
  .replace("</head>", () => `${parts[0]}\n<script>${start.outputFiles[0].text}</script>\n</head>`)
  .replace('<script type="module" src="src/main.mjs"></script>', () => `<script>${script}</script>\n${parts[1]}\n${readers.join("\n")}`);

/** The licences of what is in the page besides the project's own. */
async function licences() {
  const parts = [];
  for (const name of ["opentype.js", "dxf-parser", "loglevel"]) {
    const file = (await readdir(join(npm, name))).find((one) => /^licen[cs]e/i.test(one));
    const { license, version } = JSON.parse(await text(join(npm, name, "package.json")));
    parts.push(`${name} ${version} (${license})\n\n${file ? await text(join(npm, name, file)) : ""}`);
  }
  return parts.join("\n----\n\n");
}

await mkdir(out, { recursive: true });
await writeFile(join(out, "index.html"), page);
await writeFile(join(out, "LICENSES.txt"), await licences());
await copyFile(join(web, "../LICENSE"), join(out, "LICENSE.txt"));
console.log(`the studio: ${join(out, "index.html")}, ${(page.length / 1e6).toFixed(2)} MB, of which the program ${(script.length / 1e6).toFixed(2)} MB`);
