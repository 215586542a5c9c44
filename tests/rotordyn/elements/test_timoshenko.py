"""The twelve freedoms: signs, and what is decoupled from what."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.oracles.dense_rotor.lumped import lumped_element
from rotordyn.model.dofs import DIRECTIONS, position
from tests.oracles.dense_rotor.timoshenko import shaft_element
from rotordyn.machine.lumped import PointMass

LENGTH, OUTER, INNER = 0.06, 0.08, 0.03
ELEMENT = shaft_element(*map(np.asarray, (LENGTH, OUTER, INNER, 2.1e11, 8e10, 7850.0, 0.7)))
RING = math.pi * (OUTER**2 - INNER**2) / 4
POLAR = math.pi * (OUTER**4 - INNER**4) / 32
GROUPS = {"x": "axial", "thx": "torsion", "y": "xy", "thz": "xy", "z": "xz", "thy": "xz"}


def row(node: int, freedom: str) -> int:
    return 6 * node + position(freedom)


def test_symmetry() -> None:
    for matrix in (ELEMENT.mass, ELEMENT.translational_mass, ELEMENT.stiffness):
        assert (matrix == matrix.T).all()
    assert (ELEMENT.gyroscopic == -ELEMENT.gyroscopic.T).all()


def test_four_motions_are_decoupled() -> None:
    names = [GROUPS[name] for name in DIRECTIONS * 2]
    apart = np.array([[a != b for b in names] for a in names])
    for matrix in (ELEMENT.mass, ELEMENT.translational_mass, ELEMENT.stiffness):
        assert not matrix[apart].any()
    between = np.array([[{a, b} == {"xy", "xz"} for b in names] for a in names])
    assert not ELEMENT.gyroscopic[~between].any()


def test_shearing_force_sign() -> None:
    """Lifting the right end by y turns the shaft towards +thz; by z towards −thy."""
    assert ELEMENT.stiffness[row(0, "thz"), row(1, "y")] < 0
    assert ELEMENT.stiffness[row(0, "thy"), row(1, "z")] > 0


def test_rods() -> None:
    k, m = ELEMENT.stiffness, ELEMENT.mass
    assert k[row(0, "x"), row(0, "x")] == pytest.approx(2.1e11 * RING / LENGTH)
    assert k[row(0, "thx"), row(1, "thx")] == pytest.approx(-8e10 * POLAR / LENGTH)
    assert m[row(0, "x"), row(1, "x")] == pytest.approx(7850 * RING * LENGTH / 6)
    assert m[row(1, "thx"), row(1, "thx")] == pytest.approx(7850 * POLAR * LENGTH / 3)


@pytest.mark.parametrize("rate", [(0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.3, -0.8)])
def test_gyroscopic_moment_is_the_rate_of_the_spin_momentum(rate: tuple[float, ...]) -> None:
    """Ip Ω d(axis)/dt, the axis turning with θ′: the moment that keeps it turning."""
    spin, polar = 700.0, 0.013
    body = lumped_element(PointMass("disc", 0.0, 5.0, polar, 0.008))
    velocity = np.concatenate([np.zeros(3), rate])
    moment = spin * body.gyroscopic @ velocity
    expected = polar * spin * np.cross(rate, [1.0, 0.0, 0.0])
    assert moment[3:] == pytest.approx(expected)
    assert not moment[:3].any()


def test_element_turns_like_the_rigid_body_it_fills() -> None:
    """Its gyroscopic matrix, for a rotation as a whole, is that of a lumped polar inertia."""
    vector = np.zeros((12, 2))
    for node, lever in ((0, -LENGTH / 2), (1, LENGTH / 2)):
        vector[row(node, "thy"), 0], vector[row(node, "z"), 0] = 1.0, -lever
        vector[row(node, "thz"), 1], vector[row(node, "y"), 1] = 1.0, lever
    polar = 7850 * POLAR * LENGTH
    body = lumped_element(PointMass("body", 0.0, 1.0, polar, polar))
    tilts = [position("thy"), position("thz")]
    found = vector.T @ ELEMENT.gyroscopic @ vector
    assert found == pytest.approx(body.gyroscopic[np.ix_(tilts, tilts)])


def test_lumped_mass() -> None:
    body = lumped_element(PointMass("disc", 0.3, 5.0, 0.013, 0.008))
    assert np.diag(body.mass).tolist() == [5.0, 5.0, 5.0, 0.013, 0.008, 0.008]
    assert np.diag(body.translational_mass).tolist() == [0.0, 5.0, 5.0, 0.0, 0.0, 0.0]
    assert np.count_nonzero(body.mass) == 6


def test_many_elements_at_once() -> None:
    lengths = np.array([0.01, LENGTH])
    many = shaft_element(lengths, *map(np.asarray, (OUTER, INNER, 2.1e11, 8e10, 7850.0, 0.7)))
    assert many.stiffness.shape == many.gyroscopic.shape == (2, 12, 12)
    assert many.stiffness[1] == pytest.approx(ELEMENT.stiffness)
    assert many.mass[1] == pytest.approx(ELEMENT.mass)
