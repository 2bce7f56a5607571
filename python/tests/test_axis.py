"""The axis of one shape: inputs, arrays, copies, errors."""

import copy
import pickle
import subprocess
import sys

import numpy as np
import pytest

import medial
from medial._records import packed


def same_sites(a, b):
    return np.array_equal(packed(a.sites), packed(b.sites))


def test_every_kind_of_input_gives_the_same_axis(rectangle):
    expected = medial.axis(np.array(rectangle))
    closed = [*rectangle, rectangle[0]]
    wkt = "POLYGON ((0 0, 4 0, 4 2, 0 2, 0 0))"
    for x in (
        rectangle,
        [rectangle],
        closed,
        wkt,
        {"type": "Polygon", "coordinates": [closed]},
        {"type": "Feature", "geometry": {"type": "Polygon", "coordinates": [closed]}},
        medial.Shape(rectangle),
        np.array(rectangle, np.float32),
    ):
        assert np.array_equal(packed(medial.axis(x).nodes), packed(expected.nodes)), x


def test_shapely_and_wkb_in_both_byte_orders(plan):
    shapely = pytest.importorskip("shapely")
    geometry = shapely.geometry.shape(plan)
    expected = medial.axis(plan)
    assert medial.axis(geometry) == expected
    for order in (0, 1):
        assert medial.axis(shapely.to_wkb(geometry, byte_order=order)) == expected
    assert medial.axis(shapely.to_wkb(shapely.force_3d(geometry, 7))) == expected
    assert medial.axis(geometry.wkt) == expected
    multi = shapely.MultiPolygon([geometry, shapely.box(20, 0, 22, 1)])
    assert medial.axis(multi).shape.area == pytest.approx(multi.area)


def test_wrong_well_known_binary_is_an_error_with_a_place():
    with pytest.raises(medial.MedialError) as caught:
        medial.axis(b"\x01\x03\x00\x00\x00\xff\xff\xff\xff")
    assert caught.value.code == "malformed" and caught.value.feature == 0
    for bad in ("POLYGON ((0 0, 1", "LINESTRING (0 0, 1 1)", "hello", "M 0 0 L 1"):
        with pytest.raises(medial.MedialError):
            medial.axis(bad)


def test_curves():
    circle = medial.axis("M 2 0 A 2 2 0 0 1 -2 0 A 2 2 0 0 1 2 0 Z")
    assert len(circle.nodes) == 1 and circle.nodes["radius"][0] == pytest.approx(2, abs=1e-12)
    stadium = medial.Contour((0, 0)).line_to((4, 0)).arc_to((4, 2), 1).line_to((0, 2)).arc_to((0, 0), 1)
    assert medial.axis(stadium).length == pytest.approx(4, abs=1e-12)
    bulged = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)], bulges=[0, 1, 0, 1])
    assert bulged.length == pytest.approx(4, abs=1e-12)
    ellipse = medial.axis("M 0 0 a 4 2 0 0 1 8 0 a 4 2 0 0 1 -8 0 z", arc_tolerance=1e-4)
    assert ellipse.shape.area == pytest.approx(np.pi * 8, rel=1e-3)
    heart = medial.axis("M 0 0 C 3 -4 8 0 0 6 S -3 -4 0 0 z", arc_tolerance=1e-3)
    assert medial.verify(heart)


def test_views_are_read_only_and_outlive_the_axis(rectangle):
    nodes = medial.axis(rectangle).nodes
    assert not nodes.flags.writeable and not nodes.flags.owndata
    with pytest.raises(ValueError):
        nodes["x"] = 0
    assert nodes["radius"].max() == pytest.approx(1, abs=1e-15)


def test_errors_name_their_place():
    with pytest.raises(medial.MedialError) as caught:
        medial.axis([[(0, 0), (4, 0), (4, 4), (0, 4)], [(1, 1), (3, 3), (3, 1), (1, 3)]])
    error = caught.value
    assert (error.code, error.ring, error.point) == ("crossing", 1, (2.0, 2.0))
    assert isinstance(error, ValueError) and "ring 1" in str(error)
    assert pickle.loads(pickle.dumps(error)).point == error.point
    with pytest.raises(medial.MedialError, match="no method"):
        medial.axis([(0, 0), (1, 0), (0, 1)], "nonsense")
    with pytest.raises(TypeError, match="no option 'sed'"):
        medial.axis([(0, 0), (1, 0), (0, 1)], "biarc-dc", sed=1)
    for bad in (np.zeros((3, 2)), np.full((4, 2), np.nan), np.zeros((0, 2)), []):
        with pytest.raises(medial.MedialError):
            medial.axis(bad)


