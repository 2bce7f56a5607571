"""`--exterior` of every command that has it."""

import json
import math
import os

from support import DATA, CommandLine


class Exterior(CommandLine):
    def test_exterior_of_other_commands(self):
        """A bay 2 wide and 4 deep in a square, a hole, and the enclosure: measure, prune, features, carve."""
        self.write("bay.wkt", "POLYGON ((0 0, 10 0, 10 10, 6 10, 6 6, 4 6, 4 10, 0 10, 0 0), (2 2, 2 3, 5 3, 5 2, 2 2))")
        report = json.loads(self.succeed("measure", "bay.wkt", "--exterior", "--json").stdout)["features"][0]
        self.assertEqual([line["closed"] for line in report["lines"]], [False, False])
        self.assertEqual(sorted(round(line["narrowest_width"], 9) for line in report["lines"]), [1, 2])
        self.succeed("measure", "bay.wkt", "--exterior", "--margin", "3", "-o", "m.svg")
        self.refuse("[a-z_]+", "measure", "bay.wkt", "--exterior", "--disks", "2")
        self.refuse("[a-z_]+", "measure", "bay.wkt", "--margin", "2")
        plan = os.path.join(DATA, "plan.wkt")
        self.succeed("axis", plan, "--exterior", "--method", "potential", "-o", "plan.json")
        self.succeed("verify", plan, "plan.json")
        # A shape, its stored interior axis and its stored exterior axis give the same.
        self.succeed("axis", "bay.wkt", "-o", "inside.json")
        self.succeed("axis", "bay.wkt", "--exterior", "-o", "around.json")
        for command, options in (("prune", ["--by", "angle"]), ("features", [])):
            texts = []
            for source, exterior in (("bay.wkt", ["--exterior"]), ("inside.json", ["--exterior"]),
                                     ("around.json", ["--exterior"]), ("around.json", [])):
                self.succeed(command, source, *options, *exterior, "-o", "out.json")
                texts.append(self.read("out.json"))
            self.assertEqual(len(set(texts)), 1, command)
            self.succeed(command, "inside.json", *options, "-o", "out.json")
            self.assertNotEqual(self.read("out.json"), texts[0])
        self.succeed("prune", "bay.wkt", "--exterior", "-o", "pruned.json")
        item = json.loads(self.read("pruned.json"))["items"][0]
        self.assertEqual(item["axis"]["exterior"], 5)
        self.succeed("verify", "bay.wkt", "around.json")
        # Carving around the shape reaches the enclosure's corners, and the hole's bottom.
        for scale in ("1", "10"):
            margin = str(2 * float(scale))
            report = json.loads(self.succeed("carve", "bay.wkt", "--angle", "90", "--exterior", "--margin", margin,
                                             "--scale", scale, "-o", "c.csv", "--json").stdout)
            self.assertGreater(report["paths"], 1)
            rows = self.rows(self.read("c.csv"))
            ends = {(float(row["x"]) / float(scale), float(row["y"]) / float(scale)) for row in rows}
            for corner in ((-2, -2), (12, 12), (2, 2), (5, 3)):
                self.assertTrue(any(math.dist(corner, end) < 1e-9 for end in ends), corner)
            # Deepest before the bay, between its corners and the enclosure: (12 - y)^2 = 1 + (y - 10)^2.
            self.assertAlmostEqual(min(float(row["z"]) for row in rows), -1.25 * float(scale), delta=1e-3 * float(scale))
        self.refuse("invalid_option", "carve", "bay.wkt", "--units", "mm", "--angle", "90", "--exterior", "--margin", "1e9")
        # Drawn as it is stored; by several methods; and with the bay's bottom and the hole's corners filled.
        self.succeed("draw", "bay.wkt", "--exterior", "-o", "drawn.svg")
        self.succeed("draw", "around.json", "-o", "stored.svg")
        self.assertEqual(self.read("drawn.svg"), self.read("stored.svg"))
        report = json.loads(self.succeed("compare", "bay.wkt", "--exterior", "--methods", "disks,ridge", "-o", "both.svg",
                                         "--json").stdout)["features"][0]
        self.assertEqual([(row["passed"], row["parts"]) for row in report], [(True, 2), (True, 2)])
        self.assertLess(report[0]["radius_error"], 1e-12)
        self.assertEqual(self.run_medial("compare", "bay.wkt", "--exterior", "--methods", "brushfire").returncode, 1)
        report = json.loads(self.succeed("smooth", "bay.wkt", "--exterior", "--significance", "0.5", "--json").stdout)
        # Four corners of the hole and two of the bay are arcs of half of their widths now.
        self.assertAlmostEqual(report["area"] - (100 - 8 - 3), (1 - math.pi / 4) * (4 * 0.25 + 2 * 1), delta=1e-6)
