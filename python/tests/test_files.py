"""Files and texts: the native format, SVG, WKT, GeoJSON, fonts, graphs; beside shapely and the C++ results."""

import copy
import datetime
import gzip
import json
import os
import pathlib
import pickle
from decimal import Decimal
from pathlib import PurePosixPath

import numpy as np
import pytest

import medial

RING = [(0.0, 0.0), (10.0, 0.0), (10.0, 6.0), (0.0, 6.0)]


def test_each_text_holds_the_axis(plan):
    a = medial.axis(plan)
    assert medial.loads(a.to_text())[0] == a and medial.loads(a.to_text().encode())[0] == a
    lines = json.loads(a.to_text("geojson"))["features"]
    assert len(lines) == a.branch_count
    assert a.to_text("wkt").count("(") == a.branch_count + 1
    assert len(a.to_text("edgelist").splitlines()) == a.branch_count + 1
    rows = a.to_text("csv").splitlines()
    assert rows[0] == "edge,x,y,r" and len({row.split(",")[0] for row in rows[1:]}) == len(a)
    assert len(a.to_text("csv", simplify=0.5)) <= len(a.to_text("csv"))
    with pytest.raises(medial.MedialError) as caught:
        a.to_text("shp")
    assert caught.value.code == "unsupported"


def test_files_are_written_whole_or_not_at_all(tmp_path, plan):
    a = medial.axis(plan).prune()
    for name in ("a.json", "a.json.gz", "a.csv", "a.csv.gz"):
        a.save(tmp_path / name)
    assert medial.load(tmp_path / "a.json")[0] == medial.load(tmp_path / "a.json.gz")[0] == a
    assert medial.load(tmp_path / "a.json")[0].part
    assert gzip.decompress((tmp_path / "a.csv.gz").read_bytes()) == (tmp_path / "a.csv").read_bytes()
    with pytest.raises(medial.MedialError) as caught:
        a.save(tmp_path / "missing" / "a.json")
    assert caught.value.code == "unwritable"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.csv", "a.csv.gz", "a.json", "a.json.gz"]


def test_shapes_of_files(tmp_path, plan):
    shape = medial.Shape(plan)
    for name in ("s.wkt", "s.geojson", "s.svg", "s.json"):
        shape.save(tmp_path / name)
        (again,) = medial.read(tmp_path / name)
        assert again.area == pytest.approx(shape.area, rel=1e-6) and again.hole.sum() == 1, name
    (tmp_path / "two.wkt").write_text("POLYGON ((0 0, 4 0, 0 3, 0 0))\nPOLYGON ((9 0, 11 0, 11 2, 9 2, 9 0))\n")
    assert [part.area for part in medial.read(tmp_path / "two.wkt")] == [6, 4]
    (tmp_path / "bow.wkt").write_text("POLYGON ((0 0, 2 2, 2 0, 0 2, 0 0))\n")
    with pytest.raises(medial.MedialError) as caught:
        medial.read(tmp_path / "bow.wkt")
    assert (caught.value.code, caught.value.feature, caught.value.point) == ("crossing", 0, (1.0, 1.0))
    with pytest.warns(UserWarning):
        assert medial.read(tmp_path / "bow.wkt", repair="even_odd")[0].area == pytest.approx(2)
    (tmp_path / "x.gpkg").write_bytes(b"SQLite format 3\0")
    with pytest.raises(medial.MedialError, match="geopandas"):
        medial.read(tmp_path / "x.gpkg")
    with pytest.raises(medial.MedialError) as caught:
        medial.read(tmp_path / "none.svg")
    assert caught.value.code == "unreadable"


def test_arcs_survive_repair_and_joining():
    stadium = medial.Shape([(0, 0), (4, 0), (4, 2), (0, 2)], bulges=[0, 1, 0, 1])
    again = medial.Shape(stadium, repair="make_valid")
    assert again.area == pytest.approx(8 + np.pi) and len(again.bulges)
    square = medial.Shape([(20, 0), (22, 0), (22, 2), (20, 2)])
    both = medial.Shape([stadium, square])
    assert both.area == pytest.approx(12 + np.pi) and both.component.max() == 1


def test_letters():
    matplotlib = pytest.importorskip("matplotlib")
    font = pathlib.Path(matplotlib.get_data_path(), "fonts", "ttf", "DejaVuSans.ttf")
    shapes = medial.text("Rg8", font)
    assert [int(shape.hole.sum()) for shape in shapes] == [1, 1, 2]
    assert medial.verify(medial.axis(medial.Shape(shapes)))
    with pytest.raises(medial.MedialError):
        medial.text("R", __file__)


