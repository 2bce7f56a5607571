"""Exact medial axes of planar shapes, and what follows from them.

>>> import medial
>>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
>>> a.branch_count, medial.centerline(a).length
(5, 2.0)
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._axes import Axes, axes
from ._axis import MedialAxis, axis
from ._contour import Contour
from ._core import methods
from ._errors import MedialError, MissingPackage
from ._options import options
from ._records import NO_SITE, NODE_KINDS, SITE_KINDS
from ._shape import Shape

if TYPE_CHECKING:
    from . import arrays, image
    from ._native import load, loads
    from ._operations import (
        Carving,
        Certificate,
        Circle,
        Field,
        Line,
        Match,
        Neck,
        Pack,
        Region,
        Widths,
        buffer,
        carve,
        centerline,
        centerlines,
        centreline,
        centrelines,
        collapse,
        compare,
        curve_axis,
        distance,
        features,
        field,
        inscribed_circles,
        legality,
        match,
        maximum_inscribed_circle,
        mean_width,
        necks,
        offset,
        pack,
        prune,
        prune_measures,
        rebuild,
        smooth,
        transects,
        unpack,
        verify,
        widest_path,
        width_profile,
    )
    from ._voronoi import Voronoi, voronoi
    from ._voxels import VoxelAxis, voxels

__version__ = "0.1.0"

__all__ = [
    "NODE_KINDS", "NO_SITE", "SITE_KINDS", "Axes", "Carving", "Certificate", "Circle", "Contour",
    "Field", "Line", "Match", "MedialAxis", "MedialError", "MissingPackage", "Neck", "Pack",
    "Region", "Shape", "Voronoi", "VoxelAxis", "Widths", "arrays", "axes", "axis", "buffer", "carve",
    "centerline", "centerlines", "centreline", "centrelines", "collapse", "compare", "curve_axis",
    "distance", "features", "field", "image", "inscribed_circles", "legality", "load", "loads",
    "match", "maximum_inscribed_circle", "mean_width", "methods", "necks", "offset", "options",
    "pack", "prune", "prune_measures", "rebuild", "smooth", "transects", "unpack", "verify",
    "voronoi", "voxels", "widest_path", "width_profile",
]  # fmt: skip


# Imported when they are asked for, which halves the time of `import medial`.
_ELSEWHERE = {
    "Voronoi": "_voronoi", "VoxelAxis": "_voxels", "load": "_native", "loads": "_native",
    "voronoi": "_voronoi", "voxels": "_voxels",
}  # fmt: skip


def __getattr__(name: str) -> Any:
    import importlib

    if name in ("arrays", "image", "geo", "spark"):
        return importlib.import_module(f"medial.{name}")
    if name not in __all__:
        raise AttributeError(f"module 'medial' has no attribute {name!r}")
    value = getattr(importlib.import_module(f"medial.{_ELSEWHERE.get(name, '_operations')}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return [*__all__, "__version__", "geo", "spark"]


def _register() -> None:
    """The accessor `.medial`, where GeoPandas is imported already; see medial.geo."""
    import sys

    if "geopandas" in sys.modules:
        from . import geo  # noqa: F401


_register()
