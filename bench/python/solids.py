#!/usr/bin/env python3
"""The axis of solids beside other codes' skeletons of the same voxels: how far from the exact axis, how much of it,
how much of the solid its balls cover, parts, tunnels and cavities.

    bench/python/solids.py MEDIAL [MESH ...] [--voxels N] [--picture FILE]

MEDIAL is the command line program, a MESH an .obj or .off file. Needs numpy, scipy and scikit-image, whose thinning is
that of Lee, Kashyap and Chu (1994); kimimaro (curves by TEASAR, Sato et al. 2000), medialaxis3d (thinning in the order
of distances) and, for the picture, matplotlib where they are installed. Prints the table of bench/results/voxels.md. Times are
processor seconds: of medial's whole run, from the file; of the others from the voxels on.
"""

import argparse
import json
import pathlib
import subprocess
import tempfile
import time

import numpy as np
import scipy.ndimage
import scipy.spatial
import skimage.measure
import skimage.morphology

from solid_shapes import box, cylinder, inside, read_mesh, sampled_axis, torus, write_off

# A general rotation: of solids that lie straight on the grid scikit-image leaves nothing at all.
TURN = np.linalg.qr(np.array([[0.8, -0.3, 0.5], [0.4, 0.9, -0.2], [-0.3, 0.4, 0.7]]))[0]


def box_axis(x, y, z):
    """Points of the middle sheet and of the sheets to the edges of a box, z the shortest side; distances from them."""
    def make(u):
        p = u * [x, y, z / 2]
        side, depth = u[:, 0] < 0.5, p[:, 2]
        p[side, 0] = depth[side]                # a sheet to an edge along y, or one along x
        p[~side, 1] = depth[~side]
        p[::3] = np.column_stack([u[::3, 0] * x, u[::3, 1] * y, np.full(len(u[::3]), z / 2)])
        d = np.sort(np.column_stack([p, [x, y, z] - p]), axis=1)
        return p[d[:, 1] - d[:, 0] < 1e-12], d[d[:, 1] - d[:, 0] < 1e-12, 0]

    def off(p):
        d = np.sort(np.column_stack([p, [x, y, z] - p]), axis=1)
        return (d[:, 1] - d[:, 0]) / np.sqrt(2)
    return make, off


def cylinder_axis(radius, height):
    side = height / 2 - radius

    def make(u):
        off, turn = radius * np.sqrt(u[:, 0]), 2 * np.pi * u[:, 1]
        z = np.where(u[:, 2] < 0.5, 1, -1) * (height / 2 - radius + off)
        p = np.column_stack([off * np.cos(turn), off * np.sin(turn), z])
        p[::3] = np.column_stack([0 * off[::3], 0 * off[::3], (2 * u[::3, 2] - 1) * side])
        return p, np.minimum(radius - np.hypot(p[:, 0], p[:, 1]), height / 2 - np.abs(p[:, 2]))

    def off(p):
        across, z = np.hypot(p[:, 0], p[:, 1]), np.abs(p[:, 2])
        line = np.hypot(across, np.maximum(z - side, 0))
        return np.minimum(line, np.abs((z - height / 2) + (radius - across)) / np.sqrt(2))
    return make, off


def torus_axis(large, small):
    def make(u):
        turn = 2 * np.pi * u[:, 0]
        return np.column_stack([large * np.cos(turn), large * np.sin(turn), 0 * turn]), np.full(len(u), small)
    return make, lambda p: np.hypot(np.hypot(p[:, 0], p[:, 1]) - large, p[:, 2])


class Skeleton:
    """What a code made of a solid: points with their radii, and `dots` that fill it where it has triangles."""

    def __init__(self, code, points, radii, counts, seconds, dots=None):
        self.code, self.points, self.radii, self.counts, self.seconds = code, points, radii, counts, seconds
        self.dots = points if dots is None else dots


def read_ply(path):
    """Vertices with their radii, and triangles."""
    header, body = path.read_bytes().split(b"end_header\n", 1)
    lines = header.decode().splitlines()
    count = {line.split()[1]: int(line.split()[2]) for line in lines if line.startswith("element")}
    width = sum(line.startswith("property double") for line in lines)
    vertices = np.frombuffer(body, "<f8", width * count["vertex"]).reshape(-1, width)[:, :4]
    kind = np.dtype([("n", "u1"), ("v", "<u4", 3)])
    return vertices, np.frombuffer(body, kind, count.get("face", 0), 8 * width * count["vertex"])["v"]


