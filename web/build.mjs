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

/** Shapes of data/ that a page can hold. */
async function examples() {
  const spanner = /<path[^>]*\sd="([^"]+)"/s.exec(await text(join(data, "spanner.svg")))?.[1];
  const read = async (name) => (await text(join(data, name))).trim();
  return [
    { name: "Bow tie", note: "two bumps of one size, after Volkmann and St. Clair", text: await read("bumps.wkt") },
    { name: "Spanner", note: "arcs and cubic curves", text: spanner },
    { name: "Plan", note: "one storey of a building", text: await read("plan.wkt") },
    { name: "Gear", note: "24 involute teeth", text: await read("gear.wkt") },
    { name: "Maze", note: "32 by 24 cells", text: await read("maze.wkt") },
    { name: "Switzerland", note: "Natural Earth, public domain", text: await read("switzerland.geojson") },
  ];
}

/** Text that the page holds and does not run. */
const held = (id, content) => `<script type="text/plain" id="${id}">${content.replaceAll("</script", "<\\/script")}</script>`;

/** Readers of files, which the page holds as text until one is opened. */
const later = ["opentype.js", "dxf-parser"];
const later_only = new RegExp(`^(${later.join("|")})$`);
async function later_script(name) {
  const contents = `import * as all from "${name}"; export default all.default ?? all;`;
  const options = { bundle: true, format: "esm", minify: true, write: false, legalComments: "inline", nodePaths: [npm] };
  const { outputFiles } = await build({ ...options, stdin: { contents, resolveDir: npm } });
  return held(name, outputFiles[0].text);
}

/** The modules of the page that are made here. */
const made = {
  name: "made",
  setup(builder) {
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
};

const bundle = await build({
  entryPoints: [join(web, "src/main.mjs")],
  bundle: true, format: "esm", target: "es2022", minify: true, write: false, legalComments: "inline",
  define: { "import.meta.url": "document.baseURI" }, nodePaths: [npm], plugins: [made], logLevel: "warning",
});
/** A program of the page that runs here. */
async function run_here(path) {
  const { outputFiles } = await build({ entryPoints: [join(web, path)], bundle: true, format: "esm", write: false, nodePaths: [npm], plugins: [made] });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].text).toString("base64")}`);
}
const { poster, poster_style } = await run_here("src/poster.mjs");
const medial = await import(join(tree, "package/index.mjs"));
const style = await build({ entryPoints: [join(web, "style.css")], minify: true, write: false });

/** A part of the module: the first one as it is, so that it is compiled at once, the second one packed. */
async function part(name, packed) {
  const path = join(tree, `package/lib/${name}.wasm`);
  return existsSync(path) ? held(name, packed(await readFile(path)).toString("base64")) : "";
}
// Not as a module: that would wait for the whole page.
const script = `(async()=>{"use strict";${bundle.outputFiles[0].text}})()`.replaceAll("</script", "<\\/script");
const first = await part("medial", (bytes) => bytes);
const later_parts = [
  await part("medial-rest", (bytes) => gzipSync(bytes, { level: 9 })),
  held("examples", JSON.stringify(await examples())),
  ...(await Promise.all(later.map(later_script))),
];
const page = (await text(join(web, "index.html")))
  .replace('<link rel="stylesheet" href="style.css">', () => `<style>${style.outputFiles[0].text}${poster_style(style.outputFiles[0].text)}</style>`)
  // First what is shown; not where the address holds another shape.
  .replace("<!-- poster -->", () => `${poster(medial)}<script>if(location.hash.length>1)poster.remove()</script>\n${first}`)
  .replace('<script type="module" src="src/main.mjs"></script>', () => `<script>${script}</script>`)
  .replace("</body>", () => `${later_parts.join("\n")}\n</body>`);

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
