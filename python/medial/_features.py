"""What a shape is made of, how alike shapes are, and how they interlock."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from . import _core
from ._axis import axis_of, described
from ._options import options
from ._shape import Shape, load


def features(x: Any, **thresholds: float) -> dict[str, Any]:
    """What a shape is made of: counts and sums, and tables of branches and of their runs.

    Tables are pandas DataFrames where pandas is installed, otherwise dictionaries of columns.

    Parameters
    ----------
    x : MedialAxis or geometry
    **thresholds
        Without a unit: `parallel` (0.05) and `even` (0.1), by how much a worm's radius changes, of
        its length and of its mean; `bend` (0.1), by how much the rate of a cup's or flare's radius
        changes; `turn` (0.1), by how many radians a straight run turns; `spiral` (0.5), by how much
        a spiral's curvature changes; `shortest` (0.25), by their radius, runs join a neighbour.

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
    """One shape of a collection and how unlike it is."""

    index: int
    dissimilarity: float


def match(x: Any, others: Sequence[Any], *, best: int | None = None, threads: int | None = None) -> list[Match]:
    """How unlike other shapes are, the most similar first.

    The measure is 0 for the same shape, rotated, scaled or mirrored, and about 1 for two shapes
    at random.

    Parameters
    ----------
    x : geometry
    others : sequence of geometries
    best : int, optional
        Return so many at most.
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
    """Where a shape lies: mirrored (x to -x), then turned about the origin, then moved.

    Attributes
    ----------
    angle : float
        In radians.
    mirrored : bool
    move, bay : (x, y)
        The way it moves, and the bottom of the bay that a peninsula lies in.
    saved : float
        By how much the convex hull of both is smaller than their own hulls.
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
        """The shape in this place."""
        return Shape._of(_core.placed(load(x)[0], self.angle, self.mirrored, self.move))


def nest(fixed: Any, moving: Any, *, gap: float = 0, mirror: bool = True, best: int = 5) -> list[Placement]:
    """Lays a shape into the bays of another one, and the other way round.

    Parameters
    ----------
    fixed, moving : geometry
        Each of one connected part.
    gap : float
        The least distance between them, in units of the input.
    mirror : bool
        Whether the shape may be turned over.
    best : int
        At most so many placements.

    Returns
    -------
    list of Placement
        Those that save most area first.

    Raises
    ------
    MedialError
        With the code ``"unsupported"``: a shape of several parts.

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
