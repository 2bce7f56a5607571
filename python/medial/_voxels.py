"""The medial axis of solids, on voxels."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import MedialError, need
from ._options import options
from ._records import Floats, numbers_of


class Surface(NamedTuple):
    """Sheets as triangles, curves as lines, with a radius at each vertex."""

    vertices: Floats
    radii: Floats
    triangles: npt.NDArray[np.uint32]
    lines: npt.NDArray[np.uint32]

    def to_trimesh(self) -> Any:
        """The sheets as a mesh of trimesh, with radii as vertex attributes."""
        mesh = need("trimesh", "mesh").Trimesh(self.vertices, self.triangles, process=False)
        mesh.vertex_attributes["radius"] = self.radii
        return mesh


@dataclass(frozen=True, eq=False)
class VoxelAxis:
    """The medial axis of a solid on a grid.

    Attributes
    ----------
    cells : array
        The column, row and layer of each voxel.
    centers, radii, qualities : array
        The centre of each voxel, its distance to the surface, and how much farther its second foot
        point is.
    links : array
        Pairs of voxels that share a face, an edge or a corner.
    topology, interior : (components, tunnels, cavities)
        The Betti numbers of the axis, and of all interior voxels.
    surface : Surface
        Empty unless requested from `voxels`.
    """

    resolution: float
    origin: tuple[float, float, float]
    shape: tuple[int, int, int]
    cells: npt.NDArray[np.uint32]
    centers: Floats
    radii: Floats
    qualities: Floats
    links: npt.NDArray[np.uint32]
    topology: tuple[int, int, int]
    interior: tuple[int, int, int]
    surface: Surface

    def volume(self) -> npt.NDArray[np.bool_]:
        """The axis as a volume with the indices x, y, z."""
        grid = np.zeros(self.shape, bool)
        grid[tuple(self.cells.T.astype(np.intp))] = True
        return grid

    def __repr__(self) -> str:
        return f"<medial.VoxelAxis: {len(self.cells)} voxels of {self.resolution:.6g}>"


def _surface(volume: npt.NDArray[Any], spacing: tuple[float, float, float]) -> tuple[Floats, npt.NDArray[np.uint32]]:
    """The surface of the voxels that are set, as triangles."""
    if np.shape(spacing) != (3,) or not ((np.asarray(spacing) > 0) & np.isfinite(spacing)).all():
        raise MedialError("spacing must be three positive numbers")
    grid = np.pad(np.asarray(volume) != 0, 1)
    quads = []
    for direction in range(3):
        a, b = (direction + 1) % 3, (direction + 2) % 3
        inside = np.moveaxis(grid, direction, 0).astype(np.int8)
        change = np.moveaxis(inside[1:] - inside[:-1], 0, direction)
        for sign in (-1, 1):
            at = np.argwhere(change == sign)
            corner = at.astype(np.int64)
            corner[:, direction] += 1
            steps = [(0, 0), (1, 0), (1, 1), (0, 1)]
            corners = np.repeat(corner[:, None, :], 4, axis=1)
            for k, (da, db) in enumerate(steps if sign < 0 else steps[::-1]):
                corners[:, k, a] += da
                corners[:, k, b] += db
            quads.append(corners)
    corners = np.concatenate(quads).reshape(-1, 3)
    points, index = np.unique(corners, axis=0, return_inverse=True)
    index = index.reshape(-1, 4)
    faces = np.concatenate([index[:, [0, 1, 2]], index[:, [0, 2, 3]]]).astype(np.uint32)
    return (points - 1.0) * np.asarray(spacing), faces


def voxels(
    x: Any,
    faces: npt.ArrayLike | None = None,
    *,
    resolution: float = 0,
    count: int = 128,
    angle: float = 30,
    thinning: str = "sheets",
    surface: bool = False,
    method: str = "ridge",
    order: int = 8,
    spacing: tuple[float, float, float] = (1, 1, 1),
    memory: float = 4,
    threads: int | None = None,
) -> VoxelAxis:
    """The medial axis of a solid.

    Parameters
    ----------
    x : mesh or array
        A trimesh mesh (anything with `vertices` and `faces`), an array of vertices if `faces` is
        given, or a volume: an array with the indices x, y, z, solid where it is not 0.
    resolution : float
        The edge length of a voxel; 0: chosen by `count`.
    count : int
        The number of voxels along the longest side.
    angle : float
        The least angle between the two foot points of a voxel, in degrees.
    thinning : {"none", "sheets", "curves"}
    surface : bool
        Also compute ``VoxelAxis.surface``.
    method : {"ridge", "potential"}
        ``"potential"`` follows the force lines of a charged surface; it yields only the surface.
    order : int
        The exponent n of the potential 1 / distance^n, from 2 to 64.
    spacing : three floats
        The edge lengths of a volume's voxels.
    memory : float
        Fail with ``"too_large"`` rather than use more than about this many gibibytes.

    Raises
    ------
    MedialError
        With the code ``"open_surface"``, ``"non_manifold"``, ``"crossing"`` or ``"overlap"`` (and
        the place), ``"too_large"``, or ``"empty"``.

    Examples
    --------
    >>> import medial, numpy as np
    >>> medial.voxels(np.ones((4, 4, 12)), count=24).topology
    (1, 0, 0)
    """
    if method not in ("ridge", "potential"):
        raise MedialError("method must be 'ridge' or 'potential'", "invalid_option")
    if faces is not None:
        vertices, triangles = x, faces
    elif hasattr(x, "vertices") and hasattr(x, "faces"):
        vertices, triangles = x.vertices, x.faces
    elif isinstance(x, np.ndarray) and x.ndim == 3:
        if not x.any():
            raise MedialError("the volume is empty", "empty")
        vertices, triangles = _surface(x, spacing)
    else:
        raise MedialError(f"a {type(x).__name__} is neither a mesh nor a volume", "unsupported")
    points = np.ascontiguousarray(numbers_of(vertices, "vertices are rows of x, y and z"))
    whole = numbers_of(triangles, "faces must be rows of three vertices")
    if not ((whole >= 0) & (whole < max(len(points), 1)) & (whole == np.floor(whole))).all():
        raise MedialError("faces must be rows of three vertices, by their numbers", "malformed")
    corners = np.ascontiguousarray(triangles, np.uint32)
    some = options.threads if threads is None else threads
    made = _core.voxels_of(points, corners, resolution, count, angle, thinning, surface,
                           order if method == "potential" else 0, memory, some)  # fmt: skip
    return VoxelAxis(**{**made, "surface": Surface(*made["surface"])})
