// How many frames a second the studio shows while a vertex is dragged, and where the time of a frame goes.
// Prints Markdown.
//
//   node web/bench/frames.mjs TREE [VERTICES ...]       (default: 1e4 1e5 1e6)

import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

import { coast } from "./coast.mjs";

const tree = resolve(process.argv[2]);
const counts = process.argv.slice(3).map(Number);
const { chromium } = createRequire(join(tree, "npm/node_modules/"))("playwright-core");

/** Centres a vertex, with edges this many pixels long; 0: shows all. Returns its place. */
function look(pixels) {
  studio.fit();
  const { xy } = studio.rings[0];
  const at = 2 * Math.floor(0.37 * (xy.length / 2));
  const [x, y] = xy.slice(at, at + 2);
  if (pixels) {
    const { camera } = studio;
    camera.zoom(pixels / Math.hypot(xy[at + 2] - x, xy[at + 3] - y) / camera.scale, ...camera.toScreen(x, y));
    const [px, py] = camera.toScreen(x, y);
    camera.pan(560 - px, 400 - py);
  }
  studio.frame();
  return studio.camera.toScreen(x, y);
}

function begin() {
  const seen = (globalThis.seen = { frames: [], edit: [], draw: [], refused: 0 });
  const tick = (time) => seen.frames.push(time) && globalThis.seen === seen && requestAnimationFrame(tick);
  requestAnimationFrame(tick);
  studio.addEventListener("drawn", () => {
    if (globalThis.seen !== seen) return;
    seen.edit.push(studio.times.axis);
    seen.draw.push(studio.times.frame);
    if (studio.scene.error) ++seen.refused;
  });
}
function end() {
  const { frames, edit, draw, refused } = globalThis.seen;
  globalThis.seen = null;
  const at = (list, share) => list.sort((a, b) => a - b)[Math.floor(share * (list.length - 1))]?.toFixed(1);
  const rate = (1000 * (frames.length - 1)) / (frames.at(-1) - frames[0]);
  return [rate.toFixed(0), draw.length, at(edit, 0.5), at(edit, 0.99), at(draw, 0.5), at(draw, 0.99), refused];
}

const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
const page = await browser.newPage({ viewport: { width: 1200, height: 800 } });
await page.goto(pathToFileURL(join(tree, "studio/index.html")).href);
await page.waitForFunction(() => globalThis.studio?.opened);
console.log("| vertices | edges on the screen | frames a second | moves | edit, ms: median | 99 % | drawing, ms: median | 99 % | refused |\n|--:|---|--:|--:|--:|--:|--:|--:|--:|");
for (const n of counts.length ? counts : [1e4, 1e5, 1e6]) {
  await page.evaluate(`{
    studio.change([{ xy: (${coast})(${n}), edges: new Map() }]);
    studio.frame();
  }`);
  for (const [name, pixels] of [["60 pixels", 60], ["6 pixels", 6], ["all", 0]]) {
    const [x, y] = await page.evaluate(look, pixels);
    await page.waitForTimeout(500);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.evaluate(begin);
    const until = Date.now() + 3000;
    for (let k = 0; Date.now() < until; ++k) await page.mouse.move(x + 3 + 12 * Math.sin(0.2 * k), y + 10 * Math.cos(0.23 * k));
    console.log(`| ${[n, name, ...(await page.evaluate(end))].join(" | ")} |`);
    await page.mouse.up();
  }
}
await browser.close();
