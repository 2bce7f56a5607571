import matplotlib.pyplot as plt
import medial
from matplotlib.font_manager import findfont

font, other_font = findfont("DejaVu Sans"), findfont("DejaVu Serif")
letters = [medial.Shape(medial.text(c, font)) for c in "ABCDEFGHIJKLMNOPQRSTUVWXYZ"]
wanted = medial.Shape(medial.text("R", other_font))
found = medial.match(wanted, letters, best=5)
figure, axes = plt.subplots(1, 6, figsize=(9, 2))
titles = ["wanted", *(f"{one.dissimilarity:.3f}" for one in found)]
for ax, title, shape in zip(axes, titles, [wanted, *(letters[one.index] for one in found)]):
    medial.axis(shape).prune().plot(ax)
    ax.set_title(title, fontsize=10)
    ax.set_axis_off()
