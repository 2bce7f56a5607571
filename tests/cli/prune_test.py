"""`medial prune` and `medial smooth`."""

import json

from support import FRAME, CommandLine


class Prune(CommandLine):
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
            report = json.loads(self.succeed("rebuild", name, "--against", "frame.wkt", "--json", "--quiet").stdout)
            self.assertLess(report["against"]["hausdorff"], 1e-12)
        self.succeed("prune", "frame.wkt", "--radius", "0.5", "-o", "cut.json")
        for name in self.supported("b.json", "b.wkt", "b.dxf"):  # with arcs
            self.succeed("rebuild", "cut.json", "-o", name)
            report = json.loads(self.succeed("rebuild", name, "--against", "b.json", "--json").stdout)
            self.assertLess(report["against"]["hausdorff"], 1e-9)
        report = json.loads(self.succeed("rebuild", "frame.wkt", "--tangents", "--points", "500", "--json",
                                         "--against", "frame.wkt").stdout)
        self.assertLess(report["against"]["hausdorff"], 0.1)
        self.assertGreater(report["medial_points"], 400)
        self.assertRegex(self.succeed("rebuild", "frame.wkt", "--against", "b.wkt").stdout,
                         rb"hausdorff +0\.\d+ at \(\d\S*, \d\S*\)\n")
        self.succeed("rebuild", "frame.wkt", "--pixels", "100", "-o", "disks.png")
        self.assertEqual(self.read("disks.png")[1:4], b"PNG")
        self.refuse("invalid_option", "rebuild", "frame.wkt", "--pixels", "100")
        self.refuse("unsupported", "rebuild", "frame.wkt", "-o", "x.csv")

    def test_files_know_their_corner_angle(self):
        """Joints that count as smooth come back from a file, without a word about the angle."""
        self.write("blunt.wkt", "CURVEPOLYGON(COMPOUNDCURVE((0 -1,4 -1),CIRCULARSTRING(4 -1,4.69948 -.69948,5 0),"
                   "CIRCULARSTRING(5 0,4.69948 .69948,4 1),(4 1,0 1),CIRCULARSTRING(0 1,-.69948 .69948,-1 0),"
                   "CIRCULARSTRING(-1 0,-.69948 -.69948,0 -1)))")
        self.succeed("axis", "blunt.wkt", "--corner-angle", "4", "-o", "a.json")
        self.succeed("verify", "a.json", "a.json")
        report = json.loads(self.succeed("rebuild", "a.json", "--against", "blunt.wkt", "--json").stdout)
        self.assertLess(report["against"]["hausdorff"], 1e-12)
        self.refuse("malformed", "info", "-", given=b'{"medial":1,"corner_angle":11,"items":[]}')

    def test_prune_and_smooth_by_what_matters(self):
        """Measures, numbers of branches, tips, previews; two bumps of one size are distinguished."""
        bumps = ("POLYGON((0 -4,10 -1,14 -1,24 -4,24 4,14 1,12.4 1,12.4 1.6,11.6 1.6,11.6 1,10 1,0 4,0 .4,"
                 "-.6 .4,-.6 -.4,0 -.4))")
        self.write("bumps.wkt", bumps)
        report = json.loads(self.succeed("smooth", "bumps.wkt", "--significance", "0.5", "-o", "calm.wkt",
                                         "--json").stdout)
        self.assertEqual(report["measure"], "significance")
        self.assertRegex(self.succeed("smooth", "bumps.wkt").stdout, rb"measure +prominence\n")
        self.assertLess(report["branches"], report["branches_before"])
        text = self.read("calm.wkt").decode()
        self.assertIn("1.6", text)            # the bump in the waist stays
        self.assertNotIn("-0.6 0.4", text)    # the one on the broad side goes
        self.assertLess(report["against"]["area_error"], 0)
        for options in (["--keep", "3"], ["--keep", "3", "--tips"], ["--by", "scale-axis"], ["--lambda", "0.2"], []):
            few = json.loads(self.succeed("prune", "bumps.wkt", "--json", "-o", "few.json", *options).stdout)
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

        def rings_of(command, *options):
            self.succeed(command, "specks.wkt", "-o", "rest.json", *options)
            report = json.loads(self.succeed("info", "rest.json", "--json").stdout)
            shape = report.get("shape", report)
            return shape["components"], shape["holes"]

        for command in ("prune", "smooth"):
            self.assertEqual(rings_of(command), (2, 2))
            self.assertEqual(rings_of(command, "--specks"), (1, 1))
            self.assertEqual(rings_of(command, "--specks=0.01"), (2, 2))
            self.assertEqual(rings_of(command, "--specks=0.5"), (1, 0))
        self.succeed("axis", "specks.wkt", "-o", "stored.json")
        self.succeed("prune", "stored.json", "--specks", "-o", "rest.json")
        self.assertEqual(json.loads(self.succeed("info", "rest.json", "--json").stdout)["shape"]["holes"], 1)
        self.refuse("invalid_option", "prune", "specks.wkt", "--specks=2")

    def test_pipe_from_axis_to_shape(self):
        """medial axis x.svg -o - | medial prune - --angle 60 -o - | medial rebuild - -o y.svg"""
        self.write("x.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="90" height="50">'
                            '<path d="M 10 10 H 80 V 30 L 60 31 L 40 30 H 10 Z"/></svg>')
        axis = self.succeed("axis", "x.svg", "-o", "-").stdout
        pruned = self.succeed("prune", "-", "--angle", "60", "-o", "-", given=axis).stdout
        self.succeed("rebuild", "-", "-o", "y.svg", given=pruned)
        report = json.loads(self.succeed("rebuild", "-", "--json", given=pruned).stdout)
        again = json.loads(self.succeed("rebuild", "y.svg", "--json").stdout)
        self.assertAlmostEqual(report["area"], again["area"], delta=1e-6 * report["area"])
        self.assertEqual(report["vertices"], again["vertices"])
        # What 60 degrees keep: the corners, but not the vertex of nearly 180 that bulges out.
        area = json.loads(self.succeed("rebuild", "x.svg", "--json").stdout)["area"]
        self.assertLess(report["area"], area)
        self.assertGreater(report["area"], 0.99 * area)
        self.assertLess(len(json.loads(pruned)["items"][0]["axis"]["edges"]),
                        len(json.loads(axis)["items"][0]["axis"]["edges"]))
