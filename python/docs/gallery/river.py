# %% [markdown]
# # The centre line of a river, with widths
#
# A river is a polygon; its centre line is the main path of its medial axis. No densification, no
# tolerance to choose: the line is exact, and so are the widths along it.

# %%
import geopandas
import numpy as np
import shapely

along = np.linspace(0, 4000, 400)
middle = np.stack([along, 250 * np.sin(along / 400)], axis=1)
width = 60 + 25 * np.sin(along / 170) + along / 60
normal = np.stack([-np.gradient(middle[:, 1], along), np.ones_like(along)], axis=1)
normal /= np.hypot(*normal.T)[:, None]
banks = np.concatenate([middle + normal * width[:, None] / 2, (middle - normal * width[:, None] / 2)[::-1]])
rivers = geopandas.GeoDataFrame({"name": ["example"]}, geometry=[shapely.Polygon(banks)], crs=2056)

# %%
import medial.geo

lines = rivers.medial.centerline(extend=True)
cuts = rivers.medial.transects(40)
rivers.medial.width()

# %%
ax = rivers.plot(color="#cfe3f2", figsize=(9, 3))
lines.plot(ax=ax, color="#10508a")
cuts.plot(ax=ax, column="width", linewidth=1)
ax.set_axis_off()
