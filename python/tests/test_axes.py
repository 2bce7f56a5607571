"""Many features at once."""

import copy
import pickle
import warnings

import numpy as np
import pytest

import medial
from medial._records import packed


def footprints(count):
    ell = np.array([(0, 0), (10, 0), (10, 4), (5, 4), (5, 12), (0, 12), (0, 0)], float)
    at = np.arange(count)
    shift = np.stack([at % 300 * 20, at // 300 * 20], axis=1).astype(float)
    return (ell + shift[:, None]).reshape(-1, 2), (np.arange(count + 1) * 7, np.arange(count + 1))


def test_each_feature_is_its_own_axis(plan):
    coordinates, offsets = footprints(700)
    for threads in (1, 3):
        all_axes = medial.axes((coordinates, offsets), threads=threads)
        assert len(all_axes) == 700 and not all_axes.errors and all_axes.ok.all()
        for i in (0, 255, 256, 699):
            alone = medial.axis(coordinates[7 * i : 7 * i + 7])
            a, b = all_axes.node_begin[i : i + 2]
            assert np.array_equal(packed(all_axes.nodes[a:b]), packed(alone.nodes))
            assert all_axes[i] == alone
    assert all_axes.summary()["radius"] == pytest.approx(np.full(700, 2.5 if False else all_axes[0].nodes["radius"].max()))


def test_what_shapely_calls_a_ragged_array():
    shapely = pytest.importorskip("shapely")
    box, frame = shapely.box(0, 0, 4, 2), shapely.box(0, 0, 9, 9).difference(shapely.box(3, 3, 6, 7))
    for given in ([box, frame], [shapely.MultiPolygon([box, shapely.box(7, 0, 8, 9)]), frame]):
        kind, coordinates, offsets = shapely.to_ragged_array(given)
        for x in ((kind, coordinates, offsets), (coordinates, offsets)):
            assert [medial.axes(x)[i] == medial.axis(given[i]) for i in (0, 1)] == [True, True]
    with pytest.raises(medial.MedialError):
        medial.axes((coordinates, offsets[:1]))


def test_errors_are_raised_or_listed():
    good, bad = [(0, 0), (4, 0), (4, 2), (0, 2)], [(0, 0), (2, 2), (2, 0), (0, 2)]
    with pytest.raises(medial.MedialError) as caught:
        medial.axes([good, bad])
    assert caught.value.feature == 1
    found = medial.axes([bad, good, bad], on_error="ignore")
    assert list(found.errors) == [0, 2] and found.errors[2].code == "crossing"
    assert found.error_codes.tolist() == ["crossing", None, "crossing"]
    assert found.ok.tolist() == [False, True, False] and found[1].branch_count == 5
    with pytest.raises(medial.MedialError):
        found[0]
    assert np.isnan(found.summary()["length"][0])
    assert len(medial.axes([])) == 0


def test_wrong_offsets_are_refused():
    coordinates, (ring, polygon) = footprints(3)
    for offsets in ((ring[::-1].copy(), polygon), (ring, polygon + 9), (ring + 1, polygon)):
        with pytest.raises(medial.MedialError):
            medial.axes((coordinates, offsets))


def test_progress():
    seen = []
    medial.axes(footprints(600), progress=seen.append, threads=1)
    assert seen[-1] == 1 and sorted(seen) == seen
    seen.clear()
    medial.axes(footprints(5000), progress=seen.append, threads=8)  # one thread at a time, with and without a lock
    assert seen[-1] == 1 and sorted(set(seen)) == seen
    again = []
    medial.axes(footprints(600), threads=2, progress=lambda share: again.append(len(medial.axes(footprints(600), threads=2))))
    assert set(again) == {600} and len(again) <= 3


def test_geopandas():
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    import medial.geo  # noqa: F401

    frame = geopandas.GeoDataFrame({"name": ["a", "b"]}, index=[7, 9], crs=2056,
                                   geometry=[shapely.box(0, 0, 10, 2), shapely.box(0, 5, 4, 8)])
    assert medial.axes(frame)[1] == medial.axis(frame.geometry[9])
    lines = frame.medial.centerline(extend=True)
    assert lines.index.tolist() == [7, 9] and lines.crs == frame.crs and lines[7].length == pytest.approx(10)
    assert frame.medial.width().loc[7, "mean"] == pytest.approx(2)
    assert frame.geometry.medial.axis().length[7] == pytest.approx(medial.axis(frame.geometry[7]).length)
    assert frame.medial.inscribed_circles(2).radius[7].tolist() == pytest.approx([1, 1])
    assert frame.medial.offset(0.5).area[9] == pytest.approx(6)
    assert len(frame.medial.branches()) == 10
    assert frame.medial.prune("erosion", 0.5)[7].length < 10


def test_degrees_are_computed_in_metres():
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    import medial.geo  # noqa: F401

    degrees = geopandas.GeoSeries([shapely.box(8.0, 47.0, 8.02, 47.002)], crs=4326)
    width = degrees.medial.width().loc[0]
    assert width["mean"] == pytest.approx(222.4, abs=0.5)
    line = degrees.medial.centerline(extend=True)
    assert line.crs == degrees.crs and line[0].bounds == pytest.approx((8.0, 47.001, 8.02, 47.001), abs=1e-6)


def bars_of(count):
    return [[(0, 0), (4 + i, 0), (4 + i, 2), (0, 2)] for i in range(count)]


def test_parts_of_axes():
    bad = [(0, 0), (2, 2), (2, 0), (0, 2)]
    a = medial.axes([*bars_of(3), bad, *bars_of(1)], on_error="ignore")
    assert a[1:3] == [a[1], a[2]] and len(a[-1:]) == 1
    with pytest.raises(TypeError, match="str"):
        a["x"]
    with pytest.raises(medial.MedialError):
        a[2:4]
    passed = iter(a)
    assert [next(passed) for _ in range(3)] == a[:3]
    with pytest.raises(medial.MedialError) as caught:
        next(passed)
    assert caught.value.feature == 3 and next(passed) == a[4]
    assert medial.axes(bars_of(1), exterior=True)[0].exterior > 0


def test_many_errors_cost_little():
    bad = [(0, 0), (2, 2), (2, 0), (0, 2)]
    a = medial.axes([bad] * 3000, on_error="ignore", threads=1)
    made = []

    class Counted(medial.MedialError):
        def __init__(self, *given):
            made.append(given)
            super().__init__(*given)

    passed, original = iter(a), medial._read.MedialError
    medial._read.MedialError = Counted
    try:
        for _ in range(3000):
            with pytest.raises(medial.MedialError):
                next(passed)
    finally:
        medial._read.MedialError = original
    assert not made and len(a.errors) == 3000 and "3000 errors" in repr(a)


def test_results_can_be_pickled_and_copied(plan):
    bad = [(0, 0), (2, 2), (2, 0), (0, 2)]
    a = medial.axes([plan, bad, *bars_of(3)], on_error="ignore")
    line = medial.centerline(plan)
    contour = medial.Contour((0, 0), "hole").line_to((4, 0)).arc_to((4, 2), 1).bezier_to([(2, 3), (0, 2)], [2, 1])
    for copied in (lambda x: pickle.loads(pickle.dumps(x)), copy.deepcopy):
        b = copied(a)
        assert b[0] == a[0] and b[2:] == a[2:] and b.method == a.method
        assert b.errors[1].point == a.errors[1].point and str(b.errors[1]) == str(a.errors[1])
        other = copied(line)
        assert other.axis == line.axis and np.array_equal(other.widths(5).width, line.widths(5).width)
        again = copied(contour)
        assert medial.Shape(again) == medial.Shape(contour)
        again.line_to((0, 1))
        assert repr(contour) != repr(again)
    copy.copy(contour).line_to((9, 9))
    assert repr(contour) == "<medial.Contour: 3 pieces>"
    method, *arrays = a._core.state()
    for i in range(len(arrays)):
        damaged = list(arrays)
        damaged[i] = damaged[i][1:] if i < 3 else tuple(part[1:] for part in damaged[i])
        with pytest.raises(medial.MedialError):
            medial._core.restored_axes(method, *damaged)


@pytest.fixture
def bars():
    """Makes a GeoSeries of bars of 0.1 x 0.001 degrees."""
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    import medial.geo  # noqa: F401

    def make(places, crs=4326, unit=1.0):
        boxes = [shapely.box(x * unit, y * unit, (x + 0.1) * unit, (y + 0.001) * unit) for x, y in places]
        return geopandas.GeoSeries(boxes, crs=crs)

    return make


# A thousandth of a degree along the meridian, in metres.
HEIGHTS = {-17: 110.67, 0: 110.57, 10: 110.61, 40: 111.03, 60: 111.41}


@pytest.mark.parametrize(("places", "warns"), [
    ([(179, -17), (-179, -17)], False), ([(179.95, 10), (-180.05, 10)], False),
    ([(0, 0), (150, 0)], True), ([(-120, 40), (-70, 40)], True), ([(3 * x, 60) for x in range(-50, 50)], True),
])  # fmt: skip
def test_metres_anywhere_on_the_globe(bars, places, warns):
    series = bars(places)
    for (_, y), width in zip(places, series.medial.width()["max"], strict=True):
        assert width == pytest.approx(HEIGHTS[y], rel=3e-4)
    for result in (series.medial.axis(), series.medial.centerline(extend=True), series.medial.offset(1)):
        assert result.crs == series.crs
        assert np.abs(result.bounds - series.bounds).to_numpy().max() < 1.5e-3  # nothing goes around the globe
    assert series.medial.inscribed_circles().geometry.within(series).all()
    assert len(series.medial.branches()) == 5 * len(series)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        series.medial.axes()
    assert ["far apart" in str(one.message) for one in caught] == [True] * warns


def test_a_feature_across_the_date_line_stays_in_one_piece(bars):
    shapely = pytest.importorskip("shapely")
    jumping = shapely.Polygon([(179.95, 0), (-179.95, 0), (-179.95, 0.001), (179.95, 0.001)])
    series = bars([(0, 0)])
    series[0] = jumping
    line = series.medial.centerline(extend=True)[0]
    assert line.length == pytest.approx(0.1, rel=1e-3)
    assert series.medial.width()["max"][0] == pytest.approx(110.57, rel=1e-4)


def test_a_point_at_infinity_spoils_only_its_feature(bars):
    shapely = pytest.importorskip("shapely")
    series = bars([(0, 0), (1, 0)])
    series[1] = shapely.Polygon([(0, 0), (1, 0), (1, np.inf)])
    found = series.medial.width(on_error="ignore")
    assert found["max"][0] == pytest.approx(110.57, rel=1e-4) and np.isnan(found["max"][1])
    with pytest.raises(medial.MedialError) as caught:
        series.medial.width()
    assert caught.value.feature == 1


def test_a_feature_too_large_for_metres_warns(bars):
    shapely = pytest.importorskip("shapely")
    series = bars([(0, 0)])
    series[0] = shapely.box(0, 0, 40, 1)
    with pytest.warns(UserWarning, match=r"off by up to 2\.3 %") as caught:
        series.medial.width()
    assert caught[0].filename == __file__


def test_features_anywhere_are_near_the_middle_of_their_cell():
    from medial._globe import _angles, _cells, _directions

    random = np.random.default_rng(1)
    places = np.stack([random.uniform(-540, 540, 20000), np.degrees(np.arcsin(random.uniform(-1, 1, 20000)))], axis=1)
    places[:8, 1] = (90, -90, 89.3, 89.2, 87.8, -87.8, 0, 0.75)
    assert _angles(_directions(places), _directions(_cells(places))).max() < 1.07


def test_degrees_of_other_units_and_globes(bars):
    assert bars([(0.1, 49)], crs=4807, unit=10 / 9).medial.width()["max"][0] == pytest.approx(111.21, rel=2e-4)
    moon = bars([(0.1, 20)], crs="IAU_2015:30100").medial.width()["max"][0]
    assert moon == pytest.approx(1737400 * np.radians(0.001), rel=1e-4)


def test_points_a_rounding_beyond_a_pole_are_on_it(bars):
    shapely = pytest.importorskip("shapely")

    def wedge(south, crs=4326, unit=1.0):
        series = bars([(0, 0)], crs)
        series[0] = shapely.Polygon([(0, south * unit), (60 * unit, -89.9 * unit), (0, -89.9 * unit)])
        return series

    expected = wedge(-90).medial.width()["max"][0]
    beyond = wedge(-90.00000000000003)
    assert beyond.medial.width()["max"][0] == expected
    assert beyond.medial.axis().bounds["miny"][0] == pytest.approx(-90, abs=1e-9)
    grads = wedge(-90, crs=4807, unit=10 / 9).medial.width()["max"][0]
    assert grads == pytest.approx(expected, rel=1e-3)
    with pytest.raises(medial.MedialError, match="not longitudes and latitudes"):
        wedge(-90.00001).medial.width()


def test_arrow(monkeypatch):
    pyarrow = pytest.importorskip("pyarrow")
    shapely = pytest.importorskip("shapely")
    geometries = [shapely.box(0, 0, 4, 2), shapely.box(1, 1, 2, 9).difference(shapely.box(1.2, 3, 1.8, 4))]
    expected = medial.axes(geometries)
    wkb = pyarrow.array(list(shapely.to_wkb(geometries)), pyarrow.binary())
    for array in (wkb, pyarrow.chunked_array([wkb[:1], wkb[1:]]), wkb.cast(pyarrow.large_binary())):
        assert medial.axes(array)[1] == expected[1]
    rings = [[list(map(list, ring.coords)) for ring in (g.exterior, *g.interiors)] for g in geometries]
    kind = pyarrow.list_(pyarrow.list_(pyarrow.list_(pyarrow.float64(), 2)))
    assert medial.axes(pyarrow.array(rings, kind))[1] == expected[1]
    made = expected.to_arrow()
    assert len(made) == 2 and len(made[0].as_py()) == 5
    far = np.array([0, 2**31 + 4])  # where the rows of all lines are too many for 32 bits
    monkeypatch.setattr(medial.Axes, "_lines", lambda *_, **__: (np.zeros((1, 2)), far, np.array([0, 1])))
    with pytest.raises(pyarrow.ArrowInvalid, match="2147483652"):  # pyarrow misses the rows
        expected.to_arrow()
