#!/usr/bin/env python3
"""Checks that prose uses the words of docs/words.md, and none that reads as translated.

    tools/check_words.py [PATH...]

Reads whole documents, and only the comments and strings of sources. Without paths, reads every file that git
tracks. Prints one line per fault, with what to write instead.
"""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent

INSTEAD = {
    "tells": "says, states, lists, decides, prints",
    "told": "given, said, stated, printed; without a verb: 'from', 'by'",
    "anew": "again",
    "hang(?:s|ing)? on": "depends on",
    "switch(?:es)?": "option, flag; for a change: 'changes to'",
    "verbs?": "command; of make: target",
    "soups?": "planar graph",
    "one cycle a hole": "one cycle per hole",
    "untrue of": "not true for",
    "commands no terminal": "without escape sequences",
    "looked at:": "say what follows from it",
    "one word too many": "an unexpected word",
    "of which one": "one of which",
    "begun again": "restarted",
    "what of (?:the|a|an|it|its)": "the part of",
    "where two copies at once reach": "two independent processes reach",
    "but for rounding": "up to rounding",
    "put off": "deferred",
    "looked for": "searched for, tested",
    "so many (?:at most|of them|points on|disks|pixels)": "at most N; this many",
    "for each so long": "per N of length",
    "how far (?:chords|arcs) may be": "the largest distance of",
    "(?:that )?know nothing of each other": "independent",
    "takes the last edit back": "undoes",
    "there is never a partial": "never leaves a partial",
    "no machine holds": "too large for any machine",
    "turned round": "flipped, reversed",
    "one to a line": "one per line",
}

DOCUMENTS = {".md", ".1", ".txt"}
C_LIKE = {".h", ".cpp", ".in", ".mjs", ".ts"}
SCRIPTS = {".py", ".sh", ".cmake"}

C_PROSE = re.compile(
    r"""(?P<prose>//[^\n]*|/\*.*?\*/|R"(?P<d>\w*)\(.*?\)(?P=d)"|"(?:\\.|[^"\\\n])*")|'(?:\\.|[^'\\\n])+'""",
    re.DOTALL)
SCRIPT_PROSE = re.compile(
    r"""(?P<prose>\"\"\".*?\"\"\"|\#[^\n]*|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*')""", re.DOTALL)


def pattern(phrase):
    """Words may be parted by line ends, comment leaders and the seams of string literals."""
    return re.compile(r"(?<![\w.-])" + phrase.replace(" ", r"[\s/*\"#>]+") + r"(?![\w-])", re.IGNORECASE)


PATTERNS = [(pattern(phrase), instead) for phrase, instead in INSTEAD.items()]


def prose_of(path):
    """The text of a file with everything but its prose blanked, line ends kept."""
    text = path.read_text(errors="replace")
    if path.suffix in DOCUMENTS:
        return text
    kind = C_PROSE if path.suffix in C_LIKE else SCRIPT_PROSE
    kept, at = [], 0
    for match in kind.finditer(text):
        if match["prose"] is None:
            continue
        kept.append(re.sub(r"[^\n]", " ", text[at:match.start()]))
        kept.append(match["prose"])
        at = match.end()
    return "".join(kept)


def faults_in(path):
    text = prose_of(path)
    for expression, instead in PATTERNS:
        for match in expression.finditer(text):
            line = text.count("\n", 0, match.start()) + 1
            found = " ".join(re.split(r"[\s/*\"#>]+", match[0]))
            yield line, f"{path.relative_to(ROOT)}:{line}: '{found}': write {instead}"


def checked(path):
    scripted = path.suffix in SCRIPTS or path.name in ("Makefile", "CMakeLists.txt")
    return path.is_file() and path != pathlib.Path(__file__).resolve() and (
        scripted or path.suffix in DOCUMENTS | C_LIKE)


def main():
    tracked = subprocess.run(["git", "ls-files", "-z", *sys.argv[1:]], cwd=ROOT, check=True,
                             capture_output=True, text=True).stdout.split("\0")
    faults = [fault for name in tracked if name and checked(ROOT / name)
              for _, fault in sorted(faults_in(ROOT / name))]
    print("\n".join(faults + [f"words: {len(faults)} faults"]))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
