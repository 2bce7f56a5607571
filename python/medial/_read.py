"""Reads anything with polygons as rings of coordinates, or contours."""

from __future__ import annotations

import gzip
import re
import zlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._contour import Contour
from ._errors import MedialError
from ._records import Floats, Indices, numbers_of

ANY, OUTER, HOLE, WINDING = range(4)


@dataclass
class Rings:
    """Rings of one feature: ring i has the coordinates from begin[i] to begin[i + 1]."""

    coordinates: Floats | None = None
    begin: Indices | None = None
    roles: npt.NDArray[np.uint8] | None = None
    bulges: Floats | None = None
    contours: list[_core.Contour] = field(default_factory=list)


@dataclass
class Ragged:
    """Polygons of many features, with offsets as in shapely.to_ragged_array()."""

    coordinates: Floats
    ring: Indices
    polygon: Indices
    feature: Indices | None = None
    failed: list[Any] = field(default_factory=list)
    bulges: Floats | None = None
    attributes: dict[int, Mapping[str, Any]] = field(default_factory=dict)  # where a feature has some

    def __len__(self) -> int:
        return len(self.polygon if self.feature is None else self.feature) - 1

    def errors(self, computed: list[Any]) -> dict[int, MedialError]:
        """Errors by feature, of reading and of the computation."""
        return {row[2]: MedialError(*row) for row in (*computed, *self.failed)}

    def one(self, i: int) -> Rings:
        """The rings of one feature, which could be read."""
        first, last = (i, i + 1) if self.feature is None else self.feature[i : i + 2]
        polygons = self.polygon[first : last + 1]
        begin = self.ring[polygons[0] : polygons[-1] + 1] if len(polygons) else self.ring[:0]
        if len(begin) == 0:
            return Rings(np.empty((0, 2)), np.zeros(1, np.int64))
        roles = np.full(len(begin) - 1, HOLE, np.uint8)
        roles[polygons[:-1] - polygons[0]] = OUTER
        part = slice(begin[0], begin[-1])
        bulges = None if self.bulges is None else self.bulges[part]
        return Rings(self.coordinates[part], begin - begin[0], roles, bulges)


def rows(points: Any) -> Floats:
    """Coordinates as rows of x and y; more columns are dropped."""
    array = numbers_of(points, "coordinates must be rows of x and y")
    if array.ndim != 2 or (array.shape[1] < 2 and array.size):
        raise MedialError("coordinates must be rows of x and y", "malformed")
    return np.ascontiguousarray(array[:, :2])


def _from_lists(rings: Sequence[Any], roles: Sequence[int] | None) -> Rings:
    parts = [rows(ring) for ring in rings]
    begin = np.zeros(len(parts) + 1, np.int64)
    np.cumsum([len(part) for part in parts], out=begin[1:])
    coordinates = np.concatenate(parts) if parts else np.empty((0, 2))
    return Rings(coordinates, begin, None if roles is None else np.asarray(roles, np.uint8))


def _part(geometry: Mapping[str, Any], name: str, of: type | tuple[type, ...]) -> Any:
    """A member of GeoJSON, of the right type."""
    value = geometry.get(name)
    if not isinstance(value, of):
        raise MedialError(f"the {geometry.get('type')} has no {name}", "malformed")
    return value


def _polygons_of(geometry: Any) -> Iterator[Sequence[Any]]:
    """The polygons, as lists of rings, of a geometry, feature or collection of GeoJSON."""
    if not isinstance(geometry, Mapping):
        raise MedialError(f"a {type(geometry).__name__} is not a GeoJSON geometry", "malformed")
    kind = geometry.get("type")
    lists = (Sequence, np.ndarray)
    if kind == "Feature":
        yield from _polygons_of(_part(geometry, "geometry", Mapping))
    elif kind == "FeatureCollection":
        for feature in _part(geometry, "features", lists):
            yield from _polygons_of(feature)
    elif kind == "GeometryCollection":
        for part in _part(geometry, "geometries", lists):
            yield from _polygons_of(part)
    elif kind == "Polygon":
        yield _part(geometry, "coordinates", lists)
    elif kind == "MultiPolygon":
        yield from _part(geometry, "coordinates", lists)
    else:
        raise MedialError(f"the geometry is a {kind}, not a polygon", "unsupported")


