"""Layout of a result in tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from rotordyn.results.display import Shown


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


class Table(NamedTuple):
    """A table without a ``Layout``: name of the file, and label, printed unit and values of each
    column."""

    name: str
    columns: Sequence[tuple[str, Shown, NDArray[Any]]]
