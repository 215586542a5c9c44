"""Dynamics of high-speed machining spindles. Nothing heavy is imported before it is used."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rotordyn.case.case import Case
    from rotordyn.case.read import load
    from rotordyn.errors import InvalidInput, NoSolution, RotordynError
    from rotordyn.job import run

__version__ = "0.1.0"
_HOME = {
    "Case": "rotordyn.case.case",
    "InvalidInput": "rotordyn.errors",
    "NoSolution": "rotordyn.errors",
    "RotordynError": "rotordyn.errors",
    "load": "rotordyn.case.read",
    "run": "rotordyn.job",
}
__all__ = [
    "Case",
    "InvalidInput",
    "NoSolution",
    "RotordynError",
    "__version__",
    "load",
    "run",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'rotordyn' has no attribute {name!r}")
    return getattr(importlib.import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)
