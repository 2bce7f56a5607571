"""Operations on arrays of features, against those on one."""

import numpy as np
import pytest

import medial
import medial.arrays


def stars(count):
    rng = np.random.default_rng(5)
    for k in range(count):
        n = int(rng.integers(5, 40))
        angles = 2 * np.pi * np.arange(n) / n
        radii = rng.uniform(2, 10, n)
        yield np.stack([radii * np.cos(angles) + 30 * k, radii * np.sin(angles)], axis=1)


FEATURES = list(stars(300))
BAD = [(0, 0), (2, 2), (2, 0), (0, 2)]


def part(found, i):
    """The rows of a feature."""
    first, last = i, i + 1
    for begin in reversed(found.begin):
        first, last = begin[first], begin[last]
    return found.values[first:last]


@pytest.mark.parametrize("threads", [1, 3])
def test_each_feature_as_alone(threads):
    lines = medial.arrays.centerline(FEATURES, extend=True, threads=threads)
    widths = medial.arrays.width(FEATURES, 11, threads=threads)
    circles = medial.arrays.inscribed_circles(FEATURES, 3, threads=threads)
    pruned = medial.arrays.prune(FEATURES, "erosion", 0.5, threads=threads)
    inside = medial.arrays.offset(FEATURES, 0.3, threads=threads)
    assert len(lines) == len(widths) == len(circles) == len(pruned) == len(inside) == 300
    for i in (0, 17, 255, 256, 299):
        axis = medial.axis(FEATURES[i])
        line = medial.centerline(axis, extend=True)
        assert np.array_equal(part(lines, i), line.coordinates())
        profile = medial.centerline(axis).widths(11)
        mean = (profile.width.sum() - (profile.width[0] + profile.width[-1]) / 2) / 10
        assert widths.values[i] == pytest.approx([mean, 2 * line.narrowest, profile.width.max(), profile.along[-1]])
        assert np.array_equal(part(circles, i), medial.inscribed_circles(axis, 3))
        assert np.array_equal(part(pruned, i), np.concatenate(axis.prune("erosion", 0.5).sample()))
        regions = medial.offset(axis, 0.3)
        assert inside.begin[-1][i + 1] - inside.begin[-1][i] == len(regions)


def test_the_largest_circle_needs_no_axis():
    for points in FEATURES[:60]:
        x, y, radius = medial.maximum_inscribed_circle(points)
        axis = medial.axis(points)
        assert radius == pytest.approx(medial.maximum_inscribed_circle(axis).radius, rel=1e-12)
        assert axis.clearance([(x, y)])[0] == pytest.approx(radius, rel=1e-12)


def test_errors_by_feature():
    for function in (medial.arrays.centerline, medial.arrays.width, medial.arrays.inscribed_circles, medial.arrays.prune):
        with pytest.raises(medial.MedialError) as caught:
            function([FEATURES[0], BAD])
        assert caught.value.feature == 1
        found = function([BAD, FEATURES[0], BAD], on_error="ignore")
        assert list(found.errors) == [0, 2] and found.errors[2].code == "crossing"
        assert found.ok.tolist() == [False, True, False] and len(found) == 3
        assert found.error_codes.tolist() == ["crossing", None, "crossing"]
    with pytest.raises(ValueError):
        medial.arrays.width(FEATURES, on_error="maybe")
    assert len(medial.arrays.width([])) == 0


def test_broken_binary_is_the_error_of_its_feature():
    shapely = pytest.importorskip("shapely")
    good = shapely.to_wkb(shapely.box(0, 0, 4, 2))
    given = [good, good[:-3], b"", shapely.to_wkb(shapely.Point(0, 0)), good]
    found = medial.axes(given, on_error="ignore")
    assert {i: error.code for i, error in found.errors.items()} == {1: "malformed", 2: "malformed", 3: "unsupported"}
    assert found[4] == medial.axis(good) and found.ok.tolist() == [True, False, False, False, True]
    with pytest.raises(medial.MedialError):
        found[1]
    with pytest.raises(medial.MedialError) as caught:
        medial.axes(given)
    assert caught.value.feature == 1


