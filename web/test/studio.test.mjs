// The studio in Chromium, from a folder: every tool, what is shown, files, links, memory.

import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";

const npm = createRequire(join(process.env.MEDIAL_NPM, "node_modules", "/"));
const { chromium } = npm("playwright-core");
const address = pathToFileURL(join(process.env.MEDIAL_STUDIO, "index.html")).href;
const BOX = "POLYGON ((0 0, 40 0, 40 20, 0 20, 0 0))";

let browser;
let page;
const faults = [];

async function open(options = {}, hash = "") {
  const opened = await browser.newPage({ viewport: { width: 1200, height: 800 }, ...options });
  opened.setDefaultTimeout(15000);
  opened.on("pageerror", (error) => faults.push(error.stack));
  opened.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  await opened.goto(address + hash);
  await opened.waitForFunction(() => globalThis.studio?.opened);
  return opened;
}

before(async () => {
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
  page = await open();
});
after(async () => {
  await browser?.close();
  assert.deepEqual(faults, []);
});

/** Lets the studio draw what was asked for. */
const settled = () => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
const rings = () => page.evaluate(() => studio.rings.map(({ xy, edges }) => ({ xy: [...xy], bent: edges.size })));
const screen = (x, y) => page.evaluate(([px, py]) => studio.camera.toScreen(px, py), [x, y]);
const edges = () => page.evaluate(() => studio.axis?.edges.length);

async function paste(text) {
  await page.click("[data-menu=file-menu]");
  await page.click("[data-do=paste]");
  await page.fill("#paste-text", text);
  await page.click("#paste .primary");
  await settled();
}
async function drag(from, to, steps = 4) {
  await page.mouse.move(...from);
  await page.mouse.down();
  await page.mouse.move(...to, { steps });
  await page.mouse.up();
  await settled();
}

test("a vertex is dragged, and the axis follows; undo and redo", async () => {
  await paste(BOX);
  assert.equal(await edges(), 5);
  const length = await page.evaluate(() => studio.axis.length);
  await drag(await screen(40, 20), await screen(60, 30));
  const [{ xy }] = await rings();
  assert.ok(Math.abs(xy[4] - 60) < 1 && Math.abs(xy[5] - 30) < 1, String(xy));
  assert.ok((await page.evaluate(() => studio.axis.length)) > length);
  await page.keyboard.press("Control+z");
  await settled();
  assert.deepEqual((await rings())[0].xy, [0, 0, 40, 0, 40, 20, 0, 20]);
  assert.equal(await page.evaluate(() => studio.axis.length), length);
  await page.keyboard.press("Control+Shift+z");
  await settled();
  assert.ok((await rings())[0].xy[4] > 59);
});

test("an edge is dragged, and bent into an arc", async () => {
  await paste(BOX);
  await drag(await screen(12, 20), await screen(12, 30));
  const [{ xy }] = await rings();
  assert.ok(Math.abs(xy[5] - 30) < 1 && Math.abs(xy[7] - 30) < 1, String(xy));
  await paste(BOX);
  await page.mouse.move(...(await screen(12, 20)));
  await settled();
  await drag(await screen(20, 20), await screen(20, 30));
  const arc = await page.evaluate(() => studio.rings[0].edges.get(2));
  assert.ok(Math.abs(arc - 0.5) < 0.06, String(arc));
});

