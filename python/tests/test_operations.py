"""Operations against closed forms and against shapely."""

import math

import numpy as np
import pytest

import medial
import medial.image


def test_prune(rectangle):
    bump = [(0, 0), (9, 0), (9, 2), (5, 2), (4.5, 2.1), (4, 2), (0, 2)]
    a = medial.axis(bump)
    assert medial.prune(a, "erosion", 0.5).branch_count == 1
    assert medial.prune(a, keep=5).branch_count <= 5
    assert set(medial.prune_measures()) >= {"prominence", "erosion", "scale-axis"}
    with pytest.raises(medial.MedialError):
        medial.prune(a, "nonsense")
    assert medial.smooth(bump, "erosion", 0.5).area < 18.1


def test_rebuild_gives_the_shape_back(plan):
    shape = medial.rebuild(medial.axis(plan))
    assert medial.distance(shape, plan)["hausdorff"] == 0
    assert shape.area == pytest.approx(56, abs=1e-12)


def test_centerline(rectangle):
    long = [(0, 0), (10, 0), (10, 2), (0, 2)]
    line = medial.centerline(long, extend=True)
    assert sorted(line.coordinates()[[0, -1], :2].tolist()) == [[0, 1], [10, 1]]
    assert medial.centreline is medial.centerline
    between = medial.centerline(long, (2, 0), (7, 2))
    assert between.length == pytest.approx(5) and between.narrowest == pytest.approx(1)
    assert medial.widest_path(long, (2, 0), (7, 0)).length == pytest.approx(5)
    with pytest.raises(ValueError):
        medial.centerline(long, (2, 0))


def test_widths():
    wedge = [(0, 0), (10, -1), (10, 3), (0, 2)]
    profile = medial.width_profile(wedge, 11)
    assert (np.diff(profile.width) > 0).all() or (np.diff(profile.width) < 0).all()
    assert np.hypot(*(profile.left - profile.center).T) == pytest.approx(profile.radius)
    assert (profile.span <= profile.width + 1e-12).all()
    cuts = medial.transects([(0, 0), (10, 0), (10, 2), (0, 2)], 4)
    assert cuts.span == pytest.approx(np.full(4, 2.0)) and len(cuts.along) == 4
    mean = medial.mean_width([(0, 0), (10, 0), (10, 2), (0, 2)])
    assert mean["area"] == pytest.approx(20) and mean["by_length"] == pytest.approx(2)
    with pytest.raises(medial.MedialError):
        medial.width_profile(wedge, [3, 1])


def test_necks_and_circles():
    dumbbell = [(0, 0), (4, 0), (4, 1.5), (6, 1.5), (6, 0), (10, 0), (10, 4), (6, 4), (6, 2.5), (4, 2.5), (4, 4), (0, 4)]
    (neck,) = medial.necks(dumbbell)
    assert neck.width == pytest.approx(1) and neck.x == pytest.approx(5) and not neck.around_hole
    circles = medial.inscribed_circles(dumbbell, 3)
    assert [circle.radius for circle in circles[:2]] == pytest.approx([2.0, 2.0])
    assert medial.maximum_inscribed_circle([(0, 0), (4, 0), (0, 3)]) == pytest.approx((1, 1, 1))


def test_collapse():
    lake = [(0, 1.8), (6, 1.8), (6, 0), (10, 0), (10, 4), (6, 4), (6, 2.2), (0, 2.2)]
    polygons, lines = medial.collapse(lake, 1)
    assert 15.5 < polygons.area < 16.5 and lines.length == pytest.approx(6, abs=0.5)


def test_offsets(plan):
    square = [(0, 0), (4, 0), (4, 4), (0, 4)]
    inner, outer = medial.offset(square, 1), medial.offset(square, -1)
    assert inner[0].area == 4 and outer[0].area == pytest.approx(16 + 16 + math.pi)
    assert medial.offset(square, [0.5, 1, 1.5, 2])[-1].distance == 1.5
    assert medial.offset(plan, 0.5)[0].area == pytest.approx(45 - (9 - (4 - math.pi) * 0.25))


def test_buffers():
    (region,) = medial.buffer([[(0, 0), (4, 0)]], 1)
    assert region.area == pytest.approx(8 + math.pi) and region.length == pytest.approx(8 + 2 * math.pi)


