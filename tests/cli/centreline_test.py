"""`medial centreline` and `medial measure`."""

import json
import re
import sqlite3

from support import FORMATS, FRAME, GEOGRAPHIC, RECTANGLE, CommandLine


class Centreline(CommandLine):
    def test_main_path(self):
        self.write("rectangle.wkt", RECTANGLE)
        report = json.loads(self.succeed("centreline", "rectangle.wkt", "--json").stdout)
        self.assertAlmostEqual(report["features"][0]["lines"][0]["length"], 2)
        text = self.succeed("centreline", "rectangle.wkt", "--extend", "-o", "-", "--format", "wkt").stdout
        for end in (b"0 1", b"4 1"):
            self.assertIn(end, text)
        for extension in FORMATS:
            with self.subTest(extension=extension):
                if extension == "dxf":
                    self.skip_without("DXF")
                self.succeed("centreline", "rectangle.wkt", "--extend", "-o", "line." + extension)
                self.succeed("centreline", "rectangle.wkt", "--smooth", "1", "-o", "smooth." + extension)
        for name in ("line.json", "smooth.json"):
            self.succeed("draw", name, "-o", "again.svg")

    def test_numbers_are_those_of_the_file(self):
        """With extensions, smoothed and with loops: lengths as written; radii without the extensions."""
        self.write("rectangle.wkt", RECTANGLE)
        self.write("bend.wkt", "POLYGON((0 0,90 0,90 90,70 90,70 20,0 20,0 0))")
        self.write("frame.wkt", FRAME)
        self.write("river.wkt", "POLYGON((0 0,60 0,60 8,0 8,0 0),(25 2,35 2,35 4,25 4,25 2))")
        for name, *options in (("rectangle.wkt", "--extend"), ("bend.wkt", "--smooth", "2"), ("bend.wkt",),
                               ("bend.wkt", "--smooth", "2", "--extend"), ("frame.wkt", "--smooth", "1"),
                               ("river.wkt", "--loops", "keep"), ("frame.wkt", "--loops", "keep")):
            with self.subTest(name=name, options=options):
                done = self.succeed("centreline", name, *options, "--json", "-o", "lines.geojson").stdout
                lines = json.loads(done)["features"][0]["lines"]
                written = [f["properties"] for f in json.loads(self.read("lines.geojson"))["features"]]
                self.assertEqual(len(lines), len(written))
                for line, row in zip(lines, written):
                    self.assertAlmostEqual(line["length"], row["length"])
                    if "--extend" not in options:
                        self.assertAlmostEqual(line["narrowest_radius"], row["r_min"])
                text = self.succeed("centreline", name, *options, "--threads", "1").stdout.decode()
                self.assertIn(f"length {sum(row['length'] for row in written):.10g}", text)
        extended = json.loads(self.succeed("centreline", "rectangle.wkt", "--extend", "--json").stdout)
        self.assertAlmostEqual(extended["features"][0]["lines"][0]["length"], 4)
        self.assertAlmostEqual(extended["features"][0]["lines"][0]["narrowest_radius"], 1)
        extended = json.loads(self.succeed("centreline", "bend.wkt", "--extend", "--smooth", "1", "--json").stdout)
        self.assertGreater(extended["features"][0]["lines"][0]["narrowest_radius"], 9)

    def test_disks_have_no_line(self):
        self.write("disk.wkt", "CURVEPOLYGON(CIRCULARSTRING(-3 0, 3 0, -3 0))\n" + RECTANGLE)
        note = b"note: 1 feature has no line, as the axis is a single point"
        self.assertIn(note, self.succeed("centreline", "disk.wkt", "-o", "c.geojson").stderr)
        self.assertNotIn(note, self.succeed("centreline", "disk.wkt", "-o", "c.geojson", "--quiet").stderr)

    def test_two_places_that_are_one(self):
        self.write("rectangle.wkt", RECTANGLE)
        for command in ("centreline", "measure"):
            error = self.refuse("invalid_option", command, "rectangle.wkt", "--widest", "2,1", "2,1")
            self.assertIn("one place of the axis", error)
        self.write("strokes.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"><path d="M0 0h4v4z"/>'
                                  '<path fill="none" d="M0 0h4v4z"/></svg>')
        self.assertIn(b"1 shape is not filled and was", self.succeed("info", "strokes.svg").stderr)

    def test_between_places(self):
        self.write("frame.wkt", FRAME)
        path = json.loads(self.succeed("centreline", "frame.wkt", "--from", "0/3", "--to=1,1", "--json").stdout)
        self.assertGreater(path["features"][0]["lines"][0]["length"], 0.5)
        wide = self.succeed("centreline", "frame.wkt", "--widest", "1,3", "8,3", "--json")
        self.assertAlmostEqual(json.loads(wide.stdout)["features"][0]["lines"][0]["narrowest_radius"], 1)
        outside = self.succeed("centreline", "frame.wkt", "--from", "1,1", "--to", "20,3").stderr
        self.assertIn(b"20,3 lies in no shape", outside)
        self.refuse("invalid_option", "centreline", "frame.wkt", "--from", "1,1")
        self.refuse("invalid_option", "centreline", "frame.wkt", "--from", "1", "--to", "2,2")
        self.refuse("invalid_option", "centreline", "frame.wkt", "--from", "9/9", "--to", "2,2")
        self.refuse("invalid_option", "centreline", "frame.wkt", "--widest", "1,1", "2,2", "--clearance", "1")
        self.refuse("invalid_option", "centreline", "frame.wkt", "--collapse", "0")

    def test_places_and_projections(self):
        """Degrees would be taken as metres: only sides can be named, by their numbers."""
        self.write("g.geojson", GEOGRAPHIC)
        for command, *places in (("centreline", "--from", "9.01,47.02", "--to", "0/1"),
                                 ("centreline", "--widest", "0/3", "9.09,47.02"),
                                 ("measure", "--from", "0/3", "--to", "9.09,47.02")):
            error = self.refuse("invalid_option", command, "g.geojson", "--project", *places)
            self.assertIn("RING/VERTEX", error)
        line = json.loads(self.succeed("centreline", "g.geojson", "--project", "--where", "name = 'east'",
                                       "--from", "0/3", "--to", "0/1", "--json").stdout)["features"][0]["lines"][0]
        # Between the disks that touch these sides in their middles: 0.1 degrees less 0.05 of a meridian.
        self.assertAlmostEqual(line["length"], 2040, delta=20)

    def test_no_room(self):
        self.write("frame.wkt", FRAME)
        note = b"note: the result is empty"
        for radius, empty in (("0.9", False), ("100", True)):
            arguments = ["centreline", "frame.wkt", "--clearance", radius, "-o", "room.json"]
            self.assertEqual(note in self.succeed(*arguments).stderr, empty)
            self.assertEqual(self.succeed(*arguments, "--quiet").stderr, b"")
        self.write("many.wkt", (RECTANGLE + "\n") * 30000)  # a megabyte: in parts
        for radius, empty in (("0.9", False), ("100", True)):
            done = self.succeed("centreline", "many.wkt", "--clearance", radius, "-o", "room.csv")
            self.assertEqual(note in done.stderr, empty)

    def test_numbers_of_features(self):
        """Those of the input, also through files, so that results can be joined to it."""
        self.write("f.wkt", "\n".join([RECTANGLE, *["POLYGON ((0 0, 1 0, 2 0, 0 0))"] * 4, FRAME]))

        def numbers(*arguments):
            done = self.succeed(*arguments, "--json", "--quiet").stdout
            return [feature["feature"] for feature in json.loads(done)["features"]]

        for command in (["measure"], ["measure", "--disks", "1"], ["centreline"]):
            self.assertEqual(numbers(*command, "f.wkt", "--skip-invalid"), [0, 5])
            self.assertEqual(numbers(*command, self.write("r.wkt", RECTANGLE)), [0])
        for stored in ("a.json", "a.safetensors"):
            self.succeed("axis", "f.wkt", "--skip-invalid", "--quiet", "-o", stored)
            self.assertEqual(numbers("measure", stored), [0, 5])
            self.succeed("prune", stored, "-o", "p.json", "--quiet")
            self.assertEqual(numbers("centreline", "p.json"), [0, 5])
        self.write("many.wkt", "POLYGON ((0 0, 1 0, 2 0, 0 0))\n" + (RECTANGLE + "\n") * 30000)
        self.succeed("axis", "many.wkt", "--skip-invalid", "--quiet", "-o", "parts.json")
        self.assertIn(b'"feature":30000,', self.read("parts.json"))
        self.assertNotIn(b'"feature":0,', self.read("parts.json"))

    def test_side_channels(self):
        self.write("river.wkt", "POLYGON((0 0,60 0,60 8,0 8,0 0),(25 2,35 2,35 4,25 4,25 2))")
        line = self.succeed("centreline", "river.wkt", "-o", "line.wkt")
        self.assertIn(b"--loops=keep", line.stderr)
        self.assertIn(b"both are kept", self.succeed("centreline", "river.wkt", "--loops", "keep", "-o",
                                                     "both.geojson").stderr)
        ends = [(f["properties"]["from_node"], f["properties"]["to_node"])
                for f in json.loads(self.read("both.geojson"))["features"]]
        self.assertEqual(len(ends), 4)  # before, after and on both sides of the island
        self.assertEqual(len({frozenset(pair) for pair in ends}), 3)
        self.refuse("invalid_option", "centreline", "river.wkt", "--loops", "keep", "--smooth", "1")
        self.refuse("invalid_option", "centreline", "river.wkt", "--loops", "keep", "--all")
        self.refuse("invalid_option", "centreline", "river.wkt", "--all", "--simplify", "1", "-o", "n.svg")

    def test_clearance_and_collapse(self):
        self.write("frame.wkt", FRAME)
        report = json.loads(self.succeed("centreline", "frame.wkt", "--clearance", "1.1", "--json").stdout)
        self.assertGreater(report["length"], 1)
        for extension in ("json", "geojson", "gpkg", "wkt", "svg", "pdf", "png", "ps"):
            with self.subTest(extension=extension):
                self.succeed("centreline", "frame.wkt", "--collapse", "2.5", "-o", "parts." + extension)
        layers = [f["properties"]["layer"] for f in json.loads(self.read("parts.geojson"))["features"]]
        self.assertEqual(layers, sorted(layers, reverse=True))
        self.assertEqual(set(layers), {"polygons", "lines"})
        database = sqlite3.connect(self.path("parts.gpkg"))
        self.assertEqual(database.execute("select count(*) from polygons").fetchone()[0],
                         layers.count("polygons"))
        database.close()
        self.refuse("unsupported", "centreline", "frame.wkt", "--collapse", "2.5", "-o", "parts.dxf")

    def test_several_features_with_attributes(self):
        self.write("places.geojson", GEOGRAPHIC)
        self.succeed("centreline", "places.geojson", "--project", "-o", "lines.geojson")
        names = [f["properties"]["name"] for f in json.loads(self.read("lines.geojson"))["features"]]
        self.assertEqual(names, ["west", "east"])
        self.succeed("measure", "places.geojson", "--project", "--transects", "2", "-o", "t.geojson")
        names = [f["properties"]["name"] for f in json.loads(self.read("t.geojson"))["features"]]
        self.assertEqual(names, ["west", "west", "east", "east"])


