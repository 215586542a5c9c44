"""Errors of rotordyn and their exit codes.

RotordynError
├── InvalidInput      exit 2   every fault found in the input, all at once
│   └── OutputRefused exit 2   the results folder is not ours to replace
├── TooCostly         exit 2   more time or memory than a run may take
└── NoSolution        exit 3   no speed of the case has a physical solution

Errors of the ``bearings`` package pass through; ``exit_code`` handles them, too. Any other error is
a bug of rotordyn and exits with 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from bearings.errors import BearingError, InvalidBearing

PRINTED = 30  # faults listed in a message


@dataclass(frozen=True, slots=True)
class Fault:
    """A fault of an input file: ``file:line:column: path: message``.

    Line and column count from 1; 0 for the file as a whole, printed as 1.
    """

    file: str
    line: int
    column: int
    path: str
    message: str

    def __str__(self) -> str:
        where = f"{printable(self.file)}:{max(self.line, 1)}:{max(self.column, 1)}"
        return f"{where}: {self.path}: {self.message}" if self.path else f"{where}: {self.message}"


def printable(text: str) -> str:
    """Replace control characters and line breaks by spaces."""
    return "".join(letter if letter.isprintable() else " " for letter in text)


class RotordynError(Exception):
    """Base of all errors that ``rotordyn`` raises on purpose."""


class InvalidInput(RotordynError):
    """Invalid input; ``faults`` lists all faults, of which the message shows the first ones."""

    def __init__(self, faults: Sequence[Fault] | str) -> None:
        self.faults: tuple[Fault, ...] = () if isinstance(faults, str) else tuple(faults)
        super().__init__(faults if isinstance(faults, str) else _listed(self.faults))


class TooManyFaults(InvalidInput):
    """Invalid input with so many faults that reading stopped."""

    def __init__(self, faults: Sequence[Fault]) -> None:
        super().__init__(faults)
        last = faults[-1]
        self.args = (f"{self.args[0]}\n{last.file}: too many faults: not read any further",)


def _listed(faults: Sequence[Fault]) -> str:
    lines = [str(fault) for fault in faults[:PRINTED]]
    if len(faults) > PRINTED:
        lines.append(f"{len(faults) - PRINTED} more faults")
    return "\n".join(lines)


class OutputRefused(InvalidInput):
    """The results folder exists and was not made by rotordyn."""


class TooCostly(RotordynError):
    """A request exceeds the time or memory allowed for a run."""


class LeftOut(Exception):
    """A file is not written, for the reason given; a note says so, and the run continues."""


class NoSolution(RotordynError):
    """No speed of the case has a physical solution."""


_PACKAGES = {"PIL": "pillow", "vtkmodules": "vtk", "yaml": "PyYAML"}  # by the name of a module


def not_installed(module: str | None) -> str | None:
    """Sentence on a ``module`` that is not installed; None if it belongs to rotordyn."""
    top = (module or "").partition(".")[0]
    if top in ("", "rotordyn", "bearings"):
        return None
    package = _PACKAGES.get(top, top)
    return f"the package {package} is not installed: python -m pip install {package}"


def exit_code(error: BaseException) -> int:
    """Process exit code for an error (0 is never returned)."""
    if isinstance(error, KeyboardInterrupt):
        return 130
    if isinstance(error, InvalidInput | InvalidBearing | TooCostly):
        return 2
    if isinstance(error, NoSolution | BearingError):
        return 3
    return 1
