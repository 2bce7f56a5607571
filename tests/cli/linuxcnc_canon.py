"""What LinuxCNC's interpreter makes of G-code, from its Python module; run by Debian's python3."""
import json
import sys

import gcode


class Canon:
    """Takes the canonical commands; lengths are in inches, whatever the program says."""
    def __init__(self):
        self.at = [0.0] * 3
        self.moves, self.low, self.high, self.tools = 0, [1e300] * 3, [-1e300] * 3, []
        self.comments = []
        self.parameter_file = ""

    def __getattr__(self, name):
        return lambda *arguments: None

    def visit(self, place):
        self.low = [min(a, b) for a, b in zip(self.low, place)]
        self.high = [max(a, b) for a, b in zip(self.high, place)]

    def straight_feed(self, x, y, z, *_):
        for place in (self.at, [x, y, z]):
            self.visit(place)
        self.at = [x, y, z]
        self.moves += 1

    def straight_traverse(self, x, y, z, *_):
        self.at = [x, y, z]

    def arc_feed(self, x, y, i, j, turns, z, *_):
        self.straight_feed(x, y, z)

    def comment(self, text):
        self.comments.append(text)

    def change_tool(self, number):
        self.tools.append(number)

    def get_external_length_units(self):
        return 1.0

    def get_external_angular_units(self):
        return 1.0

    def get_axis_mask(self):
        return 7

    def get_block_delete(self):
        return False

    def get_tool(self, pocket):
        return (-1,) + (0.0,) * 12 + (0,)

    def check_abort(self):
        return False

    def next_line(self, state):
        self.state = state


canon = Canon()
result, line = gcode.parse(sys.argv[1], canon, "G20", "")
scale = 25.4 if sys.argv[2] == "mm" else 1.0
print(json.dumps({"error": gcode.strerror(result) if result > gcode.MIN_ERROR else "", "line": line,
                  "moves": canon.moves, "low": [scale * v for v in canon.low],
                  "high": [scale * v for v in canon.high], "tools": canon.tools, "comments": canon.comments}))
