#!/usr/bin/env python3
"""Writes the drawn examples of data/: a gear, the floor plan of a house, a maze and a plate.

    tools/make_examples.py [FOLDER]     (data/ of the project by default)

Each of the first three is one polygon with holes, as well-known text; the plate is a DXF drawing of
lines, arcs and circles. Every run writes the same files.
"""

import math
import pathlib
import random
import sys


def text(rings):
    """Well-known text of one polygon: its outer ring first, then the holes."""
    def ring_text(ring):
        return "(" + ", ".join(f"{x:.10g} {y:.10g}" for x, y in ring + ring[:1]) + ")"
    return "POLYGON (" + ",\n  ".join(ring_text(ring) for ring in rings) + ")\n"


def circle(center, radius, points, start=0.0):
    return [(center[0] + radius * math.cos(start + 2 * math.pi * i / points),
             center[1] + radius * math.sin(start + 2 * math.pi * i / points))
            for i in range(points)]


# ---- gear ---------------------------------------------------------------------------------------

def involute_gear(teeth, module, pressure_angle):
    """The outline of a spur gear: involute flanks between the root and the tip circle."""
    pitch = teeth * module / 2
    base = pitch * math.cos(pressure_angle)
    tip, root = pitch + module, pitch - 1.25 * module
    involute = math.tan(pressure_angle) - pressure_angle
    half_tooth = math.pi / (2 * teeth) + involute  # as seen from the centre, at the base circle

    def angle_at(radius):
        """Half the angle that a tooth takes on the circle of this radius."""
        if radius <= base:
            return half_tooth
        t = math.sqrt((radius / base) ** 2 - 1)
        return half_tooth - (t - math.atan(t))

    start = max(base, root)
    radii = [start + (tip - start) * i / 8 for i in range(9)]
    outline = []
    for tooth in range(teeth):
        middle = 2 * math.pi * tooth / teeth
        flank = [(r, angle_at(r)) for r in ([root] if root < base else []) + radii]
        polar = [(r, middle - a) for r, a in flank] + [(r, middle + a) for r, a in reversed(flank)]
        outline += [(r * math.cos(a), r * math.sin(a)) for r, a in polar]
    return outline


def gear():
    """24 teeth of module 4, six round windows in the web, a bore with a keyway. Millimetres."""
    windows = [circle((27 * math.cos(a), 27 * math.sin(a)), 8, 64, a)
               for a in (2 * math.pi * i / 6 for i in range(6))]
    bore, key = 10, 3
    edge = math.asin(key / bore)
    bow = [(bore * math.cos(a), bore * math.sin(a)) for a in
           (math.pi / 2 + edge + (2 * math.pi - 2 * edge) * i / 64 for i in range(65))]
    keyway = bow + [(key, 13), (-key, 13)]
    return [involute_gear(24, 4, math.radians(20))] + windows + [keyway]


# ---- plan ---------------------------------------------------------------------------------------

