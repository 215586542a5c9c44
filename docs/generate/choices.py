"""Effect of the choices of a case: the flagship at top speed, one choice at a time."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

import rotordyn
from docs.generate.flagship import TOP
from docs.generate.marked import table
from docs.generate.places import ROOT
from docs.generate.rows import number
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.preload.known import preload_sum
from rotordyn.analyses.preload.spec import PreloadSpec
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.case.case import Case
from rotordyn.job import solve

POINT = "Oc2"
CHOICES: tuple[tuple[str, str | float], ...] = (
    *(("kinematics", name) for name in ("hybrid", "geometric", "inner")),
    *(("moment_sharing", name) for name in ("hybrid", "outer", "inner")),
    ("friction", 0.08),
    ("bearings", "static"),
    ("rotor", "rigid"),
)
HEAD = (
    *("choice", "preload sum [N]:", "peak pressure [GPa]:", "required friction:"),
    *("radial stiffness [N/µm]:", "bending 1 forward [Hz]:"),
)
RPM = (0, 12000, 24000)
FORCES = (500.0, 1000.0, 2000.0, 3000.0, 4000.0)


@cache
def choice_table() -> str:
    """The case unchanged, then with one choice changed."""
    case = _case()
    asked = {
        "preload": PreloadSpec(),
        "campbell": CampbellSpec(max_frequency=1000.0, shapes=False),
        "stiffness": StiffnessSpec(POINT, steps=1, variants=("full",)),
    }
    case = replace(case, speeds=(0.0, TOP), analyses=asked)
    lines = [("as in the case", *_results(case))]
    for key, name in CHOICES:
        other = replace(case, conditions=replace(case.conditions, **{key: name}))
        lines.append((f"`{key}: {name}`", *_results(other)))
    return table(HEAD, lines)


@cache
def linear_table() -> str:
    """Secant over tangent stiffness less one: error of a linear model under a slow radial force."""
    spec = StiffnessSpec(POINT, max_force=FORCES[-1], steps=8, variants=("nonlinear",))
    speeds = tuple(rpm * math.pi / 30.0 for rpm in RPM)
    found = solve(replace(_case(), speeds=speeds, analyses={"stiffness": spec})).results
    curve = found["stiffness"]
    columns = [int(np.argmin(np.abs(curve.force - force))) for force in FORCES]
    secant = curve.force[columns] / curve.deflection[:, 0, columns]
    deviation = 100.0 * (secant / curve.tangent[:, :1] - 1.0)
    head = ("speed [rpm]:", *(f"{force:.0f} N:" for force in FORCES))
    percents = [[f"{value:+.1f} %".replace("-", "−") for value in line] for line in deviation]
    return table(head, [(str(rpm), *line) for rpm, line in zip(RPM, percents, strict=True)])


def _case() -> Case:
    return rotordyn.load(ROOT / "cases" / "mfw2310.yaml")


def _results(case: Case) -> tuple[str, ...]:
    """The columns of ``HEAD`` at top speed; friction and pressure are the largest of all races."""
    found: Mapping[str, Any] = solve(case).results
    preload, modes = found["preload"], found["campbell"]
    if case.spindle is None:
        raise ValueError("the case has no spindle")
    grip = max(preload.inner_required_friction[-1].max(), preload.outer_required_friction[-1].max())
    pressure = max(preload.inner_pressure[-1].max(), preload.outer_pressure[-1].max())
    bending = np.array([kind == "bending" for kind in modes.kind])
    forward = modes.frequency[-1, bending & (modes.whirl[-1] > 0.0)]
    values = (
        *(preload_sum(preload, case.spindle)[-1], pressure / 1e9, grip),
        *(found["stiffness"].tangent[-1, 0] / 1e6, np.nanmin(forward)),
    )
    return tuple(number(float(value)) for value in values)
