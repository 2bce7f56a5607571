"""Pictures: by matplotlib, and as SVG for notebooks."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._errors import need

if TYPE_CHECKING:
    from ._axis import MedialAxis

# A few colours of viridis, from small to large radii.
_COLOURS = ["#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30"]


def plot(axis: MedialAxis, ax: Any = None, *, shape: bool = True, disks: int = 0,
         cmap: str = "viridis", linewidth: float = 1.8, **given: Any) -> Any:  # fmt: skip
    """Draws an axis, coloured by radius, and its shape."""
    pyplot = need("matplotlib.pyplot", "plot")
    collections = need("matplotlib.collections", "plot")
    if ax is None:
        ax = pyplot.gca()
    if shape:
        for polygon in axis.shape.polygons():
            for ring in polygon:
                ax.plot(*ring.T, color="0.35", linewidth=0.9)
    pieces, values = [], []
    for line in axis.sample():
        pieces.append(np.stack([line[:-1, :2], line[1:, :2]], axis=1))
        values.append((line[:-1, 2] + line[1:, 2]) / 2)
    if pieces:
        drawn = collections.LineCollection(np.concatenate(pieces), cmap=cmap, linewidths=linewidth,
                                           array=np.concatenate(values), **given)  # fmt: skip
        ax.add_collection(drawn)
    if disks:
        nodes = axis.nodes[np.linspace(0, len(axis.nodes) - 1, min(disks, len(axis.nodes))).astype(int)]
        for x, y, radius in zip(nodes["x"], nodes["y"], nodes["radius"], strict=True):
            ax.add_patch(pyplot.Circle((x, y), radius, fill=False, color="0.7", linewidth=0.6))
    ax.set_aspect("equal")
    ax.autoscale_view()
    return ax


def _path(points: Any, close: bool = False) -> str:
    return "M" + "L".join(f"{x:.5g},{y:.5g}" for x, y in points.tolist()) + ("Z" if close else "")


def svg_of(axis: MedialAxis, size: float = 360) -> str:
    """A small picture; y points up."""
    shape = axis.shape
    low_x, low_y, high_x, high_y = shape.bounds if len(shape.points) else (0.0, 0.0, 1.0, 1.0)
    scale = size / max(high_x - low_x, high_y - low_y, 1e-300)
    margin = 6.0

    def placed(points: Any) -> Any:
        return (points - [low_x, high_y]) * [scale, -scale] + margin

    width, height = (high_x - low_x) * scale + 2 * margin, (high_y - low_y) * scale + 2 * margin
    outline = "".join(_path(placed(ring[:-1]), True) for polygon in shape.polygons() for ring in polygon)
    parts = [f'<path d="{outline}" fill="#f1f1ee" fill-rule="evenodd" stroke="#555" stroke-width="1"/>']
    deepest = float(axis.nodes["radius"].max()) if len(axis.nodes) else 1.0
    classes: list[list[str]] = [[] for _ in _COLOURS]
    for line in axis.sample():
        kinds = np.minimum((line[:-1, 2] + line[1:, 2]) / 2 / (deepest or 1) * len(classes), len(classes) - 1).astype(int)
        cuts = np.flatnonzero(np.diff(kinds)) + 1
        points = placed(line[:, :2])
        for a, b in zip([0, *cuts.tolist()], [*cuts.tolist(), len(kinds)], strict=True):
            if b > a:
                classes[kinds[a]].append(_path(points[a : b + 1]))
    for colour, paths in zip(_COLOURS, classes, strict=True):
        if paths:
            parts.append(f'<path d="{"".join(paths)}" fill="none" stroke="{colour}" stroke-width="2" stroke-linecap="round"/>')
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.5g}" height="{height:.5g}" '
            f'viewBox="0 0 {width:.5g} {height:.5g}">' + "".join(parts) + "</svg>")  # fmt: skip
