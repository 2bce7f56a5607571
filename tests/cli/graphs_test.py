"""Axes as networks: nodes of lines, graphs, `--simplify`, `centreline --all`, and what `verify` says of parts."""

import json
import math
import os
import sqlite3
import unittest

from support import DATA, FRAME, RECTANGLE, SQUARES, CommandLine

try:
    import networkx
except ImportError:
    networkx = None


class Graphs(CommandLine):
    def setUp(self):
        super().setUp()
        self.write("shapes.wkt", FRAME + "\n" + RECTANGLE)

    def features(self, *line):
        return json.loads(self.succeed(*line, "-o", "-", "--format", "geojson").stdout)["features"]

    def test_lines_name_their_nodes(self):
        self.succeed("axis", "shapes.wkt", "-o", "axis.gpkg")
        database = sqlite3.connect(self.path("axis.gpkg"))
        self.addCleanup(database.close)
        nodes = {row[0]: row[1:] for row in database.execute("select node, feature, r, kind from nodes")}
        degree = dict.fromkeys(nodes, 0)
        for feature, begin, end, r_from, r_to in database.execute(
                "select feature, from_node, to_node, r_from, r_to from axis"):
            for node, r in ((begin, r_from), (end, r_to)):
                self.assertEqual(nodes[node][:2], (feature, r))
                degree[node] += 1
        for node, (_, _, kind) in nodes.items():
            self.assertEqual(kind, "leaf" if degree[node] == 1 else "branching")
        # Numbers go on from feature to feature, and --nodes adds those between two edges.
        self.assertEqual(len({node for node, row in nodes.items() if row[0] == 1}), 6)
        self.succeed("axis", "shapes.wkt", "-o", "all.gpkg", "--nodes")
        every = sqlite3.connect(self.path("all.gpkg"))
        self.addCleanup(every.close)
        kinds = dict(every.execute("select kind, count(*) from nodes group by kind"))
        self.assertGreater(kinds.pop("site_change"), 0)
        self.assertEqual(sum(kinds.values()), len(nodes))

    def test_geojson_lines_name_their_nodes(self):
        lines = self.features("axis", "shapes.wkt")
        places = {}
        for line in lines:
            own, points = line["properties"], line["geometry"]["coordinates"]
            for node, point in ((own["from_node"], points[0]), (own["to_node"], points[-1])):
                self.assertEqual(places.setdefault(node, point), point)

    @unittest.skipIf(networkx is None, "networkx is not installed")
    def test_networkx_reads_graphs(self):
        for extension in ("graphml", "nodelink", "edgelist"):
            self.succeed("axis", "shapes.wkt", "-o", "graph." + extension)
        self.succeed("axis", "shapes.wkt", "--units", "mm", "-o", "mm.graphml")
        self.assertEqual(networkx.read_graphml(self.path("mm.graphml"), force_multigraph=True).graph["unit"], "mm")
        self.succeed("axis", "shapes.wkt", "--units", "mm", "-o", "mm.nodelink")
        self.assertEqual(json.loads(self.read("mm.nodelink"))["graph"], {"unit": "mm"})
        self.assertNotIn(b"from_node", self.read("graph.graphml"))  # no key without values
        xml = networkx.read_graphml(self.path("graph.graphml"), node_type=int, force_multigraph=True)
        link = networkx.node_link_graph(json.loads(self.read("graph.nodelink")))
        plain = networkx.read_weighted_edgelist(self.path("graph.edgelist"), nodetype=int,
                                                create_using=networkx.MultiGraph)
        lines = self.features("axis", "shapes.wkt")
        length = sum(line["properties"]["length"] for line in lines)
        for graph, weight in ((xml, "length"), (link, "length"), (plain, "weight")):
            self.assertEqual(graph.number_of_edges(), len(lines))
            self.assertEqual(networkx.number_connected_components(graph), 2)
            # One cycle around the frame's hole.
            self.assertEqual(graph.number_of_edges() - graph.number_of_nodes() + 2, 1)
            self.assertAlmostEqual(graph.size(weight=weight), length, places=12)
        for graph in (xml, link):
            for line in lines:
                node = graph.nodes[line["properties"]["from_node"]]
                self.assertEqual([node["x"], node["y"]], line["geometry"]["coordinates"][0])
                self.assertEqual(node["r"], line["properties"]["r_from"])
        drawn = sorted(line["geometry"]["coordinates"] for line in lines)
        self.assertEqual(sorted(points for *_, points in link.edges(data="geometry")), drawn)
        read = sorted([[float(v) for v in point.split()] for point in text[12:-1].split(",")]
                      for *_, text in xml.edges(data="geometry"))
        self.assertEqual(read, drawn)

    @unittest.skipIf(networkx is None, "networkx is not installed")
    def test_names_survive_xml(self):
        names = "a<b&\"c\"\x01"
        self.write("one.geojson", json.dumps({"type": "Feature", "properties": {"name": names}, "geometry": {
            "type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 2], [0, 2], [0, 0]]]}}))
        self.succeed("axis", "one.geojson", "-o", "graph.graphml")
        graph = networkx.read_graphml(self.path("graph.graphml"))
        self.assertEqual({name for *_, name in graph.edges(data="name")}, {names.replace("\x01", " ")})

    def test_simplified_lines_stay_within_their_error(self):
        coast, chord = os.path.join(DATA, "newfoundland.wkt.gz"), 8
        fine = self.features("prune", coast, "--keep", 5, "--chord", "1e-5")
        for error in (200, 5000):
            few = self.features("prune", coast, "--keep", 5, "--simplify", error)
            count = [sum(len(line["geometry"]["coordinates"]) for line in lines) for lines in (fine, few)]
            self.assertLess(count[1], count[0] / 2)
            for exact, line in zip(fine, few):
                points = line["geometry"]["coordinates"]
                self.assertEqual(exact["properties"], line["properties"])
                self.assertEqual(exact["geometry"]["coordinates"][0], points[0])
                self.assertEqual(exact["geometry"]["coordinates"][-1], points[-1])
                for p in exact["geometry"]["coordinates"]:
                    self.assertLessEqual(min(distance(p, a, b) for a, b in zip(points, points[1:])), error + chord)
        self.refuse("invalid_option", "prune", "shapes.wkt", "--simplify", "0", "-o", "x.geojson")


def distance(p, a, b):
    along = (b[0] - a[0], b[1] - a[1])
    square = along[0] ** 2 + along[1] ** 2
    t = ((p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1]) / square if square > 0 else 0
    t = min(max(t, 0), 1)
    return math.hypot(p[0] - a[0] - t * along[0], p[1] - a[1] - t * along[1])


class Network(CommandLine):
    # Two streets that cross, each 2 wide.
    CROSS = "POLYGON ((0 9, 9 9, 9 0, 11 0, 11 9, 20 9, 20 11, 11 11, 11 20, 9 20, 9 11, 0 11, 0 9))"

    def test_all_keeps_the_network_without_forks(self):
        self.write("cross.wkt", self.CROSS)
        done = self.succeed("centreline", "cross.wkt", "-o", "line.geojson")
        self.assertIn(b"--all", done.stderr)
        self.assertEqual(self.succeed("centreline", "cross.wkt", "-o", "line.geojson", "--quiet").stderr, b"")
        self.succeed("centreline", "cross.wkt", "--all", "-o", "all.geojson")
        lines = json.loads(self.read("all.geojson"))["features"]
        self.assertEqual(len(lines), 4)
        ends = sorted(tuple(line["geometry"]["coordinates"][k]) for line in lines for k in (0, -1))
        for end in ((1, 10), (10, 1), (10, 19), (19, 10)):
            self.assertTrue(any(math.dist(end, other) < 1e-9 for other in ends), ends)
        self.refuse("invalid_option", "centreline", "cross.wkt", "--all", "--extend")
        # Nothing is left out of a rectangle.
        self.write("rectangle.wkt", RECTANGLE)
        self.assertEqual(self.succeed("centreline", "rectangle.wkt", "-o", "line.geojson").stderr, b"")

    def test_all_keeps_ways_around_holes(self):
        self.write("frame.wkt", FRAME)
        lines = json.loads(self.succeed("centreline", "frame.wkt", "--all", "-o", "-", "--format",
                                        "geojson").stdout)["features"]
        self.assertEqual(len(lines), 1)
        self.assertEqual(lines[0]["properties"]["from_node"], lines[0]["properties"]["to_node"])


class Parts(CommandLine):
    def test_verify_checks_what_holds_of_a_part(self):
        self.write("shapes.wkt", FRAME + "\n" + SQUARES + "\n" + RECTANGLE)
        for line in (["prune", "shapes.wkt", "--significance", "1"], ["centreline", "shapes.wkt"], ["centreline", "shapes.wkt", "--all"],
                     ["centreline", "shapes.wkt", "--clearance", "0.4"],
                     ["centreline", "shapes.wkt", "--smooth", "1"]):
            self.succeed(*line, "-o", "part.json", "--quiet")
            report = json.loads(self.succeed("verify", "shapes.wkt", "part.json", "--json").stdout)
            self.assertTrue(report["passed"] and report["part"], line)
            self.assertGreater(report["disks_checked"], 0)
        self.assertIn("not checked", self.succeed("verify", "shapes.wkt", "part.json").stdout.decode())
        # Neither a wrong disk nor a whole axis without its leaves passes.
        self.succeed("prune", "shapes.wkt", "--significance", "1", "-o", "part.json")
        part = json.loads(self.read("part.json"))
        for item in part["items"]:
            del item["part"]
        self.write("whole.json", json.dumps(part))
        self.assertEqual(self.run_medial("verify", "shapes.wkt", "whole.json").returncode, 1)
        part = json.loads(self.read("part.json"))
        part["items"][0]["axis"]["nodes"][0][2] *= 1.01
        self.write("wrong.json", json.dumps(part))
        self.assertEqual(self.run_medial("verify", "shapes.wkt", "wrong.json").returncode, 1)
