"""Files of many features, read, computed and written part by part."""

import gzip
import json
import random
import sqlite3

from support import CommandLine, star


def footprints(count, seed=1):
    """L-shapes on a grid, as rings."""
    chance = random.Random(seed)
    for i in range(count):
        x, y = 30 * (i % 200), 30 * (i // 200)
        a, b, c, d = (round(chance.uniform(low, low + 5), 2) for low in (10, 10, 3, 3))
        yield [(x + u, y + v) for u, v in ((0, 0), (a, 0), (a, c), (d + 1, c), (d + 1, b), (d, b + 1), (0, b + 1), (0, 0))]


def wkt(rings, decimals=None):
    """With many decimals few features are a large file."""
    number = repr if decimals is None else f"{{:.{decimals}f}}".format
    return "".join("POLYGON ((" + ", ".join(f"{number(x)} {number(y)}" for x, y in ring) + "))\n" for ring in rings)


def geojson(rings):
    features = [
        {
            "type": "Feature",
            "properties": {"number": i, "name": f"house {i % 97}", "code": "007" if i % 2 else str(i)},
            "geometry": {"type": "Polygon", "coordinates": [ring]},
        }
        for i, ring in enumerate(rings)
    ]
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}}
    return json.dumps({"type": "FeatureCollection", "crs": crs, "features": features})


