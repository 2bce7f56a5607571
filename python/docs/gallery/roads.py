# %% [markdown]
# # Roads from polygons, as a graph
#
# Surveys draw roads as areas. The axis of the area is their network; pruning by erosion leaves out the
# corners, which protrude by less than a road is wide.

# %%
import shapely

streets = [((0, 0), (0, 90)), ((40, -5), (40, 95)), ((85, 0), (80, 90)), ((-5, 20), (95, 15)), ((-5, 70), (95, 75)), ((40, 45), (95, 48))]
area = shapely.union_all([shapely.LineString(street).buffer(3, cap_style="flat") for street in streets])

# %%
import networkx
import medial

axis = medial.axis(area).prune("erosion", 1)
graph = axis.to_networkx(branches=True)
start = min(graph, key=lambda node: graph.nodes[node]["x"] + graph.nodes[node]["y"])
end = max(graph, key=lambda node: graph.nodes[node]["x"] + graph.nodes[node]["y"])
way = networkx.shortest_path(graph, start, end, weight="length")
networkx.shortest_path_length(graph, start, end, weight="length")

# %%
ax = axis.plot(cmap="Greys")
networkx.draw_networkx_nodes(graph, networkx.get_node_attributes(graph, "pos"), way, node_size=25, node_color="#c03020", ax=ax)
ax.set_axis_off()
