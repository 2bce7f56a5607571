"""Images as input; `medial distance`."""

import json
import math

from support import CommandLine


class Images(CommandLine):
    # An L of two strokes and, over a corner, one more pixel.
    PICTURE = "P1\n8 6\n" + "".join(("11000000", "11000000", "11000000", "11111100", "11111100",
                                     "00000010"))

    def test_distance(self):
        self.write("l.pbm", self.PICTURE)
        report = json.loads(self.succeed("distance", "l.pbm", "--json", "--stats").stdout)
        self.assertEqual((report["foreground"], report["components"], report["holes"]), (19, 1, 0))
        self.assertAlmostEqual(report["largest"]["distance"], math.sqrt(2))
        for name in ("d.tif", "d.png", "d.pgm"):
            self.succeed("distance", "l.pbm", "-o", name)
            self.assertGreater(len(self.read(name)), 40)
        self.assertIn(b"8 x 6", self.succeed("distance", "-", given=self.PICTURE.encode()).stdout)
        self.refuse("unsupported", "distance", "l.pbm", "-o", "d.jpg")
        self.refuse("invalid_option", "distance", "l.pbm", "-o", "e.png", "--scale", "1e5")
        self.refuse("empty", "distance", "l.pbm", "--threshold", "2")
        self.refuse("unreadable", "distance", "none.png")
        self.refuse("unsupported", "distance", self.write("a.txt", "text"))

    def test_every_command_takes_them(self):
        self.write("l.pbm", self.PICTURE)
        info = json.loads(self.succeed("info", "l.pbm", "--json").stdout)
        self.assertEqual((info["components"], info["holes"]), (1, 0))
        self.assertAlmostEqual(info["area"], 19 + 1 / 256)  # the neck at the corner
        inverse = json.loads(self.succeed("info", "l.pbm", "--invert", "--json").stdout)
        self.assertAlmostEqual(inverse["area"], 29 + 1 / 256)
        for options in ([], ["--smooth-contour"], ["--method", "brushfire"], ["--method", "ridge"]):
            with self.subTest(options=options):
                self.succeed("axis", "l.pbm", *options, "-o", "axis.json")
                shape = options if options == ["--smooth-contour"] else []
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
