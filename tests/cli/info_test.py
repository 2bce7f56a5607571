"""`medial info`."""

import json
import math

from support import BOW_TIE, FRAME, GEOGRAPHIC, RECTANGLE, CommandLine, comb, star


class Info(CommandLine):
    def test_polygons(self):
        self.write("frame.wkt", FRAME.replace("9 0,", "9 0, 9 0, 9 3,"))
        report = json.loads(self.succeed("info", "frame.wkt", "--json").stdout)
        self.assertEqual(report["kind"], "polygons")
        self.assertEqual((report["features"], report["rings"], report["holes"]), (1, 2, 1))
        self.assertEqual(report["vertices"], 8)
        self.assertEqual(report["extent"], [0, 0, 9, 6])
        self.assertEqual(report["area"], 48)
        self.assertEqual(report["cleaned"]["repeated_points"], 1)
        self.assertEqual(report["cleaned"]["collinear_points"], 1)
        text = self.succeed("info", "frame.wkt").stdout.decode()
        for word in ("features", "holes", "vertices", "extent", "1 repeated point", "valid"):
            self.assertIn(word, text)

    def test_contours_state_no_direction_and_no_closing_point(self):
        self.write("s.svg", '<svg xmlns="http://www.w3.org/2000/svg">'
                            '<path fill-rule="evenodd" d="M0 0V4H4V0z M1 1V3H3V1z"/></svg>')
        self.assertRegex(self.succeed("info", "s.svg").stdout, rb"cleaned +nothing\n")
        cleaned = json.loads(self.succeed("info", "s.svg", "--json").stdout)["cleaned"]
        self.assertEqual(cleaned["unclosed_rings"], 2)

    def test_coordinate_system(self):
        self.write("places.geojson", GEOGRAPHIC)
        report = json.loads(self.succeed("info", "places.geojson", "--json").stdout)
        self.assertTrue(report["geographic"])
        self.assertIn("84", report["crs"])

    def test_an_axis(self):
        self.write("rectangle.wkt", RECTANGLE)
        self.succeed("axis", "rectangle.wkt", "-o", "a.json")
        report = json.loads(self.succeed("info", "a.json", "--json").stdout)
        self.assertEqual(report["kind"], "axis")
        self.assertEqual(report["nodes"], {"leaf": 4, "site_change": 0, "branching": 2})
        self.assertEqual((report["edges"], report["branches"]), (5, 5))
        self.assertAlmostEqual(report["length"], 4 * math.sqrt(2) + 2, delta=1e-12)
        self.assertAlmostEqual(report["deepest"]["radius"], 1, delta=1e-14)
        self.assertEqual(report["method"], "disks")
        self.assertGreater(report["tolerance"], 0)
        text = self.succeed("info", "a.json").stdout.decode()
        for word in ("4 leaves", "2 branchings", "deepest disk", "disks", "tolerance", "length"):
            self.assertIn(word, text)

    def test_branches_are_counted_as_they_are_written(self):
        self.write("shapes.wkt", FRAME + "\n" + comb(30) + "\n" + star(100))
        self.succeed("axis", "shapes.wkt", "-o", "a.json")
        self.succeed("axis", "shapes.wkt", "-o", "a.geojson")
        report = json.loads(self.succeed("info", "a.json", "--json").stdout)
        features = json.loads(self.read("a.geojson"))["features"]
        lines = [f for f in features if f["geometry"]["type"] == "LineString"]
        self.assertEqual(report["branches"], len(lines))

    def test_an_axis_from_a_pipe(self):
        self.write("rectangle.wkt", RECTANGLE)
        stored = self.succeed("axis", "rectangle.wkt", "-o", "-", "--format", "json").stdout
        report = json.loads(self.succeed("info", "-", "--json", given=stored).stdout)
        self.assertEqual(report["kind"], "axis")

    def test_shapes_in_the_own_format(self):
        self.write("rectangle.wkt", RECTANGLE)
        self.succeed("rebuild", "rectangle.wkt", "-o", "s.json")
        report = json.loads(self.succeed("info", "s.json", "--json").stdout)
        self.assertEqual((report["kind"], report["area"]), ("polygons", 8))

    def test_invalid_polygons(self):
        self.write("bow.wkt", BOW_TIE)
        self.refuse("crossing", "info", "bow.wkt")
