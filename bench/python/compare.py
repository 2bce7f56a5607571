#!/usr/bin/env python3
"""Measures the Python package beside its peers, on one thread, by processor time.

    compare.py [COUNT [POLYGON.wkt [PROGRAM]]]

PROGRAM is medial_python_steps (steps.cpp), which does the same in C++; without it those are left out.
Peers that are not installed are left out: pip install pygeoops centerline scikit-image.
"""

import multiprocessing
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np
import shapely

import medial
import medial.image

COUNT = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000


def seconds(work, times=3):
    """The least processor time of some runs."""
    best = float("inf")
    for _ in range(times):
        begin = time.process_time()
        work()
        best = min(best, time.process_time() - begin)
    return best


def row(name, count, took):
    print(f"| {name} | {took:.4g} | {count / took:,.0f} |", flush=True)


def footprints(count):
    """L-shaped footprints, as shapely.to_ragged_array() has them."""
    ell = np.array([(0, 0), (10, 0), (10, 4), (5, 4), (5, 12), (0, 12), (0, 0)], float)
    at = np.arange(count)
    shift = np.stack([at % 300 * 20, at // 300 * 20], axis=1).astype(float)
    return (ell + shift[:, None]).reshape(-1, 2), (np.arange(count + 1) * 7, np.arange(count + 1))


def many():
    print(f"\n## {COUNT:,} L-shaped footprints\n\n| | s | a second |\n| --- | ---: | ---: |")
    given = footprints(COUNT)
    for method in ("disks", "lee", "auto"):
        row(f"arrays to axes, {method}", COUNT, seconds(lambda: medial.axes(given, method, threads=1)))
    row("arrays to shapely lines, auto", COUNT, seconds(lambda: medial.axes(given, "auto", threads=1).to_shapely()))
    few = shapely.from_ragged_array(shapely.GeometryType.POLYGON, *footprints(300))
    try:
        import pygeoops
        row("pygeoops.centerline", len(few), seconds(lambda: pygeoops.centerline(few), 1))
    except ImportError:
        pass
    try:
        from centerline.geometry import Centerline
        row("centerline", 50, seconds(lambda: [Centerline(p) for p in few[:50]], 1))
    except ImportError:
        pass


def one():
    print("\n## One call\n\n| | s | a second |\n| --- | ---: | ---: |")
    rectangle = np.array([(0, 0), (4, 0), (4, 2), (0, 2)], float)
    for method in ("disks", "auto"):
        row(f"a rectangle, {method}", 20_000, seconds(lambda: [medial.axis(rectangle, method) for _ in range(20_000)]))


def large(path):
    """What Python adds to the library's own time."""
    print(f"\n## {pathlib.Path(path).name}, one thread\n\n| | s |\n| --- | ---: |")
    points = shapely.get_coordinates(shapely.from_wkt(pathlib.Path(path).read_text()))
    shape = medial.Shape(points)
    inside = medial.axis(shape, threads=1)

    def line(name, work):
        print(f"| {name} | {seconds(work, 5):.4g} |")

    line("the axis of the shape", lambda: medial.axis(shape, threads=1))
    line("the shape of coordinates", lambda: medial.Shape(points))
    line("the axis of coordinates", lambda: medial.axis(points, threads=1))
    line("its nodes and edges as arrays", lambda: (inside.nodes["x"].sum(), inside.edges["weight"].sum()))
    if len(sys.argv) > 3:
        beside_cpp(points, shape)
    line("the largest circle, of coordinates", lambda: medial.maximum_inscribed_circle(points))
    line("shapely.maximum_inscribed_circle", lambda: shapely.maximum_inscribed_circle(shapely.Polygon(points)))


def beside_cpp(points, shape, times=9):
    """The same steps in C++, in turn with Python: medians of processor time, and their quotients."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "points")
        points.tofile(file)
        program = subprocess.Popen([sys.argv[3], file], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        cpp, python = [], []
        for _ in range(times):
            print(file=program.stdin, flush=True)
            *took, length = map(float, program.stdout.readline().split())
            cpp.append((*took, sum(took)))
            began = time.process_time()
            own = medial.Shape(points)
            built = time.process_time()
            axis = medial.axis(own, threads=1)
            end = time.process_time()
            assert axis.length == length
            python.append((built - began, end - built, seconds(lambda: medial.axis(points, threads=1), 1)))
        program.communicate()
    names = "the shape", "its axis", "both, as one call"
    for name, a, b in zip(names, np.median(cpp, axis=0), np.median(python, axis=0), strict=True):
        print(f"| {name}: C++ {a:.4g}, Python {b:.4g} | {b / a:.3f} times |", flush=True)


def imports():
    code = "import numpy, time; begin = time.process_time(); import medial; print(time.process_time() - begin)"
    took = [float(subprocess.check_output([sys.executable, "-c", code])) for _ in range(20)]
    print(f"\n`import medial` after NumPy: {1000 * min(took):.1f} ms")


def picture(size):
    from skimage import data, transform

    return transform.resize((~data.horse()).astype(float), (size, size), order=0) > 0.5


def kilobytes(name):
    status = pathlib.Path("/proc/self/status").read_text()
    return int(next(line for line in status.splitlines() if line.startswith(name)).split()[1])


def of_image(module, name, size):
    """The milliseconds of a function of images, and the megabytes that it adds; in a new process."""
    import importlib

    function = getattr(importlib.import_module(module), name)
    image, small = picture(size), np.eye(8, dtype=bool)
    function(small)
    pathlib.Path("/proc/self/clear_refs").write_text("5")  # forgets the peak so far
    before = kilobytes("VmRSS")
    function(image)
    memory = kilobytes("VmHWM") - before
    return 1000 * seconds(lambda: function(image), 2), memory / 1024


def images():
    print("\n## Images: milliseconds (megabytes)\n\n| pixels | | scikit-image | here | times |\n| --- | --- | ---: | ---: | ---: |")
    new = multiprocessing.get_context("spawn")  # a process for each measurement
    for size in (512, 1024, 2048, 4096):
        for name in ("medial_axis", "skeletonize"):
            numbers = []
            for module in ("skimage.morphology", "medial.image"):
                with new.Pool(1) as pool:
                    numbers.append(pool.apply(of_image, (module, name, size)))
            (theirs, their_memory), (ours, our_memory) = numbers
            line = f"| {size} | {name} | {theirs:.1f} ({their_memory:.0f}) | {ours:.1f} ({our_memory:.0f}) |"
            print(f"{line} {theirs / ours:.1f} |", flush=True)


if __name__ == "__main__":
    many()
    one()
    imports()
    if len(sys.argv) > 2:
        large(sys.argv[2])
    images()
