// Boxes by their numbers, found by place. A box is in one cell of a pyramid of grids: on the level whose
// cells are as large as it is, in the cell that holds its middle, so that it comes and goes in O(1). Cells
// in the next row may hold boxes that reach here: each is looked at as if it were twice as large.

const LEVELS = 11;

/** A typed array with room for this many, and the old contents. */
export function grown(array, size, fill = 0) {
  if (size <= array.length) return array;
  const larger = new array.constructor(Math.max(size, Math.ceil(1.25 * array.length)));
  larger.set(array);
  if (fill) larger.fill(fill, array.length);
  return larger;
}

export class Quads {
  #first = Array.from({ length: LEVELS }, () => null);
  #next = new Int32Array(0);
  #before = new Int32Array(0);
  #cell = new Int32Array(0); // -1: the number is not in use
  #level = new Uint8Array(0);

  constructor([x0, y0, x1, y1], room) {
    this.x = x0;
    this.y = y0;
    this.side = Math.max(x1 - x0, y1 - y0) || 1;
    this.#reserve(room);
  }

  #reserve(room) {
    const from = this.#cell.length;
    this.#next = grown(this.#next, room);
    this.#before = grown(this.#before, room);
    this.#level = grown(this.#level, room);
    this.#cell = grown(this.#cell, room);
    if (this.#cell.length > from) this.#cell.fill(-1, from);
  }

  get room() {
    return this.#cell.length;
  }
  has(number) {
    return number < this.#cell.length && this.#cell[number] >= 0;
  }

  add(number, x0, y0, x1, y1) {
    if (number >= this.#cell.length) this.#reserve(number + 1);
    const share = Math.max(x1 - x0, y1 - y0) / this.side;
    const level = share > 0 ? Math.min(LEVELS - 1, Math.max(0, Math.floor(-Math.log2(share)))) : LEVELS - 1;
    const count = 1 << level;
    const cell = this.#row((y0 + y1) / 2 - this.y, count) * count + this.#row((x0 + x1) / 2 - this.x, count);
    const first = (this.#first[level] ??= new Int32Array(count * count).fill(-1));
    this.#level[number] = level;
    this.#cell[number] = cell;
    this.#before[number] = -1;
    this.#next[number] = first[cell];
    if (first[cell] >= 0) this.#before[first[cell]] = number;
    first[cell] = number;
  }
  #row(away, count) {
    return Math.min(count - 1, Math.max(0, Math.floor((away / this.side) * count)));
  }

  remove(number) {
    const [next, before] = [this.#next[number], this.#before[number]];
    if (before < 0) this.#first[this.#level[number]][this.#cell[number]] = next;
    else this.#next[before] = next;
    if (next >= 0) this.#before[next] = before;
    this.#cell[number] = -1;
  }

  /**
   * Calls visit(number) for each box that may meet the given one, and for some that do not. In each cell of
   * the last level, `most` boxes are visited at most.
   */
  find([x0, y0, x1, y1], visit, most = Infinity) {
    for (let level = 0; level < LEVELS; ++level) {
      const first = this.#first[level];
      if (!first) continue;
      const count = 1 << level;
      const half = this.side / count / 2;
      const [from, to] = [this.#row(x0 - half - this.x, count), this.#row(x1 + half - this.x, count)];
      const [low, high] = [this.#row(y0 - half - this.y, count), this.#row(y1 + half - this.y, count)];
      for (let row = low; row <= high; ++row)
        for (let cell = row * count + from; cell <= row * count + to; ++cell)
          for (let at = first[cell], left = level + 1 < LEVELS ? Infinity : most; at >= 0 && left > 0; at = this.#next[at], --left) visit(at);
    }
  }
  /** How large a cell of the last level is. */
  get finest() {
    return this.side / (1 << (LEVELS - 1));
  }

  /** An approximate upper bound on the cost of find(): the share of the whole that a box covers. */
  share([x0, y0, x1, y1]) {
    const part = (a, b, from) => Math.max(0, Math.min(b, from + this.side) - Math.max(a, from)) / this.side;
    return part(x0, x1, this.x) * part(y0, y1, this.y);
  }
}
