"""The same bits as the command line."""

import json
import os
import shutil
import subprocess
import sys

import numpy as np
import pytest

import medial
from medial._records import packed

PROGRAM = os.environ.get("MEDIAL_PROGRAM") or shutil.which("medial")
pytestmark = pytest.mark.skipif(PROGRAM is None, reason="the command line is not built")

WKT = [
    "POLYGON ((0 0, 10 0, 10 4, 5 4, 5 12, 0 12, 0 0))",
    "POLYGON ((0 0, 10 0, 10 6, 0 6, 0 0), (4 2, 4 4, 6 4, 6 2, 4 2))",
    "MULTIPOLYGON (((0 0, 3 0, 1 1, 0 3, 0 0)), ((9 9, 12 9, 12 9.7, 9.1 13, 9 9)))",
]


def run(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, check=True)


CASES = [(method, wkt) for method in ("disks", "biarc-dc", "potential", "ridge") for wkt in WKT]


@pytest.mark.parametrize(("method", "wkt"), CASES)
def test_axes_are_bit_equal(tmp_path, method, wkt):
    source, result = tmp_path / "a.wkt", tmp_path / "a.json"
    source.write_text(wkt + "\n")
    run("axis", source, "--method", method, "-o", result)
    (theirs,) = medial.load(result)
    ours = medial.axis(wkt, method)
    assert theirs == ours
    ours.save(tmp_path / "b.json")
    run("verify", source, tmp_path / "b.json")


def test_curves_are_bit_equal(tmp_path):
    path = "M 0 0 C 3 -4 8 0 0 6 S -3 -4 0 0 z"
    source, result = tmp_path / "a.svg", tmp_path / "a.json"
    source.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 20 20"><path d="{path}"/></svg>')
    run("axis", source, "-o", result)
    (theirs,) = medial.load(result)
    ours = medial.axis(path)
    assert np.array_equal(packed(theirs.nodes), packed(ours.nodes)) and theirs.shape.area == ours.shape.area


def test_offsets_and_codes_are_equal(tmp_path):
    source, result = tmp_path / "a.wkt", tmp_path / "o.json"
    source.write_text(WKT[1] + "\n")
    run("offset", source, "--distance", "0.5,1.5", "-o", result)
    regions = json.loads(result.read_text())["items"][0]["regions"]
    ours = medial.offset(WKT[1], [0.5, 1.5])
    assert [region["clearance"] for region in regions] == [region.distance for region in ours]
    for theirs, region in zip(regions, ours, strict=True):
        for ring, (points, bulges) in zip(theirs["rings"], region.rings, strict=True):
            assert [row[:2] for row in ring] == points.tolist()
            assert [row[2] if len(row) > 2 else 0 for row in ring] == bulges.tolist()


def test_gcode_is_equal(tmp_path):
    source, result = tmp_path / "a.wkt", tmp_path / "a.nc"
    source.write_text(WKT[0] + "\n")
    run("carve", source, "--angle", "60", "--depth", "2", "--tip", "0.2", "--pass-depth", "0",
        "--ramp", "90", "-o", result)
    ours = medial.carve(WKT[0], angle=60, depth=2, tip=0.2).to_gcode()

    def moves(text):
        return [line for line in text.splitlines() if line.startswith(("G0 ", "G1 ", "G2 ", "G3 "))]

    assert moves(ours) == moves(result.read_text())


def test_program():
    done = subprocess.run([sys.executable, "-m", "medial", "--version"], capture_output=True,
                          env={**os.environ, "MEDIAL_PROGRAM": PROGRAM})
    assert done.returncode == 0 and b"medial" in done.stdout
