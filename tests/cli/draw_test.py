"""`medial draw` and `medial field`."""

import json
import struct

from support import FRAME, CommandLine


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

    def test_a_forged_radius_takes_no_more_time(self):
        self.write("frame.wkt", FRAME)
        self.succeed("axis", "frame.wkt", "-o", "frame.json")
        axis = json.loads(self.read("frame.json"))
        axis["items"][0]["axis"]["nodes"][0][2] = 1e154
        self.write("forged.json", json.dumps(axis))
        self.succeed("draw", "forged.json", "--disks", 9, "-o", "forged.svg")


class Field(CommandLine):
    def test_every_format(self):
        self.write("elbow.wkt", "POLYGON ((0 0, 8 0, 8 3, 3 3, 3 8, 0 8))")
        for suffix, begin in (("svg", b"<?xml"), ("pdf", b"%PDF"), ("ps", b"%!PS"), ("png", b"\x89PNG")):
            self.succeed("field", "elbow.wkt", "-o", "field." + suffix, "--width", "60", "--lines", "2")
            self.assertTrue(self.read("field." + suffix).startswith(begin))
        # Lines only: no image of pixels inside; without either, the outline alone.
        self.succeed("field", "elbow.wkt", "-o", "lines.svg", "--lines", "4", "--no-brightness")
        self.assertNotIn(b"<image", self.read("lines.svg"))
        self.succeed("field", "elbow.wkt", "-o", "bare.svg", "--lines", "0", "--no-brightness")
        self.assertLess(self.read("bare.svg").count(b"<path"), self.read("lines.svg").count(b"<path"))

    def test_field_far_from_the_origin(self):
        """Where a sum of small steps does not grow: coordinates a unit apart, at 1e16."""
        low, high = "1e16", "10000000000000004"
        self.write("far.wkt", f"POLYGON (({low} {low}, {high} {low}, {high} {high}, {low} {high}))")
        self.succeed("field", "far.wkt", "--width", 20, "--lines", 4, "-o", "far.svg")
        self.assertIn(b"<svg", self.read("far.svg"))
