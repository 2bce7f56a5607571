import matplotlib.pyplot as plt
import medial

bracket = medial.Shape([(0, 0), (60, 0), (60, 50), (46, 50), (46, 14), (14, 14), (14, 50), (0, 50)])
hook = medial.Shape([(0, 0), (22, 0), (22, 60), (46, 60), (46, 70), (0, 70)])
figure, axes = plt.subplots(1, 3, figsize=(9, 3.4), sharex=True, sharey=True)
for ax, place in zip(axes, medial.nest(bracket, hook, gap=2, best=3)):
    for shape, colour in ((bracket, "#9fb7d4"), (place.placed(hook), "#e0a458")):
        for outline, *holes in shape.polygons():
            ax.fill(*outline.T, color=colour)
    ax.set_title(f"saves {place.saved:.0f}", fontsize=10)
    ax.set_aspect("equal")
    ax.set_axis_off()
