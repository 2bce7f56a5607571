"""DXF drawings: ezdxf reads the tags, and the library turns entities into shapes."""

from __future__ import annotations

import io
import logging
from collections.abc import Iterator
from typing import Any

import numpy as np

from . import _core
from ._errors import MedialError, need
from ._read import bytes_of
from ._records import in_utf8

Tags = list[tuple[int, Any]]
_MESH = 16 | 64  # flags of a POLYLINE
_SECTIONS = ("TABLES", "BLOCKS", "ENTITIES")
_STRUCTURE = ("ENDSEC", "TABLE", "ENDTAB", "LAYER", "BLOCK", "ENDBLK", "SEQEND", "VERTEX", "EOF")
_CURVES = ("POINT", "LINE", "CIRCLE", "ARC", "ELLIPSE", "LWPOLYLINE", "POLYLINE", "SPLINE", "INSERT")


def _lines(data: bytes, tag: Any) -> Iterator[Any]:
    """The tags of a text. Does not use ezdxf's loader, which guesses damaged group codes."""
    lines = iter(data.splitlines())
    for at, (code, value) in enumerate(zip(lines, lines, strict=False)):
        try:
            number = int(code)
        except ValueError:
            text = code.strip().decode("ascii", "replace")[:40]
            raise MedialError(f"line {2 * at + 1}: '{text}' is not a group code", "malformed") from None
        if number != 999:
            yield tag(number, value.strip())
        if number == 0 and value.strip() == b"EOF":
            return


def _kept(tags: Iterator[Any]) -> Iterator[Any]:
    """The names of all entities, and the tags of the supported ones."""
    name = section = ""
    for tag in tags:
        code, value = tag
        if code == 0 or (code == 2 and name == "SECTION"):
            text = value.decode("latin-1") if isinstance(value, bytes) else str(value)
            name, section = (name, text) if code else (text, "" if text == "SECTION" else section)
            yield tag
        elif (code in (9, 70) and name == "SECTION") or (section in _SECTIONS and name in (*_CURVES, *_STRUCTURE)):
            yield tag


def _groups(data: bytes) -> Iterator[tuple[str, Tags]]:
    """Each entity, and each section, with the tags that follow its name.

    Reads tags, not ezdxf's documents: if a drawing does not name its version, those lose tags of
    later versions.
    """
    faults: list[Any] = []
    types, recover = need("ezdxf.lldxf.types", "cad"), need("ezdxf.recover", "cad")
    logging.getLogger("ezdxf").addHandler(logging.NullHandler())
    if data.startswith(b"AutoCAD Binary DXF"):
        tagger = need("ezdxf.lldxf.tagger", "cad")
        tags = tagger.tag_compiler(_kept(tagger.binary_tags_loader(data)))
    else:
        in_order = need("ezdxf.lldxf.repair", "cad").tag_reorder_layer
        encoding = recover.detect_encoding(_lines(data, types.DXFTag))
        tags = recover.byte_tag_compiler(in_order(_kept(_lines(data, types.DXFTag))), encoding, messages=faults)
    name = ""
    group: Tags = []
    for code, value in tags:
        if faults and "floating" in str(faults[-1][1]):
            raise MedialError(str(faults[-1][1]).removeprefix("recovered ").split(" near ")[0], "malformed")
        if code == 0:
            yield name, group
            name, group = str(value), []
        else:
            group.append((code, value))
    if name != "EOF":
        raise MedialError("the drawing ends without an end mark", "malformed")


def _xy(point: Any) -> tuple[float, float]:
    return float(point[0]), float(point[1])


