#!/usr/bin/env python3
"""Images from file to file, by medial's command line beside scikit-image: a page of text and a blob.

    bench/images/pages.py MEDIAL FOLDER [--size 4096]

Draws both into FOLDER and prints a table in Markdown: processor seconds on one thread, of whole processes with reading
and writing, and peak memory. `skeletonize` is timed in process, without reading. Needs Pillow and scikit-image.
"""

import argparse
import os
import pathlib
import subprocess
import time

for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ[variable] = "1"

import numpy as np
import skimage.morphology
from PIL import Image, ImageDraw, ImageFont

FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSerif.ttf"
WORDS = "The axis of a shape is where the centres of its largest disks lie".split()


def page(size):
    """Lines of text, 80 to the page, white on black: medial takes what is bright."""
    image = Image.new("1", (size, size), 0)
    draw = ImageDraw.Draw(image)
    pitch = size // 80
    font = ImageFont.truetype(FONT, round(0.75 * pitch))
    for line in range(2, 78):
        text = " ".join(WORDS[(line + k) % len(WORDS)] for k in range(30))
        while draw.textlength(text, font) > 0.9 * size:
            text = text.rsplit(" ", 1)[0]
        draw.text((0.05 * size, line * pitch), text, 1, font)
    return image


def blob(size):
    angle = np.linspace(0, 2 * np.pi, 8 * size, endpoint=False)
    radius = 0.35 + 0.08 * np.sin(3 * angle) + 0.04 * np.cos(5 * angle)
    points = size * np.stack([0.5 + radius * np.cos(angle), 0.5 + radius * np.sin(angle)], 1)
    image = Image.new("1", (size, size), 0)
    ImageDraw.Draw(image).polygon([tuple(p) for p in points.round()], fill=1)
    return image


def run(words):
    """Processor seconds and peak bytes of a process; nothing if it fails."""
    process = subprocess.Popen(words, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    return None if status else (usage.ru_utime + usage.ru_stime, 1024 * usage.ru_maxrss)


def skeletonize(image):
    shape = np.array(image.convert("L")) > 0  # of one bit, Pillow's are no proper bools
    begin = time.process_time()
    skimage.morphology.skeletonize(shape)
    return time.process_time() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--size", type=int, default=4096)
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    print("| image | what | processor s | peak MB |\n|---|---|--:|--:|")
    fire = ["--method", "brushfire"]
    commands = {
        "brushfire, no output": fire, "brushfire to .json": [*fire, "-o", "axis.json"],
        "brushfire to .png": [*fire, "-o", "axis.png"], "the default, no output": [],
        "the default to .png": ["-o", "axis.png"], "`--smooth-contour`, no output": ["--smooth-contour"],
    }  # fmt: skip
    for make in (page, blob):
        path = options.folder / f"{make.__name__}.png"
        image = make(options.size)
        image.save(path)
        for name, words in commands.items():
            words = [str(options.folder / word) if word.startswith("axis.") else word for word in words]
            cost = run([options.program, "axis", str(path), *words, "--threads", "1"])
            cells = f"{cost[0]:.2f} | {cost[1] / 1e6:.0f}" if cost else "failed |"
            print(f"| {make.__name__} | {name} | {cells} |", flush=True)
    for make in (page, blob):
        print(f"| {make.__name__} | `skeletonize` alone | {skeletonize(make(options.size)):.2f} | |", flush=True)


if __name__ == "__main__":
    main()
