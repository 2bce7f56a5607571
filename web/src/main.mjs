// Starts the studio and connects its parts to the page.

import * as medial from "medial-axis/lazy.mjs";

import { code_for } from "./code.mjs";
import { geojson_of, rings_of_file, rings_of_text, rings_of_words, save, svg_of } from "./files.mjs";
import { packed, unpacked } from "./link.mjs";
import { count_of } from "./model.mjs";
import { connect_panel } from "./panel.mjs";
import { first_part, second_part } from "./parts.mjs";
import { Player } from "./player.mjs";
import { LEAF } from "./poster.mjs";
import { Studio } from "./studio.mjs";
import { Tools } from "./tools.mjs";
import { start_tour } from "./tour.mjs";

const $ = (id) => document.getElementById(id);

// This runs when the page is read up to the canvas. An axis takes only the first part of the module: it is drawn
// before the rest of the page and of the module is read.

let read_second;
const second = new Promise((use) => (read_second = use)).then(() => $("medial-rest") && second_part());
try {
  await medial.begin(first_part(), second);
} catch (error) {
  $("toast").textContent = `The studio cannot start in this browser: ${error.message}`;
  $("toast").hidden = false;
  throw error;
}
const studio = new Studio($("plane"), medial);
globalThis.studio = studio; // for the console, and for tests

/** Draws the shape of the address, or an example; false where the address has a shape that cannot be read. */
async function first() {
  const hash = location.hash.slice(1);
  let linked = null;
  if (hash) {
    await all_read();
    linked = await unpacked(hash).catch(() => null);
  }
  Object.assign(studio.settings, linked?.settings);
  studio.change(linked?.rings ?? rings_of_text(LEAF));
  studio.fit();
  return !hash || Boolean(linked);
}
const page_read = () =>
  document.readyState === "loading" ? new Promise((done) => addEventListener("DOMContentLoaded", done)) : null;

/** Waits for the second part of the module. */
async function all_read() {
  await page_read();
  read_second();
  await medial.complete();
}
const is_small = innerWidth <= 760;
document.body.classList.toggle("no-panel", is_small);
studio.resize(innerWidth, innerHeight); // before the observer comes to it
const is_read = await first();
studio.frame();
$("poster")?.remove();
performance.mark("first axis", { detail: studio.scene.error?.code });
await new Promise((done) => requestAnimationFrame(() => setTimeout(done))); // it is shown before more is laid out
await page_read();
document.body.append($("page").content);
await all_read();
medial.startThreads().catch(({ message }) => tell(message, true)); // one, unless the page is isolated
if (studio.scene.error?.code === "incomplete") studio.ask("axis");

const tools = new Tools(studio, say);
const player = new Player(studio);

/** Announces a text to screen readers. */
function say(text) {
  $("live").textContent = text;
}

let toast_ends;
/** Shows a sentence for a while. */
function tell(text, bad = false) {
  $("toast").textContent = text;
  $("toast").classList.toggle("bad", bad);
  $("toast").hidden = false;
  $("hint").hidden = true;
  clearTimeout(toast_ends);
  toast_ends = setTimeout(() => ($("toast").hidden = true), 4000);
}

function show(rings, name) {
  if (!rings.length) return tell("It holds no closed shape", true);
  studio.change(rings);
  studio.fit();
  if (name) say(`${name}: ${count_of(rings)} vertices`);
}

async function open(file) {
  try {
    show(await rings_of_file(file), file.name);
  } catch (error) {
    tell(`${file.name}: ${error.text ?? error.message}`, true);
  }
}

// Menus.

