"""Operations on many features at once: arrays in, arrays out.

Each function takes what `medial.axes` takes, computes on several threads without the
interpreter's lock, and makes no Python object per feature. Errors are raised, or kept by
feature with ``on_error="ignore"``.

>>> import medial.arrays
>>> two = [[(0, 0), (10, 0), (10, 2), (0, 2)], [(0, 0), (4, 0), (4, 1), (0, 1)]]
>>> medial.arrays.width(two)["mean"]
array([2., 1.])
>>> medial.arrays.offset(two, 0.25)
<medial.arrays.Geometries: 2 features, 10 rows>
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._axes import axes, column_of, progress_of, ragged
from ._errors import MedialError, need
from ._options import computing, options
from ._records import Floats, Indices

__all__ = [
    "Geometries", "Lines", "Table", "axis", "branches", "centerline", "inscribed_circles", "offset", "prune",
    "transects", "width",
]  # fmt: skip


class _Result:
    """Rows of numbers, and offsets that divide them into features.

    Attributes
    ----------
    values : array
        Rows of numbers.
    begin : tuple of arrays
        Offsets, innermost first: the first array divides the rows into parts, each further one
        divides the parts of the one before, and the last yields features. Empty if each feature
        has one row.
    errors : dict
        The errors, by feature.
    """

    __slots__ = ("begin", "errors", "values")

    def __init__(self, values: Floats, begin: tuple[Indices, ...], errors: dict[int, MedialError]) -> None:
        self.values, self.begin, self.errors = values, begin, errors

    def __len__(self) -> int:
        return len(self.begin[-1]) - 1 if self.begin else len(self.values)

    @property
    def ok(self) -> npt.NDArray[np.bool_]:
        """Whether each feature has a result."""
        good = np.ones(len(self), bool)
        good[list(self.errors)] = False
        return good

    @property
    def error_codes(self) -> npt.NDArray[Any]:
        """The code of each feature's error; None where there is none."""
        return column_of(self.errors, len(self))

    def __repr__(self) -> str:
        failed = f", {len(self.errors)} errors" if self.errors else ""
        return f"<medial.arrays.{type(self).__name__}: {len(self)} features, {len(self.values)} rows{failed}>"


class Geometries(_Result):
    """One geometry per feature: rows of x and y, and for lines the radius."""

    __slots__ = ()

    def to_wkb(self) -> tuple[npt.NDArray[np.uint8], Indices]:
        """Well-known binary: bytes, and the offset of each feature's."""
        data, offsets = _core.write_wkb(self.values.reshape(-1), self.values.shape[1], list(self.begin))
        return data, offsets

    def to_shapely(self) -> npt.NDArray[Any]:
        """An array of LineStrings, MultiLineStrings or MultiPolygons; None where there is an error."""
        shapely = need("shapely", "geo")
        kinds = shapely.GeometryType
        kind = (kinds.LINESTRING, kinds.MULTILINESTRING, kinds.MULTIPOLYGON)[len(self.begin) - 1]
        made: npt.NDArray[Any] = shapely.from_ragged_array(kind, np.ascontiguousarray(self.values[:, :2]), self.begin)
        made[list(self.errors)] = None
        return made

    def to_arrow(self) -> Any:
        """An Arrow array of well-known binary; null where there is an error."""
        pyarrow = need("pyarrow", "all")
        data, offsets = self.to_wkb()
        large = offsets[-1] > np.iinfo(np.int32).max
        kind = pyarrow.large_binary() if large else pyarrow.binary()
        begin = pyarrow.py_buffer(offsets if large else offsets.astype(np.int32))
        bits = np.packbits(self.ok, bitorder="little")
        valid = pyarrow.py_buffer(bits) if self.errors else None
        return pyarrow.Array.from_buffers(kind, len(self), [valid, begin, pyarrow.py_buffer(data)])


class Lines(Geometries):
    """Several lines per feature, with numbers for each line.

    Attributes
    ----------
    attributes : dict of arrays
        A value for each line.
    """

    __slots__ = ("attributes",)

    def __init__(self, values: Floats, begin: tuple[Indices, ...], errors: dict[int, MedialError],
                 attributes: dict[str, Any]) -> None:  # fmt: skip
        super().__init__(values, begin, errors)
        self.attributes = attributes

    @property
    def feature(self) -> Indices:
        """The feature of each line."""
        return np.repeat(np.arange(len(self)), np.diff(self.begin[1]))

    def lines(self) -> npt.NDArray[Any]:
        """A shapely LineString for each line."""
        shapely = need("shapely", "geo")
        flat = np.ascontiguousarray(self.values[:, :2])
        made: npt.NDArray[Any] = shapely.from_ragged_array(shapely.GeometryType.LINESTRING, flat, (self.begin[0],))
        return made

    def to_pandas(self) -> Any:
        """A DataFrame with a row for each line, indexed by feature."""
        table = need("pandas", "all").DataFrame(self.attributes, index=self.feature)
        return table.rename_axis("feature")


