"""The records of the library, as NumPy sees them: no copy is made."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

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
    return data.view(dtype)


def packed(values: Records) -> Records:
    """A copy without the gaps between fields: equal records have equal bytes."""
    dtype = values.dtype
    compact = np.dtype([(name, dtype[name]) for name in dtype.names or ()])
    return values.astype(compact)


def unpacked(values: npt.ArrayLike, dtype: np.dtype[np.void]) -> npt.NDArray[np.uint8]:
    """Records as bytes in the layout of the library, gaps set to 0."""
    source = np.asarray(values)
    result = np.zeros(source.shape, dtype)
    for name in dtype.names or ():
        result[name] = source[name]
    return result.view(np.uint8).reshape(-1)


def points_of(points: npt.ArrayLike) -> Floats:
    """Points as rows of x and y."""
    array = np.ascontiguousarray(points, dtype=np.float64)
    if array.ndim == 1 and array.shape == (2,):
        array = array.reshape(1, 2)
    if array.ndim != 2 or array.shape[1] < 2:
        raise ValueError("points are rows of x and y")
    return np.ascontiguousarray(array[:, :2])
