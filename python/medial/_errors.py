"""Errors with a code and a place."""

from __future__ import annotations

from typing import Any


class MedialError(ValueError):
    """An input or an option that cannot be computed.

    Attributes
    ----------
    code : str
        A stable name, such as ``"crossing"`` or ``"invalid_option"``.
    feature, ring, vertex : int or None
        The place in the input, counted from 0.
    point : tuple of float or None
        The place, in units of the input.

    Examples
    --------
    >>> import medial
    >>> try:
    ...     medial.axis([(0, 0), (2, 2), (2, 0), (0, 2)])
    ... except medial.MedialError as error:
    ...     error.code, error.point
    ('crossing', (1.0, 1.0))
    """

    def __init__(
        self,
        text: str,
        code: str = "invalid_option",
        feature: int | None = None,
        ring: int | None = None,
        vertex: int | None = None,
        point: tuple[float, ...] | None = None,
    ) -> None:
        super().__init__(text, code, feature, ring, vertex, point)
        self.text = text
        self.code = code
        self.feature = feature
        self.ring = ring
        self.vertex = vertex
        self.point = point

    def __str__(self) -> str:
        named = {"feature": self.feature, "ring": self.ring, "vertex": self.vertex}
        where = ", ".join(f"{name} {index}" for name, index in named.items() if index is not None)
        if self.point is not None:
            where += " at (" + ", ".join(f"{x:.10g}" for x in self.point) + ")"
        return (where.strip() + ": " if where else "") + f"{self.text} [{self.code}]"


class MissingPackage(ImportError):
    """A function needs a package that is not installed."""


def need(package: str, extra: str) -> Any:
    """Imports a package, or raises with instructions to install it."""
    import importlib

    try:
        return importlib.import_module(package)
    except ImportError as error:
        name = package.split(".")[0]
        raise MissingPackage(
            f"this needs {name}: pip install {name}, or pip install medial-axis[{extra}]"
        ) from error
