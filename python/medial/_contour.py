"""Closed curves of lines, arcs and Bézier curves."""

from __future__ import annotations

from collections.abc import Sequence

from . import _core

_ROLES = {"any": 0, "outer": 1, "hole": 2, "winding": 3}
Point = tuple[float, float]


class Contour:
    """A closed curve: pieces end to end. A straight piece closes it where its ends differ.

    Parameters
    ----------
    start : (x, y)
    role : {"any", "outer", "hole", "winding"}
        What is inside: by the even-odd rule, as said, or by the non-zero rule.

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
        """Adds a circular arc; `bulge` is the tangent of a quarter of its angle, positive left.

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
        """Adds a Bézier curve, rational with `weights`, by its control points but the first.

        Parameters
        ----------
        control : sequence of (x, y)
            The last one is the end.
        weights : sequence of float, optional
            One for each, positive.

        Examples
        --------
        >>> import medial
        >>> medial.Contour((0, 0)).bezier_to([(1, 2), (3, 2), (4, 0)])
        <medial.Contour: 1 pieces>
        """
        self._core.bezier_to(list(control), None if weights is None else list(weights))
        return self

    def ellipse_to(self, center: Point, u: Point, v: Point, begin: float, end: float) -> Contour:
        """Adds an elliptical arc with conjugate half axes, from angle to angle in radians.

        Parameters
        ----------
        center, u, v : (x, y)
            The centre and the half axes; for a circle at right angles and of equal length.
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
            As many as control points, and the degree and one more.
        control : sequence of (x, y)
            The first is where the contour is.
        weights : sequence of float, optional
            One for each, positive.

        Examples
        --------
        >>> import medial
        >>> medial.Contour((0, 0)).spline_to(2, [0, 0, 0, 1, 1, 1], [(0, 0), (2, 3), (4, 0)])
        <medial.Contour: 1 pieces>
        """
        self._core.spline_to(degree, list(knots), list(control), None if weights is None else list(weights))
        return self

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
