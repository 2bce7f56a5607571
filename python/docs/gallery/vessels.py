# %% [markdown]
# # Vessels in an image
#
# Lengths and diameters of vessels, from a picture, in units of the specimen.

# %%
import numpy as np
from scipy import ndimage
from skimage import data, measure

retina = data.retina()[:, :, 1].astype(float)
dark = ndimage.gaussian_filter(retina, 12) - ndimage.gaussian_filter(retina, 2)
disk = np.hypot(*(np.indices(retina.shape) - 705)) < 600
labels = measure.label((dark > 5) & disk)
sizes = np.bincount(labels.ravel())
labels[sizes[labels] < 800] = 0

# %%
import pandas
import medial.image

axes = medial.image.axis(labels, spacing=0.01)
table = pandas.concat({label: axis.branches for label, axis in axes.items()}, names=["vessel"])
table[["length", "mean_width", "radius_max"]].describe().round(3)

# %%
import matplotlib.pyplot as plt

figure, ax = plt.subplots(figsize=(7, 7))
ax.imshow(retina, cmap="gray", extent=(0, 14.11, 14.11, 0))
for axis in axes.values():
    axis.plot(ax, shape=False, linewidth=1.2)
ax.set_axis_off()
