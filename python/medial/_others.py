"""Codes of shapes, potential fields, axes of curves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy.typing as npt

from . import _core
from ._axis import MedialAxis, axis, axis_of
from ._records import Floats, points_of
from ._shape import load


def compressed_size(streams: Sequence[bytes]) -> int:
    """The total size of streams in bytes, each compressed by zlib."""
    import zlib

    return sum(len(zlib.compress(stream, 9)) for stream in streams)


@dataclass(frozen=True)
class Pack:
    """A compact code of a shape within an error.

    Attributes
    ----------
    streams : tuple of bytes
    disks : int
        The number of disks.
    quantum : float
        The quantum of its numbers, in units of the input.
    boundary_nbytes : int
        The size of the boundary for comparison, simplified within the same error and coded alike.
    """

    streams: tuple[bytes, ...]
    disks: int
    quantum: float
    boundary_nbytes: int

    @property
    def nbytes(self) -> int:
        """The size in bytes, compressed by zlib."""
        return compressed_size(self.streams)

    def unpack(self) -> MedialAxis:
        """The axis of disks, with the shape that they cover."""
        return MedialAxis._of(_core.unpacked(list(self.streams)))


def pack(x: Any, error: float) -> Pack:
    """Codes a shape; the unpacked shape is within the distance `error` of it.

    For images, use `medial.image.pack`.

    Parameters
    ----------
    x : MedialAxis or geometry
    error : float
        In units of the input, positive.

    Examples
    --------
    >>> import medial
    >>> round(medial.pack([(0, 0), (4, 0), (4, 2), (0, 2)], 0.01).unpack().shape.area)
    8
    """
    of = axis_of(x)
    streams, disks, _, quantum = _core.packed(of._core, error)
    boundary = compressed_size(_core.packed_boundary(of.shape._core, error))
    return Pack(tuple(streams), disks, quantum, boundary)


def unpack(code: Pack) -> MedialAxis:
    """The axis of a code, with the shape that its disks cover.

    Parameters
    ----------
    code : Pack

    Examples
    --------
    >>> import medial
    >>> code = medial.pack([(0, 0), (4, 0), (4, 2), (0, 2)], 0.01)
    >>> medial.unpack(code).method
    'pack'
    """
    if not isinstance(code, Pack):
        raise TypeError(f"a {type(code).__name__} is not a code: make one with medial.pack()")
    return code.unpack()


class Field:
    """The generalised potential of a charged border; made by `field`."""

    def __init__(self, core: _core.Field) -> None:
        self._core = core

    def sample(self, points: npt.ArrayLike) -> dict[str, Floats]:
        """The logarithm of the potential, the direction of the force and the clearance; NaN outside."""
        rows = self._core.sample(points_of(points))
        return {"log_potential": rows[:, 0], "direction": rows[:, 1:3], "clearance": rows[:, 3]}

    def streamline(self, point: Sequence[float], step: float, most: int = 1000) -> Floats:
        """The force line from a point: rows of x and y."""
        x, y = point
        return self._core.streamline((x, y), step, most)


def field(x: Any, order: float = 2) -> Field:
    """The integral of 1 / r^order along the border of a shape.

    Parameters
    ----------
    x : geometry
    order : float
        The exponent, at least 1.

    Examples
    --------
    >>> import medial
    >>> f = medial.field([(0, 0), (4, 0), (4, 2), (0, 2)])
    >>> f.sample([(2, 0.25)])["clearance"]
    array([0.25])
    """
    return Field(_core.field_of(load(x)[0], order))


def curve_axis(x: Any, *, fit: float = 0, **own: Any) -> MedialAxis:
    """The axis of closed curves, traced from maxima of curvature and corners.

    Parameters
    ----------
    x : Contour or geometry
    fit : float
        Replace polygons by smooth curves within this distance first.
    **own
        `step` and `first_maximum`.

    Raises
    ------
    MedialError
        With the code ``"unsupported"`` for cusps, or loops that touch.

    Examples
    --------
    >>> import math, medial
    >>> ellipse = medial.Contour((4, 0)).ellipse_to((0, 0), (4, 0), (0, 2), 0, 2 * math.pi)
    >>> round(medial.curve_axis(ellipse).length, 2)
    6.0
    """
    return axis(x, "curve-axis", fit=fit, **own)
