"""The native format: shapes and axes as JSON, without loss. docs/format.md describes it."""

from __future__ import annotations

import gzip
import json
import os
from pathlib import Path
from typing import Any

import numpy as np

from . import _core
from ._axis import MedialAxis, restored
from ._errors import MedialError
from ._records import EDGE, NODE, SITE, Records
from ._shape import Shape


def _number(x: float) -> str:
    text = repr(float(x))
    return text[:-2] if text.endswith(".0") else text


def _row(values: Any) -> str:
    return "[" + ",".join(_number(x) for x in values) + "]"


def _shape_text(shape: Shape) -> str:
    sources = shape._core.sources().view(np.uint32).reshape(-1, 2)
    parts = ['"points":[' + ",".join(map(_row, shape.points.tolist())) + "]"]
    if len(shape.bulges):
        parts.append('"bulges":' + _row(shape.bulges.tolist()))
    parts.append('"sources":[' + ",".join(map(_row, sources.tolist())) + "]")
    for name in ("loop_begin", "component"):
        parts.append(f'"{name}":' + _row(getattr(shape, name).tolist()))
    parts.append('"hole":' + json.dumps(shape.hole.tolist(), separators=(",", ":")))
    return "{" + ",".join(parts) + "}"


def _axis_text(axis: MedialAxis) -> str:
    sites = [[kind, *start, *end, ring, vertex, *([bulge] if kind == 2 else [])]
             for start, end, ring, vertex, kind, bulge in axis.sites.tolist()]  # fmt: skip
    edges = [[*node, *site, *control, weight] for node, site, control, weight in axis.edges.tolist()]
    head = {"method": axis.method}
    parts = [json.dumps(head)[1:-1]]
    for name in ("tolerance", "resolution", "exterior"):
        value = getattr(axis, name)
        if value or name != "exterior":
            parts.append(f'"{name}":{_number(value)}')
    for name, rows in (("sites", sites), ("nodes", axis.nodes.tolist()), ("edges", edges)):
        parts.append(f'"{name}":[' + ",".join(map(_row, rows)) + "]")
    return "{" + ",".join(parts) + ',"statistics":{}}'


def dumps(axis: MedialAxis) -> str:
    """The text of a native file with one shape and its axis."""
    shape = axis.shape
    version = 2 if len(shape.bulges) or (axis.sites["kind"] == 2).any() else 1
    item = '{"attributes":[],"shape":' + _shape_text(shape) + ',"axis":' + _axis_text(axis) + "}"
    return f'{{"medial":{version},"items":[{item}]}}\n'


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


def _shape_from(item: dict[str, Any]) -> Shape:
    points = np.array(item["points"], np.float64).reshape(-1, 2)
    state = (
        points,
        np.array(item.get("bulges", []), np.float64),
        np.array(item["sources"], np.uint32).reshape(-1),
        np.array(item["loop_begin"], np.uint32),
        np.array(item["component"], np.uint32),
        np.array(item["hole"], np.uint8),
    )
    return Shape._of(_core.restored_shape(*state))


def _sites_from(rows: list[list[Any]], shape: Shape) -> Records:
    sites = np.zeros(len(rows), SITE)
    begin = shape.loop_begin.astype(np.int64)
    bulges = shape.bulges
    sources = shape._core.sources().view(np.uint32).reshape(-1, 2)
    after = np.arange(1, len(shape.points) + 1)
    after[begin[1:] - 1] = begin[:-1]
    for site, row in zip(sites, rows, strict=True):
        kind = site["kind"] = int(row[0])
        if len(row) == 2:
            at = int(row[1])
            site["start"] = shape.points[at]
            site["end"] = shape.points[at if kind == 1 else after[at]]
            site["ring"], site["vertex"] = sources[at]
            site["bulge"] = bulges[at] if kind == 2 else 0
        else:
            site["start"], site["end"] = row[1:3], row[3:5]
            site["ring"], site["vertex"] = row[5:7]
            site["bulge"] = row[7] if kind == 2 else 0
    return sites


def _axis_from(item: dict[str, Any]) -> MedialAxis:
    shape, axis = _shape_from(item["shape"]), item["axis"]
    nodes = np.zeros(len(axis["nodes"]), NODE)
    for name, column in zip(NODE.names or (), np.array(axis["nodes"]).reshape(-1, 5).T, strict=True):
        nodes[name] = column
    edges = np.zeros(len(axis["edges"]), EDGE)
    edges["weight"] = 1
    if len(edges):
        indices = np.array([row[:4] for row in axis["edges"]], np.uint32)
        edges["node"], edges["site"] = indices[:, :2], indices[:, 2:]
        disks = np.stack([nodes["x"], nodes["y"], nodes["radius"]], axis=1)
        a, b = disks[indices[:, 0]], disks[indices[:, 1]]
        edges["control"] = a + 0.5 * (b - a)
    for edge, row in zip(edges, axis["edges"], strict=True):
        if len(row) > 4:
            edge["control"] = row[4:7]
        if len(row) > 7:
            edge["weight"] = row[7]
    return restored(shape, axis["method"], axis["tolerance"], axis.get("resolution", 0.0),
                    axis.get("exterior", 0.0), _sites_from(axis["sites"], shape), nodes, edges)  # fmt: skip


def loads(text: str | bytes) -> list[MedialAxis]:
    """The axes of a native file's text."""
    try:
        document = json.loads(text)
        if next(iter(document)) != "medial":
            raise MedialError("this is not one of medial's own JSON files", "malformed")
        if document["medial"] > 2:
            raise MedialError(f"version {document['medial']} of the format is newer", "unsupported")
        return [_axis_from(item) for item in document["items"]]
    except (KeyError, TypeError, IndexError, StopIteration, AttributeError, OverflowError) as error:
        raise MedialError("the file is not what its format says", "malformed") from error
    except ValueError as error:
        if isinstance(error, MedialError):
            raise
        raise MedialError("the file is not what its format says", "malformed") from error


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
