// Threads: workers that have an instance of the module on the same memory. Browsers let workers share memory in
// pages that are isolated from other sites (`crossOriginIsolated`); Node always does.

const in_node = typeof process !== "undefined" && Boolean(process.versions?.node);
const PAGES = { initial: 256, maximum: 65536 }; // as the module is linked

export const own_memory = () => new WebAssembly.Memory(PAGES);

/** Memory for several threads; null where there is none. */
export function shared_memory() {
  if (!in_node && !globalThis.crossOriginIsolated) return null;
  try {
    return new WebAssembly.Memory({ ...PAGES, shared: true });
  } catch {
    return null; // no room for its largest size
  }
}

/** How many threads the machine runs at the same time. */
export async function threads_of_machine() {
  if (!in_node) return navigator.hardwareConcurrency || 1;
  const { availableParallelism, cpus } = await import(/* @vite-ignore */ "node:os");
  return availableParallelism?.() ?? cpus().length;
}

/** A copy of a part of the module which imports memory that is shared, or not; of other bytes, the same. */
export function with_memory(part, shared) {
  const bytes = new Uint8Array(part.buffer ?? part, part.byteOffset ?? 0, part.byteLength).slice();
  if ([..."\0asm"].some((letter, i) => bytes[i] !== letter.charCodeAt())) return bytes;
  let at = 8; // behind the format's name and version
  const number = () => {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      if (at >= bytes.length) throw new Error("medial-axis: this is not its module");
      value |= (bytes[at] & 127) << shift;
      if (bytes[at++] < 128) return value >>> 0;
    }
  };
  const skip = () => (at = number() + at);
  while (bytes[at++] !== 2) skip(); // up to the imports
  number();
  for (let count = number(); count > 0; --count) {
    skip(); // the names of the module and of the import
    skip();
    const kind = bytes[at++];
    if (kind === 2) {
      bytes[at] = shared ? bytes[at] | 2 : bytes[at] & ~2;
      return bytes;
    }
    const [, flags] = bytes.subarray(at);
    if (kind !== 0) at += kind === 4 ? 1 : 2; // of a table, a global, a tag
    if (kind !== 3) number(); // a type, or a table's size
    if (kind === 1 && flags & 1) number();
  }
  throw new Error("medial-axis: this is not its module");
}

/**
 * What an instance of the module has around it. The text of this function is the program of a worker, too: it
 * uses nothing from outside.
 */
function surroundings() {
  /** A clock, and the functions in `own`, which differ by instance. The module calls no other imports. */
  function imports(part, memory, own) {
    const clock_time_get = (_id, _precision, at) => {
      const now = BigInt(Math.round(performance.now() * 1e6));
      new DataView(memory.buffer).setBigUint64(at >>> 0, now, true);
      return 0;
    };
    const known = { clock_time_get, memory, ...own };
    const given = {};
    for (const { module, name } of WebAssembly.Module.imports(part))
      (given[module] ??= {})[name] = (module === "placeholder" ? own.placeholder : known[name]) ?? (() => 0);
    return given;
  }

  function run({ parts: [first, second], memory, thread, stack, begin, given }, started) {
    const refuse = () => 6; // EAGAIN
    const { exports } = new WebAssembly.Instance(first, imports(first, memory, { start_thread: refuse }));
    if (second) new WebAssembly.Instance(second, { primary: exports });
    exports.stackRestore(stack);
    started();
    exports.medial_run_thread(thread, begin, given);
  }

  return { imports, run };
}
export const { imports } = surroundings();

/** What starts workers; each gives a promise, which is kept when the worker's thread begins. */
export async function worker_starter() {
  const listen = in_node
    ? `import("node:worker_threads").then(({ parentPort }) =>
         parentPort.once("message", (data) => run(data, () => parentPort.postMessage(0))));`
    : "onmessage = ({ data }) => run(data, () => postMessage(0));";
  const program = `const { run } = (${surroundings})(); ${listen}`;
  if (in_node) {
    const { Worker } = await import(/* @vite-ignore */ "node:worker_threads");
    return (data) =>
      new Promise((done, fail) => {
        const worker = new Worker(program, { eval: true });
        worker.once("error", fail).once("message", () => {
          worker.unref(); // the process may end
          done();
        });
        worker.postMessage(data);
      });
  }
  const url = URL.createObjectURL(new Blob([program], { type: "text/javascript" }));
  return (data) =>
    new Promise((done, fail) => {
      const worker = new Worker(url);
      worker.onmessage = done;
      worker.onerror = ({ message }) => fail(new Error(`medial-axis: a thread cannot start: ${message ?? "refused"}`));
      worker.postMessage(data);
    });
}

/** Whether this thread may wait for others; a page's own may not. */
export function can_wait() {
  try {
    Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, 0);
    return 1;
  } catch {
    return 0;
  }
}