def _interface_of(x: Any) -> Any:
    """The ``__geo_interface__`` of an object, or None."""
    if isinstance(x, type):
        return None
    try:
        return getattr(x, "__geo_interface__", None)
    except Exception as error:  # of any kind: the code is the object's
        text = f"the __geo_interface__ of a {type(x).__name__} fails: {error}"
        raise MedialError(text, "malformed") from error


def _from_polygons(polygons: Sequence[Sequence[Any]]) -> Rings:
    roles = [HOLE if i else OUTER for polygon in polygons for i in range(len(polygon))]
    return _from_lists([ring for polygon in polygons for ring in polygon], roles)


def from_wkb(values: Sequence[bytes | None] | npt.NDArray[Any]) -> Ragged:
    """The polygons of well-known binary, one feature per value; None is an error of its feature."""
    missing = [i for i, value in enumerate(values) if value is None]
    present: Sequence[bytes] | npt.NDArray[Any] = [value or b"" for value in values] if missing else values  # type: ignore[assignment]
    sizes = np.fromiter((len(value) for value in present), np.int64, len(values))
    offsets = np.zeros(len(values) + 1, np.int64)
    np.cumsum(sizes, out=offsets[1:])
    return from_wkb_buffer(np.frombuffer(b"".join(present), np.uint8), offsets, missing)


def _from_one_wkb(value: bytes) -> Rings:
    feature = from_wkb([value])
    if feature.failed:
        raise feature.errors([])[0]
    return feature.one(0)


def from_wkb_buffer(data: npt.NDArray[np.uint8], offsets: Indices, missing: Iterable[int] = ()) -> Ragged:
    """The same from one buffer, as Arrow holds it; `missing` features have no bytes."""
    features = Ragged(*_core.read_wkb(np.ascontiguousarray(data), np.ascontiguousarray(offsets, np.int64)))
    features.failed += [("the geometry is missing", "empty", int(i), None, None, None) for i in missing]
    return features


def bytes_of(path: str) -> bytes:
    """The contents of a file, decompressed if it is compressed by gzip."""
    try:
        data = Path(path).read_bytes()
        return gzip.decompress(data) if data.startswith(b"\x1f\x8b") else data
    except (OSError, EOFError, zlib.error) as error:
        raise MedialError(f"{path}: {getattr(error, 'strerror', None) or error}", "unreadable") from None


def parsed(text: str | bytes) -> Any:
    """GeoJSON, parsed."""
    import json

    try:
        return json.loads(text)
    except (ValueError, RecursionError) as error:
        raise MedialError(f"this is not JSON: {error}", "malformed") from error


def _from_text(text: str) -> Rings:
    """SVG path data, GeoJSON, or a text that medial::text recognises: WKT, SVG, `x y` rows."""
    if re.match(r"\s*[Mm][\s\d.+-]", text):
        return Rings(contours=_core.contours_of_path(text))
    if text.lstrip().startswith("{") and not text.lstrip("{ \t\r\n").startswith('"medial"'):
        return _from_polygons(list(_polygons_of(parsed(text))))
    try:
        return Rings(*_core.rings_of_text(re.sub(r"^\s*SRID=\d+;", "", text)))
    except MedialError as error:
        if "GDAL" not in error.text:
            raise
        kinds = "neither well-known text, GeoJSON, SVG, path data nor rows of x and y"
        raise MedialError(f"this text is {kinds}", "malformed") from None


def _is_point(value: Any) -> bool:
    return len(value) >= 2 and all(np.isscalar(number) for number in value)


def _joined(shapes: Sequence[Any]) -> Rings:
    """The rings of shapes that do not overlap, as one feature."""
    parts = [shape._as_rings() for shape in shapes]
    starts = np.cumsum([0, *(len(part.coordinates) for part in parts)])
    begin = [part.begin[:-1] + start for part, start in zip(parts, starts[:-1], strict=True)]
    bulges = [np.zeros(len(part.coordinates)) if part.bulges is None else part.bulges for part in parts]
    return Rings(np.concatenate([part.coordinates for part in parts]), np.concatenate([*begin, starts[-1:]]),
                 np.concatenate([part.roles for part in parts]),
                 np.concatenate(bulges) if any(part.bulges is not None for part in parts) else None)  # fmt: skip