test("the axis of a drawing with arcs follows; undo", async () => {
  await paste(BOX);
  await page.click("[data-tool=circle]");
  await drag(await screen(12, 10), await screen(17, 10));
  const state = () => page.evaluate(() => {
    const { axis, live, rings } = studio;
    const bulges = rings.flatMap(({ xy, edges }) => Array.from({ length: xy.length / 2 }, (_, i) => edges.get(i) ?? 0));
    const expected = studio.medial.axis(rings.map(({ xy }) => xy), { bulges });
    const same = axis.edges.length === expected.edges.length && Math.abs(axis.length - expected.length) < 1e-9;
    expected.free();
    return [Boolean(live), same, studio.certificate().passed];
  });
  const same = [true, true, true];
  assert.deepEqual(await state(), same);
  const live = await page.evaluateHandle(() => studio.live);
  await drag(await screen(12, 10), await screen(25, 9)); // the hole
  await page.mouse.move(...(await screen(10, 20)));
  await settled();
  await drag(await screen(20, 20), await screen(20, 26)); // the middle of the upper edge: it bends
  assert.deepEqual(await state(), same);
  assert.ok((await page.evaluate(() => studio.rings[0].edges.get(2))) > 0.2);
  await drag(await screen(40, 20), await screen(44, 24)); // a vertex of the arc
  assert.deepEqual(await state(), same);
  assert.ok(await live.evaluate((before) => before === studio.live), "nothing was computed from nothing");
  await page.evaluate(() => (studio.scene.hot = null));
  const picture = () => page.evaluate(() => studio.canvas.toDataURL());
  await page.mouse.move(5, 400);
  await settled();
  const in_parts = await picture();
  await page.evaluate(() => studio.ask("theme"));
  await settled();
  assert.equal(in_parts === (await picture()), true, "drawn in parts as drawn as a whole");
  for (let k = 0; k < 3; ++k) await page.keyboard.press("Control+z");
  await settled();
  assert.deepEqual((await rings()).map(({ bent }) => bent), [0, 4]);
  assert.deepEqual(await state(), same);
  for (const hole of ["10 5, 20 5, 20 15, 10 15, 10 5", "10 5, 10 15, 20 15, 20 5, 10 5"]) {
    await paste(`POLYGON ((0 0, 40 0, 40 20, 0 20, 0 0), (${hole}))`);
    await page.mouse.move(...(await screen(12, 15)));
    await settled();
    await drag(await screen(15, 15), await screen(15, 18));
    assert.deepEqual((await rings()).map(({ bent }) => bent), [0, 1]);
    assert.deepEqual(await state(), same);
  }
});

test("vertices are inserted and removed by double clicks, and by keys", async () => {
  await paste(BOX);
  await page.mouse.dblclick(...(await screen(10, 20)));
  await settled();
  assert.equal((await rings())[0].xy.length, 10);
  await page.mouse.dblclick(...(await screen(10, 20)));
  await settled();
  assert.equal((await rings())[0].xy.length, 8);
  await page.focus("#plane");
  await page.keyboard.press("Escape");
  await page.keyboard.press("Tab");
  await page.keyboard.press("Shift+ArrowRight");
  await settled();
  assert.ok((await rings())[0].xy[0] > 0);
  assert.match(await page.textContent("#live"), /ring 1, vertex 1/);
  await page.keyboard.press("i");
  await settled();
  assert.equal((await rings())[0].xy.length, 10);
  await page.keyboard.press("Delete");
  await settled();
  assert.equal((await rings())[0].xy.length, 8);
});

test("a shape is drawn, bent, moved and taken away by keys alone", async () => {
  await page.click("[data-menu=file-menu]");
  await page.click("[data-do=new]");
  await page.focus("#plane");
  const press = async (...keys) => {
    for (const key of keys) await page.keyboard.press(key);
    await settled();
  };
  const first_edge = () => page.evaluate(() => studio.rings[0].edges.get(0));
  await press("r", "Enter");
  assert.equal((await rings())[0].xy.length, 8);
  assert.equal(await edges(), 4);
  await press("]", "]");
  assert.equal(await first_edge(), 0.2);
  const arc = await page.evaluate(() => studio.axis.length);
  await press("q");
  assert.equal((await first_edge()).length, 4);
  const curve = await page.evaluate(() => studio.axis.length);
  assert.ok(Math.abs(curve / arc - 1) < 0.01, `${arc}, ${curve}`);
  await press("q");
  assert.equal(await first_edge(), undefined);
  const [{ xy: before }] = await rings();
  await press("Control+ArrowRight");
  const [{ xy }] = await rings();
  for (let k = 0; k < 8; ++k) assert.ok(k % 2 ? xy[k] === before[k] : xy[k] > before[k]);
  await press("c", "Enter");
  assert.equal((await rings()).length, 2);
  await press("Shift+Delete");
  assert.equal((await rings()).length, 1);
});

