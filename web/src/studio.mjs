// The studio's state: the drawing, its axis, and what is shown. Every change asks for a frame; a frame
// computes what is out of date and draws.

import { Camera } from "./camera.mjs";
import { draw, nice_step, read_theme, ring_from } from "./draw.mjs";
import { History, bounds_of, count_of, input_of, outline } from "./model.mjs";
import { Pieces } from "./pieces.mjs";

/** Above this many vertices the axis waits until the pointer rests. */
const LIVE = 30_000;
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
  #kept = []; // what the module holds for this drawing

  constructor(canvas, medial) {
    super();
    this.canvas = canvas;
    this.context = canvas.getContext("2d", { alpha: false });
    this.medial = medial;
    new ResizeObserver(() => this.resize()).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.ask("theme"));
  }

  get rings() {
    return this.scene.rings;
  }

  /** Shows rings; `done` makes it a step of the history. */
  change(rings, done = true) {
    this.scene.rings = rings;
    if (done) this.history.add(rings);
    this.ask("axis");
    if (done) this.emit("changed");
  }
  undo() {
    this.history.undo();
    this.change(this.history.rings, false);
    this.emit("changed");
  }
  redo() {
    this.history.redo();
    this.change(this.history.rings, false);
    this.emit("changed");
  }
  set(name, value) {
    this.settings[name] = value;
    const whole = ["method", "exact", "exterior", "compare"].includes(name);
    this.ask(whole ? "axis" : "derived");
  }
  fit() {
    const wide = innerWidth > 760;
    const panel = !document.body.classList.contains("no-panel");
    const tour = !document.getElementById("tour").hidden;
    const low = wide ? 66 : panel ? innerHeight * 0.46 + 80 : tour ? innerHeight * 0.5 : 76;
    this.camera.fit(bounds_of(this.rings), [66, wide && panel ? 296 : 12, low, wide ? (tour ? 460 : 66) : 60]);
    this.ask();
  }
  emit(name, detail) {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }

  resize() {
    const { width, height } = this.canvas.getBoundingClientRect();
    this.scene.ratio = Math.min(devicePixelRatio || 1, 3);
    this.canvas.width = Math.round(width * this.scene.ratio);
    this.canvas.height = Math.round(height * this.scene.ratio);
    const first = this.camera.width === 1;
    Object.assign(this.camera, { width, height });
    if (first) this.fit();
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
    this.scene.grid_step = nice_step(this.camera);
    draw(this.context, this.scene, this.camera, this.theme);
    this.times.frame = performance.now() - begin;
    this.emit("drawn", dirty);
  }

  #axis_or_wait() {
    clearTimeout(this.waiting);
    if (!this.dragging || count_of(this.rings) <= LIVE) return this.compute();
    this.scene.stale = true;
    this.waiting = setTimeout(() => {
      this.compute();
      this.ask();
    }, REST);
  }

  /** Computes the axis of the drawing; what cannot have one keeps the last axis, pale. */
  compute() {
    const begin = performance.now();
    try {
      this.#replace(this.rings.length ? this.#axis_of(this.rings) : null);
      this.scene.error = null;
      this.scene.stale = false;
    } catch (error) {
      if (!(error instanceof this.medial.MedialError)) throw error;
      this.scene.error = error;
      this.scene.stale = true;
    }
    this.times.axis = performance.now() - begin;
    this.#derive();
    this.emit("computed");
  }

  #axis_of(rings) {
    const { medial, settings } = this;
    const { method, exact, exterior } = settings;
    const shape = method === "curve-axis" ? this.#smooth_shape(rings) : this.#shape_of(rings);
    try {
      const given = { method, exact: exact || undefined, exterior: exterior || undefined };
      return { shape, axis: medial.axis(shape, own_options(given)) };
    } catch (error) {
      shape.free();
      throw error;
    }
  }

  #shape_of(rings) {
    const { x, options } = input_of(rings, this.medial);
    return new this.medial.Shape(x, options);
  }
  /** What `curve-axis` follows: a curve without jumps of its curvature, near to the drawing. */
  #smooth_shape(rings) {
    const [x0, y0, x1, y1] = bounds_of(rings);
    const fit = 0.004 * Math.hypot(x1 - x0, y1 - y0);
    return new this.medial.Shape(rings.map((ring) => outline(ring).flat()), { keepContours: true, fit });
  }

  #replace(next) {
    this.#kept.forEach((object) => object.free());
    this.#kept = next ? [next.axis, next.shape] : [];
    this.axis = next?.axis ?? null;
    this.shape = next?.shape ?? null;
    this.deepest = 0;
    for (const r of this.axis?.nodes.radius ?? []) if (r > this.deepest) this.deepest = r;
  }

  /** What follows from the axis: the pruned part, offsets, cells and so on. */
  #derive() {
    const { scene, settings, axis } = this;
    for (const name of ["whole", "pieces", "regions", "cells", "others", "carving", "field", "disks"]) scene[name] = null;
    if (!axis) return;
    this.#attempt(() => this.#prune());
    if (scene.error) return;
    if (settings.offset > 0) this.#attempt(() => this.#offsets());
    if (settings.carve > 0) this.#attempt(() => (scene.carving = this.medial.carve(axis, { angle: settings.carve })));
    if (settings.center) this.#attempt(() => this.#center_line());
    if (settings.cells) this.#attempt(() => this.#cells());
    if (settings.field) this.#attempt(() => this.#field());
    if (settings.disks) this.#attempt(() => this.#largest_disks());
    if (settings.compare) this.#attempt(() => this.#beside());
    this.emit("derived");
  }
  /** What an axis cannot have (of pixels, of the exterior) is left out, and said. */
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
    const { edges } = this.medial.voronoi({ type: "MultiLineString", coordinates: lines }, { chord: 0.3 / this.camera.scale });
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
    if (!this.axis || this.scene.stale || this.settings.exterior || this.axis.resolution) return null;
    const [clearance] = this.axis.edges.length < 60_000 ? this.axis.clearance([point]) : [1];
    if (!(clearance > 0)) return null;
    const place = this.axis.placeAt(point);
    return place && { ...this.axis.diskAt(place.edge, place.t), edge: place.edge };
  }

  certificate() {
    return this.medial.verify(this.axis);
  }
}

/** Options of the methods that have none of their own that suit a drawing. */
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
