"""Operations against closed forms and against shapely."""

import math

import numpy as np
import pytest

import medial


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
    assert rows[3]["error"].code == "unsupported"
    assert (medial.legality(a) <= 1e-9).all()


def test_pack(plan):
    code = medial.pack(plan, 0.05)
    assert medial.distance(code.unpack().shape, plan)["hausdorff"] <= 0.05
    assert code.nbytes < 400 and medial.unpack(code) == code.unpack()


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
