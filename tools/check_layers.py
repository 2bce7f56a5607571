#!/usr/bin/env python3
"""Checks that every file includes only its own layer and lower ones.

Public headers include no internal ones, the core never includes what only medial::io may use, and
verify shares nothing with the engines above geometry. The command line includes public headers and its
own, but for the few files of EXPERIMENTS. medial.h includes all public headers of the core.
"""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LAYERS = ["base", "raster", "geometry", "curves", "shape", "axis", "exact", "index", "engines", "ops", "verify", "volume", "io"]
# The certificate must not repeat an engine's mistake.
HIDDEN = {"verify": {"exact", "index", "engines", "ops"}}
# Experiments measure and draw what happens inside of an engine (its base cases, merge curves, orders): no
# user of the library needs that, so it stays out of the public headers. cli/CMakeLists.txt has this list too.
EXPERIMENTS = {"bench_biarc.cpp", "bench_curve_axis.cpp", "bench_lee.cpp", "bench_potential.cpp", "bench_ridge.cpp", "lee_figures.cpp"}
IO_ONLY = re.compile(r"(gdal|ogr|cpl_|geos|cairo|svgpp|libxml|dl_|ft2build|simdjson|nlohmann/|CLI/|zlib\.h|sqlite3\.h|assimp)", re.IGNORECASE)
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def faults_of_cli(path):
    """Yields one sentence for each include of `path` that the command line does not allow itself."""
    for quote, name in INCLUDE.findall(path.read_text()):
        first = name.split("/")[0]
        if quote == "<" or first in ("cli", "medial"):
            continue
        if first not in LAYERS:
            yield f'"{name}" names no layer'
        elif path.name not in EXPERIMENTS:
            yield f"the command line includes internal {name}"


def faults_of(path):
    """Yields one sentence for each include of `path` that its layer does not allow."""
    relative = path.relative_to(ROOT)
    if relative.parts[0] == "cli":
        yield from faults_of_cli(path)
        return
    public = relative.parts[0] == "include"
    layer = None if public else relative.parts[1]
    io = "io" in relative.parts[1:3]
    for quote, name in INCLUDE.findall(path.read_text()):
        first = name.split("/")[0]
        if public and quote == '"' and not name.startswith("medial/"):
            yield f"public header includes internal {name}"
        if not io and (IO_ONLY.match(name) or name.startswith("medial/io/")):
            yield f"the core includes {name}"
        if public or quote == "<" or first == "medial":
            continue
        if first not in LAYERS:
            yield f'"{name}" names no layer'
        elif LAYERS.index(first) > LAYERS.index(layer):
            yield f"{layer} includes {name} from the higher layer {first}"
        elif first in HIDDEN.get(layer, ()):
            yield f"{layer} must not share {name} with the engines"


def main():
    files = [p for folder in ("include", "src", "cli") for p in sorted((ROOT / folder).rglob("*"))
             if p.suffix in (".h", ".cpp")]
    faults = 0
    core = ROOT / "include" / "medial"
    whole = {name for _, name in INCLUDE.findall((core / "medial.h").read_text())}
    for path in core.glob("*.h"):
        if path.name != "medial.h" and f"medial/{path.name}" not in whole:
            print(f"include/medial/medial.h does not include {path.name}")
            faults += 1
    for path in files:
        relative = path.relative_to(ROOT)
        if relative.parts[0] == "src" and relative.parts[1] not in LAYERS:
            print(f"{relative}: no layer of this name")
            faults += 1
            continue
        for fault in faults_of(path):
            print(f"{relative}: {fault}")
            faults += 1
    print(f"{len(files)} files, {faults} faults")
    return 1 if faults or not files else 0


if __name__ == "__main__":
    sys.exit(main())
