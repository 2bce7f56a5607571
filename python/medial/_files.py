"""Files: the native format, and shapes of SVG, WKT, GeoJSON, fonts and plain text."""

from __future__ import annotations

import gzip
import os
import warnings
from os import PathLike, fspath
from pathlib import Path

from . import _core
from ._axis import MedialAxis, axis
from ._errors import MedialError
from ._options import options
from ._read import parsed
from ._shape import Shape


def _completed(cores: list[_core.Axis]) -> list[MedialAxis]:
    """Axes; of shapes without one it is computed."""
    found = [MedialAxis._of(core) for core in cores]
    return [a if len(a.nodes) or not len(a.shape.points) else axis(a.shape) for a in found]


def loads(text: str | bytes) -> list[MedialAxis]:
    """The axes of a native file's text.

    Parameters
    ----------
    text : str or bytes
        As `MedialAxis.to_text` makes it, or a file holds it; not compressed.

    Raises
    ------
    MedialError
        With the code ``"malformed"``, or ``"unsupported"`` for a newer version of the format.

    Examples
    --------
    >>> import medial
    >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
    >>> medial.loads(a.to_text())[0] == a
    True
    """
    return _completed(_core.native_of_text(text.encode() if isinstance(text, str) else text))


def load(path: str | PathLike[str]) -> list[MedialAxis]:
    """The axes of a native file, ``.json`` or ``.json.gz``: one for each of its shapes.

    Parameters
    ----------
    path : path

    Raises
    ------
    MedialError
        With the code ``"unreadable"``, ``"malformed"`` or ``"unsupported"``.

    Examples
    --------
    >>> import medial, tempfile, pathlib
    >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     a.save(pathlib.Path(folder, "a.json"))
    ...     medial.load(pathlib.Path(folder, "a.json"))[0] == a
    True
    """
    return _completed(_core.native_of_file(fspath(path)))


def _shapes(path: str, text: str, repair: str | None, arc_tolerance: float, fit: float) -> list[Shape]:
    try:
        shapes, notes = _core.shapes_of_file(path, text, repair, arc_tolerance, fit, options.threads)
    except MedialError as error:
        if "GDAL" not in error.text:
            raise
        other = "geopandas.read_file() reads the formats of GIS, the package ezdxf DXF"
        raise MedialError(f"{path}: not a format that medial.read() knows; {other}", "unsupported") from None
    for note in notes:
        warnings.warn(note, stacklevel=3)
    return [Shape._of(core) for core, _ in shapes]


def read(path: str | PathLike[str], *, repair: str | None = None, arc_tolerance: float = 1e-6,
         fit: float = 0) -> list[Shape]:  # fmt: skip
    """The shapes of a file: SVG, WKT, GeoJSON, plain `x y` text, or the native format.

    All are read with ``.gz`` as well. GeoPandas reads the formats of GIS, `ezdxf` DXF.

    Parameters
    ----------
    path : path
    repair : str, optional
        What is inside where rings cross: ``"make_valid"`` (as the input says), ``"even_odd"`` or
        ``"non_zero"``; without it crossing rings are an error.
    arc_tolerance : float
        How far arcs may be from free-form curves, as a share of the diagonal.
    fit : float
        Boundaries become smooth curves within this distance, in units of the file; 0: they stay.

    Returns
    -------
    list of Shape
        One for each feature, painted path or polygon, in their order.

    Raises
    ------
    MedialError
        With the code, and the feature, ring or vertex where it applies.

    Examples
    --------
    >>> import medial, tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "disk.svg")
    ...     _ = path.write_text('<svg width="9" height="9"><circle cx="4" cy="4" r="2"/></svg>')
    ...     [round(shape.area, 6) for shape in medial.read(path)]
    [12.566371]
    """
    name = fspath(path)
    if name.removesuffix(".gz").endswith(".geojson"):
        data = Path(name).read_bytes()
        document = parsed(gzip.decompress(data) if name.endswith(".gz") else data)
        parts = document.get("features", [document]) if isinstance(document, dict) else []
        return [Shape(part, repair=repair, arc_tolerance=arc_tolerance, fit=fit) for part in parts]
    return _shapes(name, "", repair, arc_tolerance, fit)


def text(text: str, font: str | PathLike[str], *, arc_tolerance: float = 1e-6) -> list[Shape]:
    """The outlines of a text in one line, with the advances and kerning of a font.

    Parameters
    ----------
    text : str
    font : path
        Of a scalable font: TrueType, OpenType or Type 1.
    arc_tolerance : float
        How far arcs may be from the font's curves, as a share of the diagonal.

    Returns
    -------
    list of Shape
        One for each character with an outline, in units of the font, the baseline at y = 0.
        ``medial.Shape(medial.text(...))`` is all of them as one.

    Raises
    ------
    MedialError
        With the code ``"unreadable"`` or ``"malformed"``, and ``"empty"`` without an outline.

    Examples
    --------
    >>> import matplotlib, medial, pathlib
    >>> font = pathlib.Path(matplotlib.get_data_path(), "fonts/ttf/DejaVuSans.ttf")
    >>> [int(shape.hole.sum()) for shape in medial.text("Rg8", font)]
    [1, 1, 2]
    """
    return _shapes(fspath(font), text, None, arc_tolerance, 0)


def write_compressed(path: str, text: str) -> None:
    """A text as a file compressed by gzip; there is never a partial one."""
    target = Path(path)
    partial = target.with_name(f".{target.name}.{os.getpid()}.tmp")
    try:
        partial.write_bytes(gzip.compress(text.encode(), mtime=0))
        partial.replace(target)
    finally:
        partial.unlink(missing_ok=True)
