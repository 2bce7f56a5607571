"""Shapes: loops with the interior on their left."""

from __future__ import annotations

import json
from collections.abc import Mapping
from copy import deepcopy
from decimal import Decimal
from numbers import Integral, Real
from os import PathLike, fsencode
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import MedialError, need
from ._options import options
from ._records import Floats, in_utf8, numbers_of, points_of, where_known
from ._read import HOLE, OUTER, Rings, read

_CoreShape = _core.Shape


class Shape:
    """A bounded region of the plane, of straight and circular edges.

    Made from anything that `axis` takes, or by operations such as `rebuild`.

    Parameters
    ----------
    x : geometry
        See `axis`.
    bulges : array, optional
        For a single ring: the bulge of each edge, the tangent of a quarter of its angle.
    repair : str, optional
        The rule that decides what is inside where rings cross: ``"make_valid"`` (that of the
        input), ``"even_odd"`` or ``"non_zero"``. Without it, crossing rings are an error.
    arc_tolerance : float
        The largest distance of arcs from free-form curves, as a share of the diagonal.
    fit : float
        Replaces boundaries by smooth curves within this distance; 0 keeps them.

    Attributes
    ----------
    attributes : dict
        Data that `read` found besides the geometry: the layer of a drawing, the `id` of a path, the
        properties of GeoJSON. Ignored by ``==``.

    Examples
    --------
    >>> import medial
    >>> shape = medial.Shape([(0, 0), (4, 0), (4, 3), (0, 3)])
    >>> shape.area, shape.bounds
    (12.0, (0.0, 0.0, 4.0, 3.0))
    """

    __slots__ = ("_core", "attributes", "__weakref__")

    _core: _CoreShape
    attributes: dict[str, Any]

    def __init__(
        self,
        x: Any,
        *,
        bulges: npt.ArrayLike | None = None,
        repair: str | None = None,
        arc_tolerance: float = 1e-6,
        fit: float = 0,
    ) -> None:
        self._core = load(x, bulges, repair, arc_tolerance, fit)[0]
        self.attributes = dict(x.attributes) if isinstance(x, Shape) else {}

    @classmethod
    def _of(cls, core: _CoreShape, attributes: Mapping[str, Any] | None = None) -> Shape:
        shape = cls.__new__(cls)
        shape._core = core
        shape.attributes = dict(attributes or {})
        return shape

    @property
    def points(self) -> Floats:
        """The vertices of all loops, loop after loop; read-only."""
        return self._core.points().view(np.float64).reshape(-1, 2)

    @property
    def bulges(self) -> Floats:
        """The bulge of the edge after each vertex; empty if all edges are straight."""
        return self._core.bulges()

    @property
    def loop_begin(self) -> npt.NDArray[np.uint32]:
        """The vertices of loop i are ``points[loop_begin[i]:loop_begin[i + 1]]``."""
        return self._core.loop_begin()

    @property
    def component(self) -> npt.NDArray[np.uint32]:
        """The component of each loop."""
        return self._core.component()

    @property
    def hole(self) -> npt.NDArray[np.bool_]:
        """Whether each loop is a hole."""
        return self._core.hole().astype(bool)

    @property
    def area(self) -> float:
        """The area, without the holes."""
        return self._core.area()

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """The bounding box, arcs included: min x, min y, max x, max y."""
        x0, y0, x1, y1 = self._core.bounds()
        return x0, y0, x1, y1

    @property
    def diagonal(self) -> float:
        """The length of the bounding box's diagonal."""
        x0, y0, x1, y1 = self.bounds
        return float(np.hypot(x1 - x0, y1 - y0))

    def clearance(self, points: npt.ArrayLike) -> Floats:
        """The distance of points to the boundary, negative outside.

        Parameters
        ----------
        points : array of shape (n, 2)
            In units of the input.

        Examples
        --------
        >>> import medial
        >>> s = medial.Shape([(0, 0), (4, 0), (4, 3), (0, 3)])
        >>> s.clearance([(1, 1)])
        array([1.])
        """
        places = points_of(points)
        return where_known(places, _core.clearances(self._core, places))

    def polygons(self, chord: float | None = None) -> list[list[Floats]]:
        """The components as lists of closed rings, outer ring first.

        Chords replace arcs, within `chord` of them.

        Parameters
        ----------
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal.

        Examples
        --------
        >>> import medial
        >>> s = medial.Shape([(0, 0), (4, 0), (4, 3), (0, 3)])
        >>> s.polygons()[0][0].shape
        (5, 2)
        """
        limit = chord if chord is not None else options.chord * (self.diagonal or 1)
        points, begin = self._core.outline(limit)
        polygons: list[list[Floats]] = [[] for _ in range(self._core.component_count())]
        for i, (component, hole) in enumerate(zip(self.component, self.hole, strict=True)):
            ring = points[begin[i] : begin[i + 1]]
            polygons[component].insert(len(polygons[component]) if hole else 0, ring)
        return polygons

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        polygons = [[ring.tolist() for ring in polygon] for polygon in self.polygons()]
        if len(polygons) == 1:
            return {"type": "Polygon", "coordinates": polygons[0]}
        return {"type": "MultiPolygon", "coordinates": polygons}

    def to_shapely(self, chord: float | None = None) -> Any:
        """A shapely Polygon, or a MultiPolygon if there are several components.

        Parameters
        ----------
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal.

        Examples
        --------
        >>> import medial
        >>> s = medial.Shape([(0, 0), (4, 0), (4, 3), (0, 3)])
        >>> s.to_shapely().area
        12.0
        """
        shapely = need("shapely", "geo")
        parts = [shapely.Polygon(rings[0], rings[1:]) for rings in self.polygons(chord)]
        return parts[0] if len(parts) == 1 else shapely.MultiPolygon(parts)

    def scaled(self, factor: float, move: tuple[float, float] = (0, 0)) -> Shape:
        """The shape scaled by `factor`, then moved.

        Parameters
        ----------
        factor : float
            Positive.
        move : (x, y)
            The translation, in units of the result.

        Examples
        --------
        >>> import medial
        >>> medial.Shape([(0, 0), (4, 0), (4, 3), (0, 3)]).scaled(0.5, move=(1, 0)).bounds
        (1.0, 0.0, 3.0, 1.5)
        """
        points, *others = self._state()
        moved = np.ascontiguousarray(points * factor + numbers_of(move, "move is x and y"))
        if not factor > 0 or not np.isfinite(moved).all():
            raise MedialError("factor must be positive, and the result must not overflow")
        return Shape._of(_core.restored_shape(moved, *others), self.attributes)

    def to_text(self, format: str = "wkt", *, chord: float = 1e-3) -> str:
        """The shape as text in a file format: see `save`.

        Parameters
        ----------
        format : {"wkt", "geojson", "svg", "json"}
        chord : float
            In formats without arcs: the largest distance of chords from them, as a share of the
            diagonal.

        Examples
        --------
        >>> import medial
        >>> medial.Shape([(0, 0), (4, 0), (0, 3)]).to_text().strip()
        'POLYGON ((0 0, 4 0, 0 3, 0 0))'
        """
        text = _core.write_shape(self._core, stated(self.attributes), None, format, chord)
        return text or ""

    def save(self, path: str | PathLike[str], *, chord: float = 1e-3) -> None:
        """Writes the shape in the format of the extension: .wkt, .geojson, .svg or .json (native).

        GeoJSON and the native format hold `attributes`, too. In the native format all are texts; in
        GeoJSON those that are the usual spelling of a number are numbers ("007" stays a text).

        Parameters
        ----------
        path : path
        chord : float
            See `to_text`.

        Examples
        --------
        >>> import medial, pathlib, tempfile
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     path = pathlib.Path(folder, "a.wkt")
        ...     medial.Shape([(0, 0), (4, 0), (0, 3)]).save(path)
        ...     medial.read(path)[0].area
        6.0
        """
        _core.write_shape(self._core, stated(self.attributes), fsencode(path), "", chord)

    def __repr__(self) -> str:
        holes, parts = self._core.hole_count(), self._core.component_count()
        return f"<medial.Shape: {len(self.points)} points, {parts} components, {holes} holes>"

    def _state(self) -> tuple[npt.NDArray[Any], ...]:
        sources = self._core.sources().view(np.uint32)
        return (self.points, self.bulges, sources, self.loop_begin, self.component, self._core.hole())

    def _as_rings(self) -> Rings:
        roles = np.where(self._core.hole() != 0, HOLE, OUTER).astype(np.uint8)
        bulges = self.bulges if len(self.bulges) else None
        return Rings(np.array(self.points), self.loop_begin.astype(np.int64), roles, bulges)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Shape):
            return NotImplemented
        return all(np.array_equal(a, b) for a, b in zip(self._state(), other._state(), strict=True))

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        arrays = tuple(np.array(part) for part in self._state())
        return restored, arrays, (None, {"attributes": self.attributes})

    def __copy__(self) -> Shape:
        return Shape._of(self._core, self.attributes)

    def __deepcopy__(self, memo: dict[int, Any]) -> Shape:
        return Shape._of(self._core, deepcopy(self.attributes, memo))  # the rest is immutable


