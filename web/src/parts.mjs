// The parts of the module, which the page holds as text.

const bytes_of = (part) => {
  const text = document.getElementById(part).textContent;
  return Uint8Array.fromBase64?.(text) ?? Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
};

/** The first part. It is compiled on the spot: to wait for other threads would take longer. */
export const first_part = () => new WebAssembly.Module(bytes_of("medial"));

/** The second part, which is packed. */
export function second_part() {
  const unpacked = new Blob([bytes_of("medial-rest")]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compileStreaming(new Response(unpacked, { headers: { "Content-Type": "application/wasm" } }));
}