test("a double click on an edge's dot makes it a curve", async () => {
  await paste(BOX);
  await page.mouse.move(...(await screen(20, 0)));
  await settled();
  await page.mouse.dblclick(...(await screen(20, 0)));
  await settled();
  assert.equal((await page.evaluate(() => studio.rings[0].edges.get(0))).length, 4);
  await page.keyboard.press("Control+z");
  await settled();
  assert.equal((await rings())[0].bent, 0);
});

test("a hole is drawn, and dragged", async () => {
  await paste(BOX);
  await page.click("[data-tool=rectangle]");
  await drag(await screen(10, 6), await screen(16, 14));
  assert.equal((await rings()).length, 2);
  assert.equal(await page.evaluate(() => studio.shape.holeCount), 1);
  await drag(await screen(13, 10), await screen(23, 10));
  const [, hole] = await rings();
  assert.ok(Math.abs(Math.min(...hole.xy.filter((_, k) => k % 2 === 0)) - 20) < 1, String(hole.xy));
});

test("the first axis needs only the first part of the module", async () => {
  const found = await page.evaluate(() => performance.getEntriesByName("first axis").map(({ detail, startTime }) => {
    return [detail, startTime < performance.getEntriesByType("navigation")[0].domInteractive];
  }));
  assert.deepEqual(found, [[null, true]]); // no error, and the rest of the page was not read yet
});

test("the first axis is on the screen before any program runs, where the studio draws it", async () => {
  for (const viewport of [{ width: 1200, height: 800 }, { width: 390, height: 780 }]) {
    const still = await browser.newPage({ viewport, javaScriptEnabled: false });
    await still.goto(address);
    const shown = await still.locator("#poster .area").boundingBox();
    assert.ok((await still.locator("#poster [class^=s]").count()) > 30);
    await still.close();
    const opened = await open({ viewport });
    assert.equal(await opened.locator("#poster").count(), 0);
    const [left, top, right, bottom] = await opened.evaluate(() => {
      const points = studio.rings[0].xy;
      const [xs, ys] = [0, 1].map((d) => [...points].filter((_, k) => k % 2 === d));
      const low = studio.camera.toScreen(Math.min(...xs), Math.min(...ys));
      const high = studio.camera.toScreen(Math.max(...xs), Math.max(...ys));
      return [low[0], high[1], high[0], low[1]];
    });
    for (const [drawn, painted] of [[left, shown.x], [right, shown.x + shown.width]]) assert.ok(Math.abs(drawn - painted) < 2, `${drawn}, ${painted}`);
    assert.ok(top > shown.y - 2 && bottom < shown.y + shown.height + 2, `${[top, bottom]}, ${Object.values(shown)}`);
    await opened.close();
  }
  const linked = await browser.newPage();
  await linked.goto(`${address}#none`);
  assert.equal(await linked.locator("#poster").count(), 0);
  await linked.close();
});

test("a hole of many vertices is dragged, and the axis follows", async () => {
  const round = Array.from({ length: 100 }, (_, k) => [10 + 3 * Math.cos(k * Math.PI / 50), 10 + 3 * Math.sin(k * Math.PI / 50)]);
  const text = [...round, round[0]].map((at) => at.join(" ")).join(", ");
  await paste(`POLYGON ((0 0, 40 0, 40 20, 20 18, 0 20, 0 0), (${text}))`);
  const [before] = (await rings()).slice(1);
  await drag(await screen(10, 10), await screen(28, 9));
  const [moved] = (await rings()).slice(1);
  assert.ok(Math.abs(moved.xy[0] - 31) < 1, String(moved.xy[0]));
  const state = () => page.evaluate(() => {
    const expected = studio.medial.axis(studio.rings.map(({ xy }) => xy));
    const counts = [Boolean(studio.live), studio.axis.edges.length === expected.edges.length, studio.axis.verify?.().passed ?? studio.certificate().passed];
    expected.free();
    return counts;
  });
  assert.deepEqual(await state(), [true, true, true]);
  await drag(await screen(28, 9), await screen(28, -5), 2); // refused
  assert.deepEqual(await state(), [true, true, true]);
  await page.keyboard.press("Control+z");
  await settled();
  if ((await rings())[1].xy[0] !== before.xy[0]) await page.keyboard.press("Control+z"); // the part of the second drag that was done
  await settled();
  assert.deepEqual((await rings())[1].xy, before.xy);
  assert.deepEqual(await state(), [true, true, true]);
});

