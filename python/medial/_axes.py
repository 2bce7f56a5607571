"""The axes of many features at once, as arrays."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Any, overload

import numpy as np
import numpy.typing as npt

from . import _core
from ._axis import MedialAxis
from ._errors import MedialError, need
from ._options import computing, log, options
from ._read import OUTER, Ragged, from_wkb, from_wkb_buffer, read, rows
from ._records import EDGE, NODE, SITE, Floats, Indices, Records, numbers_of, records
from ._shape import Shape, load


_AT_A_TIME = 4096  # few enough for their coordinates to stay in the cache until shapely reads them


class Axes:
    """The axes of many features as one struct of arrays; made by `axes`.

    The nodes of feature i are ``nodes[node_begin[i]:node_begin[i + 1]]``; edges and sites work in
    the same way. Indices in edges count from the first node or site of the feature.

    Examples
    --------
    >>> import medial
    >>> a = medial.axes([[(0, 0), (4, 0), (4, 2), (0, 2)], [(0, 0), (3, 0), (0, 3)]])
    >>> len(a), a.node_begin
    (2, array([ 0,  6, 10]))
    >>> a[1]
    <medial.MedialAxis: 4 nodes, 3 edges, 3 sites, method disks>
    >>> len(a[:1])
    1
    """

    __slots__ = ("_core", "_input", "_errors", "__weakref__")

    def __init__(self, core: _core.Axes, given: Ragged) -> None:
        self._core = core
        self._input = given
        self._errors = given.errors(core.errors())

    @property
    def nodes(self) -> Records:
        """The nodes of all features; fields as in `MedialAxis.nodes`."""
        return records(self._core.nodes(), NODE)

    @property
    def edges(self) -> Records:
        """The edges of all features; fields as in `MedialAxis.edges`."""
        return records(self._core.edges(), EDGE)

    @property
    def sites(self) -> Records:
        """The sites of all features; fields as in `MedialAxis.sites`."""
        return records(self._core.sites(), SITE)

    @property
    def node_begin(self) -> Indices:
        """The index of each feature's first node, and the number of all nodes."""
        return self._core.node_begin().view(np.int64)

    @property
    def edge_begin(self) -> Indices:
        """The index of each feature's first edge, and the number of all edges."""
        return self._core.edge_begin().view(np.int64)

    @property
    def site_begin(self) -> Indices:
        """The index of each feature's first site, and the number of all sites."""
        return self._core.site_begin().view(np.int64)

    @property
    def errors(self) -> dict[int, MedialError]:
        """The errors, by feature. A feature with an error has no nodes."""
        return dict(self._errors)

    @property
    def error_codes(self) -> npt.NDArray[Any]:
        """The code of each feature's error; None where there is none."""
        return column_of(self._errors, len(self))

    @property
    def method(self) -> str:
        """The name of the method."""
        return self._core.method()

    @property
    def ok(self) -> npt.NDArray[np.bool_]:
        """Whether each feature has an axis."""
        return np.diff(self.node_begin) > 0

    def summary(self) -> dict[str, Floats]:
        """The length of each feature's axis, and its maximum inscribed circle.

        Examples
        --------
        >>> import medial
        >>> a = medial.axes([[(0, 0), (4, 0), (4, 2), (0, 2)], [(0, 0), (3, 0), (0, 3)]])
        >>> a.summary()["radius"].round(3)
        array([1.   , 0.879])
        """
        rows = self._core.summary()
        return dict(zip(("length", "radius", "x", "y"), rows.T, strict=True))

    def lines(self, chord: float | None = None) -> tuple[Floats, Indices, Indices]:
        """All branches as polylines.

        Parameters
        ----------
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal of each axis.

        Returns
        -------
        points, line_begin, feature_begin
            Rows of x, y and radius; the first row of each line; the first line of each feature.

        Examples
        --------
        >>> import medial
        >>> a = medial.axes([[(0, 0), (4, 0), (4, 2), (0, 2)], [(0, 0), (3, 0), (0, 3)]])
        >>> points, line_begin, feature_begin = a.lines()
        >>> feature_begin.tolist()
        [0, 5, 8]
        """
        return self._lines(chord, 0, len(self), flat=False)

    def _lines(self, chord: float | None, first: int, last: int, *, flat: bool) -> tuple[Floats, Indices, Indices]:
        own = options.chord if chord is None else chord
        points, lines, features = self._core.lines(own, chord is None, first, last, flat)
        return points, lines, features

    def to_shapely(self, chord: float | None = None) -> npt.NDArray[Any]:
        """An array of MultiLineStrings in the plane, one per feature; `lines` has the radius, too.

        Parameters
        ----------
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal.

        Examples
        --------
        >>> import medial
        >>> a = medial.axes([[(0, 0), (4, 0), (4, 2), (0, 2)], [(0, 0), (3, 0), (0, 3)]])
        >>> a.to_shapely()[1].geom_type
        'MultiLineString'
        """
        shapely = need("shapely", "geo")
        kind, size = shapely.GeometryType.MULTILINESTRING, len(self)
        result: npt.NDArray[Any] = np.empty(size, object)
        for first in range(0, size, _AT_A_TIME):
            last = min(first + _AT_A_TIME, size)
            points, lines, features = self._lines(chord, first, last, flat=True)
            result[first:last] = shapely.from_ragged_array(kind, points, (lines, features))
        return result

    def to_geopandas(self, chord: float | None = None, index: Any = None, crs: Any = None) -> Any:
        """A GeoSeries of MultiLineStrings.

        Parameters
        ----------
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal.
        index : optional
            The index of the series.
        crs : optional
            The reference system.

        Examples
        --------
        >>> import medial
        >>> a = medial.axes([[(0, 0), (4, 0), (4, 2), (0, 2)], [(0, 0), (3, 0), (0, 3)]])
        >>> a.to_geopandas(index=["a", "b"]).index.tolist()
        ['a', 'b']
        """
        return need("geopandas", "geo").GeoSeries(self.to_shapely(chord), index=index, crs=crs)

    def to_arrow(self, chord: float | None = None) -> Any:
        """A GeoArrow array of MultiLineStrings; makes no Python object per feature.

        Parameters
        ----------
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal.

        Examples
        --------
        >>> import medial
        >>> a = medial.axes([[(0, 0), (4, 0), (4, 2), (0, 2)], [(0, 0), (3, 0), (0, 3)]])
        >>> len(a.to_arrow())
        2
        """
        pyarrow = need("pyarrow", "all")
        points, lines, features = self._lines(chord, 0, len(self), flat=True)
        flat = pyarrow.array(points.reshape(-1))
        coordinates = pyarrow.FixedSizeListArray.from_arrays(flat, 2)
        for begin in (lines, features):
            large = begin[-1] > np.iinfo(np.int32).max
            kind = pyarrow.LargeListArray if large else pyarrow.ListArray
            coordinates = kind.from_arrays(pyarrow.array(begin if large else begin.astype(np.int32)), coordinates)
        return coordinates

    def __len__(self) -> int:
        return len(self._core)

    if TYPE_CHECKING:  # typing would keep the functions when the interpreter ends

        @overload
        def __getitem__(self, i: int) -> MedialAxis: ...

        @overload
        def __getitem__(self, i: slice) -> list[MedialAxis]: ...

    def __getitem__(self, i: int | slice) -> MedialAxis | list[MedialAxis]:
        """The axis of one feature, or a list of axes for a slice. Raises the error of a feature."""
        if isinstance(i, slice):
            return [self[at] for at in range(len(self))[i]]
        at = range(len(self))[i]
        if at in self._errors:
            raise self._errors[at].with_traceback(None)
        shape, _ = load(self._input.one(at))
        return MedialAxis._of(self._core.axis(at, shape), self._input.attributes.get(at, {}))

    def __iter__(self) -> Iterator[MedialAxis]:
        """The axis of each feature. Raises the error of a feature; `next` then continues after it."""
        return map(self.__getitem__, range(len(self)))

    def __reduce__(self) -> tuple[Any, ...]:
        features = replace(self._input, failed=[(e.text, e.code, i, e.ring, e.vertex, e.point) for i, e in self._errors.items()])
        return _restored, (self._core.state(), features)

    def __repr__(self) -> str:
        failed = f", {len(self._errors)} errors" if self._errors else ""
        return f"<medial.Axes: {len(self)} features, {len(self.nodes)} nodes, {len(self.edges)} edges{failed}>"


