// Paints frames. What stays while the pointer moves is kept in a layer; of it only the tiles are drawn
// again in which the axis has changed, or which come into view. Where a whole frame takes long, a view
// that moves shows the old layer, shifted, and is drawn when it rests.

import { draw_base, draw_over, draw_part } from "./draw.mjs";

const TILE = 48; // pixels of the layer
const SLOW = 45; // milliseconds from one frame to the next
const REST = 120;

export class Painter {
  #layer = document.createElement("canvas");
  #drawn = null; // the state that the layer shows
  #cost = 0;
  /** How often the layer was drawn as a whole, how many parts of it, and the pixels of these. */
  counts = { wholes: 0, parts: 0, pixels: 0 };

  /** `redraw`: asks for another frame. */
  constructor(redraw) {
    this.context = this.#layer.getContext("2d", { alpha: false });
    this.redraw = redraw;
  }

  /** `whole`: other parts than the view and the changes in `scene.live` are out of date. */
  paint(c, scene, camera, theme, whole) {
    const { show, fire, stale, grid_step } = scene;
    const key = JSON.stringify([c.canvas.width, c.canvas.height, camera.width, show, fire, stale, show.grid && grid_step]);
    const ratio = scene.ratio ?? 1;
    const changes = scene.live && !scene.stale ? scene.live.changed : [];
    whole ||= !this.#drawn || this.#drawn.key !== key || !changes || (changes.length > 0 && !can_part(scene));
    const move = whole ? null : move_of(this.#drawn.transform, camera.transform);
    if (whole) this.#draw_all(c, scene, camera, theme, ratio, key);
    else if (move.scale !== 1 || move.x || move.y) this.#draw_moved(c, scene, camera, theme, ratio, key, move, changes.length > 0);
    else {
      this.moved = null;
      if (changes.length) this.#draw_tiles(scene, camera, theme, ratio, changes);
    }
    this.#show(c, this.moved, ratio);
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    draw_over(c, scene, camera, theme);
  }

  #show(c, move, ratio) {
    c.setTransform(1, 0, 0, 1, 0, 0);
    if (move) {
      c.fillStyle = this.paper;
      c.fillRect(0, 0, c.canvas.width, c.canvas.height);
      c.setTransform(move.scale, 0, 0, move.scale, move.x * ratio, move.y * ratio);
    }
    c.drawImage(this.#layer, 0, 0);
  }

  #draw_all(c, scene, camera, theme, ratio, key) {
    const begin = performance.now();
    ++this.counts.wholes;
    const { width, height } = c.canvas;
    if (this.#layer.width !== width) this.#layer.width = width;
    if (this.#layer.height !== height) this.#layer.height = height;
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    clearTimeout(this.resting);
    if (can_part(scene) && is_near(scene.live, camera))
      draw_part(this.context, scene, camera, theme, [0, 0, camera.width, camera.height]);
    else draw_base(this.context, scene, camera, theme);
    if (scene.live) scene.live.changed = [];
    this.#drawn = { key, transform: camera.transform };
    this.paper = theme.paper;
    this.moved = null;
    requestAnimationFrame(() => (this.#cost = performance.now() - begin)); // until it is on the screen
  }

  /** Updates the layer after the view has moved. If it moved by whole pixels, most of the layer stays. */
  #draw_moved(c, scene, camera, theme, ratio, key, move, is_edited) {
    const [dx, dy] = [move.x * ratio, move.y * ratio];
    const is_whole = move.scale === 1 && [dx, dy].every((d) => Math.abs(d - Math.round(d)) < 0.01);
    const { width, height } = this.#layer;
    if (is_whole && can_part(scene) && Math.abs(dx) < width && Math.abs(dy) < height) {
      this.#shift(scene, camera, theme, ratio, Math.round(dx), Math.round(dy));
      return;
    }
    const is_quick = this.#cost < SLOW || (can_part(scene) && is_near(scene.live, camera));
    if (is_quick || is_edited) return this.#draw_all(c, scene, camera, theme, ratio, key);
    const is_resting = this.moved && ["scale", "x", "y"].every((name) => this.moved[name] === move[name]);
    if (is_resting) return;
    this.moved = move;
    clearTimeout(this.resting);
    this.resting = setTimeout(() => {
      this.#drawn = null;
      this.redraw();
    }, REST);
  }

  #shift(scene, camera, theme, ratio, dx, dy) {
    const { context } = this;
    const { width, height } = this.#layer;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(this.#layer, dx, dy);
    this.#drawn.transform = camera.transform;
    this.moved = null;
    const parts = [];
    if (dx) parts.push(dx > 0 ? [0, 0, dx, height] : [width + dx, 0, width, height]);
    if (dy) parts.push(dy > 0 ? [0, 0, width, dy] : [0, height + dy, width, height]);
    for (const part of parts) this.#draw_part(scene, camera, theme, ratio, part);
    if (scene.live.changed.length) this.#draw_tiles(scene, camera, theme, ratio, scene.live.changed);
  }

  #draw_tiles(scene, camera, theme, ratio, changes) {
    for (const part of parts_of(changes, camera, ratio, this.#layer)) this.#draw_part(scene, camera, theme, ratio, part);
    scene.live.changed = [];
  }

  #draw_part(scene, camera, theme, ratio, [left, top, right, bottom]) {
    const { context, counts } = this;
    ++counts.parts;
    counts.pixels += (right - left) * (bottom - top);
    context.save();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.beginPath();
    context.rect(left, top, right - left, bottom - top);
    context.clip();
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    draw_part(context, scene, camera, theme, [left, top, right, bottom].map((side) => side / ratio));
    context.restore();
  }
}

/** Whether few enough edges are in view to search for them by place. */
const is_near = (live, camera) => live.boundary.share(camera.view) < 1 / 16;

/** Whether parts can be drawn alone: the axis follows edits, and no overlay is shown. */
function can_part(scene) {
  const { live, stale, fire, field, cells, regions, carving, whole, pieces, others } = scene;
  return live && !stale && !fire && !field && !cells && !regions && !carving && !whole && !pieces && !others?.length;
}

/** The map of screen positions from one view to another: scale, then shift. */
function move_of(from, to) {
  const scale = to.scale / from.scale;
  return {
    scale,
    x: to.dx - from.dx * scale + (from.cx - to.cx) * to.scale,
    y: to.dy - from.dy * scale + (to.cy - from.cy) * to.scale,
  };
}

/** The tiles that changes touch, as rectangles of the layer. */
function parts_of(changes, camera, ratio, { width, height }) {
  const [columns, rows] = [Math.ceil(width / TILE), Math.ceil(height / TILE)];
  const touched = new Uint8Array(columns * rows);
  const { cx, cy, dx, dy, scale } = camera.transform;
  const margin = 4;
  for (let k = 0; k < changes.length; k += 4) {
    const column = (x, side) => Math.floor((((x - cx) * scale + dx + side * margin) * ratio) / TILE);
    const row = (y, side) => Math.floor((((cy - y) * scale + dy + side * margin) * ratio) / TILE);
    const [left, right] = [Math.max(0, column(changes[k], -1)), Math.min(columns - 1, column(changes[k + 2], 1))];
    const [top, bottom] = [Math.max(0, row(changes[k + 3], -1)), Math.min(rows - 1, row(changes[k + 1], 1))];
    for (let r = top; r <= bottom; ++r) touched.fill(1, r * columns + left, r * columns + Math.max(left, right + 1));
  }
  const parts = [];
  for (let r = 0; r < rows; ++r)
    for (let first = 0; first < columns; ++first) {
      if (!touched[r * columns + first]) continue;
      let last = first;
      while (last + 1 < columns && touched[r * columns + last + 1]) ++last;
      let low = r;
      const is_run = (at) => touched.subarray(at * columns + first, at * columns + last + 1).every(Boolean);
      while (low + 1 < rows && is_run(low + 1)) touched.fill(0, ++low * columns + first, low * columns + last + 1);
      parts.push([first, r, last + 1, low + 1].map((side, i) => Math.min(side * TILE, i % 2 ? height : width)));
      first = last;
    }
  return parts;
}
