"""`medial rebuild`."""

import json

from support import FRAME, CommandLine


class Rebuild(CommandLine):
    def test_a_forged_axis_takes_no_more_pixels(self):
        """Nodes far away, as no maximal disk of the shape has them."""
        self.write("frame.wkt", FRAME)
        self.succeed("axis", "frame.wkt", "-o", "frame.json")
        axis = json.loads(self.read("frame.json"))
        axis["items"][0]["axis"]["nodes"][0][0] = 1e300
        self.write("forged.json", json.dumps(axis))
        self.refuse("unsupported", "rebuild", "forged.json", "--pixels", 50, "-o", "forged.png")
        axis["items"][0]["axis"]["nodes"][0][0] = 1e50
        self.write("forged.json", json.dumps(axis))
        self.succeed("rebuild", "forged.json", "--pixels", 50, "-o", "forged.png")