def filled(triangles):
    """Points of triangles, so dense that the ones between them are nearer than a quarter of an edge."""
    shares = [(i / 4, j / 4, 1 - i / 4 - j / 4) for i in range(5) for j in range(5 - i)]
    return np.concatenate([np.tensordot(share, triangles, (0, 1)) for share in shares])


def of_medial(medial, source, n, name, *options):
    """The skeleton, and what the program says of it; nothing of a mesh that it refuses."""
    target = source.with_suffix(".ply")
    run = subprocess.run([medial, "voxels", str(source), "-o", str(target), "--voxels", str(n), "--threads", "1",
                          "--json", "--stats", *options], stdout=subprocess.PIPE)
    if run.returncode != 0:
        return None, None
    report = json.loads(run.stdout)
    vertices, triangles = read_ply(target)
    points, counts = vertices[:, :3], tuple(report["topology"]["axis"].values())
    dots = np.concatenate([points, filled(points[triangles])]) if len(triangles) else None
    return Skeleton(name, points, vertices[:, 3], counts, report["processor_seconds"], dots), report


def counts_of(voxels):
    """Parts, tunnels and cavities: 26 neighbours of what is there, 6 of what is not."""
    padded = np.pad(voxels, 1)
    parts = scipy.ndimage.label(padded, np.ones((3, 3, 3)))[1]
    cavities = scipy.ndimage.label(~padded)[1] - 1
    return parts, int(parts + cavities - skimage.measure.euler_number(padded, connectivity=3)), cavities


def of_others(volume, low, step):
    """The skeletons of voxels by the codes that are installed."""
    depth = scipy.ndimage.distance_transform_edt(volume)

    def thinned(code, thin):
        begin = time.process_time()
        voxels = thin() > 0
        seconds = time.process_time() - begin
        return Skeleton(code, low + (np.argwhere(voxels) + 0.5) * step, depth[voxels] * step, counts_of(voxels),
                        seconds)

    yield thinned("scikit-image", lambda: skimage.morphology.skeletonize(volume, method="lee"))
    try:
        import medialaxis3d
        yield thinned("medialaxis3d", lambda: medialaxis3d.medial_axis_3d(volume, rng=1))
    except ImportError:
        pass
    try:
        import kimimaro
    except ImportError:
        return
    begin = time.process_time()
    made = kimimaro.skeletonize(volume.astype(np.uint8), {"scale": 1.5, "const": 10}, dust_threshold=0, progress=False)
    seconds = time.process_time() - begin
    lines = made[1]
    parts = len(lines.components())
    yield Skeleton("kimimaro", low + (lines.vertices + 0.5) * step, lines.radii * step,
                   (parts, len(lines.edges) - len(lines.vertices) + parts, 0), seconds)


def covered(points, centers, radii):
    """Which share of the points some ball holds."""
    inside_ball = np.zeros(len(points), bool)
    for begin in range(0, len(centers), 2000):
        c, r = centers[begin:begin + 2000], radii[begin:begin + 2000]
        left = np.flatnonzero(~inside_ball)
        d2 = ((points[left, None] - c[None]) ** 2).sum(axis=2)
        inside_ball[left] = (d2 <= r ** 2).any(axis=1)
    return inside_ball.mean()


