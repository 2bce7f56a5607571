export * from "./index.js";
/** Compiles the module, once; from another place if `source` gives its bytes, its URL, or it compiled. */
export function init(source?: ArrayBuffer | ArrayBufferView | URL | string | WebAssembly.Module): Promise<void>;
