#!/usr/bin/env python3
"""Time and memory of `medial axis` against the number of vertices, and `medial tiles` against the whole.

    bench/scale.py PROGRAM [--most N] [--tiles FILE...]

Prints tables in Markdown. Processor time of one thread with reading, the best of three below a million vertices; growth is the
exponent of the time from one size to the next. Of tiles, "edges" are the edges of the boundary that a level loads, the
leaves first; the graph is compared with that of the whole by sites and nodes.
"""

import argparse
import json
import math
import os
import pathlib
import subprocess
import tempfile
from collections import Counter


def noise(count, seed=1):
    """Midpoints displaced at random, in a ring: as rough on every scale."""
    state, values = seed, [0.0]
    scale = 0.3
    while len(values) < count:
        finer = []
        for i, value in enumerate(values):
            state = (state * 6364136223846793005 + 1442695040888963407) % 2**64
            finer += [value, (value + values[(i + 1) % len(values)]) / 2 + scale * (state / 2**64 - 0.5)]
        values, scale = finer, scale * 0.55
    return values


def coast(count):
    radii = noise(count)
    for i, radius in enumerate(radii):
        angle = 2 * math.pi * i / len(radii)
        yield (1 + radius) * math.cos(angle), (1 + radius) * math.sin(angle)


def comb(count):
    teeth = count // 4
    yield from ((0, 0), (2 * teeth - 1, 0))
    for i in reversed(range(teeth)):
        yield from ((2 * i + 1, 6), (2 * i, 6))
        if i:
            yield from ((2 * i, 1), (2 * i - 1, 1))


def blob(count):
    for i in range(count):
        angle = 2 * math.pi * i / count
        radius = 1 + 0.3 * math.cos(5 * angle) + 0.05 * math.cos(13 * angle)
        yield radius * math.cos(angle), radius * math.sin(angle)


def write(path, points):
    with open(path, "w", encoding="ascii") as file:
        file.write("POLYGON ((")
        first = None
        for x, y in points:
            first = first or (x, y)
            file.write(f"{x:.15g} {y:.15g}, ")
        file.write(f"{first[0]:.15g} {first[1]:.15g}))")


def run(program, *words):
    """The report of a command, and its processor seconds without those of writing."""
    done = subprocess.run([program, *words, "--threads", "1", "--json", "--stats"], stdout=subprocess.PIPE, check=True)
    report = json.loads(done.stdout)
    return report, sum(seconds for phase, seconds in report["processor"].items() if phase != "write")


def growth(program, folder, most):
    print("| shape | vertices | us a vertex | growth | peak bytes a vertex |\n|---|--:|--:|--:|--:|")
    for make in (coast, comb, blob):
        last, count = None, 100_000
        while count <= most:
            path = os.path.join(folder, "shape.wkt")
            write(path, make(count))
            times = []
            for _ in range(3 if count < 1_000_000 else 1):
                report, seconds = run(program, "axis", path)
                times.append(seconds)
            points = report["input_points"] - 1
            per = min(times) / points
            grown = f"{math.log(min(times) / last[0]) / math.log(points / last[1]):.2f}" if last else ""
            peak = report["peak_bytes"] / points
            print(f"| {make.__name__} | {points:,} | {1e6 * per:.2f} | {grown} | {peak:.0f} |", flush=True)
            last, count = (min(times), points), 10 * count


def graph(path):
    """Of all axes the pairs of sites, and the nodes."""
    with open(path, encoding="utf-8") as file:
        items = json.load(file)["items"]
    pairs, nodes = Counter(), Counter()
    for i, item in enumerate(items):
        pairs.update((i, *sorted(edge[2:4])) for edge in item["axis"]["edges"])
        nodes.update((i, *node[:3]) for node in item["axis"]["nodes"])
    return pairs, nodes


def tiles(program, folder, files):
    print("| file | tiles | times the whole | edges by level | edges of the axis | other edges | nodes equal in every bit |")
    print("|---|--:|--:|---|--:|--:|--:|")
    for file in files:
        whole, parts = os.path.join(folder, "whole.json"), os.path.join(folder, "tiles.json")
        _, alone = run(program, "axis", file, "-o", whole)
        pairs, nodes = graph(whole)
        for count in (4, 64, 1024, 4096):
            report, seconds = run(program, "tiles", file, "--tiles", str(count), "-o", parts)
            own_pairs, own_nodes = graph(parts)
            other = sum(((pairs - own_pairs) + (own_pairs - pairs)).values())
            equal = sum((nodes & own_nodes).values()) / sum(nodes.values())
            levels = ", ".join(f"{row['edges']:,}" for row in report["levels"])
            final = sum(own_pairs.values())
            cells = [pathlib.Path(file).name, f"{count:,}", f"{seconds / alone:.1f}", levels, f"{final:,}", other, f"{equal:.1%}"]
            print("|", *(f"{cell} |" for cell in cells), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--most", type=int, default=10_000_000, metavar="N", help="vertices (10,000,000)")
    parser.add_argument("--tiles", nargs="*", default=[], metavar="FILE", help="shapes to divide")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        growth(options.program, folder, options.most)
        if options.tiles:
            tiles(options.program, folder, options.tiles)


if __name__ == "__main__":
    main()
