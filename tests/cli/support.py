"""What the tests of the command line share. To run one file, or one class of it, in this folder:

    MEDIAL=path/to/medial python3 -m unittest axis_test
    MEDIAL=path/to/medial python3 -m unittest axis_test.Axis
"""

import csv
import json
import math
import os
import subprocess
import tempfile
import unittest

PROGRAM = os.path.abspath(os.environ["MEDIAL"]) if "MEDIAL" in os.environ else "medial"
DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "data")

RECTANGLE = "POLYGON ((0 0, 4 0, 4 2, 0 2, 0 0))"
# A rectangle with a hole: one cycle, four reflex vertices.
FRAME = "POLYGON ((0 0, 9 0, 9 6, 0 6, 0 0), (3 2, 3 4, 6 4, 6 2, 3 2))"
# The same square three times, further and further to the right.
SQUARES = "\n".join(f"POLYGON (({x} 0, {x + 1} 0, {x + 1} 1, {x} 1, {x} 0))" for x in (0, 3, 6))
BOW_TIE = "POLYGON ((0 0, 2 2, 2 0, 0 2, 0 0))"

FORMATS = ["json", "safetensors", "geojson", "gpkg", "shp", "fgb", "wkt", "csv", "graphml",
           "nodelink", "edgelist", "dxf", "svg", "pdf", "png", "ps"]

GEOGRAPHIC = json.dumps({
    "type": "FeatureCollection",
    "features": [
        {"type": "Feature", "properties": {"name": name, "rank": rank},
         "geometry": {"type": "Polygon", "coordinates": [
             [[x, 47], [x + 0.1, 47], [x + 0.1, 47.05], [x, 47.05], [x, 47]]]}}
        for name, rank, x in (("west", 1, 9.0), ("east", 2, 9.3))]})


def comb(teeth):
    """A comb with square teeth: 4 vertices per tooth."""
    points = [(0, 0), (2 * teeth - 1, 0)]
    for i in reversed(range(teeth)):
        points += [(2 * i + 1, 4), (2 * i, 4)]
        if i > 0:
            points += [(2 * i, 1), (2 * i - 1, 1)]
    points.append(points[0])
    return "POLYGON ((" + ", ".join(f"{x} {y}" for x, y in points) + "))"


def star(vertices):
    """A jagged star-shaped polygon without any symmetry."""
    points = []
    for i in range(vertices):
        angle = 2 * math.pi * i / vertices
        radius = 100 + 7 * math.sin(5 * angle) + (i * 7919 % 101) / 101
        points.append((radius * math.cos(angle), radius * math.sin(angle)))
    points.append(points[0])
    return "POLYGON ((" + ", ".join(f"{x:.17g} {y:.17g}" for x, y in points) + "))"


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def write(self, name, content):
        mode = "wb" if isinstance(content, bytes) else "w"
        with open(self.path(name), mode) as file:
            file.write(content)
        return name

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def files(self):
        return sorted(os.listdir(self.folder.name))

    def run_medial(self, *arguments, given=b""):
        """Runs in the temporary folder; a crash or a hang fails the test."""
        done = subprocess.run([PROGRAM, *map(str, arguments)], input=given, cwd=self.folder.name,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=300)
        self.assertIn(done.returncode, (0, 1, 2), (arguments, done.stderr))
        return done

    def lacks(self, what):
        """Whether the program was built without DXF, or without exact decisions."""
        if what == "DXF":
            name, content, command, message = "probe.dxf", "", ("info",), b"without DXF"
        else:
            name, content, command, message = "probe.wkt", RECTANGLE, ("axis", "--exact"), b"no exact decisions"
        errors = self.run_medial(*command, self.write(name, content)).stderr
        os.remove(self.path(name))
        return message in errors

    def supported(self, *names):
        """The names, without drawings (.dxf) if the program was built without DXF."""
        without = self.lacks("DXF")
        return [name for name in names if not (without and name.endswith(".dxf"))]

    def skip_without(self, what):
        if self.lacks(what):
            self.skipTest("built without " + what)

    def succeed(self, *arguments, given=b""):
        done = self.run_medial(*arguments, given=given)
        self.assertEqual(done.returncode, 0, (arguments, done.stderr.decode()))
        return done

    def refuse(self, code, *arguments, given=b"", nothing_new=True):
        """Expects exit status 2, one line that ends with the code, and no new file."""
        before = self.files()
        done = self.run_medial(*arguments, given=given)
        text = done.stderr.decode()
        self.assertEqual(done.returncode, 2, (arguments, text))
        self.assertEqual(text.count("\n"), 1, text)
        self.assertTrue(text.startswith("medial: "), text)
        self.assertRegex(text, rf"\[{code}\]")
        if nothing_new:
            self.assertEqual(self.files(), before)
        return text

    def rows(self, text):
        return list(csv.DictReader(text.decode().splitlines()))

    def check_csv(self, text):
        rows = list(csv.reader(text.splitlines()))
        self.assertEqual(rows[0], ["edge", "x", "y", "r"])
        edges = {}
        for edge, x, y, r in rows[1:]:
            edges.setdefault(edge, []).append((x, y, r))
            self.assertGreaterEqual(float(r), 0)
        self.assertTrue(all(len(points) >= 2 for points in edges.values()))
        return edges
