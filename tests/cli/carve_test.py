"""`medial carve`."""

import json
import math

from support import CommandLine


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
