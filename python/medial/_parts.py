"""Parts of axes, and shapes made from them."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _core
from ._axis import MedialAxis, axis, axis_of
from ._shape import Shape, load


def _without_specks(x: Any, share: float) -> MedialAxis:
    """The axis of x; with a share, the axis of x without specks."""
    if not share:
        return axis_of(x)
    shape = x.shape if isinstance(x, MedialAxis) else Shape(x)
    return axis(Shape._of(_core.without_specks(shape._core, share), shape.attributes))


def prune(x: Any, measure: str = "prominence", threshold: float | None = None, *,
          keep: int | None = None, tips: bool = False, specks: float = 0) -> MedialAxis:  # fmt: skip
    """The part of an axis that matters.

    Parameters
    ----------
    x : MedialAxis or geometry
    measure : str
        A name of `prune_measures`.
    threshold : float, optional
        By default the threshold of the measure; see `prune_measures`.
    keep : int, optional
        Instead: keep at most this many branches, and always the cycles.
    tips : bool
        Extend each end to a tip.
    specks : float
        First remove holes and parts whose bounding box has a diagonal below this share of the
        square root of the area; 0.1 is typical.

    Raises
    ------
    MedialError
        With the code ``"invalid_option"`` for an unknown measure, or a threshold below 0.

    Examples
    --------
    >>> import medial
    >>> a = medial.axis([(0, 0), (9, 0), (9, 2), (5, 2), (4.5, 2.1), (4, 2), (0, 2)])
    >>> a.branch_count, medial.prune(a, "erosion", 0.5).branch_count
    (7, 1)
    """
    return _without_specks(x, specks).prune(measure, threshold, keep=keep, tips=tips)


def prune_measures() -> dict[str, float]:
    """The measures of `prune` with their default thresholds.

    Examples
    --------
    >>> import medial
    >>> medial.prune_measures()["prominence"]
    0.25
    """
    return dict(_core.prune_measures())


def smooth(x: Any, measure: str = "prominence", threshold: float | None = None, *,
           keep: int | None = None, tips: bool = False, specks: float = 0, chord: float = 0,
           exterior: bool = False, margin: float = 0) -> Shape:  # fmt: skip
    """The shape of the pruned axis: rounds off bumps, or with `exterior` fills notches.

    Parameters
    ----------
    x : MedialAxis or geometry
    measure, threshold, keep, tips, specks
        See `prune`.
    chord : float
        Replace arcs by chords within this distance, in units of the input; 0: keep arcs.
    exterior : bool
        Fill notches instead, by the axis of the exterior.
    margin : float
        The distance of the exterior's enclosure from the shape; 0: half of the longer side.

    Returns
    -------
    Shape

    Examples
    --------
    >>> import medial
    >>> notched = [(0, 0), (9, 0), (9, 4), (5, 4), (4.5, 3.5), (4, 4), (0, 4)]
    >>> medial.smooth(notched, "significance", 9, exterior=True).area > 35.8
    True
    """
    if not exterior:
        return rebuild(_without_specks(x, specks).prune(measure, threshold, keep=keep, tips=tips), chord=chord)
    shape = x.shape._core if isinstance(x, MedialAxis) else load(x)[0]
    if specks:
        shape = _core.without_specks(shape, specks)
    around = axis(Shape._of(_core.surroundings(shape, margin)))
    return _inside(rebuild(around.prune(measure, threshold, keep=keep, tips=tips), chord=chord))


def _inside(around: Shape) -> Shape:
    """The shape enclosed by an exterior: its loops without the rectangle, which is leftmost."""
    points, starts = around.points, around.loop_begin.tolist()
    parts = [slice(a, b) for a, b in zip(starts[:-1], starts[1:], strict=True)]
    parts.remove(min(parts, key=lambda part: float(points[part, 0].min())))
    begin = np.cumsum([0, *(part.stop - part.start for part in parts)])
    points = np.concatenate([points[part] for part in parts])
    bulges = np.concatenate([around.bulges[part] for part in parts]) if len(around.bulges) else None
    return Shape._of(_core.shape_of(points, begin, None, bulges))


def rebuild(x: MedialAxis, by: str = "outline", *, points: int = 0, chord: float = 0,
            corner_angle: float = 0.01) -> Shape:  # fmt: skip
    """The union of the disks of an axis: the original shape if the axis is exact and complete.

    Parameters
    ----------
    x : MedialAxis
    by : {"outline", "tangents", "hulls"}
        The exact union; a polygon of tangents of the disks; or the union of the hulls of
        neighbouring disks.
    points : int
        For tangents: the approximate number of points on the axis.
    chord : float
        Replace arcs by chords within this distance, in units of the input; 0: keep arcs.
    corner_angle : float
        The value with which the axis was computed.

    Raises
    ------
    MedialError
        With the code ``"empty"`` for an axis without nodes.

    Examples
    --------
    >>> import medial
    >>> medial.rebuild(medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])).area
    8.0
    """
    return Shape._of(_core.rebuilt(x._core, by, points, chord, corner_angle), x._attributes)


def collapse(x: Any, width: float, *, trim: float = 1,
             corner_angle: float = 0.01) -> tuple[Shape | None, MedialAxis]:  # fmt: skip
    """Collapses parts narrower than `width` to lines, and keeps the rest as polygons.

    Parameters
    ----------
    x : MedialAxis or geometry
    width : float
        In units of the input.
    trim : float
        Corners that protrude by at most this many half widths stay with the polygons.
    corner_angle : float
        The value with which the axis was computed.

    Returns
    -------
    polygons : Shape or None
    lines : MedialAxis
        The axis of the narrow parts.

    Raises
    ------
    MedialError
        With the code ``"invalid_option"``: a width that is not positive.

    Examples
    --------
    >>> import medial
    >>> lake = [(0, 1.8), (6, 1.8), (6, 0), (10, 0), (10, 4), (6, 4), (6, 2.2), (0, 2.2)]
    >>> polygons, lines = medial.collapse(lake, 1)
    >>> round(polygons.area), round(lines.length)
    (16, 6)
    """
    of = axis_of(x)
    shape, lines = _core.collapsed(of._core, width, trim, corner_angle)
    polygons = Shape._of(shape, of._attributes)
    return (polygons if len(polygons.points) else None), MedialAxis._of(lines, of._attributes)
