"""Units of length, from files that say them to files that name them."""

import json
import struct
import zlib

from support import GEOGRAPHIC, CommandLine

BOX = '<svg xmlns="http://www.w3.org/2000/svg" {}><rect width="400" height="200"/></svg>'


class Units(CommandLine):
    def size(self, name, *options):
        rows = self.rows(self.succeed("axis", name, "-o", "-", "--format", "csv", *options).stdout)
        places = [float(row["x"]) for row in rows]
        return max(places) - min(places), rows[0].get("unit", "")

    def test_physical_sizes_of_svg(self):
        for attributes, size, unit in (('width="100mm" viewBox="0 0 400 200"', 100, "mm"),
                                       ('width="10cm" viewBox="0 0 400 200"', 100, "mm"),
                                       ('height="2in" viewBox="0 0 400 200"', 4, "in"),
                                       ('width="72pt" viewBox="0 0 400 200"', 25.4, "mm"),
                                       ('width="800" viewBox="0 0 400 200"', 800, "px"),
                                       ('viewBox="0 0 400 200"', 400, "px"),
                                       ('width="100%" viewBox="0 0 400 200"', 400, "px"),
                                       ('', 400, "px")):
            self.write("b.svg", BOX.format(attributes))
            measured, named = self.size("b.svg")
            self.assertAlmostEqual(measured, size, 9, attributes)
            self.assertEqual(named, unit, attributes)
        self.write("b.svg", BOX.format('width="400mm" viewBox="0 0 400 200"'))
        self.assertEqual(self.size("b.svg")[0], 400)  # without rounding
        self.assertIn("96 pixels", self.succeed("axis", "b.svg", "--units", "px", "--output-units", "mm",
                                                "-o", "o.json").stderr.decode())

    def test_other_units(self):
        self.write("s.wkt", "POLYGON ((0 0, 10 0, 10 8, 0 8, 0 0))")
        self.assertEqual(self.size("s.wkt"), (10, ""))
        self.assertEqual(self.size("s.wkt", "--units", "in"), (10, "in"))
        self.assertEqual(self.size("s.wkt", "--units", "in", "--output-units", "mm"), (254, "mm"))
        self.assertEqual(self.size("s.wkt", "--scale", "2.5"), (25, ""))
        self.refuse("invalid_option", "axis", "s.wkt", "--output-units", "mm")
        self.refuse("invalid_option", "axis", "s.wkt", "--units", "furlong")
        self.refuse("invalid_option", "axis", "s.wkt", "--pixel-size", "2")
        # A stored axis has its unit, and keeps it.
        self.succeed("axis", "s.wkt", "--units", "in", "-o", "s.json")
        self.assertEqual(json.loads(self.read("s.json"))["unit"], "in")
        self.assertEqual(json.loads(self.succeed("prune", "s.json", "--json").stdout)["unit"], "in")
        self.refuse("invalid_option", "prune", "s.json", "--output-units", "mm")
        self.assertIn("radius 4 in at", self.succeed("axis", "s.json").stdout.decode())

    def test_outputs_name_their_unit(self):
        self.write("s.wkt", "POLYGON ((0 0, 10 0, 10 8, 0 8, 0 0))")
        self.succeed("axis", "s.wkt", "--units", "in", "-o", "s.geojson")
        self.assertEqual(json.loads(self.read("s.geojson"))["unit"], "in")
        self.succeed("axis", "s.wkt", "-o", "s.geojson")
        self.assertNotIn("unit", json.loads(self.read("s.geojson")))
        self.succeed("axis", "s.wkt", "-o", "plain.svg")
        self.succeed("axis", "s.wkt", "--units", "in", "-o", "named.svg")  # with a scale bar
        self.assertGreater(len(self.read("named.svg")), len(self.read("plain.svg")))
        for kind in ("offset", "voronoi"):
            arguments = ["--distance", "1"] if kind == "offset" else []
            self.succeed(kind, "s.wkt", "--units", "in", *arguments, "-o", "o.json")
            self.assertEqual(json.loads(self.read("o.json"))["unit"], "in")
        self.succeed("rebuild", "s.wkt", "--units", "in", "-o", "u.geojson")
        for arguments, given in ((["u.geojson"], b""), (["-"], self.read("u.geojson")), (["u.geojson", "--layer", "u"], b"")):
            read = self.succeed("info", *arguments, "--json", given=given)  # no degrees
            self.assertEqual((json.loads(read.stdout)["unit"], read.stderr), ("in", b""), arguments)
        self.assertIn("the unit of the coordinates is 'in'", self.refuse("invalid_option", "info", "u.geojson", "--project"))
        if self.supported("s.gpkg"):
            self.succeed("axis", "s.wkt", "--units", "in", "-o", "s.gpkg")
            self.assertIn(b'UNIT["in",0.0254]', self.read("s.gpkg"))
            # Without a unit nor a reference system, no degrees either.
            self.succeed("rebuild", "s.wkt", "-o", "none.gpkg")
            read = self.succeed("info", "none.gpkg", "--json")
            self.assertEqual((json.loads(read.stdout)["unit"], read.stderr), ("", b""))

    def test_svg_and_dxf_round_trip(self):
        self.write("s.wkt", "POLYGON ((0 0, 10 0, 10 8, 0 8, 0 0))")
        for unit in ("mm", "in", "cm"):
            for name in self.supported("s.svg", "s.dxf"):
                self.succeed("rebuild", "s.wkt", "--units", unit, "-o", name)
                size, named = self.size(name, "--output-units", unit)
                self.assertAlmostEqual(size, 10, 12)
                self.assertEqual(named, unit)
        if self.supported("s.dxf"):
            self.assertIn(b"$INSUNITS\n70\n5\n", self.read("s.dxf"))
            self.assertEqual(self.size("s.dxf")[1], "cm")
            # --units overrides what a drawing says.
            self.assertAlmostEqual(self.size("s.dxf", "--units", "mm")[0], 10, 12)

    @staticmethod
    def png(dots_per_metre):
        def chunk(name, data):
            return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        rows = b"".join(b"\0" + b"\xff" * 8 for _ in range(8))
        resolution = chunk(b"pHYs", struct.pack(">IIB", dots_per_metre, dots_per_metre, 1)) if dots_per_metre else b""
        return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 8, 8, 8, 0, 0, 0, 0)) + resolution +
                chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))

    def test_feet_of_american_surveys(self):
        """EPSG:2263, the plane coordinates of New York, is in feet of 1200 / 3937 m."""
        self.write("a.wkt", "POLYGON ((987000 210000, 988000 210000, 988000 210100, 987000 210100, 987000 210000))")
        info = json.loads(self.succeed("info", "a.wkt", "--crs", "EPSG:2263", "--json").stdout)
        self.assertEqual(info["unit"], "us-ft")
        info = json.loads(self.succeed("info", "a.wkt", "--crs", "EPSG:2263", "--output-units", "m", "--json").stdout)
        self.assertAlmostEqual(info["area"], 1e5 * (1200 / 3937) ** 2, 6)

    def test_stored_axes_know_the_unit_of_their_reference_system(self):
        self.write("p.wkt", "POLYGON ((500000 5000000, 500400 5000000, 500400 5000200, 500000 5000200, 500000 5000000))")
        self.write("g.geojson", GEOGRAPHIC)
        for name, *options in (("p.wkt", "--crs", "EPSG:25832"), ("g.geojson", "--project")):
            for stored in ("a.json", "a.safetensors"):
                self.succeed("axis", name, *options, "-o", stored)
                self.assertEqual(json.loads(self.succeed("measure", stored, "--json").stdout)["unit"], "m")
        self.succeed("axis", "g.geojson", "--quiet", "-o", "a.json")
        self.assertEqual(json.loads(self.succeed("info", "a.json", "--json", "--quiet").stdout)["unit"], "degree")

    def test_images(self):
        self.write("i.png", self.png(0))
        self.assertEqual(self.size("i.png", "--pixel-outline"), (8, "pixel"))
        self.assertEqual(self.size("i.png", "--pixel-outline", "--pixel-size", "0.5", "--units", "um"), (4, "um"))
        self.refuse("invalid_option", "axis", "i.png", "--output-units", "mm")
        self.write("i.png", self.png(2000))  # half a millimetre each
        self.assertEqual(self.size("i.png", "--pixel-outline"), (8, "pixel"))
        size, unit = self.size("i.png", "--pixel-outline", "--output-units", "mm")
        self.assertAlmostEqual(size, 4, 9)
        self.assertEqual(unit, "mm")