class Table(_Result):
    """Numbers per feature: one row (NaN where there is an error), or several.

    Attributes
    ----------
    columns : tuple of str
        The names of the columns of ``values``.
    """

    __slots__ = ("columns",)

    def __init__(self, values: Floats, begin: tuple[Indices, ...], errors: dict[int, MedialError],
                 columns: tuple[str, ...]) -> None:  # fmt: skip
        super().__init__(values, begin, errors)
        self.columns = columns

    def __getitem__(self, name: str) -> Floats:
        column: Floats = self.values[:, self.columns.index(name)]
        return column

    @property
    def feature(self) -> Indices:
        """The feature of each row."""
        if not self.begin:
            return np.arange(len(self.values))
        return np.repeat(np.arange(len(self)), np.diff(self.begin[0]))

    def to_pandas(self) -> Any:
        """A DataFrame with a row for each row, indexed by feature."""
        table = need("pandas", "all").DataFrame(self.values, columns=list(self.columns), index=self.feature)
        return table.rename_axis("feature")

    def to_arrow(self) -> Any:
        """An Arrow array of structs, or of lists of them; null where there is an error."""
        pyarrow = need("pyarrow", "all")
        missing, names = ~self.ok, list(self.columns)
        fields = [pyarrow.array(np.ascontiguousarray(column)) for column in self.values.T]
        if not self.begin:
            return pyarrow.StructArray.from_arrays(fields, names, mask=pyarrow.array(missing))
        rows = pyarrow.StructArray.from_arrays(fields, names)
        offsets = pyarrow.array(self.begin[0].astype(np.int32), mask=np.append(missing, False))
        return pyarrow.ListArray.from_arrays(offsets, rows)


def _each(
    x: Any, operation: str, given: dict[str, Any], method: str | None, on_error: str,
    threads: int | None, progress: Any,
) -> tuple[Floats, tuple[Indices, ...], dict[int, MedialError], Floats]:  # fmt: skip
    """Applies an operation to features: returns rows, offsets, errors and attributes of parts."""
    if on_error not in ("raise", "ignore"):
        raise ValueError("on_error is 'raise' or 'ignore'")
    features = ragged(x)
    computed = computing(method, threads=threads)
    with progress_of(progress, len(features)) as shown:
        flat, columns, begin, failed, attributes = _core.each_of(
            features.coordinates, features.ring, features.polygon, features.feature, features.bulges,
            computed, operation, given, shown,
        )
    errors = features.errors(failed)
    if errors and on_error == "raise":
        raise errors[min(errors)]
    return flat.reshape(-1, columns), tuple(begin), errors, attributes


def axis(x: Any, method: str | None = None, *, chord: float | None = None, on_error: str = "raise",
         threads: int | None = None, progress: Any = False) -> Geometries:  # fmt: skip
    """The medial axes as MultiLineStrings; `medial.axes` returns them as graphs.

    Parameters
    ----------
    x : features
        What `medial.axes` takes.
    method : str, optional
        See `medial.axis`.
    chord : float, optional
        The largest distance of chords from the curves, in units of the input; by default
        ``medial.options.chord`` times the diagonal.
    on_error : {"raise", "ignore"}
        Raise the first error, or keep all of them in `errors`.
    threads : int, optional
        The default is ``medial.options.threads``.
    progress : bool or callable
        True shows a bar of tqdm; a function is called with the share of features done.

    Examples
    --------
    >>> import medial.arrays
    >>> two = [[(0, 0), (10, 0), (10, 2), (0, 2)], [(0, 0), (4, 0), (4, 1), (0, 1)]]
    >>> medial.arrays.axis(two)
    <medial.arrays.Geometries: 2 features, 20 rows>
    """
    found = axes(x, method, on_error=on_error, threads=threads, progress=progress)
    points, lines, features = found.lines(chord)
    return Geometries(points, (lines, features), found.errors)


