import matplotlib.pyplot as plt
import medial
from matplotlib.collections import LineCollection

plate = medial.Shape("M 0 0 H 70 V 30 H 45 A 10 10 0 0 0 25 30 H 0 Z M 12 8 V 20 H 22 V 8 Z")
carving = medial.carve(plate, angle=60, depth=6, tip=0.5, step=1.2)
figure, ax = plt.subplots(figsize=(8, 4))
for polygon in plate.polygons():
    for ring in polygon:
        ax.plot(*ring.T, color="0.3", linewidth=1)
for kind, rows in carving:
    pieces = [[a[:2], b[:2]] for a, b in zip(rows, rows[1:])]
    drawn = LineCollection(pieces, array=(rows[:-1, 2] + rows[1:, 2]) / 2, cmap="viridis", clim=(-carving.deepest, 0))
    ax.add_collection(drawn)
figure.colorbar(drawn, label="depth of the tip", shrink=0.7)
ax.set_aspect("equal")
ax.set_axis_off()
