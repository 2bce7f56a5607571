// Axes that follow edits of their shapes.

import { Handle, MedialError, call, table } from "./core.mjs";
import { MedialAxis, Shape } from "./axis.mjs";
import { rings_of_lists } from "./read.mjs";
import { Records } from "./records.mjs";

/** A number of a vertex, a node or an edge, as the module takes it. */
function whole(number) {
  if (Number.isInteger(number) && number >= 0 && number < 0xffffffff) return number;
  throw new MedialError("numbers are whole and not negative", "malformed");
}
function number(value) {
  if (typeof value === "number") return value;
  throw new MedialError("a bulge is a number", "malformed");
}
function place(point) {
  if (point?.length === 2 && Array.from(point).every((x) => typeof x === "number")) return point;
  throw new MedialError("a place is a pair of x and y", "malformed");
}

/** A shape with its axis, which follows when vertices, edges and loops change. */
export class Editor extends Handle {
  #said; // attributes of the shape from its file

  constructor(x, { tolerance = 0, ...others } = {}) {
    for (const name of Object.keys(others)) throw new MedialError(`there is no option '${name}'`, "invalid_option");
    super(x instanceof Copied ? x.address : made(x, tolerance), "editor");
    if (x instanceof Shape || x instanceof Copied) this.#said = { attributes: x.attributes, document: x.document };
  }

  #change(name, ...given) {
    call(`editor_${name}`, this.address, ...given);
    const [vertex, everything] = table();
    const numbers = (i) => Uint32Array.from(table(i));
    return {
      removedNodes: numbers(1), removedEdges: numbers(2), addedNodes: numbers(3), addedEdges: numbers(4),
      vertex, everything: Boolean(everything),
    };
  }
  move(vertex, to) {
    return this.#change("move", whole(vertex), ...place(to));
  }
  /** Inserts a vertex on the edge that begins at the vertex `before`. */
  insert(before, point) {
    return this.#change("insert", whole(before), ...place(point));
  }
  remove(vertex) {
    return this.#change("remove", whole(vertex));
  }
  /** Sets the bulge of the edge that begins at a vertex: the tangent of a quarter of its angle, 0: straight. */
  setBulge(vertex, bulge) {
    return this.#change("set_bulge", whole(vertex), number(bulge));
  }
  /** Inserts a hole or an outer loop, depending on its place. Its vertices are numbered from `change.vertex` on. */
  insertLoop(points, bulges) {
    const { coordinates } = rings_of_lists([points], () => 0);
    const own = bulges && Float64Array.from(bulges, number);
    if (own && own.length !== coordinates.length / 2) throw new MedialError("a loop has a bulge for each point", "malformed");
    return this.#change("insert_loop", coordinates, coordinates.length / 2, own);
  }
  /** Removes the loop of a vertex. */
  removeLoop(vertex) {
    return this.#change("remove_loop", whole(vertex));
  }
  moveLoop(vertex, by) {
    return this.#change("move_loop", whole(vertex), ...place(by));
  }
  /** Undoes the last edit; further calls undo earlier ones. Does nothing if there is none. */
  undo() {
    return this.#change("undo");
  }
  /** An editor of its own in the same state. */
  copy() {
    return new Editor(new Copied(call("editor_copy", this.address), this.#said));
  }

  /** The place of a vertex; null if it does not exist. */
  vertex(number) {
    call("editor_vertex", this.address, whole(number));
    const [x, y] = table();
    return x === undefined ? null : [x, y];
  }
  /** The bulge of the edge that begins at a vertex; null if it does not exist. */
  bulge(vertex) {
    call("editor_vertex", this.address, whole(vertex));
    return table()[2] ?? null;
  }
  #records(kind, numbers) {
    const wanted = Uint32Array.from(numbers, whole);
    call(`editor_${kind}s`, this.address, wanted, wanted.length);
    const { buffer } = table();
    return new Records(kind, wanted.length, (Type) => new Type(buffer));
  }
  /** Nodes, edges and sites by their numbers; edges name nodes and sites by numbers. */
  nodes(numbers) {
    return this.#records("node", numbers);
  }
  edges(numbers) {
    return this.#records("edge", numbers);
  }
  sites(numbers) {
    return this.#records("site", numbers);
  }

  /** A copy of the current axis with its shape; nodes and edges are numbered from 0 without gaps. */
  get axis() {
    const address = call("editor_axis", this.address);
    return new MedialAxis(address, Shape.of(call("shape_of", address), this.#said));
  }
}

/** A new object of the module, not yet owned. */
class Copied {
  constructor(address, said) {
    Object.assign(this, { address, ...said });
  }
}

function made(x, tolerance) {
  if (x instanceof Shape) return call("editor", x.address, tolerance);
  const shape = new Shape(x);
  try {
    return call("editor", shape.address, tolerance);
  } finally {
    shape.free();
  }
}