class Stream(CommandLine):
    """A file above 1 MiB goes part by part; compressed below that, it is read as a whole."""

    def both_ways(self, name, text, output, *more, command="axis"):
        """The names of the outputs, and what standard error says, of the file in parts and whole."""
        self.write(name, text)
        self.write(name + ".gz", gzip.compress(text.encode()))
        self.assertGreater(len(text), 1 << 20)
        self.assertLess(len(self.read(name + ".gz")), 1 << 20)
        said = {}
        for folder, source in (("whole_", name + ".gz"), ("parts_", name), ("one_", name)):
            threads = "1" if folder == "one_" else "2"
            target = ["-o", folder + "a." + output] if output else []
            done = self.run_medial(command, source, *target, "--threads", threads, *more)
            printed = done.stdout.decode()
            printed = printed.rpartition(";")[0] or printed  # without the seconds
            said[folder] = done.returncode, (printed + done.stderr.decode()).replace(source, "FILE")
        self.assertEqual(said["whole_"], said["parts_"])
        self.assertEqual(said["whole_"], said["one_"])
        return said["whole_"]

    def assert_same(self, output):
        whole, parts, one = (self.read(f"{way}_a.{output}").replace(f"{way}_a".encode(), b"a")
                             for way in ("whole", "parts", "one"))  # fmt: skip
        self.assertTrue(whole == parts, output)
        self.assertTrue(whole == one, output)

    def test_bytes_are_those_of_the_whole(self):
        text = wkt(footprints(12000))
        for output in ("csv", "wkt", "json", "geojson"):
            self.assertEqual(self.both_ways("f.wkt", text, output)[0], 0)
            self.assert_same(output)

    def test_centre_lines_are_those_of_the_whole(self):
        text = wkt(footprints(9000))
        for options in ([], ["--all"], ["--clearance", "1.5"], ["--smooth", "1"]):
            self.assertEqual(self.both_ways("f.wkt", text, "csv", *options, command="centreline")[0], 0)
            self.assert_same("csv")
        self.assertIn("main paths", self.both_ways("f.wkt", text, "csv", "--trim", "0", command="centreline")[1])

    def test_offsets_are_those_of_the_whole(self):
        text = wkt(footprints(9000))
        for output, options in (("json", ["--distance", "0.5,-1,1"]), ("wkt", ["--step", "0.8"]),
                                ("geojson", ["--step", "1", "--chord", "1e-2"])):  # fmt: skip
            self.assertEqual(self.both_ways("f.wkt", text, output, *options, command="offset")[0], 0)
            self.assert_same(output)
        self.assertIn("result is empty", self.both_ways("f.wkt", text, "wkt", "--distance", "50", command="offset")[1])
        self.assertIn("9000 features, ", self.both_ways("f.wkt", text, "", "--distance", "1", command="offset")[1])

    def test_measures_are_those_of_the_whole(self):
        text = wkt(footprints(2500), 30)
        for output, options in (("csv", ["--samples", "5"]), ("geojson", ["--spacing", "4"]), ("wkt", ["--necks", "1"])):
            said = self.both_ways("f.wkt", text, output, *options, command="measure")
            self.assertEqual((said[0], said[1].count("\n")), (0, 2501))
            self.assert_same(output)
        said = self.both_ways("f.wkt", text, "", "--quiet", command="measure")
        self.assertEqual((said[0], said[1].count("\n")), (0, 2501))
        said = self.both_ways("f.wkt", text, "wkt", "--disks", "2", command="measure")
        self.assertEqual((said[0], said[1].count("\n")), (0, 5001))
        self.assert_same("wkt")
        # One after another, layers of a text cannot go part by part.
        self.both_ways("f.wkt", text, "geojson", "--necks", "1", "--disks", "1", command="measure")
        self.assert_same("geojson")

    def test_summaries_are_those_of_the_whole(self):
        """Without an output nothing is held either."""
        text = wkt(footprints(9000))
        for command, what in (("axis", "9000 features"), ("prune", "branches"), ("centreline", "9000 lines")):
            self.assertIn(what, self.both_ways("f.wkt", text, "", command=command)[1])

    def test_seconds_are_those_of_all_parts(self):
        self.write("f.wkt", wkt(footprints(9000)))
        done = json.loads(self.run_medial("axis", "f.wkt", "--json", "--stats").stdout)
        self.assertGreater(done["seconds"]["stream"], done["phases"]["walk"] / (2 * done["threads"]))

    def test_attributes_and_reference_systems_are_those_of_the_whole(self):
        text = geojson(footprints(5000))
        self.both_ways("f.geojson", text, "geojson")
        self.assert_same("geojson")
        self.both_ways("f.geojson", text, "gpkg")
        self.assert_same_tables("axis", "nodes")
        for command, options, tables in (
                ("offset", ["--distance", "1"], ["offsets"]),
                ("measure", ["--spacing", "3", "--disks", "2"], ["transects", "disks"])):  # fmt: skip
            self.both_ways("f.geojson", text, "gpkg", *options, "--overwrite", command=command)
            self.assert_same_tables(*tables)

    def assert_same_tables(self, *tables):
        for table in tables:
            rows = []
            for way in ("whole", "parts", "one"):
                with sqlite3.connect(self.path(f"{way}_a.gpkg")) as database:
                    rows.append(database.execute(f"SELECT * FROM {table} ORDER BY fid").fetchall())
            self.assertGreaterEqual(len(rows[0]), 5000)
            self.assertTrue(rows[0] == rows[1] == rows[2], table)

    def test_errors_are_those_of_the_whole_and_leave_nothing(self):
        rings = list(footprints(12000))
        rings[7000] = [(0, 0), (2, 2), (2, 0), (0, 2), (0, 0)]
        rings[4000] = rings[8000] = [(0, 0), (1, 0), (2, 0), (0, 0)]
        status, said = self.both_ways("f.wkt", wkt(rings), "geojson")
        self.assertEqual(status, 2)
        self.assertIn("feature 4000", said)
        self.assertEqual(self.files(), ["f.wkt", "f.wkt.gz"])
        status, said = self.both_ways("f.wkt", wkt(rings), "geojson", "--skip-invalid")
        self.assertEqual(status, 0)
        self.assertIn("feature 7000", said)
        self.assertIn("3 of 12000 features are invalid", said)
        self.assert_same("geojson")


    def test_features_that_cannot_be_computed_are_left_out_alike(self):
        """Lenses of arcs that cross by less than rounding."""
        lens = ("CURVEPOLYGON(CIRCULARSTRING(2798.022421286098 -1222.5305835539248, 2798.101237045189 -1220.5320825031088, "
                "2798.022411911622 -1222.5305831841974, 2797.5873111288874 -1222.932658966175, "
                "2797.989384474963 -1223.367761999909, 2798.424489759799 -1222.965691089996, "
                "2798.022421286098 -1222.5305835539248))\n")  # fmt: skip
        lines = wkt(footprints(9000)).splitlines(keepends=True)
        lines[:13] = [lens] * 13
        lines[100] = wkt([[(0, 0), (1, 0), (2, 0), (0, 0)]])
        text = "".join(lines)
        for output, command, *more in (("geojson", "axis"), ("csv", "prune"), ("wkt", "offset", "--distance", "1"),
                                       ("csv", "centreline"), ("csv", "measure", "--samples", "3")):  # fmt: skip
            status, said = self.both_ways("f.wkt", text, output, "--skip-invalid", *more, command=command)
            self.assertEqual(status, 0)
            self.assertIn("left out: feature 0, ring 0", said)
            self.assertIn("note: 3 more notes like these", said)
            self.assertIn("note: 1 of 9000 features is invalid and was left out", said)
            self.assertIn("note: 13 features could not be computed and were left out", said)
            self.assert_same(output)
        self.assertIn(" 8986 features, ", self.both_ways("f.wkt", text, "", "--skip-invalid")[1])
        status, said = self.both_ways("f.wkt", text.replace(lines[100], lines[99]), "csv")
        self.assertEqual((status, said.count("\n")), (2, 1))
        self.assertIn("feature 0, ring 0", said)
        self.assertNotIn("--repair", said)

    def test_all_features_of_a_part_may_be_left_out(self):
        """Squares that no grid of such pixels holds."""
        rings = list(footprints(13000))
        rings[3000:7000] = [[(0, 0), (4e6, 0), (4e6, 4e6), (0, 4e6), (0, 0)]] * 4000
        options = ["--skip-invalid", "--method", "ridge", "--resolution", "0.5"]
        status, said = self.both_ways("f.wkt", wkt(rings), "csv", *options)
        self.assertEqual(status, 0)
        self.assertIn("left out: feature 3000: the grid has more than 2^31 pixels", said)
        self.assertIn("4000 features could not be computed and were left out", said)
        self.assert_same("csv")