for (const button of document.querySelectorAll("[data-menu]")) {
  const menu = $(button.dataset.menu);
  const items = () => [...menu.querySelectorAll("button")];
  const close = (focus) => {
    menu.hidden = true;
    button.setAttribute("aria-expanded", "false");
    if (focus) button.focus();
  };
  button.addEventListener("click", () => {
    const closed = menu.hidden;
    document.querySelectorAll(".menu").forEach((other) => (other.hidden = true));
    menu.hidden = !closed;
    menu.style.left = `${button.getBoundingClientRect().left}px`;
    button.setAttribute("aria-expanded", String(closed));
    if (closed) items()[0]?.focus();
  });
  menu.addEventListener("click", () => {
    close(false);
    studio.canvas.focus();
  });
  menu.addEventListener("keydown", (event) => {
    const at = items().indexOf(document.activeElement);
    const to = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: -1 }[event.key];
    if (event.key === "Escape") close(true);
    if (to === undefined) return;
    event.preventDefault();
    items().at(to % items().length).focus();
  });
  menu.addEventListener("focusout", ({ relatedTarget: to }) => to && !menu.contains(to) && to !== button && close(false));
  document.addEventListener("pointerdown", (event) => {
    if (!menu.hidden && !menu.contains(event.target) && event.target.closest("[data-menu]") !== button) close(false);
  });
}

const actions = {
  new: () => {
    studio.change([]);
    tools.choose("freehand");
  },
  open: () => $("file").click(),
  text: () => $("text").showModal(),
  paste: () => $("paste").showModal(),
  "save-svg": () => with_axis(() => save("medial.svg", svg_of(studio, studio.theme.ramp), "image/svg+xml")),
  "save-png": () => studio.canvas.toBlob((blob) => save("medial.png", blob)),
  "save-geojson": () => with_axis(() => save("medial.geojson", geojson_of(studio), "application/geo+json")),
  "save-native": () => with_axis(() => save("medial.json", medial.dumps(studio.axis), "application/json")),
  "save-gcode": () =>
    with_axis(() => save("medial.nc", medial.carve(studio.axis, { angle: studio.settings.carve || 90 }).toGcode(), "text/plain")),
  link: copy_link,
  code: () => {
    show_code("python");
    $("code").showModal();
  },
};

function with_axis(work) {
  if (!studio.axis) return tell("Draw a shape first");
  try {
    work();
  } catch (error) {
    tell(error.text ?? error.message, true);
  }
}

async function copy_link() {
  const hash = await packed(studio.rings, changed_settings());
  if (hash.length > 60_000) return tell("The shape is too large for a link; save a file instead", true);
  history.replaceState(null, "", `#${hash}`);
  try {
    await navigator.clipboard.writeText(location.href);
    tell("Link copied");
  } catch {
    tell("The link is in the address bar");
  }
}

const defaults = { ...studio.settings };
const changed_settings = () =>
  Object.fromEntries(Object.entries(studio.settings).filter(([name, value]) => value !== defaults[name]));

$("file-menu").addEventListener("click", (event) => actions[event.target.closest("[data-do]")?.dataset.do]?.());
$("file").addEventListener("change", () => {
  if ($("file").files[0]) open($("file").files[0]);
  $("file").value = "";
});

const leaf = { name: "Leaf", note: "curves, drawn by hand", text: LEAF };
for (const { name, note, text } of [leaf, ...JSON.parse($("examples").textContent)]) {
  const button = document.createElement("button");
  button.setAttribute("role", "menuitem");
  button.innerHTML = `<span>${name}<small>${note}</small></span>`;
  button.addEventListener("click", () => show(rings_of_text(text), name));
  $("examples-menu").append(button);
}

// Dialogs.

$("paste").addEventListener("close", () => {
  if ($("paste").returnValue !== "ok") return;
  try {
    show(rings_of_text($("paste-text").value));
  } catch (error) {
    tell(`This is not a shape: ${error.text ?? error.message}`, true);
  }
});
$("text").addEventListener("close", async () => {
  if ($("text").returnValue !== "ok") return;
  try {
    show(await rings_of_words($("text-words").value, $("text-font").files[0]));
  } catch (error) {
    tell(error.text ?? error.message, true);
  }
});

