"""Whatever has a polygon in it, as rings of coordinates or contours."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._contour import Contour
from ._errors import MedialError
from ._records import Floats, Indices

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
    """Polygons of many features, with offsets as shapely.to_ragged_array() has them."""

    coordinates: Floats
    ring: Indices
    polygon: Indices
    feature: Indices | None = None
    failed: list[Any] = field(default_factory=list)

    def __len__(self) -> int:
        return len(self.polygon if self.feature is None else self.feature) - 1

    def errors(self, computed: list[Any]) -> dict[int, MedialError]:
        """Errors by feature: of reading, and of what was computed then."""
        return {row[2]: MedialError(*row) for row in (*computed, *self.failed)}

    def one(self, i: int) -> Rings:
        """The rings of one feature."""
        if any(row[2] == i for row in self.failed):
            raise self.errors([])[i]
        first, last = (i, i + 1) if self.feature is None else self.feature[i : i + 2]
        polygons = self.polygon[first : last + 1]
        begin = self.ring[polygons[0] : polygons[-1] + 1] if len(polygons) else self.ring[:0]
        if len(begin) == 0:
            return Rings(np.empty((0, 2)), np.zeros(1, np.int64))
        roles = np.full(len(begin) - 1, HOLE, np.uint8)
        roles[polygons[:-1] - polygons[0]] = OUTER
        coordinates = self.coordinates[begin[0] : begin[-1]]
        return Rings(coordinates, begin - begin[0], roles)


def rows(points: Any) -> Floats:
    """Coordinates as rows of x and y; more columns are dropped."""
    try:
        array = np.asarray(points, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise MedialError("coordinates are rows of x and y", "malformed") from error
    if array.ndim != 2 or (array.shape[1] < 2 and array.size):
        raise MedialError("coordinates are rows of x and y", "malformed")
    return np.ascontiguousarray(array[:, :2])


def _from_lists(rings: Sequence[Any], roles: Sequence[int] | None) -> Rings:
    parts = [rows(ring) for ring in rings]
    begin = np.zeros(len(parts) + 1, np.int64)
    np.cumsum([len(part) for part in parts], out=begin[1:])
    coordinates = np.concatenate(parts) if parts else np.empty((0, 2))
    return Rings(coordinates, begin, None if roles is None else np.asarray(roles, np.uint8))


def _polygons_of(geometry: Mapping[str, Any]) -> Iterator[Sequence[Any]]:
    """The polygons, as lists of rings, of a geometry, feature or collection of GeoJSON."""
    kind = geometry.get("type")
    if kind == "Feature":
        yield from _polygons_of(geometry["geometry"])
    elif kind == "FeatureCollection":
        for feature in geometry["features"]:
            yield from _polygons_of(feature)
    elif kind == "GeometryCollection":
        for part in geometry["geometries"]:
            yield from _polygons_of(part)
    elif kind == "Polygon":
        yield geometry["coordinates"]
    elif kind == "MultiPolygon":
        yield from geometry["coordinates"]
    else:
        raise MedialError(f"the geometry is a {kind}, not a polygon", "unsupported")


def _from_polygons(polygons: Sequence[Sequence[Any]]) -> Rings:
    roles = [HOLE if i else OUTER for polygon in polygons for i in range(len(polygon))]
    return _from_lists([ring for polygon in polygons for ring in polygon], roles)


def from_wkb(values: Sequence[bytes | None] | npt.NDArray[Any]) -> Ragged:
    """The polygons of well-known binary, one feature for each value; None is an error of its feature."""
    missing = [i for i, value in enumerate(values) if value is None]
    present: Sequence[bytes] | npt.NDArray[Any] = [value or b"" for value in values] if missing else values  # type: ignore[assignment]
    sizes = np.fromiter((len(value) for value in present), np.int64, len(values))
    offsets = np.zeros(len(values) + 1, np.int64)
    np.cumsum(sizes, out=offsets[1:])
    return from_wkb_buffer(np.frombuffer(b"".join(present), np.uint8), offsets, missing)


def from_wkb_buffer(data: npt.NDArray[np.uint8], offsets: Indices, missing: Iterable[int] = ()) -> Ragged:
    """The same from one buffer, as Arrow holds it; `missing` features have no bytes."""
    features = Ragged(*_core.read_wkb(np.ascontiguousarray(data), np.ascontiguousarray(offsets, np.int64)))
    features.failed += [("the geometry is missing", "empty", int(i), None, None, None) for i in missing]
    return features


_WORD = re.compile(r"\s*(?:([A-Za-z]+)|([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)|([(),;=]))")


@cache
def _rings() -> list[tuple[re.Pattern[str], int]]:
    """Rings whose points have two or all three numbers, and how many."""
    number = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
    points = [(r"\s+".join([number] * columns), columns) for columns in (2, 3)]
    return [(re.compile(rf"\s*\(\s*({p}(?:\s*,\s*{p})*+)\s*\)"), columns) for p, columns in points]


class _WellKnownText:
    """A reader of POLYGON, MULTIPOLYGON and collections of them."""

    def __init__(self, text: str) -> None:
        self._text = re.sub(r"^\s*SRID=\d+;", "", text)
        self._at = 0

    def _fail(self) -> MedialError:
        return MedialError(f"this is not well-known text at place {self._at}", "malformed")

    def _next(self) -> str:
        found = _WORD.match(self._text, self._at)
        if found is None:
            raise self._fail()
        self._at = found.end()
        return found.group(found.lastindex or 0)

    def _list(self, item: Any) -> list[Any]:
        """A list in brackets; EMPTY is one without items."""
        word = self._next()
        if word.upper() in ("Z", "M", "ZM"):
            word = self._next()
        if word.upper() == "EMPTY":
            return []
        if word != "(":
            raise self._fail()
        items = []
        while True:
            items.append(item())
            word = self._next()
            if word == ")":
                return items
            if word != ",":
                raise self._fail()

    def _point(self) -> list[float]:
        numbers = []
        while True:
            at = self._at
            word = self._next()
            if word in "(),;=" or word[0].isalpha():
                self._at = at
                break
            numbers.append(float(word))
        if len(numbers) < 2:
            raise self._fail()
        return numbers[:2]

    def _ring(self) -> Any:
        """A ring: at once, where all its points are alike, else number by number."""
        for pattern, columns in _rings():
            found = pattern.match(self._text, self._at)
            if found is not None:
                self._at = found.end()
                return np.array(found[1].replace(",", " ").split(), np.float64).reshape(-1, columns)[:, :2]
        return self._list(self._point)

    def _polygon(self) -> list[Any]:
        return self._list(self._ring)

    def _geometry(self) -> list[Any]:
        name = self._next().upper()
        if name == "POLYGON":
            return [self._polygon()]
        if name == "MULTIPOLYGON":
            return self._list(self._polygon)
        if name == "GEOMETRYCOLLECTION":
            return [polygon for part in self._list(self._geometry) for polygon in part]
        raise MedialError(f"the geometry is a {name}, not a polygon", "unsupported")

    def polygons(self) -> list[Any]:
        polygons = self._geometry()
        if self._text[self._at :].strip():
            raise self._fail()
        return [polygon for polygon in polygons if polygon]


def _from_text(text: str) -> Rings:
    if re.match(r"\s*[Mm][\s\d.+-]", text):
        from ._svg_path import contours_of

        return Rings(contours=contours_of(text))
    return _from_polygons(_WellKnownText(text).polygons())


def _is_point(value: Any) -> bool:
    return len(value) >= 2 and all(np.isscalar(number) for number in value)


def read(x: Any) -> Rings:
    """The rings or contours of a geometry."""
    if isinstance(x, np.ndarray) and x.dtype != object:
        return Rings(rows(x)) if x.ndim == 2 else _from_lists(list(x), None)
    if isinstance(x, str):
        return _from_text(x)
    if isinstance(x, (bytes, bytearray, memoryview)):
        return from_wkb([bytes(x)]).one(0)
    if isinstance(x, Contour):
        return Rings(contours=[x._core])
    wkb = getattr(type(x), "__module__", "").startswith("shapely.") and getattr(x, "wkb", None)
    if wkb:
        return from_wkb([wkb]).one(0)
    if geometry := getattr(x, "__geo_interface__", None):
        return _from_polygons(list(_polygons_of(geometry)))
    if isinstance(x, Mapping):
        return _from_polygons(list(_polygons_of(x)))
    if isinstance(x, (Sequence, np.ndarray)) and len(x):
        if all(isinstance(part, Contour) for part in x):
            return Rings(contours=[part._core for part in x])
        if hasattr(x[0], "__len__") and len(x[0]) and _is_point(x[0]):
            return Rings(rows(x))
        return _from_lists(list(x), None)
    raise MedialError(f"a {type(x).__name__} has no polygon", "unsupported")


def chains_of(x: Any) -> tuple[Floats, Indices, npt.NDArray[np.uint8]]:
    """Points and lines: coordinates, where chains begin, whether they are closed."""
    parts: list[tuple[Floats, bool]] = []

    def add(geometry: Mapping[str, Any]) -> None:
        kind, at = geometry["type"], geometry.get("coordinates", ())
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
            for part in geometry["geometries"]:
                add(part)
        else:
            parts.extend((rows(ring), True) for polygon in _polygons_of(geometry) for ring in polygon)

    def add_any(value: Any) -> None:
        if hasattr(value, "__geo_interface__"):
            add(value.__geo_interface__)
        elif isinstance(value, Mapping):
            add(value)
        else:
            line = rows(value)
            closed = len(line) > 2 and bool((line[0] == line[-1]).all())
            parts.append((line[:-1] if closed else line, closed))

    if isinstance(x, np.ndarray) and x.ndim == 2 and x.dtype != object:
        points = rows(x)
        return points, np.arange(len(points) + 1), np.zeros(len(points), np.uint8)
    geometry = getattr(x, "__geo_interface__", None)
    if geometry and "features" not in geometry:
        add_any(x)
    elif len(x) and not hasattr(x[0], "__geo_interface__") and len(x[0]) and _is_point(x[0]):
        return chains_of(rows(x))
    else:
        for value in x:
            add_any(value)
    begin = np.zeros(len(parts) + 1, np.int64)
    np.cumsum([len(line) for line, _ in parts], out=begin[1:])
    coordinates = np.concatenate([line for line, _ in parts]) if parts else np.empty((0, 2))
    return coordinates, begin, np.array([closed for _, closed in parts], np.uint8)
