"""The medial axis of one shape."""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping
from copy import deepcopy
from os import PathLike, fsdecode, fsencode
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import MedialError, need
from ._options import computing, options
from ._records import (
    EDGE,
    NEAREST,
    NO_SITE,
    NODE,
    NODE_KINDS,
    SITE,
    Floats,
    Indices,
    Records,
    packed,
    points_of,
    where_known,
    records,
    unpacked,
)
from ._shape import Shape, load, stated

_CoreAxis = _core.Axis


_NONE: Mapping[str, Any] = {}


class MedialAxis:
    """The medial axis transform of a shape: a graph of exact curves in (x, y, radius).

    Made by `axis`. It is immutable: operations such as `prune` return a new axis.

    Attributes
    ----------
    nodes, edges, sites : structured arrays
        Read-only views of memory that the library owns.

    Examples
    --------
    >>> import medial
    >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
    >>> a
    <medial.MedialAxis: 6 nodes, 5 edges, 4 sites, method disks>
    >>> round(a.length, 12)
    7.656854249492
    """

    __slots__ = ("_core", "_attributes", "__weakref__")

    _core: _CoreAxis
    _attributes: Mapping[str, Any]  # of the shape

    def __init__(self) -> None:
        raise TypeError("medial.axis() makes medial axes")

    @classmethod
    def _of(cls, core: _CoreAxis, attributes: Mapping[str, Any] = _NONE) -> MedialAxis:
        self = cls.__new__(cls)
        self._core = core
        self._attributes = attributes
        return self

    # Contents.

    @property
    def nodes(self) -> Records:
        """Fields: x, y, radius, component, kind (index of :data:`NODE_KINDS`)."""
        return records(self._core.nodes(), NODE)

    @property
    def edges(self) -> Records:
        """Fields: node (from, to), site (left, right), control (x, y, radius), weight.

        An edge is a rational quadratic Bézier curve in (x, y, radius). Its control points are its
        first node, `control` and its last node; their weights are 1, `weight` and 1.
        """
        return records(self._core.edges(), EDGE)

    @property
    def sites(self) -> Records:
        """Fields: start, end, ring, vertex, kind (index of :data:`SITE_KINDS`), bulge."""
        return records(self._core.sites(), SITE)

    @property
    def shape(self) -> Shape:
        """The shape of this axis, with its attributes."""
        return Shape._of(self._core.shape(), self._attributes)

    @property
    def method(self) -> str:
        """The name of the method that computed the axis."""
        return self._core.method()

    @property
    def tolerance(self) -> float:
        """The bound of abs(distance - radius), in units of the input."""
        return self._core.tolerance()

    @property
    def resolution(self) -> float:
        """The step of a sampled axis; 0 for an exact one."""
        return self._core.resolution()

    @property
    def exterior(self) -> float:
        """The margin of the enclosure around an exterior; 0 for an interior."""
        return self._core.exterior()

    @property
    def statistics(self) -> dict[str, Any]:
        """Counts and times of the computation."""
        return self._core.statistics()

    @property
    def length(self) -> float:
        """The length of all edges in the plane."""
        return self._core.total_length()

    @property
    def edge_lengths(self) -> Floats:
        """The length of each edge."""
        return self._core.edge_lengths()

    @property
    def branch_count(self) -> int:
        """The number of branches."""
        return self._core.branch_count()

    # Queries.

    def nearest(self, points: npt.ArrayLike) -> Records:
        """The point of the axis nearest to each point.

        Parameters
        ----------
        points : array of shape (n, 2)
            In units of the input.

        Returns
        -------
        structured array
            Fields: x, y, radius, distance, t (the parameter on the edge), edge (-1 if there is none).

        Examples
        --------
        >>> import medial
        >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> a.nearest([(2, 1.5)])[["x", "y", "radius"]]
        array([(2., 1., 1.)], ...
        """
        return records(self._core.nearest(points_of(points)), NEAREST)

    def radius_at(self, points: npt.ArrayLike) -> Floats:
        """The radius at the point of the axis nearest to each point.

        Parameters
        ----------
        points : array of shape (n, 2)
            In units of the input.

        Examples
        --------
        >>> import medial
        >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> a.radius_at([(2, 1.5)])
        array([1.])
        """
        places = points_of(points)
        return where_known(places, np.array(self.nearest(places)["radius"]))

    def clearance(self, points: npt.ArrayLike) -> Floats:
        """The distance of points to the boundary of the shape, negative outside.

        Parameters
        ----------
        points : array of shape (n, 2)
            In units of the input.

        Examples
        --------
        >>> import medial
        >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> a.clearance([(2, 1), (2, 3)])
        array([ 1., -1.])
        """
        return self.shape.clearance(points)

    def disk_at(self, edge: int, t: float) -> tuple[float, float, float]:
        """The maximal disk (x, y, radius) at the parameter `t` of an edge.

        Parameters
        ----------
        edge : int
        t : float
            From 0 (the edge's first node) to 1 (its last).

        Examples
        --------
        >>> import medial
        >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> a.disk_at(2, 0.5)[:2]
        (2.0, 1.0)
        """
        x, y, radius = self._core.disk_at(edge, t)
        return x, y, radius

    def _chord(self, chord: float | None) -> float:
        if chord is not None:
            return chord
        return options.chord * (self.shape.diagonal or self._extent() or 1.0)

    def _extent(self) -> float:
        nodes = self.nodes
        return float(np.hypot(np.ptp(nodes["x"]), np.ptp(nodes["y"]))) if len(nodes) else 0.0

    def lines(self, chord: float | None = None, step: float | None = None) -> tuple[Floats, Indices]:
        """All branches as polylines: rows of x, y and radius, and the first row of each line.

        Parameters
        ----------
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal.
        step : float, optional
            Instead: the largest distance from row to row along the line, in units of the input.

        Examples
        --------
        >>> import medial
        >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> points, begin = a.lines()
        >>> points.shape, begin.tolist()
        ((10, 3), [0, 2, 4, 6, 8, 10])
        """
        return self._core.lines(self._chord(chord), step or 0.0)

    def sample(self, chord: float | None = None, step: float | None = None) -> list[Floats]:
        """A list of branches, each as rows of x, y and radius.

        Parameters
        ----------
        chord : float, optional
            The largest distance of chords from the curves, in units of the input.
        step : float, optional
            Instead: the largest distance from row to row along the line.

        Examples
        --------
        >>> import medial
        >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> len(a.sample(step=0.5)[2])
        5
        """
        points, begin = self.lines(chord, step)
        return np.split(points, begin[1:-1]) if len(begin) > 1 else []

    @property
    def branches(self) -> Any:
        """A pandas DataFrame of the branches: ends, length, radii, width, area, significance."""
        pandas = need("pandas", "all")
        table = pandas.DataFrame(described(self._core)["branches"])
        table["closed"] = table["closed"].astype(bool)
        nodes = self.nodes
        ends = nodes[table["node_from"].to_numpy()], nodes[table["node_to"].to_numpy()]
        table["euclidean"] = np.hypot(ends[0]["x"] - ends[1]["x"], ends[0]["y"] - ends[1]["y"])
        table["component"] = ends[0]["component"]
        return table.set_index("branch")

    # Operations, each of which is also a function of the package.

    def prune(self, measure: str = "prominence", threshold: float | None = None, *,
              keep: int | None = None, tips: bool = False) -> MedialAxis:  # fmt: skip
        """Removes branches that matter little: see `medial.prune`.

        Parameters
        ----------
        measure, threshold, keep, tips
            See `medial.prune`.

        Examples
        --------
        >>> import medial
        >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> a.prune("erosion", 0.5).branch_count
        1
        """
        core, _ = _core.pruned(self._core, measure, threshold, keep, tips)
        return MedialAxis._of(core, self._attributes)

    def clearance_part(self, clearance: float) -> MedialAxis:
        """The part with a radius of at least `clearance`, cut exactly.

        Parameters
        ----------
        clearance : float
            In units of the input.

        Examples
        --------
        >>> import medial
        >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> round(a.clearance_part(0.5).length, 9)
        4.828427125
        """
        return MedialAxis._of(_core.clearance_part(self._core, clearance), self._attributes)

    def verify(self, **given: Any) -> Any:
        """The measured errors: see `medial.verify`.

        Parameters
        ----------
        **given
            Options of `medial.verify`.

        Examples
        --------
        >>> import medial
        >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> a.verify().passed
        True
        """
        from ._checks import verify

        return verify(self, **given)

    # Other packages.

    def to_shapely(self, chord: float | None = None) -> Any:
        """A shapely MultiLineString of all branches, with the radius as z.

        Parameters
        ----------
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal.

        Examples
        --------
        >>> import medial
        >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> len(a.to_shapely().geoms)
        5
        """
        shapely = need("shapely", "geo")
        points, begin = self.lines(chord)
        kind = shapely.GeometryType.MULTILINESTRING
        return shapely.from_ragged_array(kind, points, (begin, np.array([0, len(begin) - 1])))[0]

    def to_geopandas(self, chord: float | None = None, crs: Any = None) -> Any:
        """A GeoDataFrame with one row per branch: the columns of `branches`, and its line.

        Parameters
        ----------
        chord : float, optional
            The largest distance of chords from the curves, in units of the input; by default
            ``medial.options.chord`` times the diagonal.
        crs : optional
            The reference system of the coordinates, as GeoPandas takes it.

        Examples
        --------
        >>> import medial
        >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> len(a.to_geopandas(crs=2056))
        5
        """
        geopandas, shapely = need("geopandas", "geo"), need("shapely", "geo")
        table = self.branches
        points, begin = self.lines(chord)
        kind = shapely.GeometryType.LINESTRING
        lines = shapely.from_ragged_array(kind, points, (begin,))
        return geopandas.GeoDataFrame(table, geometry=lines[table.index.to_numpy()], crs=crs)

    def to_networkx(self, branches: bool = False) -> Any:
        """A networkx MultiGraph of the nodes and edges, or of the ends and branches.

        Nodes have the attributes x, y, radius, pos, component and kind. Edges have edge, length,
        weight and site; branches have branch, length, weight, radius_min and mean_width.

        Parameters
        ----------
        branches : bool
            Return the graph of ends and branches instead of nodes and edges.

        Examples
        --------
        >>> import medial
        >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> a.to_networkx(branches=True).number_of_edges()
        5
        """
        networkx = need("networkx", "graph")
        graph = networkx.MultiGraph()
        nodes, edges = self.nodes, self.edges
        for i, (x, y, radius, component, kind) in enumerate(nodes.tolist()):
            graph.add_node(i, x=x, y=y, pos=(x, y), radius=radius, component=component,
                           kind=NODE_KINDS[kind])  # fmt: skip
        if not branches:
            ends, lengths, sites = edges["node"].tolist(), self.edge_lengths.tolist(), edges["site"].tolist()
            for e, ((a, b), length, site) in enumerate(zip(ends, lengths, sites, strict=True)):
                graph.add_edge(a, b, key=e, edge=e, length=length, weight=length, site=tuple(site))
            return graph
        table = described(self._core)["branches"]
        columns = [table[name].tolist() for name in ("branch", "node_from", "node_to", "length", "radius_min", "mean_width")]
        for branch, a, b, length, narrow, width in zip(*columns, strict=True):
            graph.add_edge(a, b, key=branch, branch=branch, length=length, weight=length,
                           radius_min=narrow, mean_width=width)  # fmt: skip
        graph.remove_nodes_from([node for node, degree in dict(graph.degree()).items() if not degree and len(nodes) > 1])
        return graph

    def to_scipy(self) -> Any:
        """A symmetric sparse matrix of the lengths of edges between nodes.

        Examples
        --------
        >>> import medial
        >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> a.to_scipy().shape
        (6, 6)
        """
        sparse = need("scipy.sparse", "graph")
        ends, lengths = self.edges["node"].astype(np.int64), self.edge_lengths
        ends = np.sort(ends, axis=1)
        keys = ends[:, 0] * len(self.nodes) + ends[:, 1]
        order = np.lexsort((lengths, keys))  # the shortest of parallel edges
        first = order[np.concatenate(([True], np.diff(keys[order]) != 0))] if len(order) else order
        a, b, lengths = ends[first, 0], ends[first, 1], lengths[first]
        size = (len(self.nodes),) * 2
        return sparse.coo_array((np.r_[lengths, lengths], (np.r_[a, b], np.r_[b, a])), size).tocsr()

    def to_igraph(self) -> Any:
        """An igraph Graph of the nodes (x, y, radius) and edges (length).

        Examples
        --------
        >>> import medial
        >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> a.to_igraph().diameter()
        3
        """
        igraph = need("igraph", "graph")
        nodes = self.nodes
        graph = igraph.Graph(len(nodes), self.edges["node"].tolist())
        for name in ("x", "y", "radius"):
            graph.vs[name] = nodes[name].tolist()
        graph.es["length"] = self.edge_lengths.tolist()
        return graph

    # Pictures.

    def plot(self, ax: Any = None, *, shape: bool = True, disks: int = 0, **given: Any) -> Any:
        """Draws the axis, coloured by radius, into matplotlib axes and returns them.

        Parameters
        ----------
        ax : matplotlib Axes, optional
        shape : bool
            Draw the shape.
        disks : int
            Draw at most this many maximal disks.
        **given
            Options of matplotlib's LineCollection, such as `cmap` and `linewidth`.

        Examples
        --------
        >>> import matplotlib
        >>> matplotlib.use("agg")
        >>> import medial
        >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> a.plot(disks=3).get_aspect()
        1.0
        """
        from ._pictures import plot

        return plot(self, ax, shape=shape, disks=disks, **given)

    def _repr_svg_(self) -> str:
        from ._pictures import svg_of

        return svg_of(self)

    # Files and copies.

    def to_text(self, format: str = "json", *, chord: float = 1e-3, simplify: float = 0) -> str:
        """The axis as text in a file format: see `save`.

        Parameters
        ----------
        format : {"json", "geojson", "wkt", "csv", "graphml", "nodelink", "edgelist"}
        chord, simplify : float
            See `save`.

        Examples
        --------
        >>> import medial
        >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> a.to_text("edgelist").splitlines()[0]
        '# from_node to_node length'
        """
        if format == "safetensors":
            raise MedialError("safetensors is a binary format: use save()", "unsupported")
        return _core.write_axis(self._core, stated(self._attributes), None, format, chord, simplify) or ""

    def save(self, path: str | PathLike[str], *, chord: float = 1e-3, simplify: float = 0) -> None:
        """Writes the axis in the format of the path's extension, and never leaves a partial file.

        Parameters
        ----------
        path : path
            ``.json`` is the native format, which holds the shape too, without loss; `medial.load`
            reads it. ``.safetensors`` holds the same as columns, which `medial.columns` maps.
            ``.geojson``, ``.wkt`` and ``.csv`` hold lines; ``.graphml``, ``.nodelink`` and
            ``.edgelist`` hold the graph of branches, for networkx. ``.gz`` compresses text.
        chord : float
            The largest distance of chords from the curves, as a share of the diagonal.
        simplify : float
            Instead: lines have few points, within this distance of the axis in units of the input.

        Raises
        ------
        MedialError
            With the code ``"unsupported"`` (another extension) or ``"unwritable"``.

        Examples
        --------
        >>> import medial, pathlib, tempfile
        >>> a = medial.axis([(0, 0), (4, 0), (4, 2), (0, 2)])
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     a.save(pathlib.Path(folder, "a.csv"))
        ...     pathlib.Path(folder, "a.csv").read_text()[:10]
        'edge,x,y,r'
        """
        name = fsdecode(path)
        if name.lower().endswith(".gz"):
            from ._files import write_compressed

            kind = name.lower().split(".")[-2]
            return write_compressed(name, self.to_text(kind, chord=chord, simplify=simplify))
        _core.write_axis(self._core, stated(self._attributes), fsencode(path), "", chord, simplify)
        return None

    @property
    def part(self) -> bool:
        """Whether this is only a part of the axis of its shape: pruned, cut or smoothed."""
        return self._core.part()

    def _state(self) -> tuple[Any, ...]:
        numbers = self.method, self.tolerance, self.resolution, self.exterior, self.part
        return (*numbers, packed(self.sites), packed(self.nodes), packed(self.edges))

    def __reduce__(self) -> tuple[Any, ...]:
        return restored, (self.shape, *self._state())

    def __copy__(self) -> MedialAxis:
        return MedialAxis._of(self._core, self._attributes)

    def __deepcopy__(self, memo: dict[int, Any]) -> MedialAxis:
        return MedialAxis._of(self._core, deepcopy(self._attributes, memo))  # the rest is immutable

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, MedialAxis):
            return NotImplemented
        mine, theirs = self._state(), other._state()
        return self.shape == other.shape and all(
            np.array_equal(a, b) if isinstance(a, np.ndarray) else a == b
            for a, b in zip(mine, theirs, strict=True)
        )

    __hash__ = None  # type: ignore[assignment]

    def __len__(self) -> int:
        """The number of edges."""
        return len(self.edges)

    def __bool__(self) -> bool:
        return True

    def __iter__(self) -> Iterator[Floats]:
        """The branches, as `sample` gives them."""
        return iter(self.sample())

    def __repr__(self) -> str:
        counts = f"{len(self.nodes)} nodes, {len(self.edges)} edges, {len(self.sites)} sites"
        return f"<medial.MedialAxis: {counts}, method {self.method}>"