function show_code(language) {
  $("code-text").textContent = code_for(language, studio);
  for (const tab of document.querySelectorAll("[data-code]")) tab.setAttribute("aria-selected", tab.dataset.code === language);
}
document.querySelector(".tabs").addEventListener("click", (event) => event.target.dataset.code && show_code(event.target.dataset.code));
document.querySelector(".tabs").addEventListener("keydown", ({ key, target }) => {
  const by = { ArrowLeft: -1, ArrowRight: 1 }[key];
  if (!by) return;
  const tabs = [...document.querySelectorAll("[data-code]")];
  const to = tabs[(tabs.indexOf(target) + by + tabs.length) % tabs.length];
  to.focus();
  show_code(to.dataset.code);
});
$("code-copy").addEventListener("click", async () => {
  await navigator.clipboard.writeText($("code-text").textContent).catch(() => {});
  tell("Code copied");
});

const KEYS = [
  ["V P R C F H", "choose a tool"], ["G", "snap"], ["0", "show all"], ["+  −", "zoom"], ["Ctrl Z", "undo"],
  ["Ctrl Shift Z", "redo"], ["Tab, Shift Tab", "next, previous vertex"], ["arrows", "move the vertex, or the view"], ["Shift arrows", "ten times as far"],
  ["Ctrl arrows", "move its ring"],
  ["I", "insert a vertex"], ["Delete", "remove the vertex"], ["Shift Delete", "remove its ring"], ["[  ]", "bend the edge after it"],
  ["Q", "a curve, or a line again"], ["Enter", "close the polygon, or draw in the middle"], ["Esc", "deselect"], ["N", "new drawing"],
  ["B", "fire"], ["L", "roll"], ["Ctrl O", "open"], ["Ctrl V", "paste a shape"], ["wheel, pinch", "zoom"], ["space, right button", "pan"],
];
$("keys").innerHTML = KEYS.map(([key, what]) => `<p><span>${what}</span><b>${key}</b></p>`).join("");
$("help-open").addEventListener("click", () => $("help").showModal());

// Tools and keys.

const tool_buttons = document.querySelectorAll("[data-tool]");
tool_buttons.forEach((button) => {
  button.setAttribute("aria-label", button.title);
  button.addEventListener("click", () => tools.choose(button.dataset.tool));
});
studio.addEventListener("tool", ({ detail }) => {
  tool_buttons.forEach((button) => button.setAttribute("aria-pressed", String(button.dataset.tool === tools.tool)));
  $("hint").textContent = detail;
  $("hint").hidden = false;
  $("toast").hidden = true;
  clearTimeout(tools.hint_ends);
  tools.hint_ends = setTimeout(() => ($("hint").hidden = true), 3500);
});
function snap() {
  tools.snap = !tools.snap;
  studio.scene.show.grid = tools.snap;
  $("snap").setAttribute("aria-pressed", String(tools.snap));
  studio.ask();
}
$("snap").setAttribute("aria-label", $("snap").title);
$("zoom-fit").setAttribute("aria-label", $("zoom-fit").title);
$("snap").addEventListener("click", snap);
$("zoom-fit").addEventListener("click", () => studio.fit());
$("zoom-out").addEventListener("click", () => studio.fit());
$("undo").addEventListener("click", () => studio.undo());
$("redo").addEventListener("click", () => studio.redo());
$("panel-toggle").addEventListener("click", () => {
  const closed = document.body.classList.toggle("no-panel");
  $("panel-toggle").setAttribute("aria-expanded", String(!closed));
});
$("panel-toggle").setAttribute("aria-expanded", String(!is_small));

