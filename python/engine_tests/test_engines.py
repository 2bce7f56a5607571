"""Dask-GeoPandas and DuckDB: the recipes of the documentation."""

import pathlib

import numpy as np
import pytest

import medial.arrays

shapely = pytest.importorskip("shapely")


def footprints(count):
    ell = np.array([(0, 0), (10, 0), (10, 4), (5, 4), (5, 12), (0, 12)], float)
    return [shapely.Polygon(ell * (1 + i % 5) + (99 * i, 0)) for i in range(count)]


def test_dask():
    geopandas = pytest.importorskip("geopandas")
    dask_geopandas = pytest.importorskip("dask_geopandas")
    import medial.geo  # noqa: F401

    frame = geopandas.GeoDataFrame({"name": np.arange(100)}, geometry=footprints(100), crs=2056)
    parts = dask_geopandas.from_geopandas(frame, npartitions=4)
    widths = parts.map_partitions(
        lambda part: part.medial.width(), meta=dict.fromkeys(("mean", "min", "max", "length"), float)
    ).compute(scheduler="threads")
    assert widths.equals(frame.medial.width())
    lines = parts.map_partitions(
        lambda part: part.medial.centerline(extend=True), meta=geopandas.GeoSeries([], crs=frame.crs)
    ).compute(scheduler="threads")
    assert lines.geom_equals_exact(frame.medial.centerline(extend=True), 0).all() and lines.crs == frame.crs


@pytest.fixture
def connection():
    duckdb = pytest.importorskip("duckdb")
    made = duckdb.connect(config={"threads": 2, "allow_unsigned_extensions": True})
    yield made
    made.close()


def register(connection):
    """The functions of docs/how_to/engines.md."""

    def centerline(wkb):
        return medial.arrays.centerline(wkb, on_error="ignore", threads=1).to_arrow()

    def width(wkb):
        return medial.arrays.width(wkb, on_error="ignore", threads=1).to_arrow()

    numbers = "STRUCT(mean DOUBLE, min DOUBLE, max DOUBLE, length DOUBLE)"
    given = {"type": "arrow", "null_handling": "special"}  # errors, too, are null
    connection.create_function("medial_centerline", centerline, ["BLOB"], "BLOB", **given)
    connection.create_function("medial_width", width, ["BLOB"], numbers, **given)


def test_duckdb(connection):
    pyarrow = pytest.importorskip("pyarrow")
    polygons = [*footprints(5000), shapely.Polygon([(0, 0), (2, 2), (2, 0), (0, 2)])]
    table = pyarrow.table({"id": np.arange(len(polygons) + 1), "wkb": pyarrow.array([*shapely.to_wkb(polygons).tolist(), None])})  # noqa: F841
    register(connection)
    rows = connection.sql(
        "select id, medial_width(wkb) as width, medial_centerline(wkb) as line from 'table' order by id"
    ).fetchall()
    expected = medial.arrays.width(polygons, on_error="ignore")
    assert [row[1] for row in rows[:-2]] == [
        dict(zip(expected.columns, row, strict=True)) for row in expected.values[:-1].tolist()
    ]
    assert rows[-2][1:] == rows[-1][1:] == (None, None)
    lines = medial.arrays.centerline(polygons, on_error="ignore").to_shapely()
    assert shapely.equals_exact(shapely.from_wkb([row[2] for row in rows[:-2]]), lines[:-1]).all()


def test_duckdb_geometries(connection):
    package = pytest.importorskip("duckdb_extension_spatial")
    found = sorted(pathlib.Path(package.__file__).parent.rglob("*.duckdb_extension"))
    connection.execute(f"load '{found[0]}'")
    register(connection)
    text = "ST_GeomFromText('POLYGON ((0 0, 10 0, 10 2, 0 2, 0 0))')"
    length = connection.sql(f"select ST_Length(ST_GeomFromWKB(medial_centerline(ST_AsWKB({text})::BLOB)))").fetchone()
    assert length == (8.0,)