def test_missing_geometries_are_errors():
    shapely = pytest.importorskip("shapely")
    pyarrow = pytest.importorskip("pyarrow")
    box = shapely.box(0, 0, 4, 2)
    arrow = pyarrow.array([None, box.wkb], pyarrow.binary())
    for given in ([None, box], [None, box.wkb], arrow, arrow.cast(pyarrow.large_binary())):
        found = medial.arrays.width(given, on_error="ignore")
        assert found.errors[0].code == "empty" and found["mean"][1] == pytest.approx(2)
        with pytest.raises(medial.MedialError) as caught:
            medial.axes(given)
        assert caught.value.feature == 0


def test_geometries_in_all_forms():
    shapely = pytest.importorskip("shapely")
    pyarrow = pytest.importorskip("pyarrow")
    frame = shapely.box(0, 0, 10, 10).difference(shapely.box(3, 3, 7, 7))
    for found, kind in (
        (medial.arrays.axis([frame, BAD], on_error="ignore"), "MultiLineString"),
        (medial.arrays.centerline([frame, BAD], on_error="ignore"), "LineString"),
        (medial.arrays.offset([frame, BAD], 0.5, on_error="ignore"), "MultiPolygon"),
        (medial.arrays.offset([frame, BAD], -0.5, on_error="ignore"), "MultiPolygon"),
    ):
        made, nothing = found.to_shapely()
        assert made.geom_type == kind and made.is_valid and nothing is None
        column = found.to_arrow()
        assert column.null_count == 1 and shapely.from_wkb(column[0].as_py()).equals_exact(made)
        assert shapely.from_wkb(found.to_wkb()[0][: found.to_wkb()[1][1]].tobytes()).equals_exact(made)
    assert medial.arrays.offset([frame], 0.5).to_shapely()[0].area == pytest.approx(81 - (24 + np.pi / 4), rel=1e-3)
    circles = medial.arrays.inscribed_circles([frame, BAD], 2, on_error="ignore").to_arrow()
    assert circles.type == pyarrow.list_(pyarrow.struct([(c, pyarrow.float64()) for c in ("x", "y", "radius")]))
    assert len(circles[0]) == 2 and not circles[1].is_valid


def test_wrong_offsets_write_nothing():
    from medial import _core

    for levels in ([np.array([0, 9])], [np.array([1, 0])], [], [np.array([0, 2])] * 4):
        with pytest.raises(medial.MedialError):
            _core.write_wkb(np.zeros(4), 2, levels)


def test_branches_and_transects_as_alone():
    pytest.importorskip("pandas")
    found = medial.arrays.branches(FEATURES[:40], threads=2)
    table = found.to_pandas()
    for i in (0, 13, 39):
        alone = medial.axis(FEATURES[i]).branches
        part_of = table.loc[i].set_index("branch")
        for name in alone.columns:
            if name == "euclidean":
                assert part_of[name].tolist() == pytest.approx(alone[name].tolist(), rel=1e-15)
            else:
                assert part_of[name].tolist() == alone[name].tolist(), name
    cuts = medial.arrays.transects(FEATURES[:40], 5)
    for i in (0, 13, 39):
        alone = medial.transects(FEATURES[i], 5)
        ends = cuts.values.reshape(-1, 2, 2)[5 * i : 5 * i + 5]
        assert np.array_equal(ends[:, 0], alone.left) and np.array_equal(ends[:, 1], alone.right)
        assert np.array_equal(cuts.attributes["width"][5 * i : 5 * i + 5], alone.width)
    failed = medial.arrays.branches([BAD, FEATURES[0]], on_error="ignore")
    assert failed.errors[0].code == "crossing" and set(failed.feature) == {1}