def test_carving():
    carving = medial.carve([(0, 0), (4, 0), (4, 2), (0, 2)], angle=60)
    assert carving.deepest == pytest.approx(math.sqrt(3))
    code = carving.to_gcode(spindle=9000)
    assert code.startswith("(medial carve") and code.rstrip().endswith("M2") and "S9000" in code
    flat = medial.carve([(0, 0), (4, 0), (4, 2), (0, 2)], depth=0.5, tip=0.1)
    assert {kind for kind, _ in flat} >= {"clearing", "wall"}
    with pytest.raises(medial.MedialError):
        medial.carve([(0, 0), (4, 0), (4, 2), (0, 2)], angle=200)


def test_features_and_match():
    pytest.importorskip("pandas")
    found = medial.features([(0, 0), (4, 0), (4, 2), (0, 2)])
    assert (found["ends"], found["branchings"], found["cycles"]) == (4, 2, 0)
    assert len(found["branches"]) == 5 and found["branches"]["area"].sum() == pytest.approx(8)
    letters = ["M0 0H1V4H3V5H0Z", "M0 0H6V1H1V3H0Z", "M0 0H1V2H3V0H4V5H3V3H1V5H0Z"]
    turned = [(0, 0), (0, 1), (-8, 1), (-8, 3), (-10, 3), (-10, 0)]
    assert medial.match("M0 0H2V8H6V10H0Z", [*letters, turned])[0].index == 0


def test_verify_and_compare(plan):
    a = medial.axis(plan)
    certificate = medial.verify(a)
    assert certificate and certificate.cycles == 1 and certificate.largest_residual < 1e-12
    wrong = medial.verify(a, [(0, 0), (10, 0), (10, 6), (0, 6)])
    assert not wrong and wrong.failures
    rows = medial.compare(plan.copy(), ("disks", "lee", "ridge", "curve-axis"))
    assert rows[0]["length"] == pytest.approx(rows[1]["length"], rel=1e-12)
    assert rows[0]["length"] == pytest.approx(rows[2]["length"], rel=0.02)
    assert rows[3]["length"] == pytest.approx(rows[0]["length"], rel=1e-4)
    assert medial.compare("M0 0C4 0 4 3 2 3C0 3 2 0 0 0Z", ("disks", "curve-axis"))[1]["error"].code == "unsupported"
    assert (medial.legality(a) <= 1e-9).all()


def test_pack(plan):
    code = medial.pack(plan, 0.05)
    assert medial.distance(code.unpack().shape, plan)["hausdorff"] <= 0.05
    assert code.nbytes < 400 and medial.unpack(code) == code.unpack()
    assert 20 < code.boundary_nbytes < 200


def test_pack_of_an_image():
    y, x = np.mgrid[:60, :80]
    image = (np.hypot(x - 30, y - 30) < 25) | (abs(x - 60) < 12) & (abs(y - 30) < 6)
    exact, coarse = medial.image.pack(image), medial.image.pack(image, 2)
    assert np.array_equal(exact.unpack(), image) and exact.missing == 0
    rest = image & ~coarse.unpack()
    assert rest.sum() == coarse.missing > 0 and coarse.count < exact.count and coarse.nbytes < exact.nbytes
    near = np.pad(coarse.unpack(), 2)
    assert all(near[r : r + 5, c : c + 5].any() for r, c in zip(*np.nonzero(rest)))
    assert not (coarse.unpack() & ~image).any()
    with pytest.raises(medial.MedialError):
        medial.image.pack(image, -1)


def test_passes_up_to_a_distance():
    square = [(0, 0), (8, 0), (8, 8), (0, 8)]
    assert [r.distance for r in medial.offset_passes(square, 1, first=0.5, until=2)] == [0.5, 1.5]


def test_voronoi():
    rng = np.random.default_rng(3)
    points = rng.uniform(0, 10, (200, 2))
    diagram = medial.voronoi(points)
    assert diagram.verify()["passed"] and len(diagram.cells()) == 200
    queries = rng.uniform(0, 10, (500, 2))
    distances = np.hypot(*(queries[:, None] - points).transpose(2, 0, 1))
    found = diagram.nearest(queries)
    assert (diagram.sites["ring"][found.site] == distances.argmin(axis=1)).all()
    assert found.distance == pytest.approx(distances.min(axis=1))
    crossing = [[(0, 0), (4, 4)], [(0, 4), (4, 0)]]
    with pytest.raises(medial.MedialError):
        medial.voronoi(crossing)
    assert len(medial.voronoi(crossing, node_crossings=True).sites) == 9


