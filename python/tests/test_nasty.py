"""Inputs that nobody should give: each has a right result, or an error that says what is wrong."""

import collections
import math

import numpy as np
import pytest

import medial
import medial.arrays
import medial.image

SQUARE = [(0.0, 0.0), (4.0, 0.0), (4.0, 2.0), (0.0, 2.0)]
POLYGON = {"type": "Polygon", "coordinates": [[*SQUARE, SQUARE[0]]]}


class Says:
    def __init__(self, geometry):
        self.geometry = geometry

    @property
    def __geo_interface__(self):
        if self.geometry is None:
            raise RuntimeError("no map")
        return self.geometry


class NoArray:
    def __array__(self, *given, **named):
        raise RuntimeError("no numbers")


def collection_of_itself():
    geometry = {"type": "GeometryCollection"}
    geometry["geometries"] = [geometry]
    return geometry


def list_of_itself():
    items = []
    items.append(items)
    return items


def masked():
    return np.ma.masked_array(np.array(SQUARE), mask=[[0, 0], [0, 0], [1, 0], [0, 0]])


def read_only():
    array = np.array(SQUARE)
    array.setflags(write=False)
    return array


NO_SHAPES = {
    "not a number": [(0, 0), (math.nan, 0), (4, 2)],
    "infinite": [(0, 0), (math.inf, 0), (4, 2)],
    "too large an integer": [(0, 0), (10**400, 0), (1, 1)],
    "masked": masked(),
    "complex": np.array(SQUARE, complex),
    "dates": np.array([["2020-01-01"] * 2] * 3, "datetime64[D]"),
    "text": np.array([["a", "b"], ["c", "d"], ["e", "f"]]),
    "records": np.array([(0.0, 0.0)] * 3, dtype=[("x", "f8"), ("y", "f8")]),
    "nothing": None,
    "a number": 3,
    "a type": object,
    "an array of no dimension": np.array(3.0),
    "an empty list": [],
    "an empty array": np.empty((0, 2)),
    "an empty mapping": {},
    "one point": [(1, 1)],
    "rows of other lengths": [(0, 0), (1,), (2, 2)],
    "a generator": (point for point in SQUARE),
    "generators in a list": [(x for x in point) for point in SQUARE],
    "no array": [NoArray()],
    "interface fails": Says(None),
    "interface is a number": Says(3),
    "interface has no type": Says({"coordinates": []}),
    "no coordinates": {"type": "Polygon"},
    "no geometry": {"type": "Feature", "geometry": None},
    "no features": {"type": "FeatureCollection"},
    "a point": {"type": "Point", "coordinates": [0, 0]},
    "a list in itself": list_of_itself(),
    "a collection in itself": collection_of_itself(),
    "deep JSON": '{"a":' * 100_000,
    "deep text": "GEOMETRYCOLLECTION(" * 100_000,
    "deep binary": b"\x01\x07\x00\x00\x00\x01\x00\x00\x00" * 100_000,
    "cut binary": b"\x01\x03\x00\x00\x00\x01\x00\x00\x00\xff\xff\xff\xff",
    "half a character": "POLYGON((\udc80 0,1 1))",
}


@pytest.mark.parametrize("name", NO_SHAPES)
@pytest.mark.parametrize("function", [medial.axis, medial.Shape, lambda x: medial.axes([x])])
def test_no_shape(name, function):
    with pytest.raises((medial.MedialError, TypeError)) as caught:
        function(NO_SHAPES[name])
    assert len(str(caught.value)) > 10 and "std::" not in str(caught.value)


@pytest.mark.parametrize("name", ["nothing", "a number", "interface fails", "a collection in itself", "no geometry"])
def test_no_lines(name):
    with pytest.raises((medial.MedialError, TypeError)):
        medial.voronoi(NO_SHAPES[name])


@pytest.mark.parametrize("points", [
    np.array(SQUARE, ">f8"), np.array(SQUARE, ">i2"), np.array(SQUARE, np.float16), np.asfortranarray(SQUARE),
    np.repeat(np.array(SQUARE), 2, axis=0)[::2], read_only(), np.array(SQUARE, object),
    np.ma.masked_array(np.array(SQUARE)), [(*point, 7) for point in SQUARE], [(*point, math.nan) for point in SQUARE],
    collections.deque(SQUARE), tuple(SQUARE), Says(POLYGON),
    {"type": "GeometryCollection", "geometries": [{"type": "GeometryCollection", "geometries": [POLYGON]}]},
])  # fmt: skip
def test_the_same_square(points):
    assert medial.Shape(points).area == 8 and medial.axis(points).length == medial.axis(SQUARE).length
    assert medial.axes([points, points])[1].length == medial.axis(SQUARE).length


