"""Offset curves and buffers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._axis import MedialAxis, axis_of
from ._errors import need
from ._options import options
from ._read import chains_of
from ._records import Floats, numbers_of
from ._shape import load


@dataclass(frozen=True, eq=False)
class Region:
    """A connected set of the points farther than a distance from the boundary.

    Attributes
    ----------
    distance : float
        The distance from the boundary, negative outside the shape.
    rings : list of (points, bulges)
        The outer ring, then the holes; bulge i is of the edge after point i.
    parent : int
        The index of the region around this one at the next smaller distance; -1 if there is none.
    """

    distance: float
    rings: list[tuple[Floats, Floats]]
    parent: int
    area: float
    length: float

    def polygon(self, chord: float | None = None) -> list[Floats]:
        """Closed rings in which chords replace arcs, within `chord` of them.

        Parameters
        ----------
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal.

        Examples
        --------
        >>> import medial
        >>> (region,) = medial.offset([(0, 0), (4, 0), (4, 4), (0, 4)], -1)
        >>> len(region.polygon(0.1)[0]) < len(region.polygon(0.001)[0])
        True
        """
        return [_flattened(points, bulges, chord) for points, bulges in self.rings]

    def to_shapely(self, chord: float | None = None) -> Any:
        """A shapely Polygon.

        Parameters
        ----------
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal.

        Examples
        --------
        >>> import medial
        >>> (region,) = medial.offset([(0, 0), (4, 0), (4, 4), (0, 4)], -1)
        >>> 35 < region.to_shapely().area < region.area
        True
        """
        rings = self.polygon(chord)
        return need("shapely", "geo").Polygon(rings[0], rings[1:])

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        return {"type": "Polygon", "coordinates": [ring.tolist() for ring in self.polygon()]}


def _flattened(points: Floats, bulges: Floats, chord: float | None) -> Floats:
    """A closed ring with chords for arcs."""
    if chord is None:
        chord = options.chord * (float(np.hypot(*np.ptp(points, axis=0))) or 1.0)
    closed = np.concatenate([points, points[:1]])
    if not bulges.any():
        return closed
    parts: list[npt.NDArray[Any]] = []
    for start, end, bulge in zip(closed[:-1], closed[1:], bulges.tolist(), strict=True):
        parts.append(start[None])
        if bulge == 0:
            continue
        angle = 4 * math.atan(bulge)
        radius = float(np.hypot(*(end - start))) / (2 * abs(math.sin(angle / 2)))
        step = 2 * math.acos(max(-1.0, 1 - chord / radius)) if chord < radius else math.pi
        pieces = max(1, math.ceil(abs(angle) / step))
        across = np.array([start[1] - end[1], end[0] - start[0]]) / (2 * math.tan(angle / 2))
        center = (start + end) / 2 + across
        turns = angle * np.arange(1, pieces) / pieces
        arm = start - center
        cos, sin = np.cos(turns)[:, None], np.sin(turns)[:, None]
        parts.append(center + cos * arm + sin * np.array([-arm[1], arm[0]]))
    return np.concatenate([*parts, closed[-1:]])


def _regions(rows: list[Any]) -> list[Region]:
    regions = []
    for clearance, parent, points, bulges, begin, area, length in rows:
        pairs = zip(begin[:-1].tolist(), begin[1:].tolist(), strict=True)
        rings = [(points[a:b], bulges[a:b]) for a, b in pairs]
        regions.append(Region(clearance, rings, parent, area, length))
    return regions


def offset(x: Any, distances: float | Sequence[float] | Floats, *, threads: int | None = None) -> list[Region]:
    """Offset curves with true arcs.

    Parameters
    ----------
    x : MedialAxis, Shape or geometry
    distances : float or sequence
        Distances from the boundary: positive inwards, negative outwards.

    Returns
    -------
    list of Region
        Sorted by increasing distance. Regions of the same distance are disjoint.

    Examples
    --------
    >>> import medial
    >>> [region.area for region in medial.offset([(0, 0), (4, 0), (4, 4), (0, 4)], 1)]
    [4.0]
    """
    values = np.atleast_1d(numbers_of(distances, "distances must be numbers"))
    if isinstance(x, MedialAxis) and (values > 0).all() and not x.exterior and not x.resolution:
        return _regions(_core.inward_offsets(x._core, values))
    shape = x.shape._core if isinstance(x, MedialAxis) else load(x)[0]
    return _regions(_core.offsets_of(shape, values, options.threads if threads is None else threads))


def offset_passes(x: Any, step: float, *, first: float | None = None, until: float | None = None) -> list[Region]:
    """Offset curves at every `step` until nothing is left inside, as for clearing a pocket.

    Parameters
    ----------
    x : MedialAxis or geometry
    step, first : float
        The distance between passes, and of the first pass (by default `step`), in units of the
        input.
    until : float, optional
        The largest distance of any pass.

    Raises
    ------
    MedialError
        With the code ``"invalid_option"`` or ``"too_large"`` (more than a million passes).

    Examples
    --------
    >>> import medial
    >>> [region.distance for region in medial.offset_passes([(0, 0), (9, 0), (9, 4), (0, 4)], 0.75)]
    [0.75, 1.5]
    """
    of = axis_of(x)
    passes = _core.offset_passes(of._core, step if first is None else first, step)
    return offset(of, passes if until is None else passes[passes <= float(until)])


def buffer(x: Any, distances: float | Sequence[float] | Floats, *, bulges: npt.ArrayLike | None = None,
           node_crossings: bool = True, threads: int | None = None) -> list[Region]:  # fmt: skip
    """The set of points within a distance of points, lines and arcs.

    Parameters
    ----------
    x : geometry
        Points, lines and rings: shapely geometries, GeoJSON, or rows of coordinates.
    node_crossings : bool
        Whether lines may cross.

    Examples
    --------
    >>> import medial
    >>> [round(region.area, 9) for region in medial.buffer([(0.0, 0.0)], 1)]
    [3.141592654]
    """
    coordinates, begin, closed = chains_of(x)
    values = np.atleast_1d(numbers_of(distances, "distances must be numbers"))
    own = None if bulges is None else np.ascontiguousarray(numbers_of(bulges, "bulges must be numbers"))
    rows = _core.buffers(coordinates, begin, closed, own, node_crossings, values,
                         options.threads if threads is None else threads)  # fmt: skip
    regions = []
    for distance_to, rings in rows:
        area = sum(_signed_area(points, bulge) for points, bulge in rings)
        length = sum(_ring_length(points, bulge) for points, bulge in rings)
        regions.append(Region(-distance_to, list(rings), -1, area, length))
    return regions


def _signed_area(points: Floats, bulges: Floats) -> float:
    after = np.roll(points, -1, axis=0)
    origin = points[0]
    a, b = points - origin, after - origin
    area = float((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum() / 2)
    for chord, bulge in zip(np.hypot(*(after - points).T).tolist(), bulges.tolist(), strict=True):
        if bulge:
            angle = 4 * math.atan(bulge)
            radius = chord / (2 * math.sin(angle / 2))
            area += radius * radius / 2 * (angle - math.sin(angle))
    return area


def _ring_length(points: Floats, bulges: Floats) -> float:
    chords = np.hypot(*(np.roll(points, -1, axis=0) - points).T)
    angle = 4 * np.arctan(bulges)
    with np.errstate(invalid="ignore", divide="ignore"):
        factor = np.where(bulges == 0, 1.0, angle / (2 * np.sin(angle / 2)))
    return float((chords * factor).sum())
