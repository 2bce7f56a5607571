# %% [markdown]
# # Letters
#
# What a letter is made of: branches, their widths, and which letters are alike.

# %%
import medial
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath


def letter(character, family="DejaVu Sans"):
    path = TextPath((0, 0), character, size=100, prop=FontProperties(family=family))
    return [ring[:-1] for ring in path.to_polygons(closed_only=True)]


medial.axis(letter("R")).prune()

# %%
medial.features(letter("R"))["branches"][["from_kind", "to_kind", "length", "mean_width"]].round(2)

# %%
alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
found = medial.match(letter("R", "DejaVu Serif"), [letter(c) for c in alphabet])
[(alphabet[one.index], round(one.dissimilarity, 3)) for one in found[:5]]
