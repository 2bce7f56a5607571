"""What readers must not do: swap axes, lose or renumber features, ignore options, cut texts."""

import array
import glob
import gzip
import json
import os
import random
import resource
import socket
import struct
import subprocess
import zipfile

from support import BOW_TIE, FRAME, GEOGRAPHIC, PROGRAM, RECTANGLE, CommandLine


def feature(rings, **properties):
    geometry = None if rings is None else {"type": "Polygon", "coordinates": rings}
    return {"type": "Feature", "properties": properties, "geometry": geometry}


def square(x, y, size=1):
    return [[[x, y], [x + size, y], [x + size, y + size], [x, y + size], [x, y]]]


def collection(*features, crs="EPSG::25832"):
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:" + crs}}
    return json.dumps({"type": "FeatureCollection", "crs": crs, "features": features})


class HeaderOfColumns(CommandLine):
    def test_a_header_may_put_y_first(self):
        corners = [(50, 10), (54, 10), (54, 20)]
        for number, (header, swapped, noted) in enumerate((
                ("lat,lon", True, False), ("y,x", True, False), ('"Latitude";"Longitude"', True, False),
                ("northing easting", True, False), ("x,y", False, False), ("lon,lat", False, False),
                ("a,b", False, True), ("lat,height", False, True))):
            name = self.write(f"{number}.csv", header + "\n" + "".join(f"{a},{b}\n" for a, b in corners))
            done = self.succeed("info", name, "--json")
            extent = json.loads(done.stdout)["extent"]
            self.assertEqual(extent[:2], [10, 50] if swapped else [50, 10], header)
            self.assertEqual(b"taken as x and y" in done.stderr, noted, header)


