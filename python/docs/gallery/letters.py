# %% [markdown]
# # Letters
#
# What a letter is made of: branches, their widths, and which letters are alike.

# %%
import medial
from matplotlib.font_manager import findfont


def letter(character, family="DejaVu Sans"):
    return medial.Shape(medial.text(character, findfont(family)))


medial.axis(letter("R")).prune()

# %%
medial.features(letter("R"))["branches"][["from_kind", "to_kind", "length", "mean_width"]].round(2)

# %%
alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
found = medial.match(letter("R", "DejaVu Serif"), [letter(c) for c in alphabet])
[(alphabet[one.index], round(one.dissimilarity, 3)) for one in found[:5]]
