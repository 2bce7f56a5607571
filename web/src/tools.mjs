// The pointer and the keyboard: drawing, dragging, panning, zooming.

import { nice_step } from "./draw.mjs";
import {
  arc_of, contains, count_of, moved_edge, moved_ring, moved_vertex, next_of, point_of, ring_of, samples, size_of,
  with_bend, with_curve, with_edge, with_vertex, without_vertex,
} from "./model.mjs";
import { smooth_ring } from "./freehand.mjs";

const HINTS = {
  select: "Drag a vertex, an edge, or the dot that bends it; double-click inserts or removes a vertex, on a dot it makes a curve",
  polygon: "Click the vertices; Enter, or a click on the first one, closes the polygon",
  rectangle: "Drag from corner to corner; inside a shape it becomes a hole",
  circle: "Drag from the centre; inside a shape it becomes a hole",
  freehand: "Draw a closed line; it becomes a smooth curve",
  hand: "Drag the plane",
};
const MOST_AT_ONCE = 64; // vertices that move one after the other
const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);

export class Tools {
  tool = "select";
  snap = false;
  chosen = null; // ring and vertex, by the keyboard or the last click
  #drag = null;
  #pointers = new Map();
  #space = false;

  constructor(studio, say) {
    this.studio = studio;
    this.say = say;
    const { canvas } = studio;
    canvas.addEventListener("pointerdown", (event) => this.#down(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    canvas.addEventListener("pointerup", (event) => this.#up(event));
    canvas.addEventListener("pointercancel", (event) => this.#up(event));
    canvas.addEventListener("pointerleave", () => this.#leave());
    canvas.addEventListener("dblclick", (event) => this.#double(event));
    canvas.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("keydown", (event) => this.#key(event));
    canvas.addEventListener("keyup", (event) => event.key === " " && (this.#space = false));
  }

  get scene() {
    return this.studio.scene;
  }
  get camera() {
    return this.studio.camera;
  }

  choose(tool) {
    this.tool = tool;
    this.scene.draft = null;
    this.scene.hot = null;
    this.studio.canvas.style.cursor = { select: "default", hand: "grab" }[tool] ?? "crosshair";
    this.studio.emit("tool", HINTS[tool]);
    this.studio.ask();
  }

  // The item under the pointer.

  #place(event) {
    return [event.offsetX, event.offsetY];
  }
  /** The point in the plane, snapped to the grid or to a vertex on request. */
  #plane(at, except) {
    const point = this.camera.toPlane(...at);
    if (!this.snap) return point;
    const near = this.#nearest_vertex(at, 10, except);
    if (near) return point_of(this.scene.rings[near.ring], near.index);
    const step = nice_step(this.camera);
    return point.map((v) => Math.round(v / step) * step);
  }

  #nearest_vertex([px, py], reach, except) {
    const { live } = this.studio;
    if (live?.has_all) {
      const place = this.camera.toPlane(px, py);
      return live.nearest_vertex(place, reach / this.camera.scale, (ring, index) => !except || ring !== except.ring || index !== except.index);
    }
    const { cx, cy, dx, dy, scale } = this.camera.transform;
    let best = null;
    let least = reach * reach;
    this.scene.rings.forEach(({ xy }, ring) => {
      for (let k = 0; k < xy.length; k += 2) {
        const x = (xy[k] - cx) * scale + dx - px;
        const y = (cy - xy[k + 1]) * scale + dy - py;
        const d = x * x + y * y;
        if (d >= least || (except && except.ring === ring && except.index === k / 2)) continue;
        least = d;
        best = { kind: "vertex", ring, index: k / 2 };
      }
    });
    return best;
  }

  #nearest_edge(at, reach) {
    let best = null;
    let least = reach;
    this.scene.rings.forEach((ring, r) => {
      const n = size_of(ring);
      let from = this.camera.toScreen(...point_of(ring, 0));
      for (let i = 0; i < n; ++i) {
        const to = this.camera.toScreen(...point_of(ring, next_of(ring, i)));
        const edge = ring.edges.get(i);
        const between = edge === undefined ? [] : samples(ring, i, edge).map((p) => this.camera.toScreen(...p));
        const line = [from, ...between, to];
        for (let k = 0; k + 1 < line.length; ++k) {
          const d = to_segment(at, line[k], line[k + 1]);
          if (d < least) {
            least = d;
            best = { kind: "edge", ring: r, index: i };
          }
        }
        from = to;
      }
    });
    return best;
  }

  /** The dots by which an edge is bent: the middle of a line or an arc, the control points of a curve. */
  #handles(hot) {
    const ring = this.scene.rings[hot.ring];
    const edge = ring.edges.get(hot.index);
    const [a, b] = [point_of(ring, hot.index), point_of(ring, next_of(ring, hot.index))];
    if (Array.isArray(edge)) return [{ part: 0, at: edge.slice(0, 2) }, { part: 2, at: edge.slice(2) }];
    const bend = edge ?? 0;
    const middle = [(a[0] + b[0]) / 2 + (bend * (b[1] - a[1])) / 2, (a[1] + b[1]) / 2 - (bend * (b[0] - a[0])) / 2];
    return [{ part: "bulge", at: middle }];
  }

  #under(at, touch) {
    const reach = touch ? 22 : 9;
    const hot = this.scene.hot;
    if (hot?.handles)
      for (const handle of hot.handles)
        if (distance(at, this.camera.toScreen(...handle.at)) < reach + 2) return { ...hot, handle };
    const vertex = this.#nearest_vertex(at, reach);
    if (vertex) return vertex;
    const edge = this.#nearest_edge(at, touch ? 16 : 7);
    if (edge) return { ...edge, handles: this.#handles(edge) };
    if (hot?.kind === "edge" && hot.handles.some(({ at: p }) => distance(at, this.camera.toScreen(...p)) < 40)) return hot;
    return null;
  }

  // The pointer.

  #down(event) {
    const { canvas } = this.studio;
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    const at = this.#place(event);
    this.#pointers.set(event.pointerId, at);
    if (this.#pointers.size === 2) return this.#pinch_begins();
    const pan = event.button === 1 || this.#space || this.tool === "hand" || event.button === 2;
    if (pan) this.#drag = { kind: "pan", at };
    else if (this.tool === "select") this.#grab(at, event.pointerType === "touch");
    else if (this.tool === "polygon") this.#corner(at);
    else this.#drag = { kind: this.tool, from: this.#plane(at), points: [this.#plane(at)] };
    this.studio.dragging = Boolean(this.#drag);
  }

  #grab(at, touch) {
    const hot = this.#under(at, touch);
    const point = this.camera.toPlane(...at);
    this.chosen = hot?.kind === "vertex" ? hot : null;
    this.scene.hot = hot;
    if (hot) {
      this.#drag = { ...hot, at, point, ring_before: this.#as_it_is(hot.ring) };
    } else {
      const hole = this.#ring_around(point);
      this.#drag = hole >= 0 ? { kind: "ring", ring: hole, at, point, ring_before: this.#as_it_is(hole) } : { kind: "pan", at };
    }
    this.studio.ask();
  }

  /** A copy of a ring, which edits of the drawing do not change. */
  #as_it_is(ring) {
    const { xy, edges } = this.scene.rings[ring];
    return { xy: xy.slice(), edges };
  }

  /** The hole, or island in a hole, at a place; -1 elsewhere: there the plane is dragged. */
  #ring_around(point) {
    const around = this.scene.rings.map((ring, i) => (contains(ring, point) ? i : -1)).filter((i) => i >= 0);
    if (around.length < 2) return -1;
    return around.reduce((best, i) => (area_of(this.scene.rings[i]) < area_of(this.scene.rings[best]) ? i : best));
  }

