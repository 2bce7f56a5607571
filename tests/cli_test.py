#!/usr/bin/env python3
"""Runs the command line as its users do. Takes the path of the program:

    cli_test.py PROGRAM [unittest's own arguments]
"""

import csv
import gzip
import itertools
import json
import math
import os
import re
import select
import signal
import sqlite3
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree as ElementTree

PROGRAM = os.path.abspath(sys.argv.pop(1)) if len(sys.argv) > 1 else "medial"

RECTANGLE = "POLYGON ((0 0, 4 0, 4 2, 0 2, 0 0))"
# A rectangle with a hole: one cycle, four reflex vertices.
FRAME = "POLYGON ((0 0, 9 0, 9 6, 0 6, 0 0), (3 2, 3 4, 6 4, 6 2, 3 2))"
# The same square three times, further and further to the right.
SQUARES = "\n".join(f"POLYGON (({x} 0, {x + 1} 0, {x + 1} 1, {x} 1, {x} 0))" for x in (0, 3, 6))
BOW_TIE = "POLYGON ((0 0, 2 2, 2 0, 0 2, 0 0))"

FORMATS = ["json", "geojson", "gpkg", "shp", "fgb", "wkt", "csv", "dxf", "svg", "pdf",
           "png", "ps"]

GEOGRAPHIC = json.dumps({
    "type": "FeatureCollection",
    "features": [
        {"type": "Feature", "properties": {"name": name, "rank": rank},
         "geometry": {"type": "Polygon", "coordinates": [
             [[x, 47], [x + 0.1, 47], [x + 0.1, 47.05], [x, 47.05], [x, 47]]]}}
        for name, rank, x in (("west", 1, 9.0), ("east", 2, 9.3))]})


def comb(teeth):
    """A comb with square teeth: 4 vertices a tooth."""
    points = [(0, 0), (2 * teeth - 1, 0)]
    for i in reversed(range(teeth)):
        points += [(2 * i + 1, 4), (2 * i, 4)]
        if i > 0:
            points += [(2 * i, 1), (2 * i - 1, 1)]
    points.append(points[0])
    return "POLYGON ((" + ", ".join(f"{x} {y}" for x, y in points) + "))"


def star(vertices):
    """A jagged star-shaped polygon without any symmetry."""
    points = []
    for i in range(vertices):
        angle = 2 * math.pi * i / vertices
        radius = 100 + 7 * math.sin(5 * angle) + (i * 7919 % 101) / 101
        points.append((radius * math.cos(angle), radius * math.sin(angle)))
    points.append(points[0])
    return "POLYGON ((" + ", ".join(f"{x:.17g} {y:.17g}" for x, y in points) + "))"


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def write(self, name, content):
        mode = "wb" if isinstance(content, bytes) else "w"
        with open(self.path(name), mode) as file:
            file.write(content)
        return name

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def files(self):
        return sorted(os.listdir(self.folder.name))

    def run_medial(self, *arguments, given=b""):
        """Runs in the temporary folder; a crash or a hang fails the test."""
        done = subprocess.run([PROGRAM, *map(str, arguments)], input=given, cwd=self.folder.name,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=300)
        self.assertIn(done.returncode, (0, 1, 2), (arguments, done.stderr))
        return done

    def lacks(self, what):
        """Whether the program was built without DXF, or without exact decisions."""
        if what == "DXF":
            name, content, switches, text = "probe.dxf", "", ("info",), b"without DXF"
        else:
            name, content, switches, text = "probe.wkt", RECTANGLE, ("axis", "--exact"), b"no exact decisions"
        told = self.run_medial(*switches, self.write(name, content)).stderr
        os.remove(self.path(name))
        return text in told

    def supported(self, *names):
        """Less the drawings (.dxf) where the program was built without DXF."""
        without = self.lacks("DXF")
        return [name for name in names if not (without and name.endswith(".dxf"))]

    def skip_without(self, what):
        if self.lacks(what):
            self.skipTest("built without " + what)

    def succeed(self, *arguments, given=b""):
        done = self.run_medial(*arguments, given=given)
        self.assertEqual(done.returncode, 0, (arguments, done.stderr.decode()))
        return done

    def refuse(self, code, *arguments, given=b"", nothing_new=True):
        """Expects exit status 2, one line that ends with the code, and no new file."""
        before = self.files()
        done = self.run_medial(*arguments, given=given)
        text = done.stderr.decode()
        self.assertEqual(done.returncode, 2, (arguments, text))
        self.assertEqual(text.count("\n"), 1, text)
        self.assertTrue(text.startswith("medial: "), text)
        self.assertRegex(text, rf"\[{code}\]")
        if nothing_new:
            self.assertEqual(self.files(), before)
        return text

    def rows(self, text):
        return list(csv.DictReader(text.decode().splitlines()))


