"""GeoPandas: `import medial.geo` adds the accessor ``.medial`` to GeoDataFrames and GeoSeries.

It keeps the index and the reference system. Each call projects longitudes and latitudes to metres
locally, and projects results back.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from . import arrays
from ._axes import Axes, axes
from ._errors import MedialError, need

geopandas = need("geopandas", "geo")
pandas = need("pandas", "geo")
shapely = need("shapely", "geo")


def _local_crs(series: Any) -> Any:
    """A projection in metres for geometries in degrees: conformal if they are close together."""
    west, south, east, north = series.total_bounds.tolist()
    lon, lat = (west + east) / 2, (south + north) / 2
    wide = (east - west) * np.cos(np.radians(lat)) > 5 or north - south > 5
    name = "laea" if wide else "tmerc"
    return f"+proj={name} +lat_0={lat!r} +lon_0={lon!r} +datum=WGS84 +units=m +no_defs"


class MedialAccessor:
    """Medial axes of the polygons of a GeoDataFrame or GeoSeries, as ``gdf.medial``.

    Examples
    --------
    >>> import geopandas, shapely, medial.geo
    >>> s = geopandas.GeoSeries([shapely.box(0, 0, 10, 2)], index=["a"], crs=2056)
    >>> round(s.medial.width().loc["a", "mean"], 9)
    np.float64(2.0)
    >>> s.medial.centerline(extend=True).loc["a"].length
    10.0
    """

    def __init__(self, data: Any) -> None:
        if not hasattr(data, "geometry") or not isinstance(data, (geopandas.GeoDataFrame, geopandas.GeoSeries)):
            raise AttributeError("`.medial` is for GeoDataFrames and GeoSeries")
        self._series = data.geometry
        self._crs = self._series.crs
        self._local: Any = None

    def _metric(self) -> Any:
        if self._crs is None or not self._crs.is_geographic or not np.isfinite(self._series.total_bounds).all():
            return self._series
        west, south, east, north = self._series.total_bounds
        if west < -540 or east > 540 or south < -90 or north > 90:
            raise MedialError("the reference system is geographic, but the coordinates are not longitudes and latitudes", "invalid_option")
        self._local = _local_crs(self._series)
        return self._series.to_crs(self._local)

    def _back(self, geometries: Any, index: Any = None) -> Any:
        local = self._local or self._crs
        series = geopandas.GeoSeries(geometries, index=self._series.index if index is None else index, crs=local)
        return series.to_crs(self._crs) if self._local else series

    def axes(self, method: str | None = None, **given: Any) -> Axes:
        """The axes as arrays, in metres if the reference system is geographic.

        Parameters
        ----------
        method : str, optional
            See `medial.axis`.
        **given
            Options of `medial.axes`.

        Examples
        --------
        >>> import geopandas, shapely, medial.geo
        >>> s = geopandas.GeoSeries([shapely.box(0, 0, 10, 2)], index=["a"], crs=2056)
        >>> s.medial.axes()
        <medial.Axes: 1 features, 6 nodes, 5 edges>
        """
        return axes(self._metric(), method, **given)

    def axis(self, method: str | None = None, *, chord: float | None = None, **given: Any) -> Any:
        """The axes as a GeoSeries of MultiLineStrings.

        Parameters
        ----------
        method : str, optional
            See `medial.axis`.
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal.
        **given
            Options of `medial.axes`.

        Examples
        --------
        >>> import geopandas, shapely, medial.geo
        >>> s = geopandas.GeoSeries([shapely.box(0, 0, 10, 2)], index=["a"], crs=2056)
        >>> len(s.medial.axis()["a"].geoms)
        5
        """
        return self._back(axes(self._metric(), method, **given).to_shapely(chord))

    def branches(self, chord: float | None = None) -> Any:
        """A GeoDataFrame with one row per branch, indexed by feature and branch.

        Parameters
        ----------
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal.

        Examples
        --------
        >>> import geopandas, shapely, medial.geo
        >>> s = geopandas.GeoSeries([shapely.box(0, 0, 10, 2)], index=["a"], crs=2056)
        >>> s.medial.branches().index.names
        FrozenList(['feature', 'branch'])
        """
        found = arrays.branches(self._metric(), chord=chord)
        table = found.to_pandas()
        features = self._series.index.take(table.index).rename("feature")
        index = pandas.MultiIndex.from_arrays([features, table.pop("branch")], names=["feature", "branch"])
        return self._frame(table.set_axis(index), found.lines(), index)

    def centerline(self, **given: Any) -> Any:
        """The centre lines as a GeoSeries of LineStrings.

        Parameters
        ----------
        **given
            Options of `medial.arrays.centerline`.

        Examples
        --------
        >>> import geopandas, shapely, medial.geo
        >>> s = geopandas.GeoSeries([shapely.box(0, 0, 10, 2)], index=["a"], crs=2056)
        >>> s.medial.centerline(extend=True)["a"].length
        10.0
        """
        return self._back(arrays.centerline(self._metric(), **given).to_shapely())

    centreline = centerline

    def width(self, samples: int = 100, **given: Any) -> Any:
        """A DataFrame of the widths along the centre lines: mean, min, max, length.

        Parameters
        ----------
        samples : int
            The number of places along each line.
        **given
            Options of `medial.arrays.width`.

        Examples
        --------
        >>> import geopandas, shapely, medial.geo
        >>> s = geopandas.GeoSeries([shapely.box(0, 0, 10, 2)], index=["a"], crs=2056)
        >>> s.medial.width().columns.tolist()
        ['mean', 'min', 'max', 'length']
        """
        found = arrays.width(self._metric(), samples, **given)
        return found.to_pandas().set_axis(self._series.index)

    def transects(self, count: int = 10, **given: Any) -> Any:
        """A GeoDataFrame of lines across the course, from boundary to boundary, with widths.

        Parameters
        ----------
        count : int
            The number of transects: one in the middle of each of `count` equal parts of a line.
        **given
            Options of `medial.arrays.transects`.

        Examples
        --------
        >>> import geopandas, shapely, medial.geo
        >>> s = geopandas.GeoSeries([shapely.box(0, 0, 10, 2)], index=["a"], crs=2056)
        >>> s.medial.transects(4).span.tolist()
        [2.0, 2.0, 2.0, 2.0]
        """
        found = arrays.transects(self._metric(), count, **given)
        table = found.to_pandas()
        index = self._series.index.take(table.index)
        return self._frame(table.set_axis(index), found.lines(), index)

    def inscribed_circles(self, k: int = 1, smallest: float = 0, **given: Any) -> Any:
        """A GeoDataFrame of the centres and radii of the `k` largest circles of each feature.

        Parameters
        ----------
        k : int
            The largest number of circles per feature.
        smallest : float
            The smallest radius, in units of the reference system; metres if it is geographic.
        **given
            Options of `medial.arrays.inscribed_circles`.

        Examples
        --------
        >>> import geopandas, shapely, medial.geo
        >>> s = geopandas.GeoSeries([shapely.box(0, 0, 10, 2)], index=["a"], crs=2056)
        >>> s.medial.inscribed_circles(2).radius.tolist()
        [1.0, 1.0]
        """
        found = arrays.inscribed_circles(self._metric(), k, smallest, **given)
        index = self._series.index.take(found.feature)
        return self._frame({"radius": found["radius"]}, shapely.points(found.values[:, :2]), index)

    def offset(self, distance: float, chord: float | None = None, **given: Any) -> Any:
        """The points farther than `distance` from the boundary, as a GeoSeries of polygons.

        Parameters
        ----------
        distance : float
            In units of the reference system; metres if it is geographic. Negative: outwards.
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal.
        **given
            Options of `medial.arrays.offset`.

        Examples
        --------
        >>> import geopandas, shapely, medial.geo
        >>> s = geopandas.GeoSeries([shapely.box(0, 0, 10, 2)], index=["a"], crs=2056)
        >>> s.medial.offset(0.5)["a"].area
        9.0
        """
        parts = arrays.offset(self._metric(), distance, chord=chord, **given).to_shapely()
        alone = shapely.get_num_geometries(parts) == 1
        parts[alone] = shapely.get_geometry(parts[alone], 0)
        return self._back(parts)

    def prune(self, measure: str = "prominence", threshold: float | None = None, **given: Any) -> Any:
        """The pruned axes as a GeoSeries of MultiLineStrings.

        Parameters
        ----------
        measure, threshold
            See `medial.prune`.
        **given
            Options of `medial.arrays.prune`.

        Examples
        --------
        >>> import geopandas, shapely, medial.geo
        >>> s = geopandas.GeoSeries([shapely.box(0, 0, 10, 2)], index=["a"], crs=2056)
        >>> s.medial.prune("erosion", 0.5)["a"].length < 8
        True
        """
        return self._back(arrays.prune(self._metric(), measure, threshold, **given).to_shapely())

    def _frame(self, columns: Any, geometries: Any, index: Any) -> Any:
        geometry = self._back(geometries, index).to_numpy()
        return geopandas.GeoDataFrame(columns, geometry=geometry, index=index, crs=self._crs)


pandas.api.extensions.register_dataframe_accessor("medial")(MedialAccessor)
pandas.api.extensions.register_series_accessor("medial")(MedialAccessor)
