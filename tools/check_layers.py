#!/usr/bin/env python3
"""Checks that every file includes only its own layer and lower ones.

Each public header belongs to a layer too, and counts as a file of that layer. The core includes nothing
that only medial::io may use. The command line and the papers' programs stand above all layers; the command
line sees public headers only. medial.h includes all public headers of the core.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# From the lowest to the highest, each with its public headers.
LAYERS = {
    "base": ["geometry", "error", "threads"],
    "shape": ["shape", "planar_graph"],
    "curve": ["contour"],
    "site": [],
    "axis": ["statistics", "axis", "query"],
    "verify": ["verify"],
    "methods": ["compute", "editor", "methods", "raster"],
    "voronoi": ["voronoi"],
    "ops": ["carve", "centreline", "features", "measure", "offset", "pack", "prune", "sides", "tiles"],
    "volume": ["volume"],
    "load": ["document", "load"],
    "text": ["io/*"],
    "io": [],
    "all": ["medial"],
}
ORDER = list(LAYERS)
LAYER_OF_HEADER = {f"medial/{name}.h": layer for layer, names in LAYERS.items() for name in names}
# The certificate must not repeat an engine's mistakes: it uses only these files of the layers below it.
SHARED_WITH_VERIFY = ("base/", "shape/", "axis/", "verify/", "medial/", "site/joint.h")
# The files of src/io that need libraries which Python and browsers lack; the rest is the layer `text`.
BEYOND_TEXT = re.compile(r"io/(gis/|pictures/|formats/(dxf|font|pack|assimp))")
LIBRARIES_OF_TEXT = re.compile(r"(svgpp|libxml|simdjson|nlohmann/|zlib\.h)")
IO_ONLY = re.compile(r"(gdal|ogr|cpl_|geos|cairo|png\.h|svgpp|libxml|dl_|ft2build|simdjson|nlohmann/|CLI/|zlib\.h|assimp|shapefil\.h)", re.IGNORECASE)
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def layer_of_include(name):
    """The layer of an included file of the project's own; None if it belongs to no layer."""
    if name.startswith("medial/io/"):
        return "text"
    if name.startswith("medial/"):
        return LAYER_OF_HEADER.get(name)
    if name.startswith("io/"):
        return "io" if BEYOND_TEXT.match(name) else "text"
    return name.split("/")[0] if name.split("/")[0] in LAYERS else None


def faults_of(path):
    """Yields one sentence for each include of `path` that its layer does not allow."""
    relative = path.relative_to(ROOT)
    public = relative.parts[0] == "include"
    layer = layer_of_include("/".join(relative.parts[1:]))
    if layer is None:
        yield "belongs to no layer"
        return
    for quote, name in INCLUDE.findall(path.read_text()):
        if layer != "io" and IO_ONLY.match(name) and not (layer == "text" and LIBRARIES_OF_TEXT.match(name)):
            yield f"{layer} includes {name}"
        if quote == "<":
            continue
        included = layer_of_include(name)
        if public and not name.startswith("medial/"):
            yield f"public header includes internal {name}"
        elif included is None:
            yield f'"{name}" belongs to no layer'
        elif layer == "verify" and not name.startswith(SHARED_WITH_VERIFY):
            yield f"the certificate includes {name}, which decides for the engines"
        elif ORDER.index(included) > ORDER.index(layer):
            yield f"{layer} includes {name} from the higher layer {included}"


def faults_of_cli(path):
    """Yields one sentence for each internal header that the command line includes."""
    for quote, name in INCLUDE.findall(path.read_text()):
        if quote == '"' and name.split("/")[0] not in ("cli", "medial"):
            yield f"the command line includes internal {name}"


def main():
    def sources(folder):
        return [p for p in sorted((ROOT / folder).rglob("*")) if p.suffix in (".h", ".cpp")]

    faults = []
    core = ROOT / "include" / "medial"
    whole, open_ends = set(), ["medial/medial.h"]
    while open_ends:
        name = open_ends.pop()
        whole.add(name)
        names = {name for _, name in INCLUDE.findall((ROOT / "include" / name).read_text())}
        open_ends += [name for name in names if name.startswith("medial/") and name not in whole]
    faults += [f"include/medial/medial.h does not include {path.name}" for path in sorted(core.glob("*.h"))
               if f"medial/{path.name}" not in whole]
    files = sources("include") + sources("src")
    for path in files:
        faults += [f"{path.relative_to(ROOT)}: {fault}" for fault in faults_of(path)]
    for path in sources("cli"):
        faults += [f"{path.relative_to(ROOT)}: {fault}" for fault in faults_of_cli(path)]
    print("\n".join([*faults, f"{len(files)} files, {len(faults)} faults"]))
    return 1 if faults or not files else 0


if __name__ == "__main__":
    sys.exit(main())
