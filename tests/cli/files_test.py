"""What happens to files that are there already."""

import contextlib
import gzip
import json
import os
import sqlite3
import struct
import subprocess

from support import FRAME, GEOGRAPHIC, PROGRAM, RECTANGLE, CommandLine


class Files(CommandLine):
    def test_layers_are_added_to_a_geopackage(self):
        self.write("a.wkt", RECTANGLE)
        self.write("b.wkt", FRAME)
        self.succeed("axis", "a.wkt", "-o", "t.gpkg")
        before = self.read("t.gpkg")
        self.assertIn("--overwrite", self.refuse("unwritable", "axis", "b.wkt", "-o", "t.gpkg"))
        self.assertEqual(self.read("t.gpkg"), before)
        self.succeed("features", "b.wkt", "-o", "t.gpkg")
        self.assertEqual(self.rows("axis"), 5)  # of the rectangle
        self.assertGreater(self.rows("branches"), 5)
        self.succeed("axis", "b.wkt", "-o", "t.gpkg", "--overwrite")
        self.assertGreater(self.rows("axis"), 5)
        self.assertGreater(self.rows("branches"), 5)
        self.assertEqual(self.files(), ["a.wkt", "b.wkt", "t.gpkg"])

    def rows(self, layer):
        with contextlib.closing(sqlite3.connect(self.path("t.gpkg"))) as data:
            return data.execute(f"SELECT count(*) FROM {layer}").fetchone()[0]

    def open_elsewhere(self, mode, name="t.gpkg"):
        data = sqlite3.connect(self.path(name), isolation_level=None)
        data.execute(f"PRAGMA journal_mode={mode}")
        return contextlib.closing(data)

    def test_a_geopackage_that_another_program_has_open(self):
        self.write("a.wkt", RECTANGLE)
        self.succeed("axis", "a.wkt", "-o", "t.gpkg")
        for mode in ("wal", "delete"):
            with self.open_elsewhere(mode) as data:
                data.execute("UPDATE nodes SET r = 77")  # in WAL mode still beside the file
                self.succeed("axis", "a.wkt", "-o", "t.gpkg", "--output-layer", "in_" + mode)
                self.assertEqual(data.execute(f"SELECT count(*) FROM in_{mode}").fetchone(), (5,))
                self.assertEqual(data.execute("SELECT min(r) FROM nodes").fetchone(), (77,))
                data.execute("UPDATE nodes SET r = 78")
            self.assertEqual(self.rows("in_" + mode), 5)
            self.assertEqual(self.rows("nodes WHERE r = 78"), 6)
        with self.open_elsewhere("delete") as data:
            data.execute("BEGIN IMMEDIATE")
            data.execute("CREATE TABLE mine (x)")
            self.assertIn("another program is using the file",
                          self.refuse("unwritable", "axis", "a.wkt", "-o", "t.gpkg", "--output-layer", "late"))
            data.execute("COMMIT")
        self.assertEqual(self.rows("mine"), 0)
        self.assertEqual(self.rows("sqlite_master WHERE name = 'late'"), 0)
        self.assertEqual(self.files(), ["a.wkt", "t.gpkg"])

    def test_no_layer_is_lost_between_two_runs(self):
        self.write("a.wkt", "\n".join([RECTANGLE] * 400))
        self.succeed("axis", "a.wkt", "-o", "t.gpkg")
        runs = {layer: subprocess.Popen([PROGRAM, "axis", "a.wkt", "-o", "t.gpkg", "--output-layer", layer],
                                        cwd=self.folder.name, stderr=subprocess.PIPE)
                for layer in ("first", "second", "third")}
        added = set()
        for layer, run in runs.items():
            text = run.communicate()[1].decode()
            if run.returncode == 0:
                added.add(layer)
            else:
                self.assertEqual(run.returncode, 2)
                self.assertRegex(text, "another program .* \\[unwritable\\]")
        self.assertTrue(added)
        for layer in added:
            self.assertEqual(self.rows(layer), 2000)

    def test_a_layer_with_an_index_of_a_newer_gdal(self):
        """Since 3.7, the triggers of an index have other names than GDAL before removes."""
        self.write("a.wkt", RECTANGLE)
        self.succeed("axis", "a.wkt", "-o", "t.gpkg")
        with self.open_elsewhere("delete") as data:
            data.execute("CREATE VIRTUAL TABLE rtree_axis_geom USING rtree(id, minx, maxx, miny, maxy)")
            for name in ("insert", "update2", "update4", "update5", "update6", "update7", "delete"):
                data.execute(f"CREATE TRIGGER rtree_axis_geom_{name} AFTER DELETE ON axis "
                             "BEGIN DELETE FROM rtree_axis_geom; END")
            data.execute("CREATE TABLE IF NOT EXISTS gpkg_extensions (table_name TEXT, column_name TEXT, "
                         "extension_name TEXT NOT NULL, definition TEXT NOT NULL, scope TEXT NOT NULL)")
            data.execute("INSERT INTO gpkg_extensions VALUES ('axis', 'geom', 'gpkg_rtree_index', "
                         "'http://www.geopackage.org/spec120/#extension_rtree', 'write-only')")
        self.assertEqual(self.rows("sqlite_master WHERE name LIKE 'rtree_axis_geom%' AND type = 'trigger'"), 7)
        self.succeed("axis", "a.wkt", "-o", "t.gpkg", "--overwrite")
        self.assertEqual(self.rows("sqlite_master WHERE name LIKE 'rtree_axis%'"), 0)
        self.assertEqual(self.rows("gpkg_extensions WHERE table_name = 'axis'"), 0)

    def test_layers_of_others_stay(self):
        self.write("a.wkt", RECTANGLE)
        self.succeed("features", "a.wkt", "-o", "t.gpkg")
        with self.open_elsewhere("delete") as data:
            data.execute("CREATE TABLE nodes (fid INTEGER PRIMARY KEY, name TEXT)")
            data.execute("INSERT INTO nodes VALUES (1, 'mine')")
            data.execute("INSERT INTO gpkg_contents (table_name, data_type, identifier) "
                         "VALUES ('nodes', 'attributes', 'nodes')")
        self.assertIn("other columns", self.refuse("unwritable", "axis", "a.wkt", "-o", "t.gpkg", "--overwrite"))
        self.assertEqual(self.rows("nodes WHERE name = 'mine'"), 1)
        # Nor does the default name make a layer medial's own.
        self.succeed("features", "a.wkt", "-o", "plain.gpkg")
        with self.open_elsewhere("delete", "plain.gpkg") as data:
            data.execute("CREATE TABLE axis (fid INTEGER PRIMARY KEY, name TEXT)")
            data.execute("INSERT INTO gpkg_contents (table_name, data_type, identifier) "
                         "VALUES ('axis', 'attributes', 'axis')")
        overwrite = ("axis", "a.wkt", "-o", "plain.gpkg", "--overwrite")
        self.assertIn("other columns", self.refuse("unwritable", *overwrite))
        self.succeed(*overwrite, "--output-layer", "axis")
        # Layers of another input, with other attributes, are medial's own.
        for name in ("first", "second"):
            self.write(name + ".geojson", GEOGRAPHIC.replace('"rank"', f'"{name}"'))
            self.succeed("axis", name + ".geojson", "-o", "own.gpkg", "--overwrite")

    def test_a_geopackage_without_tables_of_gdal(self):
        self.write("a.wkt", RECTANGLE)
        self.succeed("features", "a.wkt", "-o", "t.gpkg")
        with self.open_elsewhere("delete") as data:
            triggers = data.execute("SELECT name FROM sqlite_master WHERE type = 'trigger' "
                                    "AND sql LIKE '%gpkg_ogr_contents%'").fetchall()
            for (name,) in triggers:
                data.execute(f'DROP TRIGGER "{name}"')
            data.execute("DROP TABLE gpkg_ogr_contents")
        self.succeed("axis", "a.wkt", "-o", "t.gpkg")
        self.assertEqual(self.rows("axis"), 5)

    def test_extensions_in_capitals(self):
        self.write("a.wkt", RECTANGLE)
        self.succeed("axis", "a.wkt", "-o", "T.GPKG")
        self.succeed("axis", "a.wkt", "-o", "T.GPKG", "--overwrite")
        self.succeed("measure", "a.wkt", "-o", "P.CSV")
        self.succeed("carve", "a.wkt", "--angle", "60", "--post", "grbl", "-o", "P.NC")
        self.write("S.SHP", b"old")
        self.write("S.PRJ", b"old")
        self.succeed("axis", "a.wkt", "-o", "S.SHP")
        self.assertEqual([name for name in self.files() if name.startswith("S.")],
                         ["S.SHP", "S.cpg", "S.dbf", "S.shx"])
        self.assertEqual(self.read("S.SHP")[:4], b"\x00\x00\x27\x0a")
        self.succeed("axis", "a.wkt", "-o", "R.Shp")
        self.assertEqual(self.read("R.Shp"), self.read("S.SHP"))

    def test_links_and_permissions(self):
        self.write("a.wkt", RECTANGLE)
        os.mkdir(self.path("real"))
        os.symlink("real/new.json", self.path("link.json"))  # which leads to no file yet
        self.succeed("axis", "a.wkt", "-o", "link.json")
        self.assertTrue(os.path.islink(self.path("link.json")))
        os.chmod(self.path("real/new.json"), 0o600)
        self.succeed("axis", "a.wkt", "-o", "link.json")
        self.assertEqual(os.stat(self.path("real/new.json")).st_mode & 0o777, 0o600)
        # What lies beside a link to a shapefile is none of its parts.
        os.symlink("real/s.shp", self.path("s.shp"))
        for name in ("s.prj", "real/s.prj", "real/s.qix"):
            self.write(name, b"old")
        self.succeed("axis", "a.wkt", "-o", "s.shp")
        self.assertEqual(sorted(os.listdir(self.path("real"))),
                         ["new.json", "s.cpg", "s.dbf", "s.shp", "s.shx"])
        self.assertEqual(self.read("s.prj"), b"old")

    def test_the_input_is_no_output(self):
        self.write("a.wkt", RECTANGLE)
        self.succeed("axis", "a.wkt", "-o", "a.json")
        before = self.read("a.json")
        self.refuse("unwritable", "prune", "a.json", "-o", "a.json")
        self.assertEqual(self.read("a.json"), before)

    def test_layers_have_names(self):
        self.write("a.wkt", RECTANGLE)
        self.succeed("axis", "a.wkt", "-o", "t.gpkg")
        self.succeed("axis", "a.wkt", "-o", "t.gpkg", "--output-layer", "roads")
        self.succeed("measure", "a.wkt", "-o", "t.gpkg", "--transects", "3", "--output-layer", "widths")
        self.assertEqual([self.rows(layer) for layer in ("axis", "nodes", "roads", "roads_nodes", "widths")],
                         [5, 6, 5, 6, 3])
        self.assertIn("--output-layer", self.refuse("unwritable", "measure", "a.wkt", "-o", "t.gpkg", "--transects", "3",
                                                    "--output-layer", "widths"))
        self.succeed("measure", "a.wkt", "-o", "t.gpkg", "--transects", "4", "--output-layer", "widths", "--overwrite")
        self.assertEqual(self.rows("widths"), 4)
        self.refuse("invalid_option", "axis", "a.wkt", "-o", "a.wkt", "--output-layer", "roads")
        for name in ("sqlite_x", "SQLite_X", "gpkg_x", "GPKG_contents", "rtree_roads_geom", " ", "\udcff"):
            for file in ("t.gpkg", "new.gpkg"):
                said = self.refuse("invalid_option", "axis", "a.wkt", "-o", file, "--output-layer", name)
                self.assertNotIn("CREATE", said)
        self.assertNotIn("new.gpkg", self.files())
        self.assertIn("layer 'roads' already",
                      self.refuse("unwritable", "axis", "a.wkt", "-o", "t.gpkg", "--output-layer", "ROADS"))
        with sqlite3.connect(self.path("t.gpkg")) as database:
            database.execute("CREATE INDEX \"Place's\" ON roads (length)")
        for overwrite in ([], ["--overwrite"]):
            self.assertIn("something else called 'Place's'",
                          self.refuse("unwritable", "axis", "a.wkt", "-o", "t.gpkg", "--output-layer", "place's", *overwrite))
        # Any name of a layer, and any other tables beside it, such as one with as many columns.
        def rows(file, layer):
            with sqlite3.connect(self.path(file)) as database:
                return [database.execute(f'SELECT * FROM "{name}"').fetchall() for name in (layer, layer + "_nodes")]
        self.succeed("axis", "a.wkt", "-o", "u.gpkg", "--output-layer", "plain")
        expected = rows("u.gpkg", "plain")
        columns = ["7"] * (len(expected[1][0]) - 1)
        with sqlite3.connect(self.path("t.gpkg")) as database:
            database.execute("CREATE TABLE medial_rows_1 AS SELECT " + ",".join(columns))
        self.succeed("axis", "a.wkt", "-o", "t.gpkg", "--output-layer", "medial_rows_0")
        self.assertEqual(rows("t.gpkg", "medial_rows_0"), expected)

    def test_no_input_is_overwritten(self):
        self.write("a.wkt", RECTANGLE)
        self.write("b.wkt", RECTANGLE)
        self.succeed("axis", "a.wkt", "-o", "a.json")
        self.refuse("unwritable", "rebuild", "a.json", "--against", "b.wkt", "-o", "b.wkt")
        self.assertEqual(self.read("b.wkt").decode(), RECTANGLE)
        self.refuse("unwritable", "nest", "a.wkt", "b.wkt", "-o", "b.wkt")
        self.refuse("invalid_option", "measure", "a.wkt", "-o", "m.svg", "--plot", "m.svg")
        # What is read along with an input: a part of a shapefile, the image of a map.
        self.succeed("rebuild", "a.json", "-o", "s.shp")
        before = self.read("s.shp")
        self.refuse("unwritable", "centreline", "s.dbf", "-o", "s.shp")
        self.assertEqual(self.read("s.shp"), before)
        self.succeed("axis", "a.wkt", "-o", "m.png")
        before = self.read("m.png")
        for image in ("m.png", "'m.png'", "m.png  # drawn by hand", '"m.png"   '):
            self.write("m.yaml", f"image: {image}\nresolution: 1\norigin: [0, 0, 0]\n")
            self.refuse("unwritable", "axis", "m.yaml", "-o", "m.png")
            self.assertEqual(self.read("m.png"), before)
        self.write("m.yaml", gzip.compress(self.read("m.yaml")))
        self.refuse("unwritable", "axis", "m.yaml", "-o", "m.png")
        self.assertEqual(self.read("m.png"), before)
        for preview in ("p.png", "./p.png"):
            self.refuse("invalid_option", "carve", "a.wkt", "--angle", "60", "-o", "p.png", "--preview", preview)

    def test_companions_are_replaced_together(self):
        self.write("a.wkt", RECTANGLE)
        self.write("b.wkt", FRAME)
        self.succeed("axis", "a.wkt", "-o", "s.shp")
        os.remove(self.path("s.cpg"))
        os.mkdir(self.path("s.cpg"))
        parts = ["s.dbf", "s.shp", "s.shx"]
        before = [self.read(part) for part in parts]
        self.refuse("unwritable", "axis", "b.wkt", "-o", "s.shp")
        self.assertEqual([self.read(part) for part in parts], before)

    def test_shapefiles_keep_letters(self):
        names = ["\u9ec4\u6cb3", "\u0394\u03ad\u03bb\u03c4\u03b1"]
        self.write("a.geojson", json.dumps({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {"name": name}, "geometry": {
                "type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 2], [0, 2], [0, 0]]]}} for name in names]}))
        self.succeed("centreline", "a.geojson", "-o", "a.shp")
        self.assertEqual(self.read("a.cpg").strip(), b"UTF-8")
        for name in names:
            self.assertIn(name.encode(), self.read("a.dbf"))
        # Of a shapefile that is replaced nothing stays.
        for part in ("qix", "sbn", "prj"):
            self.write("a." + part, "old")
        self.write("b.wkt", RECTANGLE)
        self.succeed("axis", "b.wkt", "-o", "a.shp")
        self.assertEqual([name for name in self.files() if name.startswith("a.")],
                         ["a.cpg", "a.dbf", "a.geojson", "a.shp", "a.shx"])

    def odd_attributes(self):
        """Squares with a hole and attributes that need more than the usual room, or none."""
        odd = [("plain", 1, 1.5), ("it's \"quoted\"\t\n", -5, -2.25), ("\u2603" * 40, 10**18, 1e-20), (None, None, None),
               ("y" * 300, -(10**18), 1e8 + 0.125), ("\u00fc" * 140, 2**62, 1e20), ("", 0, 0.5)]  # fmt: skip
        self.write("odd.geojson", json.dumps({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {"name": name, "n": n, "x": x}, "geometry": {"type": "Polygon", "coordinates": [
                [[20 * i, 0], [20 * i + 9, 0], [20 * i + 9, 9], [20 * i, 9], [20 * i, 0]],
                [[20 * i + 4, 4], [20 * i + 4, 5], [20 * i + 5, 5], [20 * i + 5, 4], [20 * i + 4, 4]]]}}
            for i, (name, n, x) in enumerate(odd)]}))  # fmt: skip
        return odd

    def test_shapefiles_have_room_for_all_values(self):
        odd = self.odd_attributes()
        self.succeed("offset", "odd.geojson", "--distance", "0.25", "-o", "o.shp")
        table, shapes, index = (self.read("o." + part) for part in ("dbf", "shp", "shx"))
        count, head, size = struct.unpack("<IHH", table[4:12])
        self.assertEqual((count, len(table)), (len(odd), head + count * size + 1))
        columns = {}
        at = 1
        for field in range(32, head - 1, 32):
            columns[table[field:field + 11].rstrip(b"\0").decode()] = (at, at + table[field + 16])
            at += table[field + 16]
        self.assertEqual(at, size)
        for i, (name, n, x) in enumerate(odd):
            row = table[head + i * size:head + (i + 1) * size]
            text, whole, real = (row[slice(*columns[column])] for column in ("name", "n", "x"))
            self.assertEqual(text.decode().rstrip(" "), (name or "").encode()[:254].decode(errors="ignore"))
            if n is None:
                self.assertEqual((set(whole), set(real)), ({ord("*")}, {ord("*")}))
                continue
            self.assertEqual(int(whole), n)
            self.assertAlmostEqual(float(real) / x if x > 1e-15 else 1, 1, 12)
        # Each record begins where the index says, with an outer ring clockwise and a hole the other way.
        self.assertEqual((len(shapes), len(index)), (2 * int.from_bytes(shapes[24:28], "big"), 100 + 8 * count))
        for i in range(count):
            begin, length = (2 * number for number in struct.unpack(">II", index[100 + 8 * i:108 + 8 * i]))
            number, again = struct.unpack(">II", shapes[begin:begin + 8])
            self.assertEqual((number, 2 * again), (i + 1, length))
            parts, points, first, second = struct.unpack("<4I", shapes[begin + 44:begin + 60])
            self.assertEqual((parts, first), (2, 0))
            xy = list(struct.iter_unpack("<2d", shapes[begin + 60:begin + 8 + length]))
            self.assertEqual(len(xy), points)
            areas = []
            for ring in (xy[:second], xy[second:]):
                self.assertEqual(ring[0], ring[-1])
                areas.append(sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:])) / 2)
            self.assertAlmostEqual(areas[0], -(8.5**2), 9)
            self.assertGreater(areas[1], 1)

    def test_geopackages_count_what_they_hold(self):
        odd = self.odd_attributes()
        self.succeed("offset", "odd.geojson", "--distance", "0.25", "-o", "t.gpkg")
        self.succeed("axis", "odd.geojson", "-o", "t.gpkg")
        with sqlite3.connect(self.path("t.gpkg")) as database:
            rows = database.execute("SELECT name, n, x FROM offsets ORDER BY fid").fetchall()
            self.assertEqual([(name, n) for name, n, _ in rows], [(name, n) for name, n, _ in odd])
            for (_, _, x), (_, _, expected) in zip(rows, odd):
                self.assertEqual(x, expected)
            for table in ("offsets", "axis", "nodes"):
                count = database.execute(f"SELECT count(*), max(fid) FROM {table}").fetchone()
                told = database.execute("SELECT feature_count FROM gpkg_ogr_contents WHERE table_name = ?", [table])
                self.assertEqual((told.fetchone()[0],) * 2, count)
            extent = database.execute("SELECT min_x, min_y, max_x, max_y FROM gpkg_contents WHERE table_name = 'axis'")
            self.assertEqual(extent.fetchone(), (0, 0, 20 * len(odd) - 11, 9))
            # A row that another program adds or removes counts, too.
            database.execute("DELETE FROM offsets WHERE fid = 1")
            told = database.execute("SELECT feature_count FROM gpkg_ogr_contents WHERE table_name = 'offsets'")
            self.assertEqual(told.fetchone()[0], len(odd) - 1)
        self.assertEqual(json.loads(self.succeed("info", "t.gpkg", "--layer", "offsets", "--json").stdout)["features"],
                         len(odd) - 1)  # fmt: skip

    def test_features_keep_their_numbers(self):
        """Tables name a feature as notes do, also behind one that is left out."""
        self.write("a.wkt", "POLYGON ((0 0, 1 0, 2 0, 0 0))\n" + RECTANGLE)
        said = self.succeed("axis", "a.wkt", "--skip-invalid", "-o", "a.geojson").stderr
        self.assertIn(b"left out: feature 0", said)
        lines = json.loads(self.read("a.geojson"))["features"]
        self.assertEqual({line["properties"]["feature"] for line in lines}, {1})
        self.succeed("offset", "a.wkt", "--skip-invalid", "--distance", "0.5", "-o", "o.geojson")
        self.assertEqual(json.loads(self.read("o.geojson"))["features"][0]["properties"]["feature"], 1)
        self.succeed("measure", "a.wkt", "--skip-invalid", "--samples", "2", "-o", "m.csv")
        self.assertTrue(self.read("m.csv").splitlines()[1].startswith(b"1,"))

    def test_empty_results_and_options_without_effect(self):
        self.write("a.wkt", RECTANGLE)
        self.assertIn(b"the result is empty",
                      self.succeed("offset", "a.wkt", "--distance", "100", "-o", "o.wkt").stderr)
        for option in (["--disks", "10"], ["--contacts"], ["--nodes"], ["--no-shape"]):
            self.assertIn("pictures", self.refuse("invalid_option", "axis", "a.wkt", "-o", "a.csv", *option))
        self.succeed("axis", "a.wkt", "-o", "a.svg", "--disks", "10")
        self.assertIn("pictures", self.refuse("invalid_option", "axis", "a.wkt", "-o", "a.csv", "--width", "500"))
        for option, method in ((["--pixels", "50"], "ridge"), (["--order", "3"], "potential"),
                               (["--curve-step", "0.01"], "curve-axis"), (["--brushfire", "sides"], "brushfire")):
            self.assertIn(method, self.refuse("invalid_option", "axis", "a.wkt", *option))
