"""The number of modes in a band against counts made by other means."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.equation.mesh import build_mesh
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.dense_rotor.unreduced import dense_poles
from tests.oracles.exact_shaft.count import modes_below, whirl_frequencies
from tests.oracles.exact_shaft.rotor import exact_rotor
from tests.oracles.full_rotor import FullRotor
from tests.oracles.rotors import STEEL, support, uniform
from tests.oracles.spindles import RPM, mfw2310
from tests.oracles.stepped_rotors import stepped_rotor

NO_SEATS = np.zeros((0, 5, 5))
HZ = 2.0 * math.pi


def answered(
    spindle: Spindle, speed: list[float], highest: float, **conditions: Any
) -> CampbellResult:
    scene = Scene(spindle, Conditions(**conditions), np.array(speed), highest)
    return campbell.solve(scene, CampbellSpec(highest, shapes=False))


def number(result: CampbellResult, row: int, highest: float, *kinds: str) -> int:
    """Modes of some kinds up to ``highest`` [Hz]."""
    frequency = result.frequency[row, [kind in kinds for kind in result.kind]]
    return int((frequency <= highest).sum())


@pytest.mark.few(2)
@pytest.mark.parametrize("seed", range(6))
def test_isotropic_rotors_by_inertia_of_the_exact_shaft(seed: int) -> None:
    """Wittrick and Williams' count of both whirls: without elements, without eigenvalues."""
    rng = np.random.default_rng(seed)
    spindle = stepped_rotor(rng)
    still = whirl_frequencies(exact_rotor(spindle, 0.0, NO_SEATS), 6)
    speed = [0.5 * still[0], 4.0 * still[0]]
    highest = min(1.02 * still[5] / HZ, 9.9e5)
    result = answered(spindle, speed, highest)
    for row, spin in enumerate(speed):
        exact = exact_rotor(spindle, spin, NO_SEATS)
        expected = sum(modes_below(exact, side * HZ * highest) for side in (-1, 1))
        assert number(result, row, highest, "bending") == expected
    assert not result.unconverged


@pytest.mark.few(2)
@pytest.mark.parametrize("seed", [1, 4, 5, 7])
def test_anisotropic_damped_rotors_by_all_eigenvalues(seed: int) -> None:
    """Against the dense eigenproblem of many standard elements, no DOF omitted."""
    rng = np.random.default_rng(100 + seed)
    spindle = stepped_rotor(rng, isotropic=False, damped=True)
    short = spindle.shaft.end / 120.0
    spin = 300.0
    poles = FullRotor(spindle, build_mesh(spindle, short), NO_SEATS, spin).poles(1e5)
    light = poles[np.abs(poles) < 1.05 * poles.imag]
    gaps = np.diff(light.imag[:9]) / light.imag[:8]
    place = 3 + int(gaps[3:8].argmax())
    highest = 0.5 * (light.imag[place] + light.imag[place + 1])
    result = answered(spindle, [spin], highest / HZ, element_length=short)
    swinging = result.damping_ratio[0] < 0.3
    bending = swinging & np.array([kind == "bending" for kind in result.kind])
    assert (result.frequency[0, bending] <= highest / HZ).sum() == place + 1


@pytest.mark.parametrize("highest", [4000.0, 9000.0])
def test_a_free_bar_by_closed_form(highest: float) -> None:
    """Axial n c/2L, torsional n ct/2L, and bending by the count of the exact shaft."""
    bar = uniform(
        1.0, 0.05, supports=[support("a", 0.2, (1e8, 1e8)), support("b", 0.8, (1e8, 1e8))]
    )
    result = answered(bar, [0.0, 500.0], highest)
    wave = np.sqrt([STEEL.young_modulus / STEEL.density, STEEL.shear_modulus / STEEL.density])
    expected = np.floor(2.0 * highest / wave).astype(int)
    for row, spin in enumerate((0.0, 500.0)):
        exact = exact_rotor(bar, spin, NO_SEATS)
        bending = sum(modes_below(exact, side * HZ * highest) for side in (-1, 1))
        found = [number(result, row, highest, kind) for kind in ("axial", "torsion", "bending")]
        assert found == [*expected, bending]
    assert not result.unconverged


def test_the_count_does_not_depend_on_the_frame() -> None:
    """The flagship: unsymmetric tangents, modal damping; softened modes are as many, and in the
    rotating frame there are those besides that it sees in the band."""
    speed = (np.array([0.0, 12000.0, 24000.0]) * RPM).tolist()
    inertial, turning, softened = (
        answered(mfw2310(), speed, 4000.0, formulation=name)
        for name in ("inertial", "rotating", "fixed-frame softening")
    )
    assert set(inertial.mode) <= set(turning.mode)
    more = [k for k, name in enumerate(turning.mode) if name not in inertial.mode]
    assert (turning.frequency[:, more].min(axis=0) <= 4000.0).all()
    assert len(softened.mode) == len(inertial.mode)


@pytest.mark.few(1)
@pytest.mark.parametrize("seed", [1, 4])
def test_reduced_poles_are_those_of_all_dof(seed: int) -> None:
    """Up to sixty sections on damped uneven supports, the same elements by one dense solve."""
    rng = np.random.default_rng(seed)
    spindle = stepped_rotor(rng, isotropic=False, damped=True, sections=60)
    still = dense_poles(spindle, 0.0, 10.0, 1e-3)
    highest = float(np.sort(still.imag[still.imag > 1e-3 * np.abs(still)])[7]) / HZ
    spin = rng.uniform(0.0, 2.0) * HZ * highest
    whole = dense_poles(spindle, spin, highest, 1e-5)
    whole = whole[(whole.imag > 0.1 * np.abs(whole)) & (whole.imag < 0.98 * HZ * highest)]
    result = answered(spindle, [spin], highest, accuracy=1e-5)
    ours = result.pole[0, [kind == "bending" for kind in result.kind]]
    assert len(whole) > 3
    apart = np.abs(whole[:, None] - ours).min(axis=1) / np.abs(whole)
    assert apart.max() < 1e-5
    near = ours[(ours.imag > 0.1 * np.abs(ours)) & (ours.imag < 0.98 * HZ * highest)]
    assert len(near) == len(whole)
