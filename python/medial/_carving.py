"""Tool paths: V-carving along the axis, pockets along offsets."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from os import PathLike, fsencode
from typing import Any

from . import _core
from ._axis import MedialAxis, axis, axis_of
from ._records import Floats
from ._shape import Shape, load


@dataclass(frozen=True, eq=False)
class Carving:
    """The paths of a tool, in the order of cutting.

    Attributes
    ----------
    paths : list of (kind, rows)
        Kinds are clearing, wall, groove, ramp, plunge. Rows hold x, y, z and the bulge of the move to
        the next row, in units of the input; z is 0 at the surface.
    passes : list of int
        The pass of each path, from the surface down.
    clearing : list of (kind, rows)
        The paths of the end mill that cuts first (`clear_tool`), in the same form.
    tabs : array of shape (n, 6)
        The tabs: x and y of one end, of the middle, and of the other end.
    numbers : dict
        Measured values: deepest, flat_from, cut_length, travel_length and others.
    """

    paths: list[tuple[str, Floats]]
    passes: list[int]
    numbers: dict[str, float]
    clearing: list[tuple[str, Floats]]
    tabs: Floats
    _core: _core.Carving = field(repr=False)

    @property
    def deepest(self) -> float:
        """The largest depth, in units of the input."""
        return self.numbers["deepest"]

    def to_gcode(self, **machine: Any) -> str:
        """The paths as G-code, as the command line writes it.

        Parameters
        ----------
        **machine
            Options of `save`.

        Examples
        --------
        >>> import medial
        >>> code = medial.carve([(0, 0), (4, 0), (4, 2), (0, 2)]).to_gcode(feed=800, post="grbl")
        >>> "F800" in code, code.rstrip().splitlines()[-1]
        (True, 'M30')
        """
        return self._write(None, "nc", **machine) or ""

    def save(self, path: str | PathLike[str], **machine: Any) -> None:
        """Writes the paths as G-code (``.nc``, ``.gcode``, ``.ngc``) or as points (``.csv``).

        Parameters
        ----------
        path : path
        safe : float
            The height of moves between paths.
        feed, plunge, rapid : float
            The speeds of cutting moves, of moves straight down, and of other moves, in units per
            minute.
        spindle : float
            Revolutions per minute; 0: the program does not start the spindle.
        clear_feed, clear_plunge, clear_spindle : float
            The same for the end mill that cuts first; by default the speeds of the main tool.
        unit : {"mm", "in"}
        origin : (x, y)
            The point of the drawing that becomes 0, 0.
        y_down : bool
            Whether the y axis of the drawing points down, as in SVG and images; it is then flipped.
        post : str
            The dialect of the program: ``"linuxcnc"``, ``"grbl"``, ``"mach3"``, or the text of a
            template; by default plain G-code.

        Raises
        ------
        MedialError
            With the code ``"unsupported"`` (another extension), ``"unwritable"`` or
            ``"invalid_option"`` (a template without its parts).

        Examples
        --------
        >>> import medial, pathlib, tempfile
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     path = pathlib.Path(folder, "a.nc")
        ...     medial.carve([(0, 0), (4, 0), (4, 2), (0, 2)]).save(path, spindle=12000)
        ...     "M3 S12000" in path.read_text()
        True
        """
        self._write(fsencode(path), "", **machine)

    def _write(self, path: bytes | None, format: str, *, safe: float = 5, feed: float = 1000,
               plunge: float = 300, rapid: float = 3000, spindle: float = 0,
               clear_feed: float | None = None, clear_plunge: float | None = None,
               clear_spindle: float = 0, unit: str = "mm", origin: Sequence[float] = (0, 0),
               y_down: bool = False, post: str = "") -> str | None:  # fmt: skip
        if unit not in ("mm", "in"):
            raise ValueError("unit is 'mm' or 'in'")
        clearing = (feed if clear_feed is None else clear_feed,
                    plunge if clear_plunge is None else clear_plunge, clear_spindle)  # fmt: skip
        machine = _core.Machine(safe, rapid, (feed, plunge, spindle), clearing, post)
        x, y = origin
        return _core.write_carving(self._core, path, format, (x, y), y_down, unit == "in", machine)

    def __iter__(self) -> Iterator[tuple[str, Floats]]:
        return iter(self.paths)

    def __repr__(self) -> str:
        return f"<medial.Carving: {len(self.paths)} paths, {self.deepest:.6g} deep>"


def carve(x: Any, *, angle: float = 90, depth: float = 0, tool: float = 0, tip: float = 0,
          pass_depth: float = 0, ramp: float = 90, step: float = 0, chord: float = 0,
          exterior: bool = False, margin: float = 0, clear_tool: float = 0,
          clear_pass_depth: float | None = None, tabs: int = 0, tab_spacing: float = 0,
          tab_width: float = 6, tab_height: float = 0) -> Carving:  # fmt: skip
    """Tool paths that carve a shape with a cone, or clear it with an end mill.

    All lengths are in units of the input, which G-code reads as millimetres or inches.

    Parameters
    ----------
    x : MedialAxis or geometry
    angle : float
        The angle between the sides of the cone, in degrees; 0: an end mill.
    depth : float
        The largest depth; 0: as deep as the tool reaches.
    tool, tip : float
        The largest diameter, and the diameter of a flat tip.
    pass_depth : float
        The depth of one pass; 0: a single pass.
    ramp : float
        The steepest angle of ramps into the material, in degrees; 90: straight down.
    step, chord : float
        The distance between clearing passes, and the largest error of straight moves; 0: chosen by
        the tool.
    exterior : bool
        Cut the surroundings of the shape, up to a rectangle, and its holes.
    margin : float
        The distance of that rectangle from the shape; 0: half of its longer side.
    clear_tool, clear_pass_depth : float
        The diameter of an end mill that clears flat bottoms first, and the depth of its passes
        (half of the diameter).
    tabs : int
        The number of bars that hold each part that would come loose; needs a depth.
    tab_spacing : float
        Instead: one bar per this length of the boundary.
    tab_width, tab_height : float
        The width of tabs, and their height above the bottom (0: 2, at most half of the depth).

    Raises
    ------
    MedialError
        With the code ``"invalid_option"``, ``"unsupported"`` (a sampled axis) or
        ``"too_large"`` (more than a million passes).

    Examples
    --------
    >>> import medial
    >>> medial.carve([(0, 0), (4, 0), (4, 2), (0, 2)]).deepest
    1.0...
    >>> plate = [(0, 0), (60, 0), (60, 40), (0, 40)]
    >>> medial.carve(plate, angle=0, tool=3, depth=6, exterior=True, margin=9, tabs=4).tabs.shape
    (4, 6)
    """
    if exterior:
        shape = x.shape._core if isinstance(x, MedialAxis) else load(x)[0]
        x = axis(Shape._of(_core.surroundings(shape, margin)))
    given = {"angle": angle, "depth": depth, "tool": tool, "tip": tip, "pass_depth": pass_depth,
             "ramp": ramp, "step": step, "chord": chord, "cleared": clear_tool}  # fmt: skip
    own = clear_tool / 2 if clear_pass_depth is None else clear_pass_depth
    core = _core.carved(axis_of(x)._core, given, own, tabs, tab_spacing, tab_width, tab_height)
    paths = core.paths()
    return Carving([(kind, rows) for kind, _, rows in paths], [p for _, p, _ in paths], core.numbers(),
                   [(kind, rows) for kind, _, rows in core.clearing()], core.tabs(), core)  # fmt: skip
