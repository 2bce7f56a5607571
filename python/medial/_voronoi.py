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
    """The nearest site of each of many points; -1 where there is none."""

    site: Indices
    distance: Floats
    foot: Floats


class Voronoi:
    """The Voronoi diagram of points, segments and arcs, within a frame; made by `voronoi`.

    Sites are the points first, then the edges between them, in an order of their own: the fields
    ``ring`` and ``vertex`` of a site are the line and the vertex of the input, from 0.
    """

    __slots__ = ("_core", "_inside", "_locator")

    def __init__(self, core: _core.Voronoi, inside: bool = False) -> None:
        self._core = core
        self._inside = inside
        self._locator: _core.SiteLocator | None = None

    @property
    def sites(self) -> Records:
        """As `MedialAxis.sites`; kind vertex: a point."""
        return records(self._core.sites(), SITE)

    @property
    def nodes(self) -> Records:
        """As `MedialAxis.nodes`."""
        return records(self._core.nodes(), NODE)

    @property
    def edges(self) -> dict[str, npt.NDArray[Any]]:
        """Columns: node (from, to), site (left, right), spoke, frame."""
        node, site, spoke, frame = self._core.edge_columns()
        return {"node": node, "site": site, "spoke": spoke.astype(bool), "frame": frame.astype(bool)}

    @property
    def frame(self) -> tuple[float, float, float, float]:
        """The enclosure: low x, low y, high x, high y."""
        a, b, c, d = self._core.frame()
        return a, b, c, d

    def _chord(self, chord: float | None) -> float:
        if chord:
            return chord
        box = np.reshape(self.frame, (2, 2)) if not self._inside else self.sites["start"]
        return options.chord * float(np.hypot(*np.ptp(box, axis=0)))

    def cells(self, chord: float | None = None) -> list[Floats]:
        """The Voronoi cell of each site, as rows of x and y; empty where it is.

        Parameters
        ----------
        chord : float, optional
            How far chords may be from curves, in units of the input; by default
            ``medial.options.chord`` of the diagonal.

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
        """The edges as rows of x, y and radius, and where each begins.

        Parameters
        ----------
        chord : float, optional
            How far chords may be from curves, in units of the input; by default
            ``medial.options.chord`` of the diagonal.

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
            How far chords may be from curves, in units of the input; by default
            ``medial.options.chord`` of the diagonal.

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
    """The cell of a side of a polygon: what leads from edges of the diagram along the side."""
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
        Rows of x and y are points; shapely geometries, GeoJSON or lists of lines are as they are.
    method : {"disks", "lee"}
        Of everything together, within an enclosure; or inside of a polygon without holes.
    enclosure : (low x, low y, high x, high y), optional
        In units of the input; also as `frame`.
    margin : float
        How far the enclosure is, without one; 0: half of the longer side.
    node_crossings : bool
        Whether lines may cross.
    bulges : array, optional
        Of each coordinate's edge.

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
        raise MedialError("an enclosure must be four numbers: low x, low y, high x, high y")
    computed = computing("disks", threads=threads, margin=margin)
    return Voronoi(_core.voronoi_of(coordinates, begin, closed, own, node_crossings, box, computed))
