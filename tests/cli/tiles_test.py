"""`medial tiles`: axes in tiles."""

import json

from support import FRAME, SQUARES, CommandLine, comb, star


class Tiles(CommandLine):
    def graph(self, name):
        """Of each feature the edges by their sites, and nodes that are the same to ten digits."""
        graphs = []
        for item in json.loads(self.read(name))["items"]:
            axis = item["axis"]
            nodes = sorted(tuple(round(value, 10) + 0.0 for value in node[:3]) for node in axis["nodes"])
            graphs.append((sorted(tuple(sorted(edge[2:4])) for edge in axis["edges"]), nodes, axis["sites"]))
        return graphs

    def test_axis(self):
        """The graph of the whole, for any number of tiles; holes; several features; a certificate."""
        for name, text in (("star", star(300)), ("comb", comb(30)), ("frame", FRAME), ("squares", SQUARES)):
            self.write(f"{name}.wkt", text)
            self.succeed("axis", f"{name}.wkt", "-o", "whole.json")
            for tiles in ("1", "4", "60", "1024"):
                self.succeed("tiles", f"{name}.wkt", "--tiles", tiles, "-o", "tiles.json")
                self.assertEqual(self.graph("tiles.json"), self.graph("whole.json"), (name, tiles))
                self.succeed("verify", f"{name}.wkt", "tiles.json")

    def test_report(self):
        """A row a level, the leaves first; all edges of the axis are finished somewhere."""
        self.write("star.wkt", star(300))
        report = json.loads(self.succeed("tiles", "star.wkt", "--tiles", "17", "--json").stdout)
        self.assertEqual([row["level"] for row in report["levels"]], [3, 2, 1, 0])
        self.assertEqual(sum(row["axis"] for row in report["levels"]), report["edges"])
        self.assertGreaterEqual(report["levels"][0]["edges"], 300)
        self.assertEqual(report["levels"][-1]["tiles"], 1)
        table = self.succeed("tiles", "star.wkt").stdout.decode().splitlines()
        self.assertEqual(table[0].split(), ["level", "tiles", "edges", "most", "axis"])
        self.assertEqual([line.split()[0] for line in table[1:]], ["1", "0"])

    def test_runs_are_alike(self):
        """Files hold no times, and nothing else that differs from run to run."""
        self.write("star.wkt", star(300))
        once, again, alone = (self.succeed("tiles", "star.wkt", *threads, "-o", "-").stdout
                              for threads in ([], [], ["--threads", "1"]))  # fmt: skip
        self.assertEqual(once, again)
        self.assertEqual(once, alone)

    def test_errors(self):
        """Arcs, and numbers of tiles out of range; gaps may be as narrow as doubles are."""
        self.write("half.svg", '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0H20A10 10 0 0 1 0 0Z"/></svg>')
        self.assertIn("medial rebuild", self.refuse("invalid_option", "tiles", "half.svg", "--skip-invalid", "-o", "x.json"))
        self.write("narrow.wkt", "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (1e-14 1, 1 8, 1 1, 1e-14 1))")
        self.succeed("tiles", "narrow.wkt", "-o", "x.json")
        self.succeed("verify", "narrow.wkt", "x.json")
        self.write("star.wkt", star(10))
        self.refuse("[a-z_]+", "tiles", "star.wkt", "--tiles", "0")
        self.refuse("[a-z_]+", "tiles", "star.wkt", "--tiles", "1048577")
        text = self.refuse("invalid_option", "tiles", "star.wkt", "--tolerance", "1e-4")
        self.assertIn("use fewer tiles", text)