def _restored(state: tuple[Any, ...], features: Ragged) -> Axes:
    """Axes from their pickled state."""
    return Axes(_core.restored_axes(*state), features)


def column_of(errors: dict[int, MedialError], size: int) -> npt.NDArray[Any]:
    """The codes of errors by feature."""
    column: npt.NDArray[Any] = np.full(size, None, object)
    for feature, error in errors.items():
        column[feature] = error.code
    return column


def _loops_of(value: Any) -> tuple[Floats, Indices, npt.NDArray[np.bool_], Floats | None]:
    """The rings of one feature: coordinates, offsets, flags of outer rings, bulges. Curves become arcs."""
    if value is None:
        raise MedialError("the geometry is missing", "empty")
    rings = read(value)
    if not rings.contours and rings.bulges is None and rings.coordinates is not None:
        begin = np.array([0, len(rings.coordinates)]) if rings.begin is None else rings.begin
        outer = np.zeros(len(begin) - 1, bool) if rings.roles is None else rings.roles == OUTER
        return rings.coordinates, begin, outer, None
    shape = Shape._of(load(rings)[0])
    order = np.lexsort((shape.hole, shape.component))
    starts: list[int] = shape.loop_begin.tolist()
    loops = [np.arange(starts[i], starts[i + 1]) for i in order.tolist()]
    at, bulges = np.concatenate(loops), shape.bulges
    offsets = np.cumsum([0, *map(len, loops)])
    return shape.points[at], offsets, ~shape.hole[order], bulges[at] if len(bulges) else None