  #move(event) {
    const at = this.#place(event);
    this.pointer = at;
    if (this.#pointers.has(event.pointerId)) this.#pointers.set(event.pointerId, at);
    if (this.#pointers.size === 2) return this.#pinch();
    if (this.#drag) this.#dragged(at);
    else this.#hover(at);
    this.studio.ask();
  }

  #hover(at) {
    if (this.scene.draft?.dots) this.scene.draft = { ...this.scene.draft, points: [...this.corners, this.#plane(at)] };
    if (this.tool !== "select") return;
    this.scene.hot = count_of(this.scene.rings) < 200_000 ? this.#under(at) : this.#nearest_vertex(at, 9);
    this.studio.canvas.style.cursor = this.scene.hot ? "grab" : "default";
    this.studio.emit("hover", this.camera.toPlane(...at));
  }

  #dragged(at) {
    const drag = this.#drag;
    if (drag.kind === "pan") {
      this.camera.pan(at[0] - drag.at[0], at[1] - drag.at[1]);
      drag.at = at;
      return;
    }
    drag.moved ||= distance(at, drag.at ?? at) > 2;
    if (["vertex", "edge", "ring"].includes(drag.kind)) {
      if (drag.moved) this.#reshape(drag, at);
    } else this.#draft(drag, at);
  }

  #reshape(drag, at) {
    if (!this.scene.rings[drag.ring]) return; // another drawing since
    const before = drag.ring_before;
    const to = this.#plane(at, drag);
    const [dx, dy] = [to[0] - drag.point[0], to[1] - drag.point[1]];
    const is_done = this.#follow(drag, drag.handle ? this.#plane(at) : to, dx, dy);
    if (is_done) return this.#show_handles();
    let ring;
    if (drag.handle) ring = bent(before, drag, this.#plane(at));
    else if (drag.kind === "vertex") ring = moved_vertex(before, drag.index, to);
    else if (drag.kind === "edge") ring = moved_edge(before, drag.index, dx, dy);
    else ring = moved_ring(before, dx, dy);
    this.studio.change(this.scene.rings.with(drag.ring, ring), false);
    this.#show_handles();
    this.studio.emit("dragged", at);
  }
  #show_handles() {
    const { hot } = this.scene;
    if (hot?.kind === "edge") this.scene.hot = { ...hot, handles: this.#handles(hot) };
  }
  /** Applies a move of a vertex, an edge, its bend, or a ring to the axis. False if the axis cannot follow. */
  #follow(drag, to, dx, dy) {
    const { ring, ring_before: before } = drag;
    const count = size_of(before);
    if (drag.handle) {
      if (drag.handle.part !== "bulge") return false;
      const edge = bent(before, drag, to).edges.get(drag.index) ?? 0;
      return this.studio.edit([{ kind: "bend", ring, index: drag.index, edge }]);
    }
    if (drag.kind === "ring" && (count > MOST_AT_ONCE || before.edges.size)) {
      const { xy } = this.scene.rings[ring];
      const by = [before.xy[0] + dx - xy[0], before.xy[1] + dy - xy[1]];
      return this.studio.edit([{ kind: "ring", ring, by, xy: xy.map((v, k) => v + by[k % 2]) }]);
    }
    const moved = (index) => {
      const [x, y] = point_of(before, index);
      return { kind: "move", ring, index, point: [x + dx, y + dy] };
    };
    if (drag.kind === "vertex") return this.studio.edit([{ kind: "move", ring, index: drag.index, point: to }]);
    const all = drag.kind === "edge" ? [moved(drag.index), moved((drag.index + 1) % count)] : Array.from({ length: count }, (_, i) => moved(i));
    // The vertex ahead moves first, so that the other one does not run over it.
    const now = this.scene.rings[ring];
    const ahead = ({ index, point }) => (point[0] - now.xy[2 * index]) * point[0] + (point[1] - now.xy[2 * index + 1]) * point[1];
    return this.studio.edit(all.sort((a, b) => ahead(b) - ahead(a)));
  }

  #draft(drag, at) {
    const to = this.#plane(at);
    if (drag.kind === "freehand") {
      if (distance(at, this.camera.toScreen(...drag.points.at(-1))) > 2) drag.points.push(this.camera.toPlane(...at));
      this.scene.draft = { points: drag.points };
      return;
    }
    drag.ring = drag.kind === "circle" ? circle(drag.from, distance(drag.from, to)) : rectangle(drag.from, to);
    const points = drag.kind === "circle" ? dots_of_circle(drag.from, distance(drag.from, to)) : rows_of(drag.ring);
    this.scene.draft = { points, closed: true };
  }