const letters = { v: "select", p: "polygon", r: "rectangle", c: "circle", f: "freehand", h: "hand" };
addEventListener("keydown", (event) => {
  const typing = event.target.closest("input:not([type=range]):not([type=checkbox]), textarea, select, dialog, .menu");
  if (typing) return;
  const key = event.key.toLowerCase();
  const control = event.ctrlKey || event.metaKey;
  if (control && key === "z") event.shiftKey ? studio.redo() : studio.undo();
  else if (control && key === "y") studio.redo();
  else if (control && key === "o") actions.open();
  else if (control || event.altKey) return;
  else if (letters[key]) tools.choose(letters[key]);
  else if (key === "g") snap();
  else if (key === "n") actions.new();
  else if (key === "b") player.toggle("fire");
  else if (key === "l") player.toggle("roll");
  else if (key === "0") studio.fit();
  else if (key === "+" || key === "=") studio.camera.zoom(1.25), studio.ask();
  else if (key === "-") studio.camera.zoom(0.8), studio.ask();
  else if (key === "?") $("help").showModal();
  else return;
  event.preventDefault();
});
addEventListener("paste", (event) => {
  if (event.target.closest("input, textarea")) return;
  const file = event.clipboardData.files[0];
  const text = event.clipboardData.getData("text");
  if (file) return void open(file);
  if (!text) return;
  try {
    show(rings_of_text(text));
  } catch {
    tell("The clipboard holds no shape", true);
  }
});

// Files that are dropped.

addEventListener("dragover", (event) => {
  event.preventDefault();
  $("drop").hidden = false;
});
addEventListener("dragleave", (event) => event.relatedTarget || ($("drop").hidden = true));
addEventListener("drop", (event) => {
  event.preventDefault();
  $("drop").hidden = true;
  const [file] = event.dataTransfer.files;
  if (file) open(file);
});

// The status line, and the item under the pointer.

const short = (x) => (Math.abs(x) >= 1e5 || (Math.abs(x) < 1e-3 && x !== 0) ? x.toExponential(3) : String(+x.toPrecision(5)));
studio.addEventListener("computed", () => {
  const { scene } = studio;
  const counts = [`${count_of(studio.rings).toLocaleString("en")} vertices`];
  const edges = scene.error ? undefined : edge_count();
  if (edges !== undefined) counts.push(`${edges.toLocaleString("en")} edges`);
  if (scene.error) {
    counts.push(scene.error.text);
    if ($("live").textContent !== scene.error.text) say(scene.error.text);
  }
  $("counts").textContent = counts.join(" · ");
  $("counts").className = scene.error ? "failed" : "";
  const threads = medial.threads();
  $("speed").textContent = `${studio.times.axis.toFixed(1)} ms${threads > 1 ? `, ${threads} threads` : ""}`;
});
const edge_count = () => studio.live?.count ?? studio.axis?.edges.length;
studio.addEventListener("derived", () => {
  if (studio.branches !== undefined && !studio.scene.error && edge_count() !== undefined)
    $("counts").textContent = `${count_of(studio.rings).toLocaleString("en")} vertices · ${edge_count().toLocaleString("en")} edges · ${studio.branches.toLocaleString("en")} branches`;
});
studio.addEventListener("drawn", () => {
  const zoom = studio.camera.magnification;
  $("zoom-out").textContent = zoom < 1e4 ? `${Math.round(100 * zoom)}%` : `${zoom.toExponential(1)} ×`;
});
studio.addEventListener("hover", ({ detail }) => {
  if (player.running) return;
  const disk = detail && studio.settings.disk && !studio.scene.draft ? studio.disk_at(detail) : null;
  if (!studio.settings.disks) studio.scene.disks = disk ? [disk] : null;
  $("where").textContent = detail ? `${short(detail[0])}, ${short(detail[1])}${disk ? ` · radius ${short(disk.radius)}` : ""}` : "";
});
studio.addEventListener("said", ({ detail }) => tell(detail));
studio.addEventListener("changed", () => {
  $("undo").disabled = !studio.history.canUndo;
  $("redo").disabled = !studio.history.canRedo;
});

const panel = connect_panel(studio, tell);
start_tour(studio, { show: (text) => show(rings_of_text(text)), panel, player });

// Shows the drawing that was made before the listeners were added.
for (const name of ["computed", "derived", "changed"]) studio.emit(name);
studio.ask("theme");
panel.read();

const check_link = (is_read) => is_read || tell("The link holds no drawing that can be read", true);
check_link(is_read);
addEventListener("hashchange", async () => {
  check_link(await first());
  panel.read();
});
studio.opened = true;
