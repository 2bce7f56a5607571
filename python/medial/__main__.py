"""`python -m medial`: the command line, where it is installed."""

from __future__ import annotations

import os
import shutil
import sys


def main() -> int:
    """Becomes the program `medial`."""
    program = os.environ.get("MEDIAL_PROGRAM") or shutil.which("medial")
    if program is None:
        print(
            "medial: the command line is not installed; build it with `make install`, or set MEDIAL_PROGRAM",
            file=sys.stderr,
        )
        return 2
    os.execv(program, [program, *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
