"""Dynamics of high-speed machining spindles. Nothing heavy is imported before it is used."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rotordyn import analyses, errors, machine, state
    from rotordyn.case.case import Case
    from rotordyn.case.library import cases, models
    from rotordyn.case.model import model
    from rotordyn.case.read import load
    from rotordyn.case.vary import vary
    from rotordyn.errors import InvalidInput, NoSolution, RotordynError
    from rotordyn.job import Results, open
    from rotordyn.study.identification import (
        AxialCurve,
        AxialStiffness,
        Modes,
        NoLoad,
        Numbers,
        Phase,
        Predicted,
        Responses,
        StopReached,
        Unknown,
        identify,
    )
    from rotordyn.study.optimum.goals import Goal, Limit
    from rotordyn.study.optimum.solve import optimise
    from rotordyn.study.page import write_report
    from rotordyn.study.parameter import Span
    from rotordyn.study.run import run
    from rotordyn.study.sensitivity import sensitivities
    from rotordyn.study.solve import sweep

__version__ = "0.1.0"
_ROOMS = ("analyses", "errors", "machine", "state")
_MODULE_OF = {
    "AxialCurve": "rotordyn.study.identification",
    "AxialStiffness": "rotordyn.study.identification",
    "Case": "rotordyn.case.case",
    "Goal": "rotordyn.study.optimum.goals",
    "InvalidInput": "rotordyn.errors",
    "Limit": "rotordyn.study.optimum.goals",
    "Modes": "rotordyn.study.identification",
    "NoLoad": "rotordyn.study.identification",
    "NoSolution": "rotordyn.errors",
    "Numbers": "rotordyn.study.identification",
    "Phase": "rotordyn.study.identification",
    "Predicted": "rotordyn.study.identification",
    "Responses": "rotordyn.study.identification",
    "Results": "rotordyn.job",
    "RotordynError": "rotordyn.errors",
    "Span": "rotordyn.study.parameter",
    "StopReached": "rotordyn.study.identification",
    "Unknown": "rotordyn.study.identification",
    "cases": "rotordyn.case.library",
    "identify": "rotordyn.study.identification",
    "load": "rotordyn.case.read",
    "model": "rotordyn.case.model",
    "models": "rotordyn.case.library",
    "open": "rotordyn.job",
    "optimise": "rotordyn.study.optimum.solve",
    "run": "rotordyn.study.run",
    "sensitivities": "rotordyn.study.sensitivity",
    "sweep": "rotordyn.study.solve",
    "vary": "rotordyn.case.vary",
    "write_report": "rotordyn.study.page",
}
__all__ = [
    "AxialCurve",
    "AxialStiffness",
    "Case",
    "Goal",
    "InvalidInput",
    "Limit",
    "Modes",
    "NoLoad",
    "NoSolution",
    "Numbers",
    "Phase",
    "Predicted",
    "Responses",
    "Results",
    "RotordynError",
    "Span",
    "StopReached",
    "Unknown",
    "__version__",
    "analyses",
    "cases",
    "errors",
    "identify",
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