def restored(
    shape: Shape, method: str, tolerance: float, resolution: float, exterior: float, part: bool,
    sites: npt.ArrayLike, nodes: npt.ArrayLike, edges: npt.ArrayLike,
) -> MedialAxis:  # fmt: skip
    """An axis from its pickled state."""
    return MedialAxis._of(
        _core.restored_axis(
            shape._core, method, tolerance, resolution, exterior, part,
            unpacked(sites, SITE), unpacked(nodes, NODE), unpacked(edges, EDGE),
        ),
        shape.attributes,
    )  # fmt: skip


# Thresholds of features() and their defaults.
THRESHOLDS = {"parallel": 0.05, "even": 0.1, "bend": 0.1, "turn": 0.1, "spiral": 0.5, "shortest": 0.25}


def described(core: _CoreAxis, **thresholds: float) -> dict[str, Any]:
    """The features of an axis; thresholds have the names of THRESHOLDS."""
    if unknown := thresholds.keys() - THRESHOLDS:
        raise TypeError(f"features() has no option {min(unknown)!r}")
    return _core.described(core, list({**THRESHOLDS, **thresholds}.values()))


@functools.lru_cache(maxsize=16)
def _plain(method: str, threads: int) -> _core.Options:
    return computing(method, threads=threads)


def axis(
    x: Any,
    method: str | None = None,
    *,
    bulges: npt.ArrayLike | None = None,
    repair: str | None = None,
    arc_tolerance: float = 1e-6,
    fit: float = 0,
    tolerance: float = 0,
    corner_angle: float = 0.01,
    exact: bool = False,
    exterior: bool = False,
    margin: float = 0,
    threads: int | None = None,
    **own: Any,
) -> MedialAxis:
    """The medial axis of a shape.

    Parameters
    ----------
    x : geometry
        A shapely Polygon or MultiPolygon, anything with ``__geo_interface__``, GeoJSON as a
        mapping, well-known binary or text, an SVG path, coordinates as rows of x and y, a list
        of rings (holes by the even-odd rule), a `Contour` or a list of them, or a
        `Shape`.
    method : str, optional
        A name of `methods`; the default is ``medial.options.method``.
    bulges : array, optional
        The bulge of the edge after each vertex: the tangent of a quarter of its angle; 0: straight.
    repair : str, optional
        The rule that decides what is inside where rings cross: ``"make_valid"`` (that of the
        input), ``"even_odd"`` or ``"non_zero"``. Without it, crossing rings are an error.
    arc_tolerance : float
        The largest distance of arcs from free-form curves, as a share of the diagonal.
    fit : float
        Replaces boundaries by smooth curves within this distance; 0 keeps them.
    tolerance : float
        A disk touches a site at a distance below this share of the diagonal; 0: chosen by the
        rounding of the coordinates.
    corner_angle : float
        A convex joint with an arc is a corner if it turns by more than this, in degrees.
    exact : bool
        Keeps apart nodes closer than the tolerance. ``disks`` then computes the axis, whatever the
        method.
    exterior : bool
        Compute the axis of the exterior, around the shape and in its holes.
    margin : float
        The distance of the exterior's enclosure from the shape; 0: half of the longer side.
    threads : int, optional
        The default is ``medial.options.threads``. The result is the same, byte for byte.
    **own
        Options of the method: `resolution` or `pixels` for ``ridge`` and ``brushfire``, `seed`
        for ``biarc-dc``, `order`, `step`, `coarse` and others for ``potential``.

    Raises
    ------
    MedialError
        With a code and, where known, the place in the input.

    Examples
    --------
    >>> import medial
    >>> a = medial.axis("POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))")
    >>> len(a.nodes), a.branch_count
    (6, 5)
    >>> medial.axis("M 0 0 h 6 v 2 h -6 z").length == a.length
    True
    """
    kind = type(x)
    if kind is np.ndarray and x.dtype == np.float64 and x.ndim == 2 and x.shape[1] == 2 and not own:
        plain = (bulges is repair is None and not (fit or tolerance or exact or exterior or margin)
                 and corner_angle == 0.01)  # fmt: skip
        if plain and x.flags.c_contiguous:
            name = options.method if method is None else method
            some = options.threads if threads is None else threads
            if name != "curve-axis":
                return MedialAxis._of(_core.axis_of_ring(x, _plain(name, some)))
    follows = (method or options.method) == "curve-axis"
    shape, contours = load(x, bulges, repair, arc_tolerance, fit, follows)
    if follows:
        own["fit"] = fit  # the contours are those before the fit
    computed = computing(method, tolerance=tolerance, corner_angle=corner_angle, exact=exact,
                         threads=threads, exterior=exterior, margin=margin, own=own)  # fmt: skip
    attributes = dict(x.attributes) if isinstance(x, Shape) else _NONE
    return MedialAxis._of(_core.compute(shape, computed, contours), attributes)


def axis_of(x: Any, threads: int | None = None) -> MedialAxis:
    """x itself if it is an axis, else the axis of the geometry x."""
    return x if isinstance(x, MedialAxis) else axis(x, threads=threads)


__all__ = ["NO_SITE", "MedialAxis", "axis"]
