// The parts of the module, which the page holds as text.

function bytes_of(part) {
  const text = document.getElementById(part).textContent;
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let k = 0; k < bytes.length; ++k) bytes[k] = binary.charCodeAt(k); // faster than Uint8Array.from()
  return bytes;
}

/**
 * The first part. It is compiled on the spot: to wait for other threads would take longer. Browsers that refuse
 * to compile that much at once get the bytes, and so do pages that may have threads: the package changes them.
 */
export function first_part() {
  const bytes = bytes_of("medial");
  if (globalThis.crossOriginIsolated) return bytes;
  try {
    return new WebAssembly.Module(bytes);
  } catch {
    return bytes;
  }
}

/** The second part, which is packed. */
export function second_part() {
  const unpacked = new Blob([bytes_of("medial-rest")]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(unpacked).arrayBuffer();
}
