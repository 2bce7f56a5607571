#!/usr/bin/env python3
"""Medial axes of the shapes in data/, as pictures and numbers.

    tools/demo.py PROGRAM FOLDER

For each shape: its axis in medial's own format, a picture as SVG and as PNG, the verdict of
`medial verify`, and one line that sums up. Exit status 1 if anything failed.
"""

import json
import pathlib
import subprocess
import sys

DATA = pathlib.Path(__file__).resolve().parent.parent / "data"
# What the shape is, its file, and the options of its axis and of its picture.
SHAPES = [
    ("an island with its lakes", "newfoundland.wkt.gz", [], ["--width=1600"]),
    ("a country on a map", "switzerland.geojson", ["--project"], ["--disks=60"]),
    ("a gear", "gear.wkt", [], ["--disks=60"]),
    ("a building plan", "plan.wkt", [], ["--disks=60", "--nodes"]),
    ("a maze", "maze.wkt", [], []),
    ("a drawing of a plate", "plate.dxf", [], ["--disks=60"]),
    ("a spanner, with curves", "spanner.svg", [], ["--disks=60"]),
]
HEAD = f"{'':26}{'vertices':>9}{'holes':>7}{'nodes':>9}{'branches':>10}{'deepest disk':>14}" \
       f"{'seconds':>9}  verdict"


def medial(program, *words):
    """Runs one command and returns its exit status and the JSON object that it printed, if any."""
    done = subprocess.run([program, *map(str, words), "--quiet"], stdout=subprocess.PIPE, text=True,
                          check=False)
    return done.returncode, json.loads(done.stdout) if done.stdout.startswith("{") else None


def show(program, title, file, axis_switches, picture_switches, folder):
    """Computes, checks and draws one shape; returns whether all went well."""
    source = DATA / file
    target = folder / file.split(".")[0]
    axis = target.with_suffix(".json")
    status, result = medial(program, "axis", source, "-o", axis, "--json", "--stats",
                            *axis_switches)
    if status != 0:
        return False
    _, stored = medial(program, "info", axis, "--json")
    verdict, _ = medial(program, "verify", source, axis, *axis_switches, "--json")
    drawn = [medial(program, "draw", axis, "-o", target.with_suffix(suffix), *picture_switches)[0]
             for suffix in (".svg", ".png")]
    print(f"{title:26}{stored['shape']['vertices']:9}{stored['shape']['holes']:7}"
          f"{result['nodes']:9}{result['branches']:10}{result['deepest']['radius']:14.7g}"
          f"{result['seconds']['axis']:9.4f}  {'verified' if verdict == 0 else 'REFUSED'}",
          flush=True)
    return verdict == 0 and drawn == [0, 0]


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    print(HEAD)
    good = [show(program, *shape, folder) for shape in SHAPES]
    print(f"The pictures are in {folder}: *.svg and *.png; each axis is there as *.json.")
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
