// How long after opening the studio from a folder its first axis is drawn, and is on the screen; pages by turns.
// Prints Markdown.
//
//   node web/bench/opening.mjs TREE [PAGE ...]       TREE/studio/index.html and other pages; 21 times

import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const tree = resolve(process.argv[2]);
const pages = [join(tree, "studio/index.html"), ...process.argv.slice(3)];
const { chromium } = createRequire(join(tree, "npm/node_modules/"))("playwright-core");

const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
const times = pages.map(() => ({ drawn: [], shown: [] }));
for (let k = 0; k < 21; ++k)
  for (const [i, path] of pages.entries()) {
    const page = await browser.newPage({ viewport: { width: 1200, height: 800 } });
    await page.goto(pathToFileURL(path).href);
    await page.waitForFunction(() => globalThis.studio?.opened);
    await page.waitForTimeout(400); // until the browser knows when it has painted
    const [drawn, shown] = await page.evaluate(() =>
      ["first axis", "first-contentful-paint"].map((name) => performance.getEntriesByName(name)[0].startTime),
    );
    times[i].drawn.push(drawn);
    times[i].shown.push(shown);
    await page.close();
  }
await browser.close();

const at = (list, share) => list.toSorted((a, b) => a - b)[Math.floor(share * (list.length - 1))].toFixed(0);
console.log("| page | drawn, ms: median | best | on the screen, ms: median | best |\n|---|--:|--:|--:|--:|");
for (const [i, path] of pages.entries())
  console.log(`| ${[path, ...["drawn", "shown"].flatMap((name) => [at(times[i][name], 0.5), at(times[i][name], 0)])].join(" | ")} |`);