test("circle, polygon and freehand", async () => {
  await page.keyboard.press("n");
  await settled();
  assert.equal((await rings()).length, 0);
  await page.click("[data-tool=circle]");
  await drag([500, 400], [600, 400]);
  assert.deepEqual((await rings()).map(({ bent }) => bent), [4]);
  assert.equal(await page.evaluate(() => studio.axis.nodes.length), 1);
  await page.keyboard.press("n");
  await page.keyboard.press("p");
  for (const at of [[300, 300], [600, 320], [560, 560], [330, 500]]) await page.mouse.click(...at);
  await page.mouse.click(300, 300);
  await settled();
  assert.equal((await rings())[0].xy.length, 8);
  await page.keyboard.press("n");
  await page.keyboard.press("f");
  await page.mouse.move(700, 400);
  await page.mouse.down();
  for (let k = 0; k <= 40; ++k) {
    const a = (k / 40) * 2 * Math.PI;
    await page.mouse.move(500 + (200 + 20 * Math.cos(3 * a)) * Math.cos(a), 400 + 150 * Math.sin(a));
  }
  await page.mouse.up();
  await settled();
  const [curve] = await rings();
  assert.ok(curve.bent >= 4, String(curve.bent));
  assert.ok((await edges()) > 0);
});

/** Whether the axis is that of the drawing, computed again. */
const is_up_to_date = () =>
  page.evaluate(() => {
    const again = studio.medial.axis(studio.rings.map(({ xy }) => xy));
    const names = ({ edges, sites }) => Array.from(edges.left, (left, e) => [left, edges.right[e]].map((i) => `${sites.kind[i]} ${sites.startX[i]} ${sites.startY[i]}`).sort().join()).sort().join("; ");
    const is_same = names(again) === names(studio.axis);
    again.free();
    return is_same;
  });

test("edges that cross are shown, and the edit is undone", async () => {
  await paste(BOX);
  await drag(await screen(40, 20), await screen(-20, 8));
  assert.equal(await page.evaluate(() => studio.scene.error.code), "crossing");
  assert.match(await page.textContent("#counts"), /cross/);
  const [{ xy }] = await rings();
  assert.ok(xy[4] > 0, String(xy)); // the last place at which no edges crossed
  assert.ok(await is_up_to_date());
  await page.keyboard.press("Control+z");
  await settled();
  assert.equal(await page.evaluate(() => studio.scene.error), null);
});

test("a vertex in the middle of a straight line can be dragged, and the axis follows", async () => {
  await paste("POLYGON ((0 0, 20 0, 40 0, 40 20, 0 20, 0 0))");
  await drag(await screen(20, 0), await screen(20, 4));
  const [{ xy }] = await rings();
  assert.equal(xy.length, 10);
  assert.ok(Math.abs(xy[3] - 4) < 0.5, String(xy));
  assert.ok(await is_up_to_date());
});

/** A star of many vertices, so that an edit changes a small part of the axis. */
const many = (count) =>
  page.evaluate((n) => {
    const xy = new Float64Array(2 * n);
    let state = 7;
    for (let i = 0; i < n; ++i) {
      state = (48271 * state) % 0x7fffffff;
      const [angle, radius] = [(2 * Math.PI * i) / n, 100 + 10 * (state / 0x7fffffff)];
      xy.set([radius * Math.cos(angle), radius * Math.sin(angle)], 2 * i);
    }
    studio.change([{ xy, edges: new Map() }]);
    studio.fit();
    studio.frame();
  }, count);

