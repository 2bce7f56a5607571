// Draws the scene: the shape, the overlays that are switched on, the axis, and the item under the pointer.

import { arc_of, next_of, point_of, size_of } from "./model.mjs";
import { SHADES, add_part, clipped, conic } from "./pieces.mjs";
import { ramp_of } from "./poster.mjs";

const FAR = 2e4; // pixels beyond which a canvas loses digits

/** Colours of the style sheet, read again when light changes to dark. */
export function read_theme() {
  const style = getComputedStyle(document.documentElement);
  const get = (name) => style.getPropertyValue(`--${name}`).trim();
  const names = ["paper", "grid", "fill", "ink", "faint", "accent", "warm", "disk", "disk-line", "fire", "offset", "error"];
  const theme = Object.fromEntries(names.map((name) => [name, get(name)]));
  theme.ramp = ramp_of(get("ramp"));
  return theme;
}

/** Adds a ring to a path; if several points are in one pixel, only the first one is drawn. */
export function trace_ring(path, ring, camera) {
  const { cx, cy, dx, dy, scale } = camera.transform;
  const { xy, edges } = ring;
  const n = size_of(ring);
  const on_screen = (k) => [(xy[2 * k] - cx) * scale + dx, (cy - xy[2 * k + 1]) * scale + dy];
  let [px, py] = on_screen(0);
  if (far_ring(ring, camera)) return trace_far(path, ring, camera);
  path.moveTo(px, py);
  for (let i = 0; i < n; ++i) {
    const j = i + 1 < n ? i + 1 : 0;
    const x = (xy[2 * j] - cx) * scale + dx;
    const y = (cy - xy[2 * j + 1]) * scale + dy;
    const edge = edges.size ? edges.get(i) : undefined;
    if (edge === undefined) {
      if (Math.abs(x - px) + Math.abs(y - py) < 0.4 && j !== 0) continue;
      path.lineTo(x, y);
    } else if (typeof edge === "number") {
      const arc = arc_of(point_of(ring, i), point_of(ring, j), edge);
      const [ax, ay] = camera.toScreen(arc.cx, arc.cy);
      path.arc(ax, ay, arc.radius * scale, -arc.begin, -arc.begin - arc.angle, arc.angle > 0);
    } else {
      path.bezierCurveTo(...camera.toScreen(edge[0], edge[1]), ...camera.toScreen(edge[2], edge[3]), x, y);
    }
    [px, py] = [x, y];
  }
  path.closePath();
}

function far_ring(ring, camera) {
  if (camera.magnification < 20) return false;
  const { xy } = ring;
  for (let k = 0; k < xy.length; k += 2) {
    const [x, y] = camera.toScreen(xy[k], xy[k + 1]);
    if (Math.abs(x) > FAR || Math.abs(y) > FAR) return true;
  }
  return false;
}

/** The same for a ring that extends far beyond the screen: clips it to a box (Sutherland, Hodgman). */
function trace_far(path, ring, camera) {
  let points = flat_outline(ring, camera);
  const pad = 100;
  const sides = [
    [0, -pad, 1], [0, camera.width + pad, -1], [1, -pad, 1], [1, camera.height + pad, -1],
  ];
  for (const [d, limit, sign] of sides) {
    const inside = (p) => sign * (p[d] - limit) >= 0;
    const next = [];
    points.forEach((p, i) => {
      const q = points[(i + 1) % points.length];
      if (inside(p)) next.push(p);
      if (inside(p) === inside(q)) return;
      const t = (limit - p[d]) / (q[d] - p[d]);
      next.push(p.map((v, k) => (k === d ? limit : v + t * (q[k] - v))));
    });
    points = next;
    if (!points.length) return;
  }
  points.forEach(([x, y], i) => (i ? path.lineTo(x, y) : path.moveTo(x, y)));
  path.closePath();
}

