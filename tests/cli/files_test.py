"""What happens to files that are there already."""

import contextlib
import sqlite3

from support import FRAME, RECTANGLE, CommandLine


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

    def test_the_input_is_no_output(self):
        self.write("a.wkt", RECTANGLE)
        self.succeed("axis", "a.wkt", "-o", "a.json")
        before = self.read("a.json")
        self.refuse("unwritable", "prune", "a.json", "-o", "a.json")
        self.assertEqual(self.read("a.json"), before)

    def test_empty_results_and_options_without_effect(self):
        self.write("a.wkt", RECTANGLE)
        self.assertIn(b"the result is empty",
                      self.succeed("offset", "a.wkt", "--distance", "100", "-o", "o.wkt").stderr)
        for option in (["--disks", "10"], ["--contacts"], ["--nodes"], ["--no-shape"]):
            self.assertIn("pictures", self.refuse("invalid_option", "axis", "a.wkt", "-o", "a.csv", *option))
        self.succeed("axis", "a.wkt", "-o", "a.svg", "--disks", "10")
