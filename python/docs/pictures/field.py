import matplotlib.pyplot as plt
import medial
import numpy as np

room = [(0, 0), (8, 0), (8, 3), (5, 3), (5, 6), (0, 6)]
charged = medial.field(room, order=4)
x, y = np.meshgrid(np.linspace(0, 8, 320), np.linspace(0, 6, 240))
potential = charged.sample(np.stack([x.ravel(), y.ravel()], axis=1))["log_potential"].reshape(x.shape)
figure, ax = plt.subplots(figsize=(6, 4.6))
ax.contourf(x, y, np.clip(potential, None, np.nanquantile(potential, 0.9)), 30, cmap="viridis_r")
for corner in room:
    inside = np.array([2.5, 2.5]) - corner
    ax.plot(*charged.streamline(corner + 0.02 * inside, 0.05).T, color="white", linewidth=1.5)
medial.axis(room).plot(ax, cmap="Greys", linewidth=0.8)
ax.set_axis_off()
