# %% [markdown]
# # Skeletons of two hundred cells
#
# `medial.image.axis` makes one exact graph for each label, with pruned branches.

# %%
import numpy as np
from skimage import draw

rng = np.random.default_rng(5)
labels = np.zeros((640, 860), int)
for number, (row, column) in enumerate(np.ndindex(12, 17), 1):
    center = np.array([30 + row * 52, 30 + column * 50]) + rng.uniform(-4, 4, 2)
    where = draw.ellipse(*center, rng.uniform(8, 22), rng.uniform(5, 11), rotation=rng.uniform(0, np.pi))
    labels[where] = number

# %%
import medial.image

axes = medial.image.axis(labels)
widths = {label: 2 * axis.nodes["radius"].max() for label, axis in axes.items()}
len(axes), np.mean(list(widths.values()))

# %%
import matplotlib.pyplot as plt

figure, ax = plt.subplots(figsize=(9, 6.6))
for axis in axes.values():
    axis.plot(ax, linewidth=1.2)
ax.invert_yaxis()
ax.set_axis_off()