def is_missing(value: Any) -> bool:
    """Whether a value is missing: None, or a missing value of NumPy or pandas."""
    if isinstance(value, (Real, Decimal, np.datetime64, np.timedelta64)):
        return bool(value != value)
    return value is None or type(value).__name__ in ("NAType", "NaTType")


def stated(attributes: Mapping[str, Any]) -> list[tuple[str, float | str]]:
    """Attributes in the form of files: as the command line reads them, without missing ones."""
    pairs: list[tuple[str, float | str]] = []
    for name, value in attributes.items():
        if is_missing(value):
            continue
        if isinstance(value, (bool, np.bool_, Integral)):
            value = str(int(value))
        elif isinstance(value, Real):
            value = float(value)
        elif isinstance(value, (list, tuple, dict)):
            value = json.dumps(value, default=str, ensure_ascii=False)
        elif not isinstance(value, str):
            value = str(value)
        pairs.append((in_utf8(name), in_utf8(value) if isinstance(value, str) else value))
    return pairs


def restored(*state: npt.NDArray[Any]) -> Shape:
    """A shape from its pickled state."""
    return Shape._of(_core.restored_shape(*state))


def load(
    x: Any,
    bulges: npt.ArrayLike | None = None,
    repair: str | None = None,
    arc_tolerance: float = 1e-6,
    fit: float = 0,
    keep_contours: bool = False,
) -> tuple[_core.Shape, list[_core.Contour]]:
    """The shape of a geometry, and its contours for methods that trace them."""
    if not fit >= 0:
        raise MedialError("fit must be a distance, or 0")
    if isinstance(x, Shape) and not (repair or fit or keep_contours):
        return x._core, []
    rings = x if isinstance(x, Rings) else read(x)
    own = rings.bulges if bulges is None else np.ascontiguousarray(numbers_of(bulges, "bulges must be numbers"))
    if not (rings.contours or repair or fit or keep_contours):
        if rings.coordinates is None:
            rings.coordinates = np.empty((0, 2))
        return _core.shape_of(rings.coordinates, rings.begin, rings.roles, own), []
    loaded = _core.load(
        rings.coordinates, rings.begin, rings.roles, own, rings.contours,
        repair, arc_tolerance, fit, keep_contours, options.threads,
    )  # fmt: skip
    for note in loaded.notes:
        import warnings

        warnings.warn(note, stacklevel=3)
    return loaded.shape, loaded.contours
