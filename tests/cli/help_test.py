"""What the command line says about itself: help pages, suggestions, completion, `doctor`."""

import json
import os
import re
import shutil
import subprocess

import support
from support import CommandLine, FRAME, GEOGRAPHIC, RECTANGLE


class Help(CommandLine):
    def test_help_and_version(self):
        text = self.succeed("--help").stdout.decode()
        for command in ("axis", "verify", "info", "draw"):
            self.assertIn(f"  {command} ", text)
        for command in ("axis", "verify", "info", "draw"):
            own = self.succeed(command, "--help-all").stdout.decode()
            for word in ("Usage", "Example", "--threads", "--tolerance", "--chord", "--stats",
                         "--json", "--quiet", "default", "--repair[=RULE]", "--close[=GAP]"):
                self.assertIn(word, own)
        self.assertRegex(self.succeed("--version").stdout.decode(), r"^medial \d+\.\d+\.\d+\n$")

    def test_no_such_command(self):
        self.assertIn("unknown command: axes", self.refuse("invalid_option", "axes"))
        self.assertIn("a command is missing", self.refuse("invalid_option"))

    def test_pages_begin_with_examples_and_fold_shared_options(self):
        page = self.succeed("prune", "--help").stdout.decode()
        self.assertLess(page.index("Examples:"), page.index("Options:"))
        self.assertLess(page.index("--keep N"), page.index("described by --help-all"))
        self.assertLess(page.index("described by --help-all"), page.index("--threads"))
        self.assertNotIn("The number of threads", page)
        self.assertIn("The number of threads", self.succeed("prune", "--help-all").stdout.decode())
        for command in self.commands():
            self.assertLess(len(self.succeed(command, "--help").stdout.splitlines()), 80, command)

    def test_help_of_a_command(self):
        page = self.succeed("prune", "--help").stdout
        for line in (["help", "prune"], ["prune", "-h"], ["-h", "prune"], ["prune", "--bogus", "-h"],
                     ["prune", "no.wkt", "--threads", "x", "-h"], ["prune", "-h", "--keep", "-1"]):
            self.assertEqual(self.succeed(*line).stdout, page, line)
        self.assertEqual(self.succeed("help").stdout, self.succeed("--help").stdout)
        self.assertEqual(self.succeed("help", "centerline").stdout,
                         self.succeed("centreline", "-h").stdout)
        self.assertIn("did you mean prune?", self.refuse("invalid_option", "help", "prun"))

    def test_suggestions(self):
        self.write("frame.wkt", FRAME)
        for line, meant in ((["axs"], "axis"), (["centrline"], "centreline"),
                            (["prune", "--keap", "3"], "--keep"), (["axis", "--exect"], "--exact"),
                            (["axis", "frame.wkt", "--thread=2"], "--threads"),
                            (["prune", "frame.wkt", "--signif"], "--significance")):
            self.assertIn(f"did you mean {meant}?", self.refuse("invalid_option", *line))
        self.assertIn("unknown option: --keep, an option of prune, smooth",
                      self.refuse("invalid_option", "axis", "frame.wkt", "--keep", "3"))
        self.assertNotIn("did you mean", self.refuse("invalid_option", "axis", "--zebra"))

    def test_american_spelling(self):
        self.write("frame.wkt", FRAME)
        self.assertEqual(self.succeed("centerline", "frame.wkt", "-o", "-").stdout,
                         self.succeed("centreline", "frame.wkt", "-o", "-").stdout)

    def test_values_that_help_gives_may_be_left_out(self):
        self.write("frame.wkt", FRAME)
        named = self.succeed("prune", "frame.wkt", "--significance", "0.3", "-o", "-").stdout
        self.assertEqual(self.succeed("prune", "--significance", "frame.wkt", "-o", "-").stdout, named)
        self.assertEqual(self.succeed("prune", "frame.wkt", "-o", "-", "--significance").stdout, named)
        self.assertNotEqual(
            self.succeed("prune", "frame.wkt", "--significance", "3", "-o", "-").stdout, named)

    def commands(self):
        listed = self.succeed("--help").stdout.decode().split("Commands:\n")[1].split("\n\n")[0]
        return [line.split()[0] for line in listed.splitlines()]


