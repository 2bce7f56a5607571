"""Options for all calls."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from typing import Any

from . import _core


@dataclass
class Settings:
    """Defaults for all calls: set the attributes of ``medial.options``.

    Attributes
    ----------
    method : str
        The method of `axis` and `axes`; `methods` lists them.
    threads : int
        The number of threads; 0: all of the machine.
    chord : float
        The largest distance of lines from curves, as a share of the diagonal of the axis.
    """

    method: str = "disks"
    threads: int = 0
    chord: float = 1e-3


options = Settings()


def methods() -> list[dict[str, Any]]:
    """The methods of `axis`, and what each supports: holes, arcs, the exterior, several threads.

    Examples
    --------
    >>> import medial
    >>> [row["name"] for row in medial.methods() if row["exact"]]
    ['disks', 'biarc-dc', 'lee', 'auto']
    """
    return _core.methods()


def log(text: str, *values: object) -> None:
    """Logs to the logger "medial", if logging has been imported."""
    logging = sys.modules.get("logging")
    if logging is not None:
        logging.getLogger("medial").debug(text, *values)


def computing(
    method: str | None,
    *,
    tolerance: float = 0,
    corner_angle: float = 0.01,
    exact: bool = False,
    threads: int | None = None,
    exterior: bool = False,
    margin: float = 0,
    own: dict[str, Any] | None = None,
) -> _core.Options:
    """The options of a computation."""
    return _core.Options(
        method or options.method,
        tolerance,
        corner_angle,
        exact,
        options.threads if threads is None else threads,
        exterior,
        margin,
        own or {},
    )
