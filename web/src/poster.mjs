// The first example and its axis as a picture, which web/build.mjs puts into the page: it is on the screen before
// the module is compiled, and stays until the studio draws the same.

import { conics_of, number, path_data, rings_of_text } from "./files.mjs";
import { bounds_of, input_of } from "./model.mjs";
import { Pieces, SHADES } from "./pieces.mjs";

export const LEAF = "M 3 52 C 12 18 44 0 78 6 C 96 9 112 22 118 44 C 104 38 96 40 90 46 C 98 50 104 58 104 70 C 94 62 84 60 76 64 C 72 84 50 96 24 86 C 34 82 38 76 36 70 C 26 70 10 66 3 52 Z";

/** Each shade has a class of its own: see `ramp_of`. */
export function poster(medial) {
  const rings = rings_of_text(LEAF);
  const [x0, y0, x1, y1] = bounds_of(rings);
  const { x, options } = input_of(rings, medial);
  const axis = medial.axis(new medial.Shape(x, options), { method: "disks" });
  const short = (d) => d.replaceAll(/\d+\.\d+/g, (digits) => String(+(+digits).toFixed(2)));
  const shape = short(rings.map(path_data).join(""));
  const box = [x0, -y1, x1 - x0, y1 - y0].map(number).join(" ");
  const lines = conics_of(new Pieces(axis)).map(([shade, d]) => `<path class="s${shade}" d="${short(d)}"/>`);
  return `<svg id="poster" aria-hidden="true" viewBox="${box}"><path class="area" d="${shape}"/>${lines.join("")}<path class="line" d="${shape}"/></svg>`;
}

/** The colours of the shades, interpolated between the colours of a style sheet. */
export function ramp_of(colours) {
  const stops = colours.trim().split(/\s+/).map((hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16)));
  return Array.from({ length: SHADES }, (_, i) => {
    const at = (i / (SHADES - 1)) * (stops.length - 1);
    const k = Math.min(stops.length - 2, Math.floor(at));
    const mix = stops[k].map((v, d) => Math.round(v + (at - k) * (stops[k + 1][d] - v)));
    return `rgb(${mix.join(" ")})`;
  });
}

/** The style of the poster: the colours of the light and of the dark style sheet. */
export function poster_style(style) {
  const [light, dark] = [...style.matchAll(/--ramp:([^;}]+)/g)].map(([, colours]) => ramp_of(colours));
  const rules = (ramp) => ramp.map((colour, shade) => `#poster .s${shade}{stroke:${colour}}`).join("");
  return `${rules(light)}@media (prefers-color-scheme:dark){${rules(dark)}}`;
}
