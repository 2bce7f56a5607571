"""Properties of random polygons, memory, threads, processes, interrupts, the time of the import."""

import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import sysconfig
import threading
import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import medial


@st.composite
def polygons(draw):
    """Star-shaped polygons with up to three star-shaped holes."""

    def star(count, low, high):
        seed = draw(st.integers(0, 2**32 - 1))
        rng = np.random.default_rng(seed)
        angles = 2 * np.pi * (np.arange(count) + rng.uniform(0.05, 0.95, count)) / count
        radii = rng.uniform(low, high, count)
        return np.stack([radii * np.cos(angles), radii * np.sin(angles)], axis=1)

    rings = [star(draw(st.integers(5, 40)), 2, 10)]
    places = [(0, 0), (0.9, 0.6), (-0.8, 0.7)]
    for place in places[: draw(st.integers(0, 3))]:
        rings.append(0.05 * star(draw(st.integers(3, 12)), 2, 10) + place)
    scale = draw(st.sampled_from([1e-3, 1.0, 1e4]))
    return [ring * scale for ring in rings]


@settings(max_examples=60)
@given(polygons())
def test_random_polygons(rings):
    try:
        shape = medial.Shape(rings)
    except medial.MedialError as error:  # the hole may reach out of a narrow ring
        assert error.code in ("crossing", "hole_outside", "overlap")
        return
    axis = medial.axis(shape)
    assert medial.verify(axis)
    parts, holes = shape._core.component_count(), int(shape.hole.sum())
    assert len(axis.nodes) - len(axis.edges) == parts - holes
    nodes = axis.nodes
    centers = np.stack([nodes["x"], nodes["y"]], axis=1)
    assert shape.clearance(centers) == pytest.approx(nodes["radius"], abs=1e-9 * shape.diagonal)
    back = medial.rebuild(axis)
    assert back.area == pytest.approx(shape.area, rel=1e-9)
    pruned = axis.prune("erosion", 0.3)
    assert pruned.length <= axis.length * (1 + 1e-12)
    circle = medial.maximum_inscribed_circle(axis)
    assert circle.radius == nodes["radius"].max()


@settings(max_examples=30)
@given(st.binary(max_size=80))
def test_random_bytes_are_errors(data):
    with pytest.raises(medial.MedialError):
        medial.axis(data)


@settings(max_examples=30)
@given(st.text("MLHVCSQTAZmlhvz0123456789.,- e", max_size=60))
def test_random_paths_are_errors_or_shapes(text):
    try:
        medial.axis("M " + text)
    except medial.MedialError:
        pass


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_nothing_leaks():
    square = np.array([(0, 0), (4, 0), (4, 2), (0, 2)], float)
    bow = np.array([(0, 0), (2, 2), (2, 0), (0, 2)], float)

    def work(count):
        for _ in range(count):
            axis = medial.axis(square)
            assert len(axis.nodes) == 6 and axis.nearest([(1, 1)])["edge"][0] >= 0
            with pytest.raises(medial.MedialError):
                medial.axis(bow)

    work(2000)
    before = resident()
    work(int(os.environ.get("MEDIAL_LEAK_CALLS", 5000)))
    assert resident() - before < 4e6


def test_threads_compute_at_the_same_time():
    results = {}
    axis = medial.axis([(0, 0), (9, 0), (9, 5), (4, 3), (0, 5)])

    def work(i):
        rng = np.random.default_rng(i % 2)
        angles = np.sort(rng.uniform(0, 2 * np.pi, 400))
        points = np.stack([np.cos(angles), np.sin(angles)], axis=1) * rng.uniform(1, 3, (400, 1))
        results[i] = medial.axis(points), axis.radius_at(points)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(results) == 6 and results[0][0] == results[2][0] == results[4][0]
    assert np.array_equal(results[1][1], results[5][1])


