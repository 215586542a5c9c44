"""Figures: the cycle of axial force."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

import numpy as np

from rotordyn.analyses.contract import Code
from rotordyn.figures.draw import Job
from rotordyn.preload.arrangement import SHAFT
from rotordyn.results.described import Described, Shown
from rotordyn.results.display import MICROMETRE, RPM, STIFFNESS
from rotordyn.results.headline import Curve

code = partial(Code, __name__)


def figures(_: Described, result: Any, __: Mapping[str, Any]) -> Iterator[Job]:
    """Yield the figures of a result."""
    yield "axial_cycle", partial(code("loops:cycle_figure"), result)
    yield "axial_stiffness", partial(code("loops:stiffness_figure"), result)
    if np.isfinite(result.held_force).any():
        yield "held_force", partial(code("loops:held_figure"), result)


def headline_curves(_: Any, variant: Shown) -> Iterator[Curve]:
    """Yield displacement of the shaft at the first and last speed, stiffness at no load."""
    result, rpm = variant.result, variant.result.speed * RPM.factor
    for index in sorted({0, len(rpm) - 1}):
        for k, name in enumerate(result.branch):
            shift = result.position[index, k, :, SHAFT] * MICROMETRE.factor
            at = f"{rpm[index]:.0f} rpm"
            yield Curve(
                "axial_cycle",
                "axial shift of the shaft",
                "µm",
                result.force,
                shift,
                series=f"force {name}",
                panel=at,
                along="axial force [N]",
                title=at,
            )
    for k, name in enumerate(result.branch):
        stiffness = result.no_load_stiffness[:, k] * STIFFNESS.factor
        label = "axial stiffness at no load"
        yield Curve("axial_stiffness", label, "N/µm", rpm, stiffness, series=f"force {name}")
