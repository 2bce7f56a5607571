import matplotlib.pyplot as plt
import medial

plate = medial.Shape([[(0, 0), (60, 0), (60, 40), (38, 40), (34, 22), (26, 22), (22, 40), (0, 40)], [(10, 9), (10, 17), (22, 17), (22, 9)]])
figure, ax = plt.subplots(figsize=(6, 4.4))
for ring in plate.polygons()[0]:
    ax.fill(*ring.T, facecolor="none", edgecolor="0.3")
for region in medial.offset(plate, [-3, -1.5, 1.5, 3, 4.5, 6, 7.5, 9]):
    for ring in region.polygon():
        ax.plot(*ring.T, color=plt.colormaps["viridis"]((region.distance + 3) / 13), linewidth=1.5)
ax.set_aspect("equal")
ax.set_axis_off()
