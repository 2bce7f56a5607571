"""Images as input; `medial distance`."""

import base64
import json
import math
import struct

from support import FRAME, CommandLine


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
        for options in (["--pixel-outline"], ["--smooth-contour"], ["--method", "brushfire"],
                        ["--method", "ridge"]):
            with self.subTest(options=options):
                self.succeed("axis", "l.pbm", *options, "-o", "axis.json")
                shape = options if len(options) == 1 else []
                self.succeed("verify", "l.pbm", "axis.json", *shape)
        self.succeed("draw", "l.pbm", "-o", "l.svg")
        self.refuse("invalid_option", "info", "l.pbm", "--layer", "a")
        self.refuse("invalid_option", "info", "l.pbm", "--repair")

    def test_a_dark_shape_on_light_ground_is_noted(self):
        self.write("dark.pgm", "P2\n5 5\n255\n" + "\n".join(
            " ".join("0" if 1 <= x < 4 and 1 <= y < 4 else "255" for x in range(5)) for y in range(5)))
        for command in ("axis", "distance"):
            self.assertIn(b"add --invert", self.succeed(command, "dark.pgm").stderr)
            self.assertNotIn(b"--invert", self.succeed(command, "dark.pgm", "--invert").stderr)
            self.assertNotIn(b"--invert", self.succeed(command, "dark.pgm", "--threshold", "9").stderr)

    def test_default_is_what_a_person_would_draw(self):
        """Of a disk of pixels with a bar: one line, not the branches of its stairs."""
        inside = lambda x, y: (x - 30) ** 2 + (y - 30) ** 2 < 625 or (30 <= x < 110 and 24 <= y < 36)
        rows = ["".join("1" if inside(x, y) else "0" for x in range(120)) for y in range(60)]
        self.write("key.pbm", "P1\n120 60\n" + "\n".join(rows))
        count = lambda *options: json.loads(
            self.succeed("axis", "key.pbm", "--json", *options).stdout)["branches"]
        self.assertEqual(count(), 1)
        self.assertGreater(count("--smooth-contour"), 20)
        piped = self.succeed("axis", "-", "--smooth-contour", "--json", given=self.read("key.pbm"))
        self.assertEqual(json.loads(piped.stdout)["branches"], count("--smooth-contour"))
        self.assertGreater(count("--pixel-outline"), 20)
        self.assertIn(b"--pixel-outline", self.succeed("axis", "key.pbm").stderr)
        self.succeed("axis", "key.pbm", "--mask", "-o", "skeleton.png")
        mask = json.loads(self.succeed("distance", "skeleton.png", "--json").stdout)
        self.assertEqual((mask["width"], mask["height"], mask["components"]), (120, 60, 1))
        self.assertLess(mask["foreground"], 110)
        self.assertGreater(mask["foreground"], 60)
        self.refuse("unsupported", "axis", "key.pbm", "--mask", "-o", "skeleton.svg")
        self.refuse("invalid_option", "axis", self.write("a.wkt", FRAME), "--mask", "-o", "a.png")
        for option in (["--labels"], ["--invert"], ["--threshold", "3"]):
            self.assertIn("images", self.refuse("invalid_option", "axis", "a.wkt", *option))
        self.refuse("invalid_option", "axis", "key.pbm", "--labels", "--invert")
        self.refuse("invalid_option", "axis", "key.pbm", "--threshold", "nan")
        self.assertIn(b"--pixel-outline", self.succeed("measure", "key.pbm").stderr)

    def test_values(self):
        """Masks of zeros and ones, labels, and grey values."""
        self.write("mask.pgm", "P2\n4 3\n255\n0 0 0 0\n0 1 1 0\n0 0 0 0\n")
        self.assertEqual(json.loads(self.succeed("distance", "mask.pgm", "--json").stdout)["foreground"], 2)
        self.write("labels.pgm", "P2\n6 3\n255\n1 1 0 0 7 7\n1 1 0 0 7 7\n0 0 3 3 3 0\n")
        self.assertIn("--labels", self.refuse("empty", "axis", "labels.pgm"))
        self.succeed("axis", "labels.pgm", "--labels", "-o", "a.json")
        self.assertEqual([item["attributes"] for item in json.loads(self.read("a.json"))["items"]],
                         [[["value", "1"]], [["value", "3"]], [["value", "7"]]])
        table = self.succeed("measure", "labels.pgm", "--labels").stdout.decode().splitlines()
        self.assertEqual([line.split()[0] for line in table], ["value", "1", "3", "7", "unit"])
        self.assertEqual(table[-1].split(), ["unit", "pixel"])
        info = json.loads(self.succeed("info", "labels.pgm", "--labels", "--json").stdout)
        self.assertEqual((info["features"], info["area"]), (3, 11))
        self.write("grey.pgm", "P2\n3 1\n255\n0 100 200\n")
        self.assertIn(b"of at least 128", self.succeed("info", "grey.pgm").stderr)
        self.assertNotIn(b"from", self.succeed("info", "grey.pgm", "--threshold", "90").stderr)

    # One picture, 40 x 30: an L upside down in white.
    FORMATS = {
        "jpg":
            "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAAMCAgMCAgMDAwMEAwMEBQgFBQQEBQoHBwYIDAoMDAsKCwsNDhIQDQ4RDgsLEBYQERMU"
            "FRUVDA8XGBYUGBIUFRT/wAALCAAeACgBAREA/8QAGQAAAgMBAAAAAAAAAAAAAAAAAAkGBwgK/8QALRAAAQQBAwEFCQEBAAAAAAAA"
            "AQIDBAUGAAcRCAkSOHa0GBkxQVZXlZbT1CH/2gAIAQEAAD8AqnsVPFPlPkyV66Dpum9+FTtytl8+xCsdjsWV/j9hVRXZalJZQ6/G"
            "caQpZSlRCQpYJIBPHPAPw0ov3Km9/wBU7f8A5Gd/j0e5U3v+qdv/AMjO/wAesv8AVB0v5V0mZ/X4hl9hT2NlNrG7Vt2keddZDS3X"
            "Wgklxps97vMrPHBHBH/fiBqDsVPFPlPkyV66Dpz1tbQaCqm2dnNj11bCZXJlTJbqWmWGkJKluLWogJSlIJKiQAASdVr7WOyH3k2/"
            "/aIP9dHtY7IfeTb/APaIP9dKL7XbcLFdyupLG7PEMmp8qrWsSjRnJlJPamModEyYotlbalAKCVoPd554UD8xqQdip4p8p8mSvXQd"
            "NU6sfCxvJ5MufQva5rNGjUgwrcLKttbV2zxDJrjFbJ1kxnJlJPdhvLaKkqLZW2pJKSpCD3eeOUg/IalVt1N7w39VNrLPdfOLGtms"
            "rjSocvI5jrL7S0lK21oU4QpKkkgpIIIJB1WujRr/2Q==",
        "webp":
            "UklGRjQAAABXRUJQVlA4TCcAAAAvJ0AHAA8w//M///MfeDDTtk2+wS7VMcm7FUFE/ydgAxyp0xag7BEA",
        "tif":
            "SUkqACwAAAB4nGNgAIL/cMCAFwwdddjAqLqBU0dsvI2qo6W6YQAAgx3ATgAJAAABAwABAAAAKAAAAAEBAwABAAAAHgAAAAIBAwAB"
            "AAAACAAAAAMBAwABAAAACAAAAAYBAwABAAAAAQAAABEBBAABAAAACAAAABYBAwABAAAAHgAAABcBBAABAAAAIwAAABwBAwABAAAA"
            "AQAAAAAAAAA=",
        "gif":
            "R0lGODdhKAAeAIEAAAAAAP///wAAAAAAACwAAAAAKAAeAEAIdQABCBQYoKDBgwMTKlzIUOHBhxAjSmxIUGIAihgzWryYsePCjR5D"
            "DtxI0iJGkCJTqlw50iTLkyVjIqQosybHhjZlwpz4kqbLnkCDVuQpNCHKoi1zktyp9CfDpkt9QiX6dCrVj06RHkUKYKvWrEW9ch1L"
            "tizSgAA7",
        "png":
            "iVBORw0KGgoAAAANSUhEUgAAACgAAAAeCAAAAAB7tgMBAAAAMklEQVR42mNkYGBgYPjPAAOMDDgAEwORYAAVMqJ5BqeaoeCZYaWQ"
            "BWtMjQbPwCscVgAAVqcCNJV+H3oAAAAASUVORK5CYII=",
    }

    def test_formats(self):
        """JPEG (lossy), WebP, TIFF, GIF, PNG and BMP hold the same picture."""
        self.write("l.pgm", "P2\n40 30\n255\n" + "\n".join(
            " ".join("255" if 5 <= x < 35 and (5 <= y < 15 or x < 15 and y < 25) else "0" for x in range(40))
            for y in range(30)))
        wanted = json.loads(self.succeed("info", "l.pgm", "--json").stdout)
        self.assertEqual(wanted["area"], 450)
        files = {name: base64.b64decode(text) for name, text in self.FORMATS.items()}
        rows = [bytes([0, 1][5 <= x < 35 and (5 <= y < 15 or x < 15 and y < 25)] for x in range(40))
                for y in range(29, -1, -1)]
        files["bmp"] = (struct.pack("<2sIHHI", b"BM", 54 + 8 + 1200, 0, 0, 62) +
                        struct.pack("<IiiHHIIiiII", 40, 40, 30, 1, 8, 0, 1200, 0, 0, 2, 2) +
                        b"\0\0\0\0\xff\xff\xff\0" + b"".join(rows))
        for extension, data in files.items():
            with self.subTest(extension=extension):
                name = "l." + extension
                self.write(name, data)
                info = json.loads(self.succeed("info", name, "--json").stdout)
                self.assertEqual((info["area"], info["extent"]), (wanted["area"], wanted["extent"]))
                self.succeed("axis", name, "-o", extension + ".json")
                self.succeed("verify", name, extension + ".json")

    def test_maps_of_robots(self):
        """Free cells, in metres, with the origin in the lower left corner."""
        self.write("map.pgm", b"P5\n4 3\n255\n" + bytes([0, 254, 254, 0, 205, 254, 254, 0, 0, 0, 0, 205]))
        self.write("map.yaml", "image: map.pgm\nresolution: 0.5 # metres\norigin: [-10, 20, 0.0]\nnegate: 0\n"
                   "occupied_thresh: 0.65\nfree_thresh: 0.196\n")
        done = self.succeed("info", "map.yaml", "--json")
        info = json.loads(done.stdout)
        self.assertEqual((info["area"], info["extent"]), (1, [-9.5, 20.5, -8.5, 21.5]))
        self.assertIn(b"unknown cells", done.stderr)
        self.refuse("malformed", "axis", self.write("b.yaml", "image: map.pgm\n"))
        self.write("c.yaml", self.read("map.yaml").decode().replace("map.pgm", "gone.pgm"))
        self.assertIn("gone.pgm", self.refuse("unreadable", "axis", "c.yaml"))
        self.refuse("invalid_option", "axis", "map.yaml", "--threshold", "3")
        # Lists of a line each, probabilities in per cent, and what is wrong with a number.
        text = self.read("map.yaml").decode()
        self.write("list.yaml", text.replace("[-10, 20, 0.0]", "\n- -10\n- 20\n- 0.0"))
        self.assertEqual(json.loads(self.succeed("info", "list.yaml", "--json").stdout)["extent"], info["extent"])
        self.write("raw.yaml", text + "mode: raw\n")
        self.assertAlmostEqual(json.loads(self.succeed("info", "raw.yaml", "--json").stdout)["area"], 1.5,
                               delta=0.01)
        self.assertIn("above 0", self.refuse("malformed", "info", self.write("n.yaml", text.replace("0.5", "-0.5"))))
        self.assertIn("origin", self.refuse("malformed", "info", self.write("n.yaml", text.replace("20", "nan"))))
        # Distances and masks of their cells.
        done = self.succeed("distance", "map.yaml", "--json", "-o", "d.tif")
        self.assertEqual(json.loads(done.stdout)["foreground"], 4)
        self.assertIn(b"unknown cells", done.stderr)
        self.succeed("axis", "map.yaml", "--mask", "-o", "m.png")
        self.assertEqual(json.loads(self.succeed("distance", "m.png", "--json").stdout)["width"], 4)

    def test_pixels_of_maps_are_the_grid(self):
        """However the origin and the resolution round: single cells stay holes."""
        self.write("m.pgm", b"P5\n40 23\n255\n" + bytes(0 if x % 6 == 3 and y % 6 == 3 else 254
                                                         for y in range(23) for x in range(40)))
        for origin in ("-10.0, -6.0", "-10.35, -6.15", "0.1, 0.3"):
            self.write("m.yaml", f"image: m.pgm\nresolution: 0.05\norigin: [{origin}, 0]\n")
            done = self.succeed("axis", "m.yaml", "--method", "brushfire", "-o", "a.json")
            self.assertNotIn(b"does not resolve", done.stderr)
            item = json.loads(self.read("a.json"))["items"][0]["axis"]
            self.assertEqual(len(item["edges"]) - len(item["nodes"]) + 1, 24)  # four more are at the side

    @staticmethod
    def bits(data):
        """The set pixels of a raw PBM."""
        _, size, rows = data.split(b"\n", 2)
        width, height = map(int, size.split())
        stride = (width + 7) // 8
        return {(x, y) for y in range(height) for x in range(width)
                if rows[y * stride + x // 8] >> (7 - x % 8) & 1}

    def test_masks_are_as_connected_as_the_image(self):
        """A disk, a ring, a slanted bar, a chain of pixels that touch in corners, and one pixel."""
        def inside(x, y):
            return ((x - 15) ** 2 + (y - 15) ** 2 < 145 or 60 < (x - 50) ** 2 + (y - 15) ** 2 < 170 or
                    abs(x - 2 * y + 30) < 12 and 62 < x < 110 or (x - y == 60 and 5 < y < 12) or (x, y) == (2, 50))
        size = 120, 60
        rows = ["".join("1" if inside(x, y) else "0" for x in range(size[0])) for y in range(size[1])]
        self.write("a.pbm", "P1\n120 60\n" + "\n".join(rows))
        self.succeed("axis", "a.pbm", "--method", "brushfire", "--mask", "-o", "b.pbm")
        shape = json.loads(self.succeed("distance", "a.pbm", "--json").stdout)
        for options in ([], ["--pixel-outline"], ["--smooth-contour"], ["--method", "ridge"], ["--method", "brushfire"]):
            self.succeed("axis", "a.pbm", "--mask", "-o", "m.pbm", *options)
            mask = json.loads(self.succeed("distance", "m.pbm", "--json").stdout)
            self.assertEqual([mask[key] for key in ("components", "holes")],
                             [shape[key] for key in ("components", "holes")], options)
            drawn = self.bits(self.read("m.pbm"))
            self.assertTrue(all(inside(x, y) for x, y in drawn), options)
            squares = sum({(x + 1, y), (x, y + 1), (x + 1, y + 1)} <= drawn for x, y in drawn)
            self.assertLess(squares, 0.05 * len(drawn), options)  # where lines cross
        # Units change no pixel, a pipe has its format, and options of pictures have no effect.
        self.succeed("axis", "a.pbm", "--mask", "-o", "m.pbm")
        self.succeed("axis", "a.pbm", "--mask", "-o", "n.pbm", "--pixel-size", "0.3", "--units", "um", "--scale", "2")
        self.assertEqual(self.read("m.pbm"), self.read("n.pbm"))
        piped = self.succeed("axis", "a.pbm", "--mask", "-o", "-", "--format", "png").stdout
        self.assertTrue(piped.startswith(b"\x89PNG"))
        for option in (["--disks", "4"], ["--width", "400"], ["--no-shape"]):
            self.refuse("invalid_option", "axis", "a.pbm", "--mask", "-o", "o.png", *option)

    @staticmethod
    def tiff(pages):
        """Uncompressed little-endian pages of 16 x 8 pixels: (data, bits, photometric, samples, description)."""
        out = bytearray(b"II*\0\0\0\0\0")
        link = 4
        for data, bits, photometric, samples, text in pages:
            def put(block):
                out.extend(b"\0" * (len(out) % 2))
                at = len(out)
                out.extend(block)
                return at
            strip = put(data)
            tags = [(256, 3, 1, 16), (257, 3, 1, 8), (259, 3, 1, 1), (262, 3, 1, photometric), (273, 4, 1, strip),
                    (277, 3, 1, samples), (278, 3, 1, 8), (279, 4, 1, len(data)), (296, 3, 1, 1)]
            depth = put(struct.pack("<HH", bits, bits)) if samples == 2 else 0
            tags.append((258, 3, samples, depth or bits) if samples == 1 else (258, 3, 2, bits * 65537))
            if text:
                tags += [(270, 2, len(text) + 1, put(text + b"\0")), (282, 5, 1, put(struct.pack("<II", 10, 1))),
                         (283, 5, 1, put(struct.pack("<II", 10, 1)))]
            place = put(struct.pack("<H", len(tags)) + b"".join(struct.pack("<HHII", *tag) for tag in sorted(tags)) +
                        b"\0" * 4)
            out[link:link + 4] = struct.pack("<I", place)
            link = place + 2 + 12 * len(tags)
        return bytes(out)

    def test_tiffs_of_microscopes(self):
        bar = bytes(255 if 2 <= x < 14 and 2 <= y < 6 else 0 for y in range(8) for x in range(16))
        ones = b"".join(struct.pack(">H", 0x3FFC if 2 <= y < 6 else 0) for y in range(8))
        info = lambda name, *options: json.loads(self.succeed("info", name, "--json", *options).stdout)
        # Set bits are the foreground, also where they are drawn black.
        self.write("white.tif", self.tiff([(ones, 1, 1, 1, b"")]))
        self.write("black.tif", self.tiff([(ones, 1, 0, 1, b"")]))
        self.assertEqual([info("white.tif")["area"], info("black.tif")["area"]], [48, 48])
        self.assertIn(b"drawn black", self.succeed("info", "black.tif").stderr)
        # What is not read is noted.
        self.write("stack.tif", self.tiff([(bar, 8, 1, 1, b"")] * 3))
        self.assertIn(b"3 pages", self.succeed("info", "stack.tif").stderr)
        self.write("two.tif", self.tiff([(bytes(v for v in bar for _ in range(2)), 8, 1, 2, b"")]))
        self.assertIn(b"2 channels", self.succeed("info", "two.tif").stderr)
        # ImageJ says how long a pixel is in its own way.
        self.write("ij.tif", self.tiff([(bar, 8, 1, 1, b"ImageJ=1.53\nunit=micron\n")]))
        self.assertAlmostEqual(info("ij.tif", "--output-units", "um")["area"], 0.48)
        self.assertIn(b"--output-units um", self.succeed("info", "ij.tif", "--units", "um").stderr)

    def test_families(self):
        self.write("l.pbm", self.PICTURE)
        for family in ("sequential", "sides", "marking", "simultaneous"):
            self.succeed("axis", "l.pbm", "--method", "brushfire", "--brushfire", family,
                         "-o", "axis.json")
            info = json.loads(self.succeed("info", "axis.json", "--json").stdout)
            self.assertEqual((info["method"], info["resolution"]), ("brushfire", 1))
        self.refuse("invalid_option", "axis", "l.pbm", "--brushfire", "forest")

    def test_round_parts_have_one_point(self):
        """What a table of lines leaves out is noted; the graph has the point."""
        inside = lambda x, y: (x - 14) ** 2 + (y - 14) ** 2 < 150 or 40 <= x < 90 and 10 <= y < 18
        self.write("two.pgm", "P2\n100 30\n255\n" + "\n".join(
            " ".join(str((1 + (x > 35)) * inside(x, y)) for x in range(100)) for y in range(30)))
        done = self.succeed("axis", "two.pgm", "--labels", "-o", "a.geojson")
        self.assertIn(b"the axis of 1 feature is a single point", done.stderr)
        self.assertEqual({line["properties"]["value"] for line in json.loads(self.read("a.geojson"))["features"]}, {2})
        self.succeed("axis", "two.pgm", "--labels", "-o", "a.nodelink")
        nodes = json.loads(self.read("a.nodelink"))["nodes"]
        self.assertTrue(any(math.hypot(node["x"] - 14.5, node["y"] - 14.5) < 0.5 for node in nodes))
        self.assertNotIn(b"single point", self.succeed("axis", "two.pgm", "--labels", "--quiet", "-o", "a.csv").stderr)
