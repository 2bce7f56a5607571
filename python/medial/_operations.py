"""What follows from an axis: parts of it, lines, widths, offsets, tool paths."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field as dataclass_field
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._axis import MedialAxis, axis, axis_of
from ._errors import MedialError, need
from ._options import options
from ._read import chains_of
from ._records import Floats, points_of
from ._shape import Shape, load

# Parts of an axis.


def prune(x: Any, measure: str = "prominence", threshold: float | None = None, *,
          keep: int | None = None, tips: bool = False) -> MedialAxis:  # fmt: skip
    """The part of an axis that matters.

    Parameters
    ----------
    x : MedialAxis or geometry
    measure : str
        A name of :func:`prune_measures`.
    threshold : float, optional
        The default is that of the measure.
    keep : int, optional
        Keep at most so many branches instead, but always the cycles.
    tips : bool
        Extend each end to a tip.

    Examples
    --------
    >>> import medial
    >>> a = medial.axis([(0, 0), (9, 0), (9, 2), (5, 2), (4.5, 2.1), (4, 2), (0, 2)])
    >>> a.branch_count, medial.prune(a, "erosion", 0.5).branch_count
    (7, 1)
    """
    return axis_of(x).prune(measure, threshold, keep=keep, tips=tips)


def prune_measures() -> dict[str, float]:
    """The measures of :func:`prune` with their default thresholds."""
    return dict(_core.prune_measures())


def smooth(x: Any, measure: str = "prominence", threshold: float | None = None, *,
           keep: int | None = None) -> Shape:  # fmt: skip
    """The shape without what pruning its axis drops: bumps and notches become round."""
    return rebuild(axis_of(x).prune(measure, threshold, keep=keep))


def rebuild(x: MedialAxis, by: str = "outline", *, points: int = 0, chord: float = 0) -> Shape:
    """The shape of an axis: of an exact one its shape again, of a pruned one its disks' union.

    Parameters
    ----------
    by : {"outline", "tangents", "hulls"}
    points : int
        Of tangents: about how many points on the axis.
    chord : float
        Arcs become chords within this distance; 0: they stay arcs.

    Examples
    --------
    >>> import medial
    >>> medial.rebuild(medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])).area
    8.0
    """
    return Shape._of(_core.rebuilt(x._core, by, points, chord))


def collapse(x: Any, width: float, *, trim: float = 1) -> tuple[Shape | None, MedialAxis]:
    """The parts narrower than `width` become lines, the rest stays polygons.

    Returns
    -------
    polygons : Shape or None
    lines : MedialAxis
        The axis of the narrow parts.
    """
    shape, lines = _core.collapsed(axis_of(x)._core, width, trim)
    polygons = Shape._of(shape)
    return (polygons if len(polygons.points) else None), MedialAxis._of(lines)


# Lines along an axis.


@dataclass(frozen=True, eq=False)
class Line:
    """A line along an axis, such as a centre line.

    Attributes
    ----------
    axis : MedialAxis
        The line as an axis of one chain of exact edges, sampled if it is smoothed.
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
        """Rows of x, y and radius along the line."""
        parts = self.axis.sample(chord, step)
        if not parts:
            return np.empty((0, 3))
        return parts[0] if len(parts) == 1 else np.concatenate([parts[0], *(p[1:] for p in parts[1:])])

    def to_shapely(self, chord: float | None = None) -> Any:
        """A shapely LineString."""
        return need("shapely", "geo").LineString(self.coordinates(chord)[:, :2])

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        return {"type": "LineString", "coordinates": self.coordinates()[:, :2].tolist()}

    def widths(self, samples: int | npt.ArrayLike = 100) -> Widths:
        """The width along the line before it was extended or smoothed.

        Parameters
        ----------
        samples : int or array
            How many places, evenly; or lengths along the line.
        """
        if isinstance(samples, (int, np.integer)):
            at = np.linspace(0, self.length, int(samples))
        else:
            at = np.ascontiguousarray(samples, np.float64)
        rows = _core.widths(self._of._core, self._path, at)
        return Widths(rows[:, 0], rows[:, 1:3], rows[:, 3], rows[:, 4:6], rows[:, 6:8])


