"""`medial offset`."""

import json
import math
import sqlite3

from support import CommandLine


class Offset(CommandLine):
    SQUARE = "POLYGON ((0 0, 10 0, 10 8, 0 8, 0 0), (4 3, 4 5, 6 5, 6 3, 4 3))"

    def test_arcs_flatter_than_rounding_are_segments_in_text(self):
        self.write("a.wkt", "POLYGON((0 0,1 -4e-14,2 0,2 2,0 2))")
        self.succeed("offset", "a.wkt", "--distance=-0.5", "-o", "b.wkt")
        self.assertEqual(self.read("b.wkt").decode().count("CIRCULARSTRING"), 4)
        self.succeed("axis", "b.wkt", "-o", "b.json")
        self.succeed("verify", "b.wkt", "b.json")

    def test_every_format(self):
        self.write("s.wkt", self.SQUARE)
        for name in self.supported("o.json", "o.geojson", "o.wkt", "o.dxf", "o.svg", "o.pdf", "o.png", "o.ps"):
            self.succeed("offset", "s.wkt", "--distance=1,-1", "-o", name)
            self.assertGreater(len(self.read(name)), 100)
        stored = json.loads(self.read("o.json"))
        regions = stored["items"][0]["regions"]
        self.assertEqual([r["clearance"] for r in regions], [-1, 1])
        self.assertEqual([r["parent"] for r in regions], [None, 0])
        self.assertEqual([len(r["rings"]) for r in regions], [1, 2])
        features = json.loads(self.read("o.geojson"))["features"]
        self.assertAlmostEqual(features[0]["properties"]["area"], 80 + 36 + math.pi)
        self.assertIn(b"CIRCULARSTRING", self.read("o.wkt"))
        self.succeed("offset", "s.wkt", "--distance=1,-1", "--chords", "-o", "o.wkt")
        self.assertNotIn(b"CIRCULARSTRING", self.read("o.wkt"))
        for output in (["-o", "p.svg"], ["-o", "p.dxf"], ["-o", "p.geojson"], []):
            self.assertIn("--chords", self.refuse("invalid_option", "offset", "s.wkt", "--distance=-1", "--chords", *output))
        self.assertEqual(self.read("o.wkt").count(b"\n"), 2)

    def test_tables(self):
        """Regions are polygons with the attributes of their features; diagrams and shapes go the same way."""
        self.write("s.geojson", json.dumps({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {"name": "yard", "floors": 3}, "geometry": {
                "type": "Polygon", "coordinates": [[[x, 0], [x + 1000, 0], [x + 1000, 800], [x, 800], [x, 0]]]}}
            for x in (0, 2000)]}))
        for name in self.supported("o.gpkg", "o.shp", "o.fgb"):
            self.succeed("offset", "s.geojson", "--distance=100,-10", "-o", name)
            self.assertEqual(json.loads(self.succeed("info", name, "--json").stdout)["features"], 4)
        with sqlite3.connect(self.path("o.gpkg")) as database:
            rows = database.execute("select feature, region, clearance, parent, area, name, floors from offsets").fetchall()
        self.assertEqual([row[:4] for row in rows], [(0, 0, -10, None), (0, 1, 100, 0), (1, 0, -10, None), (1, 1, 100, 0)])
        self.assertEqual({row[5:] for row in rows}, {("yard", 3)})
        self.assertAlmostEqual(rows[1][4], 800 * 600)
        self.refuse("unwritable", "offset", "s.geojson", "--distance", "1", "-o", "o.gpkg", "--quiet")
        self.succeed("voronoi", "s.geojson", "-o", "o.gpkg")
        self.succeed("smooth", "s.geojson", "-o", "o.gpkg")
        with sqlite3.connect(self.path("o.gpkg")) as database:
            counts = [database.execute(f"select count(*) from {table}").fetchone()[0]
                      for table in ("offsets", "faces", "shapes")]
        self.assertEqual(counts, [4, 16, 2])
        self.refuse("unsupported", "voronoi", "s.geojson", "-o", "v.shp", "--quiet")  # two tables

    def test_passes(self):
        self.write("s.wkt", self.SQUARE)
        report = json.loads(self.succeed("offset", "s.wkt", "--step", "0.5", "--until", "empty",
                                         "--json").stdout)
        self.assertEqual((report["features"], report["regions"]), (1, 1 + 1 + 2 + 4))
        self.succeed("offset", "s.wkt", "--step", "0.5", "--until", "2", "--exterior", "-o", "-",
                     "--format", "wkt")
        self.refuse("invalid_option", "offset", "s.wkt", "--step", "0.5", "--exterior")
        self.refuse("too_large", "offset", "s.wkt", "--step", "1e-9")

    def test_buffers_carry_attributes(self):
        """A region carries the attributes that its features agree on; regions merge."""
        def road(x, **properties):
            return {"type": "Feature", "properties": properties,
                    "geometry": {"type": "LineString", "coordinates": [[x, 0], [x, 10]]}}
        self.write("roads.geojson", json.dumps({"type": "FeatureCollection", "features": [
            road(0, kind="road", name="a"), road(4, kind="road", name="b"), road(100, kind="path", name="c")]}))
        self.succeed("offset", "roads.geojson", "--loose", "--distance", "1,3", "-o", "b.json")
        regions = json.loads(self.read("b.json"))["items"][0]["regions"]
        report = {(r["clearance"], tuple(r["features"])): dict(r["attributes"]) for r in regions}
        self.assertEqual(report, {(-1, (0,)): {"kind": "road", "name": "a"}, (-1, (1,)): {"kind": "road", "name": "b"},
                                  (-1, (2,)): {"kind": "path", "name": "c"}, (-3, (0, 1)): {"kind": "road"},
                                  (-3, (2,)): {"kind": "path", "name": "c"}})
        self.succeed("offset", "roads.geojson", "--loose", "--distance", "3", "-o", "b.geojson")
        report = [f["properties"] for f in json.loads(self.read("b.geojson"))["features"]]
        self.assertEqual(sorted((p["features"], p["kind"], p.get("name")) for p in report),
                         [([0, 1], "road", None), ([2], "path", "c")])
        # What rounding cannot separate touches and is one region; nobody's attributes are lost.
        pieces = [("LineString", [[0, 0], [3, 1]], "a"), ("LineString", [[1.5, 0.50000000000001], [1, 2]], "b"),
                  ("Point", [3.00000000000001, 1], "c")]
        self.write("near.geojson", json.dumps({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {"kind": "road", "name": name},
             "geometry": {"type": kind, "coordinates": places}} for kind, places, name in pieces]}))
        self.succeed("offset", "near.geojson", "--loose", "--distance", "0.1", "-o", "n.json")
        report = json.loads(self.read("n.json"))["items"][0]["regions"]
        self.assertEqual([(r["features"], dict(r["attributes"])) for r in report], [([0, 1, 2], {"kind": "road"})])

    def test_what_cannot_be_done_is_refused(self):
        self.write("s.wkt", self.SQUARE)
        self.write("l.wkt", "LINESTRING (0 0, 1 1)")
        self.refuse("invalid_option", "offset", "s.wkt")
        self.refuse("invalid_option", "offset", "s.wkt", "--distance", "0")
        self.refuse("invalid_option", "offset", "s.wkt", "--distance", "1", "--step", "1")
        self.refuse("invalid_option", "offset", "s.wkt", "--step", "1", "--until", "never")
        self.refuse("unsupported", "offset", "s.wkt", "--distance", "1", "-o", "o.csv")
        self.assertNotEqual(self.run_medial("offset", "l.wkt", "--distance", "1").returncode, 0)
