// The studio's state: the drawing, its axis, and what is shown. Every change asks for a frame; a frame
// computes what is out of date and draws. Where the axis follows edits (Live), an edit changes the drawing
// and the axis at once.

import { Camera } from "./camera.mjs";
import { nice_step, read_theme, ring_from } from "./draw.mjs";
import { Live } from "./live.mjs";
import { History, apply_edit, bounds_of, count_of, input_of, line_of, outline } from "./model.mjs";
import { Painter } from "./painter.mjs";
import { Pieces } from "./pieces.mjs";

/** Above this many vertices an axis that does not follow edits waits until the pointer rests. */
const LARGE = 30_000;
/** With more edges, overlays that need the whole axis are not computed during a drag. */
const MANY = 60_000;
const REST = 160; // milliseconds

export class Studio extends EventTarget {
  camera = new Camera();
  history = new History();
  settings = {
    method: "disks", exact: false, exterior: false, compare: "", measure: "prominence", threshold: 0,
    offset: 0, carve: 0, center: false, cells: false, field: false, disks: false, disk: true,
  };
  scene = { rings: [], show: { axis: true, vertices: true, grid: false }, fire: 0 };
  times = { axis: 0, frame: 0 };
  #dirty = new Set(["theme"]);
  #asked = false;
  #kept = null; // the axis and the shape of a drawing that does not follow edits
  #settled = null; // the rings after the last step of the history
  #edits = []; // since then, each with its inverse
  /** The axis that follows edits of the drawing as it is; null where none does. */
  live = null;
  /** The largest radius of the axis. */
  deepest = 0;

