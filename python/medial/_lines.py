"""Lines along an axis, and the widths of a shape along them."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from dataclasses import dataclass, field as dataclass_field
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._axis import MedialAxis, axis_of
from ._errors import MedialError, need
from ._records import Floats, numbers_of, points_of
from ._shape import load


@dataclass(frozen=True, eq=False)
class Line:
    """A line along an axis, such as a centre line.

    Attributes
    ----------
    axis : MedialAxis
        The line as an axis: one chain of exact edges, or a sampled one if it was smoothed.
    length, narrowest : float
        Its length, and the smallest radius along it.
    closed : bool
    """

    axis: MedialAxis
    length: float
    narrowest: float
    closed: bool
    _path: _core.Path = dataclass_field(repr=False)
    _of: MedialAxis = dataclass_field(repr=False)

    def coordinates(self, chord: float | None = None, step: float | None = None) -> Floats:
        """Rows of x, y and radius along the line.

        Parameters
        ----------
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal.
        step : float, optional
            Instead: the largest distance from row to row along the line, in units of the input.

        Examples
        --------
        >>> import medial
        >>> line = medial.centerline([(0, 0), (10, 0), (10, 2), (0, 2)])
        >>> line.coordinates(step=2).shape
        (5, 3)
        """
        parts = self.axis.sample(chord, step)
        if not parts:
            return np.empty((0, 3))
        return parts[0] if len(parts) == 1 else np.concatenate([parts[0], *(p[1:] for p in parts[1:])])

    def to_shapely(self, chord: float | None = None) -> Any:
        """A shapely LineString.

        Parameters
        ----------
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal.

        Examples
        --------
        >>> import medial
        >>> line = medial.centerline([(0, 0), (10, 0), (10, 2), (0, 2)])
        >>> round(line.to_shapely().length, 9)
        8.0
        """
        return need("shapely", "geo").LineString(self.coordinates(chord)[:, :2])

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        return {"type": "LineString", "coordinates": self.coordinates()[:, :2].tolist()}

    def widths(self, samples: int | npt.ArrayLike = 100) -> Widths:
        """The width along the line before it was extended or smoothed.

        Parameters
        ----------
        samples : int or array
            The number of evenly spaced places, or increasing lengths along the line, in units of the
            input.

        Raises
        ------
        MedialError
            With the code ``"invalid_option"`` for lengths beyond the line, or not increasing.

        Examples
        --------
        >>> import medial
        >>> line = medial.centerline([(0, 0), (10, 0), (10, 2), (0, 2)])
        >>> line.widths(3).width.round(9)
        array([2., 2., 2.])
        """
        if isinstance(samples, (int, np.integer)):
            if not 0 < samples < 2**31:
                raise MedialError("samples must be a positive integer")
            at = np.linspace(0, self.length, int(samples))
        else:
            at = np.ascontiguousarray(numbers_of(samples, "samples are lengths along the line"))
        return self._widths(at, across=False)

    def transects(self, count: int = 10, *, spacing: float | None = None) -> Widths:
        """Lines across this one, perpendicular to its course: see `medial.transects`.

        Parameters
        ----------
        count, spacing
            See `medial.transects`.

        Examples
        --------
        >>> import medial
        >>> line = medial.centerline([(0, 0), (10, 0), (10, 2), (0, 2)])
        >>> len(line.transects(spacing=2).along)
        5
        """
        if spacing is None:
            if not 0 <= operator.index(count) < 2**31:
                raise MedialError("count must be a positive integer")
            places = self.length * ((np.arange(count) + 0.5) / count)
            return self._widths(np.asarray(places, np.float64), across=True)
        if not 0 < spacing < np.inf:
            raise MedialError("spacing must be positive")
        steps = int(self.length / spacing)
        at: Floats = (self.length - steps * spacing) / 2 + spacing * np.arange(steps + 1, dtype=np.float64)
        return self._widths(at, across=True)

    def _widths(self, at: Floats, *, across: bool) -> Widths:
        rows = _core.widths(self._of._core, self._path, np.clip(at, 0, self.length) if across else at, across)
        return Widths(rows[:, 0], rows[:, 1:3], rows[:, 3], rows[:, 4:6], rows[:, 6:8])

    def side_channels(self) -> MedialAxis:
        """The paths around holes that leave the line and come back to it.

        For example the side channels of a river, without its tributaries.

        Examples
        --------
        >>> import medial
        >>> island = [[(0, 0), (30, 0), (30, 6), (0, 6)], [(9, 2), (21, 2), (21, 3), (9, 3)]]
        >>> medial.centerline(island).side_channels().branch_count
        1
        """
        return MedialAxis._of(_core.side_channels(self._of._core, self._path), self._of._attributes)


class Widths(NamedTuple):
    """The widths of a shape at places along a line."""

    along: Floats
    center: Floats
    radius: Floats
    left: Floats
    right: Floats

    @property
    def width(self) -> Floats:
        """Twice the radius."""
        return 2 * self.radius

    @property
    def span(self) -> Floats:
        """The length of the transect from foot point to foot point."""
        span: Floats = np.hypot(*(self.left - self.right).T)
        return span

    def to_pandas(self) -> Any:
        """The widths as a pandas DataFrame."""
        columns = {"along": self.along, "width": self.width, "span": self.span,
                   "x": self.center[:, 0], "y": self.center[:, 1]}  # fmt: skip
        return need("pandas", "all").DataFrame(columns)

    def transects(self) -> Any:
        """A shapely LineString from foot point to foot point for each place."""
        return need("shapely", "geo").linestrings(np.stack([self.left, self.right], axis=1))


def _line(of: MedialAxis, path: _core.Path, extend: bool, smooth: float) -> Line:
    if not smooth >= 0:
        raise MedialError("smooth must be a length, or 0")
    made = MedialAxis._of(_core.centre_line(of._core, path, extend, smooth), of._attributes)
    return Line(made, path.length, path.narrowest, path.closed, path, of)


def _place(of: MedialAxis, point: Sequence[float] | str) -> tuple[int, float]:
    if isinstance(point, str):
        x, y = _middle_of_side(of, point)
    else:
        ((x, y),) = points_of(point).tolist()
    if not (np.isfinite(x) and np.isfinite(y)):
        raise MedialError("a place must be two finite numbers", "not_finite")
    place = _core.place_at(of._core, (x, y))
    if place is None:
        raise MedialError("the shape's axis is a single point", "invalid_option")
    return place


def _middle_of_side(of: MedialAxis, name: str) -> tuple[float, float]:
    """The middle of the side named RING/VERTEX."""
    ring, _, vertex = name.partition("/")
    found = None
    if ring.isdecimal() and vertex.isdecimal():
        found = _core.middle_of_side(of._core.shape(), int(ring), int(vertex))
    if found is None:
        raise MedialError(f"there is no side {name!r}: sides are RING/VERTEX of the input", "invalid_option")
    return found[0], found[1]


def centerlines(x: Any, *, trim: float = 1, route: str = "roomy", extend: bool = False,
                smooth: float = 0) -> list[Line]:  # fmt: skip
    """The main path of each connected part.

    Parameters
    ----------
    x : MedialAxis or geometry
    trim : float
        Cut ends that protrude from a disk by less than `trim` times its radius; 0: lines run into
        the corners.
    route : {"roomy", "shortest"}
        Which path to take around holes.
    extend : bool
        Extend both ends to the boundary.
    smooth : float
        Average over this many radii; 0: not at all.

    Returns
    -------
    list of Line

    Examples
    --------
    >>> import medial
    >>> two = medial.Shape("MULTIPOLYGON (((0 0, 9 0, 9 2, 0 2, 0 0)), ((0 5, 6 5, 6 6, 0 6, 0 5)))")
    >>> [round(line.length, 9) for line in medial.centerlines(two)]
    [7.0, 5.0]
    """
    of = axis_of(x)
    return [_line(of, path, extend, smooth) for path in _core.main_paths(of._core, trim, route)]


def network(x: Any, *, trim: float = 1) -> MedialAxis:
    """The network of all paths, including those around holes, without forks in corners.

    Parameters
    ----------
    x : MedialAxis or geometry
    trim : float
        See `centerlines`.

    Examples
    --------
    >>> import medial
    >>> cross = [(4, 0), (6, 0), (6, 4), (10, 4), (10, 6), (6, 6), (6, 10), (4, 10), (4, 6), (0, 6), (0, 4), (4, 4)]
    >>> medial.network(cross).branch_count
    4
    """
    return axis_of(x).prune("significance", trim)


def centerline(x: Any, start: Sequence[float] | str | None = None, end: Sequence[float] | str | None = None, *,
               trim: float = 1, route: str = "roomy", extend: bool = False,
               smooth: float = 0) -> Line:  # fmt: skip
    """The centre line of a shape; if the shape has several parts, the longest of their lines.

    Parameters
    ----------
    x : MedialAxis or geometry
    start, end : (x, y) or str, optional
        Where the line begins and ends: at a point, or in the middle of the side ``"RING/VERTEX"``
        that starts at this vertex. By default at the two ends that are farthest apart.
    trim, route, extend, smooth
        See `centerlines`.

    Returns
    -------
    Line

    Raises
    ------
    MedialError
        With the code ``"empty"`` (the axis is a point) or ``"invalid_option"`` (unknown place).

    Examples
    --------
    >>> import medial
    >>> line = medial.centerline([(0, 0), (10, 0), (10, 2), (0, 2)], extend=True)
    >>> line.length, line.coordinates()[[0, -1], :2].tolist()
    (8.0, [[10.0, 1.0], [0.0, 1.0]])
    """
    of = axis_of(x)
    if (start is None) != (end is None):
        raise ValueError("start and end must be given together")
    if start is not None and end is not None:
        path = _core.path_between(of._core, _place(of, start), _place(of, end), route)
        return _line(of, path, extend, smooth)
    paths = _core.main_paths(of._core, trim, route)
    if not paths:
        raise MedialError("the axis has no edge", "empty")
    return _line(of, max(paths, key=lambda path: path.length), extend, smooth)


def widest_path(x: Any, start: Sequence[float] | str, end: Sequence[float] | str, *, extend: bool = False,
                smooth: float = 0) -> Line:  # fmt: skip
    """The shortest path between two places among those that let the largest disk pass.

    Parameters
    ----------
    x : MedialAxis or geometry
    start, end : (x, y) or str
        See `centerline`.
    extend, smooth
        See `centerlines`.

    Examples
    --------
    >>> import medial
    >>> round(medial.widest_path([(0, 0), (10, 0), (10, 2), (0, 2)], (2, 1), (8, 1)).narrowest, 9)
    1.0
    """
    of = axis_of(x)
    path = _core.path_between(of._core, _place(of, start), _place(of, end), "widest")
    return _line(of, path, extend, smooth)


def width_profile(x: Any, samples: int | npt.ArrayLike = 100, **given: Any) -> Widths:
    """The widths along the centre line.

    Parameters
    ----------
    x : Line, MedialAxis or geometry
    samples : int or array
        The number of evenly spaced places, or increasing lengths along the line, in units of the
        input.
    **given
        Options of `centerline`.

    Examples
    --------
    >>> import medial
    >>> medial.width_profile([(0, 0), (10, 0), (10, 2), (0, 2)], 3).width
    array([2., 2., 2.])
    """
    return (x if isinstance(x, Line) else centerline(x, **given)).widths(samples)


def transects(x: Any, count: int = 10, *, spacing: float | None = None, **given: Any) -> Widths:
    """Lines across a shape, perpendicular to its centre line's course, from boundary to boundary.

    Parameters
    ----------
    x : Line, MedialAxis or geometry
    count : int
        The number of transects: one in the middle of each of `count` equal parts of the line.
    spacing : float, optional
        Instead: the distance between transects, in units of the input.
    **given
        Options of `centerline`.

    Returns
    -------
    Widths
        Its `left` and `right` are the ends of the transects.

    Examples
    --------
    >>> import medial
    >>> medial.transects([(0, 0), (10, 0), (10, 2), (0, 2)], spacing=2).span
    array([2., 2., 2., 2., 2.])
    """
    return (x if isinstance(x, Line) else centerline(x, **given)).transects(count, spacing=spacing)


def mean_width(x: Any, **given: Any) -> dict[str, float]:
    """Mean widths: by length, by area, and area by length. Takes the options of `centerline`.

    Parameters
    ----------
    x : MedialAxis or geometry
    **given
        Options of `centerline`.

    Examples
    --------
    >>> import medial
    >>> round(medial.mean_width([(0, 0), (10, 0), (10, 2), (0, 2)])["by_length"], 9)
    2.0
    """
    line = centerline(x, **given)
    return _core.mean_widths(line._of._core, line._path)


class Neck(NamedTuple):
    """A place narrower than its surroundings on both sides."""

    x: float
    y: float
    radius: float
    left: tuple[float, float]
    right: tuple[float, float]
    opens_to: float
    around_hole: bool

    @property
    def width(self) -> float:
        """Twice the radius."""
        return 2 * self.radius

    @property
    def prominence(self) -> float:
        """The growth of the width on both sides."""
        return 2 * (self.opens_to - self.radius)


def necks(x: Any, widening: float = 1.1) -> list[Neck]:
    """The necks of a shape: first those that separate it, by decreasing prominence, then others.

    Parameters
    ----------
    x : MedialAxis or geometry
    widening : float
        A neck opens on both sides to at least `widening` times its width; above 1.

    Examples
    --------
    >>> import medial
    >>> dumbbell = [(0, 0), (4, 0), (4, 1.5), (6, 1.5), (6, 0), (10, 0), (10, 4), (6, 4), (6, 2.5), (4, 2.5), (4, 4), (0, 4)]
    >>> [(neck.x, neck.y, neck.width) for neck in medial.necks(dumbbell)]
    [(5.0, 2.0, 1.0)]
    """
    rows = _core.necks(axis_of(x)._core, widening).tolist()
    return [Neck(r[1], r[2], r[3], (r[4], r[5]), (r[6], r[7]), r[8], bool(r[9])) for r in rows]


class Circle(NamedTuple):
    """A circle."""

    x: float
    y: float
    radius: float

    def to_shapely(self, quad_segs: int = 64) -> Any:
        """A shapely Polygon that approximates the circle."""
        return need("shapely", "geo").Point(self.x, self.y).buffer(self.radius, quad_segs)


def maximum_inscribed_circle(x: Any) -> Circle:
    """The largest circle inside a shape; any one of several.

    For an axis, this is its largest disk. For a geometry, no axis is computed, which is much faster
    for large shapes.

    Parameters
    ----------
    x : MedialAxis or geometry

    Examples
    --------
    >>> import medial
    >>> medial.maximum_inscribed_circle([(0, 0), (4, 0), (0, 4)]).radius
    1.17157287525...
    """
    if isinstance(x, MedialAxis):
        return Circle(*_core.deepest_disk(x._core))
    return inscribed_circles(x, 1)[0]


def inscribed_circles(x: Any, count: int, smallest: float = 0) -> list[Circle]:
    """The largest disjoint circles: each is the largest that overlaps none before it.

    Parameters
    ----------
    x : MedialAxis or geometry
    count : int
        The largest number of circles.
    smallest : float
        The smallest radius, in units of the input.

    Examples
    --------
    >>> import medial
    >>> [circle.radius for circle in medial.inscribed_circles([(0, 0), (4, 0), (4, 2), (0, 2)], 2)]
    [1.0, 1.0]
    """
    shape = x.shape._core if isinstance(x, MedialAxis) else load(x)[0]
    return [Circle(*row) for row in _core.disjoint_disks(shape, count, smallest).tolist()]