class Axis(CommandLine):
    def test_every_format_is_written_and_is_what_it_claims(self):
        self.write("frame.wkt", FRAME)
        for extension in FORMATS:
            with self.subTest(extension=extension):
                if extension == "dxf":
                    self.skip_without("DXF")
                output = "out." + extension
                self.succeed("axis", "frame.wkt", "-o", output)
                content = self.read(output)
                self.assertGreater(len(content), 50)
                self.check_content(extension, content)
        leftovers = [name for name in self.files() if not name.startswith(("out.", "frame"))]
        self.assertEqual(leftovers, [])

    def check_content(self, extension, content):
        if extension in ("json", "geojson"):
            parsed = json.loads(content)
            if extension == "geojson":
                self.assertEqual(parsed["type"], "FeatureCollection")
                kinds = {f["geometry"]["type"] for f in parsed["features"]}
                self.assertIn("LineString", kinds)
        elif extension == "gpkg":
            self.assertTrue(content.startswith(b"SQLite format 3\0"))
            with sqlite3.connect(self.path("out.gpkg")) as database:
                layers = [row[0] for row in database.execute(
                    "select table_name from gpkg_contents where data_type = 'features'")]
                self.assertEqual(len(layers), 2)
                for layer in layers:
                    (rows,) = database.execute(f'select count(*) from "{layer}"').fetchone()
                    self.assertGreater(rows, 3)
            database.close()
        elif extension == "shp":
            self.assertEqual(struct.unpack(">i", content[:4])[0], 9994)
            self.assertEqual(2 * struct.unpack(">i", content[24:28])[0], len(content))
            self.assertIn("out.dbf", self.files())
        elif extension == "fgb":
            self.assertTrue(content.startswith(b"fgb"))
        elif extension == "wkt":
            self.assertRegex(content, rb"^(MULTI)?LINESTRING")
        elif extension == "csv":
            self.check_csv(content.decode())
        elif extension == "dxf":
            self.assertTrue(content.endswith(b"0\nEOF\n"))
            self.assertIn(b"\nSPLINE\n", content)
        elif extension == "svg":
            self.assertTrue(ElementTree.fromstring(content).tag.endswith("svg"))
        elif extension == "pdf":
            self.assertTrue(content.startswith(b"%PDF-"))
            self.assertIn(b"%%EOF", content[-32:])
        elif extension == "png":
            self.assertTrue(content.startswith(b"\x89PNG\r\n\x1a\n"))
            self.assertEqual(struct.unpack(">I", content[16:20])[0], 1024)
        elif extension == "ps":
            self.assertTrue(content.startswith(b"%!PS"))

    def check_csv(self, text):
        rows = list(csv.reader(text.splitlines()))
        self.assertEqual(rows[0], ["edge", "x", "y", "r"])
        edges = {}
        for edge, x, y, r in rows[1:]:
            edges.setdefault(edge, []).append((x, y, r))
            self.assertGreaterEqual(float(r), 0)
        self.assertTrue(all(len(points) >= 2 for points in edges.values()))
        return edges

    def test_a_rectangle_has_its_five_edges(self):
        self.write("rectangle.wkt", RECTANGLE)
        csv_text = self.succeed("axis", "rectangle.wkt", "-o", "-", "--format", "csv").stdout
        edges = self.check_csv(csv_text.decode())
        ends = sorted(tuple(map(float, p)) for points in edges.values()
                      for p in (points[0], points[-1]))
        expected = sorted([(0, 0, 0), (1, 1, 1), (0, 2, 0), (1, 1, 1), (4, 0, 0), (3, 1, 1),
                           (4, 2, 0), (3, 1, 1), (1, 1, 1), (3, 1, 1)])
        self.assertEqual(len(ends), 10)
        for got, wanted in zip(ends, expected):
            for a, b in zip(got, wanted):
                self.assertAlmostEqual(a, b, delta=1e-14)

    def test_nodes_are_printed_alike_and_chord_adds_rows(self):
        self.write("frame.wkt", FRAME)
        counts = []
        for chord in ("1e-2", "1e-5"):
            text = self.succeed("axis", "frame.wkt", "-o", "-", "--format", "csv", "--chord",
                                chord).stdout.decode()
            edges = self.check_csv(text)
            counts.append(sum(map(len, edges.values())))
            ends = [p for points in edges.values() for p in (points[0], points[-1])]
            exact = {p for p in ends}
            rounded = {tuple(round(float(v), 9) for v in p) for p in ends}
            self.assertEqual(len(exact), len(rounded))
        self.assertLess(counts[0], counts[1])

    def test_methods(self):
        """Both methods find the same axis; biarc-dc refuses holes, and tells which method takes them."""
        self.write("teeth.wkt", comb(20))
        self.write("ring.wkt", FRAME)
        by_disks = json.loads(self.succeed("axis", "teeth.wkt", "--json").stdout)
        published = ["axis", "teeth.wkt", "--json", "--method", "biarc-dc", "--seed", "7"]
        by_division = json.loads(self.succeed(*published, "-o", "division.json").stdout)
        for count in ("sites", "leaves", "branches"):
            if count in by_disks:
                self.assertEqual(by_division[count], by_disks[count], count)
        self.assertAlmostEqual(by_division["length"] / by_disks["length"], 1, places=12)
        written = self.succeed("info", "division.json", "--json").stdout
        self.assertEqual(json.loads(written)["method"], "biarc-dc")
        refused = self.refuse("unsupported", "axis", "ring.wkt", "--method", "biarc-dc")
        self.refuse("[a-z_]+", "axis", "teeth.wkt", "--method", "magic")

    def test_lee(self):
        """Lee's method finds the axis of disks; its diagram less the spokes is that axis."""
        self.write("teeth.wkt", comb(20))
        self.write("ring.wkt", FRAME)
        self.write("half.svg", '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0H20A10 10 0 0 1 0 0Z"/></svg>')
        self.succeed("axis", "teeth.wkt", "--method", "lee", "-o", "lee.json")
        self.succeed("verify", "teeth.wkt", "lee.json")
        by_lee = json.loads(self.succeed("info", "lee.json", "--json").stdout)
        self.succeed("axis", "teeth.wkt", "-o", "disks.json")
        by_disks = json.loads(self.succeed("info", "disks.json", "--json").stdout)
        self.assertEqual(by_lee["method"], "lee")
        self.assertEqual(by_lee["nodes"], by_disks["nodes"])
        self.assertAlmostEqual(by_lee["length"] / by_disks["length"], 1, places=12)
        self.write("convex.wkt", "POLYGON((0 0,10 0,14 5,10 9,4 8,0 6))")
        for shape, method in (("convex.wkt", "lee"), ("teeth.wkt", "disks"), ("ring.wkt", "disks"), ("half.svg", "disks")):
            self.succeed("axis", shape, "--method", "auto", "-o", "auto.json")
            self.assertEqual(json.loads(self.succeed("info", "auto.json", "--json").stdout)["method"], method)
        if not self.lacks("exact decisions"):
            self.succeed("axis", "convex.wkt", "--method", "auto", "--exact", "-o", "auto.json")
            self.assertEqual(json.loads(self.succeed("info", "auto.json", "--json").stdout)["method"], "disks")
        for shape in ("ring.wkt", "half.svg"):
            text = self.refuse("unsupported", "axis", shape, "--method", "lee", "-o", "x.json")
            self.assertIn("disks", text)

    def test_voronoi(self):
        """Lemma 3: 2 N - 3 edges and N - 2 points; every format; holes are refused."""
        self.write("teeth.wkt", comb(20))
        self.write("ring.wkt", FRAME)
        told = json.loads(self.succeed("voronoi", "teeth.wkt", "--method", "lee", "--json").stdout)
        elements = told["segments"] + told["reflex_vertices"]
        self.assertEqual(told["edges"], 2 * elements - 3)
        self.assertEqual(told["voronoi_points"], elements - 2)
        self.assertEqual(told["spokes"], 4 * told["reflex_vertices"] // 2)
        for name, start in (("v.json", b"{"), ("v.geojson", b"{"), ("v.svg", b"<?xml"), ("v.png", b"\x89PNG"),
                            ("v.pdf", b"%PDF")):
            self.succeed("voronoi", "teeth.wkt", "--method", "lee", "-o", name)
            self.assertTrue(self.read(name).startswith(start), name)
        stored = json.loads(self.read("v.json"))
        self.assertEqual(len(stored["items"][0]["edges"]), told["edges"])
        piped = self.succeed("voronoi", "-", "--method", "lee", "-o", "-", "--format", "geojson", given=comb(20).encode()).stdout
        kinds = {f["geometry"]["type"] for f in json.loads(piped)["features"]}
        self.assertIn("Polygon", kinds)
        self.refuse("unsupported", "voronoi", "ring.wkt", "--method", "lee", "-o", "x.json")
        self.refuse("[a-z_]+", "voronoi", "teeth.wkt", "--method", "magic")

    def test_voronoi_of_loose_pieces(self):
        soup = b"POINT(1 3);LINESTRING(0 0,2 0,2 2);POLYGON((5 0,7 0,7 2,5 2,5 0));MULTIPOINT((4 4),(5 5))"
        told = json.loads(self.succeed("voronoi", "-", "--json", given=soup).stdout)
        self.assertEqual((told["segments"], told["points"]), (6, 10))
        made = json.loads(self.succeed("voronoi", "-", "-o", "-", given=soup).stdout)
        item = made["items"][0]
        self.assertEqual(len(item["faces"]), 16)
        self.assertEqual(item["frame"], [-3.5, -3.5, 10.5, 8.5])
        framed = self.succeed("voronoi", "-", "--frame", "-1,-1,9,9", "-o", "-", "--format", "geojson", given=soup)
        faces = [f for f in json.loads(framed.stdout)["features"] if f["properties"]["part"] == "face"]
        area = 0
        for face in faces:
            ring = face["geometry"]["coordinates"][0]
            area += sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(ring, ring[1:])) / 2
        self.assertAlmostEqual(area, 100, delta=0.1)
        crossing = b"LINESTRING(0 0,2 2);LINESTRING(0 2,2 0)"
        self.assertIn("(1, 1)", self.refuse("crossing", "voronoi", "-", given=crossing))
        told = json.loads(self.succeed("voronoi", "-", "--repair", "--json", given=crossing).stdout)
        self.assertEqual((told["segments"], told["points"]), (4, 5))
        points = json.loads(self.succeed("voronoi", "-", "--json", given=b"0 0\n1 0\n0 1\n").stdout)
        self.assertEqual((points["segments"], points["points"]), (0, 3))
        # Verified as stored; with a face without edges, where lines cross; and not once it is spoilt.
        self.write("soup.wkt", soup.decode())
        self.write("outline.wkt", comb(3))
        self.write("crossing.wkt", crossing.decode())
        for name, repair in (("soup.wkt", []), ("crossing.wkt", ["--repair"])):
            self.succeed("voronoi", name, *repair, "-o", "v.json")
            verdict = json.loads(self.succeed("verify", name, "v.json", "--json", *repair).stdout)
            self.assertTrue(verdict["passed"])
            self.assertLess(verdict["largest_residual"], verdict["tolerance"])
        stored = json.loads(self.read("v.json"))
        self.assertIn([], stored["items"][0]["faces"])
        stored["items"][0]["nodes"][0][2] += 1e-6
        self.write("spoilt.json", json.dumps(stored))
        done = self.run_medial("verify", "crossing.wkt", "spoilt.json", "--repair")
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"FAILED", done.stdout)
        self.succeed("voronoi", "outline.wkt", "--method", "lee", "-o", "lee.json")
        self.refuse("unsupported", "verify", "outline.wkt", "lee.json")
        self.write("cut.json", json.dumps(stored)[:-9])
        self.refuse("malformed", "verify", "crossing.wkt", "cut.json", "--repair")

    def test_ridge_and_exterior(self):
        """Ridge following and the exterior, with their switches, and what verify says of them."""
        self.write("frame.wkt", FRAME)
        for rule in ("crossing", "difference"):
            told = []
            for search in ("tree", "sorted-list"):
                self.succeed("axis", "frame.wkt", "--method", "ridge", "--pixels", "60", "--ridge-rule", rule,
                             "--ridge-search", search, "--ridge-collinear", "0", "-o", search + ".json")
                told.append(self.read(search + ".json").split(b'"statistics"')[0])
            self.assertEqual(told[0], told[1])
        verdict = json.loads(self.succeed("verify", "frame.wkt", "tree.json", "--json").stdout)
        self.assertTrue(verdict["passed"])
        self.assertGreater(verdict["resolution"], 0)
        for method in ("disks", "ridge"):
            self.succeed("axis", "frame.wkt", "--exterior", "--margin", "2", "--method", method, "-o", "around.json")
            self.succeed("verify", "frame.wkt", "around.json")
        # A hole that touches its outer ring leaves one loop, but an exterior of two parts.
        self.write("touching.wkt", "POLYGON ((0 0, 10 0, 10 10, 0 10), (0 5, 3 7, 3 3))")
        self.succeed("axis", "touching.wkt", "--exterior", "-o", "around.json")
        self.succeed("verify", "touching.wkt", "around.json")
        self.refuse("invalid_option", "axis", "frame.wkt", "--method", "brushfire", "--exact")
        self.refuse("too_large", "axis", "frame.wkt", "--method", "ridge", "--resolution", "1e-9")
        self.refuse("invalid_option", "axis", "frame.wkt", "--method", "ridge", "--pixels", "9", "--resolution", "1")
        self.refuse("invalid_option", "axis", "frame.wkt", "--exterior", "--margin", "0")

    def test_nearest_sites(self):
        """Of places on the command line and in a file: site, feature, distance and foot."""
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
        told = json.loads(self.succeed(*asked, "--json").stdout)["nearest"]
        self.assertEqual([one["attributes"]["name"] for one in told], ["road", "road", "road", "well"])
        self.assertEqual([one["foot"] for one in told], [{"x": x, "y": y} for x, y in ((10, 5), (0, 0), (1, 0), (3, 4))])
        self.succeed(*asked, "-o", "n.json")
        self.assertEqual(json.loads(self.read("n.json"))["nearest"], told)
        self.succeed(*asked, "-o", "n.csv")
        self.assertEqual(self.rows(self.read("n.csv")), rows)
        self.refuse("invalid_option", *asked, "--method", "lee")
        self.refuse("invalid_option", *asked, "--frame", "-9,-9,20,20")
        self.refuse("unsupported", *asked, "-o", "n.svg", nothing_new=True)
        self.refuse("[a-z_]+", "voronoi", "map.geojson", "--nearest", "12")

    def test_what_touches_but_for_rounding(self):
        """Ends next to an edge, points next to points: they touch, which is told, and is verified."""
        self.write("near.wkt", "LINESTRING(0 0,3 1);LINESTRING(1.5 0.50000000000000011,1 2);POINT(2 2);"
                               "POINT(2.0000000000000004 2);POINT(0.30000000000000004 0.1)".replace(";", "\n"))
        done = self.succeed("voronoi", "near.wkt", "-o", "v.json")
        self.assertIn(b"rounding does not tell them apart", done.stderr)
        self.assertTrue(json.loads(self.succeed("verify", "near.wkt", "v.json", "--json").stdout)["passed"])
        self.assertIn(b"rounding", self.succeed("offset", "near.wkt", "--loose", "--distance", "0.5", "-o", "b.wkt").stderr)
        self.write("apart.wkt", "LINESTRING(0 0,3 1)\nLINESTRING(1.5 0.5000000001,1 2)\nPOINT(2 2)\nPOINT(2.0000000001 2)")
        self.assertEqual(self.succeed("voronoi", "apart.wkt", "-o", "v.json").stderr, b"")
        self.assertTrue(json.loads(self.succeed("verify", "apart.wkt", "v.json", "--json").stdout)["passed"])

    def test_exterior_of_other_verbs(self):
        """A bay 2 wide and 4 deep in a square, a hole, and the frame: measure, prune, features, carve."""
        self.write("bay.wkt", "POLYGON ((0 0, 10 0, 10 10, 6 10, 6 6, 4 6, 4 10, 0 10, 0 0), (2 2, 2 3, 5 3, 5 2, 2 2))")
        told = json.loads(self.succeed("measure", "bay.wkt", "--exterior", "--json").stdout)["features"][0]
        self.assertEqual([line["closed"] for line in told["lines"]], [False, False])
        self.assertEqual(sorted(round(line["narrowest_width"], 9) for line in told["lines"]), [1, 2])
        self.succeed("measure", "bay.wkt", "--exterior", "--margin", "3", "-o", "m.svg")
        self.refuse("[a-z_]+", "measure", "bay.wkt", "--exterior", "--disks", "2")
        self.refuse("[a-z_]+", "measure", "bay.wkt", "--margin", "2")
        plan = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data", "plan.wkt")
        self.succeed("axis", plan, "--exterior", "--method", "potential", "-o", "plan.json")
        self.succeed("verify", plan, "plan.json")
        # Of a shape, of its stored axis of the interior, and of that of the exterior: the same.
        self.succeed("axis", "bay.wkt", "-o", "inside.json")
        self.succeed("axis", "bay.wkt", "--exterior", "-o", "around.json")
        for verb, switches in (("prune", ["--by", "angle"]), ("features", [])):
            texts = []
            for source, exterior in (("bay.wkt", ["--exterior"]), ("inside.json", ["--exterior"]),
                                     ("around.json", ["--exterior"]), ("around.json", [])):
                self.succeed(verb, source, *switches, *exterior, "-o", "out.json")
                texts.append(self.read("out.json"))
            self.assertEqual(len(set(texts)), 1, verb)
            self.succeed(verb, "inside.json", *switches, "-o", "out.json")
            self.assertNotEqual(self.read("out.json"), texts[0])
        self.succeed("prune", "bay.wkt", "--exterior", "-o", "pruned.json")
        item = json.loads(self.read("pruned.json"))["items"][0]
        self.assertEqual(item["axis"]["exterior"], 5)
        self.succeed("verify", "bay.wkt", "around.json")
        # Carving around the shape reaches the frame's corners, and the hole's bottom.
        for scale in ("1", "10"):
            margin = str(2 * float(scale))
            told = json.loads(self.succeed("carve", "bay.wkt", "--angle", "90", "--exterior", "--margin", margin,
                                           "--scale", scale, "-o", "c.csv", "--json").stdout)
            self.assertGreater(told["paths"], 1)
            rows = self.rows(self.read("c.csv"))
            ends = {(float(row["x"]) / float(scale), float(row["y"]) / float(scale)) for row in rows}
            for corner in ((-2, -2), (12, 12), (2, 2), (5, 3)):
                self.assertTrue(any(math.dist(corner, end) < 1e-9 for end in ends), corner)
            # Deepest before the bay, between its corners and the frame: (12 - y)^2 = 1 + (y - 10)^2.
            self.assertAlmostEqual(min(float(row["z"]) for row in rows), -1.25 * float(scale), delta=1e-3 * float(scale))
        self.refuse("invalid_option", "carve", "bay.wkt", "--angle", "90", "--exterior", "--margin", "1e9")
        # Drawn as it is stored; by several methods; and the bay's bottom filled, the hole's corners, too.
        self.succeed("draw", "bay.wkt", "--exterior", "-o", "drawn.svg")
        self.succeed("draw", "around.json", "-o", "stored.svg")
        self.assertEqual(self.read("drawn.svg"), self.read("stored.svg"))
        told = json.loads(self.succeed("compare", "bay.wkt", "--exterior", "--methods", "disks,ridge", "-o", "both.svg",
                                       "--json").stdout)["features"][0]
        self.assertEqual([(row["passed"], row["parts"]) for row in told], [(True, 2), (True, 2)])
        self.assertLess(told[0]["radius_error"], 1e-12)
        self.assertEqual(self.run_medial("compare", "bay.wkt", "--exterior", "--methods", "curve-axis").returncode, 1)
        told = json.loads(self.succeed("smooth", "bay.wkt", "--exterior", "--significance", "0.5", "--json").stdout)
        # Four corners of the hole and two of the bay are arcs of half of their widths now.
        self.assertAlmostEqual(told["area"] - (100 - 8 - 3), (1 - math.pi / 4) * (4 * 0.25 + 2 * 1), delta=1e-6)

    def test_prune_and_rebuild(self):
        """An axis goes through a pipe: pruned, then back to a shape; all from `medial axis` on."""
        self.write("frame.wkt", FRAME)
        self.succeed("rebuild", "frame.wkt", "-o", "x.svg")
        stored = self.succeed("axis", "x.svg", "-o", "-").stdout
        pruned = self.succeed("prune", "-", "--angle", "100", "-o", "-", given=stored).stdout
        self.succeed("rebuild", "-", "-o", "y.svg", given=pruned)
        whole = json.loads(self.succeed("info", "x.svg", "--json").stdout)
        rounded = json.loads(self.succeed("info", "y.svg", "--json").stdout)
        self.assertEqual(rounded["holes"], whole["holes"])
        self.assertLess(rounded["area"], whole["area"])
        self.assertGreater(rounded["area"], 0.8 * whole["area"])
        self.assertLess(len(json.loads(pruned)["items"][0]["axis"]["edges"]),
                        len(json.loads(stored)["items"][0]["axis"]["edges"]))
        # Back again, in every format; .svg moves what it holds to its own corner.
        for name in self.supported("a.json", "a.wkt", "a.geojson", "a.dxf"):
            self.succeed("rebuild", "frame.wkt", "-o", name)
            told = json.loads(self.succeed("rebuild", name, "--against", "frame.wkt", "--json", "--quiet").stdout)
            self.assertLess(told["against"]["hausdorff"], 1e-12)
        self.succeed("prune", "frame.wkt", "--radius", "0.5", "-o", "cut.json")
        for name in self.supported("b.json", "b.wkt", "b.dxf"):  # with arcs
            self.succeed("rebuild", "cut.json", "-o", name)
            told = json.loads(self.succeed("rebuild", name, "--against", "b.json", "--json").stdout)
            self.assertLess(told["against"]["hausdorff"], 1e-9)
        told = json.loads(self.succeed("rebuild", "frame.wkt", "--tangents", "--points", "500", "--json",
                                       "--against", "frame.wkt").stdout)
        self.assertLess(told["against"]["hausdorff"], 0.1)
        self.assertGreater(told["medial_points"], 400)
        self.succeed("rebuild", "frame.wkt", "--pixels", "100", "-o", "disks.png")
        self.assertEqual(self.read("disks.png")[1:4], b"PNG")
        self.refuse("invalid_option", "rebuild", "frame.wkt", "--pixels", "100")
        self.refuse("unsupported", "rebuild", "frame.wkt", "-o", "x.shp")

    def test_prune_and_smooth_by_what_matters(self):
        """Measures, numbers of branches, tips, previews; two bumps of one size are told apart."""
        bumps = ("POLYGON((0 -4,10 -1,14 -1,24 -4,24 4,14 1,12.4 1,12.4 1.6,11.6 1.6,11.6 1,10 1,0 4,0 .4,"
                 "-.6 .4,-.6 -.4,0 -.4))")
        self.write("bumps.wkt", bumps)
        told = json.loads(self.succeed("smooth", "bumps.wkt", "--significance", "0.5", "-o", "calm.wkt",
                                       "--json").stdout)
        self.assertEqual(told["measure"], "significance")
        self.assertLess(told["branches"], told["branches_before"])
        text = self.read("calm.wkt").decode()
        self.assertIn("1.6", text)            # the bump in the waist stays
        self.assertNotIn("-0.6 0.4", text)    # the one on the broad side goes
        self.assertLess(told["against"]["area_error"], 0)
        for switch in (["--keep", "3"], ["--keep", "3", "--tips"], ["--by", "scale"], ["--lambda", "0.2"], []):
            few = json.loads(self.succeed("prune", "bumps.wkt", "--json", "-o", "few.json", *switch).stdout)
            self.assertLessEqual(few["branches"], 15)
            self.assertEqual(few["branches"], json.loads(self.succeed("info", "few.json", "--json").stdout)["branches"])
        self.succeed("prune", "bumps.wkt", "--preview", "-o", "preview.svg")
        self.assertIn(b"<svg", self.read("preview.svg"))
        self.refuse("invalid_option", "prune", "bumps.wkt", "--preview")
        self.refuse("invalid_option", "prune", "bumps.wkt", "--angle", "60", "--erosion", "1")
        self.refuse("invalid_option", "prune", "bumps.wkt", "--angle", "60", "--keep", "1")
        self.refuse("invalid_option", "prune", "bumps.wkt", "--by", "size")
        self.refuse("invalid_option", "prune", "bumps.wkt", "--angle", "-1")

    def test_specks_are_left_out(self):
        """A small hole and a small part stay with prune and smooth, and go with --specks."""
        self.write("specks.wkt", "MULTIPOLYGON(((0 0,10 0,10 6,0 6,0 0),(3 3,3.2 3,3.2 3.2,3 3),"
                                 "(6 2,8 2,8 4,6 4,6 2)),((12 3,12.2 3,12.2 3.2,12 3)))")

        def rings_of(verb, *switches):
            self.succeed(verb, "specks.wkt", "-o", "rest.json", *switches)
            told = json.loads(self.succeed("info", "rest.json", "--json").stdout)
            return told["shape"]["components"], told["shape"]["holes"]

        for verb in ("prune", "smooth"):
            self.assertEqual(rings_of(verb), (2, 2))
            self.assertEqual(rings_of(verb, "--specks"), (1, 1))
            self.assertEqual(rings_of(verb, "--specks=0.01"), (2, 2))
            self.assertEqual(rings_of(verb, "--specks=0.5"), (1, 0))
        self.succeed("axis", "specks.wkt", "-o", "stored.json")
        self.succeed("prune", "stored.json", "--specks", "-o", "rest.json")
        self.assertEqual(json.loads(self.succeed("info", "rest.json", "--json").stdout)["shape"]["holes"], 1)
        self.refuse("invalid_option", "prune", "specks.wkt", "--specks=2")

    def test_curve_axis(self):
        """One smooth curve is followed; corners are refused, and fitted on request."""
        self.write("ellipse.svg", '<svg xmlns="http://www.w3.org/2000/svg">'
                                  '<ellipse cx="20" cy="10" rx="18" ry="8"/></svg>')
        self.succeed("axis", "ellipse.svg", "--method", "curve-axis", "-o", "curve.json")
        told = json.loads(self.succeed("info", "curve.json", "--json").stdout)
        self.assertEqual(told["method"], "curve-axis")
        self.assertEqual(told["nodes"]["leaf"], 2)
        self.assertAlmostEqual(told["length"], 2 * (18 - 64 / 18), places=6)  # between the centres of curvature
        self.succeed("legal", "curve.json")
        self.write("triangle.wkt", "POLYGON((0 0,10 0,0 8))")
        text = self.refuse("unsupported", "axis", "triangle.wkt", "--method", "curve-axis", "-o", "t.json")
        self.assertIn("corner", text)
        self.succeed("axis", "triangle.wkt", "--method", "curve-axis", "--fit", "1", "-o", "t.json")
        self.assertEqual(self.run_medial("legal", "t.json").returncode, 0)

    def test_features(self):
        """A rectangle is a worm and four wedges, in every format; of axes and of shapes alike."""
        self.write("long.wkt", "POLYGON ((0 0, 8 0, 8 2, 0 2, 0 0))")
        told = json.loads(self.succeed("features", "long.wkt", "--json").stdout)
        self.assertEqual((told["ends"], told["branches"], told["runs"]), (4, 5, 5))
        self.assertAlmostEqual(told["primitives"]["worm"], 6 / (6 + 4 * math.sqrt(2)))
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

    def test_match(self):
        """The rectangle turned is the rectangle; the square is further away."""
        self.write("a.wkt", "POLYGON ((0 0, 8 0, 8 2, 0 2, 0 0))")
        os.mkdir(self.path("others"))
        self.write("others/turned.wkt", "POLYGON ((0 0, 3 0, 3 12, 0 12, 0 0))")
        self.write("others/square.wkt", "POLYGON ((0 0, 3 0, 3 3, 0 3, 0 0))")
        self.write("others/no-shape.txt", "nothing")
        told = json.loads(self.succeed("match", "a.wkt", "others", "--json").stdout)
        self.assertEqual(told["refused"], 1)
        self.assertEqual([os.path.basename(m["shape"]) for m in told["matches"]], ["turned.wkt", "square.wkt"])
        self.assertLess(told["matches"][0]["dissimilarity"], 1e-2)
        self.assertGreater(told["matches"][1]["dissimilarity"], 0.2)
        self.refuse("unreadable", "match", "a.wkt", "nowhere")

    def test_pack(self):
        """What is packed comes back within the error; damage is told."""
        self.write("frame.wkt", FRAME)
        told = json.loads(self.succeed("pack", "frame.wkt", "-o", "f.mpk", "--error", "0.001", "--compare",
                                       "--json").stdout)
        self.assertEqual(told["bytes"], os.path.getsize(self.path("f.mpk")))
        self.assertLess(told["bytes"], 200)
        self.assertGreater(told["compare"]["boundary_within_error"], 0)
        self.succeed("unpack", "f.mpk", "-o", "back.json")
        shape = json.loads(self.read("back.json"))["items"][0]["shape"]
        self.assertEqual(shape["hole"].count(True), 1)
        area = 0
        for begin, end in zip(shape["loop_begin"], shape["loop_begin"][1:]):
            loop = shape["points"][begin:end]
            area += sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(loop, loop[1:] + loop[:1])) / 2
        self.assertAlmostEqual(area, 48, delta=0.3)
        self.succeed("unpack", "f.mpk", "-o", "back.svg")
        with open(self.path("f.mpk"), "rb") as pack:
            content = pack.read()
        piped = self.succeed("pack", "frame.wkt", "-o", "-", "--error", "0.001").stdout
        self.assertEqual(piped, content)
        with open(self.path("damaged.mpk"), "wb") as pack:
            pack.write(content[:-3])
        self.refuse("malformed", "unpack", "damaged.mpk", "-o", "x.json")
        self.refuse("malformed", "unpack", "frame.wkt", "-o", "x.json")
        self.refuse("invalid_option", "pack", "frame.wkt", "-o", "x.mpk", "--error", "0")

    def test_pack_squares(self):
        """An image of three squares is three squares, without loss."""
        self.write("i.pbm", "P1\n6 3\n1 1 0 1 0 1\n1 1 0 0 0 0\n0 0 0 0 0 0\n")
        told = json.loads(self.succeed("pack", "i.pbm", "-o", "i.mpk", "--squares", "--json").stdout)
        self.assertEqual((told["squares"], told["missing_pixels"], told["pixels"]), (3, 0, 6))
        self.succeed("unpack", "i.mpk", "-o", "back.png")
        again = json.loads(self.succeed("pack", "back.png", "-o", "j.mpk", "--squares", "--json").stdout)
        self.assertEqual((again["squares"], again["pixels"]), (3, 6))

    def test_compare(self):
        """Every method that takes the input takes part, curve-axis on a smooth boundary."""
        self.write("island.wkt", "POLYGON((0 0,10 0,14 5,10 9,4 8,0 6))")
        told = json.loads(self.succeed("compare", "island.wkt", "--json").stdout)["features"][0]
        self.assertEqual([row["method"] for row in told],
                         ["disks", "biarc-dc", "lee", "ridge", "brushfire", "potential", "curve-axis"])
        self.assertIn("refused", told[-1])
        for row in told[:3]:
            self.assertTrue(row["passed"], row)
            self.assertLess(row["hausdorff"], 1e-9)
        told = json.loads(self.succeed("compare", "island.wkt", "--fit", "0.5", "--methods", "disks,curve-axis",
                                       "--arc-tolerance", "1e-9", "--json", "-o", "both.svg").stdout)["features"][0]
        self.assertEqual(told[0]["branches"], told[1]["branches"])
        self.assertLess(told[1]["largest_distance"], 1e-5)
        picture = self.read("both.svg")
        self.assertTrue(picture.startswith(b"<?xml"))
        self.assertEqual(picture.count(b"#glyph"), len("disks" + "curve-axis"))  # letters
        self.refuse("invalid_option", "compare", "island.wkt", "--methods", "magic")

    def test_compare_tells_failures_by_its_status(self):
        """A method that does not take the input fails only where it was asked for by name."""
        self.write("frame.wkt", FRAME)
        told = json.loads(self.succeed("compare", "frame.wkt", "--json").stdout)["features"][0]
        self.assertIn("refused", next(row for row in told if row["method"] == "lee"))
        self.assertEqual(self.run_medial("compare", "frame.wkt", "--methods", "disks,lee").returncode, 1)
        self.assertEqual(self.run_medial("compare", "frame.wkt", "--methods", "disks").returncode, 0)
        # Holes closer to each other than pixels are one to brushfire: a note, no failure.
        self.write("near.wkt", "POLYGON((0 0,100 0,100 60,0 60),(50 20,70 20,70 40,50 40),"
                               "(70.01 20,90 20,90 40,70.01 40))")
        told = json.loads(self.succeed("compare", "near.wkt", "--methods", "disks,ridge,brushfire",
                                       "--json").stdout)["features"][0]
        self.assertEqual([row["passed"] for row in told], [True, True, False])
        self.assertEqual([row["unresolved"] for row in told], [False, False, True])

    def test_legal(self):
        """The axis of a shape is legal; a radius that grows faster than the way is not, and is named."""
        self.write("frame.wkt", FRAME)
        self.succeed("axis", "frame.wkt", "-o", "frame.json")
        told = json.loads(self.succeed("legal", "frame.json", "--json").stdout)
        self.assertTrue(told["legal"])
        self.assertEqual(told["judged"], told["legal_branches"])
        self.assertGreater(told["judged"], 0)
        stored = json.loads(self.read("frame.json"))
        for node in stored["items"][0]["axis"]["nodes"]:
            node[2] *= 3
        for edge in stored["items"][0]["axis"]["edges"]:
            if len(edge) > 4:  # a straight edge has no control point
                edge[6] *= 3
        self.write("steep.json", json.dumps(stored))
        done = self.run_medial("legal", "steep.json")
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"too steep a radius", done.stdout)
        self.refuse("unreadable", "legal", "nothing.json")
        self.refuse("invalid_option", "legal", "frame.json", "--slack", "nan")

    def test_pipes(self):
        self.write("frame.wkt", FRAME)
        with open(self.path("frame.wkt"), "rb") as given:
            text = self.succeed("axis", "-", "-o", "-", "--format", "csv", given=given.read())
        self.check_csv(text.stdout.decode())
        text = self.succeed("axis", "-", "-o", "-", "--format", "csv",
                            given=b"0 0\n4 0\n4 2\n0 2\n").stdout.decode()
        self.assertEqual(len(self.check_csv(text)), 5)
        text = self.succeed("axis", "-", "-o", "-", "--format", "csv", "--quiet",
                            given=GEOGRAPHIC.encode()).stdout.decode()
        self.assertEqual(len(self.check_csv(text)), 10)

    def test_standard_output_takes_every_format(self):
        self.write("frame.wkt", FRAME)
        for extension in ("json", "geojson", "wkt", "csv", "svg", "pdf", "png", "ps"):
            with self.subTest(extension=extension):
                done = self.succeed("axis", "frame.wkt", "-o", "-", "--format", extension)
                self.write("out." + extension, done.stdout)
                self.check_content(extension, done.stdout)

    def test_a_closed_pipe_ends_quietly(self):
        self.write("comb.wkt", comb(3000))
        process = subprocess.Popen(
            [PROGRAM, "axis", "comb.wkt", "-o", "-", "--format", "csv", "--chord", "1e-6"],
            cwd=self.folder.name, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        process.stdout.read(10)
        process.stdout.close()
        errors = process.stderr.read()
        process.stderr.close()
        self.assertIn(process.wait(60), (0, 128 + signal.SIGPIPE))
        self.assertEqual(errors, b"")

    def test_a_full_device_is_an_error(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full here")
        self.write("frame.wkt", FRAME)
        for arguments in (["info", "frame.wkt"], ["axis", "frame.wkt", "-o", "-", "--format", "csv"],
                          ["axis", "frame.wkt", "--json"], ["axis", "--help"], ["--version"]):
            with open("/dev/full", "wb") as full:
                done = subprocess.run([PROGRAM, *arguments], cwd=self.folder.name, stdout=full,
                                      stderr=subprocess.PIPE, timeout=60)
            self.assertEqual(done.returncode, 2)
            self.assertIn(b"[unwritable]", done.stderr)

    def test_standard_error_that_takes_nothing_changes_nothing(self):
        """Full or closed: the same exit status, and no message in a file that got its number."""
        self.write("frame.wkt", FRAME)
        self.succeed("axis", "frame.wkt", "-o", "frame.json")
        for arguments, status in ((["axis", "frame.wkt", "--stats", "-o", "again.json"], 0),
                                  (["axis", "none.wkt", "-o", "again.json"], 2)):
            for where in ["2>&-"] + ["2>/dev/full"] * os.path.exists("/dev/full"):
                done = subprocess.run(["sh", "-c", f'"$0" "$@" {where}', PROGRAM, *arguments],
                                      cwd=self.folder.name, stdout=subprocess.PIPE, timeout=300)
                self.assertEqual((done.returncode, done.stdout), (status, b""), (arguments, where))
                if status == 0:
                    self.assertEqual(len(self.read("again.json")), len(self.read("frame.json")))
                    os.remove(self.path("again.json"))
            self.assertEqual(self.files(), ["frame.json", "frame.wkt"])

    def test_names_stay_in_one_line(self):
        self.assertIn("b c [31m.wkt: cannot open", self.refuse("unreadable", "info", "b\nc\x1b[31m.wkt"))

    def test_field_far_from_the_origin(self):
        """Where a sum of small steps does not grow: coordinates a unit apart, at 1e16."""
        low, high = "1e16", "10000000000000004"
        self.write("far.wkt", f"POLYGON (({low} {low}, {high} {low}, {high} {high}, {low} {high}))")
        self.succeed("field", "far.wkt", "--width", 20, "--lines", 4, "-o", "far.svg")
        self.assertIn(b"<svg", self.read("far.svg"))

    def test_a_forged_axis_takes_no_more_pixels(self):
        """Nodes far away, as no maximal disk of the shape has them."""
        self.write("frame.wkt", FRAME)
        self.succeed("axis", "frame.wkt", "-o", "frame.json")
        axis = json.loads(self.read("frame.json"))
        axis["items"][0]["axis"]["nodes"][0][0] = 1e300
        self.write("forged.json", json.dumps(axis))
        self.refuse("unsupported", "rebuild", "forged.json", "--pixels", 50, "-o", "forged.png")
        axis["items"][0]["axis"]["nodes"][0][0] = 1e50
        self.write("forged.json", json.dumps(axis))
        self.succeed("rebuild", "forged.json", "--pixels", 50, "-o", "forged.png")

    def test_a_forged_radius_takes_no_more_time(self):
        self.write("frame.wkt", FRAME)
        self.succeed("axis", "frame.wkt", "-o", "frame.json")
        axis = json.loads(self.read("frame.json"))
        axis["items"][0]["axis"]["nodes"][0][2] = 1e154
        self.write("forged.json", json.dumps(axis))
        self.succeed("draw", "forged.json", "--disks", 9, "-o", "forged.svg")

    def test_pipe_from_axis_to_shape(self):
        """medial axis x.svg -o - | medial prune - --angle 60 -o - | medial rebuild - -o y.svg"""
        self.write("x.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="90" height="50">'
                            '<path d="M 10 10 H 80 V 30 L 60 31 L 40 30 H 10 Z"/></svg>')
        axis = self.succeed("axis", "x.svg", "-o", "-").stdout
        pruned = self.succeed("prune", "-", "--angle", "60", "-o", "-", given=axis).stdout
        self.succeed("rebuild", "-", "-o", "y.svg", given=pruned)
        told = json.loads(self.succeed("rebuild", "-", "--json", given=pruned).stdout)
        again = json.loads(self.succeed("rebuild", "y.svg", "--json").stdout)
        self.assertAlmostEqual(told["area"], again["area"], delta=1e-6 * told["area"])
        self.assertEqual(told["vertices"], again["vertices"])
        # What 60 degrees keep: the corners, but not the vertex of nearly 180 that bulges out.
        area = json.loads(self.succeed("rebuild", "x.svg", "--json").stdout)["area"]
        self.assertLess(told["area"], area)
        self.assertGreater(told["area"], 0.99 * area)
        self.assertLess(len(json.loads(pruned)["items"][0]["axis"]["edges"]),
                        len(json.loads(axis)["items"][0]["axis"]["edges"]))

    def test_unpacked_axes_keep_the_error(self):
        self.write("plan.wkt", "POLYGON ((0 0, 30 0, 30 12, 22 12, 22 20, 14 20, 14 12, 0 9, 0 0),"
                               "(4 3, 4 6, 9 6, 9 3, 4 3))")
        for error in ("0.03", "0.003", "0.0001"):
            told = json.loads(self.succeed("pack", "plan.wkt", "-o", "p.mpk", "--error", error,
                                           "--json").stdout)
            self.succeed("unpack", "p.mpk", "-o", "u.json")
            again = json.loads(self.succeed("rebuild", "u.json", "--against", "plan.wkt",
                                            "--json").stdout)
            self.assertLessEqual(again["against"]["hausdorff"], told["error"])

    def test_many_features_keep_order_and_attributes(self):
        self.write("places.geojson", GEOGRAPHIC)
        self.succeed("axis", "places.geojson", "-o", "axes.geojson")
        features = json.loads(self.read("axes.geojson"))["features"]
        lines = [f for f in features if f["geometry"]["type"] == "LineString"]
        self.assertEqual(len(lines), 10)
        names = [f["properties"]["name"] for f in lines]
        self.assertEqual(names, ["west"] * 5 + ["east"] * 5)

    def test_where_and_layer_select(self):
        self.write("places.geojson", GEOGRAPHIC)
        line = self.succeed("axis", "places.geojson", "--where", "rank > 1", "--json").stdout
        self.assertEqual(json.loads(line)["features"], 1)
        self.refuse("[a-z_]+", "axis", "places.geojson", "--layer", "nowhere")
        self.refuse("[a-z_]+", "axis", "places.geojson", "--where", "rank >")

    def test_geographic_coordinates_are_warned_about_once(self):
        self.write("places.geojson", GEOGRAPHIC)
        warned = self.succeed("axis", "places.geojson", "-o", "a.csv").stderr.decode()
        self.assertEqual(warned.count("warning"), 1)
        self.assertIn("--project", warned)
        self.assertEqual(
            self.succeed("axis", "places.geojson", "-o", "a.csv", "--quiet").stderr, b"")
        projected = self.succeed("axis", "places.geojson", "-o", "p.geojson", "--project", "--json")
        self.assertNotIn("warning", projected.stderr.decode())
        # 0.05 degrees of latitude are 5.56 km: half of it is the largest radius.
        self.assertAlmostEqual(json.loads(projected.stdout)["deepest"]["radius"], 2780, delta=10)
        # Back in longitudes and latitudes, in text as well; radii stay in metres.
        self.succeed("axis", "places.geojson", "-o", "p.csv", "--project")
        rows = list(csv.DictReader(self.read("p.csv").decode().splitlines()))
        for row in rows:
            self.assertTrue(8.99 < float(row["x"]) < 9.41 and 46.99 < float(row["y"]) < 47.06, row)
        self.assertAlmostEqual(max(float(row["r"]) for row in rows), 2780, delta=10)
        self.succeed("axis", "places.geojson", "-o", "p.json", "--project")
        self.write("wells.geojson", json.dumps({"type": "MultiPoint", "coordinates": [[9, 47], [9.1, 47.1]]}))
        for verb, source, output in (
                ("axis", "places.geojson", "q.wkt"), ("rebuild", "p.json", "r.geojson"),
                ("rebuild", "p.json", "r.wkt"), ("voronoi", "wells.geojson", "v.geojson"),
                ("voronoi", "places.geojson", "v.wkt"), ("voronoi", "places.geojson", "v.csv"),
                ("features", "p.json", "f.csv"), ("measure", "places.geojson", "m.csv"),
                ("offset", "places.geojson", "o.wkt"), ("offset", "places.geojson", "o.geojson")):
            more = [] if source == "p.json" else ["--project"]
            more += ["--distance", "100"] if verb == "offset" else []
            more += ["--margin", "50"] if verb == "voronoi" else []
            self.succeed(verb, source, "-o", output, *more)
            text = self.read(output).decode()
            if output.endswith(".csv"):
                rows = list(csv.DictReader(text.splitlines()))
                names = [name for name in rows[0] if name[0] in "xy" or name.endswith(("_x", "_y"))]
                places = [(float(row[x]), float(row[y])) for row in rows
                          for x, y in zip(names[::2], names[1::2])]
            else:
                number = r"(-?[0-9][-+.0-9e]*)"
                between = r"\[%s,%s\]" if output.endswith(".geojson") else "%s %s"
                places = [(float(x), float(y))
                          for x, y in re.findall(between % (number, number), text)]
            self.assertGreater(len(places), 3, output)
            for x, y in places:
                self.assertTrue(8.9 < x < 9.5 and 46.9 < y < 47.2, (output, x, y))
        # Back in longitudes and latitudes.
        for feature in json.loads(self.read("p.geojson"))["features"]:
            if feature["geometry"]["type"] == "LineString":
                for x, y, *_ in feature["geometry"]["coordinates"]:
                    self.assertTrue(8.99 < x < 9.41 and 46.99 < y < 47.06, (x, y))

    def test_without_output_a_summary_is_printed(self):
        self.write("rectangle.wkt", RECTANGLE)
        text = self.succeed("axis", "rectangle.wkt").stdout.decode()
        self.assertRegex(text, r"^rectangle.wkt: 1 feature, 4 sites, 6 nodes, 5 edges, 5 branches; "
                               r"deepest disk: radius 1 at \([13], 1\); [^\n]+ s\n$")

    def test_quiet_unless_a_terminal(self):
        self.write("rectangle.wkt", RECTANGLE)
        done = self.succeed("axis", "rectangle.wkt", "-o", "a.json")
        self.assertEqual((done.stdout, done.stderr), (b"", b""))

    def test_stats_as_one_object(self):
        self.write("frame.wkt", FRAME)
        done = self.succeed("axis", "frame.wkt", "-o", "a.csv", "--stats", "--json", "--threads", 2)
        stats = json.loads(done.stdout)
        self.assertEqual(done.stderr, b"")
        for step in ("read", "shape", "axis", "write"):
            self.assertGreaterEqual(stats["seconds"][step], 0)
        self.assertEqual(stats["sites"], 12)
        self.assertEqual(stats["threads"], 2)
        self.assertEqual(stats["nodes"], stats["edges"])  # one cycle
        self.assertGreater(stats["branches"], 4)
        self.assertGreater(stats["queries_per_site"], 0)
        self.assertGreaterEqual(stats["precision_retries"], 0)
        self.assertGreater(stats["peak_bytes"], 1_000_000)
        self.assertEqual(stats["cleaned"]["closing_points"], 2)
        self.assertEqual(set(stats["phases"]), {"sites", "tree", "connect", "walk", "collect", "exact"})

    def test_stats_as_a_table(self):
        self.write("frame.wkt", FRAME)
        done = self.succeed("axis", "frame.wkt", "-o", "-", "--format", "csv", "--stats")
        self.check_csv(done.stdout.decode())
        for word in ("read", "walk", "queries per site", "precision retries", "peak bytes"):
            self.assertIn(word, done.stderr.decode())

    def test_the_same_bytes_for_any_number_of_threads(self):
        self.write("star.wkt", star(2000) + "\n" + FRAME + "\n" + SQUARES + "\n" + comb(200))
        for extension in ("json", "csv", "svg", "geojson"):
            outputs = set()
            for threads in (1, 2, 8):
                # One name for all: some formats name their layer by it.
                self.succeed("axis", "star.wkt", "-o", "o." + extension, "--threads", threads)
                outputs.add(self.read("o." + extension))
            self.assertEqual(len(outputs), 1, extension)

    def test_repair(self):
        self.write("bow.wkt", BOW_TIE)
        for switch in ("--repair", "--repair=make-valid", "--repair=even-odd", "--repair=non-zero"):
            done = self.succeed("axis", switch, "bow.wkt", "--json")
            self.assertGreater(json.loads(done.stdout)["nodes"], 5)
            self.assertIn(b"note", done.stderr)
            self.assertEqual(self.succeed("axis", switch, "bow.wkt", "--quiet").stderr, b"")

    def test_the_native_format_is_an_input_too(self):
        self.write("shapes.wkt", FRAME + "\n" + SQUARES)
        self.succeed("axis", "shapes.wkt", "-o", "a.json")
        self.succeed("axis", "a.json", "-o", "b.json")
        self.assertEqual(self.read("a.json"), self.read("b.json"))

    def test_curves_of_every_kind_of_file(self):
        stadium = (
            '{"medial":2,"items":[{"contours":[{"start":[0,0],"pieces":'
            '[["line",4,0],["arc",4,2,1],["line",0,2],["arc",0,0,1]]}]}]}'
        )
        self.write("a.json", stadium)
        self.write("a.svg", '<svg><rect width="6" height="2" rx="1" id="r"/></svg>')
        drawing = "0 SECTION 2 ENTITIES 0 LWPOLYLINE 8 A 90 4 70 1 10 0 20 0 10 4 20 0 42 1 "
        drawing += "10 4 20 2 10 0 20 2 42 1 0 ENDSEC 0 EOF"
        self.write("a.dxf", drawing.replace(" ", "\n") + "\n")
        self.write(
            "a.wkt",
            "CURVEPOLYGON(COMPOUNDCURVE((0 0,4 0),CIRCULARSTRING(4 0,5 1,4 2),(4 2,0 2),"
            "CIRCULARSTRING(0 2,-1 1,0 0)))",
        )
        for name in self.supported("a.json", "a.svg", "a.dxf", "a.wkt"):
            told = json.loads(self.succeed("axis", name, "--json").stdout)
            self.assertEqual(told["features"], 1, name)
            self.assertAlmostEqual(told["deepest"]["radius"], 1, 12, name)
            self.assertAlmostEqual(told["length"], 4, 9, name)
        told = json.loads(self.succeed("info", "--json", "a.svg").stdout)
        self.assertEqual(told["arcs"]["pieces"], 8)
        self.assertAlmostEqual(told["area"], 8 + math.pi, 12)

    def test_switches_of_curves(self):
        self.write("ellipse.svg", '<svg><ellipse rx="4" ry="2"/></svg>')
        few = json.loads(self.succeed("info", "--json", "ellipse.svg", "--arc-tolerance", "1e-2").stdout)
        many = json.loads(self.succeed("info", "--json", "ellipse.svg").stdout)
        self.assertLess(few["arcs"]["arcs"], many["arcs"]["arcs"])
        absolute = json.loads(
            self.succeed("info", "--json", "ellipse.svg", "--arc-tolerance-absolute", "0.25").stdout
        )
        self.assertEqual(absolute["arcs"]["tolerance"], 0.25)
        for wrong in ("0", "nan", "2", "x"):
            self.refuse("invalid_option", "info", "ellipse.svg", "--arc-tolerance", wrong)
        self.refuse("invalid_option", "info", "ellipse.svg", "--close")
        self.write("moons.svg", '<svg><path d="M0 5a5 5 0 1 1 10 0a5 5 0 1 1-10 0zM6 5a5 5 0 1 1 10 0'
                   'a5 5 0 1 1-10 0z"/></svg>')
        self.refuse("crossing", "info", "moons.svg")
        for rule, parts in (("--repair", 1), ("--repair=non-zero", 1), ("--repair=even-odd", 2)):
            mended = self.succeed("info", rule, "moons.svg", "--json")
            self.assertEqual(json.loads(mended.stdout)["components"], parts, rule)
            self.assertIn(b"cross in 2 places", mended.stderr)

    def test_switches_of_drawings(self):
        self.skip_without("DXF")
        lines = "0 SECTION 2 ENTITIES 0 LINE 8 A 10 0 20 0 11 4 21 0 0 LINE 8 A 10 4 20 0 11 4 21 3 "
        lines += "0 LINE 8 A 10 4 20 3 11 0 21 0.1 0 ENDSEC 0 EOF"
        self.write("open.dxf", lines.replace(" ", "\n") + "\n")
        self.refuse("empty", "info", "open.dxf")
        self.succeed("info", "open.dxf", "--close")
        self.succeed("info", "open.dxf", "--close=0.2")
        self.refuse("empty", "info", "open.dxf", "--close=0.05")
        self.refuse("invalid_option", "info", "open.dxf", "--close=-1")
        self.refuse("invalid_option", "info", "open.dxf", "--layer", "B")

    def test_texts(self):
        font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"
        if not os.path.exists(font):
            self.skipTest(font + " is not here")
        self.succeed("axis", "--text", "il", "--font", font, "-o", "a.json")
        self.succeed("verify", "--text", "il", "--font", font, "a.json")
        self.refuse("invalid_option", "axis", "--text", "i")
        self.refuse("invalid_option", "axis", "--font", font)
        self.refuse("invalid_option", "axis")
        self.refuse("invalid_option", "axis", "a.wkt", "--text", "i", "--font", font)
        self.refuse("unreadable", "axis", "--text", "i", "--font", "missing.ttf")

    def test_drawings_have_the_radius_as_z_on_request(self):
        self.skip_without("DXF")
        self.write("a.wkt", RECTANGLE)
        self.succeed("axis", "a.wkt", "-o", "a.dxf")
        self.assertIn("LWPOLYLINE", self.read("a.dxf").decode())
        self.succeed("axis", "a.wkt", "-o", "b.dxf", "--radius-as-z")
        self.assertNotIn("LWPOLYLINE", self.read("b.dxf").decode())

    def test_touching_rings(self):
        self.write("touch.wkt",
                   "POLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (0 4, 2 3, 2 5, 0 4))\n"
                   "POLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (2 2, 4 4, 4 2, 2 2), (4 4, 6 6, 4 6, 4 4))")
        self.succeed("axis", "touch.wkt", "-o", "touch.json")
        self.succeed("verify", "touch.wkt", "touch.json")
        self.succeed("axis", "touch.json", "-o", "again.json")
        self.succeed("verify", "touch.wkt", "again.json")

    def test_compressed_and_large_text(self):
        self.write("comb.wkt.gz", gzip.compress(comb(20000).encode()))
        done = self.succeed("axis", "comb.wkt.gz", "-o", "comb.csv", "--json")
        self.assertEqual(json.loads(done.stdout)["features"], 1)
        # One edge and more for every tooth, each with two rows or more.
        self.assertGreater(self.read("comb.csv").count(b"\n"), 80000)


BOX = "".join(f"v {x} {y} {z}\n" for z in (0, 2) for y in (0, 3) for x in (0, 4)) + "".join(
    f"f {a} {b} {c}\n" for a, b, c in (
        (1, 3, 2), (2, 3, 4), (5, 6, 7), (6, 8, 7), (1, 2, 5), (2, 6, 5),
        (3, 7, 4), (4, 7, 8), (1, 5, 3), (3, 5, 7), (2, 4, 6), (4, 8, 6)))


class Voxels(CommandLine):
    def setUp(self):
        super().setUp()
        if b"without Assimp" in self.run_medial("voxels", self.write("box.obj", BOX)).stderr:
            self.skipTest("built without Assimp")

    def test_every_format_is_written_alike_by_any_number_of_threads(self):
        for name in ("a.ply", "a.vtk", "a.obj", "a.png"):
            self.succeed("voxels", "box.obj", "-o", name, "--voxels", 24, "--threads", 1)
            first = self.read(name)
            self.succeed("voxels", "box.obj", "-o", name, "--voxels", 24, "--threads", 3)
            self.assertEqual(self.read(name), first)
            self.succeed("voxels", "box.obj", "-o", name, "--voxels", 24, "--search", "sorted-list")
            self.assertEqual(self.read(name), first)
            pipe = self.succeed("voxels", "box.obj", "-o", "-", "--format", name[2:], "--voxels", 24)
            self.assertEqual(pipe.stdout, first)

    def test_summary(self):
        told = json.loads(self.succeed("voxels", "box.obj", "--resolution", 0.125, "--json",
                                       "--stats").stdout)
        self.assertEqual(told["cells"], [36, 28, 20])
        self.assertEqual(told["topology"]["axis"],
                         {"components": 1, "tunnels": 0, "cavities": 0})
        self.assertAlmostEqual(told["deepest"]["radius"], 1, delta=0.125)
        self.assertGreater(told["tested_voxels"], told["voxels"])

    def test_what_cannot_be_done_is_refused(self):
        self.write("open.obj", BOX[:BOX.rindex("f ")])
        text = self.refuse("open_surface", "voxels", "open.obj", "-o", "a.ply")
        self.assertIn("face 10 at (4, 1.5, 1)", text)
        self.write("two.obj", BOX + "".join(
            line.replace("v 0", "v 1") + "\n" if line[0] == "v" else
            "f " + " ".join(str(int(n) + 8) for n in line.split()[1:]) + "\n"
            for line in BOX.splitlines()))
        self.refuse("non_manifold", "voxels", "two.obj", "-o", "a.ply")
        self.refuse("too_large", "voxels", "box.obj", "-o", "a.ply", "--resolution", 1e-5)
        self.refuse("too_large", "voxels", "box.obj", "--voxels", 4000, "--memory", 0.01)
        self.refuse("invalid_option", "voxels", "box.obj", "--voxels", 2)
        self.refuse("unsupported", "voxels", "box.obj", "-o", "a.svg")
        self.refuse("unsupported", "voxels", self.write("box.wkt", RECTANGLE))
        self.refuse("malformed", "voxels", self.write("no.ply", "plywood"))
        self.refuse("unreadable", "voxels", "missing.stl")


class Verify(CommandLine):
    def setUp(self):
        super().setUp()
        self.write("shapes.wkt", FRAME + "\n" + SQUARES)
        self.succeed("axis", "shapes.wkt", "-o", "axes.json")

    def test_exact_axes(self):
        self.skip_without("exact decisions")
        self.write("shapes.wkt", FRAME + "\n" + RECTANGLE)
        self.write("round.svg", '<svg><ellipse rx="4" ry="2"/><rect width="6" height="2" rx="1"/></svg>')
        for shapes in ("shapes.wkt", "round.svg"):
            self.succeed("axis", "--exact", shapes, "-o", "exact.json")
            told = json.loads(self.succeed("verify", shapes, "exact.json", "--json").stdout)
            self.assertTrue(told["passed"])

    def test_a_computed_axis_passes(self):
        done = self.succeed("verify", "shapes.wkt", "axes.json")
        self.assertIn("passed", done.stdout.decode())
        verdict = json.loads(self.succeed("verify", "shapes.wkt", "axes.json", "--json").stdout)
        self.assertTrue(verdict["passed"])
        self.assertEqual(verdict["features"], 4)
        self.assertEqual((verdict["holes"], verdict["cycles"]), (1, 1))
        self.assertLess(verdict["largest_residual"], 1e-12)
        self.assertAlmostEqual(verdict["shape_area"], 9 * 6 - 3 * 2 + 3, delta=1e-9)
        self.assertEqual(len(verdict["certificates"]), 4)

    def test_the_axis_of_another_shape_is_refused(self):
        self.write("moved.wkt", FRAME.replace("3 4, 6 4", "3 5, 6 4") + "\n" + SQUARES)
        done = self.run_medial("verify", "moved.wkt", "axes.json")
        self.assertEqual(done.returncode, 1)
        self.assertIn("FAILED", done.stdout.decode())
        done = self.run_medial("verify", "moved.wkt", "axes.json", "--json")
        self.assertEqual(done.returncode, 1)
        verdict = json.loads(done.stdout)
        self.assertFalse(verdict["passed"])
        self.assertGreater(len(verdict["failures"]), 0)
        self.assertFalse(verdict["certificates"][0]["passed"])
        self.assertTrue(verdict["certificates"][1]["passed"])

    def test_errors(self):
        self.write("one.wkt", FRAME)
        self.refuse("malformed", "verify", "one.wkt", "axes.json")
        self.refuse("[a-z_]+", "verify", "shapes.wkt", "shapes.wkt")
        self.refuse("unreadable", "verify", "shapes.wkt", "none.json")
        self.refuse("unreadable", "verify", "none.wkt", "axes.json")
        self.refuse("invalid_option", "verify", "-", "-")

    def test_a_damaged_file_is_refused(self):
        content = self.read("axes.json")
        for share in (0.1, 0.5, 0.9, 0.999):
            self.write("cut.json", content[:int(share * len(content))])
            self.refuse("(malformed|unsupported|unreadable)", "verify", "shapes.wkt", "cut.json")
        # Any number replaced by one far out of range must be told, never followed.
        numbers = list(re.finditer(rb"(?<=[\[,:])\d+(?=[\],}])", content))
        verbs = itertools.cycle((["verify", "shapes.wkt", "damaged.json"], ["info", "damaged.json"],
                                 ["draw", "damaged.json", "-o", "-", "--format", "svg"],
                                 ["axis", "damaged.json"]))
        for match, verb in zip(numbers[::max(1, len(numbers) // 60)], verbs):
            damaged = content[:match.start()] + b"4000000000" + content[match.end():]
            self.write("damaged.json", damaged)
            self.run_medial(*verb)


class Costs(CommandLine):
    def test_every_verb_tells_them(self):
        self.write("elbow.wkt", "POLYGON ((0 0, 8 0, 8 3, 3 3, 3 8, 0 8))")
        for verb, *switches in (("info",), ("voronoi",), ("compare", "--methods", "disks"),
                                ("field", "-o", "field.PNG", "--width", "60", "--lines", "2")):
            told = json.loads(self.succeed(verb, "elbow.wkt", *switches, "--stats", "--json").stdout)
            self.assertGreater(told["peak_bytes"], 0)
            self.assertGreater(told["threads"], 0)
            self.assertIn("read", told["seconds"])
            self.assertIn(b"peak bytes", self.succeed(verb, "elbow.wkt", *switches, "--stats").stderr)
        self.assertTrue(self.read("field.PNG").startswith(b"\x89PNG"))

    def test_a_field_is_drawn_in_every_format(self):
        self.write("elbow.wkt", "POLYGON ((0 0, 8 0, 8 3, 3 3, 3 8, 0 8))")
        for suffix, begin in (("svg", b"<?xml"), ("pdf", b"%PDF"), ("ps", b"%!PS"), ("png", b"\x89PNG")):
            self.succeed("field", "elbow.wkt", "-o", "field." + suffix, "--width", "60", "--lines", "2")
            self.assertTrue(self.read("field." + suffix).startswith(begin))
        # Lines only: no image of pixels inside; without either, the outline alone.
        self.succeed("field", "elbow.wkt", "-o", "lines.svg", "--lines", "4", "--no-brightness")
        self.assertNotIn(b"<image", self.read("lines.svg"))
        self.succeed("field", "elbow.wkt", "-o", "bare.svg", "--lines", "0", "--no-brightness")
        self.assertLess(self.read("bare.svg").count(b"<path"), self.read("lines.svg").count(b"<path"))


class Info(CommandLine):
    def test_polygons(self):
        self.write("frame.wkt", FRAME.replace("9 0,", "9 0, 9 0, 9 3,"))
        told = json.loads(self.succeed("info", "frame.wkt", "--json").stdout)
        self.assertEqual(told["kind"], "polygons")
        self.assertEqual((told["features"], told["rings"], told["holes"]), (1, 2, 1))
        self.assertEqual(told["vertices"], 8)
        self.assertEqual(told["extent"], [0, 0, 9, 6])
        self.assertEqual(told["area"], 48)
        self.assertEqual(told["cleaned"]["repeated_points"], 1)
        self.assertEqual(told["cleaned"]["collinear_points"], 1)
        text = self.succeed("info", "frame.wkt").stdout.decode()
        for word in ("features", "holes", "vertices", "extent", "1 repeated point", "valid"):
            self.assertIn(word, text)

    def test_coordinate_system(self):
        self.write("places.geojson", GEOGRAPHIC)
        told = json.loads(self.succeed("info", "places.geojson", "--json").stdout)
        self.assertTrue(told["geographic"])
        self.assertIn("84", told["crs"])

    def test_an_axis(self):
        self.write("rectangle.wkt", RECTANGLE)
        self.succeed("axis", "rectangle.wkt", "-o", "a.json")
        told = json.loads(self.succeed("info", "a.json", "--json").stdout)
        self.assertEqual(told["kind"], "axis")
        self.assertEqual(told["nodes"], {"leaf": 4, "site_change": 0, "branching": 2})
        self.assertEqual((told["edges"], told["branches"]), (5, 5))
        self.assertAlmostEqual(told["length"], 4 * math.sqrt(2) + 2, delta=1e-12)
        self.assertAlmostEqual(told["deepest"]["radius"], 1, delta=1e-14)
        self.assertEqual(told["method"], "disks")
        self.assertGreater(told["tolerance"], 0)
        text = self.succeed("info", "a.json").stdout.decode()
        for word in ("4 leaves", "2 branchings", "deepest disk", "disks", "tolerance", "length"):
            self.assertIn(word, text)

    def test_branches_are_counted_as_they_are_written(self):
        self.write("shapes.wkt", FRAME + "\n" + comb(30) + "\n" + star(100))
        self.succeed("axis", "shapes.wkt", "-o", "a.json")
        self.succeed("axis", "shapes.wkt", "-o", "a.geojson")
        told = json.loads(self.succeed("info", "a.json", "--json").stdout)
        features = json.loads(self.read("a.geojson"))["features"]
        lines = [f for f in features if f["geometry"]["type"] == "LineString"]
        self.assertEqual(told["branches"], len(lines))

    def test_an_axis_from_a_pipe(self):
        self.write("rectangle.wkt", RECTANGLE)
        stored = self.succeed("axis", "rectangle.wkt", "-o", "-", "--format", "json").stdout
        told = json.loads(self.succeed("info", "-", "--json", given=stored).stdout)
        self.assertEqual(told["kind"], "axis")

    def test_invalid_polygons(self):
        self.write("bow.wkt", BOW_TIE)
        self.refuse("crossing", "info", "bow.wkt")


class Draw(CommandLine):
    def test_polygons_and_stored_axes(self):
        self.write("frame.wkt", FRAME)
        self.succeed("axis", "frame.wkt", "-o", "a.json")
        for extension in ("svg", "pdf", "png", "ps"):
            self.succeed("draw", "frame.wkt", "-o", "p." + extension)
            self.succeed("draw", "a.json", "-o", "s." + extension)
            self.assertGreater(len(self.read("p." + extension)), 500)
            self.assertGreater(len(self.read("s." + extension)), 500)
        self.assertEqual(self.read("p.svg"), self.read("s.svg"))
        self.assertEqual(self.read("p.png"), self.read("s.png"))

    def test_options_change_the_picture(self):
        self.write("frame.wkt", FRAME)
        pictures = set()
        for options in ([], ["--disks", 20], ["--contacts"], ["--nodes"], ["--no-shape"],
                        ["--width", 300]):
            self.succeed("draw", "frame.wkt", "-o", "p.svg", *options)
            pictures.add(self.read("p.svg"))
        self.assertEqual(len(pictures), 6)
        self.succeed("draw", "frame.wkt", "-o", "p.png", "--width", 300)
        self.assertEqual(struct.unpack(">I", self.read("p.png")[16:20])[0], 300)

    def test_only_pictures(self):
        self.write("frame.wkt", FRAME)
        self.refuse("unsupported", "draw", "frame.wkt", "-o", "p.csv")
        self.refuse("invalid_option", "draw", "frame.wkt")
        self.refuse("invalid_option", "draw", "frame.wkt", "-o", "")


class Errors(CommandLine):
    def test_inputs(self):
        whole = gzip.compress(FRAME.encode() * 50)
        cases = [
            ("not_finite", "nan.wkt", "POLYGON ((0 0, 1 nan, 1 1, 0 0))"),
            ("not_finite", "infinite.txt", "0 0\n1 1e999\n1 1\n"),
            ("crossing", "bow.wkt", BOW_TIE),
            ("hole_outside", "hole.wkt",
             "POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0), (5 5, 6 5, 6 6, 5 5))"),
            ("too_few_points", "two.wkt", "POLYGON ((0 0, 1 1, 0 0))"),
            ("too_few_points", "two.txt", "0 0\n1 1\n"),
            ("no_area", "flat.wkt", "POLYGON ((0 0, 1 0, 2 0, 0 0))"),
            ("overlap", "overlap.wkt",
             "MULTIPOLYGON (((0 0, 2 0, 2 2, 0 2, 0 0)), ((2 0, 4 0, 4 2, 2 2, 2 0)))"),
            ("(malformed|unreadable)", "cut.wkt.gz", whole[:len(whole) // 2]),
            ("(malformed|unreadable)", "noise.wkt.gz", b"\x1f\x8b" + bytes(range(256))),
            ("malformed", "cut.wkt", FRAME[:-20]),
            ("[a-z_]+", "empty.wkt", ""),
            ("[a-z_]+", "empty.geojson", ""),
            ("[a-z_]+", "empty.json", ""),
            ("[a-z_]+", "point.wkt", "POINT (1 1)"),
            ("[a-z_]+", "noise.bin", bytes(range(256)) * 9),
            ("[a-z_]+", "noise.shp", bytes(range(256)) * 9),
            ("[a-z_]+", "noise.json", b'{"medial": '),
        ]
        for code, name, content in cases:
            with self.subTest(name=name):
                self.write(name, content)
                text = self.refuse(code, "axis", name, "-o", "out.json")
                self.assertIn(name, text)
                self.refuse(code, "info", name)
                self.refuse(code, "draw", name, "-o", "out.svg")

    def test_missing_file_and_directory(self):
        os.mkdir(self.path("folder"))
        self.assertIn("none.wkt", self.refuse("unreadable", "axis", "none.wkt", "-o", "out.json"))
        self.assertIn("none.geojson",
                      self.refuse("unreadable", "axis", "none.geojson", "-o", "out.json"))
        self.refuse("(unreadable|unsupported)", "axis", "folder", "-o", "out.json")
        self.refuse("[a-z_]+", "axis", "/dev/null", "-o", "out.json")

    def test_the_place_is_named(self):
        self.write("bad.wkt", SQUARES + "\n" + BOW_TIE)
        text = self.refuse("crossing", "axis", "bad.wkt", "-o", "out.json")
        self.assertRegex(text, r"^medial: bad.wkt: feature 3, ring 0, .*\(1, 1\)")
        done = self.run_medial("axis", "bad.wkt", "-o", "out.json", "--json")
        error = json.loads(done.stdout)["error"]
        self.assertEqual(error["code"], "crossing")
        self.assertEqual(error["place"]["file"], "bad.wkt")
        self.assertEqual(error["place"]["feature"], 3)
        self.assertEqual((error["place"]["x"], error["place"]["y"]), (1, 1))
        self.assertTrue(error["text"])

    def test_the_first_of_many_errors_is_told(self):
        self.write("bad.wkt", "\n".join([SQUARES] * 20 + [BOW_TIE] * 50))
        for threads in (1, 2, 8):
            self.assertIn("feature 60", self.refuse("crossing", "info", "bad.wkt", "--threads", threads))

    def test_outputs(self):
        self.write("frame.wkt", FRAME)
        os.mkdir(self.path("folder.csv"))
        self.refuse("unsupported", "axis", "frame.wkt", "-o", "out.xyz")
        self.refuse("unsupported", "axis", "frame.wkt", "-o", "out")
        self.refuse("unsupported", "axis", "frame.wkt", "-o", "-", "--format", "xyz")
        self.refuse("invalid_option", "draw", "frame.wkt", "-o", "-")
        self.refuse("invalid_option", "axis", "frame.wkt", "-o", "out.csv", "--format", "csv")
        self.refuse("invalid_option", "axis", "frame.wkt", "-o", "-", "--format", "csv", "--json")
        self.refuse("unwritable", "axis", "frame.wkt", "-o", "none/out.csv")
        self.refuse("unwritable", "axis", "frame.wkt", "-o", "folder.csv")
        self.refuse("unwritable", "axis", "frame.wkt", "-o", "frame.wkt")
        self.assertEqual(self.read("frame.wkt").decode(), FRAME)
        self.refuse("unwritable", "axis", "frame.wkt", "-o", "/proc/out.csv")

    def test_an_output_is_refused_before_the_input_is_read(self):
        self.refuse("unwritable", "axis", "none.wkt", "-o", "none/out.csv")

    def test_an_error_leaves_an_older_output_alone(self):
        self.write("bow.wkt", BOW_TIE)
        self.write("out.csv", "precious")
        self.refuse("crossing", "axis", "bow.wkt", "-o", "out.csv")
        self.assertEqual(self.read("out.csv"), b"precious")

    def test_command_lines(self):
        self.write("frame.wkt", FRAME)
        for arguments in ([], ["axis"], ["dance"], ["axis", "frame.wkt", "--bogus"],
                          ["axis", "frame.wkt", "more"], ["axis", "frame.wkt", "--threads", "x"],
                          ["axis", "frame.wkt", "--threads", "-1"],
                          ["axis", "frame.wkt", "--threads", "99999999999999999999"],
                          ["axis", "frame.wkt", "-o", ""],
                          ["axis", "frame.wkt", "--seed", "-1"],
                          ["axis", "frame.wkt", "--seed", "99999999999999999999"],
                          ["axis", "frame.wkt", "--tolerance", "0.1"],
                          ["axis", "frame.wkt", "--tolerance", "nan"],
                          ["axis", "frame.wkt", "--tolerance", "-1e-9"],
                          ["axis", "frame.wkt", "--chord", "0"],
                          ["axis", "frame.wkt", "--chord", "nan"],
                          ["axis", "frame.wkt", "--repair=magic"],
                          ["axis", "frame.wkt", "-o"],
                          ["draw", "frame.wkt", "-o", "p.svg", "--width", "inf"],
                          ["draw", "frame.wkt", "-o", "p.svg", "--disks", "-1"]):
            with self.subTest(arguments=arguments):
                text = self.refuse("invalid_option", *arguments)
                self.assertIn("--help", text)
        done = self.run_medial("axis", "frame.wkt", "--bogus", "--json")
        self.assertEqual(json.loads(done.stdout)["error"]["code"], "invalid_option")

    def test_names_that_are_no_utf8(self):
        name = b"\xff\xfe.wkt"
        with open(os.path.join(self.folder.name.encode(), name), "w") as file:
            file.write(BOW_TIE)
        done = subprocess.run([PROGRAM.encode(), b"info", name, b"--json"], timeout=60,
                              cwd=self.folder.name, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(json.loads(done.stdout)["error"]["code"], "crossing")
        self.assertIn("\ufffd\ufffd.wkt", done.stderr.decode())

    def test_names_in_files_command_no_terminal(self):
        self.skip_without("DXF")
        square = "".join(f"10\n{x}\n20\n{y}\n" for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
        for name in ("a\x1b]0;\ab", "a\u009b31mb", "a\x7fb"):
            layer = f"0\nLWPOLYLINE\n8\n{name}\n90\n4\n70\n1\n{square}"
            self.write("a.dxf", f"0\nSECTION\n2\nENTITIES\n{layer}0\nENDSEC\n0\nEOF\n")
            told = self.refuse("invalid_option", "info", "a.dxf", "--layer", "c")
            self.assertRegex(told, "but: a[^\\x00-\\x1f\\x7f-\\x9f]*b \\[")
        self.write("b.dxf", b"\xff\n")
        self.assertIn("'\ufffd' is no group code", self.refuse("malformed", "info", "b.dxf"))


class Centrelines(CommandLine):
    def test_main_path(self):
        self.write("rectangle.wkt", RECTANGLE)
        told = json.loads(self.succeed("centreline", "rectangle.wkt", "--json").stdout)
        self.assertAlmostEqual(told["features"][0]["lines"][0]["length"], 2)
        text = self.succeed("centreline", "rectangle.wkt", "--extend", "-o", "-", "--format", "wkt").stdout
        for end in (b"0 1", b"4 1"):
            self.assertIn(end, text)
        for extension in FORMATS:
            with self.subTest(extension=extension):
                if extension == "dxf":
                    self.skip_without("DXF")
                self.succeed("centreline", "rectangle.wkt", "--extend", "-o", "line." + extension)
                self.succeed("centreline", "rectangle.wkt", "--smooth", "1", "-o", "smooth." + extension)
        for name in ("line.json", "smooth.json"):
            self.succeed("draw", name, "-o", "again.svg")

    def test_between_places(self):
        self.write("frame.wkt", FRAME)
        path = json.loads(self.succeed("centreline", "frame.wkt", "--from", "0/3", "--to=1,1", "--json").stdout)
        self.assertGreater(path["features"][0]["lines"][0]["length"], 0.5)
        wide = self.succeed("centreline", "frame.wkt", "--widest", "1,3", "8,3", "--json")
        self.assertAlmostEqual(json.loads(wide.stdout)["features"][0]["lines"][0]["narrowest_radius"], 1)
        self.refuse("invalid_option", "centreline", "frame.wkt", "--from", "1,1")
        self.refuse("invalid_option", "centreline", "frame.wkt", "--from", "1", "--to", "2,2")
        self.refuse("invalid_option", "centreline", "frame.wkt", "--from", "9/9", "--to", "2,2")
        self.refuse("invalid_option", "centreline", "frame.wkt", "--widest", "1,1", "2,2", "--clearance", "1")
        self.refuse("invalid_option", "centreline", "frame.wkt", "--collapse", "0")

    def test_clearance_and_collapse(self):
        self.write("frame.wkt", FRAME)
        told = json.loads(self.succeed("centreline", "frame.wkt", "--clearance", "1.1", "--json").stdout)
        self.assertGreater(told["length"], 1)
        for extension in ("json", "geojson", "gpkg", "wkt", "svg", "pdf", "png", "ps"):
            with self.subTest(extension=extension):
                self.succeed("centreline", "frame.wkt", "--collapse", "2.5", "-o", "parts." + extension)
        layers = [f["properties"]["layer"] for f in json.loads(self.read("parts.geojson"))["features"]]
        self.assertEqual(layers, sorted(layers, reverse=True))
        self.assertEqual(set(layers), {"polygons", "lines"})
        database = sqlite3.connect(self.path("parts.gpkg"))
        self.assertEqual(database.execute("select count(*) from polygons").fetchone()[0],
                         layers.count("polygons"))
        database.close()
        self.refuse("unsupported", "centreline", "frame.wkt", "--collapse", "2.5", "-o", "parts.dxf")

    def test_measure(self):
        self.write("rectangle.wkt", RECTANGLE)
        table = self.succeed("measure", "rectangle.wkt").stdout.decode()
        self.assertIn("widest", table)
        told = json.loads(self.succeed("measure", "rectangle.wkt", "--disks", "3", "--json").stdout)["features"][0]
        self.assertAlmostEqual(told["area"], 8)
        self.assertAlmostEqual(told["mean_width"]["by_length"], 2)
        self.assertEqual([round(disk["r"], 6) for disk in told["disks"]], [1, 1, 0.25])
        rows = self.rows(self.succeed("measure", "rectangle.wkt", "--samples", "4", "-o", "-",
                                      "--format", "csv").stdout)
        self.assertEqual([float(row["along"]) for row in rows], [0, 0.5, 1, 1.5, 2])
        self.assertEqual({round(float(row["width"]), 9) for row in rows}, {2})
        self.succeed("measure", "rectangle.wkt", "--spacing", "0.5", "-o", "transects.shp")
        for extension in ("geojson", "gpkg", "wkt", "svg", "pdf", "png", "ps"):
            self.succeed("measure", "rectangle.wkt", "--transects", "7", "--disks", "2", "-o", "m." + extension)
        self.assertEqual(len(json.loads(self.read("m.geojson"))["features"]), 9)
        for extension in ("svg", "png", "pdf"):
            self.succeed("measure", "rectangle.wkt", "--plot", "plot." + extension)
        self.refuse("unsupported", "measure", "rectangle.wkt", "--transects", "7", "--disks", "2", "-o", "m.fgb",
                    nothing_new=True)
        self.refuse("invalid_option", "measure", "rectangle.wkt", "--widening", "1")

    def test_several_features_with_attributes(self):
        self.write("places.geojson", GEOGRAPHIC)
        self.succeed("centreline", "places.geojson", "--project", "-o", "lines.geojson")
        names = [f["properties"]["name"] for f in json.loads(self.read("lines.geojson"))["features"]]
        self.assertEqual(names, ["west", "east"])
        self.succeed("measure", "places.geojson", "--project", "--transects", "2", "-o", "t.geojson")
        names = [f["properties"]["name"] for f in json.loads(self.read("t.geojson"))["features"]]
        self.assertEqual(names, ["west", "west", "east", "east"])


class Help(CommandLine):
    def test_help_and_version(self):
        text = self.succeed("--help").stdout.decode()
        for verb in ("axis", "verify", "info", "draw", "bench"):
            self.assertIn(f"  {verb} ", text)
        for verb in ("axis", "verify", "info", "draw"):
            own = self.succeed(verb, "--help").stdout.decode()
            for word in ("Usage", "Example", "--threads", "--tolerance", "--chord", "--stats",
                         "--json", "--quiet", "default", "--repair[=RULE]", "--close[=GAP]"):
                self.assertIn(word, own)
        self.assertRegex(self.succeed("--version").stdout.decode(), r"^medial \d+\.\d+\.\d+\n$")

    def test_no_such_verb(self):
        self.assertIn("no such command: axes", self.refuse("invalid_option", "axes"))
        self.assertIn("a command is missing", self.refuse("invalid_option"))


class Bench(CommandLine):
    def test_experiments(self):
        done = self.run_medial("bench", "biarc", "--quick", "--tolerances", "2", "--json", "-q")
        report = json.loads(done.stdout)
        self.assertEqual(done.returncode, 0 if report["passed"] else 1)
        self.assertEqual(done.stderr, b"")
        self.assertEqual([row["shape"] for row in report["by_tolerance"]],
                         [name for name in ("tree", "snowflake", "lettering", "border")
                          for _ in range(2)])
        for row in report["by_tolerance"] + report["by_size"]:
            with self.subTest(shape=row["shape"], tolerance=row["tolerance"]):
                self.assertGreater(row["edges"], 1000)
                self.assertLessEqual(row["error"], row["tolerance"])
                self.assertGreater(row["leaves"], 50)
                for phase in ("conversion", "build", "axis"):
                    self.assertGreater(row["seconds"][phase]["processor"], 0)
                if row["shape"] in ("snowflake", "lettering"):
                    self.assertEqual(row["failure"], "")
        for row in report["polygons"]:  # a leaf at every convex corner of a polygon
            self.assertGreater(row["polygon_leaves"], 2 * row["arc_leaves"])
            self.assertLess(row["arc_error"], row["polygon_error"])

    def test_ridge(self):
        done = self.run_medial("bench", "ridge", "--quick", "--per-unit", "6", "-q", "-o", "ridge.csv")
        self.assertEqual(done.returncode, 0, done.stdout.decode()[-2000:])
        table = done.stdout.decode()
        self.assertIn("| 10/5 | | | | | | | | | | | | | | | | refused: crossing |", table)
        self.assertNotIn("FAILED", table)
        rows = self.read("ridge.csv").decode().splitlines()
        self.assertGreater(len(rows), 20)
        self.assertEqual({len(row.split(",")) for row in rows}, {8 + 3 * 7})

    def test_lee(self):
        done = self.run_medial("bench", "lee", "--quick", "--json", "-q")
        self.assertEqual(done.returncode, 0, done.stdout.decode()[-2000:])
        rows = json.loads(done.stdout)
        self.assertEqual({row["shape"] for row in rows}, {"coast", "maze", "blob", "convex", "regular"})
        for row in rows:
            self.assertTrue(row["passed"], row)
            self.assertGreater(row["lee"], 0)
            self.assertLess(row["crossings"], 4)
        self.succeed("bench", "lee", "--figures", "figures")
        self.assertGreaterEqual(len(os.listdir(self.path("figures"))), 6)

    def test_figures_of_axes(self):
        for experiment, names in (
            ("curve-axis", {f"curve-axis-fig{i}.svg" for i in "1 2 3 4 5a 5b 6 7a 7b 8 9a 9b".split()}),
            ("potential", {"potential-fig13.svg"}),
        ):
            self.succeed("bench", experiment, "--figures", experiment)
            self.assertEqual(set(os.listdir(self.path(experiment))), names)

    def test_outputs(self):
        quick = ("bench", "biarc", "--quick", "--tolerances", "1", "-q", "-o")
        for name, start in (("plots.svg", b"<?xml"), ("rows.csv", b"series,"), ("all.json", b"{")):
            self.assertIn(self.run_medial(*quick, name).returncode, (0, 1))
            with open(self.path(name), "rb") as file:
                self.assertTrue(file.read().startswith(start))
        self.refuse("unsupported", *quick, "plots.txt")
        self.succeed("bench", "biarc", "--shapes", "shapes")
        info = json.loads(self.succeed("info", "shapes/tree.svg", "--json").stdout)
        self.assertEqual((info["features"], info["holes"]), (1, 0))
        info = json.loads(self.succeed("info", "shapes/lettering.svg", "--json").stdout)
        self.assertEqual((info["components"], info["holes"]), (192, 128))


class Images(CommandLine):
    # An L of two strokes and, over a corner, one more pixel.
    PICTURE = "P1\n8 6\n" + "".join(("11000000", "11000000", "11000000", "11111100", "11111100",
                                     "00000010"))

    def test_distance(self):
        self.write("l.pbm", self.PICTURE)
        told = json.loads(self.succeed("distance", "l.pbm", "--json", "--stats").stdout)
        self.assertEqual((told["foreground"], told["components"], told["holes"]), (19, 1, 0))
        self.assertAlmostEqual(told["largest"]["distance"], math.sqrt(2))
        for name in ("d.tif", "d.png", "d.pgm"):
            self.succeed("distance", "l.pbm", "-o", name)
            self.assertGreater(len(self.read(name)), 40)
        self.assertIn(b"8 x 6", self.succeed("distance", "-", given=self.PICTURE.encode()).stdout)
        self.refuse("unsupported", "distance", "l.pbm", "-o", "d.jpg")
        self.refuse("invalid_option", "distance", "l.pbm", "-o", "e.png", "--scale", "1e5")
        self.refuse("empty", "distance", "l.pbm", "--threshold", "2")
        self.refuse("unreadable", "distance", "none.png")
        self.refuse("unsupported", "distance", self.write("a.txt", "text"))

    def test_every_verb_takes_them(self):
        self.write("l.pbm", self.PICTURE)
        info = json.loads(self.succeed("info", "l.pbm", "--json").stdout)
        self.assertEqual((info["components"], info["holes"]), (1, 0))
        self.assertAlmostEqual(info["area"], 19 + 1 / 256)  # the neck at the corner
        inverse = json.loads(self.succeed("info", "l.pbm", "--invert", "--json").stdout)
        self.assertAlmostEqual(inverse["area"], 29 + 1 / 256)
        for switches in ([], ["--smooth-contour"], ["--method", "brushfire"], ["--method", "ridge"]):
            with self.subTest(switches=switches):
                self.succeed("axis", "l.pbm", *switches, "-o", "axis.json")
                shape = switches if switches == ["--smooth-contour"] else []
                self.succeed("verify", "l.pbm", "axis.json", *shape)
        self.succeed("draw", "l.pbm", "-o", "l.svg")
        self.refuse("invalid_option", "info", "l.pbm", "--layer", "a")
        self.refuse("invalid_option", "info", "l.pbm", "--repair")

    def test_families(self):
        self.write("l.pbm", self.PICTURE)
        for family in ("sequential", "sides", "marking", "simultaneous"):
            self.succeed("axis", "l.pbm", "--method", "brushfire", "--brushfire", family,
                         "-o", "axis.json")
            info = json.loads(self.succeed("info", "axis.json", "--json").stdout)
            self.assertEqual((info["method"], info["resolution"]), ("brushfire", 1))
        self.refuse("invalid_option", "axis", "l.pbm", "--brushfire", "forest")

    def test_experiment(self):
        self.write("l.pbm", self.PICTURE)
        table = self.succeed("bench", "brushfire", "l.pbm", "-o", "figure.svg").stdout.decode()
        self.assertEqual(len(table.splitlines()), 4)
        self.assertRegex(table, r"\| l \| 19 \|.* 0 \(0 %\) \|$")  # the exact axis loses nothing
        ElementTree.fromstring(self.read("figure.svg"))
        self.succeed("bench", "brushfire", "-o", "figure.csv")


class Words(CommandLine):
    """What is told of command lines and files that are not right."""

    def test_switches(self):
        self.write("r.wkt", RECTANGLE)
        for words, *line in (
                ("no such option: --foo", "axis", "r.wkt", "--foo"),
                ("--chord needs a value", "axis", "r.wkt", "--chord"),
                ("one word too many: more", "axis", "r.wkt", "more"),
                ("--threads: '1.5' is no whole number", "axis", "r.wkt", "--threads", "1.5"),
                ("--threshold: 'abc' is no number", "axis", "r.wkt", "--threshold", "abc"),
                ("--chord: 'x' is no number", "axis", "r.wkt", "--chord", "x"),
                ("-1 is no finite number above 0", "offset", "r.wkt", "--step", "-1"),
                ("inf is no finite number above 0", "carve", "r.wkt", "--angle", "60", "--depth", "inf"),
                ("'1,,2' is not numbers with commas", "offset", "r.wkt", "--distance", "1,,2"),
                ("'0.5,' is not numbers with commas", "offset", "r.wkt", "--distance", "0.5,"),
                ("'x' is not numbers with commas", "offset", "r.wkt", "--distance", "x"),
                ("'1,2' is not 4 numbers with commas", "axis", "r.wkt", "--within", "1,2"),
                ("'1,2' is not 4 numbers with commas", "voronoi", "r.wkt", "--frame", "1,2"),
                ("0 is not in [1 - 1e+06]", "measure", "r.wkt", "--samples", "0")):
            told = self.refuse("invalid_option", *line)
            self.assertIn(words, told)
            self.assertLess(len(told), 160, told)
        told = json.loads(self.succeed("offset", "r.wkt", "--distance", "0.25,0.5,-1", "--json").stdout)
        self.assertEqual(told["regions"], 3)
        self.refuse("too_large", "measure", "r.wkt", "--spacing", "1e-300")
        # Curvatures so unlike that the method would go on for hours: it gives up.
        self.write("island.wkt", "POLYGON((0 0,10 0,14 5,10 9,4 8,0 6))")
        self.refuse("too_large", "axis", "island.wkt", "--method", "curve-axis", "--fit", "1e-7")

    def test_coordinates(self):
        """The place of a coordinate that nobody can compute with is told, whatever reads it."""
        for name, text, verb, words in (
                ("far.wkt", "POLYGON ((0 0, 1e308 0, 1 1))", "voronoi", "ring 0, vertex 1 at (1e+308, 0)"),
                ("far.txt", "0 0\n-1e308 1e308\n", "voronoi", "at (-1e+308, 1e+308)")):
            self.write(name, text)
            told = self.refuse("unsupported", verb, name)
            self.assertIn(words, told)
            self.assertNotIn("4294967295", told)
        for verb in ("axis", "voronoi"):
            self.write("arc.wkt", "CURVEPOLYGON (CIRCULARSTRING (0 0, 1e400 0, 2 2, 3 3, 0 0))")
            self.refuse("not_finite", verb, "arc.wkt")
            self.write("line.wkt", "POLYGON ((0 0, 1e400 0, 2 2, 0 0))")
            self.assertIn("vertex 1", self.refuse("not_finite", verb, "line.wkt"))
        self.write("line.geojson", json.dumps({"type": "LineString", "coordinates": [[0, 0], [1, 1]]})
                   .replace("[1, 1]", "[1e400, 1]"))
        self.refuse("not_finite", "voronoi", "line.geojson")

    def test_tables(self):
        """Two columns are vertices, with names above them or without; other columns are GDAL's."""
        corners = "0,0\n4,0\n4,2\n0,2\n"
        for name, text in (("a.csv", corners), ("b.csv", "x,y\n" + corners), ("c.txt", "x y\n" + corners),
                           ("d.csv", "easting;northing\r\n" + corners.replace(",", ";").replace("\n", "\r\n"))):
            self.write(name, text)
            self.assertEqual(json.loads(self.succeed("axis", name, "--json").stdout)["sites"], 4)
            self.assertEqual(json.loads(self.succeed("voronoi", name, "--json").stdout)["points"], 4)
        given = ("x,y\n" + corners).encode()
        self.assertEqual(json.loads(self.succeed("axis", "-", "--json", given=given).stdout)["sites"], 4)
        self.write("wells.csv", "id,x,y,name\n1,0,0,a\n2,4,0,b\n3,4,2,c\n")
        self.assertEqual(json.loads(self.succeed("voronoi", "wells.csv", "--json").stdout)["points"], 3)
        self.assertIn("no polygons", self.refuse("unsupported", "axis", "wells.csv"))
        self.write("names.txt", "x y\nwords only\n")
        self.refuse("malformed", "axis", "names.txt")


class Interruption(CommandLine):
    def test_reading_shows_itself_on_a_terminal(self):
        """After a second, and is wiped; never with --quiet."""
        for quiet in ([], ["--quiet"]):
            try:
                terminal, end = os.openpty()
            except OSError as error:
                self.skipTest(f"no terminals here: {error}")
            process = subprocess.Popen([PROGRAM, "axis", "-", "-o", "out.json", *quiet], cwd=self.folder.name,
                                       stdin=subprocess.PIPE, stderr=end)
            os.close(end)
            shown = b""
            if quiet:
                time.sleep(1.5)
            else:
                # However busy the machine is: it waits for its input until this is there.
                while not re.search(rb"reading standard input \.\.\. \d+ s", shown):
                    self.assertTrue(select.select([terminal], [], [], 60)[0], shown)
                    shown += os.read(terminal, 4096)
            process.communicate(RECTANGLE.encode(), timeout=60)
            self.assertEqual(process.returncode, 0)
            try:
                while part := os.read(terminal, 4096):
                    shown += part
            except OSError:  # the other end is closed
                pass
            os.close(terminal)
            if quiet:
                self.assertEqual(shown, b"")
            else:
                self.assertIn(b"\r\x1b[K", shown)

    def start(self, output):
        return subprocess.Popen([PROGRAM, "axis", "comb.wkt", "-o", output], cwd=self.folder.name,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
                                preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))

    def results(self):
        return {name: self.read(name) for name in self.files() if name != "comb.wkt"}

    def clear(self):
        for name in self.results():
            os.remove(self.path(name))

    def test_all_or_nothing_is_left(self):
        """A signal while the result is written leaves nothing, or all of it where it came after the work."""
        self.write("comb.wkt", comb(30_000))
        interrupted = 0
        for output in ("out.csv", "out.json", "out.gpkg", "out.shp"):
            self.succeed("axis", "comb.wkt", "-o", output)
            whole = self.results()
            self.clear()
            for signal_number in (signal.SIGINT, signal.SIGTERM):
                for after in (0, 0.02):
                    process = self.start(output)
                    while process.poll() is None and len(self.files()) == 1:
                        time.sleep(0.001)
                    time.sleep(after)
                    process.send_signal(signal_number)
                    with process.stderr:
                        errors = process.stderr.read()
                    status = process.wait(60)
                    left = self.results()
                    with self.subTest(signal=signal_number, output=output, after=after, left=list(left)):
                        self.assertIn(status, (0, 128 + signal_number))
                        self.assertEqual(errors, b"")
                        self.assertIn(left, ({}, whole))
                        interrupted += not left
                    self.clear()
        self.assertGreater(interrupted, 0)


class Offset(CommandLine):
    SQUARE = "POLYGON ((0 0, 10 0, 10 8, 0 8, 0 0), (4 3, 4 5, 6 5, 6 3, 4 3))"

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
        self.assertEqual(self.read("o.wkt").count(b"\n"), 2)

    def test_passes(self):
        self.write("s.wkt", self.SQUARE)
        told = json.loads(self.succeed("offset", "s.wkt", "--step", "0.5", "--until", "empty",
                                       "--json").stdout)
        self.assertEqual((told["features"], told["regions"]), (1, 1 + 1 + 2 + 4))
        self.succeed("offset", "s.wkt", "--step", "0.5", "--until", "2", "--exterior", "-o", "-",
                     "--format", "wkt")
        self.refuse("invalid_option", "offset", "s.wkt", "--step", "0.5", "--exterior")
        self.refuse("too_large", "offset", "s.wkt", "--step", "1e-9")

    def test_buffers_carry_attributes(self):
        """Of the features in a region, what they agree on; regions grow together."""
        def road(x, **properties):
            return {"type": "Feature", "properties": properties,
                    "geometry": {"type": "LineString", "coordinates": [[x, 0], [x, 10]]}}
        self.write("roads.geojson", json.dumps({"type": "FeatureCollection", "features": [
            road(0, kind="road", name="a"), road(4, kind="road", name="b"), road(100, kind="path", name="c")]}))
        self.succeed("offset", "roads.geojson", "--loose", "--distance", "1,3", "-o", "b.json")
        regions = json.loads(self.read("b.json"))["items"][0]["regions"]
        told = {(r["clearance"], tuple(r["features"])): dict(r["attributes"]) for r in regions}
        self.assertEqual(told, {(-1, (0,)): {"kind": "road", "name": "a"}, (-1, (1,)): {"kind": "road", "name": "b"},
                                (-1, (2,)): {"kind": "path", "name": "c"}, (-3, (0, 1)): {"kind": "road"},
                                (-3, (2,)): {"kind": "path", "name": "c"}})
        self.succeed("offset", "roads.geojson", "--loose", "--distance", "3", "-o", "b.geojson")
        told = [f["properties"] for f in json.loads(self.read("b.geojson"))["features"]]
        self.assertEqual(sorted((p["features"], p["kind"], p.get("name")) for p in told),
                         [([0, 1], "road", None), ([2], "path", "c")])
        # What rounding does not tell apart touches and is one region; nobody's attributes are lost.
        pieces = [("LineString", [[0, 0], [3, 1]], "a"), ("LineString", [[1.5, 0.50000000000001], [1, 2]], "b"),
                  ("Point", [3.00000000000001, 1], "c")]
        self.write("near.geojson", json.dumps({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {"kind": "road", "name": name},
             "geometry": {"type": kind, "coordinates": places}} for kind, places, name in pieces]}))
        self.succeed("offset", "near.geojson", "--loose", "--distance", "0.1", "-o", "n.json")
        told = json.loads(self.read("n.json"))["items"][0]["regions"]
        self.assertEqual([(r["features"], dict(r["attributes"])) for r in told], [([0, 1, 2], {"kind": "road"})])

    def test_what_cannot_be_done_is_refused(self):
        self.write("s.wkt", self.SQUARE)
        self.write("l.wkt", "LINESTRING (0 0, 1 1)")
        self.refuse("invalid_option", "offset", "s.wkt")
        self.refuse("invalid_option", "offset", "s.wkt", "--distance", "0")
        self.refuse("invalid_option", "offset", "s.wkt", "--distance", "1", "--step", "1")
        self.refuse("invalid_option", "offset", "s.wkt", "--step", "1", "--until", "never")
        self.refuse("unsupported", "offset", "s.wkt", "--distance", "1", "-o", "o.shp")
        self.assertNotEqual(self.run_medial("offset", "l.wkt", "--distance", "1").returncode, 0)


class Carve(CommandLine):
    SQUARE = "POLYGON ((0 0, 10 0, 10 8, 0 8, 0 0))"

    def moves(self, name):
        """The places of the tool after each line of G-code, with the kind of move."""
        at = {"X": 0.0, "Y": 0.0, "Z": 0.0}
        out = []
        for line in self.read(name).decode().splitlines():
            words = {word[0]: float(word[1:]) for word in line.split() if not line.startswith("(")}
            if words.get("G") not in (0, 1, 2, 3):
                continue
            before = dict(at)
            at.update({axis: words[axis] for axis in "XYZ" if axis in words})
            out.append((int(words["G"]), before, dict(at), words))
        return out

    def test_gcode_cuts_nothing_outside(self):
        self.write("s.wkt", self.SQUARE)
        self.succeed("carve", "s.wkt", "--angle", "60", "--tool", "5", "--tip", "0.5", "-o", "s.nc")
        slope, tip = math.tan(math.pi / 6), 0.25
        moves = self.moves("s.nc")
        self.assertGreater(len(moves), 20)
        for kind, before, after, _ in moves:
            if kind == 0:  # fast moves are above the surface at both ends, or straight up
                self.assertGreater(after["Z"], 0)
                continue
            room = min(after["X"], 10 - after["X"], after["Y"], 8 - after["Y"])
            self.assertLessEqual(tip - after["Z"] * slope, room + 1e-5)
        self.assertAlmostEqual(min(after["Z"] for _, _, after, _ in moves), -2.25 / slope, 5)
        self.assertAlmostEqual(moves[-1][2]["Z"], 5)

    @staticmethod
    def places(move, spacing):
        """Places along a move of G-code, clockwise along G2 and counter-clockwise along G3."""
        kind, before, after, words = move
        start, end = ((at["X"], at["Y"], at["Z"]) for at in (before, after))
        if kind == 1:
            steps = 1 + int(math.dist(start, end) / spacing)
            return [tuple(a + i / steps * (b - a) for a, b in zip(start, end)) for i in range(steps + 1)]
        x, y = start[0] + words["I"], start[1] + words["J"]
        radius, first = math.hypot(words["I"], words["J"]), math.atan2(start[1] - y, start[0] - x)
        turn = (math.atan2(end[1] - y, end[0] - x) - first) % (2 * math.pi)
        if kind == 2:
            turn -= 2 * math.pi
        steps = 1 + int(abs(turn) * radius / spacing)
        return [(x + radius * math.cos(first + i / steps * turn), y + radius * math.sin(first + i / steps * turn),
                 start[2]) for i in range(steps + 1)]

    def test_arcs_cut_what_they_should(self):
        """A slot with round ends around a round post, cut by the G-code's own arcs on a map of heights."""
        self.write("slot.wkt", "CURVEPOLYGON (COMPOUNDCURVE ((5 0, 15 0), CIRCULARSTRING (15 0, 20 5, 15 10), (15 10, 5 10), "
                               "CIRCULARSTRING (5 10, 0 5, 5 0)), CIRCULARSTRING (8 5, 12 5, 8 5))")

        def room(x, y):
            return min(5 - math.hypot(x - min(max(x, 5), 15), y - 5), math.hypot(x - 10, y - 5) - 2)
        slope, tip, deepest = math.tan(math.pi / 6), 0.5, 1.5
        self.succeed("carve", "slot.wkt", "--angle", "60", "--tip", "1", "--depth", "1.5", "--pass-depth", "1", "-o", "s.nc")
        moves = [move for move in self.moves("s.nc") if move[0] > 0]
        self.assertEqual({move[0] for move in moves}, {1, 2, 3})
        places = [place for move in moves for place in self.places(move, 0.2)]
        for x, y, z in places:  # six decimals
            self.assertLessEqual(tip - slope * z, room(x, y) + 2e-6)
        bottom = [(x, y) for x, y, z in places if z < 1e-6 - deepest]
        above = [place for place in places if place[2] >= 1e-6 - deepest]
        for i in range(25):
            for k in range(12):
                p = (0.4 + 0.8 * i, 0.4 + 0.83 * k)
                wanted = min(max(room(*p), 0) / slope, deepest)
                cut = max(0, deepest - max(0, min(math.dist(p, at) for at in bottom) - tip) / slope)
                if cut < wanted - 0.02:
                    cut = max(-z - max(0, math.dist(p, (x, y)) - tip) / slope for x, y, z in above)
                self.assertLessEqual(cut, wanted + 4e-6)
                self.assertGreaterEqual(cut, wanted - 0.02, p)

    def test_arcs_have_one_radius(self):
        self.write("c.wkt", "CURVEPOLYGON (CIRCULARSTRING (-9 0, 9 0, -9 0))")
        self.succeed("carve", "c.wkt", "--angle", "0", "--tool", "2", "--depth", "1", "-o", "c.gcode")
        arcs = [move for move in self.moves("c.gcode") if move[0] in (2, 3)]
        self.assertGreater(len(arcs), 8)
        for _, before, after, words in arcs:
            x, y = before["X"] + words["I"], before["Y"] + words["J"]
            self.assertAlmostEqual(math.hypot(before["X"] - x, before["Y"] - y),
                                   math.hypot(after["X"] - x, after["Y"] - y), 5)

    def test_every_format(self):
        self.write("s.wkt", self.SQUARE)
        for name in self.supported("c.nc", "c.ngc", "c.gcode", "c.csv", "c.dxf", "c.svg", "c.pdf", "c.png", "c.ps"):
            self.succeed("carve", "s.wkt", "--angle", "90", "--depth", "2", "-o", name)
            self.assertGreater(len(self.read(name)), 200)
        self.assertTrue(self.read("c.csv").startswith(b"path,kind,x,y,z\n"))
        told = json.loads(self.succeed("carve", "s.wkt", "--angle", "90", "--json").stdout)
        self.assertAlmostEqual(told["deepest"], 4)

    def test_what_cannot_be_done_is_refused(self):
        self.write("s.wkt", self.SQUARE)
        self.refuse("invalid_option", "carve", "s.wkt")
        self.refuse("invalid_option", "carve", "s.wkt", "--angle", "0")
        self.refuse("invalid_option", "carve", "s.wkt", "--angle", "175")
        self.refuse("invalid_option", "carve", "s.wkt", "--angle", "90", "--tool", "1", "--tip", "2")
        self.refuse("unsupported", "carve", "s.wkt", "--angle", "90", "-o", "c.stl")


if __name__ == "__main__":
    unittest.main(verbosity=2)