class Grid:
    """Free and solid cells between given lines; the free ones become a polygon with holes."""

    def __init__(self, xs, ys):
        self.xs, self.ys = sorted(set(xs)), sorted(set(ys))
        self.free = set()

    def carve(self, x0, y0, x1, y1):
        self._set(x0, y0, x1, y1, True)

    def fill(self, x0, y0, x1, y1):
        self._set(x0, y0, x1, y1, False)

    def _set(self, x0, y0, x1, y1, free):
        for i in range(self.xs.index(x0), self.xs.index(x1)):
            for j in range(self.ys.index(y0), self.ys.index(y1)):
                (self.free.add if free else self.free.discard)((i, j))

    def rings(self):
        """The border of the free cells: free space on the left, only corners kept."""
        following = {}
        for i, j in self.free:
            for (a, b), outside in ((((i, j), (i + 1, j)), (i, j - 1)),
                                    (((i + 1, j), (i + 1, j + 1)), (i + 1, j)),
                                    (((i + 1, j + 1), (i, j + 1)), (i, j + 1)),
                                    (((i, j + 1), (i, j)), (i - 1, j))):
                if outside not in self.free:
                    following.setdefault(a, []).append(b)
        rings = []
        while following:
            first = min(following)
            ring, at, heading = [], first, None
            while True:
                choices = following[at]
                # Where two free cells meet in a corner only, turn right: the rings stay apart there.
                nearest = min(choices, key=lambda b: self._turn(heading, at, b))
                choices.remove(nearest)
                if not choices:
                    del following[at]
                new_heading = (nearest[0] - at[0], nearest[1] - at[1])
                if new_heading != heading:
                    ring.append(at)
                at, heading = nearest, new_heading
                if at == first:
                    break
            if len(ring) > 4 and self._straight(ring[-1], ring[0], ring[1]):
                ring = ring[1:]
            rings.append([(self.xs[i], self.ys[j]) for i, j in ring])
        return sorted(rings, key=area, reverse=True)

    @staticmethod
    def _turn(heading, at, to):
        if heading is None:
            return 0
        dx, dy = to[0] - at[0], to[1] - at[1]
        return heading[0] * dy - heading[1] * dx

    @staticmethod
    def _straight(a, b, c):
        return (b[0] - a[0]) * (c[1] - b[1]) == (b[1] - a[1]) * (c[0] - b[0])


def area(ring):
    """Twice the signed area."""
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:] + ring[:1]))


# One storey. A wall is drawn by its box, a door by the gap it leaves; metres.
PLAN_BOX = (0.0, 0.0, 24.0, 15.0)
PLAN_WALLS = [
    # outer wing of the stairs and the terrace corner, which are not part of the storey
    (18.0, 0.0, 24.0, 3.0),
    # the corridor's two walls
    (0.0, 6.0, 24.0, 6.2), (0.0, 8.2, 24.0, 8.4),
    # walls between the southern rooms
    (4.4, 0.0, 4.6, 6.0), (9.0, 0.0, 9.2, 6.0), (13.4, 0.0, 13.6, 6.0), (18.0, 3.0, 18.2, 6.0),
    # walls between the northern rooms; the hall right of x = 12 is open
    (5.0, 8.4, 5.2, 15.0), (8.4, 8.4, 8.6, 15.0), (12.0, 8.4, 12.2, 15.0), (5.2, 11.6, 8.4, 11.8),
]
PLAN_DOORS = [
    # from the southern rooms to the corridor
    (3.0, 6.0, 3.9, 6.2), (7.6, 6.0, 8.5, 6.2), (10.6, 6.0, 11.5, 6.2), (15.2, 6.0, 16.1, 6.2),
    (20.6, 6.0, 21.5, 6.2),
    # from one room to the next
    (9.0, 1.4, 9.2, 2.3), (18.0, 4.2, 18.2, 5.1),
    # from the corridor to the northern rooms and, wide, to the hall
    (2.2, 8.2, 3.1, 8.4), (6.6, 8.2, 7.5, 8.4), (10.0, 8.2, 10.9, 8.4), (13.4, 8.2, 15.2, 8.4),
    (20.4, 8.2, 22.2, 8.4), (6.0, 11.6, 6.9, 11.8), (8.4, 13.2, 8.6, 14.1),
]
PLAN_PILLARS = [(x, y, x + 0.5, y + 0.5) for x in (14.6, 17.6, 20.6) for y in (10.4, 12.6)]


def plan():
    """Rooms along a corridor, a pillared hall with two round columns. Metres."""
    boxes = [PLAN_BOX] + PLAN_WALLS + PLAN_DOORS + PLAN_PILLARS
    grid = Grid([x for box in boxes for x in (box[0], box[2])],
                [y for box in boxes for y in (box[1], box[3])])
    grid.carve(*PLAN_BOX)
    for box in PLAN_WALLS:
        grid.fill(*box)
    for box in PLAN_DOORS:
        grid.carve(*box)
    for box in PLAN_PILLARS:
        grid.fill(*box)
    return grid.rings() + [circle((22.6, 4.5), 0.4, 48), circle((11.3, 3.0), 0.5, 48)]


