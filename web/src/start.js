// Runs before the page's other parts are read: compiles the first part of the module meanwhile.

/** Compiles a part of the module, which the page holds packed. */
globalThis.compiled = (part) => {
  const binary = atob(document.getElementById(part).textContent);
  const bytes = new Uint8Array(binary.length);
  for (let k = 0; k < bytes.length; ++k) bytes[k] = binary.charCodeAt(k); // faster than Uint8Array.from()
  const unpacked = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compileStreaming(new Response(unpacked, { headers: { "Content-Type": "application/wasm" } }));
};
globalThis.first_part = compiled("medial");
first_part.catch(() => {}); // main.mjs tells of it
