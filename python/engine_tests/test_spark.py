"""medial.spark in local mode: results as without Spark, errors, skew, tasks that fail and are repeated.

Geometries of Apache Sedona are tested where MEDIAL_SEDONA_JARS lists its jars (see tools/python.sh).
"""

import os
import signal
import sys

import pytest

pyspark = pytest.importorskip("pyspark")
shapely = pytest.importorskip("shapely")

import numpy as np  # noqa: E402
from pyspark.sql import SparkSession, functions  # noqa: E402

import medial.arrays  # noqa: E402
import medial.spark  # noqa: E402

JARS = os.environ.get("MEDIAL_SEDONA_JARS", "")
os.environ["PYSPARK_PYTHON"] = sys.executable


@pytest.fixture(scope="module")
def session():
    builder = (
        SparkSession.builder.master("local[2, 3]")  # a task may fail twice
        .config("spark.ui.enabled", "false")
        .config("spark.driver.memory", "1g")
        .config("spark.sql.shuffle.partitions", "4")
        .config("spark.sql.execution.arrow.maxRecordsPerBatch", "64")
    )
    if JARS:
        builder = builder.config("spark.jars", JARS).config(
            "spark.sql.extensions", "org.apache.sedona.sql.SedonaSqlExtensions"
        )
    made = builder.getOrCreate()
    made.sparkContext.setLogLevel("OFF")
    if JARS:
        from sedona.spark import SedonaContext

        SedonaContext.create(made)
    yield made
    made.stop()


def polygons(count):
    """Ls of many sizes, some with an error, some missing."""
    ell = np.array([(0, 0), (10, 0), (10, 4), (5, 4), (5, 12), (0, 12)], float)
    for i in range(count):
        if i % 50 == 7:
            yield None
        elif i % 50 == 13:
            yield shapely.Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])
        else:
            yield shapely.Polygon(ell * (1 + i % 7) + (20 * i, 0))


GEOMETRIES = list(polygons(300))
GIVEN = [(i, None if g is None else bytearray(g.wkb)) for i, g in enumerate(GEOMETRIES)]


@pytest.fixture(scope="module")
def frame(session):
    return session.createDataFrame(GIVEN, "id long, geometry binary").repartition(5, "id")


def collected(frame, name):
    """What Spark made, in order, of what is no null."""
    rows = sorted(frame.select("id", name).collect(), key=lambda row: row.id)
    assert [row.id for row in rows] == list(range(len(GIVEN)))
    assert [row[name] is None for row in rows] == [g is None for g in GEOMETRIES]
    return [row[name] for row in rows if row[name] is not None]


PRESENT = [g for g in GEOMETRIES if g is not None]


@pytest.mark.parametrize("name, options", [
    ("centerline", {"extend": True}), ("prune", {"measure": "erosion", "threshold": 0.5}), ("offset", {"distance": 0.5}),
])  # fmt: skip
def test_geometries(frame, name, options):
    rows = collected(getattr(medial.spark, name)(frame, into="made", **options), "made")
    expected = getattr(medial.arrays, name)(PRESENT, on_error="ignore", **options)
    for i, (row, geometry) in enumerate(zip(rows, expected.to_shapely(), strict=True)):
        if i in expected.errors:
            assert row.geometry is None and row.error.code == "crossing" and (row.error.x, row.error.y) == (1, 1)
        else:
            assert row.error is None and bytes(row.geometry) == geometry.wkb


def test_axes_widths_and_circles(frame):
    axes = medial.axes(PRESENT, on_error="ignore")
    made = medial.spark.inscribed_circles(medial.spark.width(medial.spark.axis(frame, graph=True)), 2)
    widths = medial.arrays.width(PRESENT, on_error="ignore")
    circles = medial.arrays.inscribed_circles(PRESENT, 2, on_error="ignore")
    found = zip(collected(made, "axis"), collected(made, "width"), collected(made, "circles"), strict=True)
    for i, (axis, width, circle) in enumerate(found):
        if i in axes.errors:
            assert axis.error.code == width.error.code == circle.error.code == "crossing"
            assert axis.length is None and width.mean is None and circle.circles is None
            continue
        alone = axes[i]
        assert axis.length == pytest.approx(alone.length) and axis.radius == alone.nodes["radius"].max()
        assert [(n.x, n.y, n.radius, n.kind) for n in axis.nodes] == alone.nodes[["x", "y", "radius", "kind"]].tolist()
        assert [[getattr(e, "from"), e.to] for e in axis.edges] == alone.edges["node"].tolist()
        assert [width.mean, width.min, width.max, width.length] == widths.values[i].tolist()
        a, b = circles.begin[0][i : i + 2]
        assert [(c.x, c.y, c.radius) for c in circle.circles] == [tuple(row) for row in circles.values[a:b].tolist()]


