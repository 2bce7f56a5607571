"""What is refused, and in which words."""

import gzip
import json
import os
import resource
import subprocess

from support import BOW_TIE, FRAME, PROGRAM, RECTANGLE, SQUARES, CommandLine


class Errors(CommandLine):
    def test_inputs(self):
        whole = gzip.compress(FRAME.encode() * 50)
        cases = [
            ("not_finite", "nan.wkt", "POLYGON ((0 0, 1 nan, 1 1, 0 0))"),
            ("not_finite", "infinite.txt", "0 0\n1 1e999\n1 1\n"),
            ("crossing", "bow.wkt", BOW_TIE),
            ("hole_outside", "hole.wkt",
             "POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0), (5 5, 6 5, 6 6, 5 5))"),
            ("too_few_points", "two.wkt", "POLYGON ((0 0, 1 1, 0 0))"),
            ("too_few_points", "two.txt", "0 0\n1 1\n"),
            ("no_area", "flat.wkt", "POLYGON ((0 0, 1 0, 2 0, 0 0))"),
            ("overlap", "overlap.wkt",
             "MULTIPOLYGON (((0 0, 2 0, 2 2, 0 2, 0 0)), ((2 0, 4 0, 4 2, 2 2, 2 0)))"),
            ("(malformed|unreadable)", "cut.wkt.gz", whole[:len(whole) // 2]),
            ("(malformed|unreadable)", "noise.wkt.gz", b"\x1f\x8b" + bytes(range(256))),
            ("malformed", "cut.wkt", FRAME[:-20]),
            ("[a-z_]+", "empty.wkt", ""),
            ("[a-z_]+", "empty.geojson", ""),
            ("[a-z_]+", "empty.json", ""),
            ("[a-z_]+", "point.wkt", "POINT (1 1)"),
            ("[a-z_]+", "noise.bin", bytes(range(256)) * 9),
            ("[a-z_]+", "noise.shp", bytes(range(256)) * 9),
            ("[a-z_]+", "noise.json", b'{"medial": '),
        ]
        for code, name, content in cases:
            with self.subTest(name=name):
                self.write(name, content)
                text = self.refuse(code, "axis", name, "-o", "out.json")
                self.assertIn(name, text)
                self.refuse(code, "info", name)
                self.refuse(code, "draw", name, "-o", "out.svg")

    def test_missing_file_and_directory(self):
        os.mkdir(self.path("folder"))
        self.assertIn("none.wkt", self.refuse("unreadable", "axis", "none.wkt", "-o", "out.json"))
        self.assertIn("none.geojson",
                      self.refuse("unreadable", "axis", "none.geojson", "-o", "out.json"))
        self.refuse("(unreadable|unsupported)", "axis", "folder", "-o", "out.json")
        self.refuse("[a-z_]+", "axis", "/dev/null", "-o", "out.json")

    def test_the_place_is_named(self):
        self.write("bad.wkt", SQUARES + "\n" + BOW_TIE)
        text = self.refuse("crossing", "axis", "bad.wkt", "-o", "out.json")
        self.assertRegex(text, r"^medial: bad.wkt: feature 3, ring 0, .*\(1, 1\)")
        done = self.run_medial("axis", "bad.wkt", "-o", "out.json", "--json")
        error = json.loads(done.stdout)["error"]
        self.assertEqual(error["code"], "crossing")
        self.assertEqual(error["place"]["file"], "bad.wkt")
        self.assertEqual(error["place"]["feature"], 3)
        self.assertEqual((error["place"]["x"], error["place"]["y"]), (1, 1))
        self.assertTrue(error["text"])

    def test_the_first_of_many_errors_is_reported(self):
        self.write("bad.wkt", "\n".join([SQUARES] * 20 + [BOW_TIE] * 50))
        for threads in (1, 2, 8):
            self.assertIn("feature 60", self.refuse("crossing", "info", "bad.wkt", "--threads", threads))

    def test_outputs(self):
        self.write("frame.wkt", FRAME)
        os.mkdir(self.path("folder.csv"))
        self.refuse("unsupported", "axis", "frame.wkt", "-o", "out.xyz")
        self.refuse("unsupported", "axis", "frame.wkt", "-o", "out")
        self.refuse("unsupported", "axis", "frame.wkt", "-o", "-", "--format", "xyz")
        self.refuse("invalid_option", "draw", "frame.wkt", "-o", "-")
        self.refuse("invalid_option", "axis", "frame.wkt", "-o", "out.csv", "--format", "csv")
        self.refuse("invalid_option", "axis", "frame.wkt", "-o", "-", "--format", "csv", "--json")
        self.refuse("unwritable", "axis", "frame.wkt", "-o", "none/out.csv")
        self.refuse("unwritable", "axis", "frame.wkt", "-o", "folder.csv")
        self.refuse("unwritable", "axis", "frame.wkt", "-o", "frame.wkt")
        self.assertEqual(self.read("frame.wkt").decode(), FRAME)
        self.refuse("unwritable", "axis", "frame.wkt", "-o", "/proc/out.csv")

    def test_a_limit_of_file_sizes_is_an_error(self):
        self.write("frame.wkt", FRAME)
        self.write("out.csv", "precious")
        limits = resource.getrlimit(resource.RLIMIT_FSIZE)
        try:
            # Of the shapefile, GDAL's part fits.
            for name, most in (("out.csv", 100), ("out.json", 100), ("out.svg", 100), ("out.shp", 1500)):
                resource.setrlimit(resource.RLIMIT_FSIZE, (most, limits[1]))
                self.refuse("unwritable", "axis", "frame.wkt", "-o", name)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        self.assertEqual(self.read("out.csv"), b"precious")

    def test_an_output_is_refused_before_the_input_is_read(self):
        self.refuse("unwritable", "axis", "none.wkt", "-o", "none/out.csv")

    def test_an_error_leaves_an_older_output_alone(self):
        self.write("bow.wkt", BOW_TIE)
        self.write("out.csv", "precious")
        self.refuse("crossing", "axis", "bow.wkt", "-o", "out.csv")
        self.assertEqual(self.read("out.csv"), b"precious")

    def test_command_lines(self):
        self.write("frame.wkt", FRAME)
        for arguments in ([], ["axis"], ["dance"], ["axis", "frame.wkt", "--bogus"],
                          ["axis", "frame.wkt", "more"], ["axis", "frame.wkt", "--threads", "x"],
                          ["axis", "frame.wkt", "--threads", "-1"],
                          ["axis", "frame.wkt", "--threads", "99999999999999999999"],
                          ["axis", "frame.wkt", "-o", ""],
                          ["axis", "frame.wkt", "--seed", "-1"],
                          ["axis", "frame.wkt", "--seed", "99999999999999999999"],
                          ["axis", "frame.wkt", "--tolerance", "0.1"],
                          ["axis", "frame.wkt", "--tolerance", "nan"],
                          ["axis", "frame.wkt", "--tolerance", "-1e-9"],
                          ["axis", "frame.wkt", "--chord", "0"],
                          ["axis", "frame.wkt", "--chord", "nan"],
                          ["axis", "frame.wkt", "--repair=magic"],
                          ["axis", "frame.wkt", "-o"],
                          ["draw", "frame.wkt", "-o", "p.svg", "--width", "inf"],
                          ["draw", "frame.wkt", "-o", "p.svg", "--disks", "-1"]):
            with self.subTest(arguments=arguments):
                text = self.refuse("invalid_option", *arguments)
                self.assertIn("--help", text)
        done = self.run_medial("axis", "frame.wkt", "--bogus", "--json")
        self.assertEqual(json.loads(done.stdout)["error"]["code"], "invalid_option")

    def test_one_standard_input(self):
        for command in (["match"], ["nest"], ["verify"], ["rebuild", "--against"], ["voronoi", "--queries"]):
            self.assertIn("cannot both be standard input", self.refuse("invalid_option", command[0], "-", *command[1:],
                                                                       "-", given=RECTANGLE.encode()))

    def test_names_that_are_no_utf8(self):
        name = b"\xff\xfe.wkt"
        with open(os.path.join(self.folder.name.encode(), name), "w") as file:
            file.write(BOW_TIE)
        done = subprocess.run([PROGRAM.encode(), b"info", name, b"--json"], timeout=60,
                              cwd=self.folder.name, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(json.loads(done.stdout)["error"]["code"], "crossing")
        self.assertIn("\ufffd\ufffd.wkt", done.stderr.decode())

    def test_names_in_files_cannot_control_the_terminal(self):
        self.skip_without("DXF")
        square = "".join(f"10\n{x}\n20\n{y}\n" for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
        for name in ("a\x1b]0;\ab", "a\u009b31mb", "a\x7fb"):
            layer = f"0\nLWPOLYLINE\n8\n{name}\n90\n4\n70\n1\n{square}"
            self.write("a.dxf", f"0\nSECTION\n2\nENTITIES\n{layer}0\nENDSEC\n0\nEOF\n")
            report = self.refuse("invalid_option", "info", "a.dxf", "--layer", "c")
            self.assertRegex(report, "the layers are: a[^\\x00-\\x1f\\x7f-\\x9f]*b \\[")
        self.write("b.dxf", b"\xff\n")
        self.assertIn("'\ufffd' is not a group code", self.refuse("malformed", "info", "b.dxf"))


class Words(CommandLine):
    """Error messages for command lines and files that are wrong."""

    def test_options(self):
        self.write("r.wkt", RECTANGLE)
        for words, *line in (
                ("unknown option: --foo", "axis", "r.wkt", "--foo"),
                ("--chord needs a value", "axis", "r.wkt", "--chord"),
                ("--exact takes no value", "axis", "r.wkt", "--exact=18446744073709551616"),
                ("--chord is given more than once", "axis", "r.wkt", "--chord", "0.1", "--chord", "0.1"),
                ("--widest needs two values", "centreline", "r.wkt", "--widest", "1,1"),
                ("unexpected argument: more; -o names the output", "axis", "r.wkt", "more"),
                ("--threads: '1.5' is not a whole number", "axis", "r.wkt", "--threads", "1.5"),
                ("--threshold: 'abc' is not a number", "axis", "r.wkt", "--threshold", "abc"),
                ("--chord: 'x' is not a number", "axis", "r.wkt", "--chord", "x"),
                ("-1 is not a finite number above 0", "offset", "r.wkt", "--step", "-1"),
                ("inf is not a finite number above 0", "carve", "r.wkt", "--angle", "60", "--depth", "inf"),
                ("'1,,2' is not numbers separated by commas", "offset", "r.wkt", "--distance", "1,,2"),
                ("'0.5,' is not numbers separated by commas", "offset", "r.wkt", "--distance", "0.5,"),
                ("'x' is not numbers separated by commas", "offset", "r.wkt", "--distance", "x"),
                ("'1,2' is not 4 numbers separated by commas", "axis", "r.wkt", "--within", "1,2"),
                ("'1,2' is not 4 numbers separated by commas", "voronoi", "r.wkt", "--frame", "1,2"),
                ("--fit is for --method curve-axis", "axis", "r.wkt", "--fit", "1"),
                ("the text is empty", "axis", "--text", "", "--font", "f.ttf"),
                ("--angle: 200 is neither 0 nor in [1 - 170]", "carve", "r.wkt", "--angle", "200"),
                ("--angle: 0.5 is neither 0 nor in [1 - 170]", "carve", "r.wkt", "--angle", "0.5"),
                ("0 is not in [1 - 1e+06]", "measure", "r.wkt", "--samples", "0")):
            report = self.refuse("invalid_option", *line)
            self.assertIn(words, report)
            self.assertLess(len(report), 160, report)
        report = json.loads(self.succeed("offset", "r.wkt", "--distance", "0.25,0.5,-1", "--json").stdout)
        self.assertEqual(report["regions"], 3)
        self.refuse("too_large", "measure", "r.wkt", "--spacing", "1e-300", "-o", "r.svg")
        # Corners rounded by 1e-7: curvatures as unlike as that are followed.
        self.write("island.wkt", "POLYGON((0 0,10 0,14 5,10 9,4 8,0 6,0 0))")
        self.succeed("axis", "island.wkt", "--method", "curve-axis", "--fit", "1e-7", "-o", "island.json")
        self.succeed("verify", "island.wkt", "island.json")

    def test_features_count_as_in_the_file(self):
        """What is empty is left out, and the others keep their numbers in errors and notes."""
        crossing = "POLYGON EMPTY\n" + RECTANGLE + "\nPOLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))\n"
        self.write("some.wkt", crossing)
        self.assertIn("feature 2, ring 0", self.refuse("crossing", "axis", "some.wkt"))
        done = self.succeed("axis", "some.wkt", "--repair", "-o", "some.json")
        self.assertIn("1 feature is empty and was left out", done.stderr.decode())
        self.assertIn("feature 2 was repaired", done.stderr.decode())

    def test_coordinates(self):
        """The place of a coordinate that is too large or not finite is reported, whatever reads it."""
        for name, text, command, words in (
                ("far.wkt", "POLYGON ((0 0, 1e308 0, 1 1, 0 0))", "voronoi", "ring 0, vertex 1 at (1e+308, 0)"),
                ("far.txt", "0 0\n-1e308 1e308\n", "voronoi", "at (-1e+308, 1e+308)")):
            self.write(name, text)
            report = self.refuse("unsupported", command, name)
            self.assertIn(words, report)
            self.assertNotIn("4294967295", report)
        for command in ("axis", "voronoi"):
            self.write("arc.wkt", "CURVEPOLYGON (CIRCULARSTRING (0 0, 1e400 0, 2 2, 3 3, 0 0))")
            self.refuse("not_finite", command, "arc.wkt")
            self.write("line.wkt", "POLYGON ((0 0, 1e400 0, 2 2, 0 0))")
            self.assertIn("vertex 1", self.refuse("not_finite", command, "line.wkt"))
        self.write("line.geojson", json.dumps({"type": "LineString", "coordinates": [[0, 0], [1, 1]]})
                   .replace("[1, 1]", "[1e400, 1]"))
        self.refuse("not_finite", "voronoi", "line.geojson")
