// The part of the plane that the canvas shows. y points up in the plane and down on the screen. The center is
// kept as a sum of two doubles: of one alone, a step across the screen at a zoom of 1e12 would be lost.

export class Camera {
  width = 1;
  height = 1;
  scale = 1; // pixels for each unit
  #center = [0, 0];
  #rest = [0, 0];

  toScreen(x, y) {
    return [
      this.width / 2 + (x - this.#center[0] - this.#rest[0]) * this.scale,
      this.height / 2 - (y - this.#center[1] - this.#rest[1]) * this.scale,
    ];
  }
  toPlane(px, py) {
    return [
      this.#center[0] + (this.#rest[0] + (px - this.width / 2) / this.scale),
      this.#center[1] + (this.#rest[1] - (py - this.height / 2) / this.scale),
    ];
  }
  /** The map for loops over many points: screen = (plane - center) * scale + half. */
  get transform() {
    const [cx, cy] = this.#center;
    const { scale, width, height } = this;
    return { cx, cy, dx: width / 2 - this.#rest[0] * scale, dy: height / 2 + this.#rest[1] * scale, scale };
  }
  /** The visible part of the plane. */
  get view() {
    const [x0, y1] = this.toPlane(0, 0);
    const [x1, y0] = this.toPlane(this.width, this.height);
    return [x0, y0, x1, y1];
  }

  pan(dx, dy) {
    this.#rest[0] -= dx / this.scale;
    this.#rest[1] += dy / this.scale;
    this.#carry();
  }
  /** Zooms about a place of the screen. */
  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const wanted = Math.min(Math.max(this.scale * factor, this.smallest), this.largest);
    const [dx, dy] = [px - this.width / 2, py - this.height / 2];
    this.#rest[0] += dx / this.scale - dx / wanted;
    this.#rest[1] -= dy / this.scale - dy / wanted;
    this.scale = wanted;
    this.#carry();
  }
  /** Shows a box, with a margin, and makes this view zoom 1. */
  fit([x0, y0, x1, y1], margin = [0, 0, 0, 0]) {
    const [top, right, bottom, left] = margin;
    const [w, h] = [Math.max(x1 - x0, 1e-300), Math.max(y1 - y0, 1e-300)];
    const [sw, sh] = [Math.max(this.width - left - right, 50), Math.max(this.height - top - bottom, 50)];
    this.scale = Math.min((0.86 * sw) / w, (0.86 * sh) / h);
    this.home = this.scale;
    this.#center = [x0 + (x1 - x0) / 2, y0 + (y1 - y0) / 2];
    this.#rest = [(right - left) / 2 / this.scale, (top - bottom) / 2 / this.scale];
  }
  home = 1;
  get smallest() {
    return this.home * 1e-3;
  }
  get largest() {
    return this.home * 1e13;
  }
  get magnification() {
    return this.scale / this.home;
  }

  #carry() {
    for (const d of [0, 1]) {
      const sum = this.#center[d] + this.#rest[d];
      this.#rest[d] = this.#center[d] - sum + this.#rest[d];
      this.#center[d] = sum;
    }
  }
}
