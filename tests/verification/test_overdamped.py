"""Overdamped modes are flagged by speed and mode."""

from __future__ import annotations

import math

import numpy as np
import pytest

from bearings.materials import Material
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.campbell.tables import LAYOUTS
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.report.datasets import dataset
from rotordyn.report.tables import tidy_columns
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.dense_rotor.unreduced import dense_poles

STEEL = Material("steel", 2.1e11, 0.3, 7800.0)
SPEEDS, RATIOS = (0.0, 50.0, 100.0, 150.0), (0.2, 0.5, 0.8, 0.995)


@pytest.mark.parametrize("damping", [2e4, 5e4])
def test_the_error_of_an_overdamped_mode_is_known(damping: float) -> None:
    """Against all eigenvalues of fine elements; a pole that the finer model has nowhere near is
    not taken for a good one. It is omitted from figures and lists, which is no reason to warn of
    those that are in them."""
    ends = (("a", 0.0, 2e7), ("b", 0.35, 5e7))
    supports = tuple(
        LinearSupport(
            name, x, {("y", "y"): k, ("z", "z"): k}, {("y", "y"): damping, ("z", "z"): damping}
        )
        for name, x, k in ends
    )
    shaft = Shaft(0.0, (Section(0.5, 0.05, 0.0, STEEL),))
    spindle = Spindle("damped", shaft, supports=supports)
    truth = dense_poles(spindle, 2000.0, 6000.0, 1e-8)
    scene = Scene(spindle, Conditions(accuracy=1e-5), np.array([2000.0]), 3000.0)
    found = campbell.solve(scene, CampbellSpec(3000.0, shapes=False))
    slow = found.overdamped[0]
    pole, told = found.pole[0, slow], found.frequency_error[0, slow]
    nearest = truth[np.abs(truth[:, None] - pole).argmin(axis=0)]
    error = np.abs(pole.imag - nearest.imag) / np.abs(nearest)
    assert slow.sum() >= 2
    assert (told > 0.3 * error).all()
    assert found.mostly_overdamped[slow].all()
    assert (told > 1e-5).any()
    assert not found.unconverged


def test_the_error_of_a_mode_that_is_overdamped_at_some_speeds_is_said() -> None:
    """Of three speeds it is so at one, and listed."""
    damping, speeds = (9.9e3, 9.9e3, 3e4), (0.0, 1000.0, 2000.0)
    supports = tuple(
        LinearSupport(
            name,
            x,
            {("y", "y"): k, ("z", "z"): k},
            {("y", "y"): damping, ("z", "z"): damping},
            speeds=speeds,
        )
        for name, x, k in (("a", 0.0, 2e7), ("b", 0.35, 5e7))
    )
    shaft = Shaft(0.0, (Section(0.5, 0.05, 0.0, STEEL),))
    spindle = Spindle("damped", shaft, supports=supports)
    scene = Scene(spindle, Conditions(accuracy=1e-5), np.array(speeds), 3000.0)
    found = campbell.solve(scene, CampbellSpec(3000.0, shapes=False))
    assert (found.overdamped.any(axis=0) & ~found.mostly_overdamped).any()
    assert "overdamped" in found.unconverged


def test_a_rigid_rotor_whose_damper_grows_with_speed() -> None:
    """ζ = c/√(2 k m)/2 of translation on two equal supports, at each speed of the table; tilt is
    held by other springs, and does not take part."""
    shaft = Shaft(0.0, (Section(0.4, 0.05, 0.0, STEEL),))
    mass = rotor_inertia(Spindle("m", shaft)).mass
    stiffness = 1e6
    damping = tuple(2.0 * ratio * math.sqrt(stiffness * mass) for ratio in RATIOS)
    entries = {
        ("y", "y"): stiffness,
        ("z", "z"): stiffness,
        ("thy", "thy"): 1e9,
        ("thz", "thz"): 1e9,
    }
    dampers = {("y", "y"): damping, ("z", "z"): damping}
    middle = LinearSupport("s", 0.2, entries, dampers, speeds=SPEEDS)
    spindle = Spindle("rigid", shaft, supports=(middle,))
    scene = Scene(spindle, Conditions(rotor="rigid"), np.array(SPEEDS), 500.0)
    found = campbell.solve(scene, CampbellSpec(500.0))
    modes = [k for k, kind in enumerate(found.kind) if kind == "bending"]
    assert len(modes) == 2
    for k in modes:
        assert found.damping_ratio[:, k] == pytest.approx(RATIOS, rel=1e-9)
        assert found.overdamped[:, k].tolist() == [False, False, False, True]
        omega = math.sqrt(stiffness / mass)
        pole = [complex(-r, math.sqrt(1.0 - r * r)) * omega for r in RATIOS]
        assert found.pole[:, k] == pytest.approx(np.array(pole), rel=1e-9)
    assert not found.mostly_overdamped.any()
    assert dataset(found)["overdamped"].dims == ("speed", "mode")
    headers = [header for header, _ in tidy_columns(found, LAYOUTS[0])]
    assert any(header.startswith("overdamped") for header in headers)
    assert any(header.startswith("pole") and "imaginary" in header for header in headers)
