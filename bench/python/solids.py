#!/usr/bin/env python3
"""The axis of solids as a surface, beside the thinning of Lee, Kashyap and Chu (1994) in scikit-image, on the
same meshes: how far from the exact axis, how much of it, how much of the solid its balls cover.

    bench/python/solids.py MEDIAL [MESH ...] [--voxels N]

MEDIAL is the command line program. Needs numpy, scipy and scikit-image. Prints the table of bench/RESULTS.md.
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
import skimage.morphology


# A general rotation: of solids that lie straight on the grid scikit-image leaves nothing at all.
TURN = np.linalg.qr(np.array([[0.8, -0.3, 0.5], [0.4, 0.9, -0.2], [-0.3, 0.4, 0.7]]))[0]


def write_off(path, points, faces):
    rows = [f"OFF\n{len(points)} {len(faces)} 0"]
    rows += [" ".join(repr(float(x)) for x in p) for p in points]
    rows += ["3 " + " ".join(map(str, f)) for f in faces]
    path.write_text("\n".join(rows) + "\n")


def box(x, y, z):
    points = [(i * x, j * y, k * z) for k in (0, 1) for j in (0, 1) for i in (0, 1)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return np.array(points, float), [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def cylinder(radius, height, n):
    turn = 2 * np.pi * np.arange(n) / n
    ring = np.column_stack([radius * np.cos(turn), radius * np.sin(turn)])
    points = np.concatenate([np.column_stack([ring, np.full(n, z)]) for z in (-height / 2, height / 2)])
    faces = [t for i in range(n) for t in ((i, (i + 1) % n, n + i), ((i + 1) % n, n + (i + 1) % n, n + i))]
    faces += [t for i in range(1, n - 1) for t in ((0, i + 1, i), (n, n + i, n + i + 1))]
    return points, faces


def torus(large, small, around, across):
    u, v = np.meshgrid(2 * np.pi * np.arange(around) / around, 2 * np.pi * np.arange(across) / across, indexing="ij")
    r = large + small * np.cos(v)
    points = np.column_stack([(r * np.cos(u)).ravel(), (r * np.sin(u)).ravel(), (small * np.sin(v)).ravel()])
    at = lambda i, j: (i % around) * across + j % across
    quads = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for i in range(around) for j in range(across)]
    return points, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def sampled(count, exact):
    """Points of an axis and their radii, made by `exact` of `count` random ones."""
    return exact(np.random.default_rng(1).random((count, 3)))


def box_axis(x, y, z):
    """Points of the middle sheet and of the sheets to the edges of a box, z the shortest side."""
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


def read_ply(path):
    """Vertices with their radii, and triangles."""
    data = path.read_bytes()
    header, body = data.split(b"end_header\n", 1)
    count = {line.split()[1]: int(line.split()[2]) for line in header.decode().splitlines()
             if line.startswith("element")}
    vertices = np.frombuffer(body, "<f8", 4 * count["vertex"]).reshape(-1, 4)
    kind = np.dtype([("n", "u1"), ("v", "<u4", 3)])
    faces = np.frombuffer(body, kind, count.get("face", 0), 32 * count["vertex"])["v"]
    return vertices, faces


def filled(triangles):
    """Points of triangles, so dense that the ones between them are nearer than a quarter of an edge."""
    shares = [(i / 4, j / 4, 1 - i / 4 - j / 4) for i in range(5) for j in range(5 - i)]
    return np.concatenate([np.tensordot(share, triangles, (0, 1)) for share in shares])


def covered(points, centers, radii):
    """Which points some ball holds."""
    inside = np.zeros(len(points), bool)
    for begin in range(0, len(centers), 2000):
        c, r = centers[begin:begin + 2000], radii[begin:begin + 2000]
        left = np.flatnonzero(~inside)
        d2 = ((points[left, None] - c[None]) ** 2).sum(axis=2)
        inside[left] = (d2 <= r ** 2).any(axis=1)
    return inside.mean()


def measure(name, mesh, medial, n, axis=None):
    points, faces = mesh[0] @ TURN.T, mesh[1]
    with tempfile.TemporaryDirectory() as folder:
        source, target = pathlib.Path(folder, "mesh.off"), pathlib.Path(folder, "axis.ply")
        write_off(source, points, faces)
        command = [medial, "voxels", str(source), "-o", str(target), "--surface", "--voxels", str(n),
                   "--threads", "1", "--json", "--stats"]
        report = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout)
        vertices, triangles = read_ply(target)
        subprocess.run(command[:4] + [str(pathlib.Path(folder, "all.ply")), "--thin", "none", "--voxels", str(n)],
                       check=True, stdout=subprocess.DEVNULL)
    step = report["resolution"]

    # The same solid as voxels for scikit-image.
    low = points.min(axis=0) - 2 * step
    size = np.ceil((points.max(axis=0) - low) / step + 2).astype(int)
    volume = inside(points, np.asarray(faces), low, step, size)
    depth = scipy.ndimage.distance_transform_edt(volume) * step
    begin = time.process_time()
    thin = skimage.morphology.skeletonize(volume, method="lee")
    seconds = time.process_time() - begin
    cells = np.argwhere(thin)
    centers = low + (cells + 0.5) * step
    random = np.random.default_rng(2)
    some = np.argwhere(volume)
    some = low + (some[random.integers(len(some), size=4000)] + random.random((4000, 3))) * step

    def row(code, dots, nodes, node_radii, time):
        cells = [name, code, f"{len(nodes):,}"]
        if axis:
            make, off = axis
            exact, exact_radii = sampled(20000, make)
            exact = exact[exact_radii > 3 * step] @ TURN.T
            away = off(nodes @ TURN)
            far = scipy.spatial.cKDTree(dots).query(exact)[0] / step
            cells += [f"{away.mean() / step:.2f}", f"{away.max() / step:.2f}",
                      f"{100 * (far < 1).mean():.1f} %"]
        else:
            cells += ["-", "-", "-"]
        cells += [f"{100 * covered(some, nodes, node_radii):.1f} %", f"{time:.2f}"]
        print("| " + " | ".join(cells) + " |")

    dots = np.concatenate([vertices[:, :3], filled(vertices[triangles, :3])]) if len(triangles) else vertices[:, :3]
    row("`voxels --surface`", dots, vertices[:, :3], vertices[:, 3], report["processor_seconds"])
    row("scikit-image", centers, centers, depth[thin > 0], seconds)


def inside(points, faces, low, step, size):
    """Which voxels have their centres inside: by the parity of crossings below them."""
    crossings = np.zeros(size, np.int32)
    x = low[0] + (np.arange(size[0]) + 0.5) * step + 1e-7 * step
    y = low[1] + (np.arange(size[1]) + 0.5) * step + 1.7e-7 * step
    for a, b, c in points[faces]:
        i0, i1 = np.searchsorted(x, [min(a[0], b[0], c[0]), max(a[0], b[0], c[0])])
        j0, j1 = np.searchsorted(y, [min(a[1], b[1], c[1]), max(a[1], b[1], c[1])])
        if i0 == i1 or j0 == j1:
            continue
        px, py = np.meshgrid(x[i0:i1], y[j0:j1], indexing="ij")
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if area == 0:
            continue
        u = ((b[0] - px) * (c[1] - py) - (b[1] - py) * (c[0] - px)) / area
        v = ((c[0] - px) * (a[1] - py) - (c[1] - py) * (a[0] - px)) / area
        w = 1 - u - v
        hit = (u >= 0) & (v >= 0) & (w >= 0)
        k = np.ceil((u * a[2] + v * b[2] + w * c[2] - low[2]) / step - 0.5).astype(int)
        np.add.at(crossings, (np.nonzero(hit)[0] + i0, np.nonzero(hit)[1] + j0, np.clip(k[hit], 0, size[2] - 1)), 1)
    return np.cumsum(crossings, axis=2) % 2 == 1


def read_obj(path):
    points, faces = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append([float(w) for w in words[1:4]])
        elif words[:1] == ["f"]:
            corner = [int(w.split("/")[0]) - 1 for w in words[1:]]
            faces += [(corner[0], corner[i], corner[i + 1]) for i in range(1, len(corner) - 1)]
    return np.array(points), faces


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("medial")
    parser.add_argument("meshes", nargs="*", type=pathlib.Path)
    parser.add_argument("--voxels", type=int, default=96)
    options = parser.parse_args()
    print("| solid | code | points | mean from the axis, voxels | at most | of the axis within a voxel | of the solid "
          "in the balls | s |\n| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    n = options.voxels
    measure("box 4 x 3 x 2", box(4, 3, 2), options.medial, n, box_axis(4, 3, 2))
    measure("cylinder of 200 sides", cylinder(1, 4, 200), options.medial, n, cylinder_axis(1, 4))
    measure("torus 120 x 40", torus(2, 0.6, 120, 40), options.medial, n, torus_axis(2, 0.6))
    for path in options.meshes:
        measure(path.stem, read_obj(path), options.medial, n)


if __name__ == "__main__":
    main()
