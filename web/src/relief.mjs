// The cut of a V-shaped tool in 3-D: the depth is the distance to the boundary by the tool's slope.

export class Relief {
  #turn = -0.6;
  #grid = null;

  constructor(canvas, studio) {
    this.canvas = canvas;
    this.studio = studio;
    new ResizeObserver(() => this.#grid && this.#draw()).observe(canvas); // a panel that opens gives it its size
    let last = null;
    canvas.addEventListener("pointerdown", (event) => {
      last = event.clientX;
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (last === null) return;
      this.#turn_by((event.clientX - last) / 90);
      last = event.clientX;
    });
    canvas.addEventListener("pointerup", () => (last = null));
    canvas.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: -0.1, ArrowRight: 0.1 }[event.key];
      if (!by) return;
      event.preventDefault();
      this.#turn_by(by);
    });
  }

  #turn_by(angle) {
    this.#turn += angle;
    this.#draw();
  }

  show(shown) {
    this.canvas.hidden = !shown;
    if (!shown || !this.studio.shape) return;
    this.#measure();
    this.#draw();
  }

  /** Depths on a grid over the bounding box. */
  #measure() {
    const { shape, axis, settings } = this.studio;
    const [x0, y0, x1, y1] = shape.bounds;
    const across = axis.edges.length < 3000 ? 72 : 44;
    const longer = Math.max(x1 - x0, y1 - y0);
    const [nx, ny] = [x1 - x0, y1 - y0].map((side) => Math.max(4, Math.round((across * side) / longer)));
    const points = new Float64Array(2 * (nx + 1) * (ny + 1));
    for (let k = 0; k < points.length / 2; ++k) {
      points[2 * k] = x0 + ((k % (nx + 1)) / nx) * (x1 - x0);
      points[2 * k + 1] = y0 + (Math.floor(k / (nx + 1)) / ny) * (y1 - y0);
    }
    const slope = Math.tan((settings.carve * Math.PI) / 360);
    const depth = Array.from(shape.clearance(points), (c) => Math.max(0, c) / slope / longer);
    this.#grid = { nx, ny, depth, step: 1 / across };
  }

  #draw() {
    const { canvas } = this;
    const ratio = devicePixelRatio || 1;
    const { width, height } = canvas.getBoundingClientRect();
    Object.assign(canvas, { width: width * ratio, height: height * ratio });
    const c = canvas.getContext("2d");
    c.scale(ratio, ratio);
    const { nx, ny, depth, step } = this.#grid;
    const [cos, sin] = [Math.cos(this.#turn), Math.sin(this.#turn)];
    const scale = 0.82 * Math.min(width, 1.6 * height);
    const at = (i, j) => {
      const [x, y, z] = [(i - nx / 2) * step, (j - ny / 2) * step, -Math.min(depth[j * (nx + 1) + i], 0.6)];
      const [u, v] = [cos * x - sin * y, sin * x + cos * y];
      return { x: width / 2 + u * scale, y: height * 0.46 - (v * 0.62 + z * 0.8) * scale, far: v };
    };
    const faces = [];
    for (let j = 0; j < ny; ++j)
      for (let i = 0; i < nx; ++i) {
        const corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        const d = (k, l) => depth[l * (nx + 1) + k];
        const [gx, gy] = [(d(i + 1, j) - d(i, j)) / step, (d(i, j + 1) - d(i, j)) / step];
        const light = (1 + 0.75 * (gx * (cos * -0.5 + sin * 0.7) + gy * (sin * 0.5 + cos * 0.7))) / Math.hypot(gx, gy, 1);
        faces.push({ corners, far: corners[0].far, light, cut: d(i, j) + d(i + 1, j + 1) > 0 });
      }
    faces.sort((a, b) => b.far - a.far);
    for (const { corners, light, cut } of faces) {
      const tone = Math.round(Math.min(92, Math.max(18, 30 + 40 * light)));
      c.fillStyle = cut ? `hsl(28 48% ${tone}%)` : `hsl(30 22% ${tone}%)`;
      c.strokeStyle = c.fillStyle;
      c.beginPath();
      corners.forEach((p, k) => (k ? c.lineTo(p.x, p.y) : c.moveTo(p.x, p.y)));
      c.closePath();
      c.fill();
      c.stroke();
    }
  }
}