def _from_values(values: Iterable[Any]) -> Ragged:
    """Features of any kind, one polygon per outer ring. A value that cannot be read is an error of its feature."""
    ring, polygon, feature, failed = [0], [0], [0], []
    parts, arcs, curved = [np.empty((0, 2))], [np.empty(0)], False
    attributes: dict[int, Mapping[str, Any]] = {}
    for i, value in enumerate(values):
        if isinstance(value, Shape) and value.attributes:
            attributes[i] = dict(value.attributes)
        try:
            points, begin, outer, bulges = _loops_of(value)
        except MedialError as error:
            failed.append((error.text, error.code, i, error.ring, error.vertex, error.point))
            feature.append(feature[-1])
            continue
        parts.append(points)
        arcs.append(np.zeros(len(points)) if bulges is None else bulges)
        curved = curved or bulges is not None
        sizes = np.diff(begin).tolist()
        for k, (size, begins) in enumerate(zip(sizes, outer.tolist(), strict=True)):
            if k and begins:
                polygon.append(len(ring) - 1)
            ring.append(ring[-1] + size)
        if sizes:
            polygon.append(len(ring) - 1)
        feature.append(len(polygon) - 1)
    return Ragged(np.concatenate(parts), np.asarray(ring), np.asarray(polygon), np.asarray(feature), failed,
                  np.concatenate(arcs) if curved else None, attributes)  # fmt: skip


def _from_arrow(array: Any) -> Ragged:
    """Features of an Arrow array (WKB, GeoArrow polygons or multipolygons), without Python objects."""
    pyarrow = need("pyarrow", "all")
    array = pyarrow.chunked_array(array) if not isinstance(array, pyarrow.Array) and not isinstance(array, pyarrow.ChunkedArray) else array
    if isinstance(array, pyarrow.ChunkedArray):
        array = array.combine_chunks()
        if isinstance(array, pyarrow.ChunkedArray):
            array = pyarrow.concat_arrays(array.chunks)
    if isinstance(array, pyarrow.ExtensionArray):
        array = array.storage
    kind = array.type
    if pyarrow.types.is_binary(kind) or pyarrow.types.is_large_binary(kind):
        width = np.int32 if pyarrow.types.is_binary(kind) else np.int64
        buffers = array.buffers()
        first = array.offset
        offsets = np.frombuffer(buffers[1], width)[first : first + len(array) + 1].astype(np.int64)
        missing = np.flatnonzero(array.is_null().to_numpy(zero_copy_only=False)) if array.null_count else ()
        return from_wkb_buffer(np.frombuffer(buffers[2] or b"", np.uint8), offsets, missing)
    return _from_geoarrow(pyarrow, array)


def _from_geoarrow(pyarrow: Any, array: Any) -> Ragged:
    """GeoArrow polygons or multipolygons; points are structs of x and y, or lists of a fixed size."""
    if array.null_count:
        raise MedialError("a geometry of the array is null", "empty")
    offsets_list: list[Indices] = []
    while pyarrow.types.is_list(array.type) or pyarrow.types.is_large_list(array.type):
        offsets = array.offsets.to_numpy().astype(np.int64)
        offsets_list.append(offsets - offsets[0])
        array = array.flatten()
    if len(offsets_list) not in (2, 3):
        raise MedialError("the Arrow array holds neither WKB, polygons nor multipolygons", "unsupported")
    if pyarrow.types.is_struct(array.type) and array.type.num_fields >= 2:
        flat = np.stack([array.field(0).to_numpy(False), array.field(1).to_numpy(False)], axis=1)
    elif pyarrow.types.is_fixed_size_list(array.type) and array.type.list_size >= 2:
        flat = array.flatten().to_numpy(False).reshape(-1, array.type.list_size)[:, :2]
    else:
        raise MedialError(f"the points of the Arrow array are {array.type}, not x and y", "unsupported")
    flat = numbers_of(flat, "coordinates must be rows of x and y")
    ring = offsets_list[-1]
    return Ragged(np.ascontiguousarray(flat, np.float64), ring, offsets_list[-2],
                  offsets_list[0] if len(offsets_list) == 3 else None)  # fmt: skip


