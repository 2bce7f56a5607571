"""`medial voxels`."""

import json

from support import RECTANGLE, CommandLine


BOX = "".join(f"v {x} {y} {z}\n" for z in (0, 2) for y in (0, 3) for x in (0, 4)) + "".join(
    f"f {a} {b} {c}\n" for a, b, c in (
        (1, 3, 2), (2, 3, 4), (5, 6, 7), (6, 8, 7), (1, 2, 5), (2, 6, 5),
        (3, 7, 4), (4, 7, 8), (1, 5, 3), (3, 5, 7), (2, 4, 6), (4, 8, 6)))


class Voxels(CommandLine):
    def setUp(self):
        super().setUp()
        if b"without Assimp" in self.run_medial("voxels", self.write("box.obj", BOX)).stderr:
            self.skipTest("built without Assimp")

    def test_every_format_is_written_alike_by_any_number_of_threads(self):
        for name in ("a.ply", "a.vtk", "a.obj", "a.png"):
            self.succeed("voxels", "box.obj", "-o", name, "--voxels", 24, "--threads", 1)
            first = self.read(name)
            self.succeed("voxels", "box.obj", "-o", name, "--voxels", 24, "--threads", 3)
            self.assertEqual(self.read(name), first)
            self.succeed("voxels", "box.obj", "-o", name, "--voxels", 24, "--search", "sorted-list")
            self.assertEqual(self.read(name), first)
            pipe = self.succeed("voxels", "box.obj", "-o", "-", "--format", name[2:], "--voxels", 24)
            self.assertEqual(pipe.stdout, first)

    def test_surface(self):
        for name in ("a.ply", "a.vtk", "a.obj", "a.glb", "a.png"):
            report = json.loads(self.succeed("voxels", "box.obj", "-o", name, "--voxels", 24, "--surface",
                                             "--json").stdout)
        self.assertGreater(report["surface"]["triangles"], 500)
        self.assertEqual(report["surface"]["lines"], 0)
        lines = self.read("a.obj").decode().splitlines()
        self.assertEqual(sum(line.startswith("f ") for line in lines), report["surface"]["triangles"])
        glb = self.read("a.glb")
        size = int.from_bytes(glb[12:16], "little")
        document = json.loads(glb[20:20 + size])
        self.assertEqual(document["accessors"][0]["count"], report["surface"]["vertices"])
        self.assertEqual(document["meshes"][0]["primitives"][0]["mode"], 4)
        self.assertEqual(document["buffers"][0]["byteLength"], len(glb) - 28 - size)

    def test_force_lines(self):
        report = json.loads(self.succeed("voxels", "box.obj", "-o", "force.obj", "--voxels", 16, "--method",
                                         "potential", "--order", 4, "--json").stdout)
        self.assertGreater(report["surface"]["triangles"], 500)
        self.assertGreater(report["surface"]["lines"], 20)
        self.refuse("invalid_option", "voxels", "box.obj", "--method", "potential", "--order", 1)

    def test_summary(self):
        report = json.loads(self.succeed("voxels", "box.obj", "--resolution", 0.125, "--json",
                                         "--stats").stdout)
        self.assertEqual(report["cells"], [36, 28, 20])
        self.assertEqual(report["topology"]["axis"],
                         {"components": 1, "tunnels": 0, "cavities": 0})
        self.assertAlmostEqual(report["deepest"]["radius"], 1, delta=0.125)
        self.assertGreater(report["tested_voxels"], report["voxels"])

    def test_what_cannot_be_done_is_refused(self):
        self.write("open.obj", BOX[:BOX.rindex("f ")])
        text = self.refuse("open_surface", "voxels", "open.obj", "-o", "a.ply")
        self.assertIn("face 10 at (4, 1.5, 1)", text)
        self.write("two.obj", BOX + "".join(
            line.replace("v 0", "v 1") + "\n" if line[0] == "v" else
            "f " + " ".join(str(int(n) + 8) for n in line.split()[1:]) + "\n"
            for line in BOX.splitlines()))
        self.refuse("non_manifold", "voxels", "two.obj", "-o", "a.ply")
        self.refuse("too_large", "voxels", "box.obj", "-o", "a.ply", "--resolution", 1e-5)
        self.refuse("too_large", "voxels", "box.obj", "--voxels", 4000, "--memory", 0.01)
        self.refuse("invalid_option", "voxels", "box.obj", "--voxels", 2)
        self.refuse("unsupported", "voxels", "box.obj", "-o", "a.svg")
        self.refuse("unsupported", "voxels", self.write("box.wkt", RECTANGLE))
        self.refuse("malformed", "voxels", self.write("no.ply", "plywood"))
        self.refuse("unreadable", "voxels", "missing.stl")
