"""Features of shapes, and shapes compared and nested."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from . import _core
from ._axis import axis_of, described
from ._options import options
from ._shape import Shape, load


def features(x: Any, **thresholds: float) -> dict[str, Any]:
    """The features of a shape: counts, sums, and tables of branches and of their runs.

    Tables are pandas DataFrames if pandas is installed, else dictionaries of columns.

    Parameters
    ----------
    x : MedialAxis or geometry
    **thresholds
        Limits without a unit: `parallel` (0.05) and `even` (0.1), the change of a worm's radius as
        a share of its length and of its mean; `bend` (0.1), the change of the slope of a cup's or
        flare's radius; `turn` (0.1), the turning of a straight run in radians; `spiral` (0.5), the
        change of a spiral's curvature; `shortest` (0.25): runs below this share of their radius
        join a neighbour.

    Examples
    --------
    >>> import medial
    >>> medial.features([(0, 0), (4, 0), (4, 2), (0, 2)])["ends"]
    4
    """
    result = described(axis_of(x)._core, **thresholds)
    try:
        import pandas
    except ImportError:
        return result
    for name in ("branches", "runs"):
        result[name] = pandas.DataFrame(result[name])
    return result


@dataclass(frozen=True)
class Match:
    """One shape of a collection and its dissimilarity."""

    index: int
    dissimilarity: float


def match(x: Any, others: Sequence[Any], *, best: int | None = None, threads: int | None = None) -> list[Match]:
    """Ranks other shapes by their dissimilarity to x, most similar first.

    The dissimilarity is 0 for the same shape, also if rotated, scaled or mirrored, and about 1
    for two random shapes.

    Parameters
    ----------
    x : geometry
    others : sequence of geometries
    best : int, optional
        Return at most this many.
    threads : int, optional

    Returns
    -------
    list of Match

    Examples
    --------
    >>> import medial
    >>> square, bar, turned = [(0, 0), (2, 0), (2, 2), (0, 2)], [(0, 0), (9, 0), (9, 1), (0, 1)], [(2, 0), (4, 2), (2, 4), (0, 2)]
    >>> medial.match(square, [bar, turned], best=1)[0].index
    1
    """
    some = options.threads if threads is None else threads
    own = _core.signature_of(load(x)[0], some)
    found = [
        Match(i, _core.dissimilarity(own, _core.signature_of(load(other)[0], some)))
        for i, other in enumerate(others)
    ]
    return sorted(found, key=lambda one: (one.dissimilarity, one.index))[:best]


@dataclass(frozen=True)
class Placement:
    """A rigid motion: mirrored (x to -x), then rotated about the origin, then moved.

    Attributes
    ----------
    angle : float
        In radians.
    mirrored : bool
    move, bay : (x, y)
        The translation, and the bottom of the bay that a peninsula lies in.
    saved : float
        The area of both convex hulls less that of their common hull.
    gap : float
        The least distance between the shapes.
    """

    angle: float
    mirrored: bool
    move: tuple[float, float]
    bay: tuple[float, float]
    saved: float
    gap: float

    def placed(self, x: Any) -> Shape:
        """The shape x moved to this placement."""
        return Shape._of(_core.placed(load(x)[0], self.angle, self.mirrored, self.move))


def nest(fixed: Any, moving: Any, *, gap: float = 0, mirror: bool = True, best: int = 5) -> list[Placement]:
    """Places a shape so that peninsulas of either shape are in bays of the other.

    Parameters
    ----------
    fixed, moving : geometry
        Each must be connected.
    gap : float
        The least distance between them, in units of the input.
    mirror : bool
        Whether the shape may be mirrored.
    best : int
        Return at most this many placements.

    Returns
    -------
    list of Placement
        Sorted by `saved`, largest first.

    Raises
    ------
    MedialError
        With the code ``"unsupported"`` if a shape has several parts.

    Examples
    --------
    >>> import medial
    >>> ell = [(0, 0), (6, 0), (6, 2), (2, 2), (2, 6), (0, 6)]
    >>> place = medial.nest(ell, ell, best=1)[0]
    >>> round(place.placed(ell).area), place.saved > 5
    (20, True)
    """
    rows = _core.nested(load(fixed)[0], load(moving)[0], gap, mirror, best)
    return [Placement(angle, mirrored, tuple(move), tuple(bay), saved, least)
            for angle, mirrored, move, bay, saved, least in rows]  # fmt: skip