class Measure(CommandLine):
    def test_labels_of_large_numbers(self):
        """42613 is narrower than 4.261e+04, at 8 pixels a digit."""
        self.write("s.wkt", "POLYGON ((0 0, 85226 0, 85226 85226, 0 85226, 0 0))")
        self.succeed("measure", "s.wkt", "--disks", "1", "-o", "s.svg")
        label = re.findall(r' d="([^"]*)"', self.read("s.svg").decode())[-1]
        across = [float(x) for x, _ in re.findall(r"([\d.]+) ([\d.]+)", label)]
        self.assertTrue(30 < max(across) - min(across) < 50, across)

    def test_disks_alone_need_no_axis(self):
        self.write("rectangle.wkt", RECTANGLE)
        disks = ["measure", "rectangle.wkt", "--disks", "3"]
        all_of_it = json.loads(self.succeed(*disks, "--necks", "5", "--json").stdout)["features"][0]
        done = json.loads(self.succeed(*disks, "--json", "--stats").stdout)
        self.assertEqual(done["features"], [{"feature": 0, "attributes": {}, "disks": all_of_it["disks"]}])
        self.assertNotIn("axis", done["seconds"])
        rows = self.succeed(*disks).stdout.decode().splitlines()
        self.assertEqual([row.split()[-5] for row in rows], ["r"] * 3)
        # A centre that is nothing but rounding beside the radius is printed as 0.
        self.write("tiny.wkt", "POLYGON ((-2 -1, 2 -1, 2 1.00000000000001, -2 1.00000000000001, -2 -1))")
        self.assertIn(b", 0)", self.succeed("measure", "tiny.wkt", "--disks", "1").stdout)
        self.succeed(*disks, "-o", "alone.geojson")
        self.succeed(*disks, "--widening", "1.1", "-o", "whole.geojson")
        alone, whole = (json.loads(self.read(name + ".geojson"))["features"] for name in ("alone", "whole"))
        self.assertEqual([repr(disk["properties"]["rank"]) for disk in alone], ["0", "1", "2"])
        self.assertEqual(alone, whole)
        for extension in ("gpkg", "wkt", "svg", "pdf", "png"):
            self.succeed(*disks, "-o", "alone." + extension)
        # Each of these asks for more.
        for more in (["--samples", "9", "--plot", "plot.svg"], ["--transects", "2", "-o", "t.svg"],
                     ["--spacing", "1", "-o", "t.svg"], ["--necks", "1"], ["--trim", "0"], ["--widening", "2"],
                     ["--route", "shortest"], ["--from", "0,0", "--to", "4,2"],
                     ["--widest", "0,0", "4,2"], ["--plot", "plot.svg"], ["-o", "profile.csv"]):  # fmt: skip
            self.assertIn("area", json.loads(self.succeed(*disks, "--json", *more).stdout)["features"][0], more)
        self.write("two.wkt", RECTANGLE + "\n" + RECTANGLE)
        table = self.succeed("measure", "two.wkt", "--disks", "3").stdout.decode().splitlines()
        self.assertEqual([row.split()[:2] for row in table],
                         [["feature", "rank"]] + [[str(i), str(k)] for i in range(2) for k in range(3)])

    def test_options_for_what_is_not_written(self):
        """None is ignored: each error names what the option is for."""
        self.write("rectangle.wkt", RECTANGLE)
        self.write("two.wkt", RECTANGLE + "\n" + RECTANGLE)
        for option in ("--transects", "--spacing", "--necks", "--disks"):
            error = self.refuse("invalid_option", "measure", "rectangle.wkt", option, "2", "-o", "x.csv")
            self.assertIn(option, error)
            self.assertIn("FILE.geojson", error)
        for output in ([], ["-o", "x.geojson"]):
            error = self.refuse("invalid_option", "measure", "rectangle.wkt", "--samples", "10", *output)
            self.assertIn("FILE.csv", error)
        for options in (["--necks", "1"], ["--disks", "2", "--necks", "1"], ["--disks", "2", "--trim", "0"]):
            self.assertIn("--json", self.refuse("invalid_option", "measure", "two.wkt", *options))
            self.succeed("measure", "two.wkt", *options, "-o", "layers.geojson")
            feature = json.loads(self.succeed("measure", "two.wkt", *options, "--json").stdout)["features"][1]
            self.assertEqual(len(feature.get("disks", [])), 2 if "--disks" in options else 0)
            self.assertIn(b"widest", self.succeed("measure", "rectangle.wkt", *options).stdout)
        self.write("many.wkt", (RECTANGLE + "\n") * 30000)  # a megabyte: in parts
        self.refuse("invalid_option", "measure", "many.wkt", "--necks", "1")

    def test_shapes_without_a_line(self):
        """A disk has no line, and so no widths along one; nor have features that the places do not touch."""
        self.write("disk.wkt", "CURVEPOLYGON(CIRCULARSTRING(-3 0, 3 0, -3 0))")
        disk = json.loads(self.succeed("measure", "disk.wkt", "--json").stdout)["features"][0]
        self.assertIsNone(disk["mean_width"]["by_length"])
        self.assertIsNone(disk["mean_width"]["area_by_length"])
        self.assertAlmostEqual(disk["mean_width"]["by_area"], 6)
        self.assertIn(b"no line", self.succeed("measure", "disk.wkt").stdout)
        self.write("both.wkt", "CURVEPOLYGON(CIRCULARSTRING(-3 0, 3 0, -3 0))\n" + "POLYGON ((10 0,20 0,20 4,10 4,10 0))")
        row = self.succeed("measure", "both.wkt").stdout.decode().splitlines()[1].split()
        self.assertEqual(row[2:5], ["-", "-", "-"])
        for command in ("measure", "centreline"):
            done = self.succeed(command, "both.wkt", "--from", "12,2", "--to", "17,2")
            self.assertIn(b"note: the line lies in feature 1", done.stderr)
            one = self.succeed(command, "disk.wkt").stderr + self.succeed(command, "both.wkt").stderr
            self.assertNotIn(b"the line lies in", one)

    def test_measure(self):
        self.write("rectangle.wkt", RECTANGLE)
        table = self.succeed("measure", "rectangle.wkt").stdout.decode()
        self.assertIn("widest", table)
        report = json.loads(self.succeed("measure", "rectangle.wkt", "--disks", "3", "--necks", "5", "--json").stdout)["features"][0]
        self.assertAlmostEqual(report["area"], 8)
        self.assertAlmostEqual(report["mean_width"]["by_length"], 2)
        self.assertEqual([round(disk["r"], 6) for disk in report["disks"]], [1, 1, 0.25])
        rows = self.rows(self.succeed("measure", "rectangle.wkt", "--samples", "4", "-o", "-",
                                      "--format", "csv").stdout)
        self.assertEqual([float(row["along"]) for row in rows], [0, 0.5, 1, 1.5, 2])
        self.assertEqual({round(float(row["width"]), 9) for row in rows}, {2})
        self.succeed("measure", "rectangle.wkt", "--spacing", "0.5", "-o", "transects.shp")
        for extension in ("geojson", "gpkg", "wkt", "svg", "pdf", "png", "ps"):
            self.succeed("measure", "rectangle.wkt", "--transects", "7", "--disks", "2", "-o", "m." + extension)
        self.assertEqual(len(json.loads(self.read("m.geojson"))["features"]), 9)
        for extension in ("svg", "png", "pdf"):
            self.succeed("measure", "rectangle.wkt", "--plot", "plot." + extension)
        plain = self.succeed("measure", "rectangle.wkt", "--samples", "1", "-o", "-", "--format", "csv").stdout
        metres = self.succeed("measure", "rectangle.wkt", "--units", "m", "--samples", "1", "-o", "-", "--format", "csv")
        self.assertNotIn(b"unit", plain)
        self.assertEqual({row["unit"] for row in self.rows(metres.stdout)}, {"m"})
        # The numbers stand in the picture.
        self.succeed("measure", "rectangle.wkt", "--disks", "1", "-o", "one.svg")
        self.succeed("measure", "rectangle.wkt", "--disks", "2", "-o", "two.svg")
        glyphs = [self.read(name).count(b"<use") + self.read(name).count(b"<text") for name in ("one.svg", "two.svg")]
        paths = [self.read(name).count(b"<path") for name in ("one.svg", "two.svg")]
        self.assertTrue(glyphs[1] > glyphs[0] or paths[1] > paths[0] + 1)
        self.refuse("unsupported", "measure", "rectangle.wkt", "--transects", "7", "--disks", "2", "-o", "m.fgb",
                    nothing_new=True)
        self.refuse("invalid_option", "measure", "rectangle.wkt", "--widening", "1")
