"""`medial axis --method`: each method, its options and its limits."""

import json
import os
import re

from support import DATA, FRAME, CommandLine, comb


class Methods(CommandLine):
    def test_table(self):
        """The documents hold the table that the program prints, and it says what each method refuses."""
        with open(os.path.join(DATA, "..", "docs", "README.md"), encoding="utf-8") as file:
            documented = re.sub(r"\[([a-z-]+)\]\([^)]*\)", r"\1", file.read())
        table = self.succeed("methods").stdout.decode()
        self.assertIn(table, documented)
        self.write("ring.wkt", FRAME)
        self.write("plain.wkt", "POLYGON((0 0,10 0,14 5,10 9,4 8,0 6,0 0))")
        for method in json.loads(self.succeed("methods", "--json").stdout)["methods"]:
            self.assertIn(f"| {method['name']} |", table)
            if not method["exterior"]:
                text = self.refuse("invalid_option", "axis", "plain.wkt", "--exterior", "--skip-invalid", "--method", method["name"])
                self.assertIn(f"the method {method['name']} does not compute the exterior", text)
            if not method["exact"]:
                self.refuse("invalid_option", "axis", "plain.wkt", "--exact", "--method", method["name"])

    def test_methods(self):
        """Both methods find the same axis, of shapes with holes, too."""
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
        self.succeed("axis", "ring.wkt", "--method", "biarc-dc", "-o", "ring.json")
        self.succeed("verify", "ring.wkt", "ring.json")
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
        self.write("convex.wkt", "POLYGON((0 0,10 0,14 5,10 9,4 8,0 6,0 0))")
        for shape, method in (("convex.wkt", "lee"), ("teeth.wkt", "disks"), ("ring.wkt", "disks"), ("half.svg", "disks")):
            self.succeed("axis", shape, "--method", "auto", "-o", "auto.json")
            self.assertEqual(json.loads(self.succeed("info", "auto.json", "--json").stdout)["method"], method)
        if not self.lacks("exact decisions"):
            self.succeed("axis", "convex.wkt", "--method", "auto", "--exact", "-o", "auto.json")
            self.assertEqual(json.loads(self.succeed("info", "auto.json", "--json").stdout)["method"], "disks")
        self.succeed("axis", "ring.wkt", "--method", "lee", "-o", "ring.json")
        self.succeed("verify", "ring.wkt", "ring.json")
        self.succeed("axis", "half.svg", "--method", "lee", "-o", "half.json")
        self.succeed("verify", "half.svg", "half.json")

    def test_ridge_and_exterior(self):
        """Ridge following and the exterior, with their options and what verify finds."""
        self.write("frame.wkt", FRAME)
        for rule in ("crossing", "difference"):
            report = []
            for search in ("tree", "sorted-list"):
                self.succeed("axis", "frame.wkt", "--method", "ridge", "--pixels", "60", "--ridge-rule", rule,
                             "--ridge-search", search, "--ridge-collinear", "0", "-o", search + ".json")
                report.append(self.read(search + ".json").split(b'"statistics"')[0])
            self.assertEqual(report[0], report[1])
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
        self.assertIn("not brushfire",
                      self.refuse("invalid_option", "axis", "frame.wkt", "--method", "brushfire", "--exact"))
        self.refuse("invalid_option", "axis", "frame.wkt", "--seed", "7")
        self.refuse("too_large", "axis", "frame.wkt", "--method", "ridge", "--resolution", "1e-9")
        self.refuse("invalid_option", "axis", "frame.wkt", "--method", "ridge", "--pixels", "9", "--resolution", "1")
        self.refuse("invalid_option", "axis", "frame.wkt", "--exterior", "--margin", "0")

    def test_curve_axis(self):
        """Curves, corners and holes are followed; what the method does not follow is fitted on request."""
        self.write("ellipse.svg", '<svg xmlns="http://www.w3.org/2000/svg">'
                                  '<ellipse cx="20" cy="10" rx="18" ry="8"/></svg>')
        self.succeed("axis", "ellipse.svg", "--method", "curve-axis", "-o", "curve.json")
        report = json.loads(self.succeed("info", "curve.json", "--json").stdout)
        self.assertEqual(report["method"], "curve-axis")
        self.assertEqual(report["nodes"]["leaf"], 2)
        self.assertAlmostEqual(report["length"], 2 * (18 - 64 / 18), places=6)  # between the centres of curvature
        self.succeed("legal", "curve.json")
        self.write("frame.wkt", "POLYGON((0 0,10 0,10 8,0 8,0 0),(3 3,6 3.5,5 6,3.2 5,3 3))")
        for exterior in ([], ["--exterior"]):
            self.succeed("axis", "frame.wkt", *exterior, "--method", "curve-axis", "-o", "frame.json")
            self.succeed("verify", "frame.wkt", "frame.json")
        self.write("cusp.svg", '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0,0C4,0 4,3 2,3C0,3 2,0 0,0Z"/></svg>')
        text = self.refuse("unsupported", "axis", "cusp.svg", "--method", "curve-axis", "-o", "t.json")
        self.assertIn("cusp", text)
        fit = re.search(r"--fit ([0-9.]+)", text).group(1)
        self.succeed("axis", "cusp.svg", "--method", "curve-axis", "--fit", fit, "-o", "t.json")
        self.assertEqual(self.run_medial("legal", "t.json").returncode, 0)
        self.write("speck.wkt", "POLYGON((0 0,40 0,40 30,0 30,0 0),(0.5 12,0.5 13,1.5 13,1.5 12,0.5 12))")
        note = self.succeed("axis", "speck.wkt", "--method", "curve-axis", "--fit", "1", "-o", "t.json").stderr
        self.assertIn(b"1 loop within a disk as large as --fit is left out", note)

    def test_a_note_names_the_pixels_that_do(self):
        """A frame with a hole smaller than a pixel, by both methods of pixels."""
        self.write("speck.wkt", "POLYGON ((0 0, 90 0, 90 60, 0 60, 0 0),"
                                " (30.2 20.2, 30.2 20.8, 30.8 20.8, 30.8 20.2, 30.2 20.2))")
        for method in ("ridge", "brushfire"):
            coarse = self.succeed("axis", "speck.wkt", "--method", method, "--pixels", "30", "-o", "a.json")
            note = coarse.stderr.decode()
            self.assertIn("the grid does not resolve 1 of the shape's parts or holes; --pixels ", note)
            self.assertEqual(self.run_medial("verify", "speck.wkt", "a.json").returncode, 1)
            pixels = note.split("--pixels ")[1].split()[0]
            fine = self.succeed("axis", "speck.wkt", "--method", method, "--pixels", pixels, "-o", "b.json")
            self.assertNotIn("does not resolve", fine.stderr.decode())
            self.succeed("verify", "speck.wkt", "b.json")

