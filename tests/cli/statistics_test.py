"""`--stats` and `--json`."""

import json

from support import FRAME, CommandLine


class Statistics(CommandLine):
    def test_stats_as_one_object(self):
        self.write("frame.wkt", FRAME)
        done = self.succeed("axis", "frame.wkt", "-o", "a.csv", "--stats", "--json", "--threads", 2)
        stats = json.loads(done.stdout)
        self.assertEqual(done.stderr, b"")
        for step in ("read", "shape", "axis", "write"):
            self.assertGreaterEqual(stats["seconds"][step], 0)
        self.assertEqual(stats["sites"], 12)
        self.assertEqual(stats["threads"], 2)
        self.assertEqual(stats["nodes"], stats["edges"])  # one cycle
        self.assertGreater(stats["branches"], 4)
        self.assertGreater(stats["queries_per_site"], 0)
        self.assertGreaterEqual(stats["precision_retries"], 0)
        self.assertGreater(stats["peak_bytes"], 1_000_000)
        self.assertEqual(stats["cleaned"]["closing_points"], 2)
        self.assertEqual(set(stats["phases"]), {"sites", "tree", "connect", "walk", "collect"})

    def test_stats_as_a_table(self):
        self.write("frame.wkt", FRAME)
        done = self.succeed("axis", "frame.wkt", "-o", "-", "--format", "csv", "--stats")
        self.check_csv(done.stdout.decode())
        for word in ("read", "walk", "queries per site", "precision retries", "peak bytes"):
            self.assertIn(word, done.stderr.decode())

    def test_every_command_reports_them(self):
        self.write("elbow.wkt", "POLYGON ((0 0, 8 0, 8 3, 3 3, 3 8, 0 8))")
        for command, *options in (("info",), ("voronoi",), ("compare", "--methods", "disks"),
                                  ("field", "-o", "field.PNG", "--width", "60", "--lines", "2")):
            report = json.loads(self.succeed(command, "elbow.wkt", *options, "--stats", "--json").stdout)
            self.assertGreater(report["peak_bytes"], 0)
            self.assertGreater(report["threads"], 0)
            self.assertIn("read", report["seconds"])
            self.assertIn(b"peak bytes", self.succeed(command, "elbow.wkt", *options, "--stats").stderr)
        self.assertTrue(self.read("field.PNG").startswith(b"\x89PNG"))
