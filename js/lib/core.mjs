// Calls of the WebAssembly module: arguments in, answers and errors out.

import { can_wait, imports, own_memory, shared_memory, threads_of_machine, with_memory, worker_starter } from "./threads.mjs";

/** An input or an option that cannot be computed. */
export class MedialError extends Error {
  constructor(text, code = "invalid_option", place = {}) {
    const { feature, ring, vertex, point } = place;
    const named = Object.entries({ feature, ring, vertex }).filter(([, index]) => index !== undefined);
    let where = named.map(([name, index]) => `${name} ${index}`).join(", ");
    if (point) where += ` at (${point.map((x) => (x === null ? "?" : +x.toPrecision(10))).join(", ")})`;
    super(`${where ? `${where.trim()}: ` : ""}${text} [${code}]`);
    this.name = "MedialError";
    Object.assign(this, { text, code, feature, ring, vertex, point });
  }
}

const most_threads = 64; // each has a stack of 4 MB

let module; // the exports of the WebAssembly module
let heap; // its memory
let parts; // it, compiled
let starting;
let completing; // the second part of the module
let is_incomplete = false; // whether a function of the second part was called too soon
let start_worker; // while threads start
let missing = 0; // threads whose workers could not start

/**
 * Compiles the module, once; from other places if the sources give bytes, a URL, or it compiled. It has two
 * parts: what an axis needs, and everything else.
 */
export async function init(source, second) {
  await begin(source, second);
  await completing;
}

/** The same, but waits only for the first part: until complete(), functions that need more throw an error. */
export function begin(
  source = new URL("./medial.wasm", import.meta.url),
  second = new URL("./medial-rest.wasm", import.meta.url),
) {
  starting ??= start(source, second).catch((error) => {
    starting = undefined;
    throw error;
  });
  return starting;
}

/** Waits for the second part. */
export async function complete() {
  await starting;
  await completing;
}

async function start(source, second) {
  const shared = shared_memory();
  const compiled = await compile(await source, shared);
  const own = { can_wait, start_thread, placeholder };
  const instance_on = (memory) => WebAssembly.instantiate(compiled, imports(compiled, (heap = memory), own));
  // A source that is compiled already may import memory of one thread.
  const { exports } = await (shared
    ? instance_on(shared).catch((error) => {
        if (error instanceof WebAssembly.LinkError) return instance_on(own_memory());
        throw error;
      })
    : instance_on(own_memory()));
  exports._initialize();
  module = exports;
  parts = [compiled];
  if (!WebAssembly.Module.imports(compiled).some((one) => one.module === "placeholder")) return;
  completing = add_second(second, heap === shared);
  completing.catch(() => {}); // callers that wait for it get the error
}

/** Its functions take the places of the placeholders in the module's table. */
async function add_second(source, shared) {
  const compiled = await compile(await source, shared);
  await WebAssembly.instantiate(compiled, { primary: module });
  parts.push(compiled);
}

async function compile(source, shared) {
  if (source instanceof WebAssembly.Module) return source;
  if (source instanceof ArrayBuffer || ArrayBuffer.isView(source))
    return WebAssembly.compile(shared ? with_memory(source, true) : source);
  if (String(source).startsWith("file:") && typeof process !== "undefined") {
    const { readFile } = await import(/* @vite-ignore */ "node:fs/promises");
    return compile(await readFile(new URL(source)), shared);
  }
  const response = await fetch(source);
  if (!response.ok) throw new Error(`medial-axis: ${source} cannot be read (${response.status})`);
  return compile(await response.arrayBuffer(), shared);
}

/**
 * Lets the module compute on `count` threads, this one among them; 0: as many as the machine has. Returns how many
 * there are now: 1 where workers cannot share memory, or cannot start. They stay until the page or the process ends.
 */
export async function startThreads(count = 0) {
  if (!(Number.isInteger(count) && count >= 0 && count <= most_threads))
    throw new MedialError(`the number of threads is a whole number in [0, ${most_threads}]`);
  await complete();
  if (!(heap.buffer instanceof ArrayBuffer)) {
    const make = await worker_starter();
    const started = [];
    start_worker = (data) => started.push(make(data));
    module.medial_start_threads(count || Math.min(await threads_of_machine(), most_threads));
    start_worker = undefined;
    missing += (await Promise.allSettled(started)).filter(({ status }) => status === "rejected").length;
  }
  return threads();
}

/** How many threads the module has. */
export const threads = () => loaded().medial_threads() - missing;

