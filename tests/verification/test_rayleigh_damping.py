"""Rayleigh damping of the rotor against ζ = α/2ω + βω/2 and against a mass on a spring."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rotordyn
from bearings import Material
from rotordyn.analyses import CampbellSpec, Conditions
from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.analyses.solving import solve_spindle
from rotordyn.machine import LinearSupport, RayleighDamping, Section, Shaft, Spindle
from rotordyn.machine.inertia import rotor_inertia
from tests.oracles.spindles import RPM

STEEL = Material("steel", 210e9, 0.3, 7850.0)
ALPHA, BETA = 40.0, 2e-6


def bar(stiffness: float, **changes: object) -> Spindle:
    """A bar of 0.6 m on two supports that are alike in all directions."""
    matrix = {(way, way): stiffness / 2.0 for way in ("x", "y", "z")}
    made = Spindle(
        "bar",
        Shaft(0.0, (Section(0.6, 0.05, 0.01, STEEL),)),
        supports=tuple(LinearSupport(n, x, matrix) for n, x in (("l", 0.0), ("r", 0.6))),
        rayleigh=RayleighDamping(ALPHA, BETA),
    )
    return replace(made, **changes)  # type: ignore[arg-type]


def modes(spindle: Spindle, highest: float, rpm: float = 0.0, **own: str) -> CampbellResult:
    asked = {"campbell": CampbellSpec(max_frequency=highest, shapes=False)}
    found = solve_spindle(spindle, Conditions(**own), (rpm * RPM,), asked, lambda name: None)  # type: ignore[arg-type]
    result = found.results["campbell"]
    assert isinstance(result, CampbellResult)
    return result


def test_free_modes_have_the_ratio_of_the_formula() -> None:
    """Bending, axial and torsion of a bar that springs hardly hold."""
    result = modes(bar(1.0), 8000.0)
    flexible = result.frequency[0] > 100.0
    assert {kind for kind, own in zip(result.kind, flexible, strict=True) if own} == {
        "bending",
        "axial",
        "torsion",
    }
    damped = 2.0 * math.pi * result.frequency[0, flexible]
    ratio = result.damping_ratio[0, flexible]
    omega = damped / np.sqrt(1.0 - ratio**2)
    assert ratio == pytest.approx(ALPHA / (2 * omega) + BETA * omega / 2, rel=1e-6)


def test_a_rigid_rotor_feels_its_mass_only() -> None:
    """Bounce of m on k: ζ = α/2ω; supports are not part of the rotor's stiffness."""
    spindle = bar(1e6)
    omega = math.sqrt(1e6 / rotor_inertia(spindle).mass)
    result = modes(spindle, 200.0, rotor="rigid")
    assert result.damping_ratio[0, 0] == pytest.approx(ALPHA / (2 * omega), rel=1e-9)


def test_it_adds_to_modal_damping() -> None:
    both = modes(bar(1.0, rotor_damping=(0.01,)), 3000.0)
    alone = modes(bar(1.0), 3000.0)
    swinging = alone.frequency[0] > 100.0
    added = both.damping_ratio[0, swinging] - alone.damping_ratio[0, swinging]
    assert added == pytest.approx(0.01, rel=1e-5)


def test_read_from_a_case(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(
        "spindle: friswell_two_discs\n"
        "override: {damping.rayleigh: {mass: 2 1/s, stiffness: 3 us}}\n"
        "speeds: [0 rpm]\nanalyses: {campbell: {}}\n"
    )
    spindle = rotordyn.load(path).spindle
    assert spindle is not None
    assert spindle.rayleigh == RayleighDamping(2.0, 3e-6)
