import matplotlib.pyplot as plt
import medial.image
import numpy as np
from skimage import data, morphology

horse = ~data.horse()
plate = np.zeros((96, 240), bool)
plate[12:84, 12:228] = True
plate[6:12, 114:122] = True
functions = {
    "scikit-image medial_axis": morphology.medial_axis,
    "medial.image.medial_axis": medial.image.medial_axis,
    "scikit-image skeletonize": morphology.skeletonize,
    "medial.image.skeletonize": medial.image.skeletonize,
}
figure, axes = plt.subplots(4, 2, figsize=(9, 12), height_ratios=(3.4, 1.8, 3.4, 1.8))
for k, (title, function) in enumerate(functions.items()):
    for ax, image in zip(axes[k // 2 * 2 : k // 2 * 2 + 2, k % 2], (horse, plate)):
        ax.imshow(np.where(image, 0.88, 1), cmap="gray", vmin=0, vmax=1)
        y, x = np.nonzero(function(image))
        ax.plot(x, y, "s", markersize=0.9, color="#b02010")
        ax.set_axis_off()
    axes[k // 2 * 2, k % 2].set_title(title)
figure.tight_layout()