class Widths(NamedTuple):
    """The width of a shape at places along a line."""

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
        """The length of the transect, from foot to foot."""
        span: Floats = np.hypot(*(self.left - self.right).T)
        return span

    def to_pandas(self) -> Any:
        """A table of the same."""
        columns = {"along": self.along, "width": self.width, "span": self.span,
                   "x": self.center[:, 0], "y": self.center[:, 1]}  # fmt: skip
        return need("pandas", "all").DataFrame(columns)

    def transects(self) -> Any:
        """A shapely LineString from foot to foot for each place."""
        return need("shapely", "geo").linestrings(np.stack([self.left, self.right], axis=1))


def _line(of: MedialAxis, path: _core.Path, extend: bool, smooth: float) -> Line:
    made = MedialAxis._of(_core.centre_line(of._core, path, extend, smooth))
    return Line(made, path.length, path.narrowest, path.closed, path, of)


def _place(of: MedialAxis, point: Sequence[float]) -> tuple[int, float]:
    x, y = point
    place = _core.place_at(of._core, (x, y))
    if place is None:
        raise MedialError("the shape's axis is a single point", "invalid_option")
    return place


def centerlines(x: Any, *, trim: float = 1, route: str = "roomy", extend: bool = False,
                smooth: float = 0) -> list[Line]:  # fmt: skip
    """The main path of each connected part.

    Parameters
    ----------
    x : MedialAxis or geometry
    trim : float
        What protrudes from a disk by less than so many of its radii is cut from the ends; 0:
        lines run into the corners.
    route : {"roomy", "shortest"}
        Which way around holes.
    extend : bool
        Extend both ends to the boundary.
    smooth : float
        Average over so many radii.
    """
    of = axis_of(x)
    return [_line(of, path, extend, smooth) for path in _core.main_paths(of._core, trim, route)]


def centerline(x: Any, start: Sequence[float] | None = None, end: Sequence[float] | None = None, *,
               trim: float = 1, route: str = "roomy", extend: bool = False,
               smooth: float = 0) -> Line:  # fmt: skip
    """The centre line of a shape: of several parts, the longest.

    Parameters
    ----------
    x : MedialAxis or geometry
    start, end : (x, y), optional
        Where the line begins and ends, instead of the two ends that are farthest apart.
    trim, route, extend, smooth
        See :func:`centerlines`.

    Examples
    --------
    >>> import medial
    >>> line = medial.centerline([(0, 0), (10, 0), (10, 2), (0, 2)], extend=True)
    >>> line.length, line.coordinates()[[0, -1], :2].tolist()
    (8.0, [[10.0, 1.0], [0.0, 1.0]])
    """
    of = axis_of(x)
    if (start is None) != (end is None):
        raise ValueError("start and end go together")
    if start is not None and end is not None:
        path = _core.path_between(of._core, _place(of, start), _place(of, end), route)
        return _line(of, path, extend, smooth)
    paths = _core.main_paths(of._core, trim, route)
    if not paths:
        raise MedialError("the axis has no edge", "empty")
    return _line(of, max(paths, key=lambda path: path.length), extend, smooth)


centreline = centerline
centrelines = centerlines


def widest_path(x: Any, start: Sequence[float], end: Sequence[float], *, extend: bool = False,
                smooth: float = 0) -> Line:  # fmt: skip
    """The way between two places along which the largest disk can pass, of those the shortest."""
    of = axis_of(x)
    path = _core.path_between(of._core, _place(of, start), _place(of, end), "widest")
    return _line(of, path, extend, smooth)


# Widths.


def width_profile(x: Any, samples: int | npt.ArrayLike = 100, **given: Any) -> Widths:
    """The width along the centre line; further options are those of :func:`centerline`.

    Examples
    --------
    >>> import medial
    >>> medial.width_profile([(0, 0), (10, 0), (10, 2), (0, 2)], 3).width
    array([2., 2., 2.])
    """
    return (x if isinstance(x, Line) else centerline(x, **given)).widths(samples)


def transects(x: Any, count: int = 10, **given: Any) -> Widths:
    """Lines from side to side at `count` places, evenly along the centre line."""
    line = x if isinstance(x, Line) else centerline(x, **given)
    return line.widths((np.arange(count) + 0.5) * (line.length / count))