def centerline(x: Any, method: str | None = None, *, trim: float = 1, route: str = "roomy", extend: bool = False,
               smooth: float = 0, chord: float | None = None, on_error: str = "raise",
               threads: int | None = None, progress: Any = False) -> Geometries:  # fmt: skip
    """The centre lines as LineStrings; see `medial.centerline`.

    Parameters
    ----------
    x : features
        What `medial.axes` takes.
    method : str, optional
        See `medial.axis`.
    trim, route, extend, smooth
        See `medial.centerlines`.
    chord : float, optional
        The largest distance of chords from the curves, in units of the input; by default
        ``medial.options.chord`` times the diagonal.
    on_error : {"raise", "ignore"}
        Raise the first error, or keep all of them in `errors`.
    threads : int, optional
        The default is ``medial.options.threads``.
    progress : bool or callable
        True shows a bar of tqdm; a function is called with the share of features done.

    Examples
    --------
    >>> import medial.arrays
    >>> two = [[(0, 0), (10, 0), (10, 2), (0, 2)], [(0, 0), (4, 0), (4, 1), (0, 1)]]
    >>> medial.arrays.centerline(two, extend=True).values[:, :2].tolist()[:1]
    [[10.0, 1.0]]
    """
    given = {"trim": trim, "route": route, "extend": extend, "smooth": smooth, "chord": chord, "share": options.chord}
    return Geometries(*_each(x, "centerline", given, method, on_error, threads, progress)[:3])


def width(x: Any, samples: int = 100, method: str | None = None, *, trim: float = 1, route: str = "roomy",
          on_error: str = "raise", threads: int | None = None, progress: Any = False) -> Table:  # fmt: skip
    """The mean, smallest and largest width along the centre lines, and their lengths.

    Parameters
    ----------
    x : features
        What `medial.axes` takes.
    samples : int
        The number of places along each line.
    method : str, optional
        See `medial.axis`.
    trim, route
        See `medial.centerlines`.
    on_error : {"raise", "ignore"}
        Raise the first error, or keep all of them in `errors`.
    threads : int, optional
        The default is ``medial.options.threads``.
    progress : bool or callable
        True shows a bar of tqdm; a function is called with the share of features done.

    Examples
    --------
    >>> import medial.arrays
    >>> two = [[(0, 0), (10, 0), (10, 2), (0, 2)], [(0, 0), (4, 0), (4, 1), (0, 1)]]
    >>> medial.arrays.width(two)["min"]
    array([2., 1.])
    """
    given = {"samples": samples, "trim": trim, "route": route}
    return Table(*_each(x, "width", given, method, on_error, threads, progress)[:3], ("mean", "min", "max", "length"))


def inscribed_circles(x: Any, count: int = 1, smallest: float = 0, *, on_error: str = "raise",
                      threads: int | None = None, progress: Any = False) -> Table:  # fmt: skip
    """The largest disjoint circles; see `medial.inscribed_circles`.

    Parameters
    ----------
    x : features
        What `medial.axes` takes.
    count : int
        The largest number of circles of each feature.
    smallest : float
        No radius is below this, in units of the input.
    on_error : {"raise", "ignore"}
        Raise the first error, or keep all of them in `errors`.
    threads : int, optional
        The default is ``medial.options.threads``.
    progress : bool or callable
        True shows a bar of tqdm; a function is called with the share of features done.

    Examples
    --------
    >>> import medial.arrays
    >>> two = [[(0, 0), (10, 0), (10, 2), (0, 2)], [(0, 0), (4, 0), (4, 1), (0, 1)]]
    >>> medial.arrays.inscribed_circles(two)["radius"]
    array([1. , 0.5])
    """
    given = {"count": count, "smallest": float(smallest)}
    return Table(*_each(x, "inscribed_circles", given, None, on_error, threads, progress)[:3], ("x", "y", "radius"))


def offset(x: Any, distance: float, *, chord: float | None = None, on_error: str = "raise",
           threads: int | None = None, progress: Any = False) -> Geometries:  # fmt: skip
    """Offset regions as MultiPolygons: the points farther than `distance` from the boundary.

    Parameters
    ----------
    x : features
        What `medial.axes` takes.
    distance : float
        In units of the input.
    chord : float, optional
        The largest distance of chords from the curves, in units of the input; by default
        ``medial.options.chord`` times the diagonal.
    on_error : {"raise", "ignore"}
        Raise the first error, or keep all of them in `errors`.
    threads : int, optional
        The default is ``medial.options.threads``.
    progress : bool or callable
        True shows a bar of tqdm; a function is called with the share of features done.

    Examples
    --------
    >>> import medial.arrays
    >>> two = [[(0, 0), (10, 0), (10, 2), (0, 2)], [(0, 0), (4, 0), (4, 1), (0, 1)]]
    >>> len(medial.arrays.offset(two, 0.25))
    2
    """
    given = {"distance": float(distance), "chord": chord, "share": options.chord}
    return Geometries(*_each(x, "offset", given, None, on_error, threads, progress)[:3])


