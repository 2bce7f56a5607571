"""Repair, projection, curves, drawings, texts and tables: options that every command shares."""

import csv
import gzip
import json
import math
import os
import re

from support import BOW_TIE, GEOGRAPHIC, RECTANGLE, CommandLine


class Inputs(CommandLine):
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
        for command, source, output in (
                ("axis", "places.geojson", "q.wkt"), ("rebuild", "p.json", "r.geojson"),
                ("rebuild", "p.json", "r.wkt"), ("voronoi", "wells.geojson", "v.geojson"),
                ("voronoi", "places.geojson", "v.wkt"), ("voronoi", "places.geojson", "v.csv"),
                ("features", "p.json", "f.csv"), ("measure", "places.geojson", "m.csv"),
                ("offset", "places.geojson", "o.wkt"), ("offset", "places.geojson", "o.geojson")):
            more = [] if source == "p.json" else ["--project"]
            more += ["--distance", "100"] if command == "offset" else []
            more += ["--margin", "50"] if command == "voronoi" else []
            self.succeed(command, source, "-o", output, *more)
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

    def test_projected_coordinates_that_stretch_lengths(self):
        """A rectangle of 100 by 10 m at 60 degrees north, in Web Mercator, which doubles lengths."""
        def layer(name, code, points):
            self.write(name, json.dumps({
                "type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": f"EPSG:{code}"}}, "features": [
                    {"type": "Feature", "properties": {"k": 7}, "geometry": {"type": "Polygon", "coordinates": [points]}}]}))
        left, low, right, high = 1113194.9079, 8399737.8898, 1113394.9070, 8399757.8732
        layer("m.geojson", 3857, [[left, low], [right, low], [right, high], [left, high], [left, low]])
        plain = self.succeed("axis", "m.geojson", "--json")
        self.assertIn(b"are 2.00 times those on the ground at 10.00", plain.stderr)
        self.assertIn(b"--project", plain.stderr)
        metres = self.succeed("axis", "m.geojson", "--project", "--json", "-o", "m.json")
        self.assertNotIn(b"times those on the ground", metres.stderr)
        self.assertAlmostEqual(json.loads(plain.stdout)["deepest"]["radius"], 9.99, delta=0.01)
        self.assertAlmostEqual(json.loads(metres.stdout)["deepest"]["radius"], 5, delta=0.03)
        self.succeed("verify", "m.geojson", "m.json", "--project")
        # Outputs have the layer's own coordinates again.
        self.succeed("rebuild", "m.json", "-o", "r.geojson")
        for command, output, *options in (
                ("axis", "a.geojson"), ("centreline", "c.geojson"), ("offset", "o.geojson", "--distance", "1"),
                ("measure", "t.geojson", "--transects", "5"), ("voronoi", "v.geojson", "--margin", "1"),
                ("rebuild", "r.geojson")):
            if command != "rebuild":
                self.succeed(command, "m.geojson", "--project", "-o", output, *options)
            written = json.loads(self.read(output))
            self.assertIn("3857", written["crs"]["properties"]["name"], command)
            text = re.findall(r"\[(-?[0-9][-+.0-9e]*),(-?[0-9][-+.0-9e]*)", self.read(output).decode())
            self.assertGreater(len(text), 1, command)
            for x, y in text:
                self.assertTrue(left - 4 < float(x) < right + 4 and low - 4 < float(y) < high + 4, (command, x, y))
        # A grid that is true within a percent is left alone: UTM, and a state plane in feet.
        for code, x, y in (32632, 500000, 6651000), (2263, 990000, 200000):
            layer("u.geojson", code, [[x, y], [x + 99, y], [x + 99, y + 9], [x, y + 9], [x, y]])
            self.assertEqual(self.succeed("axis", "u.geojson", "--json").stderr, b"")
            self.assertIn(b"nothing was projected", self.succeed("axis", "u.geojson", "--project", "--json").stderr)
        # Read part by part, the note is the same.
        ring = f"{left} {low}, {right} {low}, {right} {high}, {left} {high}, {left} {low}"
        self.write("long.wkt", "\n".join([f"SRID=3857;POLYGON(({ring}))"] * 10000))
        self.assertEqual(self.succeed("axis", "long.wkt", "-o", "long.csv").stderr.count(b"2.00 times those"), 1)
        # What lies beyond the end of the system would come back elsewhere.
        x = 20037508.342789244
        layer("e.geojson", 3857, [[x - 50, high], [x + 50, high], [x + 50, high + 50], [x - 50, high]])
        self.assertIn("beyond the end", self.refuse("unsupported", "axis", "e.geojson", "--project"))

    def test_repair(self):
        self.write("bow.wkt", BOW_TIE)
        for option in ("--repair", "--repair=make-valid", "--repair=even-odd", "--repair=non-zero"):
            done = self.succeed("axis", option, "bow.wkt", "--json")
            self.assertGreater(json.loads(done.stdout)["nodes"], 5)
            self.assertIn(b"note", done.stderr)
            self.assertEqual(self.succeed("axis", option, "bow.wkt", "--quiet").stderr, b"")

    def test_own_format_is_not_told_to_repair(self):
        self.write("bow.json", '{"medial":2,"items":[{"contours":[{"start":[0,0],"pieces":'
                   '[["line",1,1],["line",1,0],["line",0,1],["line",0,0]]}]}]}')
        error = self.refuse("crossing", "axis", "bow.json")
        self.assertNotIn("--repair", error)

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
            report = json.loads(self.succeed("axis", name, "--json").stdout)
            self.assertEqual(report["features"], 1, name)
            self.assertAlmostEqual(report["deepest"]["radius"], 1, 12, name)
            self.assertAlmostEqual(report["length"], 4, 9, name)
        report = json.loads(self.succeed("info", "--json", "a.svg").stdout)
        self.assertEqual(report["arcs"]["pieces"], 8)
        self.assertAlmostEqual(report["area"], 8 + math.pi, 12)

    def test_svg_in_utf_16_on_standard_input(self):
        text = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0H10V10z"/></svg>'
        for encoding in ("utf-8", "utf-8-sig", "utf-16", "utf-16-be"):
            mark = b"\xfe\xff" if encoding == "utf-16-be" else b""
            report = json.loads(self.succeed("info", "-", "--json", given=mark + text.encode(encoding)).stdout)
            self.assertEqual(report["area"], 50, encoding)

    def test_options_of_curves(self):
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
        for rule, parts in ([], 1), (["--repair"], 1), (["--repair=non-zero"], 1), (["--repair=even-odd"], 2):
            mended = self.succeed("info", *rule, "moons.svg", "--json")
            self.assertEqual(json.loads(mended.stdout)["components"], parts, rule)
            self.assertIn(b"cross or overlap in 2 places", mended.stderr)

    def test_overlaps_leave_no_flat_corners(self):
        """Letters of overlapping rectangles have a leaf in each of their corners, and in no point of an edge."""
        for k in range(12):
            scale = 1 + k / 7
            path = "".join("M{0} {1}H{2}V{3}H{0}Z".format(*(scale * v for v in box)) for box in
                           ((60, 0, 160, 700), (340, 0, 440, 700), (110, 600, 430, 700), (160, 300, 340, 400)))
            self.write("a.svg", f'<svg xmlns="http://www.w3.org/2000/svg" width="800mm" viewBox="0 0 777 800"><path d="{path}"/></svg>')
            self.succeed("axis", "a.svg", "-o", "a.json")
            nodes = json.loads(self.read("a.json"))["items"][0]["axis"]["nodes"]
            self.assertEqual(sum(node[2] == 0 for node in nodes), 6, k)
            self.succeed("verify", "a.svg", "a.json")

    def test_projections_go_on_beyond_180_degrees(self):
        ring = [[179, 0], [181, 0], [181, 1], [179, 1], [179, 0]]
        self.write("a.geojson", json.dumps({"type": "Polygon", "coordinates": [ring]}))
        self.succeed("centreline", "a.geojson", "--project", "-o", "b.geojson")
        for line in json.loads(self.read("b.geojson"))["features"]:
            self.assertTrue(all(179 < x < 181 for x, _ in line["geometry"]["coordinates"]), line)
        # Where the input has no longitudes beyond 180, only what crosses that meridian has.
        boxes = [[[[a, 0], [b, 0], [b, 1], [a, 1], [a, 0]]] for a, b in ((178, 179.9), (-180, -178), (179.95, -179.95))]
        for last in (2, 3):
            self.write("d.geojson", json.dumps({"type": "FeatureCollection", "features": [
                {"type": "Feature", "properties": {"box": i}, "geometry": {"type": "Polygon", "coordinates": box}}
                for i, box in enumerate(boxes[:last])]}))
            for command in ("centreline", "rebuild"):
                self.succeed(command, "d.geojson", "--project", "-o", "e.geojson")
                for row in json.loads(self.read("e.geojson"))["features"]:
                    points = row["geometry"]["coordinates"]
                    longitudes = [x for x, *_ in (points[0][0] if command == "rebuild" else points)]
                    low, high = ((177.9, 179.91), (-180.01, -177.9), (179.9, 180.1))[row["properties"]["box"]]
                    self.assertTrue(all(low < x < high for x in longitudes), (command, row))
        # What one projection of a wide file does to lengths is said.
        far = [[[10, 60], [10.1, 60], [10.1, 60.1], [10, 60]], [[-120, -40], [-119, -40], [-119, -39], [-120, -40]]]
        self.write("c.geojson", json.dumps({"type": "MultiPolygon", "coordinates": [[ring] for ring in far]}))
        self.assertIn(b"lengths are off by up to", self.succeed("axis", "c.geojson", "--project", "-o", "c.json").stderr)

    def test_fill_rules_need_no_repair(self):
        """Outlines of a drawing that cross, overlap along edges and arcs, or enclose nothing."""
        half = "a1 1 0 0 1 2 0"
        for name, path, area in (
                ("shared.svg", "M0 0h4v4h-4zM4 1h4v2h-4z", 24),
                ("twice.svg", "M0 0h4v4h-4zM0 0h4v4h-4z", 16),
                ("odd.svg", "M0 0h4v4h-4zM0 0h2v4h-2z", 8),
                ("flat.svg", "M0 0h4v4h-4zM9 9h4h-4z", 16),
                ("arcs.svg", f"M0 0{half}v-3h-2zM0 0{half}v3h-2z", 12)):
            rule = ' fill-rule="evenodd"' if name == "odd.svg" else ""
            self.write(name, f'<svg><path{rule} d="{path}"/></svg>')
            self.assertAlmostEqual(json.loads(self.succeed("info", name, "--json").stdout)["area"], area, 9, name)
            self.succeed("axis", name, "-o", "a.json")
            self.succeed("verify", name, "a.json")
        self.write("shared.wkt", "MULTIPOLYGON(((0 0,4 0,4 4,0 4,0 0)),((4 1,8 1,8 3,4 3,4 1)))")
        self.assertIn("--repair", self.refuse("overlap", "axis", "shared.wkt"))

    def test_invalid_features_are_left_out(self):
        self.write("some.wkt", "\n".join((
            "POLYGON((0 0,4 0,4 2,0 2,0 0))", BOW_TIE,
            "MULTIPOLYGON(((10 0,14 0,14 2,10 2,10 0)),((20 0,20 0,20 0)))")))
        self.refuse("crossing", "axis", "some.wkt")
        done = self.succeed("axis", "some.wkt", "--skip-invalid", "--json")
        notes = done.stderr.decode()
        self.assertEqual(json.loads(done.stdout)["features"], 2)
        self.assertIn("left out: feature 1", notes)
        self.assertIn("feature 2, ring 1", notes)
        self.assertIn("1 of 3 features is invalid and was left out", notes)
        both = self.succeed("axis", "some.wkt", "--skip-invalid", "--repair", "--json")
        self.assertEqual(json.loads(both.stdout)["features"], 3)
        self.assertNotIn(b"left out: feature 1", both.stderr)
        # Of several polygons those that cross themselves, or each other.
        self.write("parts.wkt", "MULTIPOLYGON(((0 0,4 0,4 2,0 2,0 0)),((10 0,14 4,14 0,10 4,10 0)),"
                   "((20 0,24 0,24 2,20 2,20 0),(21 0.5,23 0.5,23 1.5,21 1.5,21 0.5)),((23 1,28 1,28 3,23 3,23 1)))")
        left = self.succeed("info", "parts.wkt", "--skip-invalid", "--json")
        self.assertEqual([json.loads(left.stdout)[name] for name in ("components", "holes")], [2, 0])
        self.assertEqual(left.stderr.count(b"left out with its polygon"), 2)
        self.assertIn(b"feature 0, ring 1", left.stderr)
        # Nothing may be left: then the result is empty, and the note names the cure.
        self.write("bad.wkt", BOW_TIE)
        for name in self.supported("bad.json", "bad.geojson", "bad.gpkg", "bad.csv", "bad.svg"):
            notes = self.succeed("axis", "bad.wkt", "--skip-invalid", "-o", name).stderr.decode()
            self.assertIn("1 of 1 feature is invalid and was left out; --repair", notes)
        # Or an error, where a command needs a shape.
        places = ["--from", "0,0", "--to", "1,1"]
        for command in (["carve", "--angle", "60"], ["match", "some.wkt"], ["nest", "some.wkt"],
                        ["prune", "--preview", "-o", "t.png"], ["compare", "-o", "t.svg"], ["pack", "-o", "t.mpk"],
                        ["centreline", *places, "-o", "t.json"], ["centreline", "--widest", "0/0", "0/1"],
                        ["measure", *places], ["measure", "--widest", "0/0", "0/1", "--json"]):
            self.refuse("empty", command[0], "bad.wkt", "--skip-invalid", "--quiet", *command[1:])
        self.write("one.wkt", "POLYGON((0 0,4 0,4 2,0 2,0 0))")
        self.refuse("empty", "nest", "one.wkt", "bad.wkt", "--skip-invalid", "--quiet")
        self.refuse("empty", "prune", "bad.json", "--preview", "-o", "t.svg", "--quiet")
        report = json.loads(self.succeed("axis", "bad.wkt", "--skip-invalid", "--json").stdout)
        self.assertIsNone(report["deepest"])
        self.assertNotIn(b"wide enough", self.succeed("offset", "bad.wkt", "--skip-invalid", "--distance", "1").stderr)

    def refused_in_the_middle(self):
        """A rectangle, a disk whose arcs cross by less than rounding next to a tiny one, and another rectangle."""
        def rectangle(x):
            return {"start": [x, 0], "pieces": [["line", x + 4, 0], ["line", x + 4, 2], ["line", x, 2], ["line", x, 0]]}
        lens = {"start": [59.779820511429911, 16.864666909415433], "pieces": [
            ["arc", 59.779820512203585, 16.864666920592896, 82960947.97596328],
            ["arc", 57.784594458571199, 17.002771934645651, 0.9999999971989485],
            ["arc", 59.779820511429911, 16.864666909415433, 0.9999999971989485]]}  # fmt: skip
        items = [{"contours": [contour]} for contour in (rectangle(0), lens, rectangle(10))]
        self.write("lens.json", json.dumps({"medial": 2, "items": items}))
        return "lens.json"

    def test_features_that_cannot_be_computed_are_left_out(self):
        lens = self.refused_in_the_middle()
        self.refuse("crossing", "axis", lens)
        for command, *more in (["axis"], ["prune"], ["centreline"], ["draw"], ["offset", "--distance", "0.5"],
                               ["smooth"], ["rebuild"], ["features"], ["measure"]):
            name = "a.svg" if command == "draw" else "a.json" if command in ("axis", "prune") else "a.geojson"
            done = self.succeed(command, lens, "--skip-invalid", "-o", name, *more)
            notes = done.stderr.decode()
            self.assertIn("left out: feature 1, ring 0", notes, command)
            self.assertIn("note: 1 feature could not be computed and was left out", notes, command)
            if name == "a.geojson" and command not in ("rebuild", "smooth"):
                self.assertEqual({line["properties"]["feature"] for line in json.loads(self.read(name))["features"]},
                                 {0, 2}, command)  # fmt: skip
            self.refuse("crossing", command, lens, "-o", name, *more)
        self.succeed("pack", lens, "--skip-invalid", "-o", "a.mpk")
        self.succeed("carve", lens, "--skip-invalid", "--angle", "60", "-o", "a.nc")
        self.succeed("match", lens, lens, "--each", "--skip-invalid")
        compared = json.loads(self.succeed("compare", lens, "--methods", "disks", "--skip-invalid", "--json").stdout)
        self.assertEqual(len(compared["features"]), 2)

    def test_what_is_left_of_such_features_is_consistent(self):
        lens = self.refused_in_the_middle()
        report = json.loads(self.succeed("axis", lens, "--skip-invalid", "--json", "--stats", "-o", "a.json").stdout)
        self.assertEqual(report["features"], 2)
        self.assertEqual(report["sites"], 8)
        for threads in ("1", "2"):
            for name, *parts in (["a.csv"], ["p.csv", "--parts"]):
                done = self.succeed("axis", lens, "--skip-invalid", "--threads", threads, "-o", name, *parts)
                self.assertIn("1 feature could not be computed", done.stderr.decode())
                self.write(threads + name, self.read(name))
        self.assertEqual(self.read("1a.csv"), self.read("2a.csv"))
        self.assertEqual(self.read("1p.csv"), self.read("2p.csv"))
        self.assertEqual(sorted(self.read("1a.csv").splitlines()), sorted(self.read("1p.csv").splitlines()))
        # The axes are those of their features, by number.
        self.assertIn("it has no axis of 1 feature", self.succeed("verify", lens, "a.json", "--skip-invalid").stderr.decode())
        verified = json.loads(self.succeed("verify", lens, "a.json", "--skip-invalid", "--json").stdout)
        self.assertEqual((verified["features"], verified["without_axis"]), (2, 1))
        self.refuse("malformed", "verify", lens, "a.json")
        smooth = json.loads(self.succeed("smooth", lens, "--skip-invalid", "--exterior", "--json").stdout)
        self.assertLess(smooth["against"]["hausdorff"], 1)
        against = json.loads(self.succeed("rebuild", "a.json", "--against", lens, "--skip-invalid", "--json").stdout)
        self.assertLess(against["against"]["hausdorff"], 1e-9)
        self.assertEqual(against["against"]["without_axis"], 1)
        # What can be computed must be there.
        whole = json.loads(self.read("a.json"))
        for kept, missing in (whole["items"][:1], 2), (whole["items"][1:], 0), ([], 0):
            self.write("less.json", json.dumps({**whole, "items": kept}))
            for command in (["verify", lens, "less.json"], ["rebuild", "less.json", "--against", lens]):
                text = self.refuse("malformed", *command, "--skip-invalid", "--quiet")
                self.assertIn(f"less.json: has no axis of feature {missing} of lens.json", text)
        # Nor may there be more; the order does not count.
        turned = [{**item, "feature": number} for item, number in zip(whole["items"][::-1], (2, 0))]
        self.write("turned.json", json.dumps({**whole, "items": turned}))
        self.succeed("verify", lens, "turned.json", "--skip-invalid")
        shapes = json.loads(self.read(lens))
        self.write("fewer.json", json.dumps({**shapes, "items": shapes["items"][:2]}))
        for command in (["verify", "fewer.json", "a.json"], ["rebuild", "a.json", "--against", "fewer.json"]):
            self.assertIn("fewer.json: holds no shape of feature 2", self.refuse("malformed", *command, "--skip-invalid"))

    def test_nest_takes_the_first_features_that_can_be_computed(self):
        lens = json.loads(self.read(self.refused_in_the_middle()))
        def polygon(*points):
            return {"contours": [{"start": points[0], "pieces": [["line", *p] for p in (*points[1:], points[0])]}]}
        slot = polygon((0, 0), (60, 0), (60, 40), (42, 40), (38, 12), (22, 12), (18, 40), (0, 40))
        tee = polygon((0, 0), (14, 0), (17, 30), (45, 33), (45, 47), (-28, 47), (-28, 33), (-3, 30))
        self.write("tee.json", json.dumps({"medial": 2, "items": [tee]}))
        self.write("slot.json", json.dumps({"medial": 2, "items": [slot]}))
        self.write("late.json", json.dumps({"medial": 2, "items": [lens["items"][1], slot]}))
        nest = lambda *files: json.loads(self.succeed("nest", *files, "--skip-invalid", "--json").stdout)["placements"]
        self.assertEqual(nest("late.json", "tee.json"), nest("slot.json", "tee.json"))
        self.assertEqual(nest("tee.json", "late.json"), nest("tee.json", "slot.json"))
        done = self.succeed("nest", "late.json", "tee.json", "--skip-invalid")
        self.assertIn("late.json: note: 1 feature could not be computed", done.stderr.decode())
        self.assertIn("late.json: feature 0, ring 0", self.refuse("crossing", "nest", "tee.json", "late.json"))

    def test_nothing_may_be_left_to_compute(self):
        lens = json.loads(self.read(self.refused_in_the_middle()))
        self.write("alone.json", json.dumps({"medial": 2, "items": lens["items"][1:2]}))
        for name in self.supported("b.json", "b.geojson", "b.gpkg", "b.csv", "b.svg"):
            notes = self.succeed("axis", "alone.json", "--skip-invalid", "-o", name).stderr.decode()
            self.assertIn("1 feature could not be computed and was left out", notes)
        for name in self.supported("b.fgb", "b.geojson"):
            self.succeed("axis", "alone.json", "--skip-invalid", "--quiet", "-o", name)
            whole = self.read(name)
            self.succeed("axis", "alone.json", "--skip-invalid", "--quiet", "--parts", "-o", name)
            self.assertEqual(self.read(name), whole, name)
        for command, *more in (["carve", "--angle", "60"], ["compare"], ["pack", "-o", "t.mpk"],
                               ["match", "b.json"], ["nest", "alone.json"], ["measure", "--from", "0,0", "--to", "1,1"]):  # fmt: skip
            self.refuse("empty", command, "alone.json", "--skip-invalid", "--quiet", *more)
        # An option that suits no feature is no feature's fault.
        self.refuse("invalid_option", "axis", "b.json", "--tolerance", "1", "--skip-invalid")

    def test_unclosed_rings_are_noted(self):
        self.write("open.geojson", '{"type":"Polygon","coordinates":[[[0,0],[4,0],[4,2],[0,2]]]}')
        self.assertIn(b"1 ring does not end at its first point", self.succeed("axis", "open.geojson").stderr)

    def test_reference_systems(self):
        """The numbers count more than what a format says of them."""
        self.write("metres.geojson", '{"type":"Polygon","coordinates":[[[5e5,5e6],[500400,5e6],[500400,5000200],'
                   '[5e5,5000200],[5e5,5e6]]]}')
        done = self.succeed("axis", "metres.geojson", "-o", "a.json")
        self.assertIn(b"--crs EPSG:n", done.stderr)
        self.assertNotIn(b"--project", done.stderr)
        self.assertIn("--crs", self.refuse("invalid_option", "axis", "metres.geojson", "--project"))
        done = self.succeed("axis", "metres.geojson", "--crs", "EPSG:32632", "-o", "a.json")
        self.assertNotIn(b"not degrees", done.stderr)
        self.assertIn(b"UTM zone 32N", self.read("a.json"))
        for name in ("EPSG:99999999", "EPSG:32632x", "EPSG:5773", "EPSG:4978"):  # the last: heights, geocentric
            self.refuse("invalid_option", "axis", "metres.geojson", "--crs", name)

    def test_arcs_that_are_nearly_full_circles(self):
        """All that three points say of such an arc is in the gap between two of them."""
        for gap in (1e-3, 1e-6, 1e-8, 1e-12):
            half = gap / 2
            for x, y in ((-1, 0), (0.6, 0.8), (0.28, -0.96)):
                for ring in (f"CIRCULARSTRING(1 {half},{x} {y},1 {-half}),(1 {-half},1 {half})",
                             f"CIRCULARSTRING(1 {-half},{x} {y},1 {half}),(1 {half},1 {-half})"):
                    self.write("disc.wkt", f"CURVEPOLYGON(COMPOUNDCURVE({ring}))")
                    area = json.loads(self.succeed("info", "disc.wkt", "--json").stdout)["area"]
                    # The circle's centre is off by less than the square of the gap.
                    self.assertAlmostEqual(area, math.pi, delta=1e-13 + 9 * gap ** 2)
                    radius = json.loads(self.succeed("axis", "disc.wkt", "--json").stdout)["deepest"]["radius"]
                    self.assertAlmostEqual(radius, 1, delta=1e-13 + gap ** 2)

    def test_what_is_no_plane_is_no_reference_system(self):
        """Geocentric coordinates and heights: the same from an option and from every file."""
        axis = json.loads(self.succeed("axis", self.write("a.wkt", "POLYGON((0 0,4 0,4 2,0 2,0 0))"), "-o", "-").stdout)
        cartesian = ('GEODCRS["spinning",DATUM["d",ELLIPSOID["e",6378137,298]],CS[Cartesian,3],AXIS["(X)",geocentricX],'
                     'AXIS["(Y)",geocentricY],AXIS["(Z)",geocentricZ],LENGTHUNIT["metre",1]]')
        latitudes = cartesian[:cartesian.index("CS[")] + ('CS[ellipsoidal,2],AXIS["latitude",north],AXIS["longitude",east],'
                                                          'ANGLEUNIT["degree",0.0174532925199433]]')
        bound = [f'BOUNDCRS[SOURCECRS[{source}],TARGETCRS[{cartesian}],ABRIDGEDTRANSFORMATION["t",METHOD["Geocentric '
                 'translations (geocentric domain)"],PARAMETER["X-axis translation",1],PARAMETER["Y-axis translation",0],'
                 'PARAMETER["Z-axis translation",0]]]'
                 for source in (cartesian, latitudes)]
        for crs in ("EPSG:4978", "EPSG:4936", "EPSG:5773", cartesian, bound[0]):
            said = "has neither plane coordinates nor longitudes and latitudes"
            self.assertIn(said, self.refuse("invalid_option", "axis", "a.wkt", "--crs", crs))
            self.write("own.json", json.dumps({**axis, "crs": crs}))
            self.assertIn(said, self.refuse("unsupported", "axis", "own.json"))
            self.assertIn(said, self.refuse("unsupported", "prune", "own.json", "-o", "b.json"))
            self.write("shape.json", json.dumps({"medial": axis["medial"], "crs": crs, "items": [
                {"shape": axis["items"][0]["shape"]}]}))
            self.assertIn(said, self.refuse("unsupported", "axis", "shape.json"))
        self.write("a.geojson", '{"type":"Polygon","coordinates":[[[0,0],[4,0],[4,2],[0,0]]],'
                   '"crs":{"type":"name","properties":{"name":"EPSG:4978"}}}')
        self.assertIn(said, self.refuse("unsupported", "axis", "a.geojson"))
        self.succeed("axis", "a.geojson", "--crs", "EPSG:25832")
        for crs in ("EPSG:4326", latitudes, bound[1]):
            self.write("degrees.json", json.dumps({**axis, "crs": crs}))
            self.succeed("prune", "degrees.json", "-o", "c.json")
            self.succeed("axis", "a.wkt", "--crs", crs)

    def test_a_code_in_a_file_of_medial_is_a_reference_system(self):
        axis = json.loads(self.succeed("axis", self.write("a.wkt", "POLYGON((0 0,4 0,4 2,0 2,0 0))"), "-o", "-").stdout)
        self.write("coded.json", json.dumps({**axis, "crs": "EPSG:25832"}))
        self.succeed("prune", "coded.json", "-o", "a.geojson")
        self.assertIn(b"EPSG::25832", self.read("a.geojson"))
        self.write("bad.json", json.dumps({**axis, "crs": "nowhere"}))
        self.assertIn("nowhere", self.refuse("malformed", "prune", "bad.json", "-o", "b.geojson"))

    def test_what_is_no_shape_is_named(self):
        self.assertIn("directory", self.refuse("unreadable", "axis", "."))
        self.refuse("empty", "axis", "/dev/null")
        self.assertIn("--text", self.refuse("unsupported", "axis", self.write("a.ttf", b"\0\1\0\0" + bytes(60))))
        self.write("shape.txt", "POLYGON((0 0,4 0,4 2,0 2,0 0))")
        self.assertEqual(json.loads(self.succeed("axis", "shape.txt", "--json").stdout)["sites"], 4)

    def test_nothing_stays_nothing(self):
        """What commands write of no features, they read again."""
        self.write("a.wkt", RECTANGLE)
        for name in self.supported("n.geojson", "n.gpkg", "n.fgb", "n.shp"):
            self.succeed("offset", "a.wkt", "--distance", "9", "-o", name)
            self.assertIn("the file holds no feature", self.succeed("info", name).stderr.decode())
            self.succeed("axis", name, "--project", "-o", "n.json")
        self.succeed("axis", "n.json", "-o", "n.safetensors")
        for name in ("n.json", "n.safetensors"):
            self.assertEqual(json.loads(self.succeed("verify", name, name, "--json").stdout)["passed"], True)
            self.assertIn(b"medial axes         0", self.succeed("info", name).stdout)
            for command, *more in (["axis"], ["prune"], ["smooth"], ["rebuild"], ["features"], ["offset", "--distance", "1"],
                                   ["centreline"], ["draw"], ["measure"], ["axis", "--parts"],
                                   ["axis", "--method", "ridge"]):  # fmt: skip
                output = "b.svg" if command == "draw" else "b.geojson"
                said = self.succeed(command, name, *more, "-o", output).stderr.decode()
                self.assertEqual(said.count("the file holds no feature"), 1, (command, said))
                if command != "draw":
                    self.assertEqual(json.loads(self.read(output))["features"], [])
            for command, *more in (["match", name], ["nest", name], ["compare"], ["carve", "--angle", "60"], ["voronoi"]):
                self.refuse("empty", command, name, "--quiet", *more)
        self.assertIn("no feature with a geometry", self.refuse("empty", "axis", self.write("none.geojson",
            '{"type":"FeatureCollection","features":[{"type":"Feature","properties":{},"geometry":null}]}')))  # fmt: skip
        self.assertIn("no polygon", self.refuse("empty", "axis", self.write("none.wkt", "POLYGON EMPTY")))
        self.assertIn("no geometry", self.refuse("empty", "axis", self.write("none.wkt", "")))

    def test_nothing_is_written_beside_inputs(self):
        text = gzip.compress(GEOGRAPHIC.encode())
        self.write("a.geojson.gz", text)
        self.succeed("axis", "a.geojson.gz")
        self.assertEqual(self.files(), ["a.geojson.gz"])

    def test_drawings_from_a_pipe(self):
        self.skip_without("DXF")
        self.write("a.wkt", "POLYGON((0 0,4 0,4 3,0 3,0 0))")
        self.succeed("rebuild", "a.wkt", "-o", "a.dxf")
        for drawing in (self.read("a.dxf"), b"999\na comment\n" + self.read("a.dxf")):
            report = json.loads(self.succeed("info", "-", "--json", given=drawing).stdout)
            self.assertAlmostEqual(report["area"], 12)

    def test_options_of_drawings(self):
        self.skip_without("DXF")
        lines = "0 SECTION 2 ENTITIES 0 LINE 8 A 10 0 20 0 11 4 21 0 0 LINE 8 A 10 4 20 0 11 4 21 3 "
        lines += "0 LINE 8 A 10 4 20 3 11 0 21 0.1 0 ENDSEC 0 EOF"
        self.write("open.dxf", lines.replace(" ", "\n") + "\n")
        self.assertIn("--close=GAP", self.refuse("empty", "info", "open.dxf"))
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
        few, many = (json.loads(self.succeed("axis", "--text", "Rg&8", "--font", font, *angle, "--json").stdout)
                     for angle in ([], ["--corner-angle", "0.01"]))
        self.assertLess(few["branches"], 40)
        self.assertGreater(many["branches"], 60)
        self.succeed("axis", "--text", "Rg&8", "--font", font, "-o", "b.json")
        self.succeed("verify", "--text", "Rg&8", "--font", font, "b.json")
        self.refuse("invalid_option", "axis", "--text", "i")
        self.refuse("invalid_option", "axis", "--font", font)
        self.refuse("invalid_option", "axis")
        self.refuse("invalid_option", "axis", "a.wkt", "--text", "i", "--font", font)
        self.assertIn("no such font", self.refuse("unreadable", "axis", "--text", "i", "--font", "DejaVu Snas"))
        # A letter H of an em of 10 mm; as high as its font says, 1493 of 2048.
        self.succeed("axis", "--text", "H", "--font", font, "--font-size", "10", "--units", "mm", "-o", "h.csv")
        heights = [float(row["y"]) for row in self.rows(self.read("h.csv"))]
        self.assertAlmostEqual(max(heights) - min(heights), 10 * 1493 / 2048)
        self.assertEqual(self.rows(self.read("h.csv"))[0]["unit"], "mm")
        self.refuse("invalid_option", "axis", "a.wkt", "--font-size", "10")

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
        self.write("line.wkt", "LINESTRING (0 0, 5 0, 5 5)")
        for lines in ("wells.csv", "line.wkt"):
            error = self.refuse("unsupported", "axis", lines)
            self.assertIn("no polygons", error)
            self.assertIn("medial voronoi", error)
        self.write("square.wkt", "POLYGON ((0 0, 9000 0, 9000 9000, 0 9000, 0 0))")
        self.succeed("axis", "square.wkt", "-o", "layers.gpkg")
        self.assertIn("--layer chooses among axis, nodes", self.refuse("unsupported", "axis", "layers.gpkg"))
        # Geometries in a column, by name and from a pipe.
        square = '"POLYGON((0 0,4 0,4 3,0 3,0 0))"'
        for text in (f"id,WKT\n1,{square}\n", f"WKT,i,s\n{square},0,a\n", f"name,WKT\na,{square}\n"):
            self.write("column.csv", text)
            for done in (self.succeed("info", "column.csv", "--json"),
                         self.succeed("info", "-", "--json", given=text.encode())):
                self.assertEqual(json.loads(done.stdout)["area"], 12)
        # What names no encoding; the geometry is no attribute.
        self.write("latin.csv", f"name,wkt\nZürich €,{square}\n".encode("cp1252"))
        done = self.succeed("rebuild", "latin.csv", "-o", "latin.geojson")
        self.assertIn(b"Windows-1252", done.stderr)
        self.assertEqual(json.loads(self.read("latin.geojson"))["features"][0]["properties"], {"name": "Zürich €"})
        piped = self.succeed("voronoi", "-", "--json", given=self.read("wells.csv"))
        self.assertEqual(json.loads(piped.stdout)["points"], 3)
        # Filters name fields and values as outputs have them.
        self.write("f.geojson", json.dumps({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {"gr__e": size, "name": name}, "geometry": {
                "type": "Polygon", "coordinates": [[[x, 0], [x + 4, 0], [x + 4, 2], [x, 0]]]}}
            for x, size, name in ((0, 1, "Bonn"), (10, 5, "K_ln"))]}))
        self.succeed("rebuild", "f.geojson", "-o", "f.shp")
        os.remove(self.path("f.cpg"))
        plain = self.read("f.dbf").replace(b"K_ln", "Köln".encode("cp1252"))
        for table in (plain, plain.replace(b"gr__e", "größe".encode("cp1252"))):
            self.write("f.dbf", table)
            named = "größe" if table != plain else "gr__e"
            # The last is in the table's encoding already.
            for condition in (named + " > 3", "name = 'Köln'", os.fsdecode("name = 'Köln'".encode("cp1252"))):
                self.succeed("rebuild", "f.shp", "--where", condition, "-o", "g.geojson")
                features = json.loads(self.read("g.geojson"))["features"]
                self.assertEqual([(f["properties"][named], f["properties"]["name"]) for f in features], [(5, "Köln")])
            # Windows-1252 lacks a letter of it.
            self.assertIn("no feature passes", self.refuse("empty", "axis", "f.shp", "--where", "name = 'Köłln'"))
        self.write("names.txt", "x y\nwords only\n")
        self.refuse("malformed", "axis", "names.txt")
