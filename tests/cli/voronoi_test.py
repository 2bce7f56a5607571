"""`medial voronoi`: diagrams and nearest sites."""

import contextlib
import json
import math
import sqlite3

from support import FRAME, CommandLine, comb


class Voronoi(CommandLine):
    def test_voronoi(self):
        """Lemma 3: 2 N - 3 edges and N - 2 points; every format; with holes; arcs are refused."""
        self.write("teeth.wkt", comb(20))
        self.write("ring.wkt", FRAME)
        report = json.loads(self.succeed("voronoi", "teeth.wkt", "--method", "lee", "--json").stdout)
        elements = report["segments"] + report["reflex_vertices"]
        self.assertEqual(report["edges"], 2 * elements - 3)
        self.assertEqual(report["voronoi_points"], elements - 2)
        self.assertEqual(report["spokes"], 4 * report["reflex_vertices"] // 2)
        for name, start in (("v.json", b"{"), ("v.geojson", b"{"), ("v.svg", b"<?xml"), ("v.png", b"\x89PNG"),
                            ("v.pdf", b"%PDF")):
            self.succeed("voronoi", "teeth.wkt", "--method", "lee", "-o", name)
            self.assertTrue(self.read(name).startswith(start), name)
        stored = json.loads(self.read("v.json"))
        self.assertEqual(len(stored["items"][0]["edges"]), report["edges"])
        piped = self.succeed("voronoi", "-", "--method", "lee", "-o", "-", "--format", "geojson", given=comb(20).encode()).stdout
        kinds = {f["geometry"]["type"] for f in json.loads(piped)["features"]}
        self.assertIn("Polygon", kinds)
        report = json.loads(self.succeed("voronoi", "ring.wkt", "--method", "lee", "--json").stdout)
        self.assertEqual(report["edges"], 2 * (report["segments"] + report["reflex_vertices"]))
        self.write("half.svg", '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0H20A10 10 0 0 1 0 0Z"/></svg>')
        self.refuse("invalid_option", "voronoi", "half.svg", "--method", "lee", "--skip-invalid", "-o", "x.json")
        self.refuse("[a-z_]+", "voronoi", "teeth.wkt", "--method", "magic")

    def test_voronoi_of_pieces_a_few_roundings_apart(self):
        """The default enclosure lies outside of them, and narrower ones are refused."""
        for place in (1, 1e6):
            step = math.ulp(place)
            for width in (1, 4):
                corners = [(place, place), (place + width * step, place), (place, place + width * step)]
                triangle = ",".join(f"{x!r} {y!r}" for x, y in corners + corners[:1])
                points = ";".join(f"POINT({x!r} {y!r})" for x, y in corners)
                for pieces in (f"POLYGON(({triangle}))", points, points[:points.rindex(";")]):
                    self.write("near.wkt", pieces)
                    self.succeed("voronoi", "near.wkt", "-o", "near.json")
                    self.assertIn("passed", self.succeed("verify", "near.wkt", "near.json").stdout.decode(), pieces)
                box = [place - step, place - step, place + (width + 1) * step, place + (width + 1) * step]
                self.refuse("invalid_option", "voronoi", "near.wkt", "--enclosure", ",".join(map(repr, box)))
                self.refuse("invalid_option", "voronoi", "near.wkt", "--margin", repr(2 * step))

    def test_voronoi_of_loose_pieces(self):
        loose = b"POINT(1 3);LINESTRING(0 0,2 0,2 2);POLYGON((5 0,7 0,7 2,5 2,5 0));MULTIPOINT((4 4),(5 5))"
        report = json.loads(self.succeed("voronoi", "-", "--json", given=loose).stdout)
        self.assertEqual((report["segments"], report["points"]), (6, 10))
        made = json.loads(self.succeed("voronoi", "-", "-o", "-", given=loose).stdout)
        item = made["items"][0]
        self.assertEqual(len(item["faces"]), 16)
        self.assertEqual(item["frame"], [-3.5, -3.5, 10.5, 8.5])
        framed = self.succeed("voronoi", "-", "--enclosure", "-1,-1,9,9", "-o", "-", "--format", "geojson", given=loose)
        faces = [f for f in json.loads(framed.stdout)["features"] if f["properties"]["part"] == "face"]
        area = 0
        for face in faces:
            ring = face["geometry"]["coordinates"][0]
            area += sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:])) / 2
        self.assertAlmostEqual(area, 100, delta=0.1)
        crossing = b"LINESTRING(0 0,2 2);LINESTRING(0 2,2 0)"
        self.assertIn("feature 0, chain 0, vertex 0, crossing at (1, 1): the edge that starts at this vertex crosses the edge that "
                      "starts at vertex 0 of chain 0 of feature 1; --repair splits lines where they cross",
                      self.refuse("crossing", "voronoi", "-", given=crossing))
        report = json.loads(self.succeed("voronoi", "-", "--repair", "--json", given=crossing).stdout)
        self.assertEqual((report["segments"], report["points"]), (4, 5))
        points = json.loads(self.succeed("voronoi", "-", "--json", given=b"0 0\n1 0\n0 1\n").stdout)
        self.assertEqual((points["segments"], points["points"]), (0, 3))
        # Verified as stored; with a face without edges, where lines cross; and not once it is damaged.
        self.write("loose.wkt", loose.decode())
        self.write("outline.wkt", comb(3))
        self.write("crossing.wkt", crossing.decode())
        for name, repair in (("loose.wkt", []), ("crossing.wkt", ["--repair"])):
            self.succeed("voronoi", name, *repair, "-o", "v.json")
            verdict = json.loads(self.succeed("verify", name, "v.json", "--json", *repair).stdout)
            self.assertTrue(verdict["passed"])
            self.assertLess(verdict["largest_residual"], verdict["tolerance"])
        stored = json.loads(self.read("v.json"))
        self.assertIn([], stored["items"][0]["faces"])
        stored["items"][0]["nodes"][0][2] += 1e-6
        self.write("damaged.json", json.dumps(stored))
        done = self.run_medial("verify", "crossing.wkt", "damaged.json", "--repair")
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"FAILED", done.stdout)
        self.succeed("voronoi", "outline.wkt", "--method", "lee", "-o", "lee.json")
        self.assertIn("this diagram has no enclosure", self.refuse("unsupported", "verify", "outline.wkt", "lee.json"))
        # Neither they nor offsets hold shapes: what they are, and what reads them.
        self.succeed("offset", "outline.wkt", "--distance", "0.1", "-o", "offsets.json")
        for name, command in (("lee.json", "medial verify"), ("v.json", "medial verify"), ("offsets.json", "medial offset")):
            self.assertIn(command, self.refuse("unsupported", "info", name))
            self.assertIn(command, self.refuse("unsupported", "draw", name, "-o", "x.svg"))
        self.write("cut.json", json.dumps(stored)[:-9])
        self.refuse("malformed", "verify", "crossing.wkt", "cut.json", "--repair")

    def test_cells_name_their_features(self):
        self.write("wells.csv", "x,y,name\n0,0,a\n10,0,b\n5,8,c\n")
        self.succeed("voronoi", "wells.csv", "-o", "v.geojson")
        rows = [f["properties"] for f in json.loads(self.read("v.geojson"))["features"]]
        faces = sorted((row["feature"], row["name"], row["ring"]) for row in rows if row["part"] == "face")
        self.assertEqual(faces, [(0, "a", 0), (1, "b", 0), (2, "c", 0)])
        self.assertEqual({row["part"] for row in rows}, {"face", "edge", "enclosure"})
        self.assertEqual({row["kind"] for row in rows if row["part"] == "face"}, {"point"})
        # Between two features an edge is nobody's.
        self.assertEqual([row["feature"] for row in rows if row["part"] == "edge"], [None] * 3)
        for output in self.supported("v.gpkg"):
            self.succeed("voronoi", "wells.csv", "-o", output)
            with contextlib.closing(sqlite3.connect(self.path(output))) as table:
                self.assertEqual(sorted(table.execute("SELECT feature, name, ring FROM faces")), faces)
                kinds = table.execute("SELECT DISTINCT feature, name FROM edges WHERE kind = 'edge'")
                self.assertEqual(list(kinds), [(None, None)])
        # Rings count in their feature, and features as the input does: here one is left out.
        self.write("two.geojson", json.dumps({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {"name": name}, "geometry": shape} for name, shape in (
                ("none", {"type": "Point", "coordinates": []}),
                ("pair", {"type": "MultiLineString", "coordinates": [[[0, 0], [1, 0]], [[0, 3], [1, 3]]]}),
                ("well", {"type": "Point", "coordinates": [5, 5]}))]}))
        self.succeed("voronoi", "two.geojson", "-o", "w.geojson")
        rows = [f["properties"] for f in json.loads(self.read("w.geojson"))["features"]]
        of = {(row["feature"], row["name"], row["ring"]) for row in rows if row["part"] == "face"}
        self.assertEqual(of, {(1, "pair", 0), (1, "pair", 1), (2, "well", 0)})
        spokes = {(row["feature"], row["name"]) for row in rows if row["part"] == "spoke"}
        self.assertEqual(spokes, {(1, "pair")})

    def test_nearest_sites(self):
        """Site, feature, distance and foot point for places on the command line and in a file."""
        def feature(name, kind, coordinates):
            return {"type": "Feature", "properties": {"name": name}, "geometry": {"type": kind, "coordinates": coordinates}}
        self.write("map.geojson", json.dumps({"type": "FeatureCollection", "features": [
            feature("road", "LineString", [[0, 0], [10, 0], [10, 8]]), feature("well", "Point", [3, 4])]}))
        self.write("places.csv", "x,y\n1,1\n3,3\n")
        asked = ("voronoi", "map.geojson", "--nearest", "12,5", "--nearest=-3,-4", "--queries", "places.csv")
        rows = self.rows(self.succeed(*asked).stdout)
        self.assertEqual([row["kind"] for row in rows], ["segment", "point", "segment", "point"])
        self.assertEqual([int(row["feature"]) for row in rows], [0, 0, 0, 1])
        self.assertEqual([float(row["distance"]) for row in rows], [2, 5, 1, 1])
        self.assertEqual([(float(row["foot_x"]), float(row["foot_y"])) for row in rows], [(10, 5), (0, 0), (1, 0), (3, 4)])
        # The sites are those of the diagram.
        self.succeed("voronoi", "map.geojson", "-o", "v.json")
        sites = json.loads(self.read("v.json"))["items"][0]["sites"]
        for row in rows:
            kind = sites[int(row["site"])][0]
            self.assertEqual(kind == 1, row["kind"] == "point")
        report = json.loads(self.succeed(*asked, "--json").stdout)["nearest"]
        self.assertEqual([one["attributes"]["name"] for one in report], ["road", "road", "road", "well"])
        self.assertEqual([one["foot"] for one in report], [{"x": x, "y": y} for x, y in ((10, 5), (0, 0), (1, 0), (3, 4))])
        self.succeed(*asked, "-o", "n.json")
        self.assertEqual(json.loads(self.read("n.json"))["nearest"], report)
        self.succeed(*asked, "-o", "n.csv")
        self.assertEqual(self.rows(self.read("n.csv")), rows)
        self.refuse("invalid_option", *asked, "--method", "lee")
        self.refuse("invalid_option", *asked, "--frame", "-9,-9,20,20")
        self.refuse("unsupported", *asked, "-o", "n.svg", nothing_new=True)
        self.refuse("[a-z_]+", "voronoi", "map.geojson", "--nearest", "12")

    def test_what_touches_but_for_rounding(self):
        """Ends next to an edge or an arc, points next to points: verified, without a note."""
        self.write("near.wkt", "LINESTRING(0 0,3 1);LINESTRING(1.5 0.50000000000000011,1 2);POINT(2 2);"
                               "POINT(2.0000000000000004 2);POINT(0.30000000000000004 0.1)".replace(";", "\n"))
        self.write("arc.wkt", "CIRCULARSTRING(0 0,1 1,2 0)\nLINESTRING(1 1.0000000000001,1 3)")
        for name in ("near", "arc"):
            done = self.succeed("voronoi", name + ".wkt", "-o", "v.json")
            self.assertEqual(done.stderr, b"")
            self.assertTrue(json.loads(self.succeed("verify", name + ".wkt", "v.json", "--json").stdout)["passed"])
            done = self.succeed("offset", name + ".wkt", "--loose", "--distance", "0.5", "-o", "b.wkt")
            self.assertEqual(done.stderr, b"")
        self.write("apart.wkt", "LINESTRING(0 0,3 1)\nLINESTRING(1.5 0.5000000001,1 2)\nPOINT(2 2)\nPOINT(2.0000000001 2)")
        self.assertEqual(self.succeed("voronoi", "apart.wkt", "-o", "v.json").stderr, b"")
        self.assertTrue(json.loads(self.succeed("verify", "apart.wkt", "v.json", "--json").stdout)["passed"])
