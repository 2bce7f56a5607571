"""`medial_papers`: what it writes for each paper."""

import json
import os
import subprocess
import xml.etree.ElementTree as ElementTree

from support import CommandLine

PAPERS = os.path.abspath(os.environ.get("MEDIAL_PAPERS", "medial_papers"))


class Papers(CommandLine):
    def run_papers(self, *arguments):
        """Runs in the temporary folder; a crash or a hang fails the test."""
        done = subprocess.run([PAPERS, *arguments], cwd=self.folder.name,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=300)
        self.assertIn(done.returncode, (0, 1, 2), (arguments, done.stderr))
        return done

    def quick(self, paper, *arguments):
        done = self.run_papers(paper, "--quick", "-o", "out", *arguments)
        self.assertEqual(done.stderr, b"")
        return done.returncode

    def rows_of(self, name):
        return self.rows(self.read(name))

    def check_figures(self, paper, names):
        for name in names:
            ElementTree.fromstring(self.read(f"out/{paper}/{name}.svg"))

    def test_aichholzer(self):
        status = self.quick("aichholzer_2009")
        by_tolerance = self.rows_of("out/aichholzer_2009/by_tolerance.csv")
        by_size = self.rows_of("out/aichholzer_2009/by_size.csv")
        polygons = self.rows_of("out/aichholzer_2009/polygons.csv")
        passed = all(row["verified"] == "yes" for row in by_tolerance + by_size + polygons)
        self.assertEqual(status, 0 if passed else 1)
        self.assertEqual([row["shape"] for row in by_tolerance],
                         [name for name in ("tree", "snowflake", "lettering", "border")
                          for _ in range(2)])
        for row in by_tolerance + by_size:
            with self.subTest(shape=row["shape"], tolerance=row["tolerance"]):
                self.assertGreater(int(row["arcs"]), 1000)
                self.assertLessEqual(float(row["error"]), float(row["tolerance"]))
                self.assertGreater(int(row["leaves"]), 50)
                for phase in ("conversion", "build", "axis"):
                    self.assertGreater(float(row[f"{phase} s"]), 0)
                if row["shape"] in ("snowflake", "lettering"):
                    self.assertEqual(row["verified"], "yes")
        for row in polygons:  # a leaf at every convex corner of a polygon
            self.assertGreater(int(row["leaves of the polygon"]), 2 * int(row["leaves of arcs"]))
            self.assertLess(float(row["error of arcs"]), float(row["error of the polygon"]))
        self.assertTrue(self.read("out/aichholzer_2009/plots.svg").startswith(b"<?xml"))
        for name, expected in (("tree", (1, 1, 0)), ("lettering", (1, 192, 128))):
            shape = f"out/aichholzer_2009/{name}.svg"
            info = json.loads(self.succeed("info", shape, "--json").stdout)
            self.assertEqual((info["features"], info["components"], info["holes"]), expected)

    def test_volkmann_stclair(self):
        picture = ("11000000", "11000000", "11000000", "11111100", "11111100", "00000010")
        self.write("l.pbm", "P1\n8 6\n" + "".join(picture))  # two strokes, a pixel over a corner
        block, tee = "M0 0H60V40H42L38 12H22L18 40H0z", "M0 0H14L17 30L45 33V47H-28V33L-3 30z"
        for name, path in ("block", block), ("tee", tee):
            self.write(name + ".svg", f'<svg xmlns="http://www.w3.org/2000/svg"><path d="{path}"/></svg>')
        self.assertEqual(self.quick("volkmann_stclair_1987", "--files", "l.pbm", "block.svg", "tee.svg"), 0)
        folder = "out/volkmann_stclair_1987/"
        table = self.read(folder + "tables.md").decode()
        self.assertIn("| 10/5 | | | | | | | | | | | | | | | | refused: crossing |", table)
        self.assertNotIn("FAILED", table)
        rows = self.read(folder + "rows.csv").decode().splitlines()
        self.assertGreater(len(rows), 20)
        self.assertEqual({len(row.split(",")) for row in rows}, {8 + 3 * 7})
        self.assertTrue(self.read(folder + "plots.svg").startswith(b"<?xml"))
        accuracy = self.read(folder + "accuracy.md").decode()
        self.assertEqual(len(accuracy.splitlines()), 4)
        self.assertRegex(accuracy, r"\| l \| 19 \|.* 0 \(0 %\) \|$")  # the exact axis loses nothing
        self.assertEqual(len(self.rows_of(folder + "accuracy.csv")), 2 * 6)
        plain, paired = self.rows_of(folder + "packing.csv")
        self.assertEqual((plain["parts"], plain["taken"], paired["pairs tried"]), ("2", "0", "1"))
        self.assertEqual(paired["that save"], "1")  # the stem in the slot
        self.assertLessEqual(float(paired["height"]), float(plain["height"]))
        self.check_figures("volkmann_stclair_1987", ("fig14", "plots", "packing"))

    def test_lee(self):
        self.assertEqual(self.quick("lee_1982"), 0)
        rows = self.rows_of("out/lee_1982/rows.csv")
        self.assertEqual({row["shape"] for row in rows}, {"coast", "maze", "blob", "convex", "regular"})
        for row in rows:
            self.assertEqual(row["verified"], "yes", row)
            self.assertGreater(float(row["lee s"]), 0)
            self.assertLess(float(row["crossings/N"]), 4)
        self.check_figures("lee_1982", [f"fig{i}" for i in "1 2 3 4 5 6a 6b 6c".split()] + ["plots"])

    def test_shaked_bruckstein(self):
        self.assertEqual(self.quick("shaked_bruckstein_1996"), 0)
        names = [f"fig{i}" for i in "1 2 3 4 5a 5b 6 7a 7b 8 9a 9b".split()]
        self.assertEqual(set(os.listdir(self.path("out/shaked_bruckstein_1996"))),
                         {f"{name}.svg" for name in names} | {"tables.md", "curves.csv"})
        for row in self.rows_of("out/shaked_bruckstein_1996/curves.csv"):
            self.assertEqual(int(row["first attempt"]) + int(row["with smaller steps"]) + int(row["refused"]),
                             int(row["simple"]), row)
            self.assertEqual(int(row["not verified"]), 0, row)
            self.assertLess(float(row["largest distance"]), 1e-6)
        self.check_figures("shaked_bruckstein_1996", names)

    def test_ahuja_chuang(self):
        self.write("square.wkt", "POLYGON ((0 0, 2 0, 2 2, 0 2, 0 0))")
        self.assertEqual(self.quick("ahuja_chuang_1997", "--files", "square.wkt"), 0)
        self.assertEqual([row["shape"] for row in self.rows_of("out/ahuja_chuang_1997/mean.csv")],
                         ["rectangle", "L", "hand", "polygon 1", "polygon 2", "square"])
        for row in self.rows_of("out/ahuja_chuang_1997/largest.csv"):  # hundredths of the size
            self.assertLess(float(row["adaptive"]), 1.1)
        self.check_figures("ahuja_chuang_1997", ["fig13"] + [
            f"fig{i}-{shape}-{order}" for shape in ("rectangle", "L", "hand")
            for i, order in ((6, 1), (12, 4), (12, 8))])

    def test_refusals(self):
        self.write("file", "")
        for *arguments, words in (("lee_1983", "-o", "out", "lee_1983"),
                                  ("lee_1982", "--output is required"),
                                  ("lee_1982", "--quick", "-o", "file", "[unwritable]"),
                                  ("ahuja_chuang_1997", "-o", "out", "--files", "no.wkt", "[unreadable]")):
            done = self.run_papers(*arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(words, (done.stdout + done.stderr).decode())
