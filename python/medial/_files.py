"""Files: the native format, and shapes from SVG, DXF, WKT, GeoJSON, fonts and plain text."""

from __future__ import annotations

import gzip
import json
import os
import warnings
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._axis import MedialAxis, axis
from ._errors import MedialError
from ._options import options
from ._read import bytes_of, parsed
from ._shape import Shape


def _completed(items: list[tuple[_core.Axis, list[tuple[str, str]]]]) -> list[MedialAxis]:
    """The axes of a file; computes missing ones."""
    found = [MedialAxis._of(core, dict(attributes)) for core, attributes in items]
    return [a if len(a.nodes) or not len(a.shape.points) else axis(a.shape) for a in found]


def loads(text: str | bytes) -> list[MedialAxis]:
    """The axes in the text of a native file.

    Parameters
    ----------
    text : str or bytes
        From `MedialAxis.to_text`, or the contents of a file; not compressed.

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
    return _completed(_core.native_of_text(text.encode("utf-8", "replace") if isinstance(text, str) else text))


def load(path: str | PathLike[str]) -> list[MedialAxis]:
    """The axes of a native file, ``.json`` or ``.safetensors``, one per shape.

    The `Shape.attributes` of their shapes are texts.

    Reads compressed files (``.gz``), too. `columns` maps a ``.safetensors`` file into memory instead.

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
    return _completed(_core.native_of_file(os.fsencode(path)))


def columns(path: str | PathLike[str]) -> dict[str, npt.NDArray[Any]]:
    """The columns of a ``.safetensors`` file, mapped into memory: bytes are read when they are used.

    The C++ documentation describes them (columns.md). Checksums are not verified; `medial.load`
    verifies them, as it reads all bytes.

    Parameters
    ----------
    path : path

    Returns
    -------
    dict of str to numpy.ndarray
        Read-only arrays by the name of the column.

    Raises
    ------
    MedialError
        With the code ``"unreadable"`` or ``"malformed"``.

    Examples
    --------
    >>> import medial, tempfile, pathlib
    >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     a.save(pathlib.Path(folder, "a.safetensors"))
    ...     medial.columns(pathlib.Path(folder, "a.safetensors"))["node_disk"].shape
    (6, 3)
    """
    types = {"F64": "<f8", "U64": "<u8", "U32": "<u4", "U8": "u1"}
    name = os.fsdecode(path)
    try:
        file = np.memmap(name, np.uint8, "r")
        end = 8 + int(file[:8].view("<u8")[0])
        header = json.loads(bytes(file[8:end]))
        header.pop("__metadata__", None)
        found = {}
        for key, column in header.items():
            first, last = column["data_offsets"]
            numbers = file[end + first : end + last].view(np.dtype(types[column["dtype"]]))
            found[key] = numbers.reshape(column["shape"]).view(np.ndarray)
        return found
    except OSError as error:
        raise MedialError(f"{name}: {error.strerror or error}", "unreadable") from None
    except (ValueError, KeyError, TypeError, IndexError, AttributeError):
        raise MedialError(f"{name}: not a valid safetensors file", "malformed") from None


def _taken(found: tuple[list[Any], list[str]]) -> list[Shape]:
    """Shapes with their attributes; issues notes as warnings."""
    shapes, notes = found
    for note in notes:
        warnings.warn(note, stacklevel=4)
    return [Shape._of(core, dict(attributes)) for core, attributes in shapes]


def _in_python(text: str) -> str:
    """An error text with the options of the command line replaced by the options of Python."""
    text = text.replace("; --units gives it one", ": leave out `unit`, and scale the shapes")
    return text.replace("--close=GAP", "close=GAP").replace("--close ", "close=math.inf ")


def _of_file(path: str, text: str, reading: _core.Reading) -> list[Shape]:
    try:
        return _taken(_core.shapes_of_file(os.fsencode(path), text, reading))
    except MedialError as error:
        error.text = _in_python(error.text)
        if "GDAL" not in error.text:
            raise
        other = "geopandas.read_file() reads the formats of GIS"
        raise MedialError(f"{path}: not a format that medial.read() knows; {other}", "unsupported") from None


def _of_drawing(path: str, reading: _core.Reading) -> list[Shape]:
    from ._drawing import drawing_of

    try:
        return _taken(_core.shapes_of_drawing(drawing_of(path), reading))
    except MedialError as error:
        error.text = _in_python(error.text)
        raise