def test_features_with_errors_are_a_column():
    curved = medial.Contour((0, 0)).line_to((4, 0)).arc_to((4, 2), 1).line_to((0, 2)).arc_to((0, 0), 1)
    given = [SQUARE, None, 3, Says(None), [(math.nan, 1)] * 4, curved, "x", medial.Shape(curved)]
    found = medial.axes(given, on_error="ignore", threads=1)
    assert found.ok.tolist() == [True, False, False, False, False, True, False, True]
    assert found.error_codes[1:5].tolist() == ["empty", "unsupported", "malformed", "not_finite"]
    assert found.errors[3].feature == 3 and "no map" in str(found.errors[3])
    with pytest.raises(medial.MedialError) as caught:
        medial.axes(given)
    assert caught.value.feature == 1
    # Curves stay curves: the axis of a stadium is a segment.
    assert len(found[5].edges) == len(found[7].edges) == 1 and found[5].length == pytest.approx(4)
    assert found[7] == medial.axis(medial.Shape(curved))
    lines = medial.arrays.centerlines if hasattr(medial.arrays, "centerlines") else medial.arrays.centerline
    assert len(lines([curved, SQUARE])) == 2


def test_curves_with_holes_in_arrays():
    ring = [medial.Contour((5, 0)).arc_to((-5, 0), 1).arc_to((5, 0), 1),
            medial.Contour((2, 0)).arc_to((-2, 0), 1).arc_to((2, 0), 1),
            medial.Contour((20, 0)).arc_to((10, 0), 1).arc_to((20, 0), 1)]  # fmt: skip
    found = medial.axes([ring, SQUARE, ring])
    whole = medial.axis(ring)
    assert found[0].length == pytest.approx(whole.length) and found[2] == found[0] and found[1] == medial.axis(SQUARE)


@pytest.mark.parametrize("given", ["POLYGON((0 0,4 0,4 2,0 0))", b"x", POLYGON, 3, None])
def test_one_feature_is_no_sequence(given):
    with pytest.raises(medial.MedialError, match="not a sequence"):
        medial.axes(given)


@pytest.mark.parametrize("offsets", [
    ([], []), ([0, math.nan], [0, 1]), (["a"], ["b"]), ([0, 2.5], [0, 1]), ([0, -4], [0, 1]), ([0, 9], [0, 1]),
    ([2, 4], [0, 1]), ([0, 2**62], [0, 1]), ([0, 4], [0, 7]), ([[0, 4]], [0, 1]), ([0, 4],), ([0, 4], [0, 1], [0, -1]),
])  # fmt: skip
def test_offsets(offsets):
    with pytest.raises(medial.MedialError):
        medial.axes((np.array(SQUARE), offsets))
    with pytest.raises(medial.MedialError):
        medial.axes((np.arange(8.0), ([0, 4], [0, 1])))


def test_arrow():
    pyarrow = pytest.importorskip("pyarrow")
    shapely = pytest.importorskip("shapely")
    wkb = shapely.Polygon(SQUARE).wkb
    some = pyarrow.chunked_array([[wkb], [], [None, wkb, b"x"]])
    assert medial.axes(some, on_error="ignore").ok.tolist() == [True, False, True, False]
    assert medial.axes(pyarrow.array([None, wkb, wkb, None])[1:3]).ok.all()
    pair = pyarrow.list_(pyarrow.float64(), 2)
    for bad in ([1, 2], ["POLYGON EMPTY"], [[1.0, 2.0]], [[[1.0, 2.0]]], [[[[1.0, 2.0]]]], [[[{"x": 1.0}]]]):
        with pytest.raises(medial.MedialError):
            medial.axes(pyarrow.array(bad))
    with pytest.raises(medial.MedialError):
        medial.axes(pyarrow.array([None], pyarrow.list_(pyarrow.list_(pair))))


def test_threads():
    for threads in (0, 1, 7, np.int64(2)):
        assert medial.axis(SQUARE, threads=threads) == medial.axis(SQUARE)
        assert len(medial.axes([SQUARE] * 3, threads=threads)) == 3
    for threads in (-1, 10**6, 2**70, 1.5, "2"):
        for call in (medial.axis, lambda x, threads: medial.axes([x], threads=threads)):
            with pytest.raises((medial.MedialError, TypeError)):
                call(SQUARE, threads=threads)


def test_what_progress_raises_ends_the_work():
    def fail(share):
        raise KeyError("no bar")

    for count in (3, 30_000):
        with pytest.raises(KeyError, match="no bar"):
            medial.axes([SQUARE] * count, progress=fail)


