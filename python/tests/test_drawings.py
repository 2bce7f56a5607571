"""DXF through ezdxf: closed forms, what is refused, and the same bits as the command line."""

import gzip
import math
import os
import pathlib
import shutil
import subprocess

import numpy as np
import pytest

import medial

ezdxf = pytest.importorskip("ezdxf")

PROGRAM = os.environ.get("MEDIAL_PROGRAM") or shutil.which("medial")
DATA = pathlib.Path(__file__).parents[2] / "data"


def plate(path, **saved):
    """Loose lines and an arc around a plate; holes in a block: round, oval, drawn, a spline; text; a hidden layer."""
    document = ezdxf.new(units=1)
    model = document.modelspace()
    model.add_line((0, 0), (10, 0))
    model.add_line((10, 6), (0, 6))
    model.add_line((0, 6), (0, 0))
    model.add_arc((10, 3), 3, -90, 90)
    block = document.blocks.new("holes", base_point=(1, 0))
    block.add_circle((1, 0), 1)
    block.add_ellipse((4, 0), (1, 0), 0.5)
    block.add_lwpolyline([(6, -1, 0), (8, -1, 0), (8, 1, 1), (6, 1, 0)], format="xyb", close=True)
    model.add_blockref("holes", (2, 3), {"layer": "0"})
    model.add_text("plate")
    document.layers.add("notes").off()
    model.add_circle((50, 50), 4, {"layer": "notes"})
    document.saveas(path, **saved)
    return 60 + 4.5 * math.pi - math.pi - math.pi / 2 - (4 + math.pi / 2)


def blocks(path):
    """Copies of copies: mirrored, turned, scaled by two factors, in rows and columns; a second layer; a polyline."""
    document = ezdxf.new()
    leaf = document.blocks.new("leaf")
    leaf.add_lwpolyline([(0, 0, 0.3), (3, 0, 0), (3, 1, -0.4), (0, 1, 0)], format="xyb", close=True)
    leaf.add_arc((5, 0), 1, 30, 200)
    leaf.add_line((5 + math.cos(math.radians(200)), math.sin(math.radians(200))),
                  (5 + math.cos(math.radians(30)), math.sin(math.radians(30))))  # fmt: skip
    twig = document.blocks.new("twig")
    twig.add_blockref("leaf", (0, 0), {"rotation": 30, "yscale": -1})
    twig.add_blockref("leaf", (0, 9), {"xscale": 2, "yscale": 0.5, "layer": "other"})
    model = document.modelspace()
    model.add_blockref("twig", (20, 0), {"row_count": 2, "column_count": 3, "row_spacing": 30, "column_spacing": 25,
                                         "rotation": 90})  # fmt: skip
    model.add_blockref("leaf", (-30, -30), {"extrusion": (0, 0, -1), "layer": "other"})
    model.add_polyline2d([(0, -20, 0.5), (6, -20, 0), (3, -15, 0)], format="xyb", close=True)
    model.add_open_spline([(-40, 0), (-30, 0), (-30, 8), (-42, 9), (-40, 0)])
    model.add_circle((9, -40), 2, {"extrusion": (0, 0, -1)})
    model.add_line((0, -60), (5, -60))  # stays open
    document.saveas(path)


def net(path):
    """No loop of lines alone: three cells."""
    document = ezdxf.new("R12")
    model = document.modelspace()
    for a, b in [((0, 0), (4, 0)), ((0, 0), (0, 2)), ((4, 0), (4, 2)), ((0, 2), (4, 2)), ((0, 2), (0, 5)),
                 ((4, 2), (4, 5)), ((0, 5), (4, 5)), ((0, 5), (0, 9)), ((4, 5), (4, 9)), ((0, 9), (4, 9))]:  # fmt: skip
        model.add_line(a, b)
    document.saveas(path)