def measure(name, mesh, medial, n, axis=None):
    """Prints the rows of one solid. Returns its skeletons."""
    points, faces = mesh[0] @ TURN.T, mesh[1]
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder, "mesh.off")
        write_off(source, points, faces)
        skeletons = [of_medial(medial, source, n, code, *options) for code, options in (
            ("`voxels --surface`", ["--surface"]), ("`voxels`", []), ("`--thin curves`", ["--thin", "curves"]))]
    report = skeletons[0][1]
    if report is None:
        return []
    step = report["resolution"]
    low = points.min(axis=0) - 2 * step
    size = np.ceil((points.max(axis=0) - low) / step + 2).astype(int)
    volume = inside(points, np.asarray(faces), low, step, size)
    skeletons = [skeleton for skeleton, _ in skeletons] + list(of_others(volume, low, step))

    if axis:
        make, distance = axis
        exact, radii = make(np.random.default_rng(1).random((20000, 3)))
        exact, away = exact @ TURN.T, lambda p: distance(p @ TURN)
    else:
        exact, radii = sampled_axis(points, faces)
        tree = scipy.spatial.cKDTree(exact)
        away = lambda p: tree.query(p)[0]
        exact, radii = exact[::5], radii[::5]
    deep = exact[radii > 3 * step]
    random = np.random.default_rng(2)
    some = np.argwhere(volume)
    some = low + (some[random.integers(len(some), size=4000)] + random.random((4000, 3))) * step
    note = ", ".join(map(str, report["topology"]["solid"].values()))
    if (of_voxels := ", ".join(map(str, counts_of(volume)))) != note:
        note += "; voxels " + of_voxels
    for skeleton in skeletons:
        off = away(skeleton.points) / step if len(skeleton.points) else np.full(1, np.nan)
        near = scipy.spatial.cKDTree(skeleton.dots).query(deep)[0] < step if len(skeleton.points) else np.zeros(1)
        print(f"| {name} | {skeleton.code} | {len(skeleton.points):,} | {off.mean():.2f} | {off.max():.2f} | "
              f"{100 * near.mean():.1f} % | {100 * covered(some, skeleton.points, skeleton.radii):.1f} % | "
              f"{', '.join(map(str, skeleton.counts))} | {skeleton.seconds:.2f} |", flush=True)
        name = f"({note})" if skeleton is skeletons[0] else ""
    return skeletons


def draw(path, rows):
    """Skeletons of some solids, a solid a row, coloured by radius."""
    import matplotlib.pyplot as plt
    rows = {name: skeletons[1:] for name, skeletons in rows.items() if skeletons}
    columns = max(map(len, rows.values()))
    figure = plt.figure(figsize=(2.6 * columns, 2.7 * len(rows)))
    for i, (name, skeletons) in enumerate(rows.items()):
        for j, skeleton in enumerate(skeletons):
            axes = figure.add_subplot(len(rows), columns, i * columns + j + 1, projection="3d")
            p = skeleton.points @ TURN
            axes.scatter(*p.T, c=skeleton.radii, s=0.6 if len(p) > 2000 else 2, cmap="viridis", linewidths=0)
            low, high = skeletons[0].points @ TURN, skeletons[0].points @ TURN
            axes.set_box_aspect(np.ptp(low, axis=0))
            for set_limits, a, b in zip((axes.set_xlim, axes.set_ylim, axes.set_zlim), low.min(axis=0),
                                        high.max(axis=0)):
                set_limits(a, b)
            axes.set_axis_off()
            code = skeleton.code.replace("`", "")
            axes.set_title(f"{name}: {code}", fontsize=8)
    figure.subplots_adjust(0, 0, 1, 1, 0, 0.05)
    figure.savefig(path, dpi=100, bbox_inches="tight")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("medial")
    parser.add_argument("meshes", nargs="*", type=pathlib.Path)
    parser.add_argument("--voxels", type=int, default=96)
    parser.add_argument("--picture", type=pathlib.Path)
    options = parser.parse_args()
    print("| solid (parts, tunnels, cavities) | code | points | mean from the axis, voxels | at most | of the axis "
          "within a voxel | of the solid in the balls | parts, tunnels, cavities | s |\n"
          "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    n = options.voxels
    measure("box 4 x 3 x 2", box(4, 3, 2), options.medial, n, box_axis(4, 3, 2))
    measure("cylinder of 200 sides", cylinder(1, 4, 200), options.medial, n, cylinder_axis(1, 4))
    measure("torus 120 x 40", torus(2, 0.6, 120, 40), options.medial, n, torus_axis(2, 0.6))
    drawn = {path.stem: measure(path.stem, read_mesh(path), options.medial, n) for path in options.meshes}
    if options.picture:
        draw(options.picture, drawn)


if __name__ == "__main__":
    main()
