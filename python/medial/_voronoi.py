"""Voronoi diagrams of points, segments and arcs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import MedialError, need
from ._options import computing, options
from ._read import chains_of
from ._records import NODE, SITE, Floats, Indices, Records, numbers_of, points_of, records
from ._shape import load


class NearestSites(NamedTuple):
    """The nearest site of each point; -1 if there is none."""

    site: Indices
    distance: Floats
    foot: Floats


class Voronoi:
    """The Voronoi diagram of points, segments and arcs, within an enclosure; made by `voronoi`.

    Sites are first the points, then the edges between them, not in the order of the input: the
    fields ``ring`` and ``vertex`` of a site give its line and vertex in the input, from 0.
    """

    __slots__ = ("_core", "_inside", "_locator")

    def __init__(self, core: _core.Voronoi, inside: bool = False) -> None:
        self._core = core
        self._inside = inside
        self._locator: _core.SiteLocator | None = None

    @property
    def sites(self) -> Records:
        """Fields as in `MedialAxis.sites`; the kind of a point is vertex."""
        return records(self._core.sites(), SITE)

    @property
    def nodes(self) -> Records:
        """Fields as in `MedialAxis.nodes`."""
        return records(self._core.nodes(), NODE)

    @property
    def edges(self) -> dict[str, npt.NDArray[Any]]:
        """Columns: node (from, to), site (left, right), spoke, frame."""
        node, site, spoke, frame = self._core.edge_columns()
        return {"node": node, "site": site, "spoke": spoke.astype(bool), "frame": frame.astype(bool)}

    @property
    def frame(self) -> tuple[float, float, float, float]:
        """The enclosure: min x, min y, max x, max y."""
        a, b, c, d = self._core.frame()
        return a, b, c, d

    def _chord(self, chord: float | None) -> float:
        if chord:
            return chord
        box = np.reshape(self.frame, (2, 2)) if not self._inside else self.sites["start"]
        return options.chord * float(np.hypot(*np.ptp(box, axis=0)))

    def cells(self, chord: float | None = None) -> list[Floats]:
        """The Voronoi cell of each site as rows of x and y; may be empty.

        Parameters
        ----------
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal.

        Examples
        --------
        >>> import medial
        >>> v = medial.voronoi([(0.0, 0.0), (4.0, 0.0)])
        >>> len(v.cells())
        2
        """
        points, begin = self._core.outlines(self._chord(chord))
        cells = np.split(points, begin[1:-1])
        return [_closed(cell, site) for cell, site in zip(cells, self.sites, strict=True)] if self._inside else cells

    def lines(self, chord: float | None = None) -> tuple[Floats, Indices]:
        """The edges as rows of x, y and radius, and the first row of each.

        Parameters
        ----------
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal.

        Examples
        --------
        >>> import medial
        >>> v = medial.voronoi([(0.0, 0.0), (4.0, 0.0)])
        >>> points, begin = v.lines()
        >>> points.shape[1]
        3
        """
        points, begin = self._core.edge_lines(self._chord(chord))
        return points, begin

    def to_shapely(self, chord: float | None = None) -> Any:
        """The cells as an array of shapely Polygons, empty ones included.

        Parameters
        ----------
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal.

        Examples
        --------
        >>> import medial
        >>> v = medial.voronoi([(0.0, 0.0), (4.0, 0.0)])
        >>> [cell.geom_type for cell in v.to_shapely()]
        ['Polygon', 'Polygon']
        """
        shapely = need("shapely", "geo")
        return np.array([shapely.Polygon(cell) for cell in self.cells(chord)], dtype=object)

    def nearest(self, points: npt.ArrayLike) -> NearestSites:
        """The nearest site of each point.

        Parameters
        ----------
        points : array of shape (n, 2)
            In units of the input.

        Examples
        --------
        >>> import medial
        >>> v = medial.voronoi([(0.0, 0.0), (4.0, 0.0)])
        >>> v.sites["ring"][v.nearest([(1, 1), (3.5, 0)]).site]
        array([0, 1], dtype=uint32)
        """
        if self._locator is None:
            self._locator = self._core.locator()
        return NearestSites(*self._locator.nearest(points_of(points)))

    def verify(self) -> dict[str, Any]:
        """The measured errors of the diagram.

        Examples
        --------
        >>> import medial
        >>> v = medial.voronoi([(0.0, 0.0), (4.0, 0.0)])
        >>> v.verify()["passed"]
        True
        """
        return self._core.verify()

    def __repr__(self) -> str:
        return f"<medial.Voronoi: {len(self.sites)} sites, {len(self.nodes)} nodes>"


def _closed(cell: Floats, site: Any) -> Floats:
    """The cell of a side of a polygon, from the edges of the diagram along the side."""
    side = [end for end in (site["start"], site["end"]) if len(cell) and not (cell == end).all(axis=1).any()]
    return np.concatenate([cell, side]) if side else cell


def voronoi(
    x: Any,
    *,
    method: str = "disks",
    enclosure: Sequence[float] | None = None,
    margin: float = 0,
    frame: Sequence[float] | None = None,
    node_crossings: bool = False,
    bulges: npt.ArrayLike | None = None,
    threads: int | None = None,
) -> Voronoi:
    """The Voronoi diagram of points, lines and rings.

    Parameters
    ----------
    x : geometry
        Rows of x and y (points), shapely geometries, GeoJSON, or a list of lines.
    method : {"disks", "lee"}
        ``"disks"``: of all points and lines, within an enclosure; ``"lee"``: inside a polygon.
        If rounding decides, `disks` computes the diagram instead.
    enclosure : (min x, min y, max x, max y), optional
        The rectangle that bounds the diagram, in units of the input. `frame` is an alias.
    margin : float
        Without an enclosure: its distance from the input; 0: half of the longer side.
    node_crossings : bool
        Whether lines may cross.
    bulges : array, optional
        The bulge of the edge after each vertex.

    Examples
    --------
    >>> import medial
    >>> len(medial.voronoi([(0.0, 0.0), (4.0, 0.0), (2.0, 3.0)]).cells())
    3
    """
    if method == "lee":
        return Voronoi(_core.voronoi_inside(load(x)[0], computing("lee", threads=threads)), inside=True)
    if method != "disks":
        raise ValueError("method is 'disks' or 'lee'")
    frame = enclosure if frame is None else frame
    coordinates, begin, closed = chains_of(x)
    own = None if bulges is None else np.ascontiguousarray(numbers_of(bulges, "bulges must be numbers"))
    box = None if frame is None else numbers_of(frame, "an enclosure must be four numbers").tolist()
    if box is not None and np.shape(box) != (4,):
        raise MedialError("an enclosure must be four numbers: min x, min y, max x, max y")
    computed = computing("disks", threads=threads, margin=margin)
    return Voronoi(_core.voronoi_of(coordinates, begin, closed, own, node_crossings, box, computed))
