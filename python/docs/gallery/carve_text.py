# %% [markdown]
# # A V-carve of text
#
# The tip of a conical tool follows the axis, where it goes as deep as the disk is wide.

# %%
import medial
from matplotlib.font_manager import findfont

text = medial.Shape(medial.text("Axis", findfont("DejaVu Serif")))
carving = medial.carve(text, angle=60, depth=200)  # in units of the font
print(carving.to_gcode(post="grbl")[:330])

# %%
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

figure, ax = plt.subplots(figsize=(9, 4))
for polygon in text.polygons():
    for ring in polygon:
        ax.fill(*ring.T, facecolor="none", edgecolor="0.3")
for kind, rows in carving:
    pieces = np.stack([rows[:-1, :2], rows[1:, :2]], axis=1)
    depth = (rows[:-1, 2] + rows[1:, 2]) / 2
    ax.add_collection(LineCollection(pieces, array=depth, cmap="viridis_r", clim=(-carving.deepest, 0), linewidths=1 - 0.024 * depth))
ax.set_aspect("equal")
ax.set_axis_off()
