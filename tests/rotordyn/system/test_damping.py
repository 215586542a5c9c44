"""Modal damping lands on the flexible modes, in order, the last ratio repeated."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.system.rotor_damping import damping_ratios

VALUES = np.array([0.0, 0.0, 1.0, 4.0, 9.0])


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ((), [0, 0, 0, 0, 0]),
        ((0.01,), [0, 0, 0.01, 0.01, 0.01]),
        ((0.01, 0.05), [0, 0, 0.01, 0.05, 0.05]),
        ((0.01, 0.02, 0.03, 0.04), [0, 0, 0.01, 0.02, 0.03]),
    ],
)
def test_ratios(given: tuple[float, ...], expected: list[float]) -> None:
    assert damping_ratios(VALUES, given).tolist() == expected


def test_only_rigid_motion() -> None:
    assert damping_ratios(np.zeros(2), (0.01,)).tolist() == [0.0, 0.0]
