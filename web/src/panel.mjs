// The panel: settings of the axis and of the overlays.

import { Relief } from "./relief.mjs";
import { settings_distance } from "./studio.mjs";

const $ = (id) => document.getElementById(id);
const short = (x) => String(+x.toPrecision(4));

// Sliders run from 0 to 1,000; thresholds of most measures from 0 up to these.
const RANGES = {
  prominence: 1.5, significance: 2, length: 20, ratio: 6, radius: 1, angle: 180, erosion: 1, potential: 1,
  residual: 1, area: 0.5, lambda: 1, "scale-axis": 4,
};
const threshold_of = (measure, slider) => {
  if (slider === 0) return 0;
  const share = (slider / 1000) ** 2 * RANGES[measure];
  return measure === "scale-axis" || measure === "ratio" ? 1 + share : share;
};

function options(select, names) {
  select.innerHTML += names.map((name) => `<option>${name}</option>`).join("");
}

export function connect_panel(studio, tell) {
  const { medial } = studio;
  const methods = medial.methods();
  options($("method"), methods.map(({ name }) => name));
  options($("compare"), methods.map(({ name }) => name));
  options($("measure"), Object.keys(medial.pruneMeasures()));
  const note = () => ($("method-note").textContent = methods.find(({ name }) => name === studio.settings.method).summary);

  const on = (id, event, work) => $(id).addEventListener(event, work);
  on("method", "change", () => studio.set("method", $("method").value) ?? note());
  on("compare", "change", () => studio.set("compare", $("compare").value));
  for (const name of ["exact", "exterior"]) on(name, "change", () => studio.set(name, $(name).checked));
  for (const name of ["center", "cells", "field", "disks", "disk"])
    on(`show-${name}`, "change", () => studio.set(name, $(`show-${name}`).checked));
  for (const name of ["axis", "vertices"])
    on(`show-${name}`, "change", () => {
      studio.scene.show[name] = $(`show-${name}`).checked;
      studio.ask();
    });

  const prune = () => {
    studio.settings.measure = $("measure").value;
    studio.set("threshold", threshold_of($("measure").value, Number($("threshold").value)));
    $("threshold-out").textContent = studio.settings.threshold ? short(studio.settings.threshold) : "all";
  };
  on("threshold", "input", prune);
  on("measure", "change", prune);
  const offset = () => {
    studio.set("offset", $("offset").value / 1000);
    $("offset-out").textContent = studio.settings.offset ? short(settings_distance(studio)) : "none";
  };
  on("offset", "input", offset);
  const relief = new Relief($("relief"), studio);
  on("carve", "input", () => {
    studio.set("carve", Number($("carve").value));
    $("carve-out").textContent = studio.settings.carve ? `${studio.settings.carve}°` : "off";
  });

  on("check", "click", () => {
    if (!studio.axis) return tell("Draw a shape first");
    show_certificate(studio.certificate());
  });
  const forget = () => {
    $("certificate-state").textContent = "Not checked";
    $("certificate-state").className = "";
    $("certificate").hidden = true;
  };
  studio.addEventListener("computed", forget);
  studio.addEventListener("derived", () => {
    $("legend-max").textContent = short(studio.deepest);
    if (studio.settings.offset) $("offset-out").textContent = short(settings_distance(studio));
    relief.show(studio.settings.carve > 0 && !studio.dragging);
  });
  studio.addEventListener("drawn", ({ detail }) => {
    if (!detail.has("theme")) return;
    const stops = studio.theme.ramp.filter((_, i) => i % 9 === 0).join(", ");
    document.documentElement.style.setProperty("--legend", `linear-gradient(90deg, ${stops})`);
  });
  note();
  return { read: () => read(studio, note) };
}

/** Shows the settings as they are, after something else changed them. */
function read(studio, note) {
  const { settings } = studio;
  for (const name of ["method", "compare", "measure"]) $(name).value = settings[name];
  for (const name of ["exact", "exterior"]) $(name).checked = settings[name];
  for (const name of ["center", "cells", "field", "disks", "disk"]) $(`show-${name}`).checked = settings[name];
  const range = RANGES[settings.measure];
  const base = ["scale-axis", "ratio"].includes(settings.measure) ? 1 : 0;
  $("threshold").value = settings.threshold ? 1000 * Math.sqrt(Math.max(0, settings.threshold - base) / range) : 0;
  $("threshold-out").textContent = settings.threshold ? short(settings.threshold) : "all";
  $("offset").value = 1000 * settings.offset;
  $("offset-out").textContent = settings.offset ? "" : "none";
  $("carve").value = settings.carve;
  $("carve-out").textContent = settings.carve ? `${settings.carve}°` : "off";
  note();
}

function show_certificate(certificate) {
  const { passed, failures } = certificate;
  $("certificate-state").textContent = passed ? "Passed" : "Failed";
  $("certificate-state").className = passed ? "passed" : "failed";
  const rows = [
    ["disks checked", certificate.disksChecked.toLocaleString("en")],
    ["largest residual", certificate.largestResidual.toExponential(1)],
    ["bound", certificate.tolerance.toExponential(1)],
    ["parts, of the graph", `${certificate.components}, ${certificate.graphParts}`],
    ["holes, cycles", `${certificate.holes}, ${certificate.cycles}`],
    ["corners without a leaf", certificate.cornersWithoutLeaf],
    ["uncovered at most", certificate.largestUncovered.toExponential(1)],
    ...failures.map((text) => ["failed", text]),
  ];
  $("certificate").replaceChildren(
    ...rows.flatMap(([name, value]) => {
      const [dt, dd] = [document.createElement("dt"), document.createElement("dd")];
      dt.textContent = name;
      dd.textContent = value;
      return [dt, dd];
    }),
  );
  $("certificate").hidden = false;
}

