"""`medial axis`: formats, curves, statistics, streams."""

import gzip
import json
import sqlite3
import struct
import xml.etree.ElementTree as ElementTree

from support import FORMATS, FRAME, GEOGRAPHIC, RECTANGLE, SQUARES, CommandLine, comb, star


class Axis(CommandLine):
    def test_every_format_is_written_and_is_what_it_claims(self):
        self.write("frame.wkt", FRAME)
        for extension in FORMATS:
            with self.subTest(extension=extension):
                if extension == "dxf":
                    self.skip_without("DXF")
                output = "out." + extension
                self.succeed("axis", "frame.wkt", "-o", output)
                content = self.read(output)
                self.assertGreater(len(content), 50)
                self.check_content(extension, content)
        leftovers = [name for name in self.files() if not name.startswith(("out.", "frame"))]
        self.assertEqual(leftovers, [])

    def test_standard_output_takes_every_format(self):
        self.write("frame.wkt", FRAME)
        for extension in ("json", "geojson", "wkt", "csv", "svg", "pdf", "png", "ps"):
            with self.subTest(extension=extension):
                done = self.succeed("axis", "frame.wkt", "-o", "-", "--format", extension)
                self.write("out." + extension, done.stdout)
                self.check_content(extension, done.stdout)

    def check_content(self, extension, content):
        if extension in ("json", "geojson"):
            parsed = json.loads(content)
            if extension == "geojson":
                self.assertEqual(parsed["type"], "FeatureCollection")
                kinds = {f["geometry"]["type"] for f in parsed["features"]}
                self.assertIn("LineString", kinds)
        elif extension == "gpkg":
            self.assertTrue(content.startswith(b"SQLite format 3\0"))
            with sqlite3.connect(self.path("out.gpkg")) as database:
                layers = [row[0] for row in database.execute(
                    "select table_name from gpkg_contents where data_type = 'features'")]
                self.assertEqual(len(layers), 2)
                for layer in layers:
                    (rows,) = database.execute(f'select count(*) from "{layer}"').fetchone()
                    self.assertGreater(rows, 3)
            database.close()
        elif extension == "shp":
            self.assertEqual(struct.unpack(">i", content[:4])[0], 9994)
            self.assertEqual(2 * struct.unpack(">i", content[24:28])[0], len(content))
            self.assertIn("out.dbf", self.files())
        elif extension == "fgb":
            self.assertTrue(content.startswith(b"fgb"))
        elif extension == "wkt":
            self.assertRegex(content, rb"^(MULTI)?LINESTRING")
        elif extension == "csv":
            self.check_csv(content.decode())
        elif extension == "dxf":
            self.assertTrue(content.endswith(b"0\nEOF\n"))
            self.assertIn(b"\nSPLINE\n", content)
        elif extension == "svg":
            self.assertTrue(ElementTree.fromstring(content).tag.endswith("svg"))
        elif extension == "pdf":
            self.assertTrue(content.startswith(b"%PDF-"))
            self.assertIn(b"%%EOF", content[-32:])
        elif extension == "png":
            self.assertTrue(content.startswith(b"\x89PNG\r\n\x1a\n"))
            self.assertEqual(struct.unpack(">I", content[16:20])[0], 1024)
        elif extension == "ps":
            self.assertTrue(content.startswith(b"%!PS"))

    def test_a_rectangle_has_its_five_edges(self):
        self.write("rectangle.wkt", RECTANGLE)
        csv_text = self.succeed("axis", "rectangle.wkt", "-o", "-", "--format", "csv").stdout
        edges = self.check_csv(csv_text.decode())
        ends = sorted(tuple(map(float, p)) for points in edges.values()
                      for p in (points[0], points[-1]))
        expected = sorted([(0, 0, 0), (1, 1, 1), (0, 2, 0), (1, 1, 1), (4, 0, 0), (3, 1, 1),
                           (4, 2, 0), (3, 1, 1), (1, 1, 1), (3, 1, 1)])
        self.assertEqual(len(ends), 10)
        for got, wanted in zip(ends, expected):
            for a, b in zip(got, wanted):
                self.assertAlmostEqual(a, b, delta=1e-14)

    def test_nodes_are_printed_alike_and_chord_adds_rows(self):
        self.write("frame.wkt", FRAME)
        counts = []
        for chord in ("1e-2", "1e-5"):
            text = self.succeed("axis", "frame.wkt", "-o", "-", "--format", "csv", "--chord",
                                chord).stdout.decode()
            edges = self.check_csv(text)
            counts.append(sum(map(len, edges.values())))
            ends = [p for points in edges.values() for p in (points[0], points[-1])]
            exact = {p for p in ends}
            rounded = {tuple(round(float(v), 9) for v in p) for p in ends}
            self.assertEqual(len(exact), len(rounded))
        self.assertLess(counts[0], counts[1])

    def test_pipes(self):
        self.write("frame.wkt", FRAME)
        with open(self.path("frame.wkt"), "rb") as given:
            text = self.succeed("axis", "-", "-o", "-", "--format", "csv", given=given.read())
        self.check_csv(text.stdout.decode())
        text = self.succeed("axis", "-", "-o", "-", "--format", "csv",
                            given=b"0 0\n4 0\n4 2\n0 2\n").stdout.decode()
        self.assertEqual(len(self.check_csv(text)), 5)
        text = self.succeed("axis", "-", "-o", "-", "--format", "csv", "--quiet",
                            given=GEOGRAPHIC.encode()).stdout.decode()
        self.assertEqual(len(self.check_csv(text)), 10)

    def test_many_features_keep_order_and_attributes(self):
        self.write("places.geojson", GEOGRAPHIC)
        self.succeed("axis", "places.geojson", "-o", "axes.geojson")
        features = json.loads(self.read("axes.geojson"))["features"]
        lines = [f for f in features if f["geometry"]["type"] == "LineString"]
        self.assertEqual(len(lines), 10)
        names = [f["properties"]["name"] for f in lines]
        self.assertEqual(names, ["west"] * 5 + ["east"] * 5)

    def test_texts_of_digits_stay_texts(self):
        self.write("places.geojson", GEOGRAPHIC.replace('"rank"', '"zip": "10115", "rank"'))
        self.succeed("axis", "places.geojson", "-o", "direct.geojson")
        for name in ("gpkg", "json", "safetensors"):
            self.succeed("axis", "places.geojson", "-o", "a." + name)
        self.succeed("prune", "a.json", "-o", "pruned.geojson")
        self.succeed("prune", "a.safetensors", "-o", "columns.geojson")
        for name in ("direct", "pruned", "columns"):
            features = json.loads(self.read(name + ".geojson"))["features"]
            self.assertEqual({f["properties"]["zip"] for f in features}, {"10115"}, name)
            self.assertEqual({f["properties"]["rank"] for f in features}, {1, 2}, name)
        with sqlite3.connect(self.path("a.gpkg")) as database:
            self.assertEqual({row[0] for row in database.execute("SELECT typeof(zip) FROM axis")}, {"text"})

    def test_where_and_layer_select(self):
        self.write("places.geojson", GEOGRAPHIC)
        line = self.succeed("axis", "places.geojson", "--where", "rank > 1", "--json").stdout
        self.assertEqual(json.loads(line)["features"], 1)
        self.refuse("[a-z_]+", "axis", "places.geojson", "--layer", "nowhere")
        self.refuse("[a-z_]+", "axis", "places.geojson", "--where", "rank >")
        self.assertIn("the fields are name rank", self.refuse("invalid_option", "axis", "places.geojson", "--where", "rnk > 1"))

    def test_without_output_a_summary_is_printed(self):
        self.write("rectangle.wkt", RECTANGLE)
        text = self.succeed("axis", "rectangle.wkt").stdout.decode()
        self.assertRegex(text, r"^rectangle.wkt: 1 feature, 4 sites, 6 nodes, 5 edges, 5 branches; "
                               r"deepest disk: radius 1 at \([13], 1\); [^\n]+ s\n$")

    def test_the_same_bytes_for_any_number_of_threads(self):
        self.write("star.wkt", star(2000) + "\n" + FRAME + "\n" + SQUARES + "\n" + comb(200))
        for extension in ("json", "csv", "svg", "geojson"):
            outputs = set()
            for threads in (1, 2, 8):
                # One name for all: some formats name their layer by it.
                self.succeed("axis", "star.wkt", "-o", "o." + extension, "--threads", threads)
                outputs.add(self.read("o." + extension))
            self.assertEqual(len(outputs), 1, extension)

    def test_the_native_format_is_an_input_too(self):
        self.write("shapes.wkt", FRAME + "\n" + SQUARES)
        self.succeed("axis", "shapes.wkt", "-o", "a.json")
        self.succeed("axis", "a.json", "-o", "b.json")
        self.assertEqual(self.read("a.json"), self.read("b.json"))

    def test_drawings_have_the_radius_as_z_on_request(self):
        self.skip_without("DXF")
        self.write("a.wkt", RECTANGLE)
        self.succeed("axis", "a.wkt", "-o", "a.dxf")
        self.assertIn("LWPOLYLINE", self.read("a.dxf").decode())
        self.succeed("axis", "a.wkt", "-o", "b.dxf", "--radius-as-z")
        self.assertNotIn("LWPOLYLINE", self.read("b.dxf").decode())
        self.assertEqual(self.succeed("axis", "a.wkt", "-o", "-", "--format", "dxf", "--radius-as-z").stdout,
                         self.read("b.dxf"))

    def test_options_that_would_have_no_effect(self):
        self.write("a.wkt", RECTANGLE)
        self.refuse("invalid_option", "axis", "a.wkt", "-o", "a.json", "--radius-as-z")
        self.refuse("invalid_option", "axis", "a.wkt", "--smooth-contour")
        for option in (["--smooth-contour"], ["--threshold", "4"], ["--invert"], ["--labels"]):
            self.assertIn("standard input", self.refuse("invalid_option", "axis", "-", *option, given=self.read("a.wkt")))

    def test_touching_rings(self):
        self.write("touch.wkt",
                   "POLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (0 4, 2 3, 2 5, 0 4))\n"
                   "POLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (2 2, 4 4, 4 2, 2 2), (4 4, 6 6, 4 6, 4 4))")
        self.succeed("axis", "touch.wkt", "-o", "touch.json")
        self.succeed("verify", "touch.wkt", "touch.json")
        self.succeed("axis", "touch.json", "-o", "again.json")
        self.succeed("verify", "touch.wkt", "again.json")

    def test_compressed_and_large_text(self):
        self.write("comb.wkt.gz", gzip.compress(comb(20000).encode()))
        done = self.succeed("axis", "comb.wkt.gz", "-o", "comb.csv", "--json")
        self.assertEqual(json.loads(done.stdout)["features"], 1)
        # One edge and more for every tooth, each with two rows or more.
        self.assertGreater(self.read("comb.csv").count(b"\n"), 80000)
