"""How a result is laid out in tables."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Layout:
    """One file: a line per combination of ``rows``, the dimensions ``across`` side by side.

    ``repeating``: quantities over some of the rows only are repeated along the others; ``several``:
    written only where there is more than one of this dimension.
    """

    name: str
    rows: tuple[str, ...]
    across: tuple[str, ...] = ()
    repeating: bool = False
    several: str = ""
