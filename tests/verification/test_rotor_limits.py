"""Slender and stubby limits against theories that know no element."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rotordyn.equation.mesh import build_mesh
from tests.oracles.dense_rotor.assemble import axial_rod, bending_plane, torsion_rod
from tests.oracles.rotors import STEEL, uniform
from tests.oracles.whirl import frequencies_at_rest

FREE_FREE = np.array([4.730040744862704, 7.853204624095838, 10.995607838001671])


def free_bending(length: float, diameter: float, elements: int) -> np.ndarray:
    spindle = uniform(length, diameter)
    plane = bending_plane(spindle, build_mesh(spindle, length / elements))
    return frequencies_at_rest(plane.mass, plane.stiffness)


def tip_compliance(length: float, diameter: float, elements: int) -> float:
    """Deflection of a cantilever's tip under a unit force."""
    spindle = uniform(length, diameter)
    plane = bending_plane(spindle, build_mesh(spindle, length / elements))
    force = np.zeros(len(plane.mass) - 2)
    force[-2] = 1.0
    return float(np.linalg.solve(plane.stiffness[2:, 2:], force)[-2])


@pytest.mark.parametrize("ratio", [0.05, 1.0, 30.0, 3e3])
@pytest.mark.parametrize("elements", [1, 7])
def test_no_shear_locking(ratio: float, elements: int) -> None:
    """Static deflections are exact for any number of elements: L³/3EI + L/κGA."""
    length, diameter, kappa = 0.4, 0.4 / ratio, 6 * 1.3 / (7 + 6 * 0.3)
    area, moment = math.pi * diameter**2 / 4, math.pi * diameter**4 / 64
    expected = length**3 / (3 * STEEL.young_modulus * moment)
    expected += length / (kappa * STEEL.shear_modulus * area)
    assert tip_compliance(length, diameter, elements) == pytest.approx(expected, rel=1e-8)


def test_slender_is_euler_bernoulli() -> None:
    length, diameter = 10.0, 1e-3
    found = free_bending(length, diameter, 40)[2:5]
    wave_speed = math.sqrt(STEEL.young_modulus / STEEL.density)
    expected = (FREE_FREE / length) ** 2 * wave_speed * diameter / 4
    assert found == pytest.approx(expected, rel=4e-5)


def test_stubby_is_a_shear_beam() -> None:
    """A disc thinner than wide keeps its sections parallel: free ends, shear waves across it."""
    length, diameter, kappa = 0.01, 1.0, 6 * 1.3 / (7 + 6 * 0.3)
    found = free_bending(length, diameter, 64)[2:]
    expected = math.pi / length * math.sqrt(kappa * STEEL.shear_modulus / STEEL.density)
    assert np.abs(found / expected - 1).min() < 1e-3


@pytest.mark.parametrize("elements", [16, 32])
def test_rods(elements: int) -> None:
    """Free-free: ω = n π c/L, with the error (k h)²/24 of linear elements, from above."""
    spindle = uniform(0.8, 0.05, inner=0.02)
    mesh = build_mesh(spindle, 0.8 / elements)
    order = np.arange(1, 4)
    moduli = {axial_rod: STEEL.young_modulus, torsion_rod: STEEL.shear_modulus}
    for assembled, modulus in moduli.items():
        rod = assembled(spindle, mesh)
        found = frequencies_at_rest(rod.mass, rod.stiffness)[1:4]
        exact = order * math.pi / 0.8 * math.sqrt(modulus / STEEL.density)
        predicted = (order * math.pi / elements) ** 2 / 24
        assert found / exact - 1 == pytest.approx(predicted, rel=0.03)