def test_texts_that_are_no_geometry():
    for bad in ("", "hello", "LINESTRING (0 0, 1 1)", "POLYGON EMPTY", "{}", '{"a', "POLYGON ((0 0, 1"):
        with pytest.raises(medial.MedialError) as caught:
            medial.axis(bad)
        assert "GDAL" not in str(caught.value)
    geojson = json.dumps({"type": "Polygon", "coordinates": [[*RING, RING[0]]]})
    expected = medial.axis(RING)
    for text in (geojson, "SRID=2056;POLYGON Z ((0 0 1, 10 0 1, 10 6 1, 0 6 1, 0 0 1))", "0 0\n10 0\n10 6\n0 6\n"):
        assert medial.axis(text).length == expected.length


def test_programs_of_tools():
    plate = [(0, 0), (60, 0), (60, 40), (0, 40)]
    carving = medial.carve(plate, angle=0, tool=3, depth=6, pass_depth=2, ramp=20, exterior=True, margin=9, tabs=4)
    assert carving.tabs.shape == (4, 6) and max(carving.passes) == 2 and "ramp" in dict(carving)
    assert medial.carve(plate, angle=0, tool=3, depth=6, exterior=True, margin=9, tab_spacing=30).tabs.shape[0] >= 6
    with pytest.raises(medial.MedialError, match="depth"):
        medial.carve(plate, angle=60, tabs=3)
    code = carving.to_gcode(post="linuxcnc", unit="in", feed=40, origin=(60, 0), spindle=9000)
    assert "G20" in code and "M3 S9000" in code and "F40" in code
    xs = [float(word[1:]) for line in code.splitlines() if line.startswith("G") for word in line.split() if word[0] == "X"]
    assert max(xs) < 15 and min(xs) < -60
    cleared = medial.carve(plate, angle=60, depth=4, clear_tool=6)
    assert cleared.clearing and "(tool 2:" in cleared.to_gcode(clear_feed=500)
    with pytest.raises(ValueError):
        cleared.to_gcode(unit="m")


def test_columns_are_those_of_the_axis(tmp_path, plan):
    a = medial.axis(plan)
    path = tmp_path / "a.safetensors"
    a.save(path)
    (b,) = medial.load(path)
    assert np.array_equal(b.nodes, a.nodes) and np.array_equal(b.edges, a.edges) and np.array_equal(b.sites, a.sites)
    columns = medial.columns(path)
    assert not columns["node_disk"].flags.writeable and not columns["node_disk"].flags.owndata
    assert np.array_equal(columns["node_disk"], np.stack([a.nodes["x"], a.nodes["y"], a.nodes["radius"]], axis=1))
    assert columns["item_node_begin"].tolist() == [0, len(a.nodes)]
    for damaged in (b"", path.read_bytes()[:100], path.read_bytes()[:-8], b"\x02" + b"\0" * 7 + b"{}", b"no columns"):
        (tmp_path / "b.safetensors").write_bytes(damaged)
        for read in (medial.load, medial.columns):
            if damaged.endswith(b"{}") and read is medial.columns:
                assert read(tmp_path / "b.safetensors") == {}
                continue
            with pytest.raises(medial.MedialError) as caught:
                read(tmp_path / "b.safetensors")
            assert caught.value.code in ("malformed", "unreadable")
    with pytest.raises(medial.MedialError):
        a.to_text("safetensors")
    with pytest.raises(medial.MedialError):
        medial.columns(tmp_path / "none.safetensors")


FEATURES = [
    {"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [[*RING, RING[0]]]},
     "properties": {"zip": "08001", "pop": 5, "share": 0.5, "ok": True, "none": None, "list": [1, "é"]}},
    {"type": "Feature", "geometry": None, "properties": {}},
]  # fmt: skip


def geojson(path, features):
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    return path


