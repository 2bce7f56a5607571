"""The records of the library as NumPy arrays, of sites a copy, which also has their kinds."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._errors import MedialError

Floats = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int64]
Records = npt.NDArray[np.void]

NO_SITE = 0xFFFFFFFF

SITE_KINDS = ("segment", "vertex", "arc")
NODE_KINDS = ("leaf", "site_change", "branching")

NODE = np.dtype(
    {
        "names": ["x", "y", "radius", "component", "kind"],
        "formats": ["f8", "f8", "f8", "u4", "u1"],
        "offsets": [0, 8, 16, 24, 28],
        "itemsize": 32,
    }
)
EDGE = np.dtype(
    {
        "names": ["node", "site", "control", "weight"],
        "formats": [("u4", 2), ("u4", 2), ("f8", 3), "f8"],
        "offsets": [0, 8, 16, 40],
        "itemsize": 48,
    }
)
_STORED_SITE = np.dtype([("start", "f8", 2), ("end", "f8", 2), ("ring", "u4"), ("vertex", "u4"), ("bulge", "f8")])
SITE = np.dtype(
    {
        "names": ["start", "end", "ring", "vertex", "kind", "bulge"],
        "formats": [("f8", 2), ("f8", 2), "u4", "u4", "u1", "f8"],
        "offsets": [0, 16, 32, 36, 40, 48],
        "itemsize": 56,
    }
)
NEAREST = np.dtype(
    [("x", "f8"), ("y", "f8"), ("radius", "f8"), ("distance", "f8"), ("t", "f8"), ("edge", "i8")]
)


def records(data: npt.NDArray[np.uint8], dtype: np.dtype[np.void]) -> Records:
    """Bytes as records."""
    return _sites(data.view(_STORED_SITE)) if dtype is SITE else data.view(dtype)


def _sites(stored: Records) -> Records:
    """Sites with their kinds: an arc has a bulge, a vertex equal ends."""
    result = np.zeros(stored.shape, SITE)
    for name in _STORED_SITE.names or ():
        result[name] = stored[name]
    is_vertex = (stored["start"] == stored["end"]).all(axis=1)
    result["kind"] = np.where(stored["bulge"] != 0, 2, is_vertex)
    result.flags.writeable = stored.flags.writeable
    return result


def packed(values: Records) -> Records:
    """A copy without the gaps between fields: equal records have equal bytes."""
    dtype = values.dtype
    compact = np.dtype([(name, dtype[name]) for name in dtype.names or ()])
    return values.astype(compact)


def unpacked(values: npt.ArrayLike, dtype: np.dtype[np.void]) -> npt.NDArray[np.uint8]:
    """Records as bytes in the layout of the library, gaps set to 0."""
    source = np.asarray(values)
    stored = _STORED_SITE if dtype is SITE else dtype
    result = np.zeros(source.shape, stored)
    for name in stored.names or ():
        result[name] = source[name]
    return result.view(np.uint8).reshape(-1)


def in_utf8(text: Any) -> str:
    """A text whose undecodable bytes are replaced."""
    return str(text).encode("utf-8", "replace").decode()


def numbers_of(values: Any, what: str) -> Floats:
    """Numbers as an array; refuses complex numbers, dates and masked values."""
    if isinstance(values, np.ndarray):
        if values.dtype.kind not in "biufO":
            raise MedialError(f"{what}, not {values.dtype}", "malformed")
        if np.any(getattr(values, "mask", False)):
            raise MedialError(f"{what}, and some are masked", "malformed")
    try:
        return np.asarray(values, np.float64)
    except Exception as error:  # of whatever has an __array__
        raise MedialError(f"{what}: {error}", "malformed") from error


def points_of(points: Any) -> Floats:
    """Points as rows of x and y."""
    array = numbers_of(points, "points must be rows of x and y")
    if array.shape == (2,) or array.size == 0:
        array = array.reshape(-1, 2)
    if array.ndim != 2 or array.shape[1] < 2:
        raise MedialError("points must be rows of x and y", "malformed")
    return np.ascontiguousarray(array[:, :2])


def where_known(points: Floats, values: Floats) -> Floats:
    """Values at points, not a number where a point is none."""
    unknown = np.isnan(points).any(axis=1)
    return np.where(unknown, np.nan, values) if unknown.any() else values