test("an edit draws what has changed, and nothing else", async () => {
  await many(2000);
  const before = await rings();
  const place = await page.evaluate(() => studio.camera.toScreen(...studio.rings[0].xy.slice(600, 602)));
  await page.evaluate(([x, y]) => {
    studio.camera.zoom(40, x, y);
    studio.frame();
  }, place);
  const counts = () => page.evaluate(() => ({ ...studio.painter.counts }));
  const [first, wide] = [await counts(), await page.evaluate(() => studio.canvas.width * studio.canvas.height)];
  await page.mouse.move(...place);
  await page.mouse.down();
  for (let k = 1; k <= 10; ++k) await page.mouse.move(place[0] + k, place[1] - k);
  await page.mouse.up();
  await settled();
  const last = await counts();
  assert.equal(last.wholes, first.wholes);
  assert.ok(last.parts > first.parts && last.pixels - first.pixels < 10 * 0.5 * wide, JSON.stringify([first, last]));
  assert.notDeepEqual(await rings(), before);
  assert.ok(await is_up_to_date());
  // A pan, too, draws what comes into view only.
  await page.evaluate(() => {
    studio.camera.pan(-37, 25);
    studio.frame();
  });
  assert.equal((await counts()).wholes, first.wholes);
  const different = await page.evaluate(() => {
    studio.scene.hot = studio.scene.disks = null;
    const pixels = () => studio.context.getImageData(0, 0, studio.canvas.width, studio.canvas.height).data.slice();
    studio.frame();
    const parts = pixels();
    studio.ask("theme");
    studio.frame();
    const whole = pixels();
    return whole.filter((value, k) => Math.abs(value - parts[k]) > 40).length / whole.length;
  });
  assert.ok(different < 1e-4, `${different} of all pixels differ`);
  await page.keyboard.press("Control+z");
  await settled();
  assert.deepEqual(await rings(), before);
  assert.ok(await is_up_to_date());
  await page.keyboard.press("Control+Shift+z");
  await settled();
  assert.notDeepEqual(await rings(), before);
  await page.keyboard.press("0");
});

test("a drag is one step, however the axis followed it; a refused edit leaves what is shown", async () => {
  await many(200);
  const before = await rings();
  const after = await page.evaluate(() => {
    const [x, y] = studio.rings[0].xy;
    const move = (dx) => studio.edit([{ kind: "move", ring: 0, index: 0, point: [x + dx, y] }]);
    const followed = move(0.1);
    const ring = { xy: studio.rings[0].xy.slice(), edges: new Map() };
    ring.xy[0] = x + 0.2;
    studio.change([ring], false); // as where the edits of a drag were refused
    studio.frame();
    const followed_again = move(0.3);
    studio.done();
    studio.frame();
    return [followed, followed_again, studio.rings[0].xy[0] - x];
  });
  assert.deepEqual(after.slice(0, 2), [true, true]);
  assert.ok(Math.abs(after[2] - 0.3) < 1e-9);
  await page.evaluate(() => studio.undo());
  await settled();
  assert.deepEqual(await rings(), before);
  assert.ok(await is_up_to_date());
  const shown = await page.evaluate(() => {
    studio.set("offset", 0.3);
    studio.edit([{ kind: "move", ring: 0, index: 0, point: [-500, 3] }]);
    studio.frame();
    const [code, count] = [studio.scene.error?.code, studio.scene.regions?.length];
    studio.set("offset", 0);
    studio.frame();
    return [code, count > 0];
  });
  assert.deepEqual(shown, ["crossing", true]);
});

test("a thousand repairs keep the memory flat", async () => {
  await many(500);
  const [before, after, repaired] = await page.evaluate(() => {
    const memory = () => studio.axis.nodes.view(Uint8Array).buffer.byteLength;
    const [x, y] = studio.rings[0].xy;
    const edit = (k) => studio.edit([{ kind: "move", ring: 0, index: 0, point: [x + 0.01 * (k % 9), y] }]) && studio.frame();
    for (let k = 0; k < 50; ++k) edit(k);
    const [first, { live }] = [memory(), studio];
    for (let k = 0; k < 1000; ++k) edit(k);
    return [first, memory(), live === studio.live && !studio.scene.error];
  });
  assert.equal(before, after);
  assert.ok(repaired);
});

test("the disk under the pointer touches the boundary", async () => {
  await paste(BOX);
  await page.mouse.move(...(await screen(20, 14)));
  await settled();
  const [disk] = await page.evaluate(() => studio.scene.disks);
  assert.ok(Math.abs(disk.radius - 10) < 1e-9);
  assert.equal(disk.feet.length, 2);
});