def _offsets(part: Any) -> Indices:
    numbers = numbers_of(part, "offsets are whole numbers")
    if numbers.ndim != 1 or not len(numbers) or not (numbers == np.floor(numbers)).all():
        raise MedialError("offsets must be whole numbers that start at 0", "malformed")
    return np.ascontiguousarray(part, np.int64)


def ragged(x: Any) -> Ragged:
    """Features of any source as arrays."""
    if isinstance(x, Ragged):
        return x
    if isinstance(x, tuple) and len(x) in (2, 3) and isinstance(x[-2], np.ndarray) and isinstance(x[-1], tuple):
        coordinates, offsets = x[-2:]
        if len(offsets) not in (2, 3):
            raise MedialError("offsets must be (ring, polygon) or (ring, polygon, feature)", "malformed")
        ring, polygon, *feature = (_offsets(part) for part in offsets)
        return Ragged(rows(coordinates), ring, polygon, feature[0] if feature else None)
    if hasattr(x, "__arrow_c_stream__") and not hasattr(x, "geometry"):
        return _from_arrow(x)
    if hasattr(x, "__arrow_c_array__"):
        pyarrow = need("pyarrow", "all")
        return _from_arrow(x if isinstance(x, pyarrow.Array) else pyarrow.array(x))
    series = getattr(x, "geometry", x) if hasattr(x, "columns") else x
    if to_wkb := getattr(series, "to_wkb", None):  # a GeoSeries or a GeometryArray
        return from_wkb(np.asarray(to_wkb(), dtype=object))
    if isinstance(x, (str, bytes, bytearray, Mapping)) or not isinstance(x, Iterable):
        raise MedialError(f"a {type(x).__name__} is not a sequence of features; for one feature, use medial.axis()", "unsupported")
    values = list(x) if not isinstance(x, np.ndarray) else x
    first = next((value for value in values if value is not None), None)
    if type(first).__module__.startswith("shapely."):
        with suppress(TypeError):  # the others are something else
            return from_wkb(need("shapely", "geo").to_wkb(np.fromiter(values, object, len(values))))
    if isinstance(first, bytes) and all(value is None or isinstance(value, bytes) for value in values):
        return from_wkb(values)
    return _from_values(values)


@contextmanager
def progress_of(wanted: Any, total: int) -> Iterator[Callable[[int], None] | None]:
    """Turns counts of features done into a bar of tqdm, or calls of a function with the share done."""
    if not wanted:
        yield None
    elif callable(wanted):
        done = 0

        def report(count: int) -> None:
            nonlocal done
            done += count
            wanted(done / max(total, 1))

        yield report
    else:
        with need("tqdm.auto", "all").tqdm(total=total) as bar:
            yield bar.update


def axes(
    x: Any,
    method: str | None = None,
    *,
    on_error: str = "raise",
    threads: int | None = None,
    progress: Any = False,
    tolerance: float = 0,
    exterior: bool = False,
    margin: float = 0,
    **own: Any,
) -> Axes:
    """The medial axes of many features at once.

    Parameters
    ----------
    x : features
        A GeoSeries or GeoDataFrame, a sequence of anything that `axis` takes,
        well-known binary in a sequence or an Arrow array, a GeoArrow array of polygons or
        multipolygons, or what ``shapely.to_ragged_array`` returns: ``(coordinates, offsets)``
        with or without the geometry type before them.
    method : str, optional
        See `axis`.
    on_error : {"raise", "ignore"}
        Raise the first error, or keep all of them in ``Axes.errors``.
    threads : int, optional
        The default is ``medial.options.threads``.
    progress : bool or callable
        True shows a bar of tqdm; a function is called with the share of features done.
    **own
        Options of the method.

    Returns
    -------
    Axes

    Examples
    --------
    >>> import medial
    >>> good, bad = [(0, 0), (4, 0), (4, 2), (0, 2)], [(0, 0), (2, 2), (2, 0), (0, 2)]
    >>> a = medial.axes([good, bad], on_error="ignore")
    >>> a.ok, a.errors[1].code
    (array([ True, False]), 'crossing')
    """
    if on_error not in ("raise", "ignore"):
        raise ValueError("on_error is 'raise' or 'ignore'")
    given = ragged(x)
    computed = computing(method, tolerance=tolerance, threads=threads, exterior=exterior,
                         margin=margin, own=own)  # fmt: skip
    with progress_of(progress, len(given)) as shown:
        core = _core.axes_of(given.coordinates, given.ring, given.polygon, given.feature, given.bulges, computed, shown)
    result = Axes(core, given)
    errors = result.errors
    log("%d features, %d errors", len(result), len(errors))
    if on_error == "raise" and errors:
        raise errors[min(errors)]
    return result
