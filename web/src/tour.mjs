// A tour of the five papers whose methods the library has: the idea of each as a figure to drag.

const $ = (id) => document.getElementById(id);

const BOW = "POLYGON ((0 0, 30 0, 50 14, 70 0, 100 0, 100 50, 78 50, 76 56, 74 50, 70 50, 50 34, 30 50, 24 50, 22 56, 20 50, 0 50, 0 0))";
const POLYGON = "POLYGON ((0 10, 22 0, 46 12, 62 2, 92 8, 100 40, 80 34, 70 62, 52 44, 30 66, 24 40, 4 44, 0 10))";
const ARCS = "M 0 20 A 20 20 0 0 0 40 20 C 55 10 65 14 80 20 A 16 16 0 1 0 80 -8 C 62 -2 50 -14 36 -6 A 22 22 0 0 0 0 20 Z";
const ROOMS = "POLYGON ((0 0, 100 0, 100 60, 60 60, 60 40, 40 40, 40 60, 0 60, 0 0), (18 16, 32 16, 32 30, 18 30, 18 16))";
const SMOOTH = "M 0 0 C 20 -24 60 -26 90 -8 C 118 8 118 40 92 46 C 66 52 62 26 40 30 C 16 34 -18 22 0 0 Z";

const STEPS = [
  {
    title: "The medial axis",
    text: "<p>Set fire to the boundary of a shape. The axis is where the fires meet: the centres of all disks that fit inside and cannot grow, each with its radius.</p><p>Move the pointer over the shape to see these disks. Drag a vertex: the axis follows.</p>",
    shape: BOW, settings: {}, play: "fire",
  },
  {
    title: "Ridges on a grid",
    cite: "Volkmann and St. Clair, 1987",
    text: "<p>Compute the distance to the nearest edge at each pixel, and follow the ridge: where two pieces of the boundary are equally near. The report also asks how much a branch matters: both bumps of the bow tie are the same size.</p><p>Turn <b>Compare with</b> off and on to see the exact axis beside that of the pixels, and pull the pruning slider.</p>",
    shape: BOW, settings: { method: "ridge", compare: "disks" },
  },
  {
    title: "Voronoi diagrams of polygons",
    cite: "Lee, 1982",
    text: "<p>Cut the boundary into chains, compute the diagram of each, and merge two by two: n log n steps in all. Without the edges that end in reflex vertices, the diagram <i>is</i> the medial axis.</p><p>The cells are drawn thin; drag a reflex vertex to see its cell open.</p>",
    shape: POLYGON, settings: { method: "lee", cells: true },
  },
  {
    title: "Divide by disks",
    cite: "Aichholzer, Aigner, Aurenhammer, Hackl, Jüttler and Rabl, 2009",
    text: "<p>Curves become arcs within a known error. Any maximal disk then cuts the shape in two: the axes of the parts are computed separately and joined at its centre. So the graph is right whatever rounding does.</p><p>Each disk under the pointer is such a cut. Roll one along all branches.</p>",
    shape: ARCS, settings: { method: "biarc-dc" }, play: "roll",
  },
  {
    title: "Valleys of a potential",
    cite: "Ahuja and Chuang, 1997",
    text: "<p>Charge the border and let a particle go: it is pushed towards the middle and runs along the valleys of the potential 1 / r<sup>n</sup>, integrated along the border. The higher the order n, the closer the valleys come to the axis.</p><p>Bright is low. The thinner line is the exact axis.</p>",
    shape: ROOMS.replace(/, \(18.*\)\)/, ")"), settings: { method: "potential", field: true, compare: "disks" },
  },
  {
    title: "The curve axis",
    cite: "Shaked and Bruckstein, 1996",
    text: "<p>On a smooth curve every branch begins at the centre of the osculating circle at a maximum of curvature. From there two feet run along the boundary, steered so that one disk touches at both.</p><p>Drag a control point: where a new maximum of curvature appears, a branch grows.</p>",
    shape: SMOOTH, settings: { method: "curve-axis", compare: "disks" },
  },
  {
    title: "Now yours",
    text: "<p>Draw, drop a file, or paste coordinates. The axis is exact: zoom in a million million times, and check its certificate in the panel.</p>",
    shape: ROOMS, settings: { offset: 0.25 },
  },
];

export function start_tour(studio, { show, panel, player }) {
  let at = -1;
  const plain = { ...studio.settings };

  function go(step) {
    at = step;
    const { title, cite, text, shape, settings, play } = STEPS[at];
    $("tour-step").textContent = `${at + 1} of ${STEPS.length}`;
    $("tour-title").textContent = title;
    $("tour-text").innerHTML = (cite ? `<p><cite>${cite}</cite></p>` : "") + text;
    $("tour-back").disabled = at === 0;
    $("tour-next").textContent = at + 1 < STEPS.length ? "Next" : "Done";
    player.clear();
    Object.assign(studio.settings, plain, settings);
    panel.read();
    show(shape);
    if (play && !matchMedia("(prefers-reduced-motion: reduce)").matches) setTimeout(() => at === step && player.toggle(play), 600);
  }
  function close() {
    at = -1;
    $("tour").hidden = true;
    player.clear();
    Object.assign(studio.settings, plain);
    panel.read();
    studio.ask("axis");
    $("tour-open").focus();
  }
  $("tour-open").addEventListener("click", () => {
    $("tour").hidden = false;
    go(0);
    $("tour-next").focus();
  });
  $("tour-next").addEventListener("click", () => (at + 1 < STEPS.length ? go(at + 1) : close()));
  $("tour-back").addEventListener("click", () => go(at - 1));
  $("tour-close").addEventListener("click", close);
  addEventListener("keydown", (event) => event.key === "Escape" && at >= 0 && !document.querySelector("dialog[open]") && close());
}
