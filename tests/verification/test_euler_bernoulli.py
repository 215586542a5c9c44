"""Shafts that do not deform in shear (``shear_coefficient: none``), with rotary inertia."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import rotordyn
from rotordyn.analyses import SectionForcesSpec
from rotordyn.analyses.solving import solve_spindle
from rotordyn.equation.elements.beam import inner_dofs
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import PointLoad
from rotordyn.scene.scene import Scene
from tests.oracles.rotors import STEEL
from tests.oracles.spindles import RPM

LENGTH, OUTER, INNER = 0.5, 0.06, 0.02
AREA = math.pi / 4.0 * (OUTER**2 - INNER**2)
MOMENT = math.pi / 64.0 * (OUTER**4 - INNER**4)


def pinned(shear: str | float = "none") -> Spindle:
    shaft = Shaft(0.0, (Section(LENGTH, OUTER, INNER, STEEL),), shear)
    ends = (("a", 0.0, ("x", "y", "z", "thx")), ("b", LENGTH, ("y", "z")))
    return Spindle(
        "pinned", shaft, supports=tuple(LinearSupport(n, x, rigid=r) for n, x, r in ends)
    )


def whirl(spindle: Spindle, speed: float, top: float = 6000.0, **conditions: float) -> np.ndarray:
    own = Conditions(**conditions)  # type: ignore[arg-type]
    scene = Scene(spindle, own, np.array([speed]), top)
    pole = scene.system(scene.with_motions(["bending"])[0]).pole[0].imag
    return np.sort(pole[np.isfinite(pole) & (pole > 1.0)])


def exact(mode: int, speed: float) -> tuple[float, float]:
    """Backward and forward: (ρA + ρI k²) ω² − 2 ρI k² Ω ω − E I k⁴ = 0."""
    k = mode * math.pi / LENGTH
    mass, rotary = 7800.0 * (AREA + MOMENT * k**2), 7800.0 * MOMENT * k**2
    roots = np.roots([mass, -2.0 * rotary * speed, -2.1e11 * MOMENT * k**4])
    backward, forward = sorted(np.abs(roots).tolist())
    return backward, forward


@pytest.mark.parametrize("accuracy", [1e-4, 1e-7])
@pytest.mark.parametrize("speed", [0.0, 30000.0 * RPM])
def test_a_pinned_beam(speed: float, accuracy: float) -> None:
    found = whirl(pinned(), speed, accuracy=accuracy)
    truth = np.sort([w for mode in (1, 2, 3) for w in exact(mode, speed)])
    assert found[:6] == pytest.approx(truth, rel=accuracy)


def test_standard_elements_converge_with_the_fourth_power() -> None:
    truth = exact(2, 0.0)[0]
    error = [whirl(pinned(), 0.0, element_length=LENGTH / n)[2] / truth - 1.0 for n in (8, 16)]
    assert error[0] / error[1] == pytest.approx(16.0, rel=0.05)


def test_it_is_the_limit_of_ever_stiffer_shear() -> None:
    rigid = whirl(pinned(), 3000.0, accuracy=1e-7)[:6]
    soft = whirl(pinned(1.0), 3000.0, accuracy=1e-7)[:6]
    assert (soft < rigid).all()
    assert soft[:2] == pytest.approx(rigid[:2], rel=0.03)


def test_no_dof_of_shear() -> None:
    """Of degree n between the nodes: 2 n − 1 with shear, n − 2 of bending alone."""
    degree = np.arange(1, 6)
    assert inner_dofs(degree).tolist() == [0, 3, 5, 7, 9]
    assert inner_dofs(degree, sheared=False).tolist() == [0, 0, 1, 2, 3]


def test_statics_without_shear() -> None:
    spec = SectionForcesSpec(loads=(PointLoad(LENGTH / 2.0, Fy=1000.0),))
    asked = {"section_forces": spec}
    found = solve_spindle(pinned(), Conditions(), (0.0,), asked, lambda name: None)
    deflection = found.results["section_forces"].deflection_y[0]
    assert deflection.max() == pytest.approx(1000.0 * LENGTH**3 / 48.0 / 2.1e11 / MOMENT, rel=1e-11)


def test_the_word_in_a_case(tmp_path: Path) -> None:
    text = """
title: beam
spindle:
  shaft:
    start: 0 mm
    shear_coefficient: none
    material: steel_rotor
    sections: [{length: 0.5 m, outer_diameter: 60 mm}]
  supports:
    - {name: a, x: 0 mm, stiffness: {yy: 30 N/um, zz: 30 N/um}}
    - {name: b, x: 0.5 m, stiffness: {yy: 30 N/um, zz: 30 N/um}}
speeds: [0 rpm]
analyses: {campbell: {max_frequency: 800 Hz}}
"""
    (tmp_path / "case.yaml").write_text(text)
    case = rotordyn.load(tmp_path / "case.yaml")
    assert case.spindle is not None
    assert case.spindle.shaft.shear_coefficient == "none"
    stiff, soft = (
        float(np.nanmin(rotordyn.run(each)["campbell"].frequency))
        for each in (case, case.vary({"spindle.shaft.shear_coefficient": "cowper"}))
    )
    assert soft < stiff < 1.1 * soft
