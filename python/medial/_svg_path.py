"""The path data of SVG, as contours."""

from __future__ import annotations

import math
import re

from . import _core
from ._errors import MedialError

_TOKEN = re.compile(r"([MmLlHhVvCcSsQqTtAaZz])|([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)|([\s,]+)")
_COUNT = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
_WINDING = 3


def _tokens(text: str) -> list[tuple[str, list[float]]]:
    """Commands with their numbers, a command again for each set of numbers."""
    commands: list[tuple[str, list[float]]] = []
    at = 0
    while at < len(text):
        found = _TOKEN.match(text, at)
        if found is None:
            raise MedialError(f"an SVG path cannot have {text[at]!r} at place {at}", "malformed")
        letter, number, _ = found.groups()
        end = found.end()
        if letter:
            commands.append((letter, []))
        elif number:
            if not commands:
                raise MedialError("an SVG path begins with M", "malformed")
            name, numbers = commands[-1]
            if name in "Aa" and len(numbers) % 7 in (3, 4):  # flags need no separator
                if number[0] not in "01":
                    raise MedialError("a flag of an arc in an SVG path is 0 or 1", "malformed")
                end = at + 1
                number = number[0]
            numbers.append(float(number))
        at = end
    return commands


def _sets(commands: list[tuple[str, list[float]]]) -> list[tuple[str, list[float]]]:
    result: list[tuple[str, list[float]]] = []
    for letter, numbers in commands:
        count = _COUNT[letter.upper()]
        if count == 0:
            if numbers:
                raise MedialError("Z has no numbers in an SVG path", "malformed")
            result.append((letter, []))
            continue
        if not numbers or len(numbers) % count:
            raise MedialError(f"{letter} needs {count} numbers each time in an SVG path", "malformed")
        for i in range(0, len(numbers), count):
            name = letter if i == 0 else {"M": "L", "m": "l"}.get(letter, letter)
            result.append((name, numbers[i : i + count]))
    return result


def _arc(contour: _core.Contour, start: complex, numbers: list[float], end: complex) -> None:
    """An elliptical arc by its end points, as appendix B.2 of SVG 2 converts it."""
    rx, ry, degrees, large, sweep = abs(numbers[0]), abs(numbers[1]), *numbers[2:5]
    if start == end:
        return
    if rx == 0 or ry == 0:
        contour.line_to((end.real, end.imag))
        return
    turn = complex(math.cos(math.radians(degrees)), math.sin(math.radians(degrees)))
    half = (start - end) / 2 / turn
    size = (half.real / rx) ** 2 + (half.imag / ry) ** 2
    if size > 1:
        rx, ry = rx * math.sqrt(size), ry * math.sqrt(size)
        size = 1.0
    away = math.sqrt(max(0.0, 1 / size - 1)) * (-1 if bool(large) == bool(sweep) else 1)
    center = away * complex(rx * half.imag / ry, -ry * half.real / rx)
    first = complex((half.real - center.real) / rx, (half.imag - center.imag) / ry)
    last = complex((-half.real - center.real) / rx, (-half.imag - center.imag) / ry)
    begin = math.atan2(first.imag, first.real)
    angle = math.atan2(last.imag, last.real) - begin
    if sweep and angle < 0:
        angle += 2 * math.pi
    if not sweep and angle > 0:
        angle -= 2 * math.pi
    middle = center * turn + (start + end) / 2
    if rx == ry:  # a circle: exact arcs
        pieces = math.ceil(abs(angle) / math.pi - 1e-9) or 1
        for i in range(1, pieces + 1):
            at = begin + angle * i / pieces
            p = end if i == pieces else middle + turn * complex(rx * math.cos(at), rx * math.sin(at))
            contour.arc_to((p.real, p.imag), math.tan(angle / pieces / 4))
        return
    u, v = turn * rx, turn * 1j * ry
    contour.ellipse_to((middle.real, middle.imag), (u.real, u.imag), (v.real, v.imag), begin, begin + angle)


def contours_of(text: str) -> list[_core.Contour]:
    """The subpaths of an SVG path, each a closed contour of the non-zero rule."""
    contours: list[_core.Contour] = []
    contour: _core.Contour | None = None
    at = start = control = 0j
    before = ""

    def bezier(*points: complex) -> None:
        assert contour is not None
        contour.bezier_to([(p.real, p.imag) for p in points], None)

    for letter, numbers in _sets(_tokens(text)):
        name = letter.upper()
        base = at if letter.islower() else 0j
        points = [base + complex(x, y) for x, y in zip(numbers[::2], numbers[1::2], strict=False)]
        if contour is None and name not in "MZ":
            if not before:
                raise MedialError("an SVG path begins with M", "malformed")
            points_start = start
            contour = _core.Contour()
            contour.start_at((points_start.real, points_start.imag))
        smooth = 2 * at - control
        if name == "M":
            if contour is not None and contour.piece_count:
                contours.append(contour)
            contour = _core.Contour()
            at = start = points[0]
            contour.start_at((at.real, at.imag))
        elif name == "Z":
            if contour is not None and contour.piece_count:
                contours.append(contour)
            contour, at = None, start
        elif contour is not None:
            if name == "H":
                points = [complex(numbers[0] + base.real, at.imag)]
            elif name == "V":
                points = [complex(at.real, numbers[0] + base.imag)]
            elif name == "A":
                points = [base + complex(numbers[5], numbers[6])]
            elif name == "S":
                points = [smooth if before in "CS" else at, *points]
            elif name == "T":
                points = [smooth if before in "QT" else at, *points]
            if name in "CSQT":
                bezier(*points)
                control = points[-2]
            elif name == "A":
                _arc(contour, at, numbers, points[0])
            elif points[0] != at:
                contour.line_to((points[0].real, points[0].imag))
            at = points[-1]
        if name not in "CSQT":
            control = at
        before = name
    if contour is not None and contour.piece_count:
        contours.append(contour)
    for each in contours:
        each.set_role(_WINDING)
    return contours