test("settings: pruning, offsets, cells, field, centre line, disks, carving, certificate", async () => {
  await paste("POLYGON ((0 0, 40 0, 40 20, 22 20, 20 21, 18 20, 0 20, 0 0))");
  const branches = () => page.evaluate(() => studio.branches);
  const before = await branches();
  await page.locator("#threshold").fill("700");
  await settled();
  assert.ok((await branches()) < before);
  await page.locator("#threshold").fill("0");
  await page.locator("#offset").fill("250");
  await settled();
  assert.ok((await page.evaluate(() => studio.scene.regions.length)) >= 3);
  for (const id of ["cells", "field", "center", "disks"]) await page.check(`#show-${id}`);
  await page.locator("#carve").fill("60");
  await settled();
  const shown = await page.evaluate(() => {
    const { cells, field, others, disks, carving } = studio.scene;
    return [cells.length, field.image.width, others.length, disks.length, carving.paths.length];
  });
  for (const count of shown) assert.ok(count > 0, String(shown));
  await page.click("#check");
  assert.equal(await page.textContent("#certificate-state"), "Passed");
  for (const id of ["cells", "field", "center", "disks"]) await page.uncheck(`#show-${id}`);
  await page.locator("#carve").fill("0");
  await page.locator("#offset").fill("0");
});

test("every measure of pruning has a slider", async () => {
  await paste("POLYGON ((0 0, 40 0, 40 20, 22 20, 20 21, 18 20, 0 20, 0 0))");
  const all = await page.evaluate(() => studio.branches);
  const measures = await page.evaluate(() => Object.keys(studio.medial.pruneMeasures()));
  assert.equal(measures.length, 12);
  for (const measure of measures) {
    await page.selectOption("#measure", measure);
    await page.locator("#threshold").fill("1000");
    await settled();
    const [threshold, left] = await page.evaluate(() => [studio.settings.threshold, studio.branches]);
    assert.ok(threshold > 0, `${measure}: ${threshold}`);
    // The scale axis shortens branches, and leaves some of each.
    assert.ok(measure === "scale-axis" ? left <= all : left < all, `${measure}: ${left} of ${all} branches`);
  }
  await page.locator("#threshold").fill("0");
  await page.selectOption("#measure", measures[0]);
});

test("methods", async () => {
  await paste("POLYGON ((0 0, 40 0, 40 20, 22 20, 20 12, 18 20, 0 20, 0 0))");
  for (const method of ["lee", "biarc-dc", "ridge", "brushfire", "potential", "disks"]) {
    await page.selectOption("#method", method);
    await settled();
    assert.equal(await page.evaluate(() => studio.axis.method), method);
    assert.equal(await page.evaluate(() => studio.scene.error), null);
  }
  await page.selectOption("#compare", "ridge");
  await settled();
  assert.ok(await page.evaluate(() => studio.scene.others[0].pieces.numbers.length > 0));
  await page.selectOption("#compare", "");
});

test("zoom to 1e12 keeps the place", async () => {
  await paste(BOX);
  const place = await screen(30, 10);
  await page.evaluate(([x, y]) => {
    for (let k = 0; k < 60; ++k) studio.camera.zoom(1.6, x, y);
    studio.frame();
  }, place);
  assert.ok((await page.evaluate(() => studio.camera.magnification)) > 1e12);
  const [x, y] = await screen(30, 10);
  assert.ok(Math.hypot(x - place[0], y - place[1]) < 2, `${x}, ${y} for ${place}`);
  await page.keyboard.press("0");
});

test("animations end where they began", async () => {
  await paste(BOX);
  await page.locator("#time").fill("500");
  await settled();
  assert.ok(Math.abs((await page.evaluate(() => studio.scene.fire)) - 5) < 1e-6);
  await page.keyboard.press("l");
  await page.waitForFunction(() => studio.scene.disks?.[0].radius > 0);
  await page.keyboard.press("l");
});