def _of_geojson(path: str, repair: str | None, arc_tolerance: float, fit: float) -> list[Shape]:
    document = parsed(bytes_of(path))
    shapes, empty = [], 0
    parts = document.get("features", [document]) if isinstance(document, dict) else None
    if not isinstance(parts, list):
        raise MedialError(f"{path}: this is not GeoJSON", "malformed")
    for i, part in enumerate(parts):
        if isinstance(part, dict) and part.get("type") == "Feature" and part.get("geometry", 0) is None:
            empty += 1
            continue
        try:
            shape = Shape(part, repair=repair, arc_tolerance=arc_tolerance, fit=fit)
        except MedialError as error:
            text = f"{path}: {error.text}"
            raise MedialError(text, error.code, i, error.ring, error.vertex, error.point) from None
        properties = part.get("properties")
        shape.attributes = dict(properties) if isinstance(properties, dict) else {}
        shapes.append(shape)
    if empty:
        features = "1 feature has" if empty == 1 else f"{empty} features have"
        warnings.warn(f"{features} no geometry and {'was' if empty == 1 else 'were'} left out", stacklevel=3)
    return shapes


def read(path: str | PathLike[str], *, repair: str | None = None, arc_tolerance: float = 1e-6,
         fit: float = 0, layer: str | None = None, close: float | None = None,
         unit: str | None = None) -> list[Shape]:  # fmt: skip
    """The shapes of a file: SVG, DXF, WKT, GeoJSON, plain `x y` text, or the native format.

    Reads compressed files (``.gz``), too. DXF needs the package `ezdxf`. For GIS formats, use
    GeoPandas.

    Parameters
    ----------
    path : path
    repair : str, optional
        The rule that decides what is inside where rings cross: ``"make_valid"`` (that of the
        input), ``"even_odd"`` or ``"non_zero"``. Without it, crossing rings are an error.
    arc_tolerance : float
        The largest distance of arcs from free-form curves, as a share of the diagonal.
    fit : float
        Replaces boundaries by smooth curves within this distance, in the unit of the result; 0
        keeps them.
    layer : str, optional
        DXF only: read this layer alone, even if it is hidden.
    close : float, optional
        DXF only: join loose curves whose ends are at most this far apart, by default 1e-6 times
        the diagonal of their layer; ``math.inf`` closes every open chain.
    unit : str, optional
        Convert lengths to ``"mm"``, ``"cm"``, ``"m"``, ``"in"`` ...; by default they stay in the
        unit of the file.

    Returns
    -------
    list of Shape
        One per feature, painted path, polygon, or layer of a drawing, in the order of the file,
        with `Shape.attributes`. Warnings say what was left out or repaired.

    Raises
    ------
    MedialError
        With a code and, where they apply, the feature, ring and vertex.

    Examples
    --------
    >>> import medial, tempfile, pathlib
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder, "disk.svg")
    ...     _ = path.write_text('<svg width="9" height="9"><circle cx="4" cy="4" r="2"/></svg>')
    ...     [round(shape.area, 6) for shape in medial.read(path)]
    [12.566371]
    """
    name = os.fsdecode(path)
    kind = name.lower().removesuffix(".gz")
    if kind.endswith(".geojson"):
        if layer or close is not None or unit:
            raise MedialError("layer, close and unit do not apply to GeoJSON")
        return _of_geojson(name, repair, arc_tolerance, fit)
    reading = _core.reading(repair, arc_tolerance, fit, layer or "", close, unit or "", options.threads)
    return _of_drawing(name, reading) if kind.endswith(".dxf") else _of_file(name, "", reading)


def text(text: str, font: str | PathLike[str], *, arc_tolerance: float | None = None) -> list[Shape]:
    """The outlines of one line of text, with the advances and kerning of a font.

    Parameters
    ----------
    text : str
    font : path
        A scalable font: TrueType, OpenType or Type 1.
    arc_tolerance : float, optional
        The largest distance of arcs from the font's curves, as a share of the diagonal. By default
        a 64th of a font unit.

    Returns
    -------
    list of Shape
        One per character with an outline, in font units, with the baseline at y = 0.
        ``medial.Shape(medial.text(...))`` joins them.

    Raises
    ------
    MedialError
        With the code ``"unreadable"``, ``"malformed"``, or ``"empty"`` if nothing has an outline.

    Examples
    --------
    >>> import matplotlib, medial, pathlib
    >>> font = pathlib.Path(matplotlib.get_data_path(), "fonts/ttf/DejaVuSans.ttf")
    >>> [int(shape.hole.sum()) for shape in medial.text("Rg8", font)]
    [1, 1, 2]
    """
    reading = _core.reading(None, arc_tolerance, 0, "", None, "", options.threads)
    return _of_file(os.fsdecode(font), text, reading)


def write_compressed(path: str, text: str) -> None:
    """Writes a text compressed by gzip, and never leaves a partial file."""
    target = Path(os.path.realpath(path))  # a link stays
    partial = target.with_name(f".{target.name}.{os.getpid()}.tmp")
    try:
        try:
            partial.write_bytes(gzip.compress(text.encode(), mtime=0))
            partial.replace(target)
        finally:
            partial.unlink(missing_ok=True)
    except OSError as error:
        raise MedialError(f"{path}: cannot write: {error.strerror or error}", "unwritable") from None
