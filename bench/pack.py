#!/usr/bin/env python3
"""Sizes of packs beside what the boundary itself takes, for docs/pack.md.

    bench/pack.py PROGRAM DATA

DATA is a folder like ../shared/data. Prints a table for each kind of shapes: the bytes of all its files
together at three errors, and of images as squares beside their PNG files.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

KINDS = {
    "coastlines": ("packaged/A_gis/gshhg", ["new_guinea*", "halmahera*", "sao_tome*", "newfoundland*"]),
    "countries": ("packaged/A_gis/countries", ["*.geojson", "*.wkt"]),
    "parcels, boroughs, a bee": ("packaged/A_gis/repos", ["*.geojson.gz", "*.wkt"]),
    "icons (bootstrap)": ("packaged/B_svg/bootstrap", ["*.svg"]),
    "drawings (DXF)": ("packaged/B_dxf", ["*.dxf*"]),
    "icons (mdi)": ("packaged/B_svg/mdi", ["*.svg"]),
    "drawings (openclipart)": ("packaged/B_svg/openclipart", ["*.svg*"]),
    "copper": ("packaged/B_pcb", ["ecc83*", "flat*"]),
}
ERRORS = [1e-2, 1e-3, 1e-4]


def run(program, *arguments):
    done = subprocess.run([program, *arguments], capture_output=True, text=True, check=False, timeout=120)
    return json.loads(done.stdout) if done.returncode == 0 else None


def main(program, data):
    with tempfile.TemporaryDirectory() as scratch:
        pack = str(pathlib.Path(scratch) / "x.mpk")
        print("| shapes | files | error | pack | boundary, alike | pack smaller | text through zstd |")
        print("| --- | --- | --- | --- | --- | --- | --- |")
        for kind, (folder, patterns) in KINDS.items():
            files = sorted({f for p in patterns for f in (data / folder).glob(p)})
            for error in ERRORS:
                packed = [run(program, "pack", str(f), "-o", pack, "--error", str(error), "--compare", "--json",
                              "--quiet", "--repair") for f in files]
                packed = [t for t in packed if t and "boundary_within_error" in t["compare"]]
                if not packed:
                    continue
                sums = [sum(v) for v in zip(*((t["bytes"], t["compare"]["boundary_within_error"],
                                                t["bytes"] < t["compare"]["boundary_within_error"],
                                                t["compare"]["boundary_text_zstd"]) for t in packed))]
                print(f"| {kind} | {len(packed)} | {error:g} | {sums[0]:,} | {sums[1]:,} | {sums[2]} | "
                      f"{sums[3]:,} |", flush=True)
        print("\n| image | pixels | squares | pack | PNG |\n| --- | --- | --- | --- | --- |")
        whole = [0, 0]
        for image in sorted((data / "packaged/C_images").glob("*.png")):
            packed = run(program, "pack", str(image), "-o", pack, "--squares", "--json", "--quiet")
            if packed:
                size = image.stat().st_size
                whole = [whole[0] + packed["bytes"], whole[1] + size]
                print(f"| {image.stem} | {packed['pixels']:,} | {packed['squares']:,} | {packed['bytes']:,} | {size:,} |")
        print(f"| all | | | {whole[0]:,} | {whole[1]:,} |")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], pathlib.Path(sys.argv[2]))
