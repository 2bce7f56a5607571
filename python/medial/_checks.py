"""Checks of an axis, and comparisons."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._axis import MedialAxis, axis
from ._errors import MedialError, need
from ._options import options
from ._records import Floats, points_of
from ._shape import Shape, load


@dataclass(frozen=True)
class Certificate:
    """The measured errors of an axis against its shape."""

    passed: bool
    failures: list[str]
    numbers: dict[str, Any]

    def __bool__(self) -> bool:
        return self.passed

    def __getattr__(self, name: str) -> Any:
        try:
            return self.__dict__["numbers"][name]
        except KeyError:
            raise AttributeError(name) from None


def verify(x: MedialAxis, shape: Any = None, *, tolerance: float = 0, samples: int = 8,
           corner_angle: float = 0.01, threads: int | None = None) -> Certificate:  # fmt: skip
    """Measures the errors of an axis against a shape, by code that shares nothing with methods.

    Parameters
    ----------
    x : MedialAxis
        For an axis that was pruned, cut or smoothed (`part`), checks only what holds for every part.
    shape : geometry, optional
        The shape to check against, instead of the axis's own.
    tolerance : float
        As a share of the diagonal; 0: 1e-14, or the tolerance of the axis.
    samples : int
        The number of points inside every edge.
    corner_angle : float
        The value that the axis was computed with, in degrees.
    threads : int, optional

    Returns
    -------
    Certificate
        True if the axis passed. Has `failures` and all measured numbers.

    Examples
    --------
    >>> import medial
    >>> medial.verify(medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])).passed
    True
    """
    if not isinstance(x, MedialAxis):
        raise TypeError(f"a {type(x).__name__} is not an axis: make one with medial.axis()")
    of = x
    if shape is not None:
        of = MedialAxis._of(_rebound(x, Shape._of(load(shape)[0])))
    numbers = _core.certificate(of._core, tolerance, samples, corner_angle,
                                options.threads if threads is None else threads)  # fmt: skip
    return Certificate(numbers.pop("passed"), numbers.pop("failures"), numbers)


def _rebound(x: MedialAxis, shape: Shape) -> _core.Axis:
    from ._axis import restored

    return restored(shape, *x._state())._core


def compare(x: Any, methods: Sequence[str] = ("disks", "lee", "biarc-dc"), **given: Any) -> list[dict[str, Any]]:
    """Compares the axes of one shape by several methods: counts, lengths, seconds, errors.

    Parameters
    ----------
    x : geometry
    methods : sequence of str
        Names of `medial.methods`; distances are to the axis of the first.
    **given
        Options of `axis`.

    Returns
    -------
    list of dict
        Each has `method` and either `error` or `axis`, `nodes`, `edges`, `length`, `seconds`,
        `mean_distance` and `hausdorff`: sampled distances to the first axis, in units of the input.

    Examples
    --------
    >>> import medial
    >>> first, second = medial.compare([(0, 0), (9, 0), (9, 4), (0, 4)], ("disks", "lee"))
    >>> second["length"] == first["length"], second["hausdorff"] < 1e-12
    (True, True)
    """
    shape, rows = Shape(x), []
    first: MedialAxis | None = None
    for name in methods:
        row: dict[str, Any] = {"method": name}
        try:
            own = axis(shape, name, **given)
        except MedialError as error:
            row["error"] = error
        else:
            first = first or own
            there, back = _distances(own, first), _distances(first, own)
            row.update(axis=own, nodes=len(own.nodes), edges=len(own.edges), length=own.length,
                       seconds=own.statistics["seconds"], mean_distance=float(there.mean()),
                       hausdorff=float(max(there.max(), back.max())))  # fmt: skip
        rows.append(row)
    return rows


def _distances(a: MedialAxis, b: MedialAxis) -> Floats:
    """The distances of evenly spaced points of an axis to another one."""
    points, _ = a.lines(step=max(a.length / 1000, 1e-300))
    return np.asarray(b.nearest(points[:, :2] if len(points) else points_of(a.nodes[["x", "y"]].tolist()))["distance"])


def distance(a: Any, b: Any, samples: int = 7) -> dict[str, Any]:
    """The areas of two shapes and the Hausdorff distance of their boundaries.

    Parameters
    ----------
    a, b : geometry
    samples : int
        Points inside each edge. The result is a lower bound; its error is less than the distance
        of two samples.

    Examples
    --------
    >>> import medial
    >>> medial.distance([(0, 0), (4, 0), (4, 2), (0, 2)], [(0, 0), (4, 0), (4, 3), (0, 3)])["hausdorff"]
    1.0
    """
    return _core.shape_distance(load(a)[0], load(b)[0], samples)


def legality(x: MedialAxis, samples: int = 8) -> Floats:
    """For each branch, the violation of two conditions that every axis meets; at most 0 if met.

    Parameters
    ----------
    x : MedialAxis
    samples : int
        The number of points inside every edge.

    Returns
    -------
    array of shape (branches, 2)
        The largest abs(dr/ds) - 1 and the largest excess of the curvature, both dimensionless.

    Examples
    --------
    >>> import medial
    >>> bool((medial.legality(medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])) <= 1e-9).all())
    True
    """
    return _core.legality(x._core, samples)


class Curvatures(NamedTuple):
    """The curvature of the boundary at foot points of disks; see `boundary_curvature`."""

    branch: npt.NDArray[np.int64]
    left: npt.NDArray[np.bool_]
    disk: Floats
    foot: Floats
    curvature: Floats
    slope: Floats

    def to_pandas(self) -> Any:
        """The same as a pandas DataFrame."""
        columns = {"branch": self.branch, "side": np.where(self.left, "left", "right"),
                   "axis_x": self.disk[:, 0], "axis_y": self.disk[:, 1], "r": self.disk[:, 2],
                   "x": self.foot[:, 0], "y": self.foot[:, 1], "curvature": self.curvature,
                   "slope": self.slope}  # fmt: skip
        return need("pandas", "all").DataFrame(columns)


def boundary_curvature(x: MedialAxis) -> Curvatures:
    """The curvature of the boundary at the foot points of disks, from the axis alone.

    Parameters
    ----------
    x : MedialAxis

    Returns
    -------
    Curvatures
        Arrays of the same length: the branch, whether the foot is on its left, the disk (x, y,
        radius), the foot (x, y), the curvature (1 / length, positive where the shape is convex) and
        its derivative along the boundary.

    Examples
    --------
    >>> import medial
    >>> stadium = medial.Shape([(0, 0), (4, 0), (4, 2), (0, 2)])
    >>> abs(medial.boundary_curvature(medial.axis(stadium)).curvature).max() < 1e-9
    np.True_
    """
    rows, begin = _core.curvatures(x._core)
    branch = np.repeat(np.arange(len(begin) - 1), np.diff(begin))
    return Curvatures(branch, rows[:, 0] == 0, rows[:, 1:4], rows[:, 4:6], rows[:, 6], rows[:, 7])
