"""Coordinates of a body: unit mass, whatever it is made of, and its matrices in them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotordyn.equation.component import Component
from rotordyn.machine.housing import RigidHousing
from rotordyn.machine.rotor import RayleighDamping
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from tests.oracles.rotors import STEPPED
from tests.oracles.spindles import mfw2310, scene

DAMPED = replace(
    STEPPED,
    rotor_damping=(0.01, 0.02),
    rayleigh=RayleighDamping(3.0, 2e-6),
    internal_damping=0.3,
)


def components(spindle: Spindle) -> list[Component]:
    return [each for parts in scene(spindle, [0.0]).subsystems for each in parts]


@pytest.mark.parametrize("spindle", [mfw2310(), STEPPED], ids=["sleeves", "stepped"])
def test_coordinates_have_unit_mass_and_their_stiffness(spindle: Spindle) -> None:
    found = components(spindle)
    assert any(each.spindle is None for each in found) == bool(spindle.sleeves)
    for each in found:
        one = np.eye(each.size)
        mass = each.projected("mass")
        assert np.abs(mass - one).max() < 1e-8
        largest = np.abs(each.stiffness).max() or 1.0
        apart = each.projected("stiffness") - each.stiffness
        assert np.abs(apart).max() < 1e-8 * largest


def test_damping_is_that_of_modes_and_its_share_turns() -> None:
    """2ζω + α + βω² of each mode, the last ratio for all that follow; 0.3 of it turns with the
    shaft in bending, none of what turns it or draws it."""
    for each in components(DAMPED):
        if each.values.ndim != 1:
            continue
        modes = np.flatnonzero(each.values > 0.0)[:3]
        omega = np.sqrt(each.values[modes])
        ratios = np.array([0.01, 0.02, 0.02]) if each.bends else np.full(3, 0.02)
        expected = 2.0 * ratios[: len(modes)] * omega + 3.0 + 2e-6 * omega**2
        assert each.damping[modes, modes] == pytest.approx(expected, rel=1e-6)
        share = 0.3 if each.bends else 0.0
        assert each.turning == pytest.approx(share * each.damping)


def test_dampers_of_a_housing_damp_its_motions() -> None:
    """c/m of a body of its own mass."""
    foot = LinearSupport("foot", 0.0, {("y", "y"): 1e8, ("z", "z"): 1e8})
    ways = {(way, way): value for way, value in (("y", 5e7), ("z", 4e7))}
    box = RigidHousing("box", ("foot",), 0.0, 30.0, ways, {("y", "y"): 900.0, ("z", "z"): 600.0})
    rates = []
    for each in components(replace(STEPPED, supports=(foot,), housings=(box,))):
        if each.spindle is None:
            rates += each.damping.diagonal().tolist()
    assert sorted(rates) == pytest.approx([20.0, 30.0])