def test_threads_share_what_was_made():
    """In a free-threaded Python at the same time; the first question of each builds its index."""
    rng = np.random.default_rng(4)
    angles = 2 * np.pi * np.arange(300) / 300
    points = np.stack([np.cos(angles), np.sin(angles)], axis=1) * rng.uniform(1, 3, (300, 1))
    places = rng.uniform(-3, 3, (500, 2))
    axis, diagram, contour = medial.axis(points), medial.voronoi(points), medial.Contour((0, 0))
    axes = medial.axes([points + k for k in range(20)])
    start, results = threading.Barrier(8), []

    def work():
        start.wait()
        for k in range(10):
            contour.line_to((k, 1))
        results.append((
            axis.nearest(places).tobytes(), axis.clearance(places).tobytes(), diagram.nearest(places).site.tobytes(),
            axis.prune("erosion", 0.1).length, medial.centerline(axis).length, axes[7].length, len(pickle.dumps(axis)),
            axes.summary()["length"].tobytes(), medial.offset(axis, 0.1)[0].area, repr(medial.axis(points)),
        ))  # fmt: skip

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(results) == 8 and len(set(results)) == 1
    assert repr(contour) == "<medial.Contour: 80 pieces>"
    if hasattr(sys, "_is_gil_enabled") and sysconfig.get_config_var("Py_GIL_DISABLED"):
        assert not sys._is_gil_enabled()


def area_of(count):
    angles = 2 * np.pi * np.arange(count) / count
    wave = 1 + 0.1 * np.cos(7 * angles)
    return medial.axis(np.stack([wave * np.cos(angles), wave * np.sin(angles)], axis=1)).length


@pytest.mark.parametrize("start", ["fork", "spawn"])
def test_processes(start):
    here = area_of(3000)  # more than one thread
    with multiprocessing.get_context(start).Pool(2) as pool:
        assert pool.map_async(area_of, [3000, 3000]).get(timeout=120) == [here, here]


def test_an_interrupt_stops_the_work():
    angles = 2 * np.pi * np.arange(2_000_000) / 2_000_000
    wave = 1 + 0.3 * np.cos(5000 * angles)
    points = np.stack([wave * np.cos(angles), wave * np.sin(angles)], axis=1)
    timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        medial.axis(points)
        time.sleep(30)  # where the machine is faster than the timer
    assert time.monotonic() - begin < 25


def test_the_import_is_quick_and_brings_numpy_only():
    code = (
        "import numpy, time, sys; begin = time.process_time(); import medial;"
        "print(time.process_time() - begin, *sorted({'shapely', 'pandas', 'scipy', 'matplotlib'} & set(sys.modules)))"
    )
    times = []
    for _ in range(5):
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
        seconds, *others = done.stdout.split()
        assert not others
        times.append(float(seconds))
    assert min(times) < 0.06


def test_options_and_missing_packages(monkeypatch):
    monkeypatch.setattr(medial.options, "method", "biarc-dc")
    axis = medial.axis(np.array([(0, 0), (4, 0), (4, 2), (0, 2.0)]))
    assert axis.method == "biarc-dc"
    monkeypatch.setitem(sys.modules, "shapely", None)
    with pytest.raises(medial.MissingPackage, match=r"pip install medial-axis\[geo\]"):
        axis.to_shapely()


def test_nothing_is_left_when_python_ends():
    code = (
        "import numpy as np, medial, medial.image, medial.arrays;"
        "kept = [medial.axis(np.array([(0, 0), (4, 0), (4, 2), (0, 2)], float)), medial.axis];"
        "medial.image.medial_axis(np.eye(8)); medial.arrays.width([[(0, 0), (4, 0), (4, 2)]])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True,
                          env={**os.environ, "MEDIAL_LEAK_WARNINGS": "1"})
    assert "leaked" not in done.stderr


def test_forks_after_many_threads_do_not_wait():
    for _ in range(3):
        medial.axes([np.array([(0, 0), (4, 0), (4, k), (0, 2)], float) for k in range(1, 600)], threads=3)
        here = area_of(3000)
        with multiprocessing.get_context("fork").Pool(2) as pool:
            assert pool.map_async(area_of, [3000, 3000]).get(timeout=60) == [here, here]
