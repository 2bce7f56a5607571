#!/usr/bin/env python3
"""Measures Spark, Dask-GeoPandas and DuckDB beside the package alone: footprints as well-known binary.

    engines.py [COUNT]

Processor seconds of one thread, but for whole jobs of engines: seconds on the clock, on one core.
Engines that are not installed are left out: `make spark` installs them.
"""

import os
import sys
import tempfile
import time

import numpy as np
import pyarrow
import pyarrow.parquet
import shapely

import medial.arrays

COUNT = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
os.environ["PYSPARK_PYTHON"] = sys.executable


def least(work, clock=time.process_time, times=3):
    best = float("inf")
    for _ in range(times):
        begin = clock()
        work()
        best = min(best, clock() - begin)
    return best


def row(name, took):
    print(f"| {name} | {took:.3g} | {COUNT / took:,.0f} |", flush=True)


def footprints():
    ell = np.array([(0, 0), (10, 0), (10, 4), (5, 4), (5, 12), (0, 12), (0, 0)], float)
    at = np.arange(COUNT)
    shift = np.stack([at % 300 * 20, at // 300 * 20], axis=1).astype(float)
    flat = (ell + shift[:, None]).reshape(-1, 2)
    offsets = np.arange(COUNT + 1)
    return shapely.from_ragged_array(shapely.GeometryType.POLYGON, flat, (7 * offsets, offsets))


def spark(path, wkb):
    from pyspark.sql import SparkSession

    import medial.spark

    batches = [pyarrow.record_batch([wkb[i : i + 10_000]], ["geometry"]) for i in range(0, COUNT, 10_000)]

    def batch_by_batch(compute):
        return least(lambda: [medial.spark._struct(batch, 0, compute) for batch in batches])

    row("what tasks of Spark do: axis", batch_by_batch(lambda x: medial.spark._compute_axis(x, None, None, False)))
    row("the same with the graph", batch_by_batch(lambda x: medial.spark._compute_axis(x, None, None, True)))
    session = (
        SparkSession.builder.master("local[1]").config("spark.ui.enabled", "false").config("spark.ui.showConsoleProgress", "false")
    ).getOrCreate()
    session.sparkContext.setLogLevel("OFF")
    frame = session.read.parquet(path)
    out = path + ".out"

    def job(made):
        return lambda: made.write.mode("overwrite").parquet(out)

    row("Spark, Parquet to Parquet: nothing", least(job(frame), time.perf_counter, 2))
    through = frame.mapInArrow(lambda batches: batches, frame.schema)
    row("Spark, through Python: nothing", least(job(through), time.perf_counter, 2))
    row("Spark: axis", least(job(medial.spark.axis(frame)), time.perf_counter, 2))
    row("Spark: centerline", least(job(medial.spark.centerline(frame)), time.perf_counter, 2))
    session.stop()


def dask(polygons):
    import dask_geopandas
    import geopandas

    import medial.geo  # noqa: F401

    parts = dask_geopandas.from_geopandas(geopandas.GeoDataFrame(geometry=polygons), npartitions=10)
    lines = parts.map_partitions(lambda part: part.medial.axis(), meta=geopandas.GeoSeries([]))
    row("Dask-GeoPandas: axis", least(lambda: lines.compute(scheduler="synchronous"), time.perf_counter, 2))


def duckdb(path):
    import duckdb

    connection = duckdb.connect(config={"threads": 1})

    def axis(wkb):
        return medial.arrays.axis(wkb, on_error="ignore", threads=1).to_arrow()

    connection.create_function("medial_axis", axis, ["BLOB"], "BLOB", type="arrow", null_handling="special")
    query = f"copy (select medial_axis(geometry) as axis from '{path}') to '{path}.duck' (format parquet)"
    row("DuckDB, Parquet to Parquet: axis", least(lambda: connection.execute(query), time.perf_counter, 2))


def main():
    polygons = footprints()
    wkb = pyarrow.array(shapely.to_wkb(polygons), pyarrow.binary())
    print(f"\n## {COUNT:,} footprints on engines\n\n| | s | a second |\n| --- | ---: | ---: |")
    medial.options.threads = 1
    row("medial.axes", least(lambda: medial.axes(wkb)))
    row("medial.arrays.axis, to well-known binary", least(lambda: medial.arrays.axis(wkb).to_arrow()))
    row("medial.arrays.centerline, the same", least(lambda: medial.arrays.centerline(wkb).to_arrow()))
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "footprints.parquet")
        pyarrow.parquet.write_table(pyarrow.table({"geometry": wkb}), path)
        for run, given in ((spark, (path, wkb)), (dask, (polygons,)), (duckdb, (path,))):
            try:
                run(*given)
            except ImportError as missing:
                print(f"{run.__name__}: {missing}")


if __name__ == "__main__":
    main()
