# %% [markdown]
# # A V-carve of text
#
# The tip of a conical tool follows the axis, where it goes as deep as the disk is wide.

# %%
import medial
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath

text = TextPath((0, 0), "Axis", size=40, prop=FontProperties(family="DejaVu Serif"))
rings = [ring[:-1] for ring in text.to_polygons(closed_only=True)]
carving = medial.carve(medial.axis(rings), angle=60, depth=4)
print(carving.to_gcode()[:180])

# %%
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

figure, ax = plt.subplots(figsize=(9, 4))
for ring in rings:
    ax.fill(*ring.T, facecolor="none", edgecolor="0.3")
for kind, rows in carving:
    pieces = np.stack([rows[:-1, :2], rows[1:, :2]], axis=1)
    depth = (rows[:-1, 2] + rows[1:, 2]) / 2
    ax.add_collection(LineCollection(pieces, array=depth, cmap="viridis_r", clim=(-carving.deepest, 0), linewidths=1 - 1.2 * depth))
ax.set_aspect("equal")
ax.set_axis_off()