def read(x: Any) -> Rings:
    """The rings or contours of a geometry."""
    try:
        return _read(x)
    except RecursionError:
        raise MedialError("the geometry is nested too deeply", "malformed") from None


def _read(x: Any) -> Rings:
    if isinstance(x, np.ndarray) and x.dtype != object:
        return Rings(rows(x)) if x.ndim == 2 else _from_lists(list(x), None)
    if isinstance(x, str):
        return _from_text(x)
    if isinstance(x, (bytes, bytearray, memoryview)):
        return _from_one_wkb(bytes(x))
    if isinstance(x, Contour):
        return Rings(contours=[x._core])
    if hasattr(x, "_as_rings"):
        return _joined([x])
    wkb = getattr(type(x), "__module__", "").startswith("shapely.") and getattr(x, "wkb", None)
    if wkb:
        return _from_one_wkb(wkb)
    if geometry := _interface_of(x):
        return _from_polygons(list(_polygons_of(geometry)))
    if isinstance(x, Mapping):
        return _from_polygons(list(_polygons_of(x)))
    if isinstance(x, (Sequence, np.ndarray)) and len(x):
        if all(isinstance(part, Contour) for part in x):
            return Rings(contours=[part._core for part in x])
        if all(hasattr(part, "_as_rings") for part in x):
            return _joined(list(x))
        if hasattr(x[0], "__len__") and len(x[0]) and _is_point(x[0]):
            return Rings(rows(x))
        return _from_lists(list(x), None)
    raise MedialError(f"a {type(x).__name__} has no polygon", "unsupported")


def chains_of(x: Any) -> tuple[Floats, Indices, npt.NDArray[np.uint8]]:
    """Points and lines as chains: coordinates, the first one of each chain, whether it is closed."""
    try:
        return _chains_of(x)
    except RecursionError:
        raise MedialError("the geometry is nested too deeply", "malformed") from None


def _chains_of(x: Any) -> tuple[Floats, Indices, npt.NDArray[np.uint8]]:
    parts: list[tuple[Floats, bool]] = []

    def add(geometry: Mapping[str, Any]) -> None:
        kind, at = geometry.get("type"), geometry.get("coordinates", ())
        if kind == "Point":
            parts.append((rows([at]), False))
        elif kind == "MultiPoint":
            parts.extend((rows([point]), False) for point in at)
        elif kind == "LineString":
            parts.append((rows(at), False))
        elif kind == "LinearRing":
            parts.append((rows(at), True))
        elif kind == "MultiLineString":
            parts.extend((rows(line), False) for line in at)
        elif kind == "GeometryCollection":
            for part in _part(geometry, "geometries", Sequence):
                add(part)
        elif kind == "Feature":
            add(_part(geometry, "geometry", Mapping))
        elif kind == "FeatureCollection":
            for part in _part(geometry, "features", Sequence):
                add(part)
        else:
            parts.extend((rows(ring), True) for polygon in _polygons_of(geometry) for ring in polygon)

    def add_any(value: Any) -> None:
        if isinstance(geometry := _interface_of(value), Mapping):
            add(geometry)
        elif isinstance(value, Mapping):
            add(value)
        else:
            line = rows(value)
            closed = len(line) > 2 and bool((line[0] == line[-1]).all())
            parts.append((line[:-1] if closed else line, closed))

    if isinstance(x, np.ndarray) and x.ndim == 2 and x.dtype != object:
        points = rows(x)
        return points, np.arange(len(points) + 1), np.zeros(len(points), np.uint8)
    if isinstance(x, Mapping) or isinstance(_interface_of(x), Mapping):
        add_any(x)
    elif not isinstance(x, (Sequence, np.ndarray)) or isinstance(x, (str, bytes)):
        raise MedialError(f"a {type(x).__name__} has neither points nor lines", "unsupported")
    elif len(x) and isinstance(x[0], (Sequence, np.ndarray)) and len(x[0]) and _is_point(x[0]):
        return chains_of(rows(x))
    else:
        for value in x:
            add_any(value)
    begin = np.zeros(len(parts) + 1, np.int64)
    np.cumsum([len(line) for line, _ in parts], out=begin[1:])
    coordinates = np.concatenate([line for line, _ in parts]) if parts else np.empty((0, 2))
    return coordinates, begin, np.array([closed for _, closed in parts], np.uint8)
