"""Longitudes and latitudes in metres, by projections that are local to the features."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import numpy.typing as npt

from ._errors import MedialError, need
from ._records import Floats, Indices

# As on the command line: farther from its middle, in degrees of the great circle, the transverse
# Mercator projection stretches by more than 0.11 percent.
_CONFORMAL_REACH = 2.7
_BEYOND_POLE = 1e-9  # in degrees: as on the command line, how far rounding may move a pole
_CELL = 1.5  # height and width in degrees: no corner is farther than 1.1 from the middle


def _directions(places: Floats) -> Floats:
    """Unit vectors of longitudes and latitudes in degrees."""
    lon, lat = np.radians(places).T
    return np.stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)], axis=1)


def _places(directions: Floats) -> Floats:
    """Longitudes and latitudes in degrees of vectors of any length."""
    x, y, z = directions.T
    angles: Floats = np.stack([np.arctan2(y, x), np.arctan2(z, np.hypot(x, y))], axis=1)
    return np.degrees(angles)


def _angles(a: Floats, b: Floats) -> Floats:
    """Between unit vectors, in degrees."""
    cosines: Floats = (a * b).sum(axis=1)
    return np.degrees(np.arccos(np.clip(cosines, -1, 1)))


def _cells(places: Floats) -> Floats:
    """The middle of the cell of the globe that each place is in."""
    lat = _CELL * np.round(places[:, 1] / _CELL)
    around = np.ceil(360 / _CELL * np.cos(np.radians(np.maximum(np.abs(lat) - _CELL / 2, 0))))
    lon = (np.floor(places[:, 0] % 360 * around / 360) + 0.5) * 360 / around
    return np.stack([lon, lat], axis=1)


class LocalProjections:
    """Projections of the features of a GeoSeries in longitudes and latitudes.

    One for all features if they are close together; otherwise one for the features of each cell of the globe.
    Coordinates that are not finite have no say in it.
    """

    def __init__(self, series: Any) -> None:
        self._shapely = need("shapely", "geo")
        self._features: npt.NDArray[Any] = series.to_numpy()
        self._unit = float(np.degrees(series.crs.axis_info[0].unit_conversion_factor))  # in degrees
        self._ellipsoid = series.crs.ellipsoid
        points, feature = self._shapely.get_coordinates(self._features, return_index=True)
        finite = np.isfinite(points).all(axis=1)
        points, feature = self._in_degrees(points[finite]), feature[finite]
        if (np.abs(points) > (540, 90)).any():
            raise MedialError("the reference system is geographic, but the coordinates are not longitudes and latitudes", "invalid_option")
        self._find_groups(points, feature)

    def _in_degrees(self, coordinates: Floats) -> Floats:
        """Longitudes and latitudes; points that rounding moved beyond a pole are back on it."""
        places = self._unit * coordinates
        lat = places[:, 1]
        places[:, 1] = np.where(np.abs(lat) <= 90 + _BEYOND_POLE, np.clip(lat, -90, 90), lat)
        return places

    def _find_groups(self, points: Floats, feature: Indices) -> None:
        size, directions = len(self._features), _directions(points)

        def sums(values: Floats) -> Floats:
            total = np.zeros((size, values.shape[1]))
            np.add.at(total, feature, values)
            return total

        middles = _places(sums(directions))
        whole = _places(directions.sum(axis=0, keepdims=True))
        centers = np.repeat(whole, size, axis=0)
        if len(points) and _angles(directions, _directions(whole)).max() > _CONFORMAL_REACH:
            reach = np.zeros(size)
            np.maximum.at(reach, feature, _angles(directions, _directions(middles)[feature]))
            is_small = reach + 0.75 * _CELL <= _CONFORMAL_REACH
            centers = np.where(is_small[:, None], _cells(middles), middles)
        places, group = np.unique(centers, axis=0, return_inverse=True)
        self._group: Indices = group.reshape(-1)
        reach = np.zeros(len(places))
        np.maximum.at(reach, self._group[feature], _angles(directions, _directions(centers)[feature]))
        self._local = [self._projection(place, far) for place, far in zip(places.tolist(), reach.tolist(), strict=True)]
        if (most := float(reach.max(initial=0))) > _CONFORMAL_REACH:
            off = 100 * (1 / np.cos(np.radians(min(most, 179)) / 2) - 1)
            warnings.warn(f"features reach over more than {2 * _CONFORMAL_REACH:g} degrees: "
                          f"lengths in them are off by up to {off:.2g} %", stacklevel=5)  # fmt: skip
        # Results lie within half a turn of the middle of their feature, on the side where it was.
        counts = np.maximum(np.bincount(feature, minlength=size), 1)
        turns = np.round((sums(points)[:, 0] / counts - middles[:, 0]) / 360)
        self._longitude: Floats = middles[:, 0] + 360 * turns

    def _projection(self, place: list[float], reach: float) -> Any:
        """From degrees to metres around a place; conformal if it does not reach far."""
        kind = "tmerc" if reach <= _CONFORMAL_REACH else "laea"
        a, b = self._ellipsoid.semi_major_metre, self._ellipsoid.semi_minor_metre
        text = f"+proj={kind} +lon_0={place[0]!r} +lat_0={place[1]!r} +a={a!r} +b={b!r}"
        return need("pyproj", "geo").Transformer.from_pipeline(text)

    @property
    def is_one(self) -> bool:
        """Whether all features have the same projection."""
        return len(self._local) == 1

    def _mapped(self, geometries: npt.NDArray[Any], features: Indices, *, back: bool) -> npt.NDArray[Any]:
        """Geometries of these features, each by the projection of its feature."""
        has_z = bool(self._shapely.has_z(geometries).any())
        at, geometry = self._shapely.get_coordinates(geometries, include_z=has_z, return_index=True)
        feature = features[geometry]
        if not back:
            at[:, :2] = self._in_degrees(at[:, :2])
        group = self._group[feature]
        order = np.argsort(group, kind="stable")
        for rows in np.split(order, np.flatnonzero(np.diff(group[order])) + 1):
            if len(rows):
                local = self._local[group[rows[0]]]
                at[rows, 0], at[rows, 1] = local.transform(at[rows, 0], at[rows, 1], direction="INVERSE" if back else "FORWARD")
        if back:
            at[:, 0] += 360 * np.round((self._longitude[feature] - at[:, 0]) / 360)
            at[:, :2] /= self._unit
        mapped: npt.NDArray[Any] = self._shapely.set_coordinates(np.array(geometries, object), at)
        return mapped

    def forward(self) -> npt.NDArray[Any]:
        """The features in metres."""
        return self._mapped(self._features, np.arange(len(self._features)), back=False)

    def back(self, geometries: npt.NDArray[Any], features: Indices) -> npt.NDArray[Any]:
        """Geometries in metres of these features, in the reference system of the series."""
        return self._mapped(geometries, features, back=True)
