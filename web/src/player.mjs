// Animations: the grass fire that burns from the boundary, and a disk that rolls along the axis.

const DURATION = { fire: 7000, roll: 14000 }; // milliseconds

export class Player {
  running = null;
  #begun = 0;

  constructor(studio) {
    this.studio = studio;
    this.time = document.getElementById("time");
    for (const kind of ["fire", "roll"]) document.getElementById(kind).addEventListener("click", () => this.toggle(kind));
    this.time.addEventListener("input", () => {
      this.kind ??= "fire";
      this.running = null;
      this.#show(this.time.value / 1000);
    });
    studio.addEventListener("computed", () => (this.way = null));
  }

  toggle(kind) {
    if (this.running === kind) return this.stop();
    if (!this.studio.axis) return;
    const from = this.kind === kind && this.time.value < 999 ? this.time.value / 1000 : 0;
    this.kind = kind;
    this.running = kind;
    this.#begun = performance.now() - from * DURATION[kind];
    this.#press();
    requestAnimationFrame((now) => this.#step(now));
  }
  stop() {
    this.running = null;
    this.#press();
  }
  /** Restores the state before the animation. */
  clear() {
    this.stop();
    this.kind = null;
    this.time.value = 0;
    this.studio.scene.fire = 0;
    this.studio.scene.disks = null;
    this.studio.ask();
  }

  #press() {
    for (const kind of ["fire", "roll"]) document.getElementById(kind).setAttribute("aria-pressed", String(this.running === kind));
  }
  #step(now) {
    if (!this.running) return;
    const share = (now - this.#begun) / DURATION[this.running];
    if (share >= 1) return this.clear();
    this.time.value = 1000 * share;
    this.#show(Math.max(0, share));
    requestAnimationFrame((next) => this.#step(next));
  }

  #show(share) {
    const { scene, deepest } = this.studio;
    scene.fire = this.kind === "fire" ? share * deepest : 0;
    if (this.kind === "roll") scene.disks = [this.#disk(share)];
    else scene.disks = null;
    this.studio.ask();
  }

  /** The disk after a share of the way along all branches. */
  #disk(share) {
    this.way ??= way_along(this.studio);
    const { rows, along } = this.way;
    const at = share * along.at(-1);
    let [low, high] = [0, along.length - 1];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (along[middle] <= at) low = middle;
      else high = middle;
    }
    const part = (at - along[low]) / (along[high] - along[low] || 1);
    const [x, y, radius] = [0, 1, 2].map((d) => rows[low][d] + part * (rows[high][d] - rows[low][d]));
    return { x, y, radius };
  }
}

/** A walk over all branches, depth first: there and back, so that the disk never jumps. */
function way_along({ axis }) {
  const lines = axis.sample();
  const ends = lines.map((line) => [line.subarray(0, 3), line.subarray(line.length - 3)].map((p) => `${p[0]} ${p[1]}`));
  const around = new Map();
  ends.forEach((pair, i) => pair.forEach((end) => around.set(end, [...(around.get(end) ?? []), i])));
  const left = new Set(lines.keys());
  const rows = [];
  const walk = (i, reverse) => {
    const line = Array.from({ length: lines[i].length / 3 }, (_, k) => [...lines[i].subarray(3 * k, 3 * k + 3)]);
    rows.push(...(reverse ? line.reverse() : line));
  };
  while (left.size) {
    const stack = [{ end: ends[[...left][0]][0], back: null }];
    while (stack.length) {
      const top = stack.at(-1);
      const next = around.get(top.end).find((i) => left.has(i));
      if (next === undefined) {
        stack.pop();
        if (top.back) walk(...top.back);
        continue;
      }
      left.delete(next);
      const reverse = ends[next][0] !== top.end;
      walk(next, reverse);
      stack.push({ end: ends[next][reverse ? 0 : 1], back: [next, !reverse] });
    }
  }
  const along = [0];
  for (let k = 1; k < rows.length; ++k)
    along.push(along[k - 1] + Math.hypot(rows[k][0] - rows[k - 1][0], rows[k][1] - rows[k - 1][1]));
  return { rows, along };
}
