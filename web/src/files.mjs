// Files and texts as rings, and the drawing as files.

import { arc_of, bounds_of, next_of, outline, point_of, ring_of, size_of } from "./model.mjs";
import { Pieces } from "./pieces.mjs";
import { flat_path } from "./svg.mjs";

const points_of = (list) => {
  const [first, last] = [list[0], list.at(-1)];
  const shut = list.length > 1 && first[0] === last[0] && first[1] === last[1];
  return (shut ? list.slice(0, -1) : list).map(([x, y]) => [x, y]);
};

function rings_of_geojson(object) {
  const polygons = (g) => {
    if (!g) return [];
    if (g.type === "FeatureCollection") return g.features.flatMap(polygons);
    if (g.type === "Feature") return polygons(g.geometry);
    if (g.type === "GeometryCollection") return g.geometries.flatMap(polygons);
    if (g.type === "Polygon") return [g.coordinates];
    return g.type === "MultiPolygon" ? g.coordinates : [];
  };
  return polygons(object).flat().map((ring) => ring_of(points_of(ring)));
}

/** All rings of a well-known text, at any depth. */
function rings_of_wkt(text) {
  const rings = [...text.matchAll(/\(([^()]+)\)/g)].map(([, row]) =>
    row.split(",").map((point) => point.trim().split(/\s+/).map(Number)),
  );
  return rings.filter((ring) => ring.length > 2).map((ring) => ring_of(points_of(ring)));
}

function rings_of_native(file) {
  return file.items.flatMap(({ shape }) =>
    shape.component.map((_, i) => {
      const [from, to] = [shape.loop_begin[i], shape.loop_begin[i + 1]];
      const edges = (shape.bulges ?? []).slice(from, to).map((bulge, k) => [k, bulge]);
      return ring_of(shape.points.slice(from, to), edges.filter(([, bulge]) => bulge));
    }),
  );
}

