"""Figures: the dynamic preload state of every bearing, spring and stop."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

from rotordyn.analyses.contract import Code
from rotordyn.analyses.preload.known import preload_sum
from rotordyn.figures.draw import Job
from rotordyn.results.described import Described, Shown
from rotordyn.results.display import MICROMETRE, RPM
from rotordyn.results.headline import Curve

code = partial(Code, __name__)


def figures(case: Described, result: Any, _: Mapping[str, Any]) -> Iterator[Job]:
    """The figures of a result."""
    if not result.bearing or case.spindle is None:
        return
    known = case.known
    yield "preload", partial(code("over_speed:preload_figure"), result, case.spindle, known)
    yield "contacts", partial(code("over_speed:contacts_figure"), result)


def headline_curves(_: Any, variant: Shown) -> Iterator[Curve]:
    """Sum of the preloads, and the shift of every sleeve."""
    result, rpm = variant.result, variant.result.speed * RPM.factor
    if not result.bearing or variant.spindle is None:
        return
    total = preload_sum(result, variant.spindle)
    yield Curve("preload", "sum of preloads", "N", rpm, total, known=("preload_sum", ""))
    for name in result.sleeve:
        shift = result.position[:, result.body.index(name)] * MICROMETRE.factor
        known = ("sleeve_displacement", name)
        yield Curve("preload", f"sleeve {name}, shift", "µm", rpm, shift, known=known)