  #up(event) {
    this.#pointers.delete(event.pointerId);
    const drag = this.#drag;
    this.#drag = null;
    this.studio.dragging = false;
    this.pinched = null;
    if (!drag) return;
    if (["vertex", "edge", "ring"].includes(drag.kind)) {
      if (drag.moved) this.studio.done();
    } else if (drag.kind === "freehand") {
      this.#add(smooth_ring(drag.points, 3 / this.camera.scale));
    } else if (drag.ring) this.#add(drag.ring);
    if (drag.kind !== "pan") this.scene.draft = null;
    this.studio.ask();
  }

  #leave() {
    this.pointer = null;
    if (!this.#drag) this.scene.hot = null;
    this.studio.emit("hover", null);
    this.studio.ask();
  }

  #add(ring) {
    if (!ring || !(area_of(ring) * this.camera.scale ** 2 > 16)) return;
    this.studio.change([...this.scene.rings, ring]);
    this.choose("select");
  }

  // Polygons, corner by corner.

  corners = [];
  #corner(at) {
    const point = this.#plane(at);
    if (!this.scene.draft) this.corners = [];
    const first = this.corners[0];
    if (first && distance(at, this.camera.toScreen(...first)) < 12) return this.#close();
    const last = this.corners.at(-1);
    if (!last || last[0] !== point[0] || last[1] !== point[1]) this.corners.push(point);
    this.scene.draft = { points: [...this.corners, point], dots: true };
    this.studio.ask();
  }
  #close() {
    const ring = this.corners.length > 2 ? ring_of(this.corners) : null;
    this.scene.draft = null;
    this.#add(ring);
    this.studio.ask();
  }

  #double(event) {
    if (this.tool === "polygon") return this.#close();
    if (this.tool !== "select") return;
    const at = this.#place(event);
    const hot = this.#under(at, false);
    if (hot?.kind === "vertex") this.#remove(hot);
    else if (hot?.handle) this.#reform(hot, with_curve);
    else if (hot?.kind === "edge") this.#insert(hot, this.#plane(at));
  }
  #insert({ ring, index }, point) {
    if (this.studio.edit([{ kind: "insert", ring, index: index + 1, point }])) {
      this.studio.done();
      if (this.scene.error) return;
    } else this.studio.change(this.scene.rings.with(ring, with_vertex(this.scene.rings[ring], index, point)));
    this.chosen = { kind: "vertex", ring, index: index + 1 };
    this.scene.hot = this.chosen;
  }
  #remove({ ring, index }) {
    if (this.studio.edit([{ kind: "remove", ring, index }])) this.studio.done();
    else {
      const left = without_vertex(this.scene.rings[ring], index);
      this.studio.change(left ? this.scene.rings.with(ring, left) : this.scene.rings.toSpliced(ring, 1));
    }
    this.scene.hot = null;
    this.chosen = null;
  }

  /** Gives an edge another form. */
  #reform({ ring, index }, form) {
    const next = form(this.scene.rings[ring], index);
    const edge = next.edges.get(index) ?? 0;
    const is_curve = Array.isArray(edge) || Array.isArray(this.scene.rings[ring].edges.get(index));
    if (!is_curve && this.studio.edit([{ kind: "bend", ring, index, edge }])) this.studio.done();
    else this.studio.change(this.scene.rings.with(ring, next));
    const of = { kind: "edge", ring, index };
    this.scene.hot = { ...of, handles: this.#handles(of) };
    this.say(Array.isArray(edge) ? "a curve" : edge ? `an arc, bulge ${+edge.toPrecision(3)}` : "a line");
  }

  // Zooming.

  #wheel(event) {
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 16 : 1;
    if (event.ctrlKey || !event.shiftKey)
      this.camera.zoom(Math.exp(-event.deltaY * lines * (event.ctrlKey ? 0.01 : 0.0022)), event.offsetX, event.offsetY);
    else this.camera.pan(-event.deltaX * lines || -event.deltaY * lines, 0);
    this.studio.ask();
  }
  #pinch_begins() {
    if (this.#drag?.ring_before) this.studio.cancel();
    this.#drag = null;
    this.scene.draft = null;
    this.#pinch();
  }
  #pinch() {
    const [a, b] = [...this.#pointers.values()];
    const now = { middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], apart: distance(a, b) };
    if (this.pinched) {
      this.camera.pan(now.middle[0] - this.pinched.middle[0], now.middle[1] - this.pinched.middle[1]);
      this.camera.zoom(now.apart / this.pinched.apart, ...now.middle);
    }
    this.pinched = now;
    this.studio.ask();
  }

  // The keyboard.

  #key(event) {
    const { key, shiftKey } = event;
    if (event.metaKey || event.altKey) return;
    if (event.ctrlKey) {
      if (!this.chosen || !key.startsWith("Arrow")) return;
      this.#arrow(key, shiftKey ? 10 : 1, true);
    } else if (key === "Tab" && this.scene.rings.length) {
      if (!this.#step(shiftKey ? -1 : 1)) return;
    } else if (key.startsWith("Arrow")) this.#arrow(key, shiftKey ? 10 : 1);
    else if ((key === "i" || key === "I") && this.chosen) this.#insert_after();
    else if ((key === "q" || key === "Q") && this.chosen) this.#reform(this.chosen, with_curve);
    else if ("[]".includes(key) && this.chosen) this.#reform(this.chosen, (ring, i) => with_bend(ring, i, key === "]" ? 0.05 : -0.05));
    else if (key === "Delete" && shiftKey && this.chosen) this.#remove_ring(this.chosen.ring);
    else if ((key === "Delete" || key === "Backspace") && this.chosen) {
      const { ring, index } = this.chosen;
      this.#remove(this.chosen);
      const still = this.scene.rings[ring];
      if (still) this.#show_chosen({ kind: "vertex", ring, index: index % size_of(still) });
    } else if (key === "Enter" && this.scene.draft?.dots) this.#close();
    else if (key === "Enter" && this.#in_the_middle()) this.#add_chosen(this.#in_the_middle());
    else if (key === "Escape") {
      this.scene.draft = null;
      this.chosen = null;
      this.scene.hot = null;
      if (this.tool !== "select") this.choose("select");
    } else if (key === " ") this.#space = true;
    else return;
    event.preventDefault();
    this.studio.ask();
  }

  /** The next vertex; false at either end, so that Tab leaves the canvas. */
  #step(by) {
    const { rings } = this.scene;
    let { ring, index } = this.chosen ?? { ring: by > 0 ? 0 : rings.length - 1, index: by > 0 ? -1 : size_of(rings.at(-1)) };
    index += by;
    if (index < 0 || index >= size_of(rings[ring])) {
      ring += by;
      if (!rings[ring]) {
        this.chosen = null;
        this.scene.hot = null;
        return false;
      }
      index = by > 0 ? 0 : size_of(rings[ring]) - 1;
    }
    this.#show_chosen({ kind: "vertex", ring, index });
    return true;
  }
  #show_chosen(chosen) {
    this.chosen = chosen;
    this.scene.hot = chosen;
    const [x, y] = point_of(this.scene.rings[chosen.ring], chosen.index);
    this.say(`ring ${chosen.ring + 1}, vertex ${chosen.index + 1}, at ${+x.toPrecision(6)}, ${+y.toPrecision(6)}`);
  }
  #remove_ring(ring) {
    this.studio.change(this.scene.rings.toSpliced(ring, 1));
    this.chosen = null;
    this.scene.hot = null;
  }
  /** The ring that a tool draws without a pointer: in the middle of the view, to be changed by keys. */
  #in_the_middle() {
    const { width, height, scale } = this.camera;
    const center = this.camera.toPlane(width / 2, height / 2);
    const r = Math.min(width, height) / scale / 8;
    const at = (x, y) => [center[0] + x * r, center[1] + y * r];
    if (this.tool === "circle") return circle(center, r);
    if (this.tool === "rectangle") return rectangle(at(-1, -1), at(1, 1));
    return this.tool === "polygon" ? ring_of([at(-1, -1), at(1, -1), at(0, 1)]) : null;
  }
  #add_chosen(ring) {
    this.#add(ring);
    this.#show_chosen({ kind: "vertex", ring: this.scene.rings.length - 1, index: 0 });
  }
  /** Moves the selected vertex, its whole ring, or the view. */
  #arrow(key, factor, of_ring = false) {
    const [dx, dy] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[key];
    if (!this.chosen) return this.camera.pan(-dx * 40 * Math.sqrt(factor), dy * 40 * Math.sqrt(factor));
    const step = (this.snap ? nice_step(this.camera) : 1 / this.camera.scale) * factor;
    const { ring, index } = this.chosen;
    const [x, y] = point_of(this.scene.rings[ring], index);
    const point = [x + dx * step, y + dy * step];
    if (of_ring) this.studio.change(this.scene.rings.with(ring, moved_ring(this.scene.rings[ring], dx * step, dy * step)));
    else if (this.studio.edit([{ kind: "move", ring, index, point }])) this.studio.done();
    else this.studio.change(this.scene.rings.with(ring, moved_vertex(this.scene.rings[ring], index, point)));
    this.#show_chosen(this.chosen);
  }
  #insert_after() {
    const { ring, index } = this.chosen;
    const of = this.scene.rings[ring];
    const [a, b] = [point_of(of, index), point_of(of, next_of(of, index))];
    this.#insert({ ring, index }, [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]);
    this.#show_chosen(this.chosen);
  }
}

