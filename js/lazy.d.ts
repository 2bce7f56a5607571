export * from "./index.js";
/** Compiles the module, once; from another place if `source` gives its bytes or its URL. */
export function init(source?: ArrayBuffer | ArrayBufferView | URL | string): Promise<void>;