/** Rows of numbers; an empty line starts another ring. */
function rings_of_rows(text) {
  const blocks = text.trim().split(/\n\s*\n/);
  return blocks.map((block) => {
    const numbers = block.match(/[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?/g)?.map(Number) ?? [];
    const rows = Array.from({ length: numbers.length >> 1 }, (_, i) => [numbers[2 * i], numbers[2 * i + 1]]);
    return ring_of(points_of(rows));
  });
}

/** The rings in a text of any supported format. */
export function rings_of_text(text) {
  const start = text.trimStart();
  if (start.startsWith("{")) {
    const object = JSON.parse(text);
    return object.medial ? rings_of_native(object) : rings_of_geojson(object);
  }
  if (start.startsWith("<")) return rings_of_svg(text);
  if (/^[Mm][\s\d.+-]/.test(start)) return flat_path(start, ([x, y]) => [x, -y]);
  if (/^(SRID=\d+;)?\s*[A-Za-z]+\s*Z?M?\s*\(/.test(start)) return rings_of_wkt(text);
  return rings_of_rows(text);
}

const SVG = "http://www.w3.org/2000/svg";

/** Removes elements and attributes that would run or load something once the drawing is in the page. */
function make_harmless(element) {
  const link = element.getAttribute("href") ?? element.getAttribute("xlink:href") ?? "#";
  const is_foreign = element.namespaceURI !== SVG || element.matches("script, foreignObject, image, feImage, style, animate, set");
  if (is_foreign || (element.matches("use") && !link.startsWith("#"))) return element.remove();
  for (const { name } of [...element.attributes]) if (/^on/i.test(name)) element.removeAttribute(name);
}

/** The filled paths and shapes of a drawing, with its transformations. */
function rings_of_svg(text) {
  const host = document.createElement("div");
  host.style.cssText = "position:absolute;visibility:hidden;width:1000px;height:1000px";
  const parsed = new DOMParser().parseFromString(text, "image/svg+xml");
  const svg = parsed.documentElement;
  if (svg.localName !== "svg" || svg.namespaceURI !== SVG) throw new Error("this is no SVG");
  for (const element of [svg, ...svg.querySelectorAll("*")]) make_harmless(element);
  svg.removeAttribute("viewBox");
  host.append(document.importNode(svg, true));
  document.body.append(host);
  try {
    const root = host.firstElementChild;
    return [...root.querySelectorAll("path, rect, circle, ellipse, polygon, polyline")].flatMap((element) => {
      if (element.closest("defs, clipPath, mask, symbol, pattern")) return [];
      const matrix = root.getScreenCTM().inverse().multiply(element.getScreenCTM());
      const map = ([x, y]) => [matrix.a * x + matrix.c * y + matrix.e, -(matrix.b * x + matrix.d * y + matrix.f)];
      return flat_path(path_of(element), map);
    });
  } finally {
    host.remove();
  }
}

function path_of(element) {
  const value = (name) => element[name].baseVal.value;
  const ellipse = (cx, cy, rx, ry) => `M${cx - rx} ${cy}a${rx} ${ry} 0 1 0 ${2 * rx} 0a${rx} ${ry} 0 1 0 ${-2 * rx} 0z`;
  switch (element.localName) {
    case "rect":
      return `M${value("x")} ${value("y")}h${value("width")}v${value("height")}h${-value("width")}z`;
    case "circle":
      return ellipse(value("cx"), value("cy"), value("r"), value("r"));
    case "ellipse":
      return ellipse(value("cx"), value("cy"), value("rx"), value("ry"));
    case "polygon":
    case "polyline":
      return `M${element.getAttribute("points")}z`;
    default:
      return element.getAttribute("d") ?? "";
  }
}

/** Closed chains of a DXF: its polylines and circles, and lines and arcs that meet end to end. */
async function rings_of_dxf(text) {
  const loaded = await import("dxf-parser");
  const Parser = loaded.DxfParser ?? loaded.default?.default ?? loaded.default;
  const { entities } = new Parser().parseSync(text);
  const rings = [];
  const loose = [];
  for (const e of entities) {
    if (e.type === "CIRCLE") rings.push(circle_ring(e.center, e.radius));
    else if (/POLYLINE/.test(e.type)) {
      const bulges = e.vertices.map((v, i) => [i, v.bulge ?? 0]).filter(([, bulge]) => bulge);
      if (e.vertices.length > 1) rings.push(ring_of(e.vertices.map(({ x, y }) => [x, y]), bulges));
    } else if (e.type === "LINE") loose.push({ a: xy(e.vertices[0]), b: xy(e.vertices[1]), bulge: 0 });
    else if (e.type === "ARC") {
      let angle = e.endAngle - e.startAngle;
      if (angle <= 0) angle += 2 * Math.PI;
      const at = (t) => [e.center.x + e.radius * Math.cos(t), e.center.y + e.radius * Math.sin(t)];
      loose.push({ a: at(e.startAngle), b: at(e.startAngle + angle), bulge: Math.tan(angle / 4) });
    }
  }
  return [...rings, ...chained(loose)];
}
const xy = ({ x, y }) => [x, y];
function circle_ring({ x, y }, r) {
  return ring_of([[x - r, y], [x + r, y]], [[0, 1], [1, 1]]);
}

function chained(pieces) {
  const rings = [];
  const rest = [...pieces];
  const near = (p, q) => Math.hypot(p[0] - q[0], p[1] - q[1]) < 1e-6 * (1 + Math.hypot(...p));
  while (rest.length) {
    const chain = [rest.pop()];
    while (!near(chain.at(-1).b, chain[0].a)) {
      const at = rest.findIndex(({ a, b }) => near(a, chain.at(-1).b) || near(b, chain.at(-1).b));
      if (at < 0) break;
      const [next] = rest.splice(at, 1);
      chain.push(near(next.a, chain.at(-1).b) ? next : { a: next.b, b: next.a, bulge: -next.bulge });
    }
    if (near(chain.at(-1).b, chain[0].a))
      rings.push(ring_of(chain.map(({ a }) => a), chain.map(({ bulge }, i) => [i, bulge]).filter(([, bulge]) => bulge)));
  }
  return rings;
}

/** The dark parts of a picture (or its opaque ones) as smoothed outlines. */
async function rings_of_image(file) {
  const bitmap = await createImageBitmap(file);
  const scale = Math.min(1, 600 / Math.max(bitmap.width, bitmap.height));
  const canvas = document.createElement("canvas");
  canvas.width = Math.max(1, Math.round(bitmap.width * scale));
  canvas.height = Math.max(1, Math.round(bitmap.height * scale));
  const context = canvas.getContext("2d", { willReadFrequently: true });
  context.drawImage(bitmap, 0, 0, canvas.width, canvas.height);
  const { trace } = await import("./trace.mjs");
  return trace(context.getImageData(0, 0, canvas.width, canvas.height));
}

/** A text in a font, or without one in the browser's bold sans-serif. */
export async function rings_of_words(words, font_file) {
  if (font_file) {
    const loaded = await import("opentype.js");
    const font = (loaded.parse ? loaded : loaded.default).parse(await font_file.arrayBuffer());
// Glyph by glyph: the package does not support all rules of substitution in fonts.
    let x = 0;
    return [...words].flatMap((letter) => {
      const glyph = font.charToGlyph(letter);
      const data = glyph.getPath(x, 0, 100).toPathData(6);
      x += (100 * glyph.advanceWidth) / font.unitsPerEm;
      return data ? flat_path(data, ([px, py]) => [px, -py]) : [];
    });
  }
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d", { willReadFrequently: true });
  const font = "700 160px system-ui, sans-serif";
  context.font = font;
  canvas.width = Math.min(4000, Math.ceil(context.measureText(words).width) + 40);
  canvas.height = 240;
  context.fillStyle = "#fff";
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.fillStyle = "#000";
  context.font = font;
  context.fillText(words, 20, 170);
  const { trace } = await import("./trace.mjs");
  return trace(context.getImageData(0, 0, canvas.width, canvas.height));
}

export async function rings_of_file(file) {
  const name = file.name.toLowerCase();
  if (/\.(ttf|otf|woff)$/.test(name)) return rings_of_words("medial", file);
  if (name.endsWith(".dxf")) return rings_of_dxf(await file.text());
  if (/\.(png|jpe?g|webp|gif|bmp)$/.test(name) || /^image\/(?!svg)/.test(file.type)) return rings_of_image(file);
  if (name.endsWith(".gz")) return rings_of_text(await new Response(file.stream().pipeThrough(new DecompressionStream("gzip"))).text());
  return rings_of_text(await file.text());
}

// Output.

export const number = (value) => String(+value.toPrecision(12));

/** The path data of a ring, with y as in SVG. */
export function path_data(ring) {
  const at = ([x, y]) => `${number(x)} ${number(-y)}`;
  let d = `M${at(point_of(ring, 0))}`;
  for (let i = 0; i < size_of(ring); ++i) {
    const [a, b] = [point_of(ring, i), point_of(ring, next_of(ring, i))];
    const edge = ring.edges.get(i);
    if (edge === undefined) d += i + 1 < size_of(ring) ? `L${at(b)}` : "";
    else if (typeof edge === "number") {
      const { radius, angle } = arc_of(a, b, edge);
      d += `A${number(radius)} ${number(radius)} 0 ${Math.abs(angle) > Math.PI ? 1 : 0} ${angle > 0 ? 0 : 1} ${at(b)}`;
    } else d += `C${at(edge.slice(0, 2))} ${at(edge.slice(2))} ${at(b)}`;
  }
  return `${d}Z`;
}

export function svg_of({ rings, scene, axis, deepest }, ramp) {
  const [x0, y0, x1, y1] = bounds_of(rings);
  const margin = 0.03 * Math.hypot(x1 - x0, y1 - y0);
  const box = [x0 - margin, -y1 - margin, x1 - x0 + 2 * margin, y1 - y0 + 2 * margin].map(number).join(" ");
  const width = 0.0035 * Math.hypot(x1 - x0, y1 - y0);
  const rows = [
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="${box}" width="1000">`,
    `<path d="${rings.map(path_data).join("")}" fill="#eef1f4" fill-rule="evenodd" stroke="#2a3442" stroke-width="${number(width / 2)}"/>`,
  ];
  if (scene.regions)
    rows.push(`<path d="${scene.regions.map(path_data).join("")}" fill="none" stroke="#c2571a" stroke-width="${number(width / 3)}"/>`);
  rows.push(`<g fill="none" stroke-linecap="round" stroke-width="${number(width)}"><desc>medial axis; largest radius ${number(deepest)}</desc>`);
  for (const [shade, d] of conics_of(scene.pieces ?? new Pieces(axis))) rows.push(`<path d="${d}" stroke="${ramp[shade]}"/>`);
  return `${rows.join("\n")}\n</g>\n</svg>\n`;
}

/** The shades that pieces of an axis have, each with its path data. */
export function conics_of({ begin, numbers }) {
  const shades = [];
  for (let shade = 0; shade + 1 < begin.length; ++shade) {
    if (begin[shade] === begin[shade + 1]) continue;
    let d = "";
    for (let k = 7 * begin[shade]; k < 7 * begin[shade + 1]; k += 7) d += conic_data(numbers.subarray(k, k + 7));
    shades.push([shade, d]);
  }
  return shades;
}

function conic_data([x0, y0, x, y, x1, y1, w]) {
  const at = (px, py) => `${number(px)} ${number(-py)}`;
  const bend = Math.hypot(x0 - 2 * x + x1, y0 - 2 * y + y1) / (Math.hypot(x1 - x0, y1 - y0) || 1);
  if (bend < 1e-6) return `M${at(x0, y0)}L${at(x1, y1)}`;
  if (Math.abs(w - 1) * bend < 1e-3) return `M${at(x0, y0)}Q${at(x, y)} ${at(x1, y1)}`;
  const d = 1 / (1 + w);
  const [ax, ay, bx, by] = [(x0 + w * x) * d, (y0 + w * y) * d, (w * x + x1) * d, (w * y + y1) * d];
  const [mx, my, half] = [(ax + bx) / 2, (ay + by) / 2, Math.sqrt((1 + w) / 2)];
  return conic_data([x0, y0, ax, ay, mx, my, half]) + conic_data([mx, my, bx, by, x1, y1, half]);
}

export function geojson_of({ shape, axis }) {
  const feature = (geometry, properties) => ({ type: "Feature", properties, geometry });
  const lines = axis.sample().map((line) => Array.from({ length: line.length / 3 }, (_, k) => [...line.subarray(3 * k, 3 * k + 3)]));
  const branches = lines.map((coordinates, branch) =>
    feature({ type: "LineString", coordinates: coordinates.map(([x, y]) => [x, y]) }, { part: "branch", branch, radius: coordinates.map(([, , r]) => r) }),
  );
  return JSON.stringify({ type: "FeatureCollection", features: [feature(shape.toGeoJSON(), { part: "shape" }), ...branches] });
}

export function wkt_of(rings) {
  const row = (ring) => {
    const points = outline(ring);
    return `(${[...points, points[0]].map(([x, y]) => `${number(x)} ${number(y)}`).join(", ")})`;
  };
  return `POLYGON (${rings.map(row).join(", ")})`;
}

export function save(name, content, type) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