  constructor(canvas, medial) {
    super();
    this.canvas = canvas;
    this.painter = new Painter(() => this.ask());
    this.context = canvas.getContext("2d", { alpha: false });
    this.medial = medial;
    new ResizeObserver(([{ contentRect: { width, height } }]) => this.resize(width, height)).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.ask("theme"));
  }

  get rings() {
    return this.scene.rings;
  }

  get axis() {
    return this.#kept ? this.#kept.axis : (this.scene.live?.axis ?? null);
  }
  get shape() {
    return this.#kept ? this.#kept.shape : (this.scene.live?.axis.shape ?? null);
  }

  /** Shows rings; `done` makes it a step of the history. */
  change(rings, done = true) {
    if (done) this.#keep_edits();
    else for (const { inverse } of this.#edits.splice(0).reverse()) apply_edit(this.scene.rings, inverse);
    this.scene.rings = rings;
    this.#drop_live();
    this.ask("axis");
    if (done && this.#settled && rings !== this.#settled) this.history.add({ before: this.#settled, after: rings });
    if (done) this.#settle();
  }
  /** Makes the changes since the last step a step of the history. */
  done() {
    if (this.scene.rings !== this.#settled) return this.change(this.scene.rings);
    this.#keep_edits();
    this.#settle();
    this.ask("counts");
  }
  #settle() {
    this.#settled = this.scene.rings;
    this.emit("changed");
  }
  #keep_edits() {
    if (this.#edits.length) this.history.add({ edits: this.#edits });
    this.#edits = [];
  }
  /** Goes back to the last step. */
  cancel() {
    if (this.scene.rings !== this.#settled) return this.change(this.#settled, false);
    this.#replay(this.#edits.splice(0).reverse().map(({ inverse }) => inverse));
  }

  /**
   * Edits vertices, one after the other, where the axis can follow. False where it cannot, and nothing
   * happens. What makes edges cross is shown and not done: then no edit is.
   */
  edit(edits) {
    const { live } = this;
    if (!live || !edits.every((edit) => live.knows(edit))) return false;
    const begin = performance.now();
    const made = [];
    this.scene.error = this.scene.refused = null;
    try {
      for (const edit of edits) made.push(this.#follow(edit));
      this.#note(made);
    } catch (error) {
      if (!live.is_in_step) this.#drop_live();
      this.#replay(made.reverse().map(({ inverse }) => inverse));
      if (!(error instanceof this.medial.MedialError)) throw error;
      if (edits.length > 1 || !this.live) return false;
      this.scene.error = error;
      this.scene.refused = this.#around(edits[0]);
    }
    this.times.axis = performance.now() - begin;
    this.ask("edit");
    return true;
  }
  #follow(edit) {
    this.live.follow(edit);
    return { edit, inverse: apply_edit(this.scene.rings, edit) };
  }
  /**
   * Notes edits as made since the last step; of a vertex that moves on, where it began and where it is.
   * Rings that differ from those of the last step are a step as a whole.
   */
  #note(made) {
    if (this.scene.rings !== this.#settled) return;
    for (const one of made) {
      const last = this.#edits.at(-1);
      const goes_on = last && ["kind", "ring", "index"].every((name) => last.edit[name] === one.edit[name]);
      if (goes_on && ["move", "bend", "ring"].includes(one.edit.kind)) last.edit = { ...one.edit, by: undefined };
      else this.#edits.push(one);
    }
  }
  #around({ kind, ring, index, point, edge, xy: moved }) {
    const { xy } = this.scene.rings[ring];
    if (kind === "bend") return line_of(this.scene.rings[ring], index, edge);
    if (kind === "ring") return Array.from({ length: moved.length / 2 + 1 }, (_, i) => [0, 1].map((k) => moved[(2 * i + k) % moved.length]));
    const at = (i) => [xy.at((2 * i) % xy.length), xy.at((2 * i + 1) % xy.length)];
    const [before, after] = [at(index - 1), at(kind === "insert" ? index : index + 1)];
    return kind === "remove" ? [before, after] : [before, point, after];
  }

  #replay(edits) {
    for (const edit of edits) {
      this.#try_to_follow(edit);
      apply_edit(this.scene.rings, edit);
    }
    this.ask(this.live ? "edit" : "axis");
    this.ask("counts");
  }
  #try_to_follow(edit) {
    if (!this.live?.knows(edit)) return this.#drop_live();
    try {
      this.live.follow(edit);
    } catch (error) {
      if (!(error instanceof this.medial.MedialError)) throw error;
      this.#drop_live();
    }
  }
  #drop_live() {
    this.live = null;
    this.scene.refused = null;
  }
  undo() {
    if (this.dragging) return;
    this.cancel();
    this.#go(this.history.undo(), true);
  }
  redo() {
    if (this.dragging) return;
    this.cancel();
    this.#go(this.history.redo(), false);
  }
  #go(step, back) {
    if (!step) return;
    this.scene.error = this.scene.refused = null;
    if (!step.edits) this.change(back ? step.before : step.after, false);
    else if (back) this.#replay(step.edits.map(({ inverse }) => inverse).reverse());
    else this.#replay(step.edits.map(({ edit }) => edit));
    this.#settle();
  }
  set(name, value) {
    this.settings[name] = value;
    const whole = ["method", "exact", "exterior", "compare"].includes(name);
    this.ask(whole ? "axis" : "derived");
  }
  /** Shows the whole drawing, clear of the panels over the canvas. */
  fit() {
    const wide = innerWidth > 760;
    const panel = !document.body.classList.contains("no-panel");
    const right = wide && panel ? 296 : 12;
    const tour = document.getElementById("tour");
    let [low, left] = [wide ? 66 : panel ? innerHeight * 0.46 + 80 : 76, wide ? 66 : 60];
    if (tour?.hidden === false) {
      const box = tour.getBoundingClientRect();
      if (innerWidth - box.right - right > 400) left = box.right + 12;
      else low = innerHeight - box.top + 12;
    }
    const top = !wide && tour?.hidden === false ? 132 : 66; // below what a step of the tour says
    this.camera.fit(bounds_of(this.rings), [top, right, low, left]);
    this.ask();
  }
  emit(name, detail) {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }

  resize(width, height) {
    const ratio = Math.min(devicePixelRatio || 1, 3);
    const { camera, canvas, scene } = this;
    if (camera.width === width && camera.height === height && scene.ratio === ratio) return;
    Object.assign(camera, { width, height });
    scene.ratio = ratio;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    this.ask();
  }

  /** Asks for a frame in which `what` is computed again. */
  ask(what) {
    if (what) this.#dirty.add(what);
    if (this.#asked) return;
    this.#asked = true;
    requestAnimationFrame(() => {
      this.#asked = false;
      this.frame();
    });
  }

  frame() {
    const begin = performance.now();
    const dirty = new Set(this.#dirty);
    this.#dirty.clear();
    if (dirty.has("theme")) this.theme = read_theme();
    if (dirty.has("axis")) this.#axis_or_wait();
    else if (dirty.has("derived")) this.#derive();
    else if (dirty.has("edit") || dirty.has("counts")) this.#edited();
    this.scene.grid_step = nice_step(this.camera);
    const whole = ["theme", "axis", "derived"].some((what) => dirty.has(what)) || (dirty.has("edit") && Boolean(this.scene.pieces));
    this.painter.paint(this.context, this.scene, this.camera, this.theme, whole);
    this.times.frame = performance.now() - begin;
    this.emit("drawn", dirty);
  }

  #axis_or_wait() {
    clearTimeout(this.waiting);
    if (!this.dragging || count_of(this.rings) <= LARGE) return this.compute();
    this.scene.stale = true;
    this.waiting = setTimeout(() => {
      this.compute();
      this.ask();
    }, REST);
  }

  /** Computes the axis of the drawing. If it has none, the last axis stays, pale. */
  compute() {
    const begin = performance.now();
    try {
      this.#replace(this.rings.length ? this.#axis_of(this.rings) : null);
      this.scene.error = this.scene.refused = null;
      this.scene.stale = false;
    } catch (error) {
      if (!(error instanceof this.medial.MedialError)) throw error;
      this.#drop_live();
      this.scene.error = error;
      this.scene.stale = true;
    }
    this.times.axis = performance.now() - begin;
    this.emit("computed");
    this.#derive();
  }

  /** Whether the axis can follow edits. */
  get #follows() {
    const { method, exact, exterior } = this.settings;
    return method === "disks" && !exact && !exterior && this.rings.every(({ edges }) => ![...edges.values()].some(Array.isArray));
  }
  #axis_of(rings) {
    const { medial, settings } = this;
    if (this.#follows) return { live: new Live(medial, rings) };
    const { method, exact, exterior } = settings;
    const { x, options } = input_of(rings, medial);
    const shape = new medial.Shape(x, { ...options, keepContours: method === "curve-axis" || undefined });
    try {
      const given = { method, exact: exact || undefined, exterior: exterior || undefined };
      return { shape, axis: medial.axis(shape, own_options(given)) };
    } catch (error) {
      shape.free();
      throw error;
    }
  }

  #replace(next) {
    this.#kept?.axis.free();
    this.#kept?.shape.free();
    this.scene.live?.free();
    this.live = this.scene.live = next?.live ?? null;
    this.#kept = next?.axis ? next : null;
    this.deepest = this.live?.largest ?? 0;
    for (const r of this.#kept?.axis.nodes.radius ?? []) if (r > this.deepest) this.deepest = r;
  }

  /** After an edit that the axis has followed. */
  #edited() {
    if (!this.live) return;
    if (!this.dragging || this.#shows_more) this.live.find_largest();
    this.deepest = this.live.largest;
    this.emit("computed");
    if (this.#shows_more && !this.scene.error) return this.#derive();
    this.#count();
    this.emit("derived");
  }
  #count() {
    this.branches = this.dragging || this.live.count > MANY ? undefined : this.live.axis.branchCount;
  }
  /** Whether something is shown that needs the whole axis. */
  get #shows_more() {
    const { threshold, offset, carve, center, cells, field, disks, compare } = this.settings;
    return threshold > 0 || offset > 0 || carve > 0 || center || cells || field || disks || Boolean(compare);
  }

  /** Computes the overlays from the axis: the pruned part, offsets, cells and so on. */
  #derive() {
    const { scene, settings } = this;
    for (const name of ["whole", "pieces", "regions", "cells", "others", "carving", "field", "disks"]) scene[name] = null;
    if (this.live && !this.#shows_more) {
      this.#count();
      return this.emit("derived");
    }
    const { axis } = this;
    if (!axis) return;
    this.#attempt(() => this.#prune());
    if (scene.stale) return;
    if (settings.offset > 0) this.#attempt(() => this.#offsets());
    if (settings.carve > 0) this.#attempt(() => (scene.carving = this.medial.carve(axis, { angle: settings.carve })));
    if (settings.center) this.#attempt(() => this.#center_line());
    if (settings.cells) this.#attempt(() => this.#cells());
    if (settings.field) this.#attempt(() => this.#field());
    if (settings.disks) this.#attempt(() => this.#largest_disks());
    if (settings.compare) this.#attempt(() => this.#beside());
    this.emit("derived");
  }
  /** Leaves out overlays that an axis (of pixels, of the exterior) does not support, with a message. */
  #attempt(work) {
    try {
      work();
    } catch (error) {
      if (!(error instanceof this.medial.MedialError)) throw error;
      this.emit("said", error.text);
    }
  }

  #prune() {
    const { axis, scene, settings } = this;
    this.branches = axis.branchCount;
    if (!(settings.threshold > 0)) {
      scene.pieces = new Pieces(axis);
      return;
    }
    const pruned = axis.prune(settings.measure, settings.threshold);
    scene.pieces = new Pieces(pruned);
    scene.whole = new Pieces(axis, false);
    this.branches = pruned.branchCount;
    pruned.free();
  }
  #offsets() {
    const step = settings_distance(this);
    const distances = Array.from({ length: Math.min(200, Math.ceil(this.deepest / step)) }, (_, k) => step * (k + 1));
    const inside = this.settings.exterior ? this.shape : this.axis;
    this.scene.regions = this.medial.offset(inside, distances).flatMap((region) => region.rings.map(ring_from));
  }
  #center_line() {
    const pieces = this.medial.centerlines(this.axis).map((line) => new Pieces(line.axis));
    this.scene.others = pieces.map((one) => ({ pieces: one, alpha: 1 }));
    this.scene.whole = this.scene.pieces;
    this.scene.pieces = pieces[0] ?? null;
  }
  #cells() {
    const lines = this.rings.map((ring) => {
      const points = outline(ring);
      return [...points, points[0]];
    });
    const [x0, y0, x1, y1] = bounds_of(this.rings);
    const margin = 4 * Math.max(x1 - x0, y1 - y0); // beyond what a screen of any form shows
    const { edges } = this.medial.voronoi({ type: "MultiLineString", coordinates: lines }, { margin, chord: 0.3 / this.camera.scale });
    this.scene.cells = edges.filter((edge) => !edge.onEnclosure).map(({ line }) => line.map(([x, y]) => [x, y]));
  }
  #largest_disks() {
    this.scene.disks = this.medial.inscribedCircles(this.shape, 40, this.deepest / 12);
  }
  #beside() {
    const begin = performance.now();
    const other = this.medial.axis(this.shape, own_options({ method: this.settings.compare }));
    this.scene.others = [...(this.scene.others ?? []), { pieces: new Pieces(other), alpha: 0.9 }];
    this.emit("said", `${other.method}: ${other.edges.length} edges in ${(performance.now() - begin).toFixed(1)} ms`);
    other.free();
  }
  /** The logarithm of the potential on a grid, as an image in the colours of the axis. */
  #field() {
    const box = this.shape.bounds;
    const [w, h] = [box[2] - box[0], box[3] - box[1]];
    const [nx, ny] = w > h ? [110, Math.max(2, Math.round((110 * h) / w))] : [Math.max(2, Math.round((110 * w) / h)), 110];
    const points = new Float64Array(2 * nx * ny);
    for (let k = 0; k < nx * ny; ++k) {
      points[2 * k] = box[0] + (((k % nx) + 0.5) * w) / nx;
      points[2 * k + 1] = box[3] - ((Math.floor(k / nx) + 0.5) * h) / ny;
    }
    const field = this.medial.field(this.shape, 4);
    const values = field.sample(points).map(({ logPotential }) => logPotential);
    field.free();
    this.scene.field = { image: image_of(values, nx, ny, this.theme.ramp), box };
  }

  /** The maximal disk that touches the boundary nearest to a place of the plane. */
  disk_at(point) {
    if (this.live?.count > MANY) return this.live.nearest_disk(point, 12 / this.camera.scale);
    if (!this.axis || this.scene.stale || this.settings.exterior || this.axis.resolution) return null;
    const [clearance] = this.axis.edges.length < MANY ? this.axis.clearance([point]) : [1];
    if (!(clearance > 0)) return null;
    const place = this.axis.placeAt(point);
    return place && { ...this.axis.diskAt(place.edge, place.t), edge: place.edge };
  }

  certificate() {
    return this.medial.verify(this.axis);
  }
}

/** Adds a number of pixels for the methods on pixels, whose defaults do not suit a drawing. */
function own_options(given) {
  const pixels = { ridge: 500, brushfire: 400 }[given.method];
  return pixels ? { ...given, pixels } : given;
}

export const settings_distance = (studio) => studio.deepest * studio.settings.offset;

function image_of(values, width, height, ramp) {
  const known = values.filter(Number.isFinite).sort((a, b) => a - b);
  const [low, high] = [known[0], known[Math.floor(0.95 * (known.length - 1))]];
  const canvas = document.createElement("canvas");
  Object.assign(canvas, { width, height });
  const context = canvas.getContext("2d");
  values.forEach((value, k) => {
    if (!Number.isFinite(value)) return;
    const share = 1 - Math.min(1, Math.max(0, (value - low) / (high - low || 1)));
    context.fillStyle = ramp[Math.round(share * (ramp.length - 1))];
    context.globalAlpha = 0.55;
    context.fillRect(k % width, Math.floor(k / width), 1, 1);
  });
  return canvas;
}
