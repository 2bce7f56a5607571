"""`--help` and `--version`."""

from support import CommandLine


class Help(CommandLine):
    def test_help_and_version(self):
        text = self.succeed("--help").stdout.decode()
        for command in ("axis", "verify", "info", "draw"):
            self.assertIn(f"  {command} ", text)
        for command in ("axis", "verify", "info", "draw"):
            own = self.succeed(command, "--help").stdout.decode()
            for word in ("Usage", "Example", "--threads", "--tolerance", "--chord", "--stats",
                         "--json", "--quiet", "default", "--repair[=RULE]", "--close[=GAP]"):
                self.assertIn(word, own)
        self.assertRegex(self.succeed("--version").stdout.decode(), r"^medial \d+\.\d+\.\d+\n$")

    def test_no_such_command(self):
        self.assertIn("unknown command: axes", self.refuse("invalid_option", "axes"))
        self.assertIn("a command is missing", self.refuse("invalid_option"))
