#!/usr/bin/env python3
"""Checks that what README.md tells a newcomer to type is true.

    tools/check_readme.py PROGRAM

Runs its `medial` commands in a scratch folder with data/, in their order; looks up its `make` verbs in
the Makefile; compares its C++ with the example that the install test builds; looks for the files it
links to.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
README = (ROOT / "README.md").read_text()


def blocks(language):
    return re.findall(rf"^```{language}\n(.*?)^```$", README, re.MULTILINE | re.DOTALL)


def check_commands(program):
    """Runs every line of the sh blocks that calls medial."""
    faults = []
    commands = [line for block in blocks("sh") for line in block.splitlines()
                if re.search(r"(^|\| *)medial ", line) and not line.startswith("#")]
    if not commands:
        faults.append("README.md has no command of medial")
    with tempfile.TemporaryDirectory() as scratch:
        os.symlink(ROOT / "data", pathlib.Path(scratch) / "data")
        os.symlink(pathlib.Path(program).resolve(), pathlib.Path(scratch) / "medial")
        environment = dict(os.environ, PATH=scratch + os.pathsep + os.environ["PATH"])
        for command in commands:
            # Of a pipe, every part but one that `head` cuts short has to succeed.
            done = subprocess.run(["bash", "-c", command], cwd=scratch, env=environment, text=True,
                                  capture_output=True, check=False)
            if done.returncode != 0:
                faults.append(f"{command}\n  exit status {done.returncode}: {done.stderr.strip()}")
            output = re.search(r"-o (\S+\.\w+)", command)
            if output and not (pathlib.Path(scratch) / output[1]).is_file():
                faults.append(f"{command}\n  wrote no {output[1]}")
            if "-o -" in command and not done.stdout.strip():
                faults.append(f"{command}\n  printed nothing")
    return faults


def check_verbs():
    known = set(re.findall(r"^([a-z]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
    told = set(re.findall(r"^make ([a-z]+)", "\n".join(blocks("sh")), re.MULTILINE))
    told |= set(re.findall(r"`make ([a-z]+)", README))
    return [f"make {verb}: no such verb" for verb in sorted(told - known)]


def check_example():
    example = (ROOT / "examples" / "consumer" / "main.cpp").read_text()
    return [] if blocks("cpp") == [example] else ["the C++ is not that of examples/consumer/main.cpp"]


def check_links():
    targets = re.findall(r"\]\(([^)#:]+)\)", README)
    return [f"{target}: no such file" for target in targets if not (ROOT / target).exists()]


def main():
    faults = check_commands(sys.argv[1]) + check_verbs() + check_example() + check_links()
    for fault in faults:
        print(fault)
    print(f"README.md: {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