@pytest.mark.parametrize("bad", [math.nan, -1.0, 0.0])
def test_lengths(bad):
    curved = medial.axis(medial.Contour((0, 0)).arc_to((4, 0), 1))
    for call in (lambda: curved.lines(chord=bad), lambda: curved.shape.polygons(bad),
                 lambda: medial.axes([SQUARE]).lines(bad), lambda: medial.Shape(SQUARE).scaled(bad),
                 lambda: medial.transects(SQUARE, spacing=bad), lambda: medial.image.axis(np.eye(9), spacing=bad),
                 lambda: medial.image.distance_transform(np.eye(9), spacing=bad),
                 lambda: medial.voxels(np.ones((3, 3, 3)), spacing=(1, 1, bad))):  # fmt: skip
        with pytest.raises(medial.MedialError):
            call()
    if bad != 0:
        with pytest.raises(medial.MedialError):
            medial.Shape(SQUARE, fit=bad)


def test_places():
    for call in (lambda: medial.widest_path(SQUARE, (math.nan, 1), (3, 1)), lambda: medial.centerline(SQUARE, trim=-1),
                 lambda: medial.centerline(SQUARE, smooth=math.nan), lambda: medial.arrays.width([SQUARE], trim=math.nan),
                 lambda: medial.width_profile(SQUARE, -1), lambda: medial.transects(SQUARE, 2**70),
                 lambda: medial.voronoi(SQUARE, enclosure=[1, 2])):  # fmt: skip
        with pytest.raises(medial.MedialError):
            call()


def test_options_of_other_types():
    for call in (lambda: medial.carve(SQUARE, angle="steep"), lambda: medial.axis(SQUARE, "potential", order="x")):
        with pytest.raises(TypeError, match="wrong type"):
            call()
    for call in (lambda: medial.verify(None), lambda: medial.unpack(b"x")):
        with pytest.raises(TypeError):
            call()
    with pytest.raises(medial.MedialError):
        medial.Shape(SQUARE).scaled(1, (math.inf, 0))


def test_points_that_are_none():
    a = medial.axis(SQUARE)
    assert len(a.clearance([])) == len(a.nearest(np.empty((0, 2)))) == 0
    assert np.isnan(a.clearance([(math.nan, 1), (2, 1)])).tolist() == [True, False]
    assert np.isnan(a.radius_at([(2, 1), (2, math.nan)])).tolist() == [False, True]
    for points in ("ab", [(1, 2), (3,)], np.ones((2, 2), complex), masked(), [1, 2, 3], NoArray()):
        with pytest.raises(medial.MedialError):
            a.clearance(points)


def test_labels():
    labels = np.zeros((6, 8), np.uint64)
    labels[1:5, 1:4], labels[1:5, 4:7] = 2**31, 2**63
    assert list(medial.image.axis(labels)) == [2**31, 2**63]
    hidden = np.ma.masked_array(labels.astype(float), mask=labels == 2**63)
    assert list(medial.image.axis(hidden)) == [2**31]
    assert medial.image.skeletonize(np.ma.masked_array(np.ones((5, 5)), mask=np.ones((5, 5)))).sum() == 0
    for bad in ([[0, 1.5], [1.7, 0]], [[0, math.inf], [1, 0]], [[0, math.nan], [1, 0]], [["a", "b"]]):
        with pytest.raises(medial.MedialError, match="whole numbers"):
            medial.image.axis(bad)
    for mask in (np.ones((3, 3)), 1, "x"):
        with pytest.raises(ValueError, match="shape of its image"):
            medial.image.medial_axis(np.ones((6, 6)), mask)
    with pytest.raises(medial.MedialError):
        medial.voxels(np.zeros((4, 3)), [[0, 1, -1]])


def test_files(tmp_path):
    (tmp_path / "bad.geojson.gz").write_bytes(b"\x1f\x8bx")
    (tmp_path / "list.geojson").write_text("[]")
    for name, code in {"bad.geojson.gz": "unreadable", "none.geojson": "unreadable", "list.geojson": "malformed"}.items():
        with pytest.raises(medial.MedialError) as caught:
            medial.read(tmp_path / name)
        assert caught.value.code == code
    (tmp_path / "a.wkt").write_text("POLYGON((0 0,4 0,4 2,0 0))")
    assert medial.read(str(tmp_path / "a.wkt").encode())[0].area == 4
    with pytest.raises(medial.MedialError):
        medial.read(tmp_path / "a.wkt", unit="mm")
    with pytest.raises(medial.MedialError):
        medial.loads("\udc80")


def test_degrees_that_are_none():
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    import medial.geo  # noqa: F401

    assert len(geopandas.GeoSeries([], crs=4326).medial.axis()) == 0
    with pytest.raises(medial.MedialError, match="longitudes"):
        geopandas.GeoSeries([shapely.box(0, 0, 400, 300)], crs=4326).medial.axis()
