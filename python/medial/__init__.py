"""Exact medial axes of planar shapes, and what you can compute from them.

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
from ._errors import MedialError, MissingPackage
from ._options import methods, options
from ._records import NO_SITE, NODE_KINDS, SITE_KINDS
from ._shape import Shape

if TYPE_CHECKING:
    from . import arrays, image
    from ._carving import Carving, carve
    from ._checks import (
        Certificate,
        Curvatures,
        boundary_curvature,
        compare,
        distance,
        legality,
        verify,
    )
    from ._editor import Change, Editor
    from ._features import Match, Placement, features, match, nest
    from ._files import columns, load, loads, read, text
    from ._lines import (
        Circle,
        Line,
        Neck,
        Widths,
        centerline,
        centerlines,
        inscribed_circles,
        maximum_inscribed_circle,
        mean_width,
        necks,
        network,
        transects,
        widest_path,
        width_profile,
    )
    from ._offsets import Region, buffer, offset, offset_passes
    from ._others import Field, Pack, curve_axis, field, pack, unpack
    from ._parts import collapse, prune, prune_measures, rebuild, smooth
    from ._voronoi import Voronoi, voronoi
    from ._voxels import VoxelAxis, voxels

    centreline, centrelines = centerline, centerlines

__version__ = "0.1.0"

__all__ = [
    "Axes", "Carving", "Certificate", "Change", "Circle", "Contour", "Curvatures", "Editor", "Field", "Line",
    "Match", "MedialAxis", "MedialError", "MissingPackage", "NODE_KINDS", "NO_SITE", "Neck",
    "Pack", "Placement", "Region", "SITE_KINDS", "Shape", "Voronoi", "VoxelAxis", "Widths",
    "arrays", "axes", "axis", "boundary_curvature", "buffer", "carve", "centerline",
    "centerlines", "centreline", "centrelines", "collapse", "columns", "compare", "curve_axis",
    "distance", "features", "field", "image", "inscribed_circles", "legality", "load", "loads", "match",
    "maximum_inscribed_circle", "mean_width", "methods", "necks", "nest", "network", "offset",
    "offset_passes", "options", "pack", "prune", "prune_measures", "read", "rebuild", "smooth",
    "text", "transects", "unpack", "verify", "voronoi", "voxels", "widest_path",
    "width_profile",
]  # fmt: skip


# Imported on first use: that halves the time of `import medial`.
_WHERE = {
    "_carving": "Carving carve",
    "_checks": "Certificate Curvatures boundary_curvature compare distance legality verify",
    "_editor": "Change Editor",
    "_features": "Match Placement features match nest",
    "_files": "columns load loads read text",
    "_lines": "Circle Line Neck Widths centerline centerlines inscribed_circles maximum_inscribed_circle mean_width necks network transects widest_path width_profile",
    "_offsets": "Region buffer offset offset_passes",
    "_others": "Field Pack curve_axis field pack unpack",
    "_parts": "collapse prune prune_measures rebuild smooth",
    "_voronoi": "Voronoi voronoi",
    "_voxels": "VoxelAxis voxels",
}
_ALIASES = {"centreline": "centerline", "centrelines": "centerlines"}


def __getattr__(name: str) -> Any:
    import importlib

    if name in ("arrays", "image", "geo", "spark"):
        return importlib.import_module(f"medial.{name}")
    wanted = _ALIASES.get(name, name)
    for module, names in _WHERE.items():
        if wanted in names.split():
            value = getattr(importlib.import_module(f"medial.{module}"), wanted)
            globals()[name] = value
            return value
    raise AttributeError(f"module 'medial' has no attribute {name!r}")


def __dir__() -> list[str]:
    return [*__all__, "__version__", "geo", "spark"]


def _register() -> None:
    """Registers the accessor `.medial` if GeoPandas has been imported; see medial.geo."""
    import sys

    if "geopandas" in sys.modules:
        from . import geo  # noqa: F401


_register()
