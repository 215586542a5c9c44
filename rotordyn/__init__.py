"""Dynamics of high-speed machining spindles. Nothing heavy is imported before it is used."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rotordyn import analyses, errors, machine, state
    from rotordyn.case.case import Case
    from rotordyn.case.model import model
    from rotordyn.case.read import load
    from rotordyn.case.shipped import cases, models
    from rotordyn.case.vary import vary
    from rotordyn.errors import InvalidInput, NoSolution, RotordynError
    from rotordyn.job import Results, open
    from rotordyn.study import Goal, Limit, Span, optimise, sweep, write_report
    from rotordyn.study.run import run
    from rotordyn.study.sensitivity import sensitivities

__version__ = "0.1.0"
_ROOMS = ("analyses", "errors", "machine", "state")
_MODULE_OF = {
    "Case": "rotordyn.case.case",
    "Goal": "rotordyn.study",
    "InvalidInput": "rotordyn.errors",
    "NoSolution": "rotordyn.errors",
    "Limit": "rotordyn.study",
    "Results": "rotordyn.job",
    "RotordynError": "rotordyn.errors",
    "Span": "rotordyn.study",
    "cases": "rotordyn.case.shipped",
    "load": "rotordyn.case.read",
    "model": "rotordyn.case.model",
    "models": "rotordyn.case.shipped",
    "open": "rotordyn.job",
    "optimise": "rotordyn.study",
    "run": "rotordyn.study.run",
    "sensitivities": "rotordyn.study.sensitivity",
    "sweep": "rotordyn.study",
    "vary": "rotordyn.case.vary",
    "write_report": "rotordyn.study",
}
__all__ = [
    "Case",
    "Goal",
    "InvalidInput",
    "Limit",
    "NoSolution",
    "Results",
    "RotordynError",
    "Span",
    "__version__",
    "analyses",
    "cases",
    "errors",
    "load",
    "machine",
    "model",
    "models",
    "open",
    "optimise",
    "run",
    "sensitivities",
    "state",
    "sweep",
    "vary",
    "write_report",
]


def __getattr__(name: str) -> Any:
    if name in _ROOMS:
        return importlib.import_module(f"rotordyn.{name}")
    if name not in _MODULE_OF:
        raise AttributeError(f"module 'rotordyn' has no attribute {name!r}")
    return getattr(importlib.import_module(_MODULE_OF[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)
