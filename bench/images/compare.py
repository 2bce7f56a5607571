#!/usr/bin/env python3
"""Compares medial's brushfire with scikit-image and OpenCV, on one thread.

    bench/images/compare.py PROGRAM FOLDER [--sizes 1024,4096] [--rounds 3]

PROGRAM is medial_bench_images. Draws a coastline, a maze, a blob and a grid of holes into FOLDER, times
everything, checks that every result has the image's number of components (8-connected) and of holes
(4-connected), and prints tables in Markdown. Each timing runs in a process of its own, so that its peak
memory is its own; the least time of all rounds counts. Exit status 1: a bar was missed.
"""

import argparse
import math
import multiprocessing
import os
import pathlib
import subprocess
import sys
import time

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import cv2
import numpy as np
import scipy.ndimage
import skimage
import skimage.morphology

FAMILIES = ["simultaneous", "marking", "sides", "sequential"]


def filled(points, size):
    image = np.zeros((size, size), np.uint8)
    cv2.fillPoly(image, [np.round(points).astype(np.int32)], 1)
    return image > 0


def around(radius, size):
    angle = np.linspace(0, 2 * np.pi, len(radius), endpoint=False)
    return size * np.stack([0.5 + radius * np.cos(angle), 0.5 + radius * np.sin(angle)], 1)


def coastline(size, random):
    radius, step = np.full(8, 0.3), 0.08
    while len(radius) < 16 * size:
        middle = (radius + np.roll(radius, -1)) / 2 + random.normal(0, step, len(radius))
        radius = np.stack([radius, middle], 1).ravel()
        step *= 0.55
    return filled(around(radius, size), size)


def blob(size, random):
    angle = np.linspace(0, 2 * np.pi, 8 * size, endpoint=False)
    return filled(around(0.35 + 0.08 * np.sin(3 * angle) + 0.04 * np.cos(5 * angle), size), size)


def maze(size, random):
    cells, pitch = size // 16, 16
    image = np.zeros((size, size), bool)
    seen = np.zeros((cells, cells), bool)
    seen[0, 0] = True
    way = [(0, 0)]
    while way:
        y, x = way[-1]
        free = [(v, u) for v, u in ((y, x + 1), (y + 1, x), (y, x - 1), (y - 1, x))
                if 0 <= v < cells and 0 <= u < cells and not seen[v, u]]
        if not free:
            way.pop()
            continue
        v, u = free[random.integers(len(free))]
        seen[v, u] = True
        way.append((v, u))
        image[min(y, v) * pitch + 3:max(y, v) * pitch + 13,
              min(x, u) * pitch + 3:max(x, u) * pitch + 13] = True
    return image


def holes(size, random):
    y, x = np.mgrid[0:size, 0:size] % 64 - 32
    image = x * x + y * y > 18 * 18
    image[:4] = image[-4:] = False
    image[:, :4] = image[:, -4:] = False
    return image


def topology(image):
    """Components and holes."""
    parts = scipy.ndimage.label(image, np.ones((3, 3)))[1]
    outside = np.pad(~image, 1, constant_values=True)
    return parts, scipy.ndimage.label(outside)[1] - 1


def peer(name):
    """A function from an image to its skeleton."""
    if name == "skeletonize":
        return skimage.morphology.skeletonize
    if name == "medial_axis":
        return lambda image: skimage.morphology.medial_axis(image, return_distance=True)[0]
    kind = {"opencv zhang-suen": cv2.ximgproc.THINNING_ZHANGSUEN,
            "opencv guo-hall": cv2.ximgproc.THINNING_GUOHALL}[name]
    return lambda image: cv2.ximgproc.thinning(image.astype(np.uint8) * 255, thinningType=kind) > 0


def status_bytes(key):
    """VmRSS: resident memory; VmHWM: at most so far."""
    with open("/proc/self/status") as file:
        return next(1024 * int(line.split()[1]) for line in file if line.startswith(key + ":"))


def run_peer(name, path, rounds, pipe):
    cv2.setNumThreads(1)
    image = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE) == 0  # PBM: black is set
    thin = peer(name)
    before = status_bytes("VmRSS")
    best = math.inf
    for _ in range(rounds):
        start = time.process_time()
        result = thin(image)
        best = min(best, time.process_time() - start)
    peak = status_bytes("VmHWM")  # that of getrusage may be the parent's
    pipe.send((best, peak - before, topology(result), result if name == "opencv guo-hall" else None))