/** Points on the screen. Bent edges become chords, which are finer at a higher zoom. */
function flat_outline(ring, camera) {
  const points = [];
  for (let i = 0; i < size_of(ring); ++i) {
    const [a, b] = [point_of(ring, i), point_of(ring, next_of(ring, i))];
    points.push(camera.toScreen(...a));
    const edge = ring.edges.get(i);
    if (edge === undefined) continue;
    const count = 512;
    const arc = typeof edge === "number" ? arc_of(a, b, edge) : null;
    for (let k = 1; k < count; ++k) {
      const t = k / count;
      const s = 1 - t;
      if (arc) {
        const at = arc.begin + t * arc.angle;
        points.push(camera.toScreen(arc.cx + arc.radius * Math.cos(at), arc.cy + arc.radius * Math.sin(at)));
      } else {
        const w = [s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t];
        const at = (d) => w[0] * a[d] + w[1] * edge[d] + w[2] * edge[2 + d] + w[3] * b[d];
        points.push(camera.toScreen(at(0), at(1)));
      }
    }
  }
  return points;
}

/** A ring of the library, points with bulges, as a ring to draw. */
export function ring_from({ points, bulges }) {
  const xy = Float64Array.from(points.flat());
  const edges = new Map();
  bulges.forEach((bulge, i) => bulge && edges.set(i, bulge));
  return { xy, edges };
}

function draw_grid(c, camera, theme, step) {
  const [x0, y0, x1, y1] = camera.view;
  c.strokeStyle = theme.grid;
  c.lineWidth = 1;
  c.beginPath();
  for (let x = Math.ceil(x0 / step) * step; x <= x1; x += step) {
    const [px] = camera.toScreen(x, 0);
    c.moveTo(Math.round(px) + 0.5, 0);
    c.lineTo(Math.round(px) + 0.5, camera.height);
  }
  for (let y = Math.ceil(y0 / step) * step; y <= y1; y += step) {
    const [, py] = camera.toScreen(0, y);
    c.moveTo(0, Math.round(py) + 0.5);
    c.lineTo(camera.width, Math.round(py) + 0.5);
  }
  c.stroke();
}

/** A step of 1, 2 or 5 by a power of ten, about `pixels` wide on the screen. */
export function nice_step(camera, pixels = 48) {
  const wanted = pixels / camera.scale;
  const power = 10 ** Math.floor(Math.log10(wanted));
  return power * ([1, 2, 5].find((f) => f * power >= wanted) ?? 10);
}

function draw_pieces(c, pieces, camera, theme, width, alpha = 1) {
  c.globalAlpha = alpha;
  c.lineWidth = width;
  c.lineCap = "round";
  for (let shade = 0; shade < SHADES; ++shade) {
    if (pieces.begin[shade] === pieces.begin[shade + 1]) continue;
    c.strokeStyle = theme.ramp[shade];
    c.beginPath();
    pieces.trace(c, shade, camera);
    c.stroke();
  }
  c.globalAlpha = 1;
}

function draw_regions(c, regions, camera, theme) {
  c.strokeStyle = theme.offset;
  c.lineWidth = 1.25;
  c.beginPath();
  for (const ring of regions) trace_ring(c, ring, camera);
  c.stroke();
}

function draw_lines(c, lines, camera, colour, width) {
  c.strokeStyle = colour;
  c.lineWidth = width;
  c.beginPath();
  for (const line of lines) {
    for (let k = 0; k + 1 < line.length; ++k) {
      const part = clipped(...camera.toScreen(...line[k]), ...camera.toScreen(...line[k + 1]), -50, -50, camera.width + 50, camera.height + 50);
      if (!part) continue;
      c.moveTo(part[0], part[1]);
      c.lineTo(part[2], part[3]);
    }
  }
  c.stroke();
}

export function draw_disk(c, disk, camera, theme) {
  const [x, y] = camera.toScreen(disk.x, disk.y);
  const r = disk.radius * camera.scale;
  if (r > 5e5) return;
  c.beginPath();
  c.arc(x, y, Math.max(r, 0.5), 0, 2 * Math.PI);
  c.fillStyle = theme.disk;
  c.fill();
  c.strokeStyle = theme["disk-line"];
  c.lineWidth = 1.5;
  c.stroke();
  c.beginPath();
  for (const foot of disk.feet ?? []) {
    c.moveTo(x, y);
    c.lineTo(...camera.toScreen(...foot));
  }
  c.setLineDash([3, 3]);
  c.lineWidth = 1;
  c.stroke();
  c.setLineDash([]);
  dot(c, x, y, 3, theme["disk-line"]);
  for (const foot of disk.feet ?? []) dot(c, ...camera.toScreen(...foot), 3.5, theme["disk-line"], theme.paper);
}