@pytest.mark.filterwarnings("ignore::UserWarning")
def test_a_plate_of_entities(tmp_path):
    area = plate(tmp_path / "plate.dxf")
    with pytest.warns(UserWarning, match="1 TEXT"):
        (shape,) = medial.read(tmp_path / "plate.dxf")
    assert shape.area == pytest.approx(area, rel=1e-6) and shape.hole.sum() == 3
    assert shape.attributes == {"layer": "0"} and medial.verify(medial.axis(shape))
    (large,) = medial.read(tmp_path / "plate.dxf", unit="mm")
    assert large.area == pytest.approx(shape.area * 25.4**2)
    (hidden,) = medial.read(tmp_path / "plate.dxf", layer="notes")
    assert hidden.area == pytest.approx(16 * math.pi) and hidden.attributes == {"layer": "notes"}
    (tmp_path / "plate.dxf.gz").write_bytes(gzip.compress((tmp_path / "plate.dxf").read_bytes()))
    plate(tmp_path / "binary.dxf", fmt="bin")
    assert medial.read(tmp_path / "plate.dxf.gz") == medial.read(tmp_path / "binary.dxf") == [shape]
    with pytest.raises(medial.MedialError, match="no layer 'x'"):
        medial.read(tmp_path / "plate.dxf", layer="x")


def test_gaps(tmp_path):
    document = ezdxf.new()
    document.modelspace().add_lwpolyline([(0, 0), (4, 0), (4, 3), (0.01, 0)])
    document.saveas(tmp_path / "open.dxf")
    with pytest.raises(medial.MedialError, match=r"close=math\.inf") as caught:
        medial.read(tmp_path / "open.dxf")
    assert caught.value.code == "empty"
    assert medial.read(tmp_path / "open.dxf", close=math.inf)[0].area == pytest.approx(5.985)
    assert medial.read(tmp_path / "open.dxf", close=0.02)[0].area == pytest.approx(6, rel=0.01)


# Entities without a version, without subclasses and without handles, as small programs write them.
BARE = """0 SECTION
2 ENTITIES
0 LWPOLYLINE
8 A
90 3
70 1
10 0
20 0
42 1
10 4
20 0
10 4
20 3
0 ENDSEC
0 EOF
"""


def bare(change=lambda text: text):
    return "\n".join(line.replace(" ", "\n", 1) for line in change(BARE).splitlines()) + "\n"


def test_a_drawing_without_a_version(tmp_path):
    (tmp_path / "bare.dxf").write_text(bare())
    (shape,) = medial.read(tmp_path / "bare.dxf")
    assert shape.area == pytest.approx(6 + 2 * math.pi) and shape.attributes == {"layer": "A"}


@pytest.mark.parametrize(("change", "code"), [
    (lambda text: text.replace("0 EOF\n", ""), "malformed"),
    (lambda text: text.replace("20 3", "20 three"), "malformed"),
    (lambda text: text.replace("20 3", "20 3x"), "malformed"),
    (lambda text: text.replace("20 3", "20 nan"), "not_finite"),
    (lambda text: text.replace("20 3", "2 3"), "malformed"),
    (lambda text: text.replace("20 3", "20.5 3"), "malformed"),
    (lambda text: text.replace("8 A", "eight A"), "malformed"),
    (lambda text: text.replace("0 LWPOLYLINE", "0 CIRCLE"), "malformed"),
    (lambda text: "", "malformed"),
])  # fmt: skip
def test_what_is_refused(tmp_path, change, code):
    (tmp_path / "bad.dxf").write_text(bare(change))
    with pytest.raises(medial.MedialError) as caught:
        medial.read(tmp_path / "bad.dxf")
    assert caught.value.code == code


def test_what_cannot_be_read(tmp_path):
    for name in ("none.dxf", ".dxf"):
        with pytest.raises(medial.MedialError) as caught:
            medial.read(tmp_path / name)
        assert caught.value.code == "unreadable"


@pytest.mark.skipif(PROGRAM is None, reason="the command line is not built")
@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.parametrize("name", ["plate", "blocks", "net", *sorted(path.name for path in DATA.glob("*.dxf"))])
def test_the_same_bits_as_the_command_line(tmp_path, name):
    made = {"plate": plate, "blocks": blocks, "net": net}.get(name)
    source = tmp_path / f"{name}.dxf" if made else DATA / name
    if made:
        made(source)
    subprocess.run([PROGRAM, "axis", source, "-o", tmp_path / "a.json"], capture_output=True, check=True)
    theirs, ours = medial.load(tmp_path / "a.json"), medial.read(source)
    assert len(ours) == len(theirs) and [a.shape for a in theirs] == ours
    assert [medial.axis(shape) for shape in ours] == theirs
    assert len(ours) == {"blocks": 2, "net": 3}.get(name, 1) and np.all([s.area > 0 for s in ours])