def test_repair():
    bow = [(0, 0), (2, 2), (2, 0), (0, 2)]
    with pytest.warns(UserWarning):
        mended = medial.axis(bow, repair="even_odd")
    assert mended.shape.area == pytest.approx(2)


@pytest.mark.parametrize("method", ["disks", "lee", "auto", "biarc-dc", "ridge", "brushfire", "potential"])
def test_methods(rectangle, method):
    length = 2 if method == "brushfire" else 2 + 4 * 2**0.5  # a fire leaves no corners
    assert medial.axis(rectangle, method).length == pytest.approx(length, rel=0.08)
    assert method in {row["name"] for row in medial.methods()}


def test_options_of_methods(rectangle):
    assert medial.axis(rectangle, "ridge", pixels=64).resolution == pytest.approx(4 / 64)
    assert medial.axis(rectangle, "brushfire", resolution=0.25).resolution == 0.25


def test_copies_and_pickles(plan):
    a = medial.axis(plan)
    for other in (copy.copy(a), copy.deepcopy(a), pickle.loads(pickle.dumps(a))):
        assert other == a and other.shape == a.shape
    assert a != medial.axis(plan, exterior=True)
    assert pickle.dumps(a) == pickle.dumps(medial.axis(plan))
    with pytest.raises(TypeError):
        hash(a)


def test_pickles_reach_another_process(plan):
    a = medial.axis(plan)
    code = "import pickle, sys; a = pickle.load(sys.stdin.buffer); sys.stdout.buffer.write(pickle.dumps(a.prune()))"
    done = subprocess.run([sys.executable, "-c", code], input=pickle.dumps(a), capture_output=True, check=True)
    assert pickle.loads(done.stdout) == a.prune()


def test_stored_axes_are_checked(rectangle, tmp_path):
    a = medial.axis(rectangle)
    path = tmp_path / "a.json.gz"
    a.save(path)
    assert medial.load(path) == [a]
    text = __import__("gzip").decompress(path.read_bytes()).decode()
    for old, new in (('"edges":[\n[', '"edges":[[99,'), ('"nodes":[\n[', '"nodes":[[0,'), ('"medial":1', '"medial":3')):
        with pytest.raises(medial.MedialError):
            medial.loads(text.replace(old, new, 1))
    with pytest.raises(medial.MedialError):
        medial.loads(text[: len(text) // 2])


def test_questions(plan):
    a = medial.axis(plan)
    found = a.nearest([(1, 3), (5, 1)])
    assert found["distance"].tolist() == pytest.approx([0.0, 0.0], abs=1) and (found["edge"] >= 0).all()
    assert a.radius_at([(2, 3)])[0] == pytest.approx(2, abs=0.3)
    clear = a.clearance([(1, 3), (5, 3), (-3, -4), (2, 1)])
    assert clear.tolist() == [1.0, -1.0, -5.0, 1.0]
    places = [a.disk_at(e, 0.5) for e in range(len(a))]
    centers = np.array(places)[:, :2]
    assert a.clearance(centers) == pytest.approx(np.array(places)[:, 2], abs=1e-12)


def test_clearance_of_arcs():
    ring = medial.Shape([(0, 0), (4, 0), (4, 2), (0, 2)], bulges=[0, 1, 0, 1])
    points = np.random.default_rng(1).uniform(-3, 7, (500, 2))
    x, y = points.T - np.array([[0], [1]])
    expected = 1 - np.hypot(x - np.clip(x, 0, 4), y)
    assert ring.clearance(points) == pytest.approx(expected, abs=1e-12)


def test_samples(plan):
    a = medial.axis(plan)
    lines = a.sample(chord=1e-4)
    assert len(lines) == a.branch_count
    total = sum(np.hypot(*np.diff(line[:, :2], axis=0).T).sum() for line in lines)
    assert total == pytest.approx(a.length, rel=1e-4)
    steps = [np.hypot(*np.diff(line[:, :2], axis=0).T).max() for line in a.sample(step=0.1)]
    assert max(steps) <= 0.1 + 1e-12


def test_command_line_needs_a_program():
    done = subprocess.run([sys.executable, "-m", "medial", "--help"], capture_output=True, text=True,
                          env={"PATH": "", "PYTHONPATH": ":".join(sys.path)})
    assert done.returncode == 2 and "not installed" in done.stderr
