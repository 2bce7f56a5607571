// A drawing of straight edges and arcs whose axis follows edits: the package's Editor, and beside it what is
// drawn, by the editor's numbers, in arrays that change where the axis does.

import { Quads, grown } from "./quads.mjs";
import { arc_of, chords_of, input_of, size_of } from "./model.mjs";

const STRIDE = 7; // x0 y0 cx cy x1 y1 weight

export class Live {
  /** Edge e of the axis: numbers in `rows`, radii at its ends and its middle control point. */
  rows = new Float64Array(0);
  radii = new Float32Array(0);
  count = 0;
  largest = 0;
  /** Boundary: vertex v, and the edge from it to `next`, with its bulge; -1 where there is none. */
  x = new Float64Array(0);
  y = new Float64Array(0);
  bulge = new Float64Array(0);
  next = new Int32Array(0);
  before = new Int32Array(0);
  ring = new Int32Array(0);
  index = new Int32Array(0);
  /** The boxes that changed since the last drawing; null if everything did. */
  changed = null;
  /** False if the shape lacks vertices of the drawing, such as those between collinear edges. */
  has_all = true;
  /** False if an edit changed the editor but failed to update these arrays. */
  is_in_step = true;

  constructor(medial, rings) {
    const { x, options } = input_of(rings, medial);
    const shape = new medial.Shape(x, options);
    try {
      this.editor = new medial.Editor(shape);
      this.#number(rings, shape);
      this.#read(shape, (k) => k);
    } finally {
      shape.free();
    }
  }

  /** The whole axis, a copy that stays until the next edit. */
  get axis() {
    return (this.#axis ??= this.editor.axis);
  }
  #axis = null;
  #forget_axis() {
    this.#axis?.ofShape?.free();
    this.#axis?.free();
    this.#axis = null;
  }
  free() {
    this.#forget_axis();
    this.editor.free();
  }

