// The functions of the package in a worker, so that long work leaves the page alone.
//
//   const medial = await inWorker();
//   const { nodes, edges, lines } = await medial.axis(shape, { method: "lee" });
//   medial.terminate();
//
// Arguments and results are plain data. In place of an axis, a line or a shape comes a copy of what it
// holds; give the shape again for the next operation.

import { MedialError } from "./lib/core.mjs";

const is_worker = typeof WorkerGlobalScope !== "undefined" && globalThis instanceof WorkerGlobalScope;
const in_node = typeof process !== "undefined" && Boolean(process.versions?.node);

/** Starts a worker whose methods are the functions of the package, each giving a promise. */
export async function inWorker() {
  const worker = await start();
  const waiting = new Map();
  let last = 0;
  worker.listen(({ id, result, error }) => {
    const { resolve, reject } = waiting.get(id);
    waiting.delete(id);
    if (error) reject(error.code ? new MedialError(error.text, error.code, error) : new Error(error.text));
    else resolve(result);
  });
  const call = (name, given) =>
    new Promise((resolve, reject) => {
      waiting.set(++last, { resolve, reject });
      worker.post({ id: last, name, given });
    });
  const own = { terminate: worker.terminate, then: undefined };
  return new Proxy(own, { get: (_, name) => (name in own ? own[name] : (...given) => call(name, given)) });
}

async function start() {
  const url = new URL(import.meta.url);
  if (in_node) {
    const { Worker } = await import("node:worker_threads");
    const worker = new Worker(url, { workerData: "medial-axis" });
    return {
      listen: (use) => worker.on("message", use),
      post: (message) => worker.postMessage(message),
      terminate: () => worker.terminate(),
    };
  }
  const worker = new Worker(url, { type: "module" });
  return {
    listen: (use) => worker.addEventListener("message", ({ data }) => use(data)),
    post: (message) => worker.postMessage(message),
    terminate: () => worker.terminate(),
  };
}

// In the worker.

function columns(records) {
  return Object.fromEntries(Object.keys(records).map((name) => [name, records[name]]));
}

/** What an object holds, as plain data; its memory is freed. */
function plain(value, medial) {
  if (Array.isArray(value)) return value.map((one) => plain(one, medial));
  if (value instanceof medial.MedialAxis) {
    const { method, tolerance, resolution, length, branchCount } = value;
    const [nodes, edges, sites] = [value.nodes, value.edges, value.sites].map(columns);
    const lines = value.sample();
    value.free();
    return { nodes, edges, sites, method, tolerance, resolution, length, branchCount, lines };
  }
  if (value instanceof medial.Shape) {
    const { area, bounds } = value;
    return { area, bounds, polygons: value.polygons() };
  }
  if (value instanceof medial.Line) {
    const { length, narrowest, closed } = value;
    return { length, narrowest, closed, coordinates: value.coordinates() };
  }
  if (value === null || typeof value !== "object" || ArrayBuffer.isView(value)) return value;
  const entries = Object.entries(value).filter(([, part]) => typeof part !== "function");
  return Object.fromEntries(entries.map(([key, part]) => [key, plain(part, medial)]));
}

async function serve(listen, post) {
  const queue = import("./index.mjs");
  listen(async ({ id, name, given }) => {
    try {
      const medial = await queue;
      if (typeof medial[name] !== "function") throw new Error(`medial-axis has no function '${name}'`);
      post({ id, result: plain(medial[name](...given), medial) });
    } catch (error) {
      const { text, message, code, feature, ring, vertex, point } = error;
      post({ id, error: { text: text ?? message, code, feature, ring, vertex, point } });
    }
  });
}

if (is_worker) serve((use) => addEventListener("message", ({ data }) => use(data)), (m) => postMessage(m));
if (in_node) {
  const { isMainThread, parentPort, workerData } = await import("node:worker_threads");
  if (!isMainThread && workerData === "medial-axis")
    serve((use) => parentPort.on("message", use), (m) => parentPort.postMessage(m));
}
