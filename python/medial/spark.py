"""Spark: medial axes of the polygons in a column of a DataFrame.

The column holds well-known binary, or geometries of Apache Sedona. Results are structs of a fixed
schema with geometries of the same kind. Rows travel as Arrow batches. A feature without a result
has null fields and an ``error``; a null geometry has a null result.

>>> import medial.spark                                                    # doctest: +SKIP
>>> lines = medial.spark.centerline(rivers, "geometry", extend=True)       # doctest: +SKIP
>>> lines.select("id", "centerline.geometry", "centerline.error.code")     # doctest: +SKIP
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from . import _core, arrays
from ._axes import axes, ragged
from ._errors import MedialError, need
from ._shape import Shape

pyarrow = need("pyarrow", "spark")
need("pyspark", "spark")

from pyspark.sql import DataFrame, functions  # noqa: E402
from pyspark.sql.types import (  # noqa: E402
    ArrayType,
    BinaryType,
    DataType,
    DoubleType,
    IntegerType,
    LongType,
    StringType,
    StructField,
    StructType,
    UserDefinedType,
)

__all__ = ["axis", "axis_of_tiles", "balanced", "boundary", "centerline", "inscribed_circles", "offset", "prune", "width"]


def _doubles(*names: str) -> list[StructField]:
    return [StructField(name, DoubleType()) for name in names]


_ERROR = StructType(
    [StructField("code", StringType()), StructField("text", StringType()), StructField("ring", IntegerType()),
     StructField("vertex", IntegerType()), *_doubles("x", "y")]
)  # fmt: skip
_GEOMETRY = StructField("geometry", BinaryType())
_NODES = StructType([*_doubles("x", "y", "radius"), StructField("kind", IntegerType())])
_EDGES = StructType(
    [*(StructField(name, IntegerType()) for name in ("from", "to", "left", "right")), *_doubles("x", "y", "radius", "weight")]
)

# The results of a batch: Arrow arrays by field, and the errors.
Fields = tuple[dict[str, Any], dict[int, MedialError]]


def _errors(errors: dict[int, MedialError], count: int) -> Any:
    """The column of errors; null where there is none."""
    rows: list[dict[str, Any] | None] = [None] * count
    for i, error in errors.items():
        x, y = (error.point or (None, None))[:2]
        rows[i] = {"code": error.code, "text": error.text, "ring": error.ring, "vertex": error.vertex, "x": x, "y": y}
    kinds = {StringType(): pyarrow.string(), IntegerType(): pyarrow.int32(), DoubleType(): pyarrow.float64()}
    return pyarrow.array(rows, pyarrow.struct([(field.name, kinds[field.dataType]) for field in _ERROR.fields]))


def _lists(begin: Any, columns: dict[str, Any]) -> Any:
    rows = pyarrow.StructArray.from_arrays([pyarrow.array(np.ascontiguousarray(c)) for c in columns.values()], list(columns))
    return pyarrow.ListArray.from_arrays(pyarrow.array(np.asarray(begin, np.int32)), rows)


def _row_fields(table: arrays.Table) -> Fields:
    missing = ~table.ok
    fields = {name: pyarrow.array(np.ascontiguousarray(table[name]), mask=missing) for name in table.columns}
    return fields, table.errors


def _compute_axis(features: Any, method: str | None, chord: float | None, graph: bool) -> Fields:
    found = axes(features, method, on_error="ignore", threads=1)
    points, lines, parts = found.lines(chord)
    errors = found.errors
    missing = ~found.ok
    fields = {"geometry": arrays.Geometries(points, (lines, parts), errors).to_arrow()}
    for name, column in found.summary().items():
        fields[name] = pyarrow.array(np.ascontiguousarray(column), mask=missing)
    if graph:
        nodes, edges = found.nodes, found.edges
        columns = {name: nodes[name] for name in ("x", "y", "radius")}
        fields["nodes"] = _lists(found.node_begin, {**columns, "kind": nodes["kind"].astype(np.int32)})
        ends = {"from": edges["node"][:, 0], "to": edges["node"][:, 1],
                "left": edges["site"][:, 0], "right": edges["site"][:, 1]}  # fmt: skip
        control = dict(zip(("x", "y", "radius"), edges["control"].T, strict=True))
        whole = {name: column.astype(np.int32) for name, column in ends.items()}
        fields["edges"] = _lists(found.edge_begin, {**whole, **control, "weight": edges["weight"]})
    return fields, errors


def _struct(batch: Any, at: int, compute: Callable[[Any], Fields]) -> Any:
    """The result of a column of a batch as an Arrow array of structs."""
    column = batch.column(at)
    present = column.drop_null() if column.null_count else column
    fields, errors = compute(ragged(present))
    fields = {**fields, "error": _errors(errors, len(present))}
    made = pyarrow.StructArray.from_arrays(list(fields.values()), list(fields))
    if not column.null_count:
        return made
    valid = column.is_valid().to_numpy(zero_copy_only=False)
    return made.take(pyarrow.array(np.cumsum(valid) - 1, mask=~valid))


def _over_geometries(df: DataFrame, function: str) -> DataFrame:
    """Applies a function to all columns of Sedona geometries."""
    changed = {f.name: functions.expr(f"{function}(`{f.name}`)") for f in df.schema.fields if _is_sedona(f.dataType)}
    return df.withColumns(changed) if changed else df


def _is_sedona(kind: DataType) -> bool:
    return isinstance(kind, UserDefinedType) and type(kind).__name__ == "GeometryType"


def _with(df: DataFrame, column: str, into: str, result: list[StructField], compute: Callable[[Any], Fields]) -> DataFrame:
    """The DataFrame with one more column, computed from another."""
    sedona = {field.name for field in df.schema.fields if _is_sedona(field.dataType)}
    plain = _over_geometries(df, "ST_AsBinary")
    kept = StructType([field for field in plain.schema.fields if field.name != into])
    if column not in kept.names:
        raise MedialError(f"there is no column {column!r} beside {into!r}", "invalid_option")
    schema = StructType([*kept.fields, StructField(into, StructType([*result, StructField("error", _ERROR)]))])
    names = kept.names

    def work(batches: Iterator[Any]) -> Iterator[Any]:
        for batch in batches:
            at = batch.schema.get_field_index(column)
            columns = [batch.column(name) for name in names]
            yield pyarrow.RecordBatch.from_arrays([*columns, _struct(batch, at, compute)], [*names, into])

    made = plain.mapInArrow(work, schema)
    back = {name: functions.expr(f"ST_GeomFromWKB(`{name}`)") for name in sedona if name != into}
    if column in sedona and any(field.name == "geometry" for field in result):
        geometry = functions.expr(f"ST_GeomFromWKB(`{into}`.geometry)")
        back[into] = functions.col(f"`{into}`").withField("geometry", geometry)
    return made.withColumns(back) if back else made


def axis(df: DataFrame, column: str = "geometry", into: str = "axis", *, method: str | None = None,
         chord: float | None = None, graph: bool = False) -> DataFrame:  # fmt: skip
    """The medial axes.

    Parameters
    ----------
    df : DataFrame
    column : str
        The column of polygons, as well-known binary or Sedona geometries.
    into : str
        The name of the new column: a struct of `geometry` (multi line strings), `length`, the
        largest disk's `radius`, `x` and `y`, and `error`.
    method : str, optional
        See `medial.axis`.
    chord : float, optional
        The largest distance of lines from curves.
    graph : bool
        Add arrays of `nodes` and `edges` to the struct.
    """
    result = [_GEOMETRY, *_doubles("length", "radius", "x", "y")]
    if graph:
        result += [StructField("nodes", ArrayType(_NODES)), StructField("edges", ArrayType(_EDGES))]
    return _with(df, column, into, result, lambda given: _compute_axis(given, method, chord, graph))


def _lines(df: DataFrame, column: str, into: str, make: Callable[[Any], arrays.Geometries]) -> DataFrame:
    def compute(given: Any) -> Fields:
        found = make(given)
        return {"geometry": found.to_arrow()}, found.errors

    return _with(df, column, into, [_GEOMETRY], compute)


def centerline(df: DataFrame, column: str = "geometry", into: str = "centerline", **given: Any) -> DataFrame:
    """The centre lines as LineStrings; takes the options of `medial.arrays.centerline`."""
    return _lines(df, column, into, lambda x: arrays.centerline(x, on_error="ignore", threads=1, **given))


def offset(df: DataFrame, distance: float, column: str = "geometry", into: str = "offset", **given: Any) -> DataFrame:
    """The points farther than `distance` from the boundary as MultiPolygons; negative: outwards."""
    return _lines(df, column, into, lambda x: arrays.offset(x, distance, on_error="ignore", threads=1, **given))


def prune(df: DataFrame, column: str = "geometry", into: str = "pruned", **given: Any) -> DataFrame:
    """The pruned axes as MultiLineStrings; takes the options of `medial.arrays.prune`."""
    return _lines(df, column, into, lambda x: arrays.prune(x, on_error="ignore", threads=1, **given))


def width(df: DataFrame, column: str = "geometry", into: str = "width", **given: Any) -> DataFrame:
    """The `mean`, `min` and `max` width along the centre lines, and their `length`."""

    def compute(x: Any) -> Fields:
        return _row_fields(arrays.width(x, on_error="ignore", threads=1, **given))

    return _with(df, column, into, _doubles("mean", "min", "max", "length"), compute)


def inscribed_circles(df: DataFrame, count: int = 1, column: str = "geometry", into: str = "circles",
                      smallest: float = 0) -> DataFrame:  # fmt: skip
    """The largest disjoint circles: an array `circles` of `x`, `y` and `radius`."""

    def compute(x: Any) -> Fields:
        found = arrays.inscribed_circles(x, count, smallest, on_error="ignore", threads=1)
        return {"circles": found.to_arrow()}, found.errors

    row = StructType(_doubles("x", "y", "radius"))
    return _with(df, column, into, [StructField("circles", ArrayType(row))], compute)


def balanced(df: DataFrame, column: str = "geometry", partitions: int | None = None) -> DataFrame:
    """The same rows in partitions of about equal numbers of vertices.

    Hashing alone may put several large features, which take most of the time, into one partition.
    Here large features go, by decreasing size, to the partition with the least work so far; small
    ones go by hash. The result depends on the geometries alone, so repeated tasks agree.

    Parameters
    ----------
    partitions : int, optional
        The default is ``spark.sql.shuffle.partitions``.
    """
    session = df.sparkSession
    count = partitions or int(str(session.conf.get("spark.sql.shuffle.partitions")))
    field = next(field for field in df.schema.fields if field.name == column)
    binary = functions.expr(f"ST_AsBinary(`{column}`)") if _is_sedona(field.dataType) else functions.col(f"`{column}`")
    weighed = df.select(functions.xxhash64(binary).alias("key"), functions.octet_length(binary).alias("weight"))
    total = weighed.agg(functions.sum("weight")).first()
    limit = (total[0] or 0) / (16 * count) if total else 0
    large = weighed.where(functions.col("weight") > limit).groupBy("key").agg(functions.sum("weight").alias("weight")).collect()
    loads = [0] * count
    places = []
    for key, weight in sorted(((row.key, row.weight) for row in large), key=lambda row: (-row[1], row[0])):
        to = loads.index(min(loads))
        loads[to] += weight
        places.append((key, to))
    # Spark partitions by the hash of a key: find one key for each partition.
    numbers = session.range(64 * count).selectExpr("id", f"pmod(hash(id), {count}) as part")
    number_of = {row.part: row.id for row in numbers.groupBy("part").agg(functions.min("id").alias("id")).collect()}
    table = session.createDataFrame([(key, number_of.get(to, to)) for key, to in places], "`medial key` long, `medial to` long")
    return (
        df.withColumn("medial key", functions.xxhash64(binary))
        .join(functions.broadcast(table), "medial key", "left")
        .withColumn("medial to", functions.coalesce("`medial to`", "`medial key`"))
        .repartition(count, functions.col("`medial to`"))
        .drop("medial key", "medial to")
    )


_TILE_EDGE = [StructField("number", LongType()), *_doubles("x0", "y0", "x1", "y1")]
_NAMES = ["node0", "node1", "site0", "site1", "degree0", "degree1"]
_CURVES = [*(f"{disk}_{name}" for disk in ("node0", "node1", "control") for name in ("x", "y", "radius")), "weight"]
_TILE_AXIS = [*(StructField(name, LongType()) for name in _NAMES), *_doubles(*_CURVES)]
_TILE = [StructField("column", IntegerType()), StructField("row", IntegerType())]


def boundary(shape: Shape) -> Any:
    """The edges of a shape as an Arrow table for `axis_of_tiles`."""
    ends = np.empty((shape.points.shape[0], 4))
    ends[:, :2] = shape.points
    begins = shape._core.loop_begin().astype(int)
    for begin, end in zip(begins[:-1], begins[1:], strict=True):
        ends[begin:end, 2:] = np.roll(shape.points[begin:end], -1, axis=0)
    columns = [pyarrow.array(np.arange(len(ends))), *(pyarrow.array(np.ascontiguousarray(column)) for column in ends.T)]
    return pyarrow.table(columns, ["number", "x0", "y0", "x1", "y1"])


def _rows(table: Any) -> tuple[Any, Any]:
    """The numbers of a table of edges, and their coordinates as rows."""
    columns = [table.column(name).to_numpy() for name in ("x0", "y0", "x1", "y1")]
    return np.ascontiguousarray(table.column("number").to_numpy(), np.int64), np.ascontiguousarray(np.stack(columns, axis=1))


def _tile_table(numbers: Any, ends: Any, names: Any, curves: Any) -> Any:
    """Open edges, then final edges of the axis, in one table; columns of the other kind are null."""
    opened, final = len(numbers), len(names)

    def padded(values: Any, before: int, after: int) -> Any:
        filled = np.concatenate([np.zeros(before, values.dtype), values, np.zeros(after, values.dtype)])
        mask = np.concatenate([np.ones(before, bool), np.zeros(len(values), bool), np.ones(after, bool)])
        return pyarrow.array(filled, mask=mask)

    columns = [padded(numbers, 0, final), *(padded(column, 0, final) for column in ends.T)]
    columns += [padded(column, opened, 0) for rows in (names, curves) for column in rows.T]
    return pyarrow.table(columns, [field.name for field in (*_TILE_EDGE, *_TILE_AXIS)])


def axis_of_tiles(edges: DataFrame, levels: int, *, tolerance: float = 0) -> DataFrame:
    """The axis of one shape too large for any machine.

    Each tile of a quadtree is a group of rows, computed by itself; what it cannot finish becomes
    rows of its parent tile (docs/tiles.md). Straight edges only. Results of each level stay cached
    in memory or on disk until the session ends or ``spark.catalog.clearCache()`` is called.

    Parameters
    ----------
    edges : DataFrame
        The boundary with the interior on its left: `number`, increasing along each loop, and the
        ends `x0`, `y0`, `x1`, `y1`. See `boundary`.
    levels : int
        The levels of the quadtree, at most 10: it has 4 ** levels leaves. If all leaves together
        would load more than 64 times the number of edges plus 2 ** 20, raises ``invalid_option``.
    tolerance : float
        See `medial.axis`.

    Returns
    -------
    DataFrame
        One row per edge: `node0` and `node1`, numbers that all rows of a node share except for ties
        within the tolerance; `site0` and `site1`, the lower one first, which are twice the number of an
        edge, plus one for the vertex where it begins; the number of edges of each node; and both
        disks, control point and weight of the curve.
    """
    extremes = ["min(least(x0, x1))", "min(least(y0, y1))", "max(greatest(x0, x1))", "max(greatest(y0, y1))"]
    summary = edges.selectExpr(*extremes, "sum(abs(x1 - x0) + abs(y1 - y0))", "count(*)").first()
    *box, length, count = summary or [None, 0, 0]
    if None in box:
        raise MedialError("there are no edges", "empty")
    _core.check_tiles(box, levels, tolerance)
    # An edge crosses this many borders between leaves, and each leaf loads it.
    crossed = length * 2**levels / max(box[2] - box[0], box[3] - box[1])
    if crossed > 64 * count + 2**20:
        raise MedialError("edges meet too many tiles: use fewer levels", "invalid_option")
    edges = edges.select("number", "x0", "y0", "x1", "y1")

    def to_leaves(batches: Iterator[Any]) -> Iterator[Any]:
        for batch in batches:
            places = _core.tile_leaves(_rows(pyarrow.Table.from_batches([batch]))[1], box, levels)
            taken = batch.take(pyarrow.array(places[:, 0]))
            at = [pyarrow.array(places[:, i].astype(np.int32)) for i in (1, 2)]
            yield pyarrow.RecordBatch.from_arrays([*at, *taken.columns], ["column", "row", *taken.schema.names])

    def work(level: int) -> Callable[[Any, Any], Any]:
        def tile(key: Any, table: Any) -> Any:
            numbers, ends = _rows(table)
            order = np.argsort(numbers, kind="stable")
            numbers, ends = numbers[order], ends[order]
            column, row = (value.as_py() for value in key)
            names, curves, opened = _core.tile(ends, numbers, box, levels, level, column, row, tolerance)
            at = np.searchsorted(numbers, opened)
            table = _tile_table(numbers[at], ends[at], names, curves)
            places = [pyarrow.array(np.full(len(table), place // 2, np.int32)) for place in (column, row)]
            return table.add_column(0, "row", places[1]).add_column(0, "column", places[0])

        return tile

    tiles = edges.mapInArrow(to_leaves, StructType([*_TILE, *_TILE_EDGE]))
    final: DataFrame | None = None
    for level in range(levels, -1, -1):
        # Each row names its parent tile, by which the next level groups.
        rows = StructType([*_TILE, *_TILE_EDGE, *_TILE_AXIS])
        done = tiles.groupBy("column", "row").applyInArrow(work(level), rows).persist()
        own = done.where("site0 is not null").select([field.name for field in _TILE_AXIS])
        final = own if final is None else final.union(own)
        opened = done.where("number is not null").select([field.name for field in (*_TILE, *_TILE_EDGE)])
        tiles = opened.dropDuplicates(["column", "row", "number"])
    assert final is not None
    return final.dropDuplicates(_NAMES[:4])