def prune(x: Any, measure: str = "prominence", threshold: float | None = None, method: str | None = None, *,
          keep: int | None = None, tips: bool = False, chord: float | None = None, on_error: str = "raise",
          threads: int | None = None, progress: Any = False) -> Geometries:  # fmt: skip
    """The pruned axes as MultiLineStrings; see `medial.prune`.

    Parameters
    ----------
    x : features
        What `medial.axes` takes.
    measure, threshold, keep, tips
        See `medial.prune`.
    method : str, optional
        See `medial.axis`.
    chord : float, optional
        The largest distance of chords from the curves, in units of the input; by default
        ``medial.options.chord`` times the diagonal.
    on_error : {"raise", "ignore"}
        Raise the first error, or keep all of them in `errors`.
    threads : int, optional
        The default is ``medial.options.threads``.
    progress : bool or callable
        True shows a bar of tqdm; a function is called with the share of features done.

    Examples
    --------
    >>> import medial.arrays
    >>> two = [[(0, 0), (10, 0), (10, 2), (0, 2)], [(0, 0), (4, 0), (4, 1), (0, 1)]]
    >>> medial.arrays.prune(two, "erosion", 0.5)
    <medial.arrays.Geometries: 2 features, 4 rows>
    """
    given = {"measure": measure, "threshold": threshold, "keep": keep, "tips": tips, "chord": chord,
             "share": options.chord}  # fmt: skip
    return Geometries(*_each(x, "prune", given, method, on_error, threads, progress)[:3])


_POINTS = np.array(["end", "normal", "branching"], object)
_BRANCH = {  # in the order of the extension module
    "branch": int, "node_from": int, "node_to": int, "from_kind": None, "to_kind": None, "closed": bool,
    "length": float, "radius_min": float, "radius_max": float, "mean_width": float, "turning": float,
    "absolute_turning": float, "area": float, "significance": float, "euclidean": float, "component": int,
}  # fmt: skip


def branches(x: Any, method: str | None = None, *, chord: float | None = None, on_error: str = "raise",
             threads: int | None = None, progress: Any = False) -> Lines:  # fmt: skip
    """The branches of all axes as lines, with the columns of `medial.MedialAxis.branches`.

    Parameters
    ----------
    x : features
        What `medial.axes` takes.
    method : str, optional
        See `medial.axis`.
    chord : float, optional
        The largest distance of chords from the curves, in units of the input; by default
        ``medial.options.chord`` times the diagonal.
    on_error : {"raise", "ignore"}
        Raise the first error, or keep all of them in `errors`.
    threads : int, optional
        The default is ``medial.options.threads``.
    progress : bool or callable
        True shows a bar of tqdm; a function is called with the share of features done.

    Examples
    --------
    >>> import medial.arrays
    >>> found = medial.arrays.branches([[(0, 0), (4, 0), (4, 2), (0, 2)], [(0, 0), (3, 0), (0, 3)]])
    >>> found.feature.tolist(), float(found.attributes["length"].max())
    ([0, 0, 0, 0, 0, 1, 1, 1], 2.2961...)
    """
    given = {"chord": chord, "share": options.chord}
    values, begin, errors, flat = _each(x, "branches", given, method, on_error, threads, progress)
    columns = flat.reshape(-1, len(_BRANCH)).T
    attributes = {name: _POINTS[column.astype(int)] if kind is None else column.astype(kind)
                  for (name, kind), column in zip(_BRANCH.items(), columns, strict=True)}  # fmt: skip
    return Lines(values, begin, errors, attributes)


def transects(x: Any, count: int = 10, method: str | None = None, *, trim: float = 1, route: str = "roomy",
              on_error: str = "raise", threads: int | None = None, progress: Any = False) -> Lines:  # fmt: skip
    """Lines across shapes, with along, width and span; see `medial.transects`.

    Parameters
    ----------
    x : features
        What `medial.axes` takes.
    count : int
        The number of transects: one in the middle of each of `count` equal parts of a centre line.
    method : str, optional
        See `medial.axis`.
    trim, route
        See `medial.centerlines`.
    on_error : {"raise", "ignore"}
        Raise the first error, or keep all of them in `errors`.
    threads : int, optional
        The default is ``medial.options.threads``.
    progress : bool or callable
        True shows a bar of tqdm; a function is called with the share of features done.

    Examples
    --------
    >>> import medial.arrays
    >>> medial.arrays.transects([[(0, 0), (10, 0), (10, 2), (0, 2)]], 4).attributes["along"]
    array([1., 3., 5., 7.])
    """
    given = {"count": count, "trim": trim, "route": route}
    values, begin, errors, flat = _each(x, "transects", given, method, on_error, threads, progress)
    attributes: dict[str, Any] = dict(zip(("along", "width", "span"), flat.reshape(-1, 3).T, strict=True))
    return Lines(values, begin, errors, attributes)