class InParts(CommandLine):
    """One shape whose axis is written while it grows."""

    def rows(self, name):
        edges = {}
        for line in self.read(name).decode().splitlines()[1:]:
            edge, *disk = line.split(",")
            edges.setdefault(edge, []).append(tuple(disk))
        return sorted(min(samples, samples[::-1]) for samples in edges.values())

    def test_edges_are_those_of_the_whole(self):
        self.write("star.wkt", star(20_000))
        said = [self.succeed("axis", "star.wkt", "-o", name, "--json", *more).stdout
                for name, more in (("whole.csv", []), ("parts.csv", ["--parts"]))]  # fmt: skip
        self.assertEqual(self.rows("whole.csv"), self.rows("parts.csv"))
        whole, parts = map(json.loads, said)
        for name in ("features", "sites", "nodes", "edges", "branches", "deepest"):
            self.assertEqual(whole[name], parts[name], name)
        self.assertAlmostEqual(whole["length"] / parts["length"], 1, 12)
        self.assertNotEqual(self.read("whole.csv"), self.read("parts.csv"))
        self.succeed("axis", "star.wkt", "--parts")

    def test_native_files_hold_the_same_axis(self):
        self.write("star.wkt", star(20_000))
        for name in ("parts.json", "parts.safetensors"):
            self.succeed("axis", "star.wkt", "-o", name, "--parts")
            self.succeed("verify", "star.wkt", name)
        self.assertEqual(self.succeed("info", "parts.json").stdout.replace(b"json", b"safetensors"),
                         self.succeed("info", "parts.safetensors").stdout)  # fmt: skip

    def test_what_is_not_written_so(self):
        self.write("star.wkt", star(50))
        for more in (["-o", "a.gpkg"], ["-o", "-", "--format", "csv"], ["-o", "a.csv", "--exact"],
                     ["-o", "a.csv", "--method", "lee"], ["-o", "a.csv", "--exterior"]):  # fmt: skip
            self.refuse("invalid_option", "axis", "star.wkt", "--parts", *more)
