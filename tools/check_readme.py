#!/usr/bin/env python3
"""Checks the statements of the documents.

    tools/check_readme.py PROGRAM

Runs the `medial` commands of every page's sh blocks, and of the manual's examples, page by page in order, in a
scratch folder with data/. Checks that links, citations, paths and `make` targets exist, and the functions and
options that ARCHITECTURE.md and the pages in docs name; compares the manual with `--help-all`, and README.md's
C++ with the example that the install test builds; counts the words of the pages in docs.
"""

import concurrent.futures
import itertools
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/*.md"), *ROOT.glob("data/*.md"), *ROOT.glob("bench/**/*.md"),
                *ROOT.glob("papers/**/*.md")])
MANUAL = ROOT / "docs" / "medial.1"
MOST_WORDS = 1600  # of a page in docs


def blocks(page, language):
    return re.findall(rf"^```{language}\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)


def commands_of(page):
    """The lines of a page that call medial or write a small input; those that end in a backslash are joined."""
    if page == MANUAL:
        text = re.search(r"^\.SH EXAMPLES\n\.nf\n(.*?)^\.fi$", page.read_text(), re.MULTILINE | re.DOTALL)[1]
        text = text.replace(r"\-", "-").replace(r"\(dq", '"')
    else:
        text = "\n".join(blocks(page, "sh"))
    lines = text.replace("\\\n", " ").splitlines()
    return [line for line in lines if re.search(r"^(echo|printf) |(^|[|&] *)medial ", line)]


def faults_of_commands(page, program):
    """Runs a page's commands one after the other."""
    faults = []
    with tempfile.TemporaryDirectory() as scratch:
        os.symlink(ROOT / "data", pathlib.Path(scratch) / "data")
        os.mkdir(pathlib.Path(scratch) / "out")
        os.symlink(pathlib.Path(program).resolve(), pathlib.Path(scratch) / "medial")
        environment = dict(os.environ, PATH=scratch + os.pathsep + os.environ["PATH"])
        for command in commands_of(page):
            # Every part of a pipe must succeed, except one that `head` cuts short.
            pipe = "" if "| head" in command else "set -o pipefail; "
            done = subprocess.run(["bash", "-c", pipe + command], cwd=scratch, env=environment, text=True,
                                  capture_output=True, check=False)
            if done.returncode != 0:
                faults.append(f"{command}\n  exit status {done.returncode}: {done.stderr.strip()}")
            for output in re.findall(r" -o ([^\s-]\S*)", command):
                if not (pathlib.Path(scratch) / output).is_file():
                    faults.append(f"{command}\n  wrote no {output}")
            if command.rstrip().endswith("-o -") and not done.stdout.strip():
                faults.append(f"{command}\n  printed nothing")
    return faults


def faults_of_links(page):
    targets = re.findall(r"\]\(([^)#:\s]+)(?:#[^)]*)?\)", page.read_text())
    return [f"{target}: no such file" for target in targets if not (page.parent / target).exists()]


def faults_of_targets(page):
    known = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
    named = set(re.findall(r"^make ([a-z-]+)", "\n".join(blocks(page, "sh")), re.MULTILINE))
    named |= set(re.findall(r"`make ([a-z-]+)", page.read_text()))
    return [f"make {target}: no such target" for target in sorted(named - known)]


def faults_of_citations(page):
    known = set(re.findall(r"^@\w+\{(\w+)", (ROOT / "docs" / "references.bib").read_text(), re.MULTILINE))
    cited = set(re.findall(r"\b[a-z]+(?:19|20)\d\d\b", " ".join(re.findall(r"\[([^\]]*)\]", page.read_text()))))
    return [f"[{key}]: not in references.bib" for key in sorted(cited - known)]


def identifiers():
    """Every name in the sources."""
    folders = ("include", "src", "cli", "faces", "papers", "tests", "python/medial", "python/src", "js/lib", "js/src",
               "web/src")
    sources = [path for folder in folders for path in (ROOT / folder).rglob("*")
               if path.suffix in (".h", ".cpp", ".py", ".mjs")]
    return set(re.findall(r"\w+", " ".join(path.read_text(errors="replace") for path in sources)))


def faults_of_names(page, names, options):
    """Functions and options in backquotes that do not exist (any more)."""
    quoted = re.findall(r"`([^`\n]+)`", re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.MULTILINE | re.DOTALL))
    functions = {match[1] for text in quoted for match in [re.fullmatch(r"(?:\w+::)*(\w+)\(\)", text)] if match}
    named = {match[0] for text in quoted for match in [re.match(r"--[a-z][a-z-]*[a-z]", text)] if match}
    return ([f"`{name}()`: no such function" for name in sorted(functions - names)] +
            [f"`{option}`: no command has it" for option in sorted(named - options)])


