// Nodes, edges and sites of an axis: arrays of records.

export const NODE_KINDS = ["leaf", "site_change", "branching"];
export const SITE_KINDS = ["segment", "vertex", "arc"];
/** Stands for a site in a sampled axis, which does not record the sites that its disks touch. */
export const NO_SITE = 0xffffffff;

// Fields by their place in a record: of doubles, 32-bit indices and bytes.
const LAYOUT = {
  node: { size: 32, f64: { x: 0, y: 8, radius: 16 }, u32: { component: 24 }, u8: { kind: 28 } },
  edge: {
    size: 48,
    f64: { controlX: 16, controlY: 24, controlRadius: 32, weight: 40 },
    u32: { from: 0, to: 4, left: 8, right: 12 },
    u8: {},
  },
  site: {
    size: 48,
    f64: { startX: 0, startY: 8, endX: 16, endY: 24, bulge: 40 },
    u32: { ring: 32, vertex: 36 },
    u8: {},
    made: { kind: kinds_of_sites },
  },
};
/** Of each site, the index of SITE_KINDS: an arc has a bulge, a vertex equal ends. */
function kinds_of_sites({ length, startX, startY, endX, endY, bulge }) {
  const kind = (_, i) => (bulge[i] !== 0 ? 2 : startX[i] === endX[i] && startY[i] === endY[i] ? 1 : 0);
  return Uint8Array.from({ length }, kind);
}
const TYPES = { f64: [Float64Array, 8], u32: [Uint32Array, 4], u8: [Uint8Array, 1] };

/** A table whose columns are typed arrays; each is copied when it is first asked for. */
export class Records {
  #bytes;
  #layout;
  #columns = {};

  /** `bytes(Type)` gives all that lies in memory from the first record on. */
  constructor(kind, length, bytes) {
    this.#bytes = bytes;
    this.#layout = LAYOUT[kind];
    this.length = length;
    const define = (name, make) =>
      Object.defineProperty(this, name, { enumerable: true, get: () => (this.#columns[name] ??= make()) });
    for (const type of Object.keys(TYPES))
      for (const name of Object.keys(this.#layout[type])) define(name, () => this.#column(type, name));
    for (const [name, make] of Object.entries(this.#layout.made ?? {})) define(name, () => make(this));
  }

  /** The records as they lie in the module's memory, until the memory next grows or is freed. */
  view(Type = Float64Array) {
    return this.#bytes(Type).subarray(0, (this.length * this.#layout.size) / Type.BYTES_PER_ELEMENT);
  }

  #column(type, name) {
    const [Type, width] = TYPES[type];
    const from = this.view(Type);
    const stride = this.#layout.size / width;
    const column = new Type(this.length);
    for (let i = 0, at = this.#layout[type][name] / width; i < column.length; ++i, at += stride)
      column[i] = from[at];
    return column;
  }

  /** Record i as an object. */
  at(i) {
    const names = [...Object.keys(TYPES), "made"].flatMap((type) => Object.keys(this.#layout[type] ?? {}));
    return Object.fromEntries(names.map((name) => [name, this[name][i]]));
  }

  *[Symbol.iterator]() {
    for (let i = 0; i < this.length; ++i) yield this.at(i);
  }
}

/** The bytes of records from objects with the fields above. */
export function packed(kind, rows) {
  const { size, f64, u32, u8 } = LAYOUT[kind];
  const bytes = new DataView(new ArrayBuffer(Math.max(1, rows.length) * size));
  rows.forEach((row, i) => {
    const set = { f64: "setFloat64", u32: "setUint32", u8: "setUint8" };
    for (const [type, names] of Object.entries({ f64, u32, u8 }))
      for (const [name, at] of Object.entries(names)) bytes[set[type]](i * size + at, row[name], true);
  });
  return bytes;
}
