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
from ._shape import load


class Change(NamedTuple):
    """What an edit has changed: numbers of nodes and edges, those that are removed first.

    New ones may get numbers of removed ones. `everything`: all was computed again.
    """

    removed_nodes: Indices
    removed_edges: Indices
    added_nodes: Indices
    added_edges: Indices
    vertex: int
    everything: bool


class Editor:
    """A shape of straight edges with its axis, which follows when vertices move, come and go.

    The axis is that of `axis`, repaired where an edit changes it. Vertices keep their numbers;
    so do sites, nodes and edges, except where ``Change.everything`` is set. A new editor counts
    vertices as ``Shape.points`` does. An edit that makes edges cross raises `MedialError` with the
    place, and changes nothing.

    Parameters
    ----------
    x
        A geometry, as `axis` takes it.
    tolerance : float, optional
        As of `axis`.

    Examples
    --------
    >>> import medial
    >>> editor = medial.Editor([(0, 0), (4, 0), (4, 2), (0, 2)])
    >>> change = editor.move(2, (5, 2))
    >>> editor.axis.edges["node"].shape, len(change.added_edges)
    ((5, 2), 5)
    """

    __slots__ = ("_core",)

    def __init__(self, x: Any, *, tolerance: float = 0) -> None:
        shape, _ = load(x)
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

    def undo(self) -> Change:
        """Takes the last edit back, and those before, one by one; nothing where there is none.

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
        """An editor of its own in the same state.

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
        other._core = self._core.copy()
        return other

    def vertex(self, number: int) -> tuple[float, float] | None:
        """The place of a vertex; None where there is no such vertex.

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

    def nodes(self, numbers: npt.ArrayLike) -> Records:
        """The nodes of these numbers, as `MedialAxis.nodes`.

        Parameters
        ----------
        numbers : array of int
            As a `Change` has them.

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
        """The edges of these numbers, as `MedialAxis.edges`; they name nodes and sites by numbers.

        Parameters
        ----------
        numbers : array of int
            As a `Change` has them.

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
        """The sites of these numbers, as `MedialAxis.sites`.

        Parameters
        ----------
        numbers : array of int
            As edges name them.

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
        """All of the axis, with its shape, as it is now; nodes and edges count from 0 without gaps."""
        return MedialAxis._of(self._core.axis())


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
