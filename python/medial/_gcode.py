"""Plain G-code, as the command line writes it."""

from __future__ import annotations

import math
from collections.abc import Iterable

from ._records import Floats

_SHORTEST_ARC = 1e-3  # six decimals do not hold the centre of a shorter one


def _decimal(value: float) -> str:
    text = f"{value:.6f}".rstrip("0")
    return "0" if text in ("-0.", "0.") else text.rstrip(".")


class _Program:
    def __init__(self, safe: float, feed: float, plunge: float) -> None:
        self.lines: list[str] = []
        self._safe, self._feed, self._plunge = safe, feed, plunge
        self._at = (0.0, 0.0, 0.0)
        self._down = False
        self._current = 0.0

    def lift(self) -> None:
        if self._down:
            self.lines.append("G0 Z" + _decimal(self._safe))
            self._down = False

    def path(self, rows: list[list[float]]) -> None:
        x, y, z, bulge = rows[0]
        if not self._down or (x, y, z) != self._at:
            self.lift()
            self.lines.append(f"G0 X{_decimal(x)} Y{_decimal(y)}")
            self.lines.append(f"G1 Z{_decimal(z)} F{_decimal(self._plunge)}")
            self._current = self._plunge
            self._down = True
        self._at = (x, y, z)
        for row in rows[1:]:
            self._move(bulge, row)
            bulge = row[3]
            self._at = (row[0], row[1], row[2])

    def _move(self, bulge: float, to: list[float]) -> None:
        x0, y0, z0 = self._at
        x, y, z = (_decimal(value) for value in to[:3])
        same_place = x == _decimal(x0) and y == _decimal(y0)
        same_height = z == _decimal(z0)
        if same_place and same_height and abs(bulge) < 1:
            return
        length = math.hypot(to[0] - x0, to[1] - y0)
        if bulge != 0 and length > _SHORTEST_ARC:
            i, j = _center(x0, y0, to[0], to[1], bulge)
            text = f"{'G3' if bulge > 0 else 'G2'} X{x} Y{y} I{_decimal(i)} J{_decimal(j)}"
        else:
            text = "G1" + ("" if same_place else f" X{x} Y{y}") + ("" if same_height else f" Z{z}")
        feed = self._plunge if same_place and to[2] < z0 else self._feed
        if feed != self._current:
            text += " F" + _decimal(feed)
        self._current = feed
        self.lines.append(text)


def _center(x0: float, y0: float, x1: float, y1: float, bulge: float) -> tuple[float, float]:
    """The centre of an arc, from its start."""
    dx, dy = x1 - x0, y1 - y0
    across = (1 - bulge * bulge) / (4 * bulge)
    return 0.5 * dx - across * dy, 0.5 * dy + across * dx


def program(paths: Iterable[tuple[str, Floats]], safe: float, feed: float, plunge: float,
            spindle: float, y_down: bool) -> str:  # fmt: skip
    """The program of some paths."""
    made = _Program(safe, feed, plunge)
    made.lines += ["(medial carve: millimetres, z 0 on the surface)", "G21 G90 G17 G94"]
    if spindle > 0:
        made.lines.append("M3 S" + _decimal(spindle))
    made.lines.append("G0 Z" + _decimal(safe))
    for _, rows in paths:
        upright = rows * [1, -1, 1, -1] if y_down else rows
        made.path(upright.tolist())
    made.lift()
    if spindle > 0:
        made.lines.append("M5")
    made.lines.append("M2")
    return "\n".join(made.lines) + "\n"