test("files: saved, read again; links", async () => {
  await paste(BOX);
  const saved = {};
  for (const kind of ["svg", "geojson", "native", "gcode", "png"]) {
    await page.click("[data-menu=file-menu]");
    const [download] = await Promise.all([page.waitForEvent("download"), page.click(`[data-do=save-${kind}]`)]);
    saved[kind] = await readFile(await download.path());
  }
  assert.match(saved.svg.toString(), /^<svg [^]*<\/svg>\n$/);
  assert.equal(JSON.parse(saved.geojson).features.length, 6);
  assert.match(saved.gcode.toString(), /M2\n$/);
  assert.equal(saved.png.subarray(1, 4).toString(), "PNG");
  const give = async (name, buffer) => {
    await page.setInputFiles("#file", { name, mimeType: "", buffer: Buffer.from(buffer) });
    await page.waitForFunction(() => studio.rings.length > 0);
    await settled();
  };
  await page.keyboard.press("n");
  await give("shape.json", saved.native);
  assert.equal(await page.evaluate(() => studio.shape.area), 800);
  await page.keyboard.press("n");
  await give("shape.svg", '<svg xmlns="http://www.w3.org/2000/svg" onload="globalThis.ran = true"><g transform="scale(2)"><circle cx="5" cy="5" r="3"/><path d="M20 0h10v10h-10z"/></g></svg>');
  assert.equal((await rings()).length, 2);
  assert.equal(await page.evaluate(() => globalThis.ran), undefined);
  const area = await page.evaluate(() => studio.shape.area);
  assert.ok(Math.abs(area - (400 + 36 * Math.PI)) < 0.05, String(area));
  await page.keyboard.press("n");
  await give("plate.dxf", await readFile(join(import.meta.dirname, "../../data/plate.dxf")));
  assert.equal((await rings()).length, 6);
  assert.equal(await page.evaluate(() => studio.shape.holeCount), 5);
  await page.click("[data-menu=file-menu]");
  await page.click("[data-do=link]");
  await page.waitForFunction(() => location.hash.length > 40);
  const again = await open({}, await page.evaluate(() => location.hash));
  assert.deepEqual(await again.evaluate(() => studio.rings.map(({ xy }) => [...xy])), (await rings()).map(({ xy }) => xy));
  await again.close();
});

test("a text becomes a shape, and a picture", async () => {
  await page.click("[data-menu=file-menu]");
  await page.click("[data-do=text]");
  await page.fill("#text-words", "Oi");
  await page.click("#text .primary");
  await page.waitForFunction(() => studio.shape?.componentCount === 3);
  assert.equal(await page.evaluate(() => studio.shape.holeCount), 1);
  const font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
  if (!existsSync(font)) return;
  await page.keyboard.press("n");
  await page.click("[data-menu=file-menu]");
  await page.click("[data-do=text]");
  await page.setInputFiles("#text-font", font);
  await page.click("#text .primary");
  await page.waitForFunction(() => studio.shape?.componentCount === 3 && studio.rings.some(({ edges }) => edges.size));
});

test("code in four languages", async () => {
  await paste(BOX);
  await page.click("[data-menu=file-menu]");
  await page.click("[data-do=code]");
  for (const [language, text] of [["python", "medial.axis("], ["cpp", "medial::compute("], ["javascript", "medial.axis("], ["shell", "medial axis"]]) {
    await page.click(`[data-code=${language}]`);
    assert.ok((await page.textContent("#code-text")).includes(text), language);
  }
  await page.keyboard.press("ArrowRight"); // from the last one to the first
  assert.match(await page.textContent("#code-text"), /^import medial\n/);
  await page.click("#code .primary");
});

test("menus by the keyboard", async () => {
  const is_open = () => page.isVisible("#examples-menu");
  const focused = () => page.evaluate(() => document.activeElement.id || document.activeElement.textContent);
  await page.focus("[data-menu=examples-menu]");
  await page.keyboard.press("Enter");
  assert.ok(await is_open());
  await page.keyboard.press("Escape");
  assert.deepEqual([await is_open(), await focused()], [false, "Examples"]);
  await page.keyboard.press("Enter");
  await page.keyboard.press("End");
  await page.keyboard.press("Tab");
  assert.equal(await is_open(), false);
  await page.focus("[data-menu=examples-menu]");
  await page.keyboard.press("Enter");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("Enter");
  await settled();
  assert.deepEqual([await is_open(), await focused()], [false, "plane"]);
  assert.match(await page.textContent("#live"), /^Bow tie: \d+ vertices/);
});