def mean_width(x: Any, **given: Any) -> dict[str, float]:
    """Mean widths: by length, by area, and area by length."""
    line = centerline(x, **given)
    return _core.mean_widths(line._of._core, line._path)


class Neck(NamedTuple):
    """A place narrower than what lies on both sides of it."""

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
        """By how much the width grows on both sides."""
        return 2 * (self.opens_to - self.radius)


def necks(x: Any, widening: float = 1.1) -> list[Neck]:
    """The necks of a shape: those that separate it by decreasing prominence, then others."""
    rows = _core.necks(axis_of(x)._core, widening).tolist()
    return [Neck(r[1], r[2], r[3], (r[4], r[5]), (r[6], r[7]), r[8], bool(r[9])) for r in rows]


class Circle(NamedTuple):
    """A circle."""

    x: float
    y: float
    radius: float

    def to_shapely(self, quad_segs: int = 64) -> Any:
        """A shapely Polygon near to it."""
        return need("shapely", "geo").Point(self.x, self.y).buffer(self.radius, quad_segs)


def maximum_inscribed_circle(x: Any) -> Circle:
    """The largest circle inside of a shape; of several, one.

    Of an axis its deepest disk; of anything else found without an axis, which is much sooner for
    large shapes.

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
    """The largest circles without overlap, by decreasing radius: each in what the others leave."""
    shape = x.shape._core if isinstance(x, MedialAxis) else load(x)[0]
    return [Circle(*row) for row in _core.disjoint_disks(shape, count, smallest).tolist()]


# Offsets.


@dataclass(frozen=True, eq=False)
class Region:
    """A connected part of what is farther than a distance from the boundary.

    Attributes
    ----------
    distance : float
        From the boundary, negative outside of the shape.
    rings : list of (points, bulges)
        The outer ring, then the holes; a bulge is of the edge after a point.
    parent : int
        The index of the region around it at the next smaller distance; -1: none.
    """

    distance: float
    rings: list[tuple[Floats, Floats]]
    parent: int
    area: float
    length: float

    def polygon(self, chord: float | None = None) -> list[Floats]:
        """Closed rings in which arcs are chords at most `chord` away."""
        return [_flattened(points, bulges, chord) for points, bulges in self.rings]

    def to_shapely(self, chord: float | None = None) -> Any:
        """A shapely Polygon."""
        rings = self.polygon(chord)
        return need("shapely", "geo").Polygon(rings[0], rings[1:])

    @property
    def __geo_interface__(self) -> dict[str, Any]:
        return {"type": "Polygon", "coordinates": [ring.tolist() for ring in self.polygon()]}


def _flattened(points: Floats, bulges: Floats, chord: float | None) -> Floats:
    """A closed ring with arcs as chords."""
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
        From the boundary: positive inwards, negative outwards.

    Returns
    -------
    list of Region
        By increasing distance. Those of one distance are disjoint.

    Examples
    --------
    >>> import medial
    >>> [region.area for region in medial.offset([(0, 0), (4, 0), (4, 4), (0, 4)], 1)]
    [4.0]
    """
    values = np.atleast_1d(np.asarray(distances, np.float64))
    if isinstance(x, MedialAxis) and (values > 0).all() and not x.exterior and not x.resolution:
        return _regions(_core.inward_offsets(x._core, values))
    shape = x.shape._core if isinstance(x, MedialAxis) else load(x)[0]
    return _regions(_core.offsets_of(shape, values, options.threads if threads is None else threads))


