"""`medial carve`."""

import json
import math
import os
import subprocess

from support import DATA, FRAME, CommandLine, comb, star


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
        """A slot with round ends around a round post: the G-code's own arcs, simulated on a height map."""
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
        self.assertTrue(self.read("c.csv").startswith(b"path,kind,x,y,z,unit\n"))
        report = json.loads(self.succeed("carve", "s.wkt", "--angle", "90", "--json").stdout)
        self.assertAlmostEqual(report["deepest"], 4)

    def test_what_cannot_be_done_is_refused(self):
        self.write("s.wkt", self.SQUARE)
        self.refuse("invalid_option", "carve", "s.wkt", "--units", "mm")
        self.refuse("invalid_option", "carve", "s.wkt", "--units", "mm", "--angle", "0")
        self.refuse("invalid_option", "carve", "s.wkt", "--units", "mm", "--angle", "175")
        self.refuse("invalid_option", "carve", "s.wkt", "--units", "mm", "--angle", "90", "--tool", "1", "--tip", "2")
        self.refuse("unsupported", "carve", "s.wkt", "--angle", "90", "-o", "c.stl")

    def lines(self, name):
        return self.read(name).decode().splitlines()

    def test_the_header_says_what_is_cut(self):
        self.write("s.wkt", self.SQUARE)
        self.succeed("carve", "s.wkt", "--angle", "60", "--depth", "3", "--units", "mm", "-o", "s.nc")
        header = [line for line in self.lines("s.nc") if line.startswith("(")]
        self.assertEqual(header[:3], ["(medial carve: s)", "(units: mm, z 0 on the surface)",
                                      "(tool 1: V of 60 degrees, depth 3 in 2 passes)"])
        deep = 3 * math.tan(math.pi / 6)
        self.assertRegex(header[3], r"^\(bounds: X [0-9.]+ to [0-9.]+, Y [0-9.]+ to [0-9.]+, Z -3 to 5\)$")
        self.assertRegex(header[4], r"about \d+ min \d+ s\)$")
        # The time is that of the moves.
        report = json.loads(self.succeed("carve", "s.wkt", "--angle", "60", "--depth", "3", "--units", "mm",
                                         "--json").stdout)
        seconds, feed = 0, 0
        for kind, before, after, words in self.moves("s.nc"):
            feed = words.get("F", feed)
            way = math.dist([before[a] for a in "XYZ"], [after[a] for a in "XYZ"])
            if kind > 1:
                way = sum(math.dist(a, b) for a, b in zip(self.places((kind, before, after, words), 0.01),
                                                          self.places((kind, before, after, words), 0.01)[1:]))
            seconds += 60 * way / (3000 if kind == 0 else feed)
        self.assertAlmostEqual(report["seconds_cutting"], seconds, delta=0.02 * seconds + 1)
        self.assertGreater(report["cut_length"], 4 * deep)

    def test_origin_and_inches(self):
        self.write("s.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="2in" viewBox="0 0 40 20">'
                            '<rect x="10" y="5" width="20" height="10"/></svg>')
        for origin, low, high in ((None, (0, 0), (1, 0.5)), ("lower-left", (0, 0), (1, 0.5)),
                                  ("upper-right", (-1, -0.5), (0, 0)), ("center", (-0.5, -0.25), (0.5, 0.25)),
                                  ("0,1", (0.5, 0.25), (1.5, 0.75))):
            for unit, scale in (("in", 1), ("mm", 25.4)):
                place = origin if origin != "0,1" or unit == "in" else "0,25.4"
                options = ["--origin", place] if place else []
                self.succeed("carve", "s.svg", "--angle", "90", "--output-units", unit, *options, "-o", "s.nc")
                self.assertEqual([line for line in self.lines("s.nc") if line.startswith("G2")][0][:3],
                                 "G20" if unit == "in" else "G21")
                ends = [after for kind, _, after, _ in self.moves("s.nc") if kind == 1]
                for axis, i in (("X", 0), ("Y", 1)):
                    self.assertAlmostEqual(min(end[axis] for end in ends), scale * low[i], 5)
                    self.assertAlmostEqual(max(end[axis] for end in ends), scale * high[i], 5)
        self.refuse("invalid_option", "carve", "s.svg", "--angle", "90", "--origin", "middle")
        self.refuse("invalid_option", "carve", "s.svg", "--angle", "90", "--output-units", "cm")

    def test_passes_take_no_long_ways(self):
        spanner = os.path.join(DATA, "spanner.svg")
        for options in ([], ["--pass-depth", "0.2"], ["--scale", "3.7795", "--pass-depth", "1"], ["--tip", "0.5"]):
            report = json.loads(self.succeed("carve", spanner, "--angle", "60", *options, "--json").stdout)
            self.assertLessEqual(report["cut_length"] + report["travel_length"], 2 * report["passes_length"], options)

    def test_an_end_mill_clears_before(self):
        self.write("s.wkt", "POLYGON ((0 0, 40 0, 40 30, 0 30, 0 0))")
        common = ["carve", "s.wkt", "--units", "mm", "--angle", "60", "--depth", "3"]
        self.succeed(*common, "-o", "alone.nc")
        self.succeed(*common, "--clear-tool", "6", "--clear-feed", "1500", "--clear-spindle", "12000",
                     "--spindle", "18000", "--post", "linuxcnc", "-o", "both.nc")
        lines = self.lines("both.nc")
        tools = [i for i, line in enumerate(lines) if line.startswith("T")]
        self.assertEqual([lines[i][:5] for i in tools], ["T1 M6", "T2 M6"])
        self.assertEqual([line for line in lines if line.startswith("M3")], ["M3 S12000", "M3 S18000"])
        self.assertTrue(any("F1500" in line for line in lines[tools[0]:tools[1]]))
        self.assertFalse(any("F1500" in line for line in lines[tools[1]:]))
        self.assertLess(len(lines), len(self.lines("alone.nc")))
        self.refuse("invalid_option", "carve", "s.wkt", "--units", "mm", "--angle", "60", "--clear-tool", "6")
        self.refuse("invalid_option", *common, "--clear-feed", "100")

    def test_a_tool_that_fits_nowhere(self):
        """No program without a cut; the error says what to do."""
        self.write("slot.wkt", "POLYGON ((0 0, 10 0, 10 1, 0 1, 0 0))")
        for quiet in ([], ["--quiet"]):
            said = self.refuse("empty", "carve", "slot.wkt", "--units", "mm", "--angle", "0", "--tool", "5", "--depth",
                               "1", "-o", "s.nc", *quiet)
            self.assertIn("the tool fits nowhere in the shape; use a smaller --tool", said)
        self.assertNotIn("s.nc", self.files())
        self.write("wide.wkt", "POLYGON ((0 0, 30 0, 30 4, 0 4, 0 0))")
        cleared = self.succeed("carve", "wide.wkt", "--units", "mm", "--angle", "60", "--tip", "5", "--tool", "6", "--depth",
                               "1", "--clear-tool", "2", "-o", "s.nc")
        self.assertIn(b"only the mill of --clear-tool cuts", cleared.stderr)

    def test_circles_are_cut_by_going_straight_down(self):
        """Beside other shapes and alone; a hole as wide as the mill is drilled."""
        self.write("c.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="60mm" viewBox="0 0 60 40">'
                            '<circle cx="20" cy="20" r="8"/><rect x="40" y="10" width="10" height="20"/></svg>')
        self.succeed("carve", "c.svg", "--angle", "60", "--origin", "drawing", "-o", "c.nc")
        deep = 8 / math.tan(math.pi / 6)
        down = [move for move in self.moves("c.nc") if (move[2]["X"], abs(move[2]["Y"])) == (20, 20) and move[0] == 1]
        self.assertAlmostEqual(min(move[2]["Z"] for move in down), -deep, 5)
        self.assertEqual({(move[1]["X"], move[1]["Y"]) for move in down}, {(down[0][2]["X"], down[0][2]["Y"])})
        self.assertTrue(all(move[3].get("F", 300) == 300 for move in down))
        self.write("h.wkt", "CURVEPOLYGON (CIRCULARSTRING (0 0, 3 0, 0 0))\nCURVEPOLYGON (CIRCULARSTRING (9 0, 11 0, 9 0))")
        done = self.succeed("carve", "h.wkt", "--units", "mm", "--angle", "0", "--tool", "3", "--depth", "2", "-o", "h.nc")
        self.assertEqual({(move[2]["X"], move[2]["Z"]) for move in self.moves("h.nc") if move[0] == 1 and
                          move[2]["Z"] < -1.9}, {(1.5, -2)})
        self.assertIn(b"1 of 2 parts is narrower than the tool", done.stderr)

    def test_notes_and_defaults_of_tools(self):
        self.write("s.wkt", "POLYGON ((0 0, 40 0, 40 30, 0 30, 0 0))")
        common = ["carve", "s.wkt", "--units", "mm"]
        self.succeed(*common, "--angle", "60", "--depth", "3", "--clear-tool", "6", "--spindle", "12000", "-o", "s.nc")
        self.assertEqual([line for line in self.lines("s.nc") if line.startswith("M3")], ["M3 S12000"] * 2)
        outside = ["--angle", "0", "--tool", "3", "--depth", "2", "--exterior", "--margin", "2", "-o", "n.nc"]
        self.assertIn("a larger --margin", self.refuse("empty", *common, *outside))
        self.write("u.wkt", "POLYGON ((0 0, 40 0, 40 30, 30 30, 30 10, 10 10, 10 30, 0 30, 0 0))")
        narrow = self.succeed("carve", "u.wkt", "--units", "mm", *outside)
        self.assertIn(b"--margin is narrower", narrow.stderr)
        self.assertIn(b"fits nowhere: the V clears", self.succeed(*common, "--angle", "60", "--depth", "3", "--clear-tool",
                                                                 "100", "-o", "n.nc").stderr)
        self.write("i.dxf", "\n".join(["0", "SECTION", "2", "HEADER", "9", "$INSUNITS", "70", "1", "0", "ENDSEC", "0",
                                        "SECTION", "2", "ENTITIES", "0", "CIRCLE", "8", "0", "10", "0", "20", "0", "40", "1",
                                        "0", "ENDSEC", "0", "EOF", ""]))
        if self.supported("i.dxf"):
            carved = self.succeed("carve", "i.dxf", "--angle", "60", "-o", "i.nc")
            self.assertIn(b"the unit of the input is 'in', that of the result and of options 'mm'", carved.stderr)
            carved = self.succeed("carve", "i.dxf", "--angle", "60", "--output-units", "in", "-o", "i.tap")
            self.assertNotIn(b"unit of the input", carved.stderr)
            # Variables whose group code is that of a section's name.
            self.write("j.dxf", self.read("i.dxf").replace(b"9\n$INSUNITS", b"9\n$UCSNAME\n2\nours\n9\n$INSUNITS"))
            self.assertEqual(json.loads(self.succeed("info", "j.dxf", "--json").stdout)["unit"], "in")
        for wrong in (["--angle", "0"], ["--angle", "0", "--tool", "3", "--depth", "2", "--tip", "1"],
                      ["--angle", "60", "--clear-tool", "3"], ["--angle", "60", "--post", "grbl", "-o", "a.png"]):
            self.refuse("invalid_option", *common, *wrong)

    def test_passes_that_do_not_reach_each_other(self):
        """A step beyond the tool's diameter would leave ridges as high as the material."""
        self.write("s.wkt", "POLYGON ((0 0, 40 0, 40 30, 0 30, 0 0))")
        common = ["carve", "s.wkt", "--units", "mm", "-o", "s.nc"]
        mill = ["--angle", "0", "--tool", "4", "--depth", "2"]
        cone = ["--angle", "90", "--depth", "2"]  # 4 wide at that depth
        for tool, step, most in ((mill, "4.01", "at most 2 leaves nothing"), (cone, "4.01", "at most 0.1 leaves low ones"),
                                 (["--angle", "90", "--tool", "3"], "3.01", "at most 0.075"),
                                 ([*cone, "--tip", "1"], "5.01", "at most 0.5 leaves nothing")):
            with self.subTest(tool=tool):
                error = self.refuse("invalid_option", *common, *tool, "--step", step)
                self.assertIn("--step", error)
                self.assertIn(most, error)
        note = b"note: --step 3 is more than half of the tool's diameter"
        self.assertIn(note, self.succeed(*common, *mill, "--step", "3").stderr)
        self.assertEqual(self.succeed(*common, *mill, "--step", "2").stderr, b"")
        self.assertEqual(self.succeed(*common, *cone, "--step", "3").stderr, b"")
        # Without a step it follows from the depth.
        error = self.refuse("too_large", *common, "--angle", "90", "--depth", "1e-9")
        self.assertRegex(error, "more than 1e6 passes: .*; a larger step, tool or depth takes fewer")

    def test_templates_and_preview(self):
        self.write("s.wkt", self.SQUARE)
        common = ["carve", "s.wkt", "--units", "mm", "--angle", "60"]
        for post, end in (("plain", "M2"), ("linuxcnc", "M2"), ("grbl", "M30"), ("mach3", "M30")):
            self.succeed(*common, "--post", post, "-o", "s.nc")
            self.assertEqual(self.lines("s.nc")[-1], end)
        self.write("own.post", "[start]\n%\n{header}\n{units}\n[tool]\n[cut]\nG0 Z{safe}\n[end]\nM5\n%\n")
        self.succeed(*common, "--post", self.path("own.post"), "-o", "s.nc")
        self.assertEqual(self.lines("s.nc")[0], "%")
        self.assertEqual(self.lines("s.nc")[-2:], ["M5", "%"])
        self.write("odd.post", "[start]\n{header}\n[tool]\n[cut]\n[end]\nM5 {unknown}\n")
        self.assertIn("{spindle}", self.refuse("invalid_option", *common, "--post", self.path("odd.post"), "-o", "t.nc"))
        self.write("low.post", "[start]\nG0 Z{safe}\n[tool]\n[cut]\n{spindle}\n[end]\nM5\n")
        self.assertIn("{safe}", self.refuse("invalid_option", *common, "--post", self.path("low.post"), "-o", "t.nc"))
        self.write("bad.post", "[start]\n")
        error = self.refuse("invalid_option", *common, "--post", self.path("bad.post"), "-o", "t.nc")
        self.assertIn("bad.post: the G-code template has no section [tool]", error)
        self.refuse("invalid_option", *common, "--post", "nowhere", "-o", "t.nc")
        self.succeed(*common, "--preview", "p.png", "--width", "200", "-o", "s.nc")
        self.assertTrue(self.read("p.png").startswith(b"\x89PNG"))

    def test_pictures_leave_what_stands(self):
        """A disc in the hole of a frame, its wall all tabs: in the picture it is not cut."""
        self.write("a.svg", '<svg width="100mm" height="60mm" viewBox="0 0 100 60"><circle cx="50" cy="30" r="4"/>'
                   '<path fill-rule="evenodd" d="M5 5H95V55H5Z M20 20H80V40H20Z"/></svg>')
        standing = []
        for tabs in ([], ["--tabs", "4"]):
            self.succeed("carve", "a.svg", "--angle", "0", "--tool", "3", "--depth", "6", "--exterior", "--margin", "4",
                         *tabs, "--width", "400", "-o", "p.png")
            white = json.loads(self.succeed("distance", "p.png", "--threshold", "250", "--json").stdout)
            standing.append(white["components"])
        self.assertEqual(*standing)

    def test_several_shapes_stand_out_together(self):
        """What lies around one is not cut through its neighbour."""
        self.write("two.wkt", "POLYGON((0 0,10 0,10 10,0 10,0 0))\nPOLYGON((14 0,24 0,24 10,14 10,14 0))")
        self.succeed("carve", "two.wkt", "--units", "mm", "--angle", "0", "--tool", "2", "--depth", "1", "--exterior",
                     "--margin", "8", "-o", "t.nc")
        places = [place for move in self.moves("t.nc") if move[0] > 0 for place in self.places(move, 0.2)]
        for x, y, z in places:
            off = min(math.hypot(max(left - x, x - left - 10, 0), max(-y, y - 10, 0)) for left in (0, 14))
            self.assertTrue(z >= 0 or off > 1 - 1e-5, (x, y, z))
        self.assertTrue(any(10.9 < x < 13.1 and 0 < y < 10 and z < 0 for x, y, z in places))

    def test_tabs_stand_in_every_format(self):
        self.write("s.wkt", "POLYGON ((0 0, 40 0, 40 30, 0 30, 0 0))")
        common = ["carve", "s.wkt", "--units", "mm", "--angle", "0", "--tool", "3", "--depth", "6", "--pass-depth", "2",
                  "--exterior", "--margin", "4"]
        tabs = ["--tabs", "4", "--tab-width", "5", "--tab-height", "2.5"]
        report = json.loads(self.succeed(*common, *tabs, "--json", "-o", "s.nc").stdout)
        self.assertEqual(report["tabs"], 4)
        places = [place for move in self.moves("s.nc") if move[0] > 0 for place in self.places(move, 0.1)]
        raised = [z for _, _, z in places if abs(z + 3.5) < 1e-6]
        self.assertGreater(len(raised), 100)
        self.assertGreater(sum(z < -5.9 for _, _, z in places), 100)
        # Around the part, the bottom is interrupted four times; straight up and down beside each tab.
        steep = [move for move in self.moves("s.nc") if move[0] == 1 and move[1]["Z"] == -6 and move[2]["Z"] == -3.5]
        self.assertTrue(all(move[1]["X"] == move[2]["X"] and move[1]["Y"] == move[2]["Y"] for move in steep))
        self.assertGreaterEqual(len(steep), 8)
        for name in self.supported("t.csv", "t.dxf", "t.png", "t.svg"):
            self.succeed(*common, "-o", "plain" + name)
            self.succeed(*common, *tabs, "-o", name)
            self.assertNotEqual(self.read("plain" + name), self.read(name))
        self.assertIn(b"no tabs", self.succeed("carve", "s.wkt", "--units", "mm", "--angle", "60", "--depth", "2", "--tabs",
                                              "2", "-o", "u.nc").stderr)
        self.refuse("invalid_option", *common, "--tab-width", "5")
        self.refuse("invalid_option", *common, "--tabs", "4", "--tab-height", "6")
        self.refuse("invalid_option", "carve", "s.wkt", "--units", "mm", "--angle", "60", "--tabs", "4")

    def test_linuxcnc_reads_ten_drawings(self):
        """LinuxCNC's own interpreter, where Debian's package linuxcnc-uspace is installed."""
        python = "/usr/bin/python3"
        program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "linuxcnc_canon.py")
        if not os.path.exists(python) or subprocess.run([python, "-c", "import gcode"], capture_output=True).returncode:
            self.skipTest("LinuxCNC is not installed")
        drawings = {name: os.path.join(DATA, name) for name in
                    self.supported("bumps.wkt", "gear.wkt", "maze.wkt", "plan.wkt", "spanner.svg", "plate.dxf")}
        for name, text in (("square", self.SQUARE), ("comb", comb(5)), ("star", star(30)), ("frame", FRAME)):
            drawings[name] = self.path(self.write(name + ".wkt", text))
        sharp = {"maze.wkt", "plan.wkt", "square", "comb", "frame"}  # corners at all four sides
        beyond = 2  # around a drawing its enclosure is cut, whose corners are sharp
        for name, path in drawings.items():
            # Its module in Python knows no table of tools, so the program with a change of tool has a pause instead.
            around = ["--depth", "1", "--exterior", "--margin", str(beyond)]
            tabs = [*around, "--tabs", "3", "--tab-width", "1"]
            for unit, post, options in (("mm", "linuxcnc", []), ("in", "plain", ["--pass-depth", "0"]),
                                        ("mm", "linuxcnc", tabs), ("in", "plain", around)):
                units = ["--units", "mm", "--output-units", unit]
                x0, y0, x1, y1 = json.loads(self.succeed("info", path, "--json", *units).stdout)["extent"]
                self.succeed("carve", path, *units, "--angle", "90", *options,
                             "--origin", "lower-left", "--post", post, "-o", "d.ngc")
                read = json.loads(subprocess.run([python, program, self.path("d.ngc"), unit], capture_output=True,
                                                 check=True, cwd=self.folder.name).stdout)
                self.assertEqual(read["error"], "", name)
                self.assertGreater(read["moves"], 4)
                margin = beyond if "--exterior" in options else 0
                if margin or name in sharp:
                    for low, high, size in zip(read["low"], read["high"], (x1 - x0, y1 - y0)):
                        self.assertAlmostEqual(low, -margin, delta=1e-6, msg=name)
                        self.assertAlmostEqual(high, size + margin, delta=1e-6, msg=name)