class _Filling:
    """Fills a drawing entity by entity."""

    def __init__(self) -> None:
        self.drawing = _core.Drawing()
        self.section = ""
        self.polyline: tuple[Tags, list[tuple[float, float, float]]] | None = None

    def add(self, name: str, tags: Tags) -> None:
        values = dict(tags)
        if name == "VERTEX":
            if self.polyline is not None:
                self.polyline[1].append((*_xy(values.get(10, (0, 0))), values.get(42, 0.0)))
            return
        self.end_polyline()
        if name == "SECTION":
            self.section = values.get(2, "") if tags else ""
            for (_, variable), (_, value) in zip(tags, tags[1:], strict=False):
                if variable == "$INSUNITS":
                    self.drawing.units = value
        elif name == "LAYER" and self.section == "TABLES":
            hidden = bool(values.get(70, 0) & 1) or values.get(62, 7) < 0
            self.drawing.layer(in_utf8(values.get(2, "")), hidden)
        elif name == "BLOCK" and self.section == "BLOCKS":
            self.drawing.begin_block(in_utf8(values.get(2, "")), _xy(values.get(10, (0, 0))))
        elif name == "ENDBLK":
            self.drawing.end_block()
        elif self.section in ("BLOCKS", "ENTITIES") and name not in _STRUCTURE:
            self.add_entity(name, tags, values)

    def add_entity(self, name: str, tags: Tags, values: dict[int, Any]) -> None:
        add = getattr(self, f"add_{name.lower()}", None) if name in _CURVES else None
        if add is None:
            if self.section == "ENTITIES":
                self.drawing.leave_out(in_utf8(name[:40]))
            return
        kind = "POLYLINE" if name == "LWPOLYLINE" else name
        normal = tuple(float(x) for x in values.get(210, (0, 0, 1)))
        if self.drawing.begin_entity(kind, in_utf8(values.get(8, "0")), normal) and not values.get(67, 0):
            add(tags, values)

    def add_point(self, _: Tags, values: dict[int, Any]) -> None:
        self.drawing.point(_xy(values[10]))

    def add_line(self, _: Tags, values: dict[int, Any]) -> None:
        self.drawing.line(_xy(values[10]), _xy(values[11]))

    def add_circle(self, _: Tags, values: dict[int, Any]) -> None:
        self.drawing.circle(_xy(values[10]), values[40])

    def add_arc(self, _: Tags, values: dict[int, Any]) -> None:
        self.drawing.arc(_xy(values[10]), values[40], values.get(50, 0.0), values.get(51, 0.0))

    def add_ellipse(self, _: Tags, values: dict[int, Any]) -> None:
        self.drawing.ellipse(_xy(values[10]), _xy(values[11]), values.get(40, 1.0),
                             values.get(41, 0.0), values.get(42, 2 * np.pi))  # fmt: skip

    def add_lwpolyline(self, tags: Tags, values: dict[int, Any]) -> None:
        rows: list[tuple[float, float, float]] = []
        for code, value in tags:
            if code == 10:
                rows.append((*_xy(value), 0.0))
            elif code == 42 and rows:
                rows[-1] = (*rows[-1][:2], value)
        self.draw(rows, bool(values.get(70, 0) & 1))

    def add_polyline(self, tags: Tags, values: dict[int, Any]) -> None:
        if values.get(70, 0) & _MESH:
            self.drawing.leave_out("polygon mesh")
        else:
            self.polyline = (tags, [])

    def end_polyline(self) -> None:
        if self.polyline is not None:
            (tags, rows), self.polyline = self.polyline, None
            self.draw(rows, bool(dict(tags).get(70, 0) & 1))

    def draw(self, rows: list[tuple[float, float, float]], closed: bool) -> None:
        table = np.array(rows, np.float64).reshape(-1, 3)
        self.drawing.polyline(np.ascontiguousarray(table[:, :2]), np.ascontiguousarray(table[:, 2]), closed)

    def add_spline(self, tags: Tags, values: dict[int, Any]) -> None:
        def numbers(wanted: int) -> Any:
            return np.array([value for code, value in tags if code == wanted], np.float64)

        points = np.array([_xy(value) for code, value in tags if code == 10], np.float64).reshape(-1, 2)
        weights = np.ones(len(points))
        given = numbers(41)[: len(points)]
        weights[: len(given)] = given
        self.drawing.spline(values.get(71, 3), numbers(40), points, weights, bool(values.get(70, 0) & 1))

    def add_insert(self, _: Tags, values: dict[int, Any]) -> None:
        self.drawing.copies(
            in_utf8(values[2]), _xy(values[10]), (values.get(41, 1.0), values.get(42, 1.0)), values.get(50, 0.0),
            (values.get(70, 1), values.get(71, 1)), (values.get(44, 0.0), values.get(45, 0.0)),
        )  # fmt: skip


def drawing_of(path: str) -> _core.Drawing:
    """The entities of a drawing, with its layers, blocks and unit."""
    structure_error = need("ezdxf", "cad").DXFError
    filling, name, data = _Filling(), "", bytes_of(path)
    try:
        for name, tags in _groups(data):
            filling.add(name, tags)
    except KeyError as error:
        raise MedialError(f"{path}: a {name} lacks group {error}", "malformed") from None
    except (structure_error, TypeError, ValueError, IndexError) as error:
        code = error.code if isinstance(error, MedialError) else "malformed"
        # ezdxf counts lines within the rest of the file only.
        text = error.text if isinstance(error, MedialError) else str(error).split(" near line")[0]
        raise MedialError(f"{path}: {text}", code) from None
    return filling.drawing
