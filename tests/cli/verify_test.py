"""`medial verify`."""

import itertools
import json
import re

from support import FRAME, RECTANGLE, SQUARES, CommandLine


class Verify(CommandLine):
    def setUp(self):
        super().setUp()
        self.write("shapes.wkt", FRAME + "\n" + SQUARES)
        self.succeed("axis", "shapes.wkt", "-o", "axes.json")

    def test_exact_axes(self):
        self.skip_without("exact decisions")
        self.write("shapes.wkt", FRAME + "\n" + RECTANGLE)
        self.write("round.svg", '<svg><ellipse rx="4" ry="2"/><rect width="6" height="2" rx="1"/></svg>')
        for shapes in ("shapes.wkt", "round.svg"):
            self.succeed("axis", "--exact", shapes, "-o", "exact.json")
            report = json.loads(self.succeed("verify", shapes, "exact.json", "--json").stdout)
            self.assertTrue(report["passed"])

    def test_a_computed_axis_passes(self):
        done = self.succeed("verify", "shapes.wkt", "axes.json")
        self.assertIn("passed", done.stdout.decode())
        verdict = json.loads(self.succeed("verify", "shapes.wkt", "axes.json", "--json").stdout)
        self.assertTrue(verdict["passed"])
        self.assertEqual(verdict["features"], 4)
        self.assertEqual((verdict["holes"], verdict["cycles"]), (1, 1))
        self.assertLess(verdict["largest_residual"], 1e-12)
        self.assertAlmostEqual(verdict["shape_area"], 9 * 6 - 3 * 2 + 3, delta=1e-9)
        self.assertEqual(len(verdict["certificates"]), 4)

    def test_what_is_not_checked_is_null(self):
        self.succeed("prune", "axes.json", "-o", "pruned.json")
        verdict = json.loads(self.succeed("verify", "shapes.wkt", "pruned.json", "--json").stdout)
        self.assertTrue(verdict["part"])
        for one in [verdict, *verdict["certificates"]]:
            self.assertEqual([one[name] for name in ("shape_area", "disks_area", "largest_uncovered")], [None] * 3)

    def test_the_axis_of_another_shape_is_refused(self):
        self.write("moved.wkt", FRAME.replace("3 4, 6 4", "3 5, 6 4") + "\n" + SQUARES)
        done = self.run_medial("verify", "moved.wkt", "axes.json")
        self.assertEqual(done.returncode, 1)
        self.assertIn("FAILED", done.stdout.decode())
        done = self.run_medial("verify", "moved.wkt", "axes.json", "--json")
        self.assertEqual(done.returncode, 1)
        verdict = json.loads(done.stdout)
        self.assertFalse(verdict["passed"])
        self.assertGreater(len(verdict["failures"]), 0)
        self.assertFalse(verdict["certificates"][0]["passed"])
        self.assertTrue(verdict["certificates"][1]["passed"])

    def test_a_fitted_axis_needs_the_same_fit(self):
        self.write("gear.svg", '<svg><path d="M0,0L8,0L8,1L14,1L14,7L0,7Z"/></svg>')
        self.succeed("axis", "gear.svg", "--method", "curve-axis", "--fit", "0.5", "-o", "fit.json")
        self.succeed("verify", "gear.svg", "fit.json", "--fit", "0.5")
        done = self.run_medial("verify", "gear.svg", "fit.json")
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"--fit", done.stderr)
        self.assertIn(b"medial verify fit.json fit.json", done.stderr)
        self.succeed("verify", "fit.json", "fit.json")
        self.succeed("rebuild", "fit.json", "-o", "shape.json")
        self.assertIn("no axes", self.refuse("malformed", "verify", "gear.svg", "shape.json"))

    def test_what_of_an_exterior_is_checked(self):
        self.succeed("axis", "shapes.wkt", "--exterior", "-o", "around.json")
        table = self.succeed("verify", "shapes.wkt", "around.json").stdout.decode()
        self.assertIn("exterior ", table)
        self.assertNotIn("area", table)
        self.assertNotIn("component", table)
        self.assertTrue(json.loads(self.succeed("verify", "shapes.wkt", "around.json", "--json").stdout)["exterior"])

    def test_errors(self):
        self.write("one.wkt", FRAME)
        self.refuse("malformed", "verify", "one.wkt", "axes.json")
        self.refuse("[a-z_]+", "verify", "shapes.wkt", "shapes.wkt")
        self.refuse("unreadable", "verify", "shapes.wkt", "none.json")
        self.refuse("unreadable", "verify", "none.wkt", "axes.json")
        self.refuse("invalid_option", "verify", "-", "-")

    def test_a_damaged_file_is_refused(self):
        content = self.read("axes.json")
        for share in (0.1, 0.5, 0.9, 0.999):
            self.write("cut.json", content[:int(share * len(content))])
            self.refuse("(malformed|unsupported|unreadable)", "verify", "shapes.wkt", "cut.json")
        # Any number replaced by one far out of range must be reported, never followed.
        numbers = list(re.finditer(rb"(?<=[\[,:])\d+(?=[\],}])", content))
        commands = itertools.cycle((["verify", "shapes.wkt", "damaged.json"], ["info", "damaged.json"],
                                    ["draw", "damaged.json", "-o", "-", "--format", "svg"],
                                    ["axis", "damaged.json"]))
        for match, command in zip(numbers[::max(1, len(numbers) // 60)], commands):
            damaged = content[:match.start()] + b"4000000000" + content[match.end():]
            self.write("damaged.json", damaged)
            self.run_medial(*command)
