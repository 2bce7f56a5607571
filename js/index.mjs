// The package `medial-axis`: the module is compiled before the first import returns.

import { init } from "./lazy.mjs";

await init();
export * from "./lazy.mjs";
