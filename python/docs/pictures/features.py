import matplotlib.pyplot as plt
import medial
from matplotlib.font_manager import findfont

letter = medial.Shape(medial.text("R", findfont("DejaVu Serif")))
runs = medial.features(letter)["runs"]
figure, ax = plt.subplots(figsize=(5, 5))
letter_axis = medial.axis(letter)
letter_axis.plot(ax, cmap="Greys")
kinds = sorted(runs["primitive"].unique())
for kind, colour in zip(kinds, plt.colormaps["tab10"].colors):
    of_kind = runs[runs["primitive"] == kind]
    ax.plot(of_kind[["x_from", "x_to"]].T, of_kind[["y_from", "y_to"]].T, color=colour, linewidth=3, marker="o", markersize=3)
    ax.plot([], color=colour, linewidth=3, label=kind.replace("_", " "))
ax.legend(loc="center left", bbox_to_anchor=(1, 0.5), frameon=False)
ax.set_axis_off()
