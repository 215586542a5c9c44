"""Slow modes of stiff rotors on soft springs, the lowest that rounding threatens."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.exact_shaft.count import modes_below, whirl_frequencies
from tests.oracles.exact_shaft.rotor import ExactRotor, exact_rotor
from tests.oracles.many_digits import determinant
from tests.oracles.stepped_rotors import STEEL, stepped_rotor

NO_SEATS = np.zeros((0, 5, 5))
LENGTH, DIAMETER = 5.0, 0.01
PLACES = (0.7, 4.1)
BAND = 200.0  # Hz: the mesh is as fine as this asks


def slender(*stiffness: float) -> Spindle:
    """A uniform bar of 500 diameters, a piece of 0.2 diameters in it, on springs at ``PLACES``."""
    lengths = (2.0, 0.2 * DIAMETER, LENGTH - 2.0 - 0.2 * DIAMETER)
    held = [
        LinearSupport(name, x, {("y", "y"): k, ("z", "z"): k})
        for name, x, k in zip(("left", "right"), PLACES, stiffness, strict=False)
    ]
    sections = tuple(Section(h, DIAMETER, 0.0, STEEL) for h in lengths)
    return Spindle("slender", Shaft(0.0, sections), supports=tuple(held))


def bounce_and_pitch(stiffness: tuple[float, float], spin: float) -> np.ndarray:
    """Whirl of the same as a rigid body [rad/s], backward negative, by size."""
    line = STEEL.density * math.pi / 4.0 * DIAMETER**2
    rotary = STEEL.density * math.pi / 64.0 * DIAMETER**4 * LENGTH
    mass = np.diag([line * LENGTH, line * LENGTH**3 / 12.0 + rotary])
    arm = np.array([[1.0, x - LENGTH / 2.0] for x in PLACES])
    held = arm.T @ np.diag(stiffness) @ arm
    polar = np.diag([0.0, 2.0 * rotary])
    # K + ω Ω Jp − ω² M
    first = np.linalg.solve(mass, np.hstack([held, spin * polar]))
    omega = np.linalg.eigvals(np.block([[np.zeros((2, 2)), np.eye(2)], [first]])).real
    return omega[np.abs(omega).argsort()]


@pytest.mark.parametrize("spin", [0.0, 30.0])
@pytest.mark.parametrize("soft", [1e-9, 1e-6])
def test_rigid_body_on_two_springs(soft: float, spin: float) -> None:
    """Bending lowers the frequencies by 10⁻⁹ on springs of 10⁻⁶ N/m, less on softer ones."""
    stiffness = (soft, 3.0 * soft)
    truth = bounce_and_pitch(stiffness, spin)
    spindle = slender(*stiffness)
    found = Scene(spindle, Conditions(accuracy=1e-6), np.array([spin]), BAND)
    result = campbell.solve(found, CampbellSpec(BAND, shapes=False))
    order = result.frequency[0].argsort()[:4]
    ours = 2.0 * math.pi * result.frequency[0, order]
    assert ours == pytest.approx(np.abs(truth), rel=2e-9 * soft / 1e-6 + 1e-10)
    exact = exact_rotor(spindle, spin, NO_SEATS)
    for omega in truth:
        below, above = (modes_below(exact, omega * (1.0 + side * 3e-9)) for side in (-1.0, 1.0))
        assert above == below + 1


@pytest.mark.parametrize("formulation", ["inertial", "rotating"])
@pytest.mark.parametrize(("springs", "slow"), [((), 0), ((1e4,), 0), ((1e4, 1e-5), 1)])
def test_only_what_nothing_holds_is_omitted(
    springs: tuple[float, ...], slow: int, formulation: str
) -> None:
    """Free, hinged on one spring, and hinged with a spring of 10⁻⁹ of it: slow, not free."""
    conditions = Conditions(accuracy=1e-4, formulation=formulation)
    found = Scene(slender(*springs), conditions, np.array([0.0]), BAND)
    result = campbell.solve(found, CampbellSpec(BAND, shapes=False))
    bending = [k for k, kind in enumerate(result.kind) if kind == "bending"]
    frequency = np.sort(result.frequency[0, bending])
    assert (frequency < 0.1).sum() == 2 * slow
    along = 2 + 2  # nothing holds axial motion and torsion: two poles at zero each
    assert result.free == pytest.approx(along + 4 * (2 - len(springs)))  # in both planes
    assert (result.frequency_error[0, bending] < 1e-4).all()


@pytest.mark.few(2)
@pytest.mark.parametrize("seed", [128, 147, 196, 251])
def test_lowest_modes_against_sixty_digits(seed: int) -> None:
    """Exact shaft and elements enclose the same zero of the determinant, and as told."""
    rng = np.random.default_rng(seed)
    spindle = stepped_rotor(rng)
    still = whirl_frequencies(exact_rotor(spindle, 0.0, NO_SEATS), 6)
    spin = rng.uniform(0.0, 5.0) * still[0]
    highest = 1.02 * still[5] / (2.0 * math.pi)
    found = Scene(spindle, Conditions(accuracy=1e-6), np.array([spin]), highest)
    result = campbell.solve(found, CampbellSpec(highest, shapes=False))
    exact = exact_rotor(spindle, spin, NO_SEATS)
    for direction in (-1, 1):
        own = np.flatnonzero(result.whirl[0] == direction)
        own = own[result.frequency[0, own].argsort()][:2]
        truth = whirl_frequencies(exact, 2, direction)
        for k, omega in zip(own, truth, strict=True):
            assert encloses(exact, direction * omega, 1e-11)
            ours = 2.0 * math.pi * result.frequency[0, k]
            # refinement does not show rounding, which is held below 1e-8
            width = max(3.0 * result.frequency_error[0, k], 1e-8)
            assert encloses(exact, direction * ours, width)
            assert result.frequency_error[0, k] < 1e-8


def encloses(rotor: ExactRotor, omega: float, width: float) -> bool:
    """True where the determinant changes sign within a relative ``width`` around ``omega``."""
    low, high = (determinant(rotor, omega * (1.0 + s * width)) for s in (-1.0, 1.0))
    return (low < 0) != (high < 0)
