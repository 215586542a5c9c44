"""Stability lobes: stable depth of cut over speed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rotordyn.analyses.contract import in_folder
from rotordyn.analyses.stability_lobes.spec import StabilityLobesSpec
from rotordyn.analyses.stability_lobes.tables import LAYOUTS

if TYPE_CHECKING:
    from rotordyn.analyses.stability_lobes.forced import Milled, milled
    from rotordyn.analyses.stability_lobes.limit import limit_depth
    from rotordyn.analyses.stability_lobes.modal_limit import Limit
    from rotordyn.analyses.stability_lobes.turning import turning_limit

__all__ = ["ANALYSIS", "Limit", "Milled", "limit_depth", "milled", "turning_limit"]

ANALYSIS = in_folder(
    __name__,
    "accuracy",
    "warnings",
    "page",
    "lacking",
    machine="spindle",
    place=25,
    spec=StabilityLobesSpec,
    highest=lambda spec, _: spec.max_frequency,
    forced=True,
    ports=lambda spec: (spec.point,),
    tables=LAYOUTS,
    heading="stability lobes",
    over="cutting_speed",
)

_MODULES = {
    "Limit": "modal_limit",
    "Milled": "forced",
    "limit_depth": "limit",
    "milled": "forced",
    "turning_limit": "turning",
}


def __getattr__(name: str) -> Any:
    """Import solvers when they are first used: reading a case needs specs alone."""
    if name in _MODULES:
        from importlib import import_module

        return getattr(import_module(f"{__name__}.{_MODULES[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