test("the tour shows every paper", async () => {
  await page.click("#tour-open");
  const seen = [];
  for (let k = 0; k < 7; ++k) {
    await settled();
    seen.push(await page.evaluate(() => studio.axis.method));
    assert.equal(await page.evaluate(() => studio.scene.error), null, seen.at(-1));
    // Curves are followed themselves: no branch ends where a chord of theirs would.
    if (seen.at(-1) === "curve-axis") assert.equal(await page.evaluate(() => studio.axis.branchCount), 7);
    await page.click("#tour-next");
  }
  assert.deepEqual(seen, ["disks", "ridge", "lee", "biarc-dc", "potential", "curve-axis", "disks"]);
  assert.ok(await page.isHidden("#tour"));
});

test("a thousand edits keep the memory flat", async () => {
  await paste(BOX);
  const size = await page.evaluate(async () => {
    const { Shape } = studio.medial;
    const memory = () => new Shape([[0, 0], [1, 0], [1, 1]]) && studio.axis.nodes.view(Uint8Array).buffer.byteLength;
    const edit = (k) => {
      const ring = { xy: Float64Array.of(0, 0, 40, 0, 40, 20 + (k % 7), 0, 20), edges: new Map() };
      studio.change([ring], false);
      studio.compute();
    };
    for (let k = 0; k < 50; ++k) edit(k);
    const before = memory();
    for (let k = 0; k < 1000; ++k) edit(k);
    return [before, memory()];
  });
  assert.equal(size[0], size[1]);
});

const cutIsDrawn = (page) =>
  page.waitForFunction(() => {
    const { width, height } = document.getElementById("relief");
    if (!width || !height) return false;
    return document.getElementById("relief").getContext("2d").getImageData(0, 0, width, height).data.some((value) => value > 0);
  });

for (const colorScheme of ["light", "dark"])
  test(`axe-core finds nothing, and the cut is turned by keys (${colorScheme})`, async () => {
    const own = await open({ colorScheme });
    await own.addScriptTag({ path: npm.resolve("axe-core") });
    const check = () => own.evaluate(async () => (await axe.run()).violations.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 120)}`));
    assert.deepEqual(await check(), []);
    await own.locator("#carve").fill("60");
    await own.focus("#relief");
    await cutIsDrawn(own);
    const before = await own.evaluate(() => document.getElementById("relief").toDataURL());
    await own.keyboard.press("ArrowRight");
    await own.waitForFunction((old) => document.getElementById("relief").toDataURL() !== old, before);
    assert.deepEqual(await check(), []);
    await own.click("#help-open");
    assert.deepEqual(await check(), []);
    await own.close();
  });

test("a phone", async () => {
  const own = await open({ viewport: { width: 390, height: 780 }, hasTouch: true, isMobile: true });
  const wide = await own.evaluate(() => document.documentElement.scrollWidth);
  assert.equal(wide, 390);
  await own.evaluate(() => {
    const slider = document.getElementById("carve");
    slider.value = 60;
    slider.dispatchEvent(new Event("input"));
  });
  await own.tap("#panel-toggle");
  assert.ok(await own.isVisible("#method"));
  // What was cut while the panel was closed is drawn once it is open.
  await cutIsDrawn(own);
  await own.close();
});

test("a tablet: the tour leaves room for its figure", async () => {
  const own = await open({ viewport: { width: 834, height: 1112 } });
  await own.click("#tour-open");
  const [wide, low, top] = await own.evaluate(() => {
    const at = studio.rings[0].xy.reduce((all, _, k, xy) => (k % 2 ? all : [...all, studio.camera.toScreen(xy[k], xy[k + 1])]), []);
    const [x, y] = [0, 1].map((d) => at.map((point) => point[d]));
    return [Math.max(...x) - Math.min(...x), Math.max(...y), document.getElementById("tour").getBoundingClientRect().top];
  });
  assert.ok(wide > 350 && low < top, `${wide} wide, down to ${low}, the tour from ${top}`);
  await own.close();
});
