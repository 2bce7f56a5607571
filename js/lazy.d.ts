export * from "./index.js";
type Source = ArrayBuffer | ArrayBufferView | URL | string | WebAssembly.Module;
/** Compiles the module, once; from other places if the sources of its two parts give bytes, a URL, or it compiled. */
export function init(source?: Source, second?: Source): Promise<void>;
/**
 * The same, but waits for the first part only: axes. Until complete(), what needs more throws an error
 * (`incomplete`).
 */
export function begin(source?: Source | Promise<Source>, second?: Source | Promise<Source>): Promise<void>;
/** Waits for the second part. */
export function complete(): Promise<void>;