def test_a_wrong_column_is_an_error(frame):
    with pytest.raises(medial.MedialError):
        medial.spark.axis(frame, "shape")


def test_large_features_are_spread(session):
    count = np.full(400, 8)
    count[:8] = 4000  # as large as all others together, and neighbours
    circles = [
        bytearray(shapely.Point(50 * i, 0).buffer(20, quad_segs=int(n) // 4).wkb) for i, n in enumerate(count)
    ]
    frame = session.createDataFrame(list(enumerate(circles)), "id long, geometry binary")
    even = medial.spark.balanced(frame, partitions=4)
    assert even.columns == frame.columns and even.rdd.getNumPartitions() == 4
    weights = even.groupBy(functions.spark_partition_id()).agg(functions.sum(functions.octet_length("geometry")))
    loads = [row[1] for row in weights.collect()]
    assert len(loads) == 4 and max(loads) < 1.2 * sum(loads) / 4
    assert sorted(row.id for row in even.collect()) == list(range(400))


@pytest.mark.parametrize("how", ["exception", "kill"])
def test_tasks_that_fail_are_repeated(session, frame, tmp_path, how):
    expected = sorted(medial.spark.width(frame).collect())
    marks = str(tmp_path)

    def fail_once(batches):
        from pyspark import TaskContext

        mark = os.path.join(marks, str(TaskContext.get().partitionId()))
        for batch in batches:
            yield batch
            if not os.path.exists(mark):  # after a part of the work
                open(mark, "w").close()
                if how == "kill":
                    os.kill(os.getpid(), signal.SIGKILL)
                raise RuntimeError("lost")

    faulty = medial.spark.width(frame.mapInArrow(fail_once, frame.schema))
    assert sorted(faulty.collect()) == expected
    assert len(os.listdir(marks)) >= 2  # tasks that failed


def test_geometries_of_sedona(session, frame):
    if not JARS:
        pytest.skip("there are no jars of Sedona")
    geometries = frame.selectExpr("id", "ST_GeomFromWKB(geometry) as geometry")
    made = medial.spark.centerline(geometries, extend=True)
    rows = made.selectExpr("id", "geometry is null as missing", "ST_AsBinary(centerline.geometry) as line").collect()
    lines = {row.id: row.line for row in rows}
    expected = medial.arrays.centerline(PRESENT, extend=True, on_error="ignore").to_shapely()
    ids = [i for i, g in enumerate(GEOMETRIES) if g is not None]
    for i, line in zip(ids, expected, strict=True):
        assert (lines[i] is None) == (line is None)
        assert line is None or shapely.from_wkb(bytes(lines[i])).equals_exact(line)
    assert [row.missing for row in sorted(rows)] == [g is None for g in GEOMETRIES]


def star_with_lake():
    angle = np.linspace(0, 2 * np.pi, 600, endpoint=False)
    radius = 10 + np.sin(5 * angle) + 0.05 * np.cos(131 * angle) + np.random.default_rng(1).random(600) / 10
    ring = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    return medial.Shape(shapely.Polygon(ring, [[(-2, -1), (3, -1.5), (2, 2), (-1.5, 1)]]))


def tiled(session, shape, levels):
    """Of the axis by tiles the pairs of sites, and the disks of its nodes by their names."""
    table = medial.spark.boundary(shape)
    edges = session.createDataFrame(table.to_pandas()).repartition(3)
    rows = medial.spark.axis_of_tiles(edges, levels).collect()
    pairs = sorted(tuple(sorted((row.site0, row.site1))) for row in rows)
    nodes = {}
    for row in rows:
        nodes[row.node0] = (row.node0_x, row.node0_y, row.node0_radius)
        nodes[row.node1] = (row.node1_x, row.node1_y, row.node1_radius)
    return pairs, np.array(sorted(nodes.values()))


@pytest.mark.parametrize("levels", [0, 1, 3])
def test_axis_of_tiles(session, levels):
    shape = star_with_lake()
    axis = medial.axis(shape)
    pairs, nodes = tiled(session, shape, levels)
    number, numbers = 0, []
    for kind in axis.sites["kind"]:
        numbers.append(2 * number + int(kind == 1))
        number += int(kind != 1)
    assert pairs == sorted(tuple(sorted(numbers[site] for site in edge)) for edge in axis.edges["site"])
    whole = np.stack([axis.nodes[name] for name in ("x", "y", "radius")], axis=1)
    assert len(nodes) == len(whole)
    distances = np.abs(nodes[:, None] - whole[None]).max(axis=2)
    assert distances.min(axis=0).max() < 1e-12 and distances.min(axis=1).max() < 1e-12


@pytest.mark.parametrize("how", ["exception", "kill"])
def test_tiles_that_fail_are_repeated(session, tmp_path, monkeypatch, how):
    from types import SimpleNamespace

    shape = star_with_lake()
    expected = tiled(session, shape, 2)
    marks = str(tmp_path)

    def leaves(*given):
        from medial import _core

        return _core.tile_leaves(*given)

    def check(*given):
        from medial import _core

        return _core.check_tiles(*given)

    def fail_once(ends, numbers, box, levels, level, column, row, tolerance):
        from medial import _core
        from pyspark import TaskContext

        mark = os.path.join(marks, f"{level} {TaskContext.get().partitionId()}")
        if not os.path.exists(mark):
            open(mark, "w").close()
            if how == "kill":
                os.kill(os.getpid(), signal.SIGKILL)
            raise RuntimeError("lost")
        return _core.tile(ends, numbers, box, levels, level, column, row, tolerance)

    monkeypatch.setattr(medial.spark, "_core", SimpleNamespace(tile=fail_once, tile_leaves=leaves, check_tiles=check))
    found = tiled(session, shape, 2)
    assert found[0] == expected[0] and (found[1] == expected[1]).all()
    assert len(os.listdir(marks)) >= 3  # a task of each level has failed


def test_tiles_refuse_what_is_empty(session):
    nothing = session.createDataFrame([], "number long, x0 double, y0 double, x1 double, y1 double")
    with pytest.raises(medial.MedialError) as raised:
        medial.spark.axis_of_tiles(nothing, 1)
    assert raised.value.code == "empty"


def test_tiles_refuse_options_at_once(session):
    square = medial.Shape(shapely.box(0, 0, 1, 1))
    edges = session.createDataFrame(medial.spark.boundary(square).to_pandas())
    for levels, tolerance in ((-1, 0), (11, 0), (1, -1), (1, float("nan")), (1, 5)):
        with pytest.raises(medial.MedialError) as raised:
            medial.spark.axis_of_tiles(edges, levels, tolerance=tolerance)
        assert raised.value.code == "invalid_option"


def test_tiles_refuse_more_leaves_than_pay(session):
    x = np.arange(2001) / 2000
    zigzag = np.stack([x, np.arange(2001) % 2.0], axis=1)
    rows = [(i, *start, *end) for i, (start, end) in enumerate(zip(zigzag[:-1].tolist(), zigzag[1:].tolist(), strict=True))]
    edges = session.createDataFrame(rows, "number long, x0 double, y0 double, x1 double, y1 double")
    with pytest.raises(medial.MedialError, match="fewer levels") as raised:
        medial.spark.axis_of_tiles(edges, 10)
    assert raised.value.code == "invalid_option"


def test_tiles_refuse_what_is_no_tile():
    from medial import _core

    ends = np.array([(0, 0, 1, 0), (1, 0, 1, 1), (1, 1, 0, 1), (0, 1, 0, 0)], float)
    numbers = np.arange(4)
    for box in ([0, 0, 0, 0], [1, 1, 0, 0], [0, 2, 1, 1], [0, 0, np.inf, 1], [np.nan, 0, 1, 1], [-1e308, 0, 1e308, 1]):
        with pytest.raises(medial.MedialError) as raised:
            _core.tile_leaves(ends, box, 1)
        assert raised.value.code == "malformed"
    for level in (-1, 2):
        with pytest.raises(medial.MedialError) as raised:
            _core.tile(ends, numbers, [0, 0, 1, 1], 1, level, 0, 0, 0)
        assert raised.value.code == "invalid_option"
    with pytest.raises(medial.MedialError) as raised:
        _core.tile(ends, numbers - 1, [0, 0, 1, 1], 1, 0, 0, 0, 0)
    assert raised.value.code == "malformed"
