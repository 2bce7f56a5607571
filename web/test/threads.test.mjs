// Threads in Chromium: pages that a server isolates from other sites have them, others do without.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { extname, join } from "node:path";
import { after, before, test } from "node:test";

const { chromium } = createRequire(join(process.env.MEDIAL_NPM, "node_modules", "/"))("playwright-core");
const TYPES = { ".html": "text/html", ".mjs": "text/javascript", ".wasm": "application/wasm" };
const ISOLATED = { "Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Embedder-Policy": "require-corp" };

let browser;
const servers = {};

/** Serves the studio, and the package beside it. */
async function serve(headers) {
  const server = createServer(async ({ url }, answer) => {
    const { pathname } = new URL(url, "http://x");
    const path = join(process.env.MEDIAL_STUDIO, "..", pathname);
    const body = pathname === "/empty.html" ? "<!doctype html><title>empty</title>" : await readFile(path).catch(() => null);
    answer.writeHead(body === null ? 404 : 200, { "Content-Type": TYPES[extname(pathname)] ?? "text/plain", ...headers });
    answer.end(body ?? "");
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  return server;
}
const address = (server) => `http://127.0.0.1:${server.address().port}`;

before(async () => {
  globalThis.crypto ??= (await import("node:crypto")).webcrypto;
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
  servers.isolated = await serve(ISOLATED);
  servers.plain = await serve({});
  servers.strict = await serve({ ...ISOLATED, "Content-Security-Policy": "worker-src 'self'" }); // not blob:
});
after(async () => {
  await browser?.close();
  for (const server of Object.values(servers)) server.close();
});

/** Opens a page, fails if it does. */
async function open(server, path) {
  const page = await browser.newPage();
  page.setDefaultTimeout(30000);
  page.on("pageerror", (error) => assert.fail(error));
  await page.goto(address(server) + path);
  return page;
}

/** In a page: how many threads `medial` has, and a sum of the axis' bytes for numbers of threads. */
async function sums(source) {
  const medial = source ? await import(source) : studio.medial;
  const found = [await medial.startThreads(3)];
  let state = 1;
  const random = () => (state = (48271 * state) % 0x7fffffff) / 0x7fffffff;
  // A rough circle: without Math.sin(), which differs among engines.
  const ring = new Float64Array(40000);
  for (let i = 0; i < 20000; ++i) {
    const [quarter, t] = [Math.floor(i / 5000), (i % 5000) / 5000];
    const radius = (1 + 0.3 * Math.abs((i % 2000) / 1000 - 1) + 1e-3 * random()) / (1 + t * t);
    const [x, y] = [radius * (1 - t * t), radius * 2 * t];
    ring.set([[x, y], [-y, x], [-x, -y], [y, -x]][quarter], 2 * i);
  }
  for (const threads of [1, 2, 3, 0]) {
    const axis = medial.axis(ring, { threads });
    const bytes = Uint8Array.from(axis.edges.view(Uint8Array));
    axis.free();
    const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", bytes));
    found.push(digest.reduce((text, one) => text + one.toString(16).padStart(2, "0"), ""));
  }
  return found;
}

test("a page has threads where it is isolated; the axes are the same", async () => {
  const all = [];
  for (const [server, threads] of [["isolated", 3], ["plain", 1], ["strict", 1]]) {
    const page = await open(servers[server], "/empty.html");
    assert.equal(await page.evaluate(() => crossOriginIsolated), server !== "plain");
    const [count, ...digests] = await page.evaluate(sums, "/package/index.mjs");
    assert.equal(count, threads);
    all.push(...digests);
    await page.close();
  }
  const here = await import(join(process.env.MEDIAL_STUDIO, "../package/index.mjs"));
  assert.equal(here.threads(), 1);
  all.push(...(await sums(join(process.env.MEDIAL_STUDIO, "../package/index.mjs"))).slice(1));
  assert.equal(new Set(all).size, 1, all.join("\n"));
});

test("a worker of a page has threads", async () => {
  for (const [server, threads] of [["isolated", 2], ["plain", 1], ["strict", 1]]) {
    const page = await open(servers[server], "/empty.html");
    const found = await page.evaluate(async () => {
      const { inWorker } = await import("/package/worker.mjs");
      const medial = await inWorker({ threads: 2 });
      const { branchCount } = await medial.axis("POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))", { threads: 2 });
      const count = await medial.threads();
      medial.terminate();
      return [count, branchCount];
    });
    assert.deepEqual(found, [threads, 5]);
    if (server === "isolated") {
      // With the worker its threads end.
      const ended = Date.now() + 20000;
      while (page.workers().length > 0 && Date.now() < ended) await new Promise((done) => setTimeout(done, 50));
      assert.equal(page.workers().length, 0);
    }
    await page.close();
  }
});

test("the studio computes on all threads where it is isolated", async () => {
  for (const server of ["isolated", "plain"]) {
    const page = await open(servers[server], "/studio/index.html");
    await page.waitForFunction(() => globalThis.studio?.opened);
    const [threads, wanted] = await page.evaluate(async () => [await studio.medial.startThreads(), navigator.hardwareConcurrency]);
    assert.equal(threads, server === "isolated" ? wanted : 1);
    const [first] = (await page.evaluate(sums, "")).slice(1);
    assert.equal((await page.evaluate(sums, "")).slice(1).every((one) => one === first), true);
    await page.close();
  }
});