function to_segment([x, y], [x0, y0], [x1, y1]) {
  const [dx, dy] = [x1 - x0, y1 - y0];
  const t = Math.min(1, Math.max(0, ((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(x - x0 - t * dx, y - y0 - t * dy);
}

/** A ring whose edge is bent by a dot that is dragged to a place. */
function bent(ring, { index, handle }, to) {
  if (handle.part !== "bulge") {
    const curve = [...ring.edges.get(index)];
    curve[handle.part] = to[0];
    curve[handle.part + 1] = to[1];
    return with_edge(ring, index, curve);
  }
  const [a, b] = [point_of(ring, index), point_of(ring, next_of(ring, index))];
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const away = ((to[0] - (a[0] + b[0]) / 2) * dy - (to[1] - (a[1] + b[1]) / 2) * dx) / (dx * dx + dy * dy);
  const bulge = Math.min(1, Math.max(-1, 2 * away));
  return with_edge(ring, index, Math.abs(bulge) < 0.02 ? 0 : bulge);
}

const rows_of = (ring) => Array.from({ length: size_of(ring) }, (_, i) => point_of(ring, i));
const rectangle = ([x0, y0], [x1, y1]) => ring_of([[x0, y0], [x1, y0], [x1, y1], [x0, y1]]);
function circle([x, y], r) {
  return ring_of([[x + r, y], [x, y + r], [x - r, y], [x, y - r]], [0, 1, 2, 3].map((i) => [i, Math.tan(Math.PI / 8)]));
}
const dots_of_circle = ([x, y], r) =>
  Array.from({ length: 64 }, (_, k) => [x + r * Math.cos((k * Math.PI) / 32), y + r * Math.sin((k * Math.PI) / 32)]);

export function area_of(ring) {
  let sum = 0;
  const n = size_of(ring);
  const [ox, oy] = point_of(ring, 0);
  for (let i = 0; i < n; ++i) {
    const j = next_of(ring, i);
    sum += (ring.xy[2 * i] - ox) * (ring.xy[2 * j + 1] - oy) - (ring.xy[2 * j] - ox) * (ring.xy[2 * i + 1] - oy);
    const edge = ring.edges.get(i);
    if (typeof edge !== "number") continue;
    const { radius, angle } = arc_of(point_of(ring, i), point_of(ring, j), edge);
    sum += radius * radius * (angle - Math.sin(angle));
  }
  return Math.abs(sum) / 2;
}