class Completion(CommandLine):
    def complete(self, *words):
        """What bash offers behind these words; the last of them is begun."""
        script = self.succeed("completion", "bash").stdout.decode()
        script += f'COMP_WORDS=({" ".join(repr(word) for word in words)}); COMP_CWORD={len(words) - 1}\n'
        script += 'COMPREPLY=(); _medial; printf "%s\n" "${COMPREPLY[@]}"\n'
        done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True)
        return done.stdout.split()

    def test_bash(self):
        self.assertEqual(self.complete("medial", "pr"), ["prune"])
        self.assertEqual(self.complete("medial", "prune", "--sig"), ["--significance"])
        self.assertIn("ridge", self.complete("medial", "axis", "--method", ""))
        self.assertEqual(self.complete("medial", "help", "cen"), ["centreline"])
        self.assertEqual(self.complete("medial", "prune", "plan"), [])

    def test_zsh_and_fish_have_every_command(self):
        for shell, begin in (("zsh", "#compdef medial"), ("fish", "complete -c medial")):
            script = self.succeed("completion", shell).stdout.decode()
            self.assertTrue(script.startswith(begin))
            for word in ("centreline", "significance", "brushfire"):
                self.assertIn(word, script)
        self.refuse("invalid_option", "completion", "csh")


class Doctor(CommandLine):
    def test_doctor(self):
        found = json.loads(self.succeed("doctor", "--json").stdout)
        self.assertEqual(found["axis"], "works")
        self.assertEqual(found["projections"], "works")
        self.assertEqual(found["exact"], "no" if self.lacks("exact") else "works")
        self.assertEqual(".dxf" in found["written"]["axes"], not self.lacks("DXF"))
        self.assertRegex(found["libraries"]["GDAL"], r"^\d+\.\d+")
        version = self.succeed("--version").stdout.decode().split()[1]
        self.assertIn(version, self.succeed("doctor").stdout.decode().splitlines()[0])


