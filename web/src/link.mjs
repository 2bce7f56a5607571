// The drawing and its settings in an address: packed, without a server.

import { ring_of } from "./model.mjs";

async function through(stream, bytes) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

/** Rings as rows of numbers that read back as the same doubles. */
const plain = (rings) => rings.map(({ xy, edges }) => [[...xy], [...edges]]);

export async function packed(rings, settings) {
  const text = new TextEncoder().encode(JSON.stringify({ v: 1, rings: plain(rings), settings }));
  const bytes = await through(new CompressionStream("deflate-raw"), text);
  let binary = "";
  for (let k = 0; k < bytes.length; k += 8192) binary += String.fromCharCode(...bytes.subarray(k, k + 8192));
  return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

export async function unpacked(text) {
  const binary = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = await through(new DecompressionStream("deflate-raw"), Uint8Array.from(binary, (c) => c.charCodeAt(0)));
  const { v, rings, settings } = JSON.parse(new TextDecoder().decode(bytes));
  if (v !== 1) throw new Error("the link is of another version of the studio");
  return { rings: rings.map(([xy, edges]) => ({ ...ring_of([], edges), xy: Float64Array.from(xy) })), settings };
}
