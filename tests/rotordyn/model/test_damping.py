"""Modal damping lands on the flexible modes, in order, the last ratio repeated."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotordyn.machine.damping import RayleighDamping
from rotordyn.model.damping import modal_damping
from tests.oracles.rotors import uniform

VALUES = np.array([0.0, 0.0, 1.0, 4.0, 9.0])
ROTOR = uniform(1.0, 0.05)


@pytest.mark.parametrize(
    ("given", "bending", "expected"),
    [
        ((), True, [0, 0, 0, 0, 0]),
        ((0.01,), True, [0, 0, 0.01, 0.01, 0.01]),
        ((0.01, 0.05), True, [0, 0, 0.01, 0.05, 0.05]),
        ((0.01, 0.02, 0.03, 0.04), True, [0, 0, 0.01, 0.02, 0.03]),
        ((0.01, 0.05), False, [0, 0, 0.05, 0.05, 0.05]),
    ],
)
def test_ratios(given: tuple[float, ...], bending: bool, expected: list[float]) -> None:
    """Axial motion and torsion have the last one."""
    found = modal_damping(replace(ROTOR, rotor_damping=given), VALUES, bending=bending)
    assert found == pytest.approx(2.0 * np.array(expected) * np.sqrt(VALUES))


def test_rayleigh_damping_is_that_of_mass_and_stiffness() -> None:
    rotor = replace(ROTOR, rayleigh=RayleighDamping(3.0, 0.5))
    assert modal_damping(rotor, VALUES, bending=True) == pytest.approx(3.0 + 0.5 * VALUES)
