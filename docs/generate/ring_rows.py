"""Flexible rings: the bearing of Lacroix' thesis, and their effect on two spindles."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

import rotordyn
from bearings.bearing import BallBearing
from docs.generate.marked import table
from docs.generate.places import ROOT
from docs.generate.rows import number

LOADS = {  # axial and radial load; tables 4.10 to 4.12 for rigid and elastic rings
    "20 kN": ((20e3, 0.0), ("250", "42.2", "1486"), ("265", "43.4", "1452")),
    "100 kN": ((100e3, 0.0), ("304", "45.3", "7030"), ("395", "50.9", "6408")),
    "20 kN, 12 kN radial": ((20e3, 12e3), ("228, 136", "22.4", "–"), ("246, 174", "20.3", "3739")),
}


def thesis_table() -> str:
    """Deflection, contact angle and load of the ball at 0°, printed and computed."""
    case = rotordyn.load(ROOT / "cases" / "four_point_rings.yaml")
    spec: Any = case.analyses["bearing"]
    assert case.bearing is not None, "the case is one of a bearing"
    rows = []
    for name, (load, *printed) in LOADS.items():
        for rings, known in zip((False, True), printed, strict=True):
            bearing = spec.mounted(case.bearing) if rings else case.bearing
            rows.append(
                (
                    f"{name}, rings {'elastic' if rings else 'rigid'}",
                    *(
                        cell
                        for pair in zip(known, _found(bearing, load), strict=True)
                        for cell in pair
                    ),
                )
            )
    head = (
        "load",
        "deflection [µm], thesis:",
        "computed:",
        "angle ir [°], thesis:",
        "computed:",
        "load ir [N], thesis:",
        "computed:",
    )
    return table(head, rows)


def _found(bearing: BallBearing, load: tuple[float, float]) -> tuple[str, str, str]:
    state = bearing.equilibrium(
        load=[*load, 0.0, 0.0, 0.0], speed=1500.0 * math.pi / 30.0, kinematics="outer"
    )
    moved = state.displacement[:2] * 1e6
    play = ", ".join(number(float(v)) for v in moved[: 2 if load[1] else 1])
    angle = math.degrees(float(state.contact_angle[0, 0]))
    return play, number(angle), number(float(state.contact_load[0, 0]))


def walls_table() -> str:
    """Effect of flexible rings on flagship and grinding spindle, in per cent of rigid rings."""
    rows = []
    for name, what in (("mfw2310_rings", "frequency"), ("grinding_spindle_rings", "stiffness")):
        case = rotordyn.load(ROOT / "cases" / f"{name}.yaml")
        found = {key: _ends(variant, what) for key, variant in case.variants.items()}
        rigid = found.pop("rigid")
        for key, values in found.items():
            title = case.variants[key].title
            change = [f"{100.0 * (v / r - 1.0):+.2f}" for v, r in zip(values, rigid, strict=True)]
            quantity = (
                "first bending mode" if what == "frequency" else "radial stiffness at the nose"
            )
            rows.append((f"{name}: {title}", quantity, *change))
    return table(("case", "quantity", "at rest [%]:", "at top speed [%]:"), rows)


def _solved(case: Any, analysis: str) -> Any:
    return rotordyn.run(replace(case, analyses={analysis: case.analyses[analysis]}))[analysis]


def _ends(case: Any, what: str) -> list[float]:
    """The quantity at the first and the last speed."""
    if what == "stiffness":
        values = _solved(case, "stiffness").tangent.values[:, 0]
    else:
        modes = _solved(case, "campbell")
        values = modes.frequency.sel(mode="bending 1 forward").values
    return [float(values[0]), float(np.asarray(values)[-1])]
