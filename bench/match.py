#!/usr/bin/env python3
"""How often `medial match` finds a shape again that was changed, for docs/features.md.

    bench/match.py PROGRAM DATA

DATA is a folder like ../shared/data. Each shape asked for is turned, mirrored, scaled, made coarser or noisy;
printed is how often it ranks first, and among the first ten, of all shapes of its kind as they were.
"""

import gzip
import json
import math
import pathlib
import random
import re
import subprocess
import sys
import tempfile


def ranks(program, query, others, each):
    done = subprocess.run([program, "match", str(query), str(others), "--best", "10", "--json", "--quiet", "--repair"] +
                          (["--each"] if each else []), capture_output=True, text=True, check=False, timeout=300)
    return [m["shape"] for m in json.loads(done.stdout)["matches"]] if done.returncode == 0 else None


def tell(what, way, all_ranks, total):
    found = [r for r in all_ranks if r is not None]
    first = sum(r[:1] == [name] for name, r in found)
    ten = sum(name in r for name, r in found)
    print(f"| {what} | {total} | {way} | {len(found)} | {first} | {ten} |", flush=True)


def icons(program, data):
    """Each file between its root's tags gets a transformation."""
    files = sorted(f for d in ("mdi",) for f in (data / "packaged/B_svg" / d).glob("*.svg"))
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch) / "all"
        folder.mkdir()
        for f in files:
            (folder / f"{f.parent.name}-{f.name}").write_bytes(f.read_bytes())
        for way, transform in (("turned by 50 degrees, a third as large", "rotate(50) scale(.33)"),
                               ("turned, mirrored, 7 times as large", "rotate(200) scale(7 -7)")):
            told = []
            for f in files:
                text = re.sub(r"(<svg[^>]*>)", rf'\1<g transform="{transform}">', f.read_text(), count=1)
                query = pathlib.Path(scratch) / "query.svg"
                query.write_text(text.replace("</svg>", "</g></svg>"))
                names = ranks(program, query, folder, False)
                told.append(None if names is None else
                            (f"{f.parent.name}-{f.name}", [pathlib.Path(n).name for n in names]))
            tell("icons", way, [t for t in told if t], len(files))


def islands(program, data, count=200, asked=50):
    text = gzip.open(data / "packaged/A_gis/gshhg/islands_rank2001_4000.wkt.gz", "rt").read()
    rings = [[tuple(map(float, p.split(" "))) for p in ring.split(",")][:-1]
             for ring in re.findall(r"\(\(([^()]*)\)\)", text)][::4][:count]
    wkt = lambda r: "POLYGON((" + ",".join(f"{x!r} {y!r}" for x, y in r + r[:1]) + "))\n"
    pick = random.Random(1)
    chosen = pick.sample(range(len(rings)), asked)

    def moved(ring, angle=2.0, scale=-0.2):
        c, s = math.cos(angle), math.sin(angle)
        return [(scale * (c * x - s * y), abs(scale) * (s * x + c * y)) for x, y in ring]

    def noisy(ring, share):
        area = abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1]))) / 2
        step = share * math.sqrt(area)
        return [(x + pick.gauss(0, step), y + pick.gauss(0, step)) for x, y in ring]

    with tempfile.TemporaryDirectory() as scratch:
        every = pathlib.Path(scratch) / "all.wkt"
        every.write_text("".join(map(wkt, rings)))
        axes = every.with_suffix(".json")
        subprocess.run([program, "axis", str(every), "-o", str(axes), "--quiet"], check=True, timeout=300)
        query = pathlib.Path(scratch) / "query.wkt"
        for way, change in (("turned, mirrored, a fifth as large", moved),
                            ("the same, every second vertex", lambda r: moved(r)[::2]),
                            ("the same, vertices moved by 1 %", lambda r: noisy(moved(r), 0.01)),
                            ("the same, vertices moved by 3 %", lambda r: noisy(moved(r), 0.03))):
            told = []
            for i in chosen:
                query.write_text(wkt(change(rings[i])))
                names = ranks(program, query, axes, True)
                told.append(None if names is None else (i, [int(re.search(r"(\d+)$", n).group(1)) for n in names]))
            tell("islands", way, [t for t in told if t], len(rings))


if __name__ == "__main__":
    print("| shapes | all | asked | asked for | ranks first | among ten |")
    print("| --- | --- | --- | --- | --- | --- |")
    icons(sys.argv[1], pathlib.Path(sys.argv[2]))
    islands(sys.argv[1], pathlib.Path(sys.argv[2]))