def test_field_and_curve_axis():
    field = medial.field([(0, 0), (4, 0), (4, 2), (0, 2)], 3)
    at = field.sample([(2, 0.5), (9, 9)])
    assert at["direction"][0] == pytest.approx([0, 1], abs=1e-6) and np.isnan(at["clearance"][1])
    assert len(field.streamline((2, 0.2), 0.05)) > 3
    ellipse = medial.curve_axis(medial.Contour((4, 0)).ellipse_to((0, 0), (4, 0), (0, 2), 0, 2 * math.pi))
    assert ellipse.method == "curve-axis" and ellipse.length == pytest.approx(6, rel=1e-3)


def test_voxels():
    box = medial.voxels(np.ones((4, 4, 12)), count=24)
    assert box.topology == box.interior == (1, 0, 0) and box.volume().sum() == len(box.cells)
    assert box.radii.max() == pytest.approx(2, abs=0.6 * box.resolution)
    torus = np.ones((9, 9, 3))
    torus[3:6, 3:6] = 0
    assert medial.voxels(torus, count=27).topology == (1, 1, 0)
    assert len(box.surface.vertices) == 0


def test_surfaces_of_solids():
    plate = medial.voxels(np.ones((9, 9, 2)), count=27, surface=True)
    points, radii, triangles, lines = plate.surface
    assert len(plate.cells) and len(triangles) and triangles.max() < len(points) == len(radii)
    corners = points[triangles]
    sheet = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum() / 2
    assert 49 < sheet < 49 + 32 * np.sqrt(3)  # the middle sheet, and those to the edges
    middle = abs(points[:, 2] - 1) < 0.5 * plate.resolution
    assert radii[middle].max() == pytest.approx(1, abs=0.5 * plate.resolution)
    force = medial.voxels(np.ones((9, 9, 2)), count=16, method="potential", order=6)
    assert len(force.cells) == 0 and len(force.surface.triangles)
    for wrong in ({"method": "magic"}, {"method": "potential", "order": 1}):
        with pytest.raises(medial.MedialError):
            medial.voxels(np.ones((4, 4, 4)), count=8, **wrong)
    trimesh = pytest.importorskip("trimesh")
    assert isinstance(plate.surface.to_trimesh(), trimesh.Trimesh)


def test_against_shapely(plan):
    shapely = pytest.importorskip("shapely")
    polygon = shapely.geometry.shape(plan)
    circle = medial.maximum_inscribed_circle(polygon)
    ours, theirs = circle.radius, shapely.maximum_inscribed_circle(polygon, 1e-6).length
    assert ours == pytest.approx(theirs, abs=1e-5)
    for distance in (0.3, -0.7):
        mine = shapely.union_all([part.to_shapely(1e-5) for part in medial.offset(polygon, distance)])
        assert mine.symmetric_difference(polygon.buffer(-distance, 512)).area < 1e-3
    lines = medial.axis(polygon).to_shapely(1e-4)
    assert lines.length == pytest.approx(medial.axis(polygon).length, rel=1e-4)
    assert polygon.buffer(1e-9).covers(shapely.force_2d(lines))


def test_graphs(plan):
    a = medial.axis(plan)
    networkx = pytest.importorskip("networkx")
    graph = a.to_networkx()
    assert graph.number_of_edges() == len(a) and networkx.is_connected(graph)
    assert graph.number_of_edges() - graph.number_of_nodes() == 0
    assert a.to_networkx(branches=True).size("weight") == pytest.approx(a.length)
    pytest.importorskip("scipy")
    matrix = a.to_scipy()
    assert matrix.sum() / 2 == pytest.approx(a.length) and abs(matrix - matrix.T).sum() == 0


def test_tables_and_pictures(plan):
    pytest.importorskip("pandas")
    a = medial.axis(plan)
    assert a.branches["length"].sum() == pytest.approx(a.length)
    assert a._repr_svg_().startswith("<svg")
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    assert a.plot(disks=5).get_aspect() in ("equal", 1.0)


def test_networks_and_side_channels():
    island = [[(0, 0), (30, 0), (30, 6), (0, 6)], [(9, 2), (21, 2), (21, 3), (9, 3)]]
    line = medial.centerline(island)
    channels = line.side_channels()
    whole = medial.network(island)
    assert channels.branch_count == 1 and channels.part
    assert whole.length >= line.length + channels.length - 1e-9
    assert medial.verify(whole)  # as a part
    assert medial.centerline(island, "0/3", "0/1").length == pytest.approx(medial.centerline(island, (0, 3), (30, 3)).length)
    for name in ("0/9", "x", "1"):
        with pytest.raises(medial.MedialError, match="side"):
            medial.centerline(island, name, "0/1")