  /** The editor's number of each vertex of each ring; -1 where the shape has none. */
  #number(rings, shape) {
    this.numbers = rings.map((ring) => new Int32Array(size_of(ring)).fill(-1));
    const { sources } = shape;
    const count = sources.length / 2;
    [this.x, this.y, this.bulge] = Array.from({ length: 3 }, () => new Float64Array(count));
    [this.ring, this.index] = [new Int32Array(count), new Int32Array(count)];
    for (let v = 0; v < count; ++v) {
      const [r, i] = [sources[2 * v], sources[2 * v + 1]];
      [this.ring[v], this.index[v]] = [r, i];
      this.numbers[r][i] = v;
    }
  }

  /** Reads everything; `number` gives the vertex of a point of the shape. */
  #read(shape, number) {
    this.changed = null;
    this.#read_boundary(shape, number);
    this.#read_edges(this.axis, shape.bounds);
  }

  #read_boundary(shape, number) {
    const { points, bulges, loopBegin } = shape;
    this.next = new Int32Array(this.x.length).fill(-1);
    this.before = new Int32Array(this.x.length).fill(-1);
    this.boundary = new Quads(shape.bounds, this.x.length);
    for (let l = 0; l + 1 < loopBegin.length; ++l)
      for (let k = loopBegin[l]; k < loopBegin[l + 1]; ++k) {
        const [v, w] = [number(k), number(k + 1 < loopBegin[l + 1] ? k + 1 : loopBegin[l])];
        [this.x[v], this.y[v], this.bulge[v]] = [points[2 * k], points[2 * k + 1], bulges[k] ?? 0];
        this.next[v] = w;
        this.before[w] = v;
      }
    for (let v = 0; v < this.next.length; ++v) if (this.next[v] >= 0) this.#index_boundary(v);
    this.has_all = this.numbers.every((ring) => ring.every((v) => v >= 0 && this.next[v] >= 0));
  }

  #read_edges({ nodes, edges }, bounds) {
    const { from, to, controlX, controlY, controlRadius, weight } = edges;
    const { x, y, radius } = nodes;
    this.rows = new Float64Array(from.length * STRIDE);
    this.radii = new Float32Array(from.length * 3);
    this.edges = new Quads(bounds, from.length);
    this.count = 0;
    this.largest = 0;
    for (let e = 0; e < from.length; ++e) {
      const [a, b] = [from[e], to[e]];
      this.#put(e, x[a], y[a], radius[a], controlX[e], controlY[e], controlRadius[e], x[b], y[b], radius[b], weight[e]);
    }
  }

  #put(e, x0, y0, r0, cx, cy, cr, x1, y1, r1, w) {
    this.rows = grown(this.rows, (e + 1) * STRIDE);
    this.radii = grown(this.radii, (e + 1) * 3);
    const { rows, radii } = this;
    let k = e * STRIDE;
    rows[k] = x0;
    rows[++k] = y0;
    rows[++k] = cx;
    rows[++k] = cy;
    rows[++k] = x1;
    rows[++k] = y1;
    rows[++k] = w;
    radii[3 * e] = r0;
    radii[3 * e + 1] = cr;
    radii[3 * e + 2] = r1;
    const larger = Math.max(r0, r1);
    if (larger > this.largest) {
      this.largest = larger;
      this.changed = null; // all colours change
    }
    ++this.count;
    this.edges.add(e, Math.min(x0, cx, x1), Math.min(y0, cy, y1), Math.max(x0, cx, x1), Math.max(y0, cy, y1));
  }

  // Edits.

  /** Whether the editor has the vertices of an edit. */
  knows({ kind, ring, index }) {
    if (kind === "ring") return this.#known(ring).length > 0;
    if (kind === "bend") return this.#edge_at(ring, index + 1) >= 0;
    // The editor divides and joins arcs where a vertex comes and goes; the drawing makes edges straight there.
    if (kind === "insert") return this.bulge[this.#edge_at(ring, index)] === 0;
    const numbers = this.numbers[ring];
    const v = numbers[index];
    if (!(v >= 0 && this.next[v] >= 0)) return false;
    return kind === "move" || (numbers.length > 3 && this.bulge[v] === 0 && this.bulge[this.before[v]] === 0);
  }
  /** The places in a ring of the vertices that the shape has. */
  #known(ring) {
    return [...this.numbers[ring].keys()].filter((i) => this.numbers[ring][i] >= 0 && this.next[this.numbers[ring][i]] >= 0);
  }
  /** The vertex at which the edge to the vertex `index` of a ring begins, as the editor has it; -1 for none. */
  #edge_at(ring, index) {
    const numbers = this.numbers[ring];
    const [a, b] = [numbers[(index + numbers.length - 1) % numbers.length], numbers[index % numbers.length]];
    if (a >= 0 && b >= 0 && this.next[a] === b) return a;
    return a >= 0 && b >= 0 && this.next[b] === a ? b : -1;
  }

  /** Applies an edit to the axis. Throws a MedialError, and changes nothing, if it is refused. */
  follow(edit) {
    const { editor } = this;
    const { kind, ring, index, point } = edit;
    if (kind === "ring") return this.#follow_ring(edit);
    if (kind === "bend") return this.#follow_bend(edit);
    const v = kind === "insert" ? this.#edge_at(ring, index) : this.numbers[ring][index];
    let change;
    if (kind === "move") change = editor.move(v, point);
    else if (kind === "insert") change = editor.insert(v, point);
    else change = editor.remove(v);
    this.is_in_step = false;
    this.#forget_axis();
    if (kind === "move") this.#moved(v, point);
    else if (kind === "insert") this.#inserted(v, change.vertex, ring, index, point);
    else this.#removed(v, ring, index);
    this.#take_any(change);
    this.is_in_step = true;
  }
  /** Moves a whole ring. Its vertices get exactly the given places, without rounding errors of sums. */
  #follow_ring({ ring, xy, by }) {
    const known = this.#known(ring).map((i) => ({ v: this.numbers[ring][i], x: xy[2 * i], y: xy[2 * i + 1] }));
    const [{ v: first, x, y }] = known;
    const way = by ?? [x - this.x[first], y - this.y[first]];
    const change = this.editor.moveLoop(first, way);
    this.is_in_step = false;
    this.#forget_axis();
    const off = known.filter(({ v, x, y }) => this.x[v] + way[0] !== x || this.y[v] + way[1] !== y);
    for (const { v } of known) this.#forget(v);
    for (const { v, x, y } of known) [this.x[v], this.y[v]] = [x, y];
    for (const { v } of known) this.#add(v);
    this.#take_any(change);
    for (const { v, x, y } of off) this.#take_any(this.editor.move(v, [x, y]));
    this.is_in_step = true;
  }
  #follow_bend({ ring, index, edge }) {
    const v = this.#edge_at(ring, index + 1);
    const bulge = v === this.numbers[ring][index] ? edge : -edge; // the editor may go round the other way
    const change = this.editor.setBulge(v, bulge);
    this.is_in_step = false;
    this.#forget_axis();
    this.#forget(v);
    this.bulge[v] = bulge;
    this.#add(v);
    this.#take_any(change);
    this.is_in_step = true;
  }
  #take_any(change) {
    this.#forget_axis();
    if (!change.everything) return this.#take(change);
    const { shape } = this.axis;
    const { sources } = shape;
    this.#read(shape, (k) => sources[2 * k + 1]);
  }

  /** Updates `largest` after the largest disk has become smaller, in O(n). */
  find_largest() {
    let largest = 0;
    for (let e = 0; e < this.edges.room; ++e)
      if (this.edges.has(e)) largest = Math.max(largest, this.radii[3 * e], this.radii[3 * e + 2]);
    if (largest === Math.fround(this.largest)) return;
    this.largest = largest;
    this.changed = null; // all colours change
  }

  #take({ removedEdges, addedEdges }) {
    for (const e of removedEdges) {
      this.#mark_row(e);
      this.edges.remove(e);
      --this.count;
    }
    if (!addedEdges.length) return;
    const { from, to, controlX, controlY, controlRadius, weight } = this.editor.edges(addedEdges);
    const [a, b] = [this.editor.nodes(from), this.editor.nodes(to)];
    const [ax, ay, ar, bx, by, br] = [a.x, a.y, a.radius, b.x, b.y, b.radius];
    for (let i = 0; i < addedEdges.length; ++i) {
      this.#put(addedEdges[i], ax[i], ay[i], ar[i], controlX[i], controlY[i], controlRadius[i], bx[i], by[i], br[i], weight[i]);
      this.#mark_row(addedEdges[i]);
    }
  }

  #moved(v, [x, y]) {
    const before = this.before[v];
    this.#forget(before);
    this.#forget(v);
    [this.x[v], this.y[v]] = [x, y];
    this.#add(before);
    this.#add(v);
  }
  #inserted(a, v, ring, index, [x, y]) {
    const b = this.next[a];
    for (const name of ["x", "y", "bulge", "next", "before", "ring", "index"]) this[name] = grown(this[name], v + 1);
    this.#forget(a);
    [this.x[v], this.y[v], this.bulge[v], this.ring[v]] = [x, y, 0, ring];
    this.#link(a, v);
    this.#link(v, b);
    this.#add(a);
    this.#add(v);
    const old = this.numbers[ring];
    const numbers = new Int32Array(old.length + 1);
    numbers.set(old.subarray(0, index));
    numbers[index] = v;
    numbers.set(old.subarray(index), index + 1);
    this.#renumber(ring, numbers, index);
  }
  #removed(v, ring, index) {
    const [before, next] = [this.before[v], this.next[v]];
    this.#forget(before);
    this.#forget(v);
    this.next[v] = this.before[v] = -1;
    this.#link(before, next);
    this.#add(before);
    const old = this.numbers[ring];
    const numbers = new Int32Array(old.length - 1);
    numbers.set(old.subarray(0, index));
    numbers.set(old.subarray(index + 1), index);
    this.#renumber(ring, numbers, index);
  }
  #link(a, b) {
    this.next[a] = b;
    this.before[b] = a;
  }
  #renumber(ring, numbers, from) {
    this.numbers[ring] = numbers;
    for (let i = from; i < numbers.length; ++i) if (numbers[i] >= 0) this.index[numbers[i]] = i;
  }

  /** A box around the edge that begins at a vertex. */
  #box_of(v) {
    const [x0, y0, x1, y1] = [this.x[v], this.y[v], this.x[this.next[v]], this.y[this.next[v]]];
    const bulge = this.bulge[v];
    if (bulge === 0) return [Math.min(x0, x1), Math.min(y0, y1), Math.max(x0, x1), Math.max(y0, y1)];
    const { cx, cy, radius } = arc_of([x0, y0], [x1, y1], bulge);
    if (Math.abs(bulge) >= 1) return [cx - radius, cy - radius, cx + radius, cy + radius];
    // Of less than half a circle: the triangle of the chord and the tangents at its ends.
    const rise = bulge / (1 - bulge * bulge);
    const [tx, ty] = [(x0 + x1) / 2 + rise * (y1 - y0), (y0 + y1) / 2 - rise * (x1 - x0)];
    const [low_x, high_x] = [Math.max(Math.min(x0, x1, tx), cx - radius), Math.min(Math.max(x0, x1, tx), cx + radius)];
    const [low_y, high_y] = [Math.max(Math.min(y0, y1, ty), cy - radius), Math.min(Math.max(y0, y1, ty), cy + radius)];
    return [Math.min(low_x, x0, x1), Math.min(low_y, y0, y1), Math.max(high_x, x0, x1), Math.max(high_y, y0, y1)];
  }
  #index_boundary(v) {
    this.boundary.add(v, ...this.#box_of(v));
  }
  #add(v) {
    this.#index_boundary(v);
    this.#mark_edge(v);
  }
  #forget(v) {
    this.#mark_edge(v);
    this.boundary.remove(v);
  }

  #mark_edge(v) {
    this.changed?.push(...this.#box_of(v));
  }
  #mark_row(e) {
    if (!this.changed) return;
    const { rows } = this;
    const k = e * STRIDE;
    const [x0, cx, x1] = [rows[k], rows[k + 2], rows[k + 4]];
    const [y0, cy, y1] = [rows[k + 1], rows[k + 3], rows[k + 5]];
    this.changed.push(Math.min(x0, cx, x1), Math.min(y0, cy, y1), Math.max(x0, cx, x1), Math.max(y0, cy, y1));
  }

  // Queries.

  /** The vertices whose edges may meet a box; until the next call is_found() knows them. */
  in_box(box) {
    if (this.#found.length < this.x.length) this.#found = new Uint32Array(this.x.length);
    this.#serial += 2;
    const all = [];
    this.boundary.find(box, (v) => {
      this.#found[v] = this.#serial;
      all.push(v);
    });
    return all;
  }
  #found = new Uint32Array(0);
  #serial = 0;
  is_found(v) {
    return this.#found[v] >= this.#serial;
  }
  /** Whether a vertex is found and was not taken before. */
  take(v) {
    if (this.#found[v] !== this.#serial) return false;
    ++this.#found[v];
    return true;
  }

  /** The edge that begins at a vertex: x and y of its ends, of an arc also between them, for this scale. */
  edge(v, scale) {
    const w = this.next[v];
    if (this.bulge[v] === 0) return [this.x[v], this.y[v], this.x[w], this.y[w]];
    return chords_of([this.x[v], this.y[v]], [this.x[w], this.y[w]], this.bulge[v], scale);
  }

  /** Whether a place is inside, by the edges as edge() has them that a ray to the right meets. */
  inside(px, py, scale) {
    const { boundary } = this;
    let inside = false;
    boundary.find([px, py, boundary.x + 2 * boundary.side, py], (v) => {
      const line = this.edge(v, scale);
      for (let k = 0; k + 2 < line.length; k += 2) {
        const [ax, ay, bx, by] = [line[k], line[k + 1], line[k + 2], line[k + 3]];
        if (ay > py !== by > py && px < ((bx - ax) * (py - ay)) / (by - ay) + ax) inside = !inside;
      }
    });
    return inside;
  }

  /** The vertex nearest to a place, less than `reach` away, as ring and index. */
  nearest_vertex([px, py], reach, accept = () => true) {
    let best = null;
    let least = reach;
    this.boundary.find([px - reach, py - reach, px + reach, py + reach], (v) => {
      for (const w of [v, this.next[v]]) {
        const away = Math.hypot(this.x[w] - px, this.y[w] - py);
        if (away >= least || !accept(this.ring[w], this.index[w])) continue;
        least = away;
        best = { kind: "vertex", ring: this.ring[w], index: this.index[w] };
      }
    });
    return best;
  }

  /** The disk in an end of an edge of the axis nearest to a place, less than `reach` away. */
  nearest_disk([px, py], reach) {
    let best = null;
    let least = reach;
    this.edges.find([px - reach, py - reach, px + reach, py + reach], (e) => {
      for (const end of [0, 2]) {
        const [x, y] = [this.rows[e * STRIDE + 2 * end], this.rows[e * STRIDE + 2 * end + 1]];
        const away = Math.hypot(x - px, y - py);
        if (away >= least) continue;
        least = away;
        best = { x, y, radius: this.radii[3 * e + end] };
      }
    });
    return best;
  }
}
