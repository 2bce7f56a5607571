#!/usr/bin/env python3
"""Time and memory of axes in parts against the number of vertices, and `medial tiles` against the whole.

    bench/scale.py MEDIAL MEDIAL_BENCH_SCALE [--most N] [--output FORMAT] [--tiles FILE...]

Prints tables in Markdown. Processor time of one thread, the best of three below a million vertices; growth is the
exponent of the time from one size to the next; memory is the peak above the shape alone. Of tiles, "edges" are the
edges of the boundary that a level loads, the leaves first; the graph is compared with that of the whole by sites and
nodes.
"""

import argparse
import json
import math
import os
import pathlib
import subprocess
import tempfile
from collections import Counter


def run(program, *words):
    """The report of a command, and its processor seconds without those of writing."""
    done = subprocess.run([program, *words, "--threads", "1", "--json", "--stats"], stdout=subprocess.PIPE, check=True)
    report = json.loads(done.stdout)
    return report, sum(seconds for phase, seconds in report["processor"].items() if phase != "write")


def growth(giant, folder, most, output):
    print("| shape | vertices | us a vertex | growth | bytes a vertex |\n|---|--:|--:|--:|--:|")
    for shape in ("coast", "comb", "blob", "needles"):
        last, count = None, 100_000
        while count <= most:
            target = ["-o", os.path.join(folder, "axis." + output)] if output else []
            reports = []
            for _ in range(3 if count < 1_000_000 else 1):
                done = subprocess.run([giant, shape, str(count), *target], stdout=subprocess.PIPE, check=True)
                reports.append(json.loads(done.stdout))
            report = min(reports, key=lambda each: each["seconds"])
            points, per = report["vertices"], report["microseconds_a_vertex"]
            grown = f"{math.log(per * points / (last[0] * last[1])) / math.log(points / last[1]):.2f}" if last else ""
            print(f"| {shape} | {points:,} | {per:.2f} | {grown} | {report['bytes_a_vertex']:.0f} |", flush=True)
            last, count = (per, points), 10 * count


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
    parser.add_argument("giant", help="medial_bench_scale, which makes the shapes")
    parser.add_argument("--output", default="", metavar="FORMAT", help="written: csv, fgb, safetensors ... (none)")
    parser.add_argument("--most", type=int, default=10_000_000, metavar="N", help="vertices (10,000,000)")
    parser.add_argument("--tiles", nargs="*", default=[], metavar="FILE", help="shapes to divide")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        growth(options.giant, folder, options.most, options.output)
        if options.tiles:
            tiles(options.program, folder, options.tiles)


if __name__ == "__main__":
    main()
