"""Pipes, terminals, full devices, signals."""

import os
import re
import select
import signal
import subprocess
import time

from support import FRAME, PROGRAM, RECTANGLE, CommandLine, comb


class Streams(CommandLine):
    def test_quiet_unless_a_terminal(self):
        self.write("rectangle.wkt", RECTANGLE)
        done = self.succeed("axis", "rectangle.wkt", "-o", "a.json")
        self.assertEqual((done.stdout, done.stderr), (b"", b""))

    def test_a_closed_pipe_ends_quietly(self):
        self.write("comb.wkt", comb(3000))
        process = subprocess.Popen(
            [PROGRAM, "axis", "comb.wkt", "-o", "-", "--format", "csv", "--chord", "1e-6"],
            cwd=self.folder.name, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        process.stdout.read(10)
        process.stdout.close()
        errors = process.stderr.read()
        process.stderr.close()
        self.assertIn(process.wait(60), (0, -signal.SIGPIPE))
        self.assertEqual(errors, b"")

    def test_a_full_device_is_an_error(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full here")
        self.write("frame.wkt", FRAME)
        for arguments in (["info", "frame.wkt"], ["axis", "frame.wkt", "-o", "-", "--format", "csv"],
                          ["axis", "frame.wkt", "--json"], ["axis", "--help"], ["--version"]):
            with open("/dev/full", "wb") as full:
                done = subprocess.run([PROGRAM, *arguments], cwd=self.folder.name, stdout=full,
                                      stderr=subprocess.PIPE, timeout=60)
            self.assertEqual(done.returncode, 2)
            self.assertIn(b"[unwritable]", done.stderr)

    def test_standard_error_that_takes_nothing_changes_nothing(self):
        """Full or closed: the same exit status, and no message in a file that got its number."""
        self.write("frame.wkt", FRAME)
        self.succeed("axis", "frame.wkt", "-o", "frame.json")
        for arguments, status in ((["axis", "frame.wkt", "--stats", "-o", "again.json"], 0),
                                  (["axis", "none.wkt", "-o", "again.json"], 2)):
            for where in ["2>&-"] + ["2>/dev/full"] * os.path.exists("/dev/full"):
                done = subprocess.run(["sh", "-c", f'"$0" "$@" {where}', PROGRAM, *arguments],
                                      cwd=self.folder.name, stdout=subprocess.PIPE, timeout=300)
                self.assertEqual((done.returncode, done.stdout), (status, b""), (arguments, where))
                if status == 0:
                    self.assertEqual(len(self.read("again.json")), len(self.read("frame.json")))
                    os.remove(self.path("again.json"))
            self.assertEqual(self.files(), ["frame.json", "frame.wkt"])

    def test_names_stay_in_one_line(self):
        self.assertIn("b c [31m.wkt: cannot open", self.refuse("unreadable", "info", "b\nc\x1b[31m.wkt"))

    def test_reading_shows_itself_on_a_terminal(self):
        """After a second, and is wiped; never with --quiet."""
        for quiet in ([], ["--quiet"]):
            try:
                terminal, end = os.openpty()
            except OSError as error:
                self.skipTest(f"no terminals here: {error}")
            process = subprocess.Popen([PROGRAM, "axis", "-", "-o", "out.json", *quiet], cwd=self.folder.name,
                                       stdin=subprocess.PIPE, stderr=end)
            os.close(end)
            shown = b""
            if quiet:
                time.sleep(1.5)
            else:
                # However busy the machine is: it waits for its input until this is there.
                while not re.search(rb"reading standard input \.\.\. \d+ s", shown):
                    self.assertTrue(select.select([terminal], [], [], 60)[0], shown)
                    shown += os.read(terminal, 4096)
            process.communicate(RECTANGLE.encode(), timeout=60)
            self.assertEqual(process.returncode, 0)
            try:
                while part := os.read(terminal, 4096):
                    shown += part
            except OSError:  # the other end is closed
                pass
            os.close(terminal)
            if quiet:
                self.assertEqual(shown, b"")
            else:
                self.assertIn(b"\r\x1b[K", shown)


class Interruption(CommandLine):
    def start(self, output, *more):
        return subprocess.Popen([PROGRAM, "axis", "comb.wkt", "-o", output, *more], cwd=self.folder.name,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
                                preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))

    def results(self):
        return {name: self.read(name) for name in self.files() if name != "comb.wkt"}

    def clear(self):
        for name in self.results():
            os.remove(self.path(name))

    def test_all_or_nothing_is_left(self):
        """A signal while the result is written leaves nothing, or all of it where it came after the work."""
        self.write("comb.wkt", comb(30_000))
        interrupted = 0
        for output, *more in (("out.csv",), ("out.json",), ("out.gpkg",), ("out.shp",),
                              ("out.safetensors", "--parts"), ("out.json", "--parts")):  # fmt: skip
            self.succeed("axis", "comb.wkt", "-o", output, *more)
            whole = self.results()
            self.clear()
            for signal_number in (signal.SIGINT, signal.SIGTERM):
                for after in (0, 0.02):
                    process = self.start(output, *more)
                    while process.poll() is None and len(self.files()) == 1:
                        time.sleep(0.001)
                    time.sleep(after)
                    process.send_signal(signal_number)
                    with process.stderr:
                        errors = process.stderr.read()
                    status = process.wait(60)
                    left = self.results()
                    with self.subTest(signal=signal_number, output=output, after=after, left=list(left)):
                        self.assertIn(status, (0, -signal_number))
                        self.assertEqual(errors, b"")
                        self.assertIn(left, ({}, whole))
                        interrupted += not left
                    self.clear()
        self.assertGreater(interrupted, 0)

    def stop_while_writing(self):
        """A process that a signal stopped while it wrote, and its hidden folder."""
        while True:
            process = self.start("out.json")
            while process.poll() is None and len(self.files()) == 1:
                time.sleep(0.001)
            process.send_signal(signal.SIGSTOP)
            left = [name for name in self.files() if name.startswith(".medial-")]
            if left:
                return process, left[0]
            process.kill()
            self.end(process)
            self.clear()

    def end(self, process):
        process.communicate(timeout=60)
        return process.returncode

    def test_what_a_killed_process_left_goes(self):
        self.write("comb.wkt", comb(30_000))
        process, hidden = self.stop_while_writing()
        # Not while it lives.
        self.succeed("axis", "comb.wkt", "-o", "other.json")
        self.assertIn(hidden, self.files())
        process.send_signal(signal.SIGCONT)
        self.assertEqual(self.end(process), 0)
        self.assertEqual(self.read("out.json"), self.read("other.json"))
        self.assertEqual(self.files(), ["comb.wkt", "other.json", "out.json"])
        self.clear()

        process, hidden = self.stop_while_writing()
        process.kill()
        self.assertEqual(self.end(process), -signal.SIGKILL)
        self.assertIn(hidden, self.files())
        # A folder that others can use is none of ours.
        os.chmod(self.path(hidden), 0o755)
        self.succeed("axis", "comb.wkt", "-o", "out.csv")
        self.assertIn(hidden, self.files())
        # Nor is one that the user made, even for files of its own.
        os.chmod(self.path(hidden), 0o700)
        self.succeed("axis", "comb.wkt", "-o", "out.csv")
        self.assertIn(hidden, self.files())
        os.chmod(self.path(hidden), 0o1700)
        self.succeed("axis", "comb.wkt", "-o", "out.csv")
        self.assertEqual(self.files(), ["comb.wkt", "out.csv"])
