"""Exact medial axes of planar shapes, and what follows from them.

>>> import medial
>>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
>>> a.branch_count, medial.centerline(a).length
(5, 2.0)
"""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING, Any

from ._axes import Axes, axes
from ._axis import MedialAxis, axis
from ._contour import Contour
from ._core import methods
from ._errors import MedialError, MissingPackage
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
from ._options import options
from ._records import NO_SITE, NODE_KINDS, SITE_KINDS
from ._shape import Shape
from ._voronoi import Voronoi, voronoi
from ._voxels import VoxelAxis, voxels

if TYPE_CHECKING:
    from . import image

__version__ = "0.1.0"

logging.getLogger("medial").addHandler(logging.NullHandler())

__all__ = [
    "NODE_KINDS", "NO_SITE", "SITE_KINDS", "Axes", "Carving", "Certificate", "Circle", "Contour",
    "Field", "Line", "Match", "MedialAxis", "MedialError", "MissingPackage", "Neck", "Pack",
    "Region", "Shape", "Voronoi", "VoxelAxis", "Widths", "axes", "axis", "buffer", "carve",
    "centerline", "centerlines", "centreline", "centrelines", "collapse", "compare", "curve_axis",
    "distance", "features", "field", "image", "inscribed_circles", "legality", "load", "loads",
    "match", "maximum_inscribed_circle", "mean_width", "methods", "necks", "offset", "options",
    "pack", "prune", "prune_measures", "rebuild", "smooth", "transects", "unpack", "verify",
    "voronoi", "voxels", "widest_path", "width_profile",
]  # fmt: skip


def __getattr__(name: str) -> Any:
    if name in ("image", "geo"):
        import importlib

        return importlib.import_module(f"medial.{name}")
    raise AttributeError(f"module 'medial' has no attribute {name!r}")


def __dir__() -> list[str]:
    return [*__all__, "__version__", "geo"]


def _register() -> None:
    """The accessor `.medial`, where GeoPandas is imported already; see medial.geo."""
    import sys

    if "geopandas" in sys.modules:
        from . import geo  # noqa: F401


_register()