function dot(c, x, y, r, fill, ring) {
  c.beginPath();
  c.arc(x, y, r, 0, 2 * Math.PI);
  c.fillStyle = fill;
  c.fill();
  if (!ring) return;
  c.lineWidth = 1.5;
  c.strokeStyle = ring;
  c.stroke();
}

const MOST_DOTS = 750;

/** Vertices in view; none where there are too many. */
function vertices_in_view({ rings, live, stale }, camera) {
  const seen = [];
  const [x0, y0, x1, y1] = camera.view;
  const add = (x, y) => x >= x0 && x <= x1 && y >= y0 && y <= y1 && seen.push(x, y);
  if (live?.has_all && !stale && live.boundary.share([x0, y0, x1, y1]) < 1 / 16) {
    live.boundary.find([x0, y0, x1, y1], (v) => seen.length <= 2 * MOST_DOTS && add(live.x[v], live.y[v]));
    return seen;
  }
  for (const { xy } of rings)
    for (let k = 0; k < xy.length && seen.length <= 2 * MOST_DOTS; k += 2) add(xy[k], xy[k + 1]);
  return seen;
}

function draw_vertices(c, scene, camera, theme) {
  const { rings, hot } = scene;
  const seen = vertices_in_view(scene, camera);
  if (seen.length <= 2 * MOST_DOTS) {
    const size = seen.length > 500 ? 1.6 : 2.6;
    let last = [-99, -99];
    for (let i = 0; i < seen.length; i += 2) {
      const [x, y] = camera.toScreen(seen[i], seen[i + 1]);
      if (Math.hypot(x - last[0], y - last[1]) < 3 * size) continue; // dots would cover the line
      last = [x, y];
      dot(c, x, y, size, theme.paper, theme.ink);
    }
  }
  if (!hot || !rings[hot.ring]) return;
  const ring = rings[hot.ring];
  if (hot.kind === "edge") {
    c.beginPath();
    draw_edge(c, ring, hot.index, camera);
    c.strokeStyle = theme.accent;
    c.lineWidth = 3;
    c.stroke();
  }
  if (hot.kind === "vertex") dot(c, ...camera.toScreen(...point_of(ring, hot.index)), 5.5, theme.accent, theme.paper);
  if (hot.handles) for (const { at } of hot.handles) dot(c, ...camera.toScreen(...at), 4.5, theme.paper, theme.accent);
}

function draw_edge(c, ring, i, camera) {
  const j = next_of(ring, i);
  const edge = ring.edges.get(i);
  const [a, b] = [camera.toScreen(...point_of(ring, i)), camera.toScreen(...point_of(ring, j))];
  c.moveTo(...a);
  if (edge === undefined) c.lineTo(...b);
  else if (typeof edge === "number") {
    const arc = arc_of(point_of(ring, i), point_of(ring, j), edge);
    c.arc(...camera.toScreen(arc.cx, arc.cy), arc.radius * camera.scale, -arc.begin, -arc.begin - arc.angle, arc.angle > 0);
  } else c.bezierCurveTo(...camera.toScreen(edge[0], edge[1]), ...camera.toScreen(edge[2], edge[3]), ...b);
}

function draw_draft(c, draft, camera, theme) {
  if (!draft?.points.length) return;
  c.beginPath();
  draft.points.forEach((p, i) => (i ? c.lineTo(...camera.toScreen(...p)) : c.moveTo(...camera.toScreen(...p))));
  if (draft.closed) c.closePath();
  c.strokeStyle = theme.accent;
  c.lineWidth = 2;
  c.stroke();
  if (!draft.dots) return;
  for (const p of draft.points) dot(c, ...camera.toScreen(...p), 3, theme.paper, theme.accent);
}

function draw_error(c, point, camera, theme) {
  const [x, y] = camera.toScreen(...point);
  c.strokeStyle = theme.error;
  c.lineWidth = 2.5;
  c.beginPath();
  c.arc(x, y, 11, 0, 2 * Math.PI);
  c.moveTo(x - 4, y - 4);
  c.lineTo(x + 4, y + 4);
  c.moveTo(x + 4, y - 4);
  c.lineTo(x - 4, y + 4);
  c.stroke();
}

