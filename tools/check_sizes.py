#!/usr/bin/env python3
"""Checks that the project stays small enough to read: its lines, its public headers, its functions.

    tools/check_sizes.py [--longest N]

Needs Universal Ctags; exits with 77 without. A function is as long as its lines from its name to its closing
brace; a lambda counts with the function around it. Prints the sizes and the N longest functions. Fails if a size
exceeds its limit, except for the lines in all, whose limit is a goal.
"""

import argparse
import json
import pathlib
import shutil
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
LINES = 60_000          # of src, cli and include: a goal
HEADER_LINES = 2_600    # of include
FUNCTION_LINES = 60     # of every function
MEDIAN_LINES = 8        # of functions


def sources(*folders):
    paths = (path for folder in folders for path in (ROOT / folder).rglob("*"))
    return sorted(path for path in paths if path.suffix in {".h", ".cpp"})


def lines_of(paths):
    return sum(path.read_bytes().count(b"\n") for path in paths)


def functions_of(paths):
    """Length, file, line and name of each function that is defined in `paths`, longest first."""
    tags = subprocess.run(
        ["ctags", "--languages=C++", "--langmap=C++:.h.cpp", "--kinds-C++=f", "--fields=+ne",
         "--output-format=json", "-f", "-", "-L", "-"],
        input="\n".join(map(str, paths)), stdout=subprocess.PIPE, check=True, text=True).stdout
    functions = []
    for tag in map(json.loads, tags.splitlines()):
        if tag["name"].startswith("__anon") or "end" not in tag:
            continue
        path = pathlib.Path(tag["path"]).relative_to(ROOT)
        functions.append((tag["end"] - tag["line"] + 1, str(path), tag["line"], tag["name"]))
    return sorted(functions, reverse=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--longest", type=int, default=10, metavar="N", help="functions to list (10)")
    options = parser.parse_args()
    if shutil.which("ctags") is None:
        print("there is no ctags: nothing was checked")
        return 77

    functions = functions_of(sources("src", "cli", "include"))
    sizes = [
        ("lines of src, cli and include", lines_of(sources("src", "cli", "include")), LINES),
        ("lines of public headers", lines_of(sources("include")), HEADER_LINES),
        (f"lines of the longest of {len(functions)} functions", functions[0][0], FUNCTION_LINES),
        ("lines of the median function", statistics.median_low(f[0] for f in functions), MEDIAN_LINES),
    ]
    for what, size, limit in sizes:
        print(f"{size:7,} {what}, at most {limit:,}" + (": TOO MANY" if size > limit else ""))
    too_long = sum(1 for function in functions if function[0] > FUNCTION_LINES)
    for length, path, line, name in functions[:max(options.longest, too_long)]:
        print(f"{length:7} {path}:{line}: {name}")
    return 1 if any(size > limit for _, size, limit in sizes[1:]) else 0


if __name__ == "__main__":
    sys.exit(main())