def faults_of_length(page):
    words = sum(any(map(str.isalpha, word)) for word in page.read_text().split())
    return [f"{words} words, {MOST_WORDS} at most"] if page.parent.name == "docs" and words > MOST_WORDS else []


def expanded(path):
    """Expands braces in paths: a/{b,c}.h is a/b.h and a/c.h."""
    parts = [re.split(",", part[1:-1]) if part.startswith("{") else [part]
             for part in re.findall(r"\{[^}]*\}|[^{}]+", path)]
    return ["".join(choice) for choice in itertools.product(*parts)]


def faults_of_paths(page):
    """Paths in backquotes, from the root of the repository; NAME in capitals stands for any name."""
    text = page.read_text()
    named = re.findall(r"`((?:src|include|cli|tests|tools|bench|papers|docs|data|examples|cmake)/[^`\s]*)`", text)
    named += ["include/" + name for name in re.findall(r"`(medial/[^`\s]*\.h)`", text)]
    return [f"{path}: no such file" for name in named for path in expanded(name)
            if not any(ROOT.glob(re.sub(r"[A-Z]{3,}", "*", path.rstrip("/"))))]


def faults_of_layers(page):
    """Compares the table of layers with that of tools/check_layers.py."""
    layers = re.findall(r'^    "(\w+)": \[', (ROOT / "tools" / "check_layers.py").read_text(), re.MULTILINE)
    listed = re.findall(r"^\| `(\w+)` \|", page.read_text().split("## Layers")[1], re.MULTILINE)
    return [] if listed == [layer for layer in layers if layer != "all"] else ["the layers are not those of check_layers.py"]


def faults_of_example(page):
    example = (ROOT / "examples" / "consumer" / "main.cpp").read_text()
    return [] if blocks(page, "cpp") == [example] else ["the C++ is not that of examples/consumer/main.cpp"]


def help_of(program, *command):
    return subprocess.run([program, *command, "--help-all" if command else "--help"], capture_output=True, text=True, check=True).stdout


def commands_and_options(program):
    listed = re.findall(r"^  ([a-z]+) {3,}", help_of(program), re.MULTILINE)
    help_texts = [help_of(program)] + [help_of(program, command) for command in listed]
    return listed, set(re.findall(r"(?<![^\s,])(--[a-z][a-z-]*[a-z])", "\n".join(help_texts)))


def faults_of_manual(listed, known):
    """Commands and options that either the manual or the help lacks."""
    manual = MANUAL.read_text().replace(r"\-", "-")
    named = set(re.findall(r"--[a-z][a-z-]*[a-z]", manual))
    return ([f"the command {command} is missing" for command in listed
             if not re.search(rf"^\.B {command}$", manual, re.MULTILINE)] +
            [f"{option}: no command has it" for option in sorted(named - known)] +
            [f"{option} is missing" for option in sorted(known - named)])


def faults_of(page, program, names, listed, options):
    if page == MANUAL:
        return faults_of_commands(page, program) + faults_of_manual(listed, options)
    checks = [faults_of_links, faults_of_targets, faults_of_citations, faults_of_length, faults_of_paths]
    if page == ROOT / "ARCHITECTURE.md":
        checks.append(faults_of_layers)
    if page == ROOT / "README.md":
        checks.append(faults_of_example)
    faults = faults_of_commands(page, program) + [fault for check in checks for fault in check(page)]
    named = page.parent.name == "docs" or page == ROOT / "ARCHITECTURE.md"
    return faults + (faults_of_names(page, names, options) if named else [])


def main():
    pages, program = [*PAGES, MANUAL], sys.argv[1]
    known = (identifiers(), *commands_and_options(program))
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = list(pool.map(lambda page: faults_of(page, program, *known), pages))
    for page, faults in zip(pages, found):
        for fault in faults:
            print(f"{page.relative_to(ROOT)}: {fault}")
    count = sum(map(len, found))
    print(f"{len(pages)} pages, {sum(len(commands_of(page)) for page in pages)} commands, {count} faults")
    return 1 if count or not commands_of(ROOT / "README.md") else 0


if __name__ == "__main__":
    sys.exit(main())