/** The area that has not burnt yet: points of the shape further from the boundary than the fire. */
function draw_fire(c, scene, camera, theme, shape) {
  c.save();
  c.clip(shape, "evenodd");
  c.strokeStyle = theme.fire;
  c.lineJoin = "round";
  c.lineWidth = 2 * scene.fire * camera.scale;
  c.stroke(shape);
  c.restore();
}

/** Everything that stays the same while the pointer moves: the shape, its axis, and the overlays. */
export function draw_base(c, scene, camera, theme) {
  c.fillStyle = theme.paper;
  c.fillRect(0, 0, camera.width, camera.height);
  if (scene.show.grid) draw_grid(c, camera, theme, scene.grid_step);
  const shape = new Path2D();
  for (const ring of scene.rings) trace_ring(shape, ring, camera);
  c.fillStyle = theme.fill;
  c.fill(shape, "evenodd");
  if (scene.field) draw_field(c, scene.field, camera, shape);
  if (scene.fire > 0) draw_fire(c, scene, camera, theme, shape);
  if (scene.cells) draw_lines(c, scene.cells, camera, theme.faint, 1);
  if (scene.regions) draw_regions(c, scene.regions, camera, theme);
  if (scene.carving) draw_carving(c, scene.carving, camera, theme);
  if (scene.whole) draw_pieces(c, scene.whole, camera, theme, 1, 0.28);
  if (scene.pieces && scene.show.axis) draw_pieces(c, scene.pieces, camera, theme, scene.pieces.numbers.length > 7e5 ? 1 : 2.25, scene.stale ? 0.25 : 1);
  if (scene.live && !scene.pieces && scene.show.axis) draw_axis(c, scene.live, camera, theme, [0, 0, camera.width, camera.height], scene.stale ? 0.25 : 1);
  for (const { pieces, alpha } of scene.others ?? []) draw_pieces(c, pieces, camera, theme, 1.25, alpha);
  outline_style(c, theme, scene.live);
  c.stroke(shape);
}
function outline_style(c, theme, live) {
  c.strokeStyle = theme.ink;
  c.lineWidth = 1.5;
  c.lineJoin = live?.count > 12_000 ? "bevel" : "round";
  c.lineCap = "butt";
}

/** A part of the screen where the axis follows edits and nothing else is shown. */
export function draw_part(c, scene, camera, theme, part) {
  const [left, top, right, bottom] = part;
  c.fillStyle = theme.paper;
  c.fillRect(left, top, right - left, bottom - top);
  if (scene.show.grid) draw_grid(c, camera, theme, scene.grid_step);
  const { fill, line } = trace_part(scene.live, camera, part);
  c.fillStyle = theme.fill;
  c.fill(fill, "evenodd");
  if (scene.show.axis) draw_axis(c, scene.live, camera, theme, part, 1);
  outline_style(c, theme, scene.live);
  c.stroke(line);
}

/** The item under the pointer, and the ring that is being drawn. */
export function draw_over(c, scene, camera, theme) {
  for (const disk of scene.disks ?? []) draw_disk(c, disk, camera, theme);
  if (scene.show.vertices) draw_vertices(c, scene, camera, theme);
  draw_draft(c, scene.draft, camera, theme);
  if (scene.refused) draw_refused(c, scene.refused, camera, theme);
  if (scene.error?.point) draw_error(c, scene.error.point, camera, theme);
}

/** The edges that an edit would have made. */
function draw_refused(c, points, camera, theme) {
  c.strokeStyle = theme.error;
  c.lineWidth = 1.5;
  c.setLineDash([4, 4]);
  c.beginPath();
  points.forEach((p, i) => (i ? c.lineTo(...camera.toScreen(...p)) : c.moveTo(...camera.toScreen(...p))));
  c.stroke();
  c.setLineDash([]);
}

// The axis that follows edits.

/** The lines of an axis with `count` edges: their width, and whether their ends are round. */
const lines_of = (count) => [count > 100_000 ? 1 : count > 12_000 ? 1.5 : 2.25, count > 12_000 ? "butt" : "round"];
let covered = new Uint8Array(0); // half pixels that have a short piece