def buffer(x: Any, distances: float | Sequence[float] | Floats, *, bulges: npt.ArrayLike | None = None,
           node_crossings: bool = True, threads: int | None = None) -> list[Region]:  # fmt: skip
    """What is nearer than a distance to points, lines and arcs.

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
    values = np.atleast_1d(np.asarray(distances, np.float64))
    own = None if bulges is None else np.ascontiguousarray(bulges, np.float64)
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


# Tool paths.


@dataclass(frozen=True, eq=False)
class Carving:
    """The paths of a V-shaped tool.

    Attributes
    ----------
    paths : list of (kind, rows)
        Kinds are clearing, wall and groove; rows x, y, z and the bulge of the move after them.
    numbers : dict
        deepest, flat_from, cut_length, travel_length and others.
    """

    paths: list[tuple[str, Floats]]
    passes: list[int]
    numbers: dict[str, float]

    @property
    def deepest(self) -> float:
        """The largest depth."""
        return self.numbers["deepest"]

    def to_gcode(self, *, safe: float = 5, feed: float = 1000, plunge: float = 300,
                 spindle: float = 0, y_down: bool = False) -> str:  # fmt: skip
        """The paths as plain G-code in millimetres, as the command line writes them."""
        from ._gcode import program

        return program(self.paths, safe, feed, plunge, spindle, y_down)

    def __iter__(self) -> Iterator[tuple[str, Floats]]:
        return iter(self.paths)

    def __repr__(self) -> str:
        return f"<medial.Carving: {len(self.paths)} paths, {self.deepest:.6g} deep>"


def carve(x: Any, *, angle: float = 90, depth: float = 0, tool: float = 0, tip: float = 0,
          pass_depth: float = 0, step: float = 0, chord: float = 0) -> Carving:  # fmt: skip
    """Tool paths that carve a shape with a cone.

    Parameters
    ----------
    x : MedialAxis or geometry
    angle : float
        Between the sides of the cone, in degrees; 0: an end mill.
    depth : float
        At most; 0: as deep as the tool reaches.
    tool, tip : float
        The largest diameter, and that of a flat tip.
    pass_depth, step, chord : float
        Depth of one pass, width between clearing passes, largest error of straight moves.

    Examples
    --------
    >>> import medial
    >>> medial.carve([(0, 0), (4, 0), (4, 2), (0, 2)]).deepest
    1.0...
    """
    given = {"angle": angle, "depth": depth, "tool": tool, "tip": tip,
             "pass_depth": pass_depth, "step": step, "chord": chord}  # fmt: skip
    numbers, paths = _core.carved(axis_of(x)._core, given)
    return Carving([(kind, rows) for kind, _, rows in paths], [p for _, p, _ in paths], numbers)


# What a shape is made of.


def features(x: Any) -> dict[str, Any]:
    """What a shape is made of: counts and sums, and tables of branches and of their runs.

    Tables are pandas DataFrames where pandas is installed, otherwise dictionaries of columns.

    Examples
    --------
    >>> import medial
    >>> medial.features([(0, 0), (4, 0), (4, 2), (0, 2)])["ends"]
    4
    """
    result = _core.described(axis_of(x)._core)
    try:
        import pandas
    except ImportError:
        return result
    for name in ("branches", "runs"):
        result[name] = pandas.DataFrame(result[name])
    return result


@dataclass(frozen=True)
class Match:
    """One shape of a collection and how unlike it is."""

    index: int
    dissimilarity: float


def match(x: Any, others: Sequence[Any], *, threads: int | None = None) -> list[Match]:
    """How unlike other shapes are, the most similar first.

    The measure is 0 for the same shape, rotated, scaled or mirrored, and about 1 for two shapes
    at random.
    """
    some = options.threads if threads is None else threads
    own = _core.signature_of(load(x)[0], some)
    found = [
        Match(i, _core.dissimilarity(own, _core.signature_of(load(other)[0], some)))
        for i, other in enumerate(others)
    ]
    return sorted(found, key=lambda one: (one.dissimilarity, one.index))


# Checks.


@dataclass(frozen=True)
class Certificate:
    """The measured errors of an axis against its shape."""

    passed: bool
    failures: list[str]
    numbers: dict[str, Any]

    def __bool__(self) -> bool:
        return self.passed

    def __getattr__(self, name: str) -> Any:
        try:
            return self.__dict__["numbers"][name]
        except KeyError:
            raise AttributeError(name) from None


def verify(x: MedialAxis, shape: Any = None, *, tolerance: float = 0, samples: int = 8,
           corner_angle: float = 0.01, threads: int | None = None) -> Certificate:  # fmt: skip
    """Checks an axis against its shape, or another one.

    Examples
    --------
    >>> import medial
    >>> medial.verify(medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])).passed
    True
    """
    of = x
    if shape is not None:
        of = MedialAxis._of(_rebound(x, Shape._of(load(shape)[0])))
    numbers = _core.certificate(of._core, tolerance, samples, corner_angle,
                                options.threads if threads is None else threads)  # fmt: skip
    return Certificate(numbers.pop("passed"), numbers.pop("failures"), numbers)


def _rebound(x: MedialAxis, shape: Shape) -> _core.Axis:
    from ._axis import restored

    return restored(shape, *x._state())._core


def compare(x: Any, methods: Sequence[str] = ("disks", "lee", "biarc-dc"), **given: Any) -> list[dict[str, Any]]:
    """The axes of one shape by several methods: counts, lengths, seconds, and what went wrong."""
    shape, rows = Shape(x), []
    for name in methods:
        row: dict[str, Any] = {"method": name}
        try:
            own = axis(shape, name, **given)
        except MedialError as error:
            row["error"] = error
        else:
            row.update(axis=own, nodes=len(own.nodes), edges=len(own.edges), length=own.length,
                       seconds=own.statistics["seconds"])  # fmt: skip
        rows.append(row)
    return rows


def distance(a: Any, b: Any, samples: int = 7) -> dict[str, Any]:
    """The areas of two shapes and the Hausdorff distance of their boundaries, measured."""
    return _core.shape_distance(load(a)[0], load(b)[0], samples)


def legality(x: MedialAxis, samples: int = 8) -> Floats:
    """Of each branch by how much it misses two conditions that every axis meets; 0 or less: not.

    Rows of the largest abs(dr/ds) - 1 and the largest excess of the curvature.
    """
    return _core.legality(x._core, samples)


# Codes.


@dataclass(frozen=True)
class Pack:
    """A compact code of a shape within an error."""

    streams: tuple[bytes, ...]
    disks: int
    quantum: float

    @property
    def nbytes(self) -> int:
        """The number of bytes, compressed by zlib."""
        import zlib

        return sum(len(zlib.compress(stream, 9)) for stream in self.streams)

    def unpack(self) -> MedialAxis:
        """The axis of disks, with the shape that they cover."""
        return MedialAxis._of(_core.unpacked(list(self.streams)))


def pack(x: Any, error: float) -> Pack:
    """Codes a shape so that it and the unpacked one lie within `error` of each other.

    Examples
    --------
    >>> import medial
    >>> round(medial.pack([(0, 0), (4, 0), (4, 2), (0, 2)], 0.01).unpack().shape.area)
    8
    """
    streams, disks, _, quantum = _core.packed(axis_of(x)._core, error)
    return Pack(tuple(streams), disks, quantum)


def unpack(code: Pack) -> MedialAxis:
    """The axis of a code, with the shape that its disks cover."""
    return code.unpack()


# Other methods.


class Field:
    """The generalised potential of a charged border; made by :func:`field`."""

    def __init__(self, core: _core.Field) -> None:
        self._core = core

    def sample(self, points: npt.ArrayLike) -> dict[str, Floats]:
        """The logarithm of the potential, the direction of the force, the clearance; NaN outside."""
        rows = self._core.sample(points_of(points))
        return {"log_potential": rows[:, 0], "direction": rows[:, 1:3], "clearance": rows[:, 3]}

    def streamline(self, point: Sequence[float], step: float, most: int = 1000) -> Floats:
        """The force line from a point: rows of x and y."""
        x, y = point
        return self._core.streamline((x, y), step, most)


def field(x: Any, order: float = 2) -> Field:
    """The integral of 1 / r^order along the border of a shape.

    Examples
    --------
    >>> import medial
    >>> f = medial.field([(0, 0), (4, 0), (4, 2), (0, 2)])
    >>> f.sample([(2, 0.25)])["clearance"]
    array([0.25])
    """
    return Field(_core.field_of(load(x)[0], order))


def curve_axis(x: Any, *, fit: float = 0, **own: Any) -> MedialAxis:
    """The axis of one smooth closed curve, followed from its maxima of curvature.

    Parameters
    ----------
    x : Contour or geometry
    fit : float
        Polygons become smooth curves within this distance first.
    **own
        `step` and `first_maximum`.
    """
    return axis(x, "curve-axis", fit=fit, **own)


