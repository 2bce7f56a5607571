// The functions of the package in a worker, so that long computations do not block the page.
//
//   const medial = await inWorker({ threads: 0 });
//   const { nodes, edges, lines } = await medial.axis(shape, { method: "lee" });
//   const editor = await medial.Editor(shape);
//   const { addedEdges } = await editor.move(17, [2, 3]);
//   medial.terminate();
//
// Arguments and results are plain data. In place of an axis, a line or a shape comes a copy of what it
// holds; give the shape again for the next operation. Editors stay in the worker until they are freed.

import { MedialError } from "./lib/core.mjs";

const is_worker = typeof WorkerGlobalScope !== "undefined" && globalThis instanceof WorkerGlobalScope;
const in_node = typeof process !== "undefined" && Boolean(process.versions?.node);

/**
 * Starts a worker whose methods are the functions of the package, each giving a promise. It computes on `threads`
 * threads, 0: as many as the machine has; on one where workers cannot share memory.
 */
export async function inWorker({ threads = 1 } = {}) {
  const worker = await start();
  const waiting = new Map();
  let last = 0;
  let ended; // the error of all calls, once the worker is gone
  const end = (error) => {
    ended ??= new Error(`medial-axis: ${error?.message ?? "the worker cannot be loaded"}`);
    for (const { reject } of waiting.values()) reject(ended);
    waiting.clear();
  };
  const answered = ({ id, result, error }) => {
    if (!waiting.has(id)) return;
    const { resolve, reject } = waiting.get(id);
    waiting.delete(id);
    if (error) reject(error.code ? new MedialError(error.text, error.code, error) : new Error(error.text));
    else resolve(result?.editor ? remote_editor(result.editor, call) : result);
  };
  const call = (name, given, editor) =>
    new Promise((resolve, reject) => {
      if (ended) return reject(ended);
      worker.post({ id: ++last, name, given, editor });
      waiting.set(last, { resolve, reject });
    });
  const terminate = () => {
    end({ message: "the worker is terminated" });
    return worker.terminate();
  };
  worker.listen(answered, end);
  const own = { terminate, then: undefined };
  if (threads !== 1)
    await call("startThreads", [threads]).catch((error) => {
      terminate();
      throw error;
    });
  return new Proxy(own, { get: (_, name) => (name in own ? own[name] : (...given) => call(name, given)) });
}

const left = new FinalizationRegistry(({ editor, call }) => call("free", [], editor).catch(() => {}));

/** A proxy for an editor in the worker: the same methods, each of which returns a promise. */
function remote_editor(editor, call) {
  const methods = [
    "move", "insert", "remove", "setBulge", "insertLoop", "removeLoop", "moveLoop", "undo", "copy",
    "vertex", "bulge", "nodes", "edges", "sites",
  ];
  const remote = {
    get axis() {
      return call("axis", [], editor);
    },
    free() {
      left.unregister(remote);
      return call("free", [], editor);
    },
  };
  for (const name of methods) remote[name] = (...given) => call(name, given, editor);
  left.register(remote, { editor, call }, remote);
  return remote;
}

async function start() {
  const url = new URL(import.meta.url);
  if (in_node) {
    const { Worker } = await import("node:worker_threads");
    const worker = new Worker(url, { workerData: "medial-axis" });
    return {
      listen: (use, fail) => worker.on("message", use).on("error", fail),
      post: (message) => worker.postMessage(message),
      terminate: () => worker.terminate(),
    };
  }
  const worker = new Worker(url, { type: "module" });
  return {
    listen: (use, fail) => {
      worker.addEventListener("message", ({ data }) => use(data));
      worker.addEventListener("error", fail);
    },
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
  if (value instanceof medial.Records) return columns(value);
  if (value === null || typeof value !== "object" || ArrayBuffer.isView(value)) return value;
  const entries = Object.entries(value).filter(([, part]) => typeof part !== "function");
  return Object.fromEntries(entries.map(([key, part]) => [key, plain(part, medial)]));
}

/** Calls a function of the package, or of one of the editors. */
async function answer(medial, editors, { id, name, given, editor }) {
  if (name === "free") {
    editors.get(editor)?.free();
    return void editors.delete(editor);
  }
  const of = editor ? editors.get(editor) : medial;
  if (!of) throw new medial.MedialError("the object is freed", "invalid_option");
  if (editor && name === "axis") return plain(of.axis, medial);
  if (!(name in of) || typeof of[name] !== "function") throw new Error(`medial-axis has no function '${name}'`);
  const value = name === "Editor" ? new medial.Editor(...given) : await of[name](...given);
  if (!(value instanceof medial.Editor)) return plain(value, medial);
  editors.set(id, value);
  return { editor: id };
}

async function serve(listen, post) {
  const queue = import("./index.mjs");
  const editors = new Map();
  listen(async (message) => {
    const { id } = message;
    try {
      post({ id, result: await answer(await queue, editors, message) });
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