def test_transects_lie_across_the_course():
    notched = [(0, 0), (10, 0), (10, 2), (5.1, 2), (5, 1.9), (4.9, 2), (0, 2)]
    cuts = medial.transects(notched, 9)
    directions = cuts.left - cuts.right
    assert np.abs(directions[:, 0]).max() < 0.2 and cuts.span.max() < 2.05
    spaced = medial.transects([(0, 0), (10, 0), (10, 2), (0, 2)], spacing=3)
    assert np.diff(spaced.along) == pytest.approx(np.full(len(spaced.along) - 1, 3.0))
    with pytest.raises(ValueError):
        medial.transects(notched, spacing=0)


def test_smoothing_outside_and_specks():
    notched = [(0, 0), (9, 0), (9, 4), (5, 4), (4.5, 3.5), (4, 4), (0, 4)]
    filled = medial.smooth(notched, "significance", 9, exterior=True)
    assert medial.Shape(notched).area < filled.area <= 36 + 1e-9
    speck = [[(0, 0), (9, 0), (9, 4), (0, 4)], [(3, 1), (3.01, 1), (3.01, 1.01), (3, 1.01)]]
    with_speck, without = (medial.prune(speck, "erosion", 0.9, **kept) for kept in ({}, {"specks": 0.1}))
    assert len(with_speck.nodes) != len(without.nodes)
    assert medial.prune(speck, specks=0.1).shape.hole.sum() == 0


def test_nesting():
    ell = [(0, 0), (6, 0), (6, 2), (2, 2), (2, 6), (0, 6)]
    places = medial.nest(ell, ell, gap=0.1, best=3)
    assert 1 <= len(places) <= 3 and places[0].saved > 5 and places[0].gap >= 0.1 - 1e-9
    moved = places[0].placed(ell)
    assert moved.area == pytest.approx(20)
    shapely = pytest.importorskip("shapely")
    a, b = shapely.Polygon(ell), moved.to_shapely()
    assert a.intersection(b).area < 1e-9 and a.distance(b) == pytest.approx(places[0].gap, abs=1e-9)
    both = shapely.union(a, b).convex_hull.area
    assert a.convex_hull.area + b.convex_hull.area - both == pytest.approx(places[0].saved, rel=1e-9)


def test_curvature_of_the_boundary():
    loaf = medial.axis([(0, 0), (10, 0), (10, 4), (0, 4)], bulges=[0, 0, 0.2, 0])
    at = medial.boundary_curvature(loaf)
    top = at.foot[:, 1] > 4 + 1e-9
    angle = 4 * math.atan(0.2)
    assert top.any() and at.curvature[top] == pytest.approx(2 * math.sin(angle / 2) / 10, abs=1e-9)
    assert at.curvature[~top] == pytest.approx(0, abs=1e-9) and at.slope == pytest.approx(0, abs=1e-6)
    assert at.branch.max() < loaf.branch_count and len(at.left) == len(at.disk)


def test_thresholds_and_distances_of_methods():
    bent = [(0, 0), (10, 0), (10, 2), (5, 2.3), (0, 2)]
    with pytest.raises(TypeError, match="no option 'paralel'"):
        medial.features(bent, paralel=1)
    assert len(medial.features(bent, parallel=9, even=9)["runs"]) <= len(medial.features(bent)["runs"])
    first, second = medial.compare(bent, ("disks", "ridge"))
    assert first["hausdorff"] < 1e-12 and 0 < second["mean_distance"] <= second["hausdorff"] < 0.2


def areas(cells):
    for cell in cells:
        (x, y), (u, v) = cell.T, np.roll(cell, -1, axis=0).T
        yield abs(float((x * v - y * u).sum())) / 2


def test_offset_passes_and_a_diagram_inside():
    passes = medial.offset_passes([(0, 0), (9, 0), (9, 4), (0, 4)], 0.75, first=0.5)
    assert [region.distance for region in passes] == [0.5, 1.25]
    inside = medial.voronoi([(0, 0), (9, 0), (9, 4), (0, 4)], method="lee")
    assert sum(areas(inside.cells())) == pytest.approx(36)
    with pytest.raises(ValueError):
        medial.voronoi([(0.0, 0.0), (1.0, 0.0)], method="ridge")
