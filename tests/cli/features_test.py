"""`medial features` and `medial match`."""

import csv
import json
import math
import os

from support import GEOGRAPHIC, CommandLine


class Features(CommandLine):
    def test_features(self):
        """A rectangle is a worm and four wedges, in every format; of axes and of shapes alike."""
        self.write("long.wkt", "POLYGON ((0 0, 8 0, 8 2, 0 2, 0 0))")
        report = json.loads(self.succeed("features", "long.wkt", "--json").stdout)
        self.assertEqual((report["ends"], report["branches"], report["runs"]), (4, 5, 5))
        self.assertAlmostEqual(report["primitives"]["worm"], 6 / (6 + 4 * math.sqrt(2)))
        self.succeed("axis", "long.wkt", "-o", "long.json")
        for output in ("f.json", "f.csv", "f.geojson", "f.gpkg", "f.shp", "f.fgb", "f.svg", "f.pdf", "f.png"):
            self.succeed("features", "long.json", "-o", output)
            self.assertGreater(os.path.getsize(self.path(output)), 0, output)
        item = json.loads(self.read("f.json"))["items"][0]
        self.assertEqual(sorted(b["runs"][0]["primitive"] for b in item["branches"]),
                         ["closing_wedge"] * 4 + ["worm"])
        self.assertAlmostEqual(sum(b["area"] for b in item["branches"]), 16)
        rows = list(csv.DictReader(self.read("f.csv").decode().splitlines()))
        self.assertEqual(len(rows), 5)
        for table, count in (("runs", 5), ("branches", 5), ("points", 6)):
            text = self.succeed("features", "long.wkt", "-o", "-", "--format", "csv", "--table", table).stdout
            self.assertEqual(len(text.decode().splitlines()), count + 1, table)
        # The attributes of each place come along.
        self.write("places.geojson", GEOGRAPHIC)
        for table in ("runs", "branches", "points"):
            self.succeed("features", "places.geojson", "--table", table, "-o", "p.geojson")
            names = [f["properties"]["name"] for f in json.loads(self.read("p.geojson"))["features"]]
            self.assertEqual(sorted(set(names)), ["east", "west"], table)
            self.assertEqual(names, sorted(names, reverse=True), table)
        self.succeed("features", "places.geojson", "-o", "p.json")
        items = json.loads(self.read("p.json"))["items"]
        self.assertEqual([dict(item["attributes"])["name"] for item in items], ["west", "east"])
        self.refuse("invalid_option", "features", "long.wkt", "--bend", "nan")
        self.refuse("unsupported", "features", "long.wkt", "-o", "f.dxf")


class Nest(CommandLine):
    def test_nest(self):
        """A peg goes into its slot, and keeps its distance; squares have no bay."""
        self.write("slot.wkt", "POLYGON ((0 0, 60 0, 60 40, 42 40, 38 12, 22 12, 18 40, 0 40, 0 0))")
        self.write("tee.wkt", "POLYGON ((0 0, 14 0, 17 30, 45 33, 45 47, -28 47, -28 33, -3 30, 0 0))")
        self.write("square.wkt", "POLYGON ((0 0, 3 0, 3 3, 0 3, 0 0))")
        report = json.loads(self.succeed("nest", "slot.wkt", "tee.wkt", "--gap", "1", "--best", "2", "-o", "pair.svg",
                                         "--json").stdout)
        self.assertEqual(len(report["placements"]), 2)
        self.assertGreater(report["placements"][0]["saved"], 600)
        self.assertGreaterEqual(report["placements"][0]["gap"], 1)
        self.assertIn(b"<svg", self.read("pair.svg"))
        self.refuse("empty", "nest", "square.wkt", "square.wkt")


class Match(CommandLine):
    def test_match(self):
        """The rectangle turned is the rectangle; the square is further away."""
        self.write("a.wkt", "POLYGON ((0 0, 8 0, 8 2, 0 2, 0 0))")
        os.mkdir(self.path("others"))
        self.write("others/turned.wkt", "POLYGON ((0 0, 3 0, 3 12, 0 12, 0 0))")
        self.write("others/square.wkt", "POLYGON ((0 0, 3 0, 3 3, 0 3, 0 0))")
        self.write("others/no-shape.txt", "nothing")
        report = json.loads(self.succeed("match", "a.wkt", "others", "--json").stdout)
        self.assertEqual(report["refused"], 1)
        self.assertEqual([os.path.basename(m["shape"]) for m in report["matches"]], ["turned.wkt", "square.wkt"])
        self.assertLess(report["matches"][0]["dissimilarity"], 1e-2)
        self.assertGreater(report["matches"][1]["dissimilarity"], 0.2)
        self.refuse("unreadable", "match", "a.wkt", "nowhere")
