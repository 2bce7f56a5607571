"""`medial compare` and `medial legal`."""

import json

from support import FRAME, CommandLine


class Compare(CommandLine):
    def test_compare(self):
        """Every method that takes the input takes part."""
        self.write("island.wkt", "POLYGON((0 0,10 0,14 5,10 9,4 8,0 6))")
        report = json.loads(self.succeed("compare", "island.wkt", "--json").stdout)["features"][0]
        self.assertEqual([row["method"] for row in report],
                         ["disks", "biarc-dc", "lee", "ridge", "brushfire", "potential", "curve-axis"])
        self.assertLess(report[-1]["hausdorff"], 1e-9)
        table = self.succeed("compare", "island.wkt").stdout.decode().splitlines()
        self.assertTrue(table[1].endswith("yes: disks, graph, cover"), table)
        self.assertRegex(table[5], r"brushfire .* yes: radii, graph; up to \S+ away$")
        for row in report[:3]:
            self.assertEqual(row["verified"], ["disks", "graph", "cover"])
            self.assertTrue(row["passed"], row)
            self.assertLess(row["hausdorff"], 1e-9)
        report = json.loads(self.succeed("compare", "island.wkt", "--fit", "0.5", "--methods", "disks,curve-axis",
                                         "--arc-tolerance", "1e-9", "--json", "-o", "both.svg").stdout)["features"][0]
        self.assertEqual(report[0]["branches"], report[1]["branches"])
        self.assertLess(report[1]["largest_distance"], 1e-5)
        picture = self.read("both.svg")
        self.assertTrue(picture.startswith(b"<?xml"))
        self.assertEqual(picture.count(b"#glyph"), len("disks" + "curve-axis"))  # letters
        self.assertIn("magic not in {all,disks,", self.refuse("invalid_option", "compare", "island.wkt", "--methods", "magic"))

    def test_failures_set_the_exit_status(self):
        """A method that does not take the input fails only where it was asked for by name."""
        self.write("frame.wkt", FRAME)
        report = json.loads(self.succeed("compare", "frame.wkt", "--json").stdout)["features"][0]
        self.assertEqual(next(row for row in report if row["method"] == "curve-axis")["cycles"], 1)
        self.write("cusp.svg", '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0,0C4,0 4,3 2,3C0,3 2,0 0,0Z"/></svg>')
        report = json.loads(self.succeed("compare", "cusp.svg", "--json").stdout)["features"][0]
        self.assertIn("refused", next(row for row in report if row["method"] == "curve-axis"))
        self.assertEqual(self.run_medial("compare", "cusp.svg", "--methods", "disks,curve-axis").returncode, 1)
        self.assertEqual(self.run_medial("compare", "cusp.svg", "--methods", "disks").returncode, 0)
        # Holes closer to each other than pixels are one to brushfire: a note, no failure.
        self.write("near.wkt", "POLYGON((0 0,100 0,100 60,0 60),(50 20,70 20,70 40,50 40),"
                               "(70.01 20,90 20,90 40,70.01 40))")
        report = json.loads(self.succeed("compare", "near.wkt", "--methods", "disks,ridge,brushfire",
                                         "--json").stdout)["features"][0]
        self.assertEqual([row["passed"] for row in report], [True, True, False])
        self.assertEqual([row["unresolved"] for row in report], [False, False, True])


class Legal(CommandLine):
    def test_legal(self):
        """The axis of a shape is legal; a radius that grows faster than the way is not, and is named."""
        self.write("frame.wkt", FRAME)
        self.succeed("axis", "frame.wkt", "-o", "frame.json")
        report = json.loads(self.succeed("legal", "frame.json", "--json").stdout)
        self.assertTrue(report["legal"])
        self.assertEqual(report["judged"], report["legal_branches"])
        self.assertGreater(report["judged"], 0)
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

    def test_curvature(self):
        """Straight edges have no curvature; the comb is a picture."""
        self.write("stadium.wkt", "CURVEPOLYGON(COMPOUNDCURVE((0 0,8 0),CIRCULARSTRING(8 0,10 2,8 4),(8 4,0 4),"
                                  "CIRCULARSTRING(0 4,-2 2,0 0)))")
        self.succeed("axis", "stadium.wkt", "-o", "stadium.json")
        self.succeed("legal", "stadium.json", "--slack", "1e-6", "--curvature", "k.csv")
        lines = self.read("k.csv").decode().splitlines()
        self.assertEqual(lines[0], "feature,branch,side,axis_x,axis_y,r,x,y,curvature,slope")
        self.assertGreater(len(lines), 10)
        for line in lines[1:]:
            curvature, slope = map(float, line.split(",")[-2:])
            self.assertAlmostEqual(curvature, 0, delta=1e-6)
            self.assertAlmostEqual(slope, 0, delta=1e-6)
        self.succeed("legal", "stadium.json", "--slack", "1e-6", "--curvature", "comb.svg")
        self.assertIn(b"<svg", self.read("comb.svg"))
        self.refuse("unsupported", "legal", "stadium.json", "--curvature", "comb.doc")
