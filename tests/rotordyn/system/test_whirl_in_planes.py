"""Whirl seen in the planes: against one real system of both, and what couples these."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rotordyn.analysis.frf import answer
from rotordyn.analysis.scene import Scene
from rotordyn.analysis.specs import Conditions, FrfSpec
from rotordyn.system.whirl_in_planes import (
    FORWARD,
    planes_of,
    receptance_in_planes,
)
from tests.oracles.rotors import STEPPED, support
from tests.oracles.spindles import RPM, pairs

OMEGA = np.array([0.4, 1.3, 7.0])
EVEN = (support("front", 0.0, (8e7, 8e7), 300.0), support("rear", 0.2, (6e7, 6e7), 200.0))
SKEW = tuple(replace(s, stiffness={**s.stiffness, ("y", "z"): 5e6, ("z", "y"): -5e6}) for s in EVEN)
ROTOR = replace(STEPPED, points={"tip": -0.05, "mid": 0.11})


def test_there_and_back() -> None:
    rng = np.random.default_rng(1)
    y, z = rng.standard_normal((2, 4, 3)) + 1j * rng.standard_normal((2, 4, 3))
    np.testing.assert_allclose(planes_of(y + 1j * z, y - 1j * z), (y, z), rtol=1e-14)


def test_forward_whirl_alone() -> None:
    y, z = FORWARD
    assert y - 1j * z == 0.0
    np.testing.assert_array_equal(planes_of(y + 1j * z, 0.0), FORWARD)


def test_receptances_are_those_of_both_planes_in_one_matrix() -> None:
    """q̈ + (d − ig) q̇ + (k + ih) q = f on y + iz is real on (y, z)."""
    d, g, k, h = 0.3, 0.8, 2.0, 0.4
    both = np.concatenate([OMEGA, -OMEGA])
    whirl = 1.0 / (k + 1j * h + 1j * both * (d - 1j * g) - both**2)
    turns = np.array([0, 1, -1])
    found = receptance_in_planes(np.stack([whirl] * 3), turns, np.array(False))
    real = [
        [[k, -h], [h, k]] + 1j * w * np.array([[d, g], [-g, d]]) - w**2 * np.eye(2) for w in OMEGA
    ]
    inverse = np.linalg.inv(real)
    expected = [inverse[:, 1, 1], inverse[:, 1, 0], inverse[:, 0, 1]]
    np.testing.assert_allclose(found, expected, rtol=1e-13)


def test_planes_apart_answer_each_other_with_nothing() -> None:
    """Not even rounding, at rest on supports that do not couple them; else they do answer."""
    for supports, rpm, apart in ((EVEN, 0.0, True), (EVEN, 3000.0, False), (SKEW, 0.0, False)):
        spindle = replace(ROTOR, supports=supports)
        scene = Scene(spindle, Conditions(), np.array([rpm * RPM]), 1000.0, (-0.05, 0.11))
        spec = FrfSpec((100.0, 900.0), pairs("tip.z/tip.y", "mid.y/tip.z"))
        found = answer(scene, spec)
        assert (found.receptance == 0.0).all() == apart
        assert (found.receptance != 0.0).all() != apart
        assert not (apart and found.error.any())