class LateLibraries(CommandLine):
    """GDAL, Cairo with Assimp, and libxml2 are in modules beside the program, loaded when they are needed."""

    SVG = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0H4V3H0Z"/></svg>'
    MODULES = ("medial_gis.so", "medial_draw.so", "medial_svg.so")

    def setUp(self):
        super().setUp()
        if not os.path.exists(os.path.join(os.path.dirname(support.PROGRAM), "medial_gis.so")):
            self.skipTest("this build links its libraries")

    def loads(self, *arguments, library=b"libgdal"):
        done = subprocess.run([support.PROGRAM, *arguments], capture_output=True, check=True,
                              cwd=self.folder.name, env={**os.environ, "LD_DEBUG": "files"})
        return library in done.stderr

    def test_loaded_for_what_needs_them(self):
        self.write("a.wkt", RECTANGLE)
        self.write("a.geojson", GEOGRAPHIC)
        for output in ("a.json", "a.csv", "b.wkt", "a.graphml", "a.svg", "a.png", "a.pdf"):
            self.assertFalse(self.loads("axis", "a.wkt", "-o", output), output)
        self.assertFalse(self.loads("offset", "a.wkt", "--distance", "0.1", "-o", "a.json"))
        for output in ("a.shp", "a.gpkg"):
            self.assertTrue(self.loads("axis", "a.wkt", "-o", output), output)
        self.assertTrue(self.loads("axis", "a.geojson", "--project", "-o", "g.json"))

    def test_loaded_to_draw(self):
        self.write("a.wkt", RECTANGLE)
        for output in ("a.json", "a.csv", "b.wkt", "a.graphml"):
            for library in (b"libcairo", b"libassimp", b"libfreetype"):
                self.assertFalse(self.loads("axis", "a.wkt", "-o", output, library=library), output)
        for output in ("a.svg", "a.png", "a.pdf"):
            self.assertTrue(self.loads("axis", "a.wkt", "-o", output, library=b"libcairo"), output)
        self.assertTrue(self.loads("measure", "a.json", "--plot", "plot.svg", library=b"libcairo"))
        self.assertFalse(self.loads("axis", "a.wkt", "-o", "a.fgb", library=b"medial_draw.so"))
        self.succeed("rebuild", "a.json", "-o", "shape.fgb")
        self.assertFalse(self.loads("axis", "shape.fgb", "-o", "b.json", library=b"medial_draw.so"))
        self.assertFalse(self.loads("axis", "shape.fgb", "-o", "b.json", library=b"libassimp"))

    def test_loaded_to_read_svg(self):
        self.write("a.wkt", RECTANGLE)
        self.write("a.svg", self.SVG)
        for arguments in (["axis", "a.wkt", "-o", "a.json"], ["axis", "a.wkt", "-o", "a.fgb"],
                          ["rebuild", "a.json", "-o", "b.svg"]):
            self.assertFalse(self.loads(*arguments, library=b"medial_svg.so"), arguments)
        self.assertFalse(self.loads("axis", "a.wkt", "-o", "a.json", library=b"libxml2"))
        self.assertTrue(self.loads("axis", "a.svg", "-o", "b.json", library=b"libxml2"))
        self.assertFalse(self.loads("axis", "a.svg", "-o", "b.json", library=b"medial_draw.so"))

    def test_without_the_module(self):
        alone = self.path("alone")
        os.mkdir(alone)
        shutil.copy(support.PROGRAM, alone)
        program = os.path.join(alone, os.path.basename(support.PROGRAM))
        self.write("a.wkt", RECTANGLE)
        self.succeed("axis", "a.wkt", "-o", "a.gpkg")
        self.succeed("axis", "a.wkt", "-o", "whole.json")

        def run(*arguments):
            return subprocess.run([program, *arguments], capture_output=True, cwd=self.folder.name)

        self.assertEqual(run("axis", "a.wkt", "-o", "a.json").returncode, 0)
        self.assertEqual(self.read("a.json"), self.read("whole.json"))
        before = self.files()
        for arguments in (["axis", "a.gpkg", "-o", "b.json"], ["axis", "a.wkt", "-o", "b.fgb"],
                          ["axis", "a.wkt", "--project", "-o", "b.json"]):
            done = run(*arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(b"[unsupported]", done.stderr)
            self.assertIn(b"install medial again", done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertEqual(self.files(), before)
        doctor = run("doctor")
        self.assertEqual(doctor.returncode, 1)
        self.assertIn(b"install medial again", doctor.stdout)

    def expect_installed(self, arguments, status):
        """Runs the program in the folder, which advises to install it again where it fails."""
        done = subprocess.run([self.path("medial"), *arguments], capture_output=True,
                              cwd=self.folder.name)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertEqual(b"install medial again" in done.stdout + done.stderr, status > 0, arguments)

    def test_without_the_module_that_draws(self):
        for name in ("medial", "medial_gis.so"):
            shutil.copy(os.path.join(os.path.dirname(support.PROGRAM), name), self.folder.name)
        self.write("a.wkt", RECTANGLE)
        self.write("x.stl", "solid x\nendsolid x\n")
        self.succeed("axis", "a.wkt", "-o", "a.json")
        for arguments, status in ((["axis", "a.wkt", "-o", "a.svg"], 2),
                                  (["measure", "a.json", "--plot", "p.svg"], 2),
                                  (["voxels", "x.stl", "-o", "x.ply"], 2), (["doctor"], 1),
                                  (["axis", "a.wkt", "-o", "a.fgb"], 0)):
            self.expect_installed(arguments, status)

    def test_without_the_module_that_reads_svg(self):
        for name in ("medial", "medial_gis.so", "medial_draw.so"):
            shutil.copy(os.path.join(os.path.dirname(support.PROGRAM), name), self.folder.name)
        self.write("a.wkt", RECTANGLE)
        self.write("a.svg", self.SVG)
        for arguments, status in ((["axis", "a.svg", "-o", "a.json"], 2), (["doctor"], 1),
                                  (["axis", "a.wkt", "-o", "b.svg"], 0)):
            self.expect_installed(arguments, status)

    def test_modules_of_another_build(self):
        for name in ("medial", *self.MODULES):
            shutil.copy(os.path.join(os.path.dirname(support.PROGRAM), name), self.folder.name)
        program = self.path("medial")
        # All modules have it; whatever stands before it may be such a digit, too.
        found = [set(re.findall(rb"(?=([0-9a-f]{64})\0)", self.read(name)))
                 for name in self.MODULES]
        [stamp] = set.intersection(*found)
        self.write("a.wkt", RECTANGLE)
        self.succeed("axis", "a.wkt", "-o", "a.json")
        gis = ["axis", "a.wkt", "--project", "-o", "b.json"]
        plot = ["measure", "a.json", "--plot", "plot.svg"]
        self.write("a.svg", self.SVG)
        svg = ["axis", "a.svg", "-o", "b.json"]
        for replaced, arguments in zip(self.MODULES, (gis, plot, svg)):
            module = self.read(replaced)
            self.assertIn(stamp, module)
            other = self.read(next(name for name in self.MODULES if name != replaced))
            for content, text in ((module.replace(stamp, stamp[:-1] + b"!"), b"is of another build"),
                                  (other, b"is of another build"),
                                  (module[:40], b"cannot be loaded")):
                self.write(replaced, content)
                done = subprocess.run([program, *arguments], capture_output=True,
                                      cwd=self.folder.name)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(text, done.stderr)
                self.assertIn(b"install medial again", done.stderr)
            self.write(replaced, module)
