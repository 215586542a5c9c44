"""Shafts with next to no mass under a disc: the poles of the disc on a massless beam."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.machine.lumped import Disc
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.idealised import idealised
from tests.oracles.stepped_rotors import STEEL

TOP = 1000.0


def held(name: str, x: float, damping: float) -> LinearSupport:
    damped = {("y", "y"): damping, ("z", "z"): damping}
    return LinearSupport(name, x, {("y", "y"): 1e7, ("z", "z"): 1.5e7}, damped)


def solved(density: float, damping: float, top: float = TOP) -> CampbellResult:
    """A disc on a shaft of 500 mm on damped supports, at rest and at 1000 rad/s."""
    light = idealised("light", 2.1e11, 0.3, density)
    spindle = Spindle(
        "light",
        Shaft(0.0, (Section(0.5, 0.03, 0.0, light),)),
        discs=(Disc("disc", 0.2, 0.2, 0.03, 0.03, STEEL),),
        supports=(held("front", 0.0, damping), held("rear", 0.5, damping)),
    )
    scene = Scene(spindle, Conditions(), np.array([0.0, 1000.0]), top)
    return campbell.solve(scene, CampbellSpec(top, shapes=False))


def bending(result: CampbellResult) -> np.ndarray:
    """Poles in the band at 1000 rad/s, by imaginary part."""
    kind = np.array([kind == "bending" for kind in result.kind])
    pole = result.pole[1, kind & (result.frequency[1] < TOP)]
    return pole[np.argsort(pole.imag)]


@pytest.mark.parametrize("damping", [2e3, 2e5])
@pytest.mark.parametrize("density", [1e-5, 1e-7, 1e-9])
def test_poles_are_those_of_a_massless_beam(density: float, damping: float) -> None:
    light, heavier = solved(density, damping), solved(1e-2, damping)
    assert bending(light) == pytest.approx(bending(heavier), rel=1e-5)
    assert math.isinf(light.stability_threshold)
    assert not light.unconverged
