"""Effect of formulation and axial force on the bending modes of the flagship."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from docs.generate.flagship import TOP, flagship
from docs.generate.marked import table
from docs.generate.rows import number
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.job import solve
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.formulation import FORMULATIONS
from rotordyn.scene.scene import Scene

Array = NDArray[np.float64]
SHOWN = 6  # modes


@cache
def _modes(**conditions: Any) -> tuple[tuple[str, ...], Array]:
    """Names and frequencies (2, modes) [Hz] of the lowest bending modes at rest and top speed."""
    case = flagship().case
    asked = replace(
        case,
        speeds=(0.0, TOP),
        analyses={"campbell": CampbellSpec(4000.0, shapes=False)},
        conditions=replace(case.conditions, **conditions),
    )
    found: Any = solve(asked).results["campbell"]
    bending = [k for k, kind in enumerate(found.kind) if kind == "bending"][:SHOWN]
    return tuple(found.mode[k] for k in bending), found.frequency[:, bending]


def formulation_table() -> str:
    """Frequencies at top speed in the three formulations, with bearings at speed and at rest."""
    head = ["mode at 24 000 rpm [Hz]"]
    columns: list[tuple[str, ...]] = []
    for bearings in ("dynamic", "static"):
        for formulation in FORMULATIONS:
            names, values = _modes(bearings=bearings, formulation=formulation)
            head.append(f"{formulation}, bearings {bearings}:")
            columns.append(tuple(number(value) for value in values[1]))
    rows = [(name, *(column[k] for column in columns)) for k, name in enumerate(names)]
    return table(tuple(head), rows)


def axial_force_table() -> str:
    """Relative change of the modes by the axial force due to preload and speed."""
    names, plain = _modes(axial_stiffening=False)
    _, stiffened = _modes()
    changes = stiffened / plain - 1.0
    rows = [
        (name, *(f"{1e6 * change:+.1f}".replace("-", "−") for change in changes[:, k]))
        for k, name in enumerate(names)
    ]
    return table(("mode", "at rest [10⁻⁶]:", "at 24 000 rpm [10⁻⁶]:"), rows)


def axial_force_spans() -> str:
    """The axial force between the bearings, at rest and at top speed."""
    case, spindle = flagship().case, flagship().spindle
    force = Scene(spindle, case.conditions, np.array([0.0, TOP])).shaft_force
    ends = _ends(spindle)
    middle = np.array([0.5 * (a + b) for (_, a), (_, b) in pairwise(ends)])
    values = force.at(middle)
    rows = [
        (f"{a} to {b}", *(number(v) if abs(v) > 1e-6 else "0" for v in values[:, k]))
        for k, ((a, _), (b, _)) in enumerate(pairwise(ends))
    ]
    return table(("part of the shaft", "at rest [N]:", "at 24 000 rpm [N]:"), rows)


def _ends(spindle: Spindle) -> list[tuple[str, float]]:
    shaft = spindle.shaft
    seats = [(seat.name, seat.x) for seat in spindle.seats]
    return [("tip", shaft.start), *seats, ("tail", shaft.end)]
