import matplotlib.pyplot as plt
import medial

walls = [[(0, 0), (4, 1), (6, 0)], [(1, 4), (3, 3), (3, 5)], [(7, 2), (7, 5)], [(5, 3.5)]]
diagram = medial.voronoi(walls, margin=1.5)
figure, ax = plt.subplots(figsize=(6, 4.6))
colours = plt.colormaps["Pastel1"].colors
for cell, site in zip(diagram.cells(), diagram.sites):
    ax.fill(*cell.T, color=colours[site["ring"] % len(colours)], edgecolor="white")
for wall in walls:
    ax.plot(*zip(*wall), color="0.2", linewidth=2, marker="o", markersize=4)
places = [(2, 2), (5.6, 2), (4.2, 4.6)]
for place, foot in zip(places, diagram.nearest(places).foot):
    ax.annotate("", foot, place, arrowprops={"arrowstyle": "->", "color": "#b02010"})
ax.set_aspect("equal")
ax.set_axis_off()
