"""Skeletons and distances of images, with the signatures of scikit-image.

The functions take the arguments of scikit-image's and return the same types; :doc:`a table
</images>` lists where results differ. `axis` makes exact vector graphs of labelled regions.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
import numpy.typing as npt

from . import _core
from ._axis import MedialAxis
from ._axis import axis as _axis
from ._errors import MedialError
from ._options import options
from ._others import compressed_size
from ._read import Rings
from ._records import Floats

Mask = npt.NDArray[np.bool_]
_ARC = 0.05  # largest distance of arcs from the smooth outline, in pixels


def _pixels(image: npt.ArrayLike, mask: npt.ArrayLike | None = None) -> npt.NDArray[np.uint8]:
    array = np.asarray(image.filled(0) if isinstance(image, np.ma.MaskedArray) else image)
    if array.ndim != 2:
        raise ValueError("images have two dimensions; medial.voxels() takes volumes")
    if mask is not None:
        if np.shape(mask) != array.shape:
            raise ValueError("a mask has the shape of its image")
        array = np.where(np.asarray(mask, bool), array, 0)
    binary = array if array.dtype == bool else array != 0
    return np.ascontiguousarray(binary).view(np.uint8)


def _thinned(pixels: npt.NDArray[np.uint8], family: str) -> Mask:
    return _core.thinned(pixels, family).view(bool)


if TYPE_CHECKING:  # at run time, overloads would keep the package alive until Python ends

    @overload
    def medial_axis(image: npt.ArrayLike, mask: npt.ArrayLike | None = ...,
                    return_distance: Literal[False] = ..., *, rng: Any = ...) -> Mask: ...  # fmt: skip
    @overload
    def medial_axis(image: npt.ArrayLike, mask: npt.ArrayLike | None = ..., *,
                    return_distance: Literal[True], rng: Any = ...) -> tuple[Mask, Floats]: ...  # fmt: skip


def medial_axis(image: npt.ArrayLike, mask: npt.ArrayLike | None = None,
                return_distance: bool = False, *, rng: Any = None) -> Mask | tuple[Mask, Floats]:  # fmt: skip
    """The medial axis of the foreground, one pixel wide.

    Parameters
    ----------
    image : array
        Foreground where it is not 0.
    mask : array, optional
        The part of the image to process; elsewhere the result is a copy of the image.
    return_distance : bool
        Return the distance transform, too.
    rng
        Ignored: the result is not random.

    Examples
    --------
    >>> import numpy as np, medial.image
    >>> square = np.zeros((7, 7), np.uint8)
    >>> square[1:-1, 2:-2] = 1
    >>> medial.image.medial_axis(square).astype(np.uint8)[2:5]
    array([[0, 0, 0, 1, 0, 0, 0],
           [0, 0, 0, 1, 0, 0, 0],
           [0, 0, 0, 1, 0, 0, 0]], dtype=uint8)
    """
    pixels = _pixels(image, mask)
    result = _thinned(pixels, "simultaneous")
    if mask is not None:
        outside = ~np.asarray(mask, bool)
        result[outside] = np.asarray(image).astype(bool)[outside]
    if return_distance:
        return result, _core.distances(pixels, False, False, False, options.threads)
    return result


def skeletonize(image: npt.ArrayLike, *, method: str | None = None) -> npt.NDArray[Any]:
    """The skeleton of the foreground, one pixel wide.

    Parameters
    ----------
    image : array
    method : {"zhang", "lee"}, optional
        Accepted for compatibility; either way pixels are removed from four subfields in turn.

    Examples
    --------
    >>> import numpy as np, medial.image
    >>> square = np.zeros((7, 7), bool)
    >>> square[1:6, 1:6] = True
    >>> int(medial.image.skeletonize(square).sum())
    1
    """
    if method not in (None, "zhang", "lee"):
        raise ValueError(f"method is 'zhang' or 'lee', not {method!r}")
    return _thinned(_pixels(image), "marking")


def thin(image: npt.ArrayLike, max_num_iter: int | None = None) -> Mask:
    """The foreground thinned to lines one pixel wide (Guo and Hall).

    Parameters
    ----------
    image : array
    max_num_iter : int, optional
        The largest number of rounds, which then match scikit-image's pixel by pixel. By default
        thins until nothing changes, which is faster.

    Examples
    --------
    >>> import numpy as np, medial.image
    >>> square = np.zeros((7, 7), bool)
    >>> square[1:6, 1:6] = True
    >>> int(medial.image.thin(square).sum())
    1
    """
    if max_num_iter is None:
        return _thinned(_pixels(image), "marking")
    pixels = _pixels(image).view(bool)
    for _ in range(max_num_iter):
        before = pixels
        for half in (0, 4):
            pixels = pixels & ~_removable(pixels, half)
        if np.array_equal(pixels, before):
            break
    return pixels


def _removable(pixels: Mask, half: int) -> Mask:
    """The pixels that a half round of Guo and Hall (1989) removes; `half` is 0 or 4."""
    padded = np.pad(pixels, 1)
    rows, columns = pixels.shape
    around = [(0, 1), (0, 2), (1, 2), (2, 2), (2, 1), (2, 0), (1, 0), (0, 0)]  # from above, clockwise
    p = [padded[y : y + rows, x : x + columns] for y, x in around]
    crossings = np.sum([~p[i] & (p[i + 1] | p[(i + 2) % 8]) for i in (0, 2, 4, 6)], axis=0)
    first = np.sum([p[i] | p[i + 1] for i in (0, 2, 4, 6)], axis=0)
    second = np.sum([p[i + 1] | p[(i + 2) % 8] for i in (0, 2, 4, 6)], axis=0)
    least = np.minimum(first, second)
    a, b, c, d = (p[(i + half) % 8] for i in (0, 1, 3, 2))
    removable: Mask = pixels & (crossings == 1) & (least >= 2) & (least <= 3) & ~((a | b | ~c) & d)
    return removable


def distance_transform(image: npt.ArrayLike, *, spacing: float = 1, to: str = "pixels",
                       frame: bool = False, squared: bool = False) -> Floats:  # fmt: skip
    """The exact Euclidean distance of each foreground pixel to the background.

    Parameters
    ----------
    spacing : float
        The side of a pixel.
    to : {"pixels", "cracks"}
        Measure to the centre of the nearest background pixel, or to its boundary.
    frame : bool
        Whether everything outside the image is background.
    squared : bool
        Return the squares of the distances, which are exact.

    Returns
    -------
    array of float
        In units of `spacing`, with the image's shape; infinite if there is no background.

    Examples
    --------
    >>> import numpy as np, medial.image
    >>> medial.image.distance_transform(np.array([[0, 1, 1, 1]]))
    array([[0., 1., 2., 3.]])
    """
    if to not in ("pixels", "cracks"):
        raise ValueError("to is 'pixels' or 'cracks'")
    if not 0 < spacing < np.inf:
        raise MedialError("spacing must be positive")
    result = _core.distances(_pixels(image), to == "cracks", frame, squared, options.threads)
    return result if spacing == 1 else result * (spacing * spacing if squared else spacing)


def topology(image: npt.ArrayLike) -> tuple[int, int]:
    """The numbers of components of the foreground (8-connected) and of its holes.

    Parameters
    ----------
    image : array of shape (rows, columns)
        Foreground where it is not 0.

    Examples
    --------
    >>> import numpy as np, medial.image
    >>> square = np.zeros((7, 7), bool)
    >>> square[1:6, 1:6] = True
    >>> medial.image.topology(square)
    (1, 0)
    """
    components, holes = _core.topology(_pixels(image))
    return components, holes


def outline(image: npt.ArrayLike, *, neck: float = 1 / 16) -> list[Floats]:
    """The boundary of the foreground pixels, as rings with y downwards.

    Pixels that meet in a corner only are connected by a neck.

    Parameters
    ----------
    image : array of shape (rows, columns)
        Foreground where it is not 0.
    neck : float
        The width of these necks in pixels, below 1 / 2; 0: none.

    Examples
    --------
    >>> import numpy as np, medial.image
    >>> square = np.zeros((7, 7), bool)
    >>> square[1:6, 1:6] = True
    >>> [len(ring) for ring in medial.image.outline(square)]
    [4]
    """
    points, begin = _core.pixel_outline(_pixels(image), neck)
    return np.split(points, begin[1:-1]) if len(begin) > 1 else []


def disks(x: MedialAxis, pixels: int = 512) -> tuple[Mask, float, tuple[float, float]]:
    """The union of an axis's disks as an image, like `medial rebuild --pixels`.

    Parameters
    ----------
    x : MedialAxis
    pixels : int
        The number of pixels along the longer side.

    Returns
    -------
    image : array of bool
        Rows go in the direction of y.
    spacing : float
        The side of a pixel, in units of the input.
    origin : (x, y)
        The corner of the first pixel with the smallest x and y.

    Examples
    --------
    >>> import medial.image
    >>> image, spacing, _ = medial.image.disks(medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)]), 80)
    >>> round(image.sum() * spacing**2)
    8
    """
    image, spacing, origin = _core.disk_image(x._core, pixels, True)
    return image.view(bool), spacing, origin


@dataclass(frozen=True)
class Squares:
    """An image as squares of pixels; made by `pack`.

    Attributes
    ----------
    streams : tuple of bytes
    count : int
        The number of squares.
    missing : int
        The number of foreground pixels that no square covers.
    """

    streams: tuple[bytes, ...]
    count: int
    missing: int

    @property
    def nbytes(self) -> int:
        """The size in bytes, compressed by zlib."""
        return compressed_size(self.streams)

    def unpack(self) -> Mask:
        """The image that the squares cover."""
        return _core.unpacked_image(list(self.streams)).view(bool)


def pack(image: npt.ArrayLike, error: int = 0) -> Squares:
    """Codes an image as maximal squares of its foreground, like `medial pack --squares`.

    Parameters
    ----------
    image : array
        Foreground where it is not 0.
    error : int
        Each foreground pixel is within this many pixels of a covered one; 0: lossless.

    Examples
    --------
    >>> import numpy as np, medial.image
    >>> square = np.zeros((9, 9), bool); square[2:7, 2:7] = True
    >>> code = medial.image.pack(square)
    >>> code.count, np.array_equal(code.unpack(), square)
    (1, True)
    """
    if not 0 <= error <= 0xFFFF:
        raise MedialError("error must be a number of pixels, from 0 to 65535", "invalid_option")
    streams, count, missing = _core.packed_image(_pixels(image), int(error))
    return Squares(tuple(streams), count, missing)


def _boxes(labels: npt.NDArray[Any]) -> dict[int, tuple[slice, slice]]:
    """The bounding box of each label except 0."""
    rows, columns = np.nonzero(labels)
    values = labels[rows, columns]
    found, index = np.unique(values, return_inverse=True)
    low = np.full((2, len(found)), max(labels.shape))
    high = np.zeros((2, len(found)), np.int64)
    for k, at in enumerate((rows, columns)):
        np.minimum.at(low[k], index, at)
        np.maximum.at(high[k], index, at + 1)
    return {
        int(label): (slice(low[0, i], high[0, i]), slice(low[1, i], high[1, i]))
        for i, label in enumerate(found.tolist())
    }


def axis(
    label_image: npt.ArrayLike,
    *,
    spacing: float | Sequence[float] = 1,
    origin: Sequence[float] = (0, 0),
    smooth: bool = True,
    measure: str | None = "prominence",
    threshold: float | None = None,
    method: str | None = None,
) -> dict[int, MedialAxis]:
    """Exact medial axes of the regions of a label image, as a dict by label.

    Parameters
    ----------
    label_image : array
        The number of each pixel's region; 0 is background.
    spacing : float or (x, y)
        The sides of a pixel.
    origin : (x, y)
        The place of the upper left corner. Rows go in the direction of y.
    smooth : bool
        Replace boundaries by smooth curves within half a pixel of the pixels' edges.
    measure, threshold : optional
        How to prune the axes (`medial.prune`); None: not at all.

    Examples
    --------
    >>> import numpy as np, medial.image
    >>> labels = np.zeros((20, 30), int)
    >>> labels[5:15, 5:25] = 3
    >>> axes = medial.image.axis(labels)
    >>> list(axes), round(float(axes[3].nodes["radius"].max()))
    ([3], 5)
    """
    labels = np.asarray(label_image.filled(0) if isinstance(label_image, np.ma.MaskedArray) else label_image)
    if labels.ndim != 2:
        raise ValueError("label images have two dimensions")
    if labels.dtype.kind not in "biu" and not (labels.dtype.kind == "f" and (labels == np.floor(labels)).all()
                                               and np.isfinite(labels).all()):  # fmt: skip
        raise MedialError("labels must be whole numbers")
    sides, corners = np.ravel(spacing), np.ravel(origin)
    if len(sides) > 2 or len(corners) != 2 or not ((sides > 0) & (sides < np.inf)).all() or not np.isfinite(corners).all():
        raise MedialError("spacing must be a positive number or two, origin must be x and y")
    dx, dy = float(sides[0]), float(sides[-1])
    result = {}
    for label, (rows, columns) in _boxes(labels).items():
        region = np.ascontiguousarray(labels[rows, columns] == label).view(np.uint8)
        corner = (origin[0] + dx * columns.start, origin[1] + dy * rows.start)
        if smooth:
            contours = _core.smooth_outline(region, (dx, dy), corner)
            size = float(np.hypot(region.shape[0] * dy, region.shape[1] * dx))
            own = _axis(Rings(contours=contours), method, arc_tolerance=_ARC * min(dx, dy) / size)
        else:
            points, begin = _core.pixel_outline(region, 1 / 16)
            own = _axis(Rings(points * [dx, dy] + corner, begin), method)
        result[label] = own if measure is None else own.prune(measure, threshold)
    return result
