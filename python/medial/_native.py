"""The native format: shapes and axes as JSON, without loss. docs/format.md describes it."""

from __future__ import annotations

import gzip
import os
from pathlib import Path

from . import _core
from ._axis import MedialAxis


def dumps(axis: MedialAxis) -> str:
    """The text of a native file with one shape and its axis."""
    return _core.dumps(axis._core)


def save(axis: MedialAxis, path: str | Path) -> None:
    """Writes a native file; of a name that ends in .gz compressed. There is never a partial one."""
    target = Path(path)
    data = dumps(axis).encode()
    if target.suffix == ".gz":
        data = gzip.compress(data, mtime=0)
    partial = target.with_name(f".{target.name}.{os.getpid()}.tmp")
    try:
        partial.write_bytes(data)
        partial.replace(target)
    finally:
        partial.unlink(missing_ok=True)


def loads(text: str | bytes) -> list[MedialAxis]:
    """The axes of a native file's text."""
    data = text.encode() if isinstance(text, str) else text
    return [MedialAxis._of(core) for core in _core.loads(data)]


def load(path: str | Path) -> list[MedialAxis]:
    """The axes of a native file, one for each of its shapes.

    Examples
    --------
    >>> import medial, tempfile, pathlib
    >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     a.save(pathlib.Path(folder, "a.json"))
    ...     medial.load(pathlib.Path(folder, "a.json"))[0] == a
    True
    """
    data = Path(path).read_bytes()
    return loads(gzip.decompress(data) if data[:2] == b"\x1f\x8b" else data)
