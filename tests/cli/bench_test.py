"""`medial bench`."""

import json
import os

from support import CommandLine


class Bench(CommandLine):
    def test_experiments(self):
        done = self.run_medial("bench", "biarc", "--quick", "--tolerances", "2", "--json", "-q")
        report = json.loads(done.stdout)
        self.assertEqual(done.returncode, 0 if report["passed"] else 1)
        self.assertEqual(done.stderr, b"")
        self.assertEqual([row["shape"] for row in report["by_tolerance"]],
                         [name for name in ("tree", "snowflake", "lettering", "border")
                          for _ in range(2)])
        for row in report["by_tolerance"] + report["by_size"]:
            with self.subTest(shape=row["shape"], tolerance=row["tolerance"]):
                self.assertGreater(row["edges"], 1000)
                self.assertLessEqual(row["error"], row["tolerance"])
                self.assertGreater(row["leaves"], 50)
                for phase in ("conversion", "build", "axis"):
                    self.assertGreater(row["seconds"][phase]["processor"], 0)
                if row["shape"] in ("snowflake", "lettering"):
                    self.assertEqual(row["failure"], "")
        for row in report["polygons"]:  # a leaf at every convex corner of a polygon
            self.assertGreater(row["polygon_leaves"], 2 * row["arc_leaves"])
            self.assertLess(row["arc_error"], row["polygon_error"])

    def test_ridge(self):
        done = self.run_medial("bench", "ridge", "--quick", "--per-unit", "6", "-q", "-o", "ridge.csv")
        self.assertEqual(done.returncode, 0, done.stdout.decode()[-2000:])
        table = done.stdout.decode()
        self.assertIn("| 10/5 | | | | | | | | | | | | | | | | refused: crossing |", table)
        self.assertNotIn("FAILED", table)
        rows = self.read("ridge.csv").decode().splitlines()
        self.assertGreater(len(rows), 20)
        self.assertEqual({len(row.split(",")) for row in rows}, {8 + 3 * 7})

    def test_lee(self):
        done = self.run_medial("bench", "lee", "--quick", "--json", "-q")
        self.assertEqual(done.returncode, 0, done.stdout.decode()[-2000:])
        rows = json.loads(done.stdout)
        self.assertEqual({row["shape"] for row in rows}, {"coast", "maze", "blob", "convex", "regular"})
        for row in rows:
            self.assertTrue(row["passed"], row)
            self.assertGreater(row["lee"], 0)
            self.assertLess(row["crossings"], 4)
        self.succeed("bench", "lee", "--figures", "figures")
        self.assertGreaterEqual(len(os.listdir(self.path("figures"))), 6)

    def test_figures_of_axes(self):
        for experiment, names in (
            ("curve-axis", {f"curve-axis-fig{i}.svg" for i in "1 2 3 4 5a 5b 6 7a 7b 8 9a 9b".split()}),
            ("potential", {"potential-fig13.svg"}),
        ):
            self.succeed("bench", experiment, "--figures", experiment)
            self.assertEqual(set(os.listdir(self.path(experiment))), names)

    def test_outputs(self):
        quick = ("bench", "biarc", "--quick", "--tolerances", "1", "-q", "-o")
        for name, start in (("plots.svg", b"<?xml"), ("rows.csv", b"series,"), ("all.json", b"{")):
            self.assertIn(self.run_medial(*quick, name).returncode, (0, 1))
            with open(self.path(name), "rb") as file:
                self.assertTrue(file.read().startswith(start))
        self.refuse("unsupported", *quick, "plots.txt")
        self.succeed("bench", "biarc", "--shapes", "shapes")
        info = json.loads(self.succeed("info", "shapes/tree.svg", "--json").stdout)
        self.assertEqual((info["features"], info["holes"]), (1, 0))
        info = json.loads(self.succeed("info", "shapes/lettering.svg", "--json").stdout)
        self.assertEqual((info["components"], info["holes"]), (192, 128))
