"""Closed curves of lines, arcs and Bézier curves."""

from __future__ import annotations

from collections.abc import Sequence
from copy import deepcopy

from . import _core

_ROLES = {"any": 0, "outer": 1, "hole": 2, "winding": 3}
Point = tuple[float, float]


class Contour:
    """A closed curve of pieces end to end. If its ends differ, a straight piece closes it.

    Parameters
    ----------
    start : (x, y)
    role : {"any", "outer", "hole", "winding"}
        What the curve encloses: by the even-odd rule (any), always or never inside (outer, hole),
        or by the non-zero rule (winding).

    Examples
    --------
    A stadium, whose axis is one segment:

    >>> import medial
    >>> c = medial.Contour((0, 0)).line_to((4, 0)).arc_to((4, 2), 1).line_to((0, 2)).arc_to((0, 0), 1)
    >>> medial.axis(c).length
    4.0
    """

    __slots__ = ("_core",)

    def __init__(self, start: Point, role: str = "any") -> None:
        self._core = _core.Contour()
        self._core.start_at(start)
        if role not in _ROLES:
            raise ValueError(f"role must be one of {', '.join(_ROLES)}")
        self._core.set_role(_ROLES[role])

    def line_to(self, end: Point) -> Contour:
        """Adds a straight piece.

        Parameters
        ----------
        end : (x, y)

        Examples
        --------
        >>> import medial
        >>> medial.Contour((0, 0)).line_to((4, 0))
        <medial.Contour: 1 pieces>
        """
        self._core.line_to(end)
        return self

    def arc_to(self, end: Point, bulge: float) -> Contour:
        """Adds a circular arc; `bulge` is the tangent of a quarter of its angle, positive to the left.

        Parameters
        ----------
        end : (x, y)
        bulge : float
            1 is half a circle.

        Examples
        --------
        >>> import medial
        >>> medial.Contour((0, 0)).arc_to((4, 0), 1)
        <medial.Contour: 1 pieces>
        """
        self._core.arc_to(end, bulge)
        return self

    def bezier_to(self, control: Sequence[Point], weights: Sequence[float] | None = None) -> Contour:
        """Adds a Bézier curve by its control points except the first; rational with `weights`.

        Parameters
        ----------
        control : sequence of (x, y)
            The last point is the end of the curve.
        weights : sequence of float, optional
            One positive weight per control point.

        Examples
        --------
        >>> import medial
        >>> medial.Contour((0, 0)).bezier_to([(1, 2), (3, 2), (4, 0)])
        <medial.Contour: 1 pieces>
        """
        self._core.bezier_to(list(control), None if weights is None else list(weights))
        return self

    def ellipse_to(self, center: Point, u: Point, v: Point, begin: float, end: float) -> Contour:
        """Adds an elliptical arc with conjugate half axes.

        Parameters
        ----------
        center, u, v : (x, y)
            The centre and the half axes; a circle has two of equal length at right angles.
        begin, end : float
            In radians.

        Examples
        --------
        >>> import math, medial
        >>> medial.Contour((4, 0)).ellipse_to((0, 0), (4, 0), (0, 2), 0, math.pi)
        <medial.Contour: 2 pieces>
        """
        self._core.ellipse_to(center, u, v, begin, end)
        return self

    def spline_to(self, degree: int, knots: Sequence[float], control: Sequence[Point],
                  weights: Sequence[float] | None = None) -> Contour:  # fmt: skip
        """Adds a B-spline, or a NURBS with `weights`.

        Parameters
        ----------
        degree : int
        knots : sequence of float
            One more than the number of control points plus the degree.
        control : sequence of (x, y)
            The first must be the current end of the contour.
        weights : sequence of float, optional
            One positive weight per control point.

        Examples
        --------
        >>> import medial
        >>> medial.Contour((0, 0)).spline_to(2, [0, 0, 0, 1, 1, 1], [(0, 0), (2, 3), (4, 0)])
        <medial.Contour: 1 pieces>
        """
        self._core.spline_to(degree, list(knots), list(control), None if weights is None else list(weights))
        return self

    def __copy__(self) -> Contour:
        return deepcopy(self)  # pieces are added to one of them

    def __repr__(self) -> str:
        return f"<medial.Contour: {self._core.piece_count} pieces>"

    @staticmethod
    def from_svg_path(path: str) -> list[Contour]:
        """The subpaths of SVG path data.

        Examples
        --------
        >>> import medial
        >>> medial.Contour.from_svg_path("M0 0H4V2H0Z")
        [<medial.Contour: 3 pieces>]
        """
        contours = []
        for core in _core.contours_of_path(path):
            contour = Contour.__new__(Contour)
            contour._core = core
            contours.append(contour)
        return contours