function start_thread(thread, stack, begin, given) {
  if (!start_worker) return 6; // EAGAIN
  start_worker({ parts, memory: heap, thread, stack: stack >>> 0, begin, given });
  return 0;
}

/** A placeholder for the functions of the second part. */
function placeholder() {
  is_incomplete = true;
  throw incomplete();
}
const incomplete = () => new MedialError("this part of the program is still being loaded; await complete()", "incomplete");

/** The module once init() is done. */
export function loaded() {
  if (!module) throw new Error("medial-axis: await init() before the first call");
  return module;
}

/** The module's memory; it moves when it grows, so ask each time. */
export const memory = () => loaded() && heap.buffer;

const text = new TextDecoder();
const bytes = new TextEncoder();

function text_at(address) {
  const all = new Uint8Array(memory());
  return text.decode(all.slice(address, all.indexOf(0, address)));
}

// Addresses come as signed numbers: beyond 2 GB they are negative.

/** The text that goes with the last answer, as JSON. */
export const answer_text = () => text_at(module.medial_text() >>> 0);
export const answer_json = () => camel(JSON.parse(answer_text()));

/** A copy of table i of the last answer. */
export function table(i = 0) {
  const size = module.medial_table_size(i);
  if (size === 0) return new Float64Array(0);
  return new Float64Array(memory(), module.medial_table(i) >>> 0, size).slice();
}

/** Keys in JavaScript's spelling. */
export function camel(object) {
  const renamed = Object.entries(object).map(([key, value]) => [
    key.replace(/_(\w)/g, (_, letter) => letter.toUpperCase()),
    value ?? undefined,
  ]);
  return Object.fromEntries(renamed);
}

/** A text as the module reads it: an argument of call(). */
export const encoded = (value) => bytes.encode(`${value}\0`);

/** Options in the module's format: names in the spelling of C++, without undefined ones. */
export function options(given) {
  const rows = Object.entries(given)
    .filter(([, value]) => value !== undefined && value !== null)
    .map(([key, value]) => {
      if (!/^\w+$/.test(key)) throw new MedialError(`there is no option '${key}'`);
      if (/[;\0]/.test(value)) throw new MedialError(`${key} cannot be '${value}'`);
      return `${key.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`)}=${value}`;
    });
  return encoded(rows.join(";"));
}

/** Copies an array into the module's memory. */
function place(value) {
  const from = new Uint8Array(value.buffer, value.byteOffset, value.byteLength);
  const address = module.malloc(Math.max(from.length, 1)) >>> 0;
  if (address === 0) throw new MedialError("memory ran out", "out_of_memory");
  new Uint8Array(memory()).set(from, address);
  return address;
}

/**
 * Calls a function of the module. Arrays are copied there for the call; null is no array.
 * An answer of 0 is an error.
 */
export function call(name, ...given) {
  loaded();
  const placed = [];
  try {
    const values = given.map((value) => {
      if (value === null || value === undefined) return 0;
      if (typeof value === "number" || typeof value === "boolean") return Number(value);
      if (!ArrayBuffer.isView(value)) throw new MedialError(`'${value}' is not a number`);
      placed.push(place(value));
      return placed.at(-1);
    });
    const result = module[`medial_${name}`](...values);
    if (result === 0) {
      if (is_incomplete) throw incomplete();
      const { code, text: what, ...where } = JSON.parse(answer_text());
      throw new MedialError(what, code, where);
    }
    return result >>> 0;
  } finally {
    is_incomplete = false;
    placed.forEach((address) => module.free(address));
  }
}

/** A function of the module that gives a number and cannot fail. */
export const number_of = (name, ...values) => loaded()[`medial_${name}`](...values);

// Objects of the module are freed when JavaScript's garbage collector takes their owners.
const registry = new FinalizationRegistry(({ free, address }) => module[free](address));

/** Owns an object of the module. */
export class Handle {
  #address;
  #free;

  constructor(address, kind) {
    this.#address = address;
    this.#free = `medial_free_${kind}`;
    registry.register(this, { free: this.#free, address }, this);
  }

  /** The object's address. Throws an error after it is freed. */
  get address() {
    if (this.#address === 0) throw new MedialError("the object is freed", "invalid_option");
    return this.#address;
  }

  /** Frees the module's memory now, not when the garbage collector comes. */
  free() {
    if (this.#address === 0) return;
    registry.unregister(this);
    module[this.#free](this.#address);
    this.#address = 0;
  }

  [Symbol.dispose ?? Symbol.for("dispose")]() {
    this.free();
  }
}
