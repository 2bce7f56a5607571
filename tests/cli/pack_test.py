"""`medial pack` and `medial unpack`."""

import json
import os

from support import DATA, FRAME, RECTANGLE, CommandLine


class Pack(CommandLine):
    def test_the_docs_say_what_packs_take(self):
        """The table on the first lines of the page, but for other versions of zstd."""
        page = os.path.join(DATA, "..", "docs", "pack.md")
        with open(page, encoding="utf-8") as file:
            rows = [line.split("|")[1:-1] for line in file if line.startswith("| ")]
        table = {row[0].strip(): [int(cell.replace(",", "")) for cell in row[1:]]
                 for row in rows if row[0].strip() in ("spanner.svg", "gear.wkt", "plan.wkt")}
        self.assertEqual(len(table), 3)
        for name, wanted in table.items():
            found = []
            for error in ("0.005", "0.001"):
                report = json.loads(self.succeed("pack", os.path.join(DATA, name), "--error", error, "-o", "a.mpk",
                                                 "--compare", "--json").stdout)
                found += [report["bytes"], report["compare"]["boundary_within_error"]]
            for ours, said in zip(found, wanted):
                self.assertAlmostEqual(ours, said, delta=4 + 0.02 * said, msg=name)

    def test_pack(self):
        """What is packed comes back within the error; damage is reported."""
        self.write("frame.wkt", FRAME)
        report = json.loads(self.succeed("pack", "frame.wkt", "-o", "f.mpk", "--error", "0.001", "--compare",
                                         "--json").stdout)
        self.assertEqual(report["bytes"], os.path.getsize(self.path("f.mpk")))
        self.assertLess(report["bytes"], 200)
        self.assertGreater(report["compare"]["boundary_within_error"], 0)
        self.succeed("unpack", "f.mpk", "-o", "back.json")
        shape = json.loads(self.read("back.json"))["items"][0]["shape"]
        self.assertEqual(shape["hole"].count(True), 1)
        area = 0
        for begin, end in zip(shape["loop_begin"], shape["loop_begin"][1:]):
            loop = shape["points"][begin:end]
            area += sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(loop, loop[1:] + loop[:1])) / 2
        self.assertAlmostEqual(area, 48, delta=0.3)
        self.succeed("unpack", "f.mpk", "-o", "back.svg")
        with open(self.path("f.mpk"), "rb") as pack:
            content = pack.read()
        piped = self.succeed("pack", "frame.wkt", "-o", "-", "--error", "0.001").stdout
        self.assertEqual(piped, content)
        with open(self.path("damaged.mpk"), "wb") as pack:
            pack.write(content[:-3])
        self.refuse("malformed", "unpack", "damaged.mpk", "-o", "x.json")
        self.refuse("malformed", "unpack", "frame.wkt", "-o", "x.json")
        self.refuse("invalid_option", "pack", "frame.wkt", "-o", "x.mpk", "--error", "0")
        share = self.refuse("invalid_option", "pack", "frame.wkt", "-o", "x.mpk", "--error", "5")
        self.assertIn("--absolute", share)

    def test_packs_know_their_unit(self):
        self.write("r.wkt", RECTANGLE)
        for unit in ("in", "pixel", "degree", ""):
            options = ["--units", unit] if unit == "in" else []
            self.succeed("axis", "r.wkt", *options, "-o", "a.json")
            if unit not in ("in", ""):
                axis = json.loads(self.read("a.json"))
                self.write("a.json", json.dumps({"medial": axis["medial"], "unit": unit, "items": axis["items"]}))
            self.succeed("pack", "a.json", "-o", "r.mpk")
            self.succeed("unpack", "r.mpk", "-o", "u.json")
            self.assertEqual(json.loads(self.read("u.json")).get("unit", ""), unit)
        content = self.read("r.mpk")
        self.write("odd.mpk", content[:5] + bytes([content[5] | 16, 3]) + b"ell" + content[6:])
        self.refuse("malformed", "unpack", "odd.mpk", "-o", "x.json")
        for command in ("info", "axis", "rebuild"):
            self.assertIn("medial unpack", self.refuse("unsupported", command, "r.mpk"))
        self.assertIn("medial unpack", self.refuse("unsupported", "info", "-", given=content))
        self.write("short.mpk", content[:5] + bytes([content[5] | 16, 99]) + b"mm")
        self.refuse("malformed", "unpack", "short.mpk", "-o", "x.json")

    def test_pack_squares(self):
        """An image of three squares is three squares, without loss."""
        self.write("i.pbm", "P1\n6 3\n1 1 0 1 0 1\n1 1 0 0 0 0\n0 0 0 0 0 0\n")
        report = json.loads(self.succeed("pack", "i.pbm", "-o", "i.mpk", "--squares", "--json").stdout)
        self.assertEqual((report["squares"], report["missing_pixels"], report["pixels"]), (3, 0, 6))
        self.succeed("unpack", "i.mpk", "-o", "back.png")
        again = json.loads(self.succeed("pack", "back.png", "-o", "j.mpk", "--squares", "--json").stdout)
        self.assertEqual((again["squares"], again["pixels"]), (3, 6))

    def test_unpacked_axes_keep_the_error(self):
        self.write("plan.wkt", "POLYGON ((0 0, 30 0, 30 12, 22 12, 22 20, 14 20, 14 12, 0 9, 0 0),"
                               "(4 3, 4 6, 9 6, 9 3, 4 3))")
        for error in ("0.03", "0.003", "0.0001"):
            report = json.loads(self.succeed("pack", "plan.wkt", "-o", "p.mpk", "--error", error,
                                             "--json").stdout)
            self.succeed("unpack", "p.mpk", "-o", "u.json")
            again = json.loads(self.succeed("rebuild", "u.json", "--against", "plan.wkt",
                                            "--json").stdout)
            self.assertLessEqual(again["against"]["hausdorff"], report["error"])