def test_attributes_stay_with_shapes_and_axes(tmp_path):
    with pytest.warns(UserWarning, match="1 feature has no geometry"):
        (shape,) = medial.read(geojson(tmp_path / "a.geojson", FEATURES))
    assert shape.attributes == FEATURES[0]["properties"]
    shape.save(tmp_path / "b.geojson")
    (again,) = medial.read(tmp_path / "b.geojson")
    texts = {"zip": "08001", "pop": "5", "share": "0.5", "ok": "1", "list": '[1, "é"]'}
    assert again.attributes == {**texts, "pop": 5, "share": 0.5, "ok": 1}
    a = medial.axis(shape)
    line = medial.centerline(a)
    many, editor = medial.axes([RING, shape]), medial.Editor(shape)
    assert many[0].shape.attributes == {}
    for kept in (a, many[1], editor.axis, editor.copy().axis, a.prune(), copy.copy(a), copy.deepcopy(a), pickle.loads(pickle.dumps(a)), line.axis):
        assert kept.shape.attributes == shape.attributes
    assert shape.scaled(2).attributes == medial.rebuild(a).attributes == shape.attributes
    for name in ("c.json", "c.safetensors", "c.json.gz"):
        a.save(tmp_path / name)
        assert medial.load(tmp_path / name)[0].shape.attributes == texts, name
    assert medial.loads(a.to_text())[0].shape.attributes == texts
    properties = json.loads(a.to_text("geojson"))["features"][0]["properties"]
    assert (properties["zip"], properties["pop"], properties["share"]) == ("08001", 5, 0.5)
    assert medial.axis(RING).shape.attributes == {}


def test_attributes_of_other_libraries_are_texts_numbers_or_missing():
    shape = medial.Shape(RING)
    shape.attributes = {
        "price": Decimal("1.50"), "day": datetime.date(2026, 1, 2), "path": PurePosixPath("a/b"), "half": np.float32(0.5),
        "count": np.int8(3), "pair": (1, 2), "nan": np.float32("nan"), "no_price": Decimal("nan"),
        "never": np.datetime64("NaT"), "no_time": np.timedelta64("NaT"),
    }  # fmt: skip
    expected = {"price": "1.50", "day": "2026-01-02", "path": "a/b", "half": "0.5", "count": "3", "pair": "[1, 2]"}
    assert medial.loads(medial.axis(shape).to_text())[0].shape.attributes == expected
    pandas = pytest.importorskip("pandas")
    shape.attributes = {"na": pandas.NA, "nat": pandas.NaT, "time": pandas.Timestamp(2026, 1, 2)}
    assert medial.loads(medial.axis(shape).to_text())[0].shape.attributes == {"time": "2026-01-02 00:00:00"}


def test_errors_of_files_have_a_code_and_a_place(tmp_path):
    damaged = gzip.compress(b"{}")[:10] + b"\xff" * 40
    for name in ("a.geojson.gz", "a.dxf.gz"):
        (tmp_path / name).write_bytes(damaged)
        if name.startswith("a.dxf"):
            pytest.importorskip("ezdxf")
        with pytest.raises(medial.MedialError) as caught:
            medial.read(tmp_path / name)
        assert caught.value.code == "unreadable"
    bow = {"type": "Polygon", "coordinates": [[(0, 0), (2, 2), (2, 0), (0, 2), (0, 0)]]}
    path = geojson(tmp_path / "b.geojson", [FEATURES[0], {**FEATURES[0], "geometry": bow}])
    with pytest.raises(medial.MedialError, match="b.geojson") as caught:
        medial.read(path)
    assert (caught.value.code, caught.value.feature, caught.value.ring) == ("crossing", 1, 0)
    with pytest.raises(medial.MedialError) as caught:
        medial.axis(RING).save(tmp_path / "missing" / "a.json.gz")
    assert caught.value.code == "unwritable"


def test_any_path_will_do(tmp_path):
    a = medial.axis(RING)
    for name in (b"a.json", b"\xff.json", b"a.JSON.GZ", b"\xff.json.gz"):
        path = os.path.join(os.fsencode(tmp_path), name)
        a.save(path)
        assert medial.load(path)[0] == medial.load(os.fsdecode(path))[0] == a
    a.shape.save(os.path.join(os.fsencode(tmp_path), b"\xff.wkt"))
    assert medial.read(os.path.join(os.fsencode(tmp_path), b"\xff.wkt"))[0].area == 60
    with pytest.raises(medial.MedialError):
        medial.load(os.fsencode(tmp_path) + b"/none\xff.json")
    (tmp_path / "link.json.gz").symlink_to(tmp_path / "target.json.gz")
    a.save(tmp_path / "link.json.gz")
    assert (tmp_path / "link.json.gz").is_symlink() and medial.load(tmp_path / "target.json.gz")[0] == a
