"""Axes that follow edits of their shapes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._axis import MedialAxis
from ._errors import MedialError
from ._options import computing
from ._records import EDGE, NODE, SITE, Indices, Records, records
from ._shape import Shape, load


class Change(NamedTuple):
    """What an edit has changed: the numbers of nodes and edges that it removed and added.

    New nodes and edges may get the numbers of removed ones. If `everything` is set, the whole
    axis was computed again.
    """

    removed_nodes: Indices
    removed_edges: Indices
    added_nodes: Indices
    added_edges: Indices
    vertex: int
    everything: bool


class Editor:
    """A shape and its axis, which follows when vertices, edges and loops change.

    The axis equals that of `axis`; an edit repairs it only where it changes. Vertices keep their
    numbers; sites, nodes and edges do, too, unless ``Change.everything`` is set. A new editor
    numbers vertices as ``Shape.points`` does. An edit that makes edges cross raises `MedialError`
    with the place, and changes nothing.

    Parameters
    ----------
    x
        A geometry without curves; see `axis`.
    tolerance : float, optional
        See `axis`.

    Examples
    --------
    >>> import medial
    >>> editor = medial.Editor([(0, 0), (4, 0), (4, 2), (0, 2)])
    >>> change = editor.move(2, (5, 2))
    >>> editor.axis.edges["node"].shape, len(change.added_edges)
    ((5, 2), 5)
    """

    __slots__ = ("_core", "_attributes")

    def __init__(self, x: Any, *, tolerance: float = 0) -> None:
        shape, _ = load(x)
        self._attributes = dict(x.attributes) if isinstance(x, Shape) else {}
        self._core = _core.editor_of(shape, computing("disks", tolerance=tolerance))

    def move(self, vertex: int, to: Sequence[float]) -> Change:
        """Moves a vertex.

        Parameters
        ----------
        vertex : int
            Its number.
        to : (x, y)
            In units of the input.

        Examples
        --------
        >>> import medial
        >>> editor = medial.Editor([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> editor.move(0, (-1, 0)).vertex
        0
        """
        return Change(*self._core.move(vertex, _place(to)))

    def insert(self, before: int, point: Sequence[float]) -> Change:
        """Inserts a vertex on the edge that begins at the vertex `before`.

        Parameters
        ----------
        before : int
            The number of a vertex.
        point : (x, y)
            In units of the input.

        Examples
        --------
        >>> import medial
        >>> editor = medial.Editor([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> editor.insert(0, (2, -1)).vertex
        4
        """
        return Change(*self._core.insert(before, _place(point)))

    def remove(self, vertex: int) -> Change:
        """Removes a vertex.

        Parameters
        ----------
        vertex : int
            Its number.

        Examples
        --------
        >>> import medial
        >>> editor = medial.Editor([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> _ = editor.remove(1)
        >>> len(editor.axis.edges)
        3
        """
        return Change(*self._core.remove(vertex))

    def set_bulge(self, vertex: int, bulge: float) -> Change:
        """Makes the edge that begins at a vertex an arc, or a segment.

        Parameters
        ----------
        vertex : int
            Its number.
        bulge : float
            The tangent of a quarter of the arc's angle: 0 straight, positive where it turns left.

        Examples
        --------
        >>> import medial
        >>> editor = medial.Editor([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> _ = editor.set_bulge(1, 0.5)
        >>> editor.bulge(1)
        0.5
        """
        return Change(*self._core.set_bulge(vertex, bulge))

    def insert_loop(self, points: npt.ArrayLike, bulges: npt.ArrayLike | None = None) -> Change:
        """Inserts a hole or an outer loop, depending on its place.

        Its vertices have the numbers from ``Change.vertex`` on, in their order.

        Parameters
        ----------
        points : array of (x, y)
            Closed or not, in any orientation.
        bulges : array, optional
            Of the edge after each point.

        Examples
        --------
        >>> import medial
        >>> editor = medial.Editor([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> editor.insert_loop([(1, 0.5), (2, 0.5), (1, 1.5)]).vertex
        4
        """
        try:
            places = np.ascontiguousarray(points, np.float64).reshape(-1, 2)
            own = np.ascontiguousarray([] if bulges is None else bulges, np.float64).reshape(-1)
        except (TypeError, ValueError) as error:
            raise MedialError("a loop is a list of places, and bulges are numbers", "malformed") from error
        return Change(*self._core.insert_loop(places.reshape(-1), own))

    def remove_loop(self, vertex: int) -> Change:
        """Removes the loop of a vertex.

        Parameters
        ----------
        vertex : int
            Its number.

        Examples
        --------
        >>> import medial
        >>> editor = medial.Editor([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> change = editor.insert_loop([(1, 0.5), (2, 0.5), (1, 1.5)])
        >>> _ = editor.remove_loop(change.vertex)
        >>> len(editor.axis.edges)
        5
        """
        return Change(*self._core.remove_loop(vertex))

    def move_loop(self, vertex: int, by: Sequence[float]) -> Change:
        """Moves the loop of a vertex.

        Parameters
        ----------
        vertex : int
            Its number.
        by : (x, y)
            How far.

        Examples
        --------
        >>> import medial
        >>> editor = medial.Editor([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> change = editor.insert_loop([(1, 0.5), (2, 0.5), (1, 1.5)])
        >>> _ = editor.move_loop(change.vertex, (0.5, 0))
        >>> editor.vertex(change.vertex)
        (1.5, 0.5)
        """
        return Change(*self._core.move_loop(vertex, _place(by)))

    def undo(self) -> Change:
        """Undoes the last edit that is not undone yet; without one, changes nothing.

        Examples
        --------
        >>> import medial
        >>> editor = medial.Editor([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> _ = editor.move(0, (-1, 0))
        >>> _ = editor.undo()
        >>> editor.vertex(0)
        (0.0, 0.0)
        """
        return Change(*self._core.undo())

    def copy(self) -> Editor:
        """An independent editor in the same state.

        Examples
        --------
        >>> import medial
        >>> editor = medial.Editor([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> other = editor.copy()
        >>> _ = other.move(0, (-1, 0))
        >>> editor.vertex(0)
        (0.0, 0.0)
        """
        other = Editor.__new__(Editor)
        other._core, other._attributes = self._core.copy(), self._attributes
        return other

    def vertex(self, number: int) -> tuple[float, float] | None:
        """The place of a vertex; None if it does not exist.

        Parameters
        ----------
        number : int

        Examples
        --------
        >>> import medial
        >>> medial.Editor([(0, 0), (4, 0), (4, 2), (0, 2)]).vertex(2)
        (4.0, 2.0)
        """
        place = self._core.vertex(number)
        return None if place is None else (place[0], place[1])

    def bulge(self, vertex: int) -> float | None:
        """The bulge of the edge that begins at a vertex; None where there is no such vertex.

        Parameters
        ----------
        vertex : int

        Examples
        --------
        >>> import medial
        >>> medial.Editor([(0, 0), (4, 0), (4, 2), (0, 2)]).bulge(0)
        0.0
        """
        return self._core.bulge(vertex)

    def nodes(self, numbers: npt.ArrayLike) -> Records:
        """The nodes with these numbers; fields as in `MedialAxis.nodes`.

        Parameters
        ----------
        numbers : array of int
            From a `Change`.

        Examples
        --------
        >>> import medial
        >>> editor = medial.Editor([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> change = editor.move(2, (5, 2))
        >>> len(editor.nodes(change.added_nodes))
        6
        """
        return records(self._core.nodes(_numbers(numbers)), NODE)

    def edges(self, numbers: npt.ArrayLike) -> Records:
        """The edges with these numbers; fields as in `MedialAxis.edges`, nodes and sites by number.

        Parameters
        ----------
        numbers : array of int
            From a `Change`.

        Examples
        --------
        >>> import medial
        >>> editor = medial.Editor([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> change = editor.move(2, (5, 2))
        >>> len(editor.edges(change.added_edges))
        5
        """
        return records(self._core.edges(_numbers(numbers)), EDGE)

    def sites(self, numbers: npt.ArrayLike) -> Records:
        """The sites with these numbers; fields as in `MedialAxis.sites`.

        Parameters
        ----------
        numbers : array of int
            From the field ``site`` of edges.

        Examples
        --------
        >>> import medial
        >>> editor = medial.Editor([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> change = editor.move(2, (5, 2))
        >>> sites = editor.edges(change.added_edges)["site"]
        >>> len(editor.sites(sites[:, 0]))
        5
        """
        return records(self._core.sites(_numbers(numbers)), SITE)

    @property
    def axis(self) -> MedialAxis:
        """The current axis with its shape; nodes and edges are numbered from 0 without gaps."""
        return MedialAxis._of(self._core.axis(), self._attributes)


def _place(point: Sequence[float]) -> tuple[float, float]:
    try:
        x, y = point
        return float(x), float(y)
    except (TypeError, ValueError) as error:
        raise MedialError("a place is a pair of x and y", "malformed") from error


def _numbers(numbers: npt.ArrayLike) -> npt.NDArray[np.int64]:
    values = np.asarray(numbers).reshape(-1)
    if len(values) and not np.issubdtype(values.dtype, np.integer):
        raise MedialError("numbers must be integers", "malformed")
    return np.ascontiguousarray(values, np.int64)