class NumbersOfFeatures(CommandLine):
    def test_features_keep_their_numbers(self):
        point = {"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [0, 0]}}
        for first in (feature(None), point):
            self.write("a.geojson", collection(first, feature(square(0, 0), n=1), feature(square(3, 0), n=2)))
            for command, *more in (("axis",), ("offset", "--distance", 0.1), ("voronoi", "--method", "lee"), ("rebuild",)):
                self.succeed(command, "a.geojson", *more, "-o", "b.geojson")
                own = [one["properties"] for one in json.loads(self.read("b.geojson"))["features"]]
                for properties in own:
                    if "feature" in properties and "n" in properties:
                        self.assertEqual(properties["feature"], properties["n"], command)
                if command != "rebuild":
                    self.assertEqual({one["feature"] for one in own}, {1, 2}, command)
            self.succeed("offset", "a.geojson", "--loose", "--distance", 0.1, "-o", "b.geojson")
            own = [one["properties"] for one in json.loads(self.read("b.geojson"))["features"]]
            self.assertTrue(all(one["feature"] == 0 for one in own))
            self.assertEqual({one["n"] for one in own if one["features"] == [2]}, {2})
            self.succeed("features", "a.geojson", "-o", "f.csv")
            self.assertEqual({row["feature"] for row in self.rows(self.read("f.csv"))}, {"1", "2"})
            near = json.loads(self.succeed("voronoi", "a.geojson", "--nearest", "3.5,0.5", "--json").stdout)["nearest"][0]
            self.assertEqual((near["feature"], near["attributes"]), (2, {"n": "2"}))
            self.succeed("features", "a.geojson", "-o", "f.json")
            self.assertEqual([item["feature"] for item in json.loads(self.read("f.json"))["items"]], [1, 2])
            matches = json.loads(self.succeed("match", "a.geojson", "a.geojson", "--each", "--json").stdout)["matches"]
            self.assertEqual({one["shape"] for one in matches}, {"a.geojson#1", "a.geojson#2"})
            compared = self.succeed("compare", "a.geojson", "--methods", "disks").stdout.decode()
            self.assertEqual([line for line in compared.splitlines() if line.startswith("feature")], ["feature 1", "feature 2"])
            self.succeed("measure", "a.geojson", "--plot", "m.svg")
            self.write("all.geojson", collection(feature(square(0, 0), n=1), feature(square(3, 0), n=2)))
            self.succeed("measure", "all.geojson", "--plot", "n.svg")
            self.assertNotEqual(self.read("m.svg"), self.read("n.svg"))  # the titles
            deepest = json.loads(self.succeed("axis", "a.geojson", "--json").stdout)["deepest"]
            self.assertEqual(deepest["feature"], 1)
            crossed = [[[0, 0], [2, 2], [2, 0], [0, 2], [0, 0]]]
            self.write("c.geojson", collection(first, feature(square(5, 0)), feature(crossed)))
            self.assertIn("feature 2", self.refuse("crossing", "axis", "c.geojson"))

    def test_also_where_the_file_is_streamed(self):
        chance = random.Random(1)
        features = [feature(None, n=0)]
        for n in range(1, 4000):
            x, y = 3 * (n % 100), 3 * (n // 100)
            a, b = (chance.uniform(1, 2) for _ in range(2))
            features.append(feature([[[x, y], [x + a, y], [x + a, y + b], [x, y + 1.5], [x, y]]], n=n, name="n" * 200))
        text = collection(*features)
        self.assertGreater(len(text), 1 << 20)
        self.write("a.geojson", text)
        self.write("b.geojson.gz", gzip.compress(text.encode()))
        for name in ("a.geojson", "b.geojson.gz"):
            self.succeed("axis", name, "-o", name[0] + "_axis.geojson")
            own = [one["properties"] for one in json.loads(self.read(name[0] + "_axis.geojson"))["features"]]
            self.assertTrue(all(one["feature"] == one["n"] for one in own), name)
            self.assertEqual(len({one["feature"] for one in own}), 3999, name)


class OptionsOfFiles(CommandLine):
    def test_stored_axes_refuse_options_of_reading(self):
        self.write("places.geojson", GEOGRAPHIC)
        self.succeed("axis", "places.geojson", "-o", "geo.json")
        for command in ("prune", "rebuild", "draw", "features", "info", "centreline"):
            for option in (("--project",), ("--layer", "nope"), ("--where", "x > 1"), ("--repair",),
                           ("--crs", "EPSG:25832"), ("--close",)):
                self.refuse("invalid_option", command, "geo.json", *option)
        self.assertIn("images", self.refuse("invalid_option", "prune", "geo.json", "--threshold", 3))
        self.assertIn(b"--project", self.succeed("prune", "geo.json", "-o", "b.json").stderr)
        self.assertEqual(self.succeed("prune", "geo.json", "-o", "c.json", "--quiet").stderr, b"")

    def test_a_second_file_has_the_options_that_apply_to_it(self):
        self.write("a.wkt", FRAME)
        self.write("b.wkt", RECTANGLE + "\n" + RECTANGLE)
        self.write("tie.wkt", BOW_TIE)
        self.write("a.pgm", "P2\n8 8\n9\n" + "\n".join("0 0 5 5 5 5 0 0" for _ in range(8)))
        self.succeed("axis", "a.wkt", "-o", "a.json")
        # The axis has no rings to repair, the shapes have.
        self.refuse("crossing", "match", "a.json", "tie.wkt")
        self.succeed("match", "a.json", "tie.wkt", "--repair")
        self.succeed("match", "tie.wkt", "a.json", "--repair")
        self.refuse("invalid_option", "match", "a.json", "a.json", "--repair")
        self.succeed("rebuild", "a.json", "--against", "a.wkt", "--repair")
        self.succeed("match", "a.pgm", "a.wkt", "--threshold", 3)
        self.succeed("match", "a.wkt", "a.pgm", "--threshold", 3)
        self.refuse("invalid_option", "match", "a.wkt", "a.wkt", "--threshold", 3)

    def test_a_text_is_no_text_for_the_second_file(self):
        fonts = glob.glob("/usr/share/fonts/**/*.ttf", recursive=True)
        if not fonts:
            self.skipTest("no font")
        self.write("a.wkt", RECTANGLE)
        text = ["--text", "l", "--font", fonts[0]]
        self.succeed("rebuild", *text, "--against", "a.wkt")
        self.succeed("match", *text, "a.wkt")
        self.assertNotIn("font", self.run_medial("nest", *text, "a.wkt").stderr.decode())


class NamedPipes(CommandLine):
    def test_a_pipe_by_its_name_is_as_standard_input(self):
        self.write("a.wkt", FRAME)
        self.write("a.geojson", collection(feature(square(0, 0), n=1)))
        self.write("a.pgm", "P2\n8 8\n9\n" + "\n".join("0 0 5 5 5 5 0 0" for _ in range(8)))
        self.succeed("axis", "a.wkt", "-o", "a.json")
        for name in ("a.wkt", "a.geojson", "a.pgm", "a.json"):
            for command in ("info", "axis"):
                by_dash = self.succeed(command, "-", "--json", given=self.read(name)).stdout
                by_name = self.succeed(command, "/dev/stdin", "--json", given=self.read(name)).stdout
                strip = lambda text: {k: v for k, v in json.loads(text).items() if k not in ("input", "seconds")}
                self.assertEqual(strip(by_name), strip(by_dash), (name, command))

    def test_a_pipe_made_by_mkfifo(self):
        self.write("a.wkt", FRAME)
        self.write("tie.wkt", BOW_TIE)
        self.write("a.pgm", "P2\n8 8\n9\n" + "\n".join("0 0 5 5 5 5 0 0" for _ in range(8)))
        os.mkfifo(self.path("pipe"))

        def piped(name, *arguments):
            script = f"cat {name} > pipe & exec timeout 60 '{PROGRAM}' {' '.join(arguments)}"
            return subprocess.run(["bash", "-c", script], cwd=self.folder.name, capture_output=True)

        for name in ("a.wkt", "a.pgm"):
            done = piped(name, "axis", "pipe", "-o", "b.json")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.succeed("axis", name, "-o", "c.json")
            self.assertEqual(self.read("b.json"), self.read("c.json"), name)
        self.assertIn(b"--repair", piped("tie.wkt", "axis", "pipe").stderr)
        self.assertIn(b"--repair", piped("tie.wkt", "voronoi", "pipe").stderr)
        self.assertIn(b"not in pipes", piped("a.pgm", "axis", "pipe", "--mask", "-o", "m.png").stderr)

    def test_shapes_of_a_pipe_have_their_axes_computed(self):
        self.write("a.wkt", FRAME)
        self.succeed("rebuild", "a.wkt", "-o", "shapes.json")
        self.succeed("prune", "shapes.json", "-o", "a.json")
        self.succeed("prune", "-", "-o", "b.json", given=self.read("shapes.json"))
        self.assertEqual(self.read("a.json"), self.read("b.json"))
        wide = [json.loads(self.succeed("prune", "shapes.json", *more, "--json").stdout)["deepest"]["radius"]
                for more in ((), ("--scale", 2))]
        self.assertEqual(wide[1], 2 * wide[0])

    def test_a_file_without_an_extension_is_known_by_its_beginning(self):
        for name, text in (("shape", FRAME), ("places", collection(feature(square(0, 0))))):
            self.write(name, text)
            self.succeed("axis", name, "-o", "a.json")
            with open(self.path(name), "rb") as file:
                done = subprocess.run([PROGRAM, "axis", "/dev/stdin", "-o", "b.json"], cwd=self.folder.name,
                                      stdin=file, capture_output=True, timeout=60)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(self.read("a.json"), self.read("b.json"))

    def test_two_pipes(self):
        self.write("a.wkt", FRAME)
        script = f"'{PROGRAM}' match <(cat a.wkt) <(cat a.wkt)"
        done = subprocess.run(["bash", "-c", script], cwd=self.folder.name, capture_output=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(b"0.0000", done.stdout)


class LabelsAndHeaders(CommandLine):
    def test_many_labels_take_the_time_of_their_pixels(self):
        """Labels times pixels are 6e10."""
        chance = random.Random(4)
        size, labels = 1000, 60000
        values = array.array("H", bytes(2 * size * size))
        for label, place in enumerate(chance.sample(range(size * size), labels), 1):
            values[place] = label
        values.byteswap()
        self.write("a.pgm", f"P5\n{size} {size}\n65535\n".encode() + values.tobytes())
        info = json.loads(self.succeed("info", "a.pgm", "--labels", "--json").stdout)
        self.assertEqual(info["features"], labels)

    def test_labels_have_the_outlines_of_their_masks(self):
        """Labels that are spread over the whole image: each with many parts, some in holes of others."""
        chance = random.Random(3)
        size, labels = 40, 6
        values = [[chance.randrange(labels) for _ in range(size)] for _ in range(size)]
        rows = "\n".join(" ".join(map(str, row)) for row in values)
        self.write("a.pgm", f"P2\n{size} {size}\n{labels}\n{rows}\n")
        info = json.loads(self.succeed("info", "a.pgm", "--labels", "--json").stdout)
        self.assertEqual(info["features"], labels - 1)
        # Each label alone, as a mask, has the same outline.
        self.succeed("rebuild", "a.pgm", "--labels", "--pixel-outline", "-o", "all.wkt")
        own = self.read("all.wkt").decode().splitlines()
        for label in range(1, labels):
            mask = "\n".join(" ".join(str(int(value == label)) for value in row) for row in values)
            self.write("one.pgm", f"P2\n{size} {size}\n1\n{mask}\n")
            self.succeed("rebuild", "one.pgm", "--pixel-outline", "-o", "one.wkt")
            self.assertEqual(own[label - 1], self.read("one.wkt").decode().rstrip("\n"))

    def test_labels_are_whole_numbers(self):
        self.write("a.tif", self.tiff(1.5, 2, 0))
        self.write("b.tif", self.tiff(-1, 2, 0))
        self.assertIn("whole numbers", self.refuse("malformed", "info", "a.tif", "--labels"))
        done = self.succeed("info", "b.tif", "--labels", "--json")
        self.assertEqual(json.loads(done.stdout)["features"], 1)
        self.assertIn(b"1 pixel has a value below 0", done.stderr)

    @staticmethod
    def tiff(*row):
        """A TIFF of one row of 32-bit real numbers."""
        pixels = struct.pack(f"<{len(row)}f", *row)
        # Width, height, bits, compression, meaning, place, channels, rows, bytes and kind of number.
        tags = ((256, len(row)), (257, 1), (258, 32), (259, 1), (262, 1), (273, 8), (277, 1), (278, 1),
                (279, len(pixels)), (339, 3))
        directory = b"".join(struct.pack("<HHII", tag, 4, 1, value) for tag, value in tags)
        return (b"II*\0" + struct.pack("<I", 8 + len(pixels)) + pixels
                + struct.pack("<H", len(tags)) + directory + bytes(4))

    def test_a_header_takes_no_memory(self):
        """A bitmap of 46,000 x 46,000 pixels is 264 MB."""
        for number, begin in enumerate(("P4\n46000 46000\n", "P1\n46000 46000\n1 0 1", "P5\n46000 46000\n255\n", "P2\n46000 46000\n255\n7 ")):
            name = self.write(f"{number}.pgm", begin)
            limit = lambda: resource.setrlimit(resource.RLIMIT_DATA, (200 << 20, 200 << 20))
            done = subprocess.run([PROGRAM, "info", name], cwd=self.folder.name, capture_output=True,
                                  timeout=60, preexec_fn=limit)
            if b"ReserveShadowMemoryRange" in done.stderr:
                self.skipTest("sanitizers take more memory than that for themselves")
            self.assertIn(b"[malformed]", done.stderr, begin)


class ReadingDetails(CommandLine):
    def test_a_pole_that_rounding_moved(self):
        ring = [[[-10, -80], [0, -90.00000000000003], [10, -80], [-10, -80]]]
        self.write("a.geojson", collection(feature(ring), crs="OGC:1.3:CRS84"))
        info = self.succeed("info", "a.geojson", "--json")
        self.assertIn("WGS 84", json.loads(info.stdout)["crs"])
        self.succeed("axis", "a.geojson", "--project", "-o", "b.geojson")
        ring[0][1][1] = -90.1
        self.write("a.geojson", collection(feature(ring), crs="OGC:1.3:CRS84"))
        self.refuse("invalid_option", "axis", "a.geojson", "--project")

    def test_a_reference_system_in_grads(self):
        self.write("a.wkt", "POLYGON ((2 54, 2.02 54, 2.02 54.02, 2 54.02, 2 54))")
        done = self.succeed("info", "a.wkt", "--crs", "EPSG:4807", "--project").stderr.decode()
        self.assertRegex(done, r"at 1\.80\d\d, 48\.60\d\d")  # nine tenths
        self.write("a.wkt", "POLYGON ((2 95, 2.02 95, 2.02 95.02, 2 95.02, 2 95))")
        done = self.succeed("info", "a.wkt", "--crs", "EPSG:4807", "--project").stderr.decode()
        self.assertRegex(done, r"at 1\.80\d\d, 85\.50\d\d")
        self.assertIn("degrees", self.refuse("invalid_option", "info", "a.wkt", "--crs", "EPSG:4326", "--project"))
        # A file says so itself.
        self.succeed("rebuild", "a.wkt", "--crs", "EPSG:4807", "-o", "a.gpkg")
        self.assertIn("NTF", json.loads(self.succeed("info", "a.gpkg", "--json").stdout)["crs"])
        # Through a pipe, without the name that GDAL gets for it.
        self.assertNotIn(b"note", self.succeed("info", "-", given=self.read("a.gpkg")).stderr)
        self.assertNotIn("vsimem", self.refuse("malformed", "info", "-", given=self.read("a.gpkg")[:5000]))

    def test_attributes_have_one_type_whatever_the_command(self):
        self.write("a.geojson", collection(feature(square(0, 0, 4), pop=5, zip="01115", share=0.5, region="x")))
        for command, *more in (("axis",), ("rebuild",), ("offset", "--distance", 0.5)):
            self.succeed(command, "a.geojson", *more, "-o", "b.geojson")
            text = self.read("b.geojson").decode()
            own = json.loads(text)["features"][0]["properties"]
            self.assertEqual((own["pop"], own["zip"], own["share"]), (5, "01115", 0.5), command)
            if command == "offset":
                self.assertEqual((own["region"], own["region_1"]), (0, "x"))

    def test_many_notes_are_cut_short(self):
        self.write("a.wkt", RECTANGLE + "\n" + "\n".join(
            f"POLYGON (({x} 0, {x + 2} 2, {x + 2} 0, {x} 2, {x} 0))" for x in range(10, 210, 4)))
        notes = self.succeed("axis", "a.wkt", "--skip-invalid", "-o", "a.json").stderr.decode().splitlines()
        self.assertLess(len(notes), 15)
        self.assertTrue(any("50 of 51 features are invalid" in note for note in notes), notes)
        self.assertTrue(any("40 more notes like these" in note for note in notes), notes)

    def test_messages(self):
        self.write("a.pgm", "P2\n8 8\n9\n" + "\n".join("0 0 5 5 5 5 0 0" for _ in range(8)))
        self.assertNotIn("--format", self.refuse("invalid_option", "distance", "a.pgm", "-o", "-"))
        self.write("a.yaml", "image: a.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nfree_thresh: abc\n")
        self.assertIn("free_thresh", self.refuse("malformed", "info", "a.yaml"))
        self.write("a.geojson", collection(feature(square(0, 0), name="a]]>b")))
        self.succeed("axis", "a.geojson", "-o", "a.graphml")
        self.assertIn(b"a]]&gt;b", self.read("a.graphml"))


class Servers(CommandLine):
    def test_files_open_no_connections(self):
        with socket.create_server(("127.0.0.1", 0)) as server:
            url = "http://127.0.0.1:%d/a" % server.getsockname()[1]
            link = {"type": "link", "properties": {"href": url, "type": "proj4"}}
            self.write("link.geojson", json.dumps({"type": "FeatureCollection", "crs": link,
                                                   "features": [feature(square(0, 0))]}))
            self.assertIn(url.encode(), self.succeed("info", "link.geojson").stderr)
            layer = "<OGRVRTDataSource><OGRVRTLayer name='a'><SrcDataSource>{}</SrcDataSource></OGRVRTLayer></OGRVRTDataSource>"
            self.write("curl.vrt", layer.format("/vsicurl/" + url + ".geojson"))
            self.write("stream.vrt", layer.format("/vsigzip//vsicurl_streaming/" + url + ".geojson"))
            with zipfile.ZipFile(self.path("a.zip"), "w") as archive:
                archive.write(self.path("curl.vrt"), "curl.vrt")
            self.write("base.vrt", layer.format("PG:host=127.0.0.1 port=" + url[17:-2]))
            self.write("wfs.xml", f"<OGRWFSDataSource><URL>{url}</URL></OGRWFSDataSource>")
            for name in ("curl.vrt", "stream.vrt", "/vsizip/a.zip/curl.vrt", "base.vrt", "wfs.xml"):
                self.refuse("malformed", "info", name)
            server.setblocking(False)
            self.assertRaises(BlockingIOError, server.accept)
        # A virtual layer of a file beside it is read.
        self.write("own.geojson", collection(feature(square(0, 0))))
        self.write("own.vrt", layer.format("own.geojson").replace("'a'", "'own'"))
        self.succeed("info", "own.vrt")


class Beside(CommandLine):
    def test_nothing_is_written_beside_what_is_read(self):
        polygon = ("<gml:Polygon><gml:outerBoundaryIs><gml:LinearRing><gml:coordinates>0,0 4,0 4,2 0,2 0,0"
                   "</gml:coordinates></gml:LinearRing></gml:outerBoundaryIs></gml:Polygon>")
        self.write("a.gml", "<wfs:FeatureCollection xmlns:wfs='http://www.opengis.net/wfs' xmlns:gml="
                   "'http://www.opengis.net/gml' xmlns:f='http://f'><gml:featureMember><f:a><f:g>" + polygon +
                   "</f:g></f:a></gml:featureMember></wfs:FeatureCollection>")
        before = self.files()
        self.succeed("info", "a.gml")
        self.assertEqual(self.files(), before)