def in_own_process(name, path, rounds):
    context = multiprocessing.get_context("spawn")
    here, there = context.Pipe()
    process = context.Process(target=run_peer, args=(name, path, rounds, there))
    process.start()
    answer = here.recv()
    process.join()
    return answer


def read_pbm(path):
    return cv2.imread(str(path), cv2.IMREAD_GRAYSCALE) == 0


def write_pbm(path, image):
    height, width = image.shape
    path.write_bytes(b"P4\n%d %d\n" % (width, height) + np.packbits(image, axis=1).tobytes())


def geometric_mean(values):
    return math.exp(sum(map(math.log, values)) / len(values))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--sizes", default="1024,4096")
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    peers = ["skeletonize", "medial_axis", "opencv zhang-suen", "opencv guo-hall"]
    print(f"scikit-image {skimage.__version__}, OpenCV {cv2.__version__}; seconds of processor time, least of "
          f"{arguments.rounds}; in brackets where the topology is not the image's: components/holes\n")
    print("| image | distance, ns a pixel | " + " | ".join(FAMILIES + peers) + " | peak MB: medial | medial_axis |")
    print("| --- |" + " ---: |" * (3 + len(FAMILIES + peers)))
    faults, ratios, axis_ratios = [], {f: [] for f in FAMILIES}, {f: [] for f in FAMILIES}
    for size in map(int, arguments.sizes.split(",")):
        for make in (coastline, maze, blob, holes):
            name = f"{make.__name__} {size}"
            path = arguments.folder / f"{make.__name__}{size}.pbm"
            image = make(size, np.random.default_rng(1))
            write_pbm(path, image)
            expected = topology(image)
            seconds, cells, own_peak, distance = {}, [], 0, math.inf
            guo_hall = None
            for family in FAMILIES:
                result = path.with_suffix(f".{family}.pbm")
                text = subprocess.run([arguments.program, family, str(arguments.rounds), path, result],
                                      check=True, text=True, capture_output=True).stdout
                thinning, measuring, peak = map(float, text.split())
                seconds[family] = thinning + measuring
                distance = min(distance, measuring)
                own_peak = max(own_peak, peak)
                found = topology(read_pbm(result))
                if family == "marking":
                    guo_hall = read_pbm(result)
                if found != expected:
                    faults.append(f"{name}, {family}: {found} instead of {expected}")
                cells.append(f"{thinning:.4f}")
            for other in peers:
                slow = size > 2048 and other.startswith("opencv")  # a minute and more
                best, peak, found, result = in_own_process(other, path, 1 if slow else arguments.rounds)
                seconds[other] = best
                if other == "medial_axis":
                    axis_peak = peak
                if other == "opencv guo-hall" and (result != guo_hall).any():
                    faults.append(f"{name}: marking differs from OpenCV's Guo and Hall in "
                                  f"{(result != guo_hall).sum()} pixels")
                cells.append(f"{best:.4f}" + ("" if found == expected else f" [{found[0]}/{found[1]}]"))
            nanoseconds = 1e9 * distance / size ** 2
            for family in FAMILIES:
                ratios[family].append(seconds["skeletonize"] / seconds[family])
                axis_ratios[family].append(seconds["medial_axis"] / seconds[family])
            if nanoseconds > 10:
                faults.append(f"{name}: {nanoseconds:.1f} ns a pixel")
            if size >= 4096 and own_peak > axis_peak / 4:
                faults.append(f"{name}: peak memory {own_peak / 1e6:.0f} MB of {axis_peak / 1e6:.0f}")
            print(f"| {name} | {nanoseconds:.1f} | " + " | ".join(cells) +
                  f" | {own_peak / 1e6:.0f} | {axis_peak / 1e6:.0f} |", flush=True)
    print("\nTimes of peers over thinning and distances together:\n")
    print("| family | skeletonize: least | geometric mean | medial_axis: least |\n| --- | ---: | ---: | ---: |")
    for family in FAMILIES:
        least, mean, axis = min(ratios[family]), geometric_mean(ratios[family]), min(axis_ratios[family])
        print(f"| {family} | {least:.1f} | {mean:.1f} | {axis:.1f} |")
        if least < 1 or mean < 4 or axis < 10:
            faults.append(f"{family}: {least:.2f}, {mean:.2f} and {axis:.2f} times")
    for fault in faults:
        print("MISSED: " + fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