/**
 * The edges in a part of the screen by their shades, as numbers of conics on the screen. Of pieces
 * shorter than half a pixel one is drawn in each half pixel. Of edges that are smaller than a pixel, few
 * are looked at in each.
 */
function conics_in(live, camera, part) {
  const [left, top, right, bottom] = part;
  const { rows, radii } = live;
  const { cx, cy, dx, dy, scale } = camera.transform;
  const factor = (SHADES - 1) / (live.largest || 1);
  const shades = Array.from({ length: SHADES }, () => []);
  const wide = 2 * Math.ceil(right - left + 10);
  const tall = 2 * Math.ceil(bottom - top + 10);
  if (covered.length < wide * tall) covered = new Uint8Array(wide * tall);
  covered.fill(0, 0, wide * tall);
  const parts_of = [];
  const shades_of = [];
  const add = (e) => {
    const k = 7 * e;
    const x0 = (rows[k] - cx) * scale + dx;
    const y0 = (cy - rows[k + 1]) * scale + dy;
    const x = (rows[k + 2] - cx) * scale + dx;
    const y = (cy - rows[k + 3]) * scale + dy;
    const x1 = (rows[k + 4] - cx) * scale + dx;
    const y1 = (cy - rows[k + 5]) * scale + dy;
    if (Math.max(x0, x1, x) < left - 4 || Math.min(x0, x1, x) > right + 4) return;
    if (Math.max(y0, y1, y) < top - 4 || Math.min(y0, y1, y) > bottom + 4) return;
    const r0 = radii[3 * e];
    const r1 = radii[3 * e + 2];
    const size = Math.max(Math.abs(x1 - x0), Math.abs(y1 - y0), Math.abs(x - x0), Math.abs(y - y0));
    const into = shades[Math.min(SHADES - 1, Math.round(((r0 + r1) / 2) * factor))];
    if (size < 0.5) {
      const at = Math.floor(2 * (y0 - top + 5)) * wide + Math.floor(2 * (x0 - left + 5));
      if (covered[at]) return;
      covered[at] = 1;
      const reach = 0.3 / (size || 1);
      const [mx, my, ux, uy] = [(x0 + x1) / 2, (y0 + y1) / 2, size ? (x1 - x0) * reach : 0.3, (y1 - y0) * reach];
      into.push(mx - ux, my - uy, mx, my, mx + ux, my + uy, 1);
      return;
    }
    const parts = Math.min(24, size / 4, (Math.abs(r0 - r1) * factor) / 1.5);
    if (!(parts > 1)) {
      into.push(x0, y0, x, y, x1, y1, rows[k + 6]);
      return;
    }
    const count = Math.ceil(parts);
    const curve = [x0, y0, r0, x, y, radii[3 * e + 1], x1, y1, r1, rows[k + 6]];
    parts_of.length = shades_of.length = 0;
    for (let i = 0; i < count; ++i) add_part(parts_of, shades_of, curve, i / count, (i + 1) / count, factor);
    shades_of.forEach((shade, i) => shades[Math.min(SHADES - 1, Math.max(0, Math.round(shade)))].push(...parts_of.slice(7 * i, 7 * i + 7)));
  };
  const box = box_of(camera, part, 4);
  const [pixel, few] = [1, 4];
  if (live.edges.finest * scale < pixel) live.edges.find(box, add, few);
  else if (live.edges.share(box) < 1 / 16) live.edges.find(box, add);
  else for (let e = 0; e < live.edges.room; ++e) if (live.edges.has(e)) add(e);
  return shades;
}
/** A part of the screen in the plane, with a margin in pixels. */
function box_of(camera, [left, top, right, bottom], margin) {
  const [x0, y1] = camera.toPlane(left - margin, top - margin);
  const [x1, y0] = camera.toPlane(right + margin, bottom + margin);
  return [x0, y0, x1, y1];
}

function draw_axis(c, live, camera, theme, part, alpha) {
  c.globalAlpha = alpha;
  [c.lineWidth, c.lineCap] = lines_of(live.count);
  conics_in(live, camera, part).forEach((numbers, shade) => {
    if (!numbers.length) return;
    c.strokeStyle = theme.ramp[shade];
    c.beginPath();
    for (let k = 0; k < numbers.length; k += 7)
      conic(c, numbers[k], numbers[k + 1], numbers[k + 2], numbers[k + 3], numbers[k + 4], numbers[k + 5], numbers[k + 6], camera.width + 4, camera.height + 4);
    c.stroke();
  });
  c.globalAlpha = 1;
}

