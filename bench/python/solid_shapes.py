"""Solids for solids.py: made or read meshes, their voxels, and points of their medial axes."""

import numpy as np
import scipy.spatial


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


def read_mesh(path):
    """Points and triangles of an .obj or .off file."""
    lines = [line.split() for line in path.read_text().splitlines() if line.strip() and line[0] != "#"]
    if path.suffix == ".obj":
        points = [[float(w) for w in words[1:4]] for words in lines if words[0] == "v"]
        corners = [[int(w.split("/")[0]) - 1 for w in words[1:]] for words in lines if words[0] == "f"]
    else:
        count = int(lines[1][0])
        points = [[float(w) for w in words[:3]] for words in lines[2:2 + count]]
        corners = [[int(w) for w in words[1:1 + int(words[0])]] for words in lines[2 + count:]]
    faces = [(c[0], c[i], c[i + 1]) for c in corners for i in range(1, len(c) - 1)]
    return np.array(points), faces


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


def sample_surface(points, faces, count):
    """Random points of the surface, and the normals into the solid."""
    random = np.random.default_rng(1)
    a, b, c = np.moveaxis(points[np.asarray(faces)], 1, 0)
    normal = np.cross(b - a, c - a)
    twice = np.linalg.norm(normal, axis=1)
    face = random.choice(len(twice), count, p=twice / twice.sum())
    u, v = random.random((2, count))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum()
    into = (-1 if volume > 0 else 1) * normal / np.where(twice > 0, twice, 1)[:, None]
    return a[face] + u[:, None] * (b - a)[face] + v[:, None] * (c - a)[face], into[face]


def sampled_axis(points, faces, count=200000, angle=30):
    """Points of the medial axis and their radii, by the shrinking ball of Ma, Bae and Choi (2012): each ball touches
    the surface in a random point and shrinks until it holds no other. Of those that see two feet under the angle,
    in degrees, or more."""
    feet, into = sample_surface(points, faces, count)
    tree = scipy.spatial.cKDTree(feet)
    radius = np.full(count, np.ptp(points, axis=0).min() / 2)  # no ball inside is larger
    other = np.zeros(count, int)
    left = np.arange(count)
    for _ in range(60):
        center = feet[left] + radius[left, None] * into[left]
        near, nearest = tree.query(center, distance_upper_bound=radius.max())
        nearest = np.where(np.isfinite(near), nearest, left)
        way = feet[nearest] - feet[left]
        ahead = np.einsum("ij,ij->i", way, into[left])
        with np.errstate(divide="ignore", invalid="ignore"):
            smaller = np.einsum("ij,ij->i", way, way) / (2 * ahead)
        shrinks = (ahead > 0) & (smaller < radius[left] * (1 - 1e-6))
        left, nearest, smaller = left[shrinks], nearest[shrinks], smaller[shrinks]
        if len(left) == 0:
            break
        radius[left], other[left] = smaller, nearest
    center = feet + radius[:, None] * into
    apart = np.linalg.norm(feet[other] - feet, axis=1) / (2 * radius)
    seen = apart > np.sin(np.radians(angle) / 2)
    return center[seen], radius[seen]