# ---- maze ---------------------------------------------------------------------------------------

def maze(columns=32, rows=24, seed=1967):
    """A maze grown from one cell by depth-first search, some of its dead ends opened into loops."""
    dice = random.Random(seed)
    corridor, wall = 6, 2
    lines_x = [c * (corridor + wall) + d for c in range(columns) for d in (0, corridor)]
    lines_y = [r * (corridor + wall) + d for r in range(rows) for d in (0, corridor)]
    grid = Grid(lines_x, lines_y)

    def cell(c, r):
        return c * (corridor + wall), r * (corridor + wall)

    def neighbours(c, r):
        return [(c + dc, r + dr) for dc, dr in ((1, 0), (0, 1), (-1, 0), (0, -1))
                if 0 <= c + dc < columns and 0 <= r + dr < rows]

    passages = set()
    seen, path = {(0, 0)}, [(0, 0)]
    while path:
        here = path[-1]
        unseen = [n for n in neighbours(*here) if n not in seen]
        if not unseen:
            path.pop()
            continue
        there = dice.choice(unseen)
        passages.add(frozenset((here, there)))
        seen.add(there)
        path.append(there)
    for c in range(columns):
        for r in range(rows):
            doors = [n for n in neighbours(c, r) if frozenset(((c, r), n)) in passages]
            closed = [n for n in neighbours(c, r) if n not in doors]
            if len(doors) == 1 and closed and dice.random() < 0.25:
                passages.add(frozenset(((c, r), dice.choice(closed))))

    for c in range(columns):
        for r in range(rows):
            x, y = cell(c, r)
            grid.carve(x, y, x + corridor, y + corridor)
    for passage in passages:
        (c0, r0), (c1, r1) = sorted(passage)
        x, y = cell(c0, r0)
        if c1 > c0:
            grid.carve(x + corridor, y, x + corridor + wall, y + corridor)
        else:
            grid.carve(x, y + corridor, x + corridor, y + corridor + wall)
    return grid.rings()


# ---- plate --------------------------------------------------------------------------------------

def line(start, end):
    return [(0, "LINE"), (8, "OUTLINE"), (10, start[0]), (20, start[1]), (11, end[0]), (21, end[1])]


def arc(center, radius, degrees):
    return [(0, "ARC"), (8, "OUTLINE"), (10, center[0]), (20, center[1]), (40, radius),
            (50, degrees[0]), (51, degrees[1])]


def hole(center, radius):
    return [(0, "CIRCLE"), (8, "OUTLINE"), (10, center[0]), (20, center[1]), (40, radius)]


def plate(width=80, height=50, corner=10):
    """A plate with rounded corners, drawn edge by edge; four bolt holes, one large bore. Millimetres."""
    east, north = width - corner, height - corner
    entities = [line((corner, 0), (east, 0)), arc((east, corner), corner, (270, 360)),
                line((width, corner), (width, north)), arc((east, north), corner, (0, 90)),
                line((east, height), (corner, height)), arc((corner, north), corner, (90, 180)),
                line((0, north), (0, corner)), arc((corner, corner), corner, (180, 270))]
    entities += [hole((x, y), 4) for x in (corner, east) for y in (corner, north)]
    entities += [hole((0.4 * width, 0.5 * height), 14)]
    groups = [(0, "SECTION"), (2, "ENTITIES"), *sum(entities, []), (0, "ENDSEC"), (0, "EOF")]
    return "".join(f"{code:3}\n{value}\n" for code, value in groups)


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else
                          pathlib.Path(__file__).resolve().parent.parent / "data")
    for name, rings in (("gear", gear()), ("plan", plan()), ("maze", maze())):
        (folder / f"{name}.wkt").write_text(text(rings))
        print(f"{name}.wkt: {sum(map(len, rings))} vertices, {len(rings) - 1} holes")
    (folder / "plate.dxf").write_text(plate())


if __name__ == "__main__":
    main()