/**
 * The inside the shape in a part of the screen, by the even-odd rule, and the boundary there. Each chain
 * of edges bounds an area that reaches far to the left, which counts where an edge lies on the right of a
 * point; where the boundary leaves the part on its right side, the rest of that side changes sides as well.
 */
function trace_part(live, camera, part) {
  const [left, top, right, bottom] = part.map((side, i) => side + (i < 2 ? -4 : 4));
  const far = left - 10;
  const tracer = new Tracer(far);
  const { next, before } = live;
  const { cx, cy, dx, dy, scale } = camera.transform;
  const { fill } = tracer;
  if (live.inside(...camera.toPlane(right, top), scale)) fill.rect(far, top, right - far, bottom - top);
  const add = (x0, y0, x1, y1) => {
    const ax = (x0 - cx) * scale + dx;
    const ay = (cy - y0) * scale + dy;
    const bx = (x1 - cx) * scale + dx;
    const by = (cy - y1) * scale + dy;
    const is_far = Math.max(Math.abs(ax), Math.abs(ay), Math.abs(bx), Math.abs(by)) > FAR;
    if (!is_far && ax <= right && bx <= right) return tracer.edge(ax, ay, bx, by);
    const inner = clipped(ax, ay, bx, by, far, top, right, bottom);
    tracer.end();
    if (inner) tracer.edge(...inner);
    tracer.end();
    if (ax > right === bx > right) return;
    const at = ay + ((right - ax) / (bx - ax)) * (by - ay);
    if (at > top && at < bottom) fill.rect(far, at, right - far, bottom - at);
  };
  const found = live.in_box(box_of(camera, part, 4));
  const walk = (first) => {
    for (let v = first; live.take(v); v = next[v]) {
      if (live.bulge[v] === 0) {
        add(live.x[v], live.y[v], live.x[next[v]], live.y[next[v]]);
        continue;
      }
      const line = live.edge(v, scale);
      for (let k = 0; k + 2 < line.length; k += 2) add(line[k], line[k + 1], line[k + 2], line[k + 3]);
    }
    tracer.end();
  };
  for (const v of found) if (!live.is_found(before[v])) walk(v);
  for (const v of found) walk(v); // loops that lie inside as a whole
  return tracer;
}

/** Chains of edges as paths; if several points are in one pixel, only the first one is drawn. */
class Tracer {
  fill = new Path2D();
  line = new Path2D();
  #open = false;

  constructor(far) {
    this.far = far;
  }
  edge(ax, ay, bx, by) {
    if (!this.#open) {
      this.#open = true;
      this.#put(ax, ay, true);
    }
    [this.x, this.y] = [bx, by];
    if (Math.abs(bx - this.px) + Math.abs(by - this.py) >= 0.4) this.#put(bx, by, false);
  }
  #put(x, y, is_first) {
    if (is_first) {
      this.fill.moveTo(this.far, y);
      this.line.moveTo(x, y);
    } else this.line.lineTo(x, y);
    this.fill.lineTo(x, y);
    [this.px, this.py] = [x, y];
  }
  end() {
    if (!this.#open) return;
    this.#put(this.x, this.y, false);
    this.fill.lineTo(this.far, this.y);
    this.fill.closePath();
    this.#open = false;
  }
}

function draw_field(c, field, camera, shape) {
  c.save();
  c.clip(shape, "evenodd");
  const [x0, y0, x1, y1] = field.box;
  const [left, top] = camera.toScreen(x0, y1);
  c.imageSmoothingEnabled = true;
  c.drawImage(field.image, left, top, (x1 - x0) * camera.scale, (y1 - y0) * camera.scale);
  c.restore();
}

function draw_carving(c, carving, camera, theme) {
  for (const { kind, points } of carving.paths)
    draw_lines(c, [points.map(([x, y]) => [x, y])], camera, kind === "clearing" ? theme.faint : theme.warm, kind === "groove" ? 2 : 1.25);
}
