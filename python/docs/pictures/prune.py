import matplotlib.pyplot as plt
import medial
import numpy as np

turns = np.linspace(0, 2 * np.pi, 240, endpoint=False)
radius = 10 + 4 * np.cos(3 * turns) + np.random.default_rng(2).normal(0, 0.12, turns.size)
blob = np.stack([radius * np.cos(turns), radius * np.sin(turns)], axis=1)
axis = medial.axis(blob)
figure, axes = plt.subplots(1, 3, figsize=(9, 3.2))
parts = {"axis()": axis, 'prune("erosion", 0.2)': axis.prune("erosion", 0.2), "prune()": axis.prune()}
for ax, (title, part) in zip(axes, parts.items()):
    part.plot(ax)
    ax.set_title(title, fontsize=10)
    ax.set_axis_off()
