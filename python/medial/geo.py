"""GeoPandas: `import medial.geo` adds the accessor ``.medial`` to GeoDataFrames and GeoSeries.

It keeps the index and the reference system. Each call projects longitudes and latitudes to metres
around the features, and projects results back. Features far apart get projections of their own, so
that lengths are right within 0.11 %; of a feature of more than 600 km a warning says by how much
they are off.
"""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np

from . import arrays
from ._axes import Axes, axes
from ._errors import need
from ._globe import LocalProjections

geopandas = need("geopandas", "geo")
pandas = need("pandas", "geo")
shapely = need("shapely", "geo")


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
        self._local: LocalProjections | None = None

    def _metric(self) -> Any:
        points = shapely.get_coordinates(self._series.to_numpy())
        if self._crs is None or not self._crs.is_geographic or not np.isfinite(points).all(axis=1).any():
            return self._series
        self._local = LocalProjections(self._series)
        return self._local.forward()

    def _back(self, geometries: Any, features: Any = None) -> Any:
        """Geometries of these features, by default one of each, as a GeoSeries."""
        of = np.arange(len(self._series)) if features is None else np.asarray(features)
        placed = self._local.back(geometries, of) if self._local else geometries
        return geopandas.GeoSeries(placed, index=self._series.index.take(of), crs=self._crs)

    def axes(self, method: str | None = None, **given: Any) -> Axes:
        """The axes as arrays, in metres if the reference system is geographic.

        Features farther apart than some 300 km are then in projections of their own: radii and
        lengths are right, but positions of different features do not go together. A warning says so.

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
        metric = self._metric()
        if self._local and not self._local.is_one:
            warnings.warn("the features lie far apart: each is in metres around a middle of its own", stacklevel=2)
        return axes(metric, method, **given)

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
        lines = self._back(found.lines(), table.index)
        index = pandas.MultiIndex.from_arrays([lines.index, table.pop("branch")], names=["feature", "branch"])
        return geopandas.GeoDataFrame(table.set_axis(index), geometry=lines.set_axis(index), crs=self._crs)

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
        """A GeoDataFrame of lines across the shapes, from boundary to boundary, with widths.

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
        lines = self._back(found.lines(), table.index)
        return geopandas.GeoDataFrame(table.set_axis(lines.index), geometry=lines, crs=self._crs)

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
        centers = self._back(shapely.points(found.values[:, :2]), found.feature)
        return geopandas.GeoDataFrame({"radius": found["radius"]}, geometry=centers.to_numpy(), index=centers.index, crs=self._crs)

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


pandas.api.extensions.register_dataframe_accessor("medial")(MedialAccessor)
pandas.api.extensions.register_series_accessor("medial")(MedialAccessor)
