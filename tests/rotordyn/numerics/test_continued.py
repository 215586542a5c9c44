"""Which mode each becomes: first order of the poles in closed form, whatever the unit of time."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.numerics.continued import _expected, continued
from rotordyn.numerics.modes import Modes, modes


def by_hand(pole: list[float], turned: float, scale: float) -> Modes:
    """Two of one system by hand: poles on the imaginary axis, vectors turned by an angle [deg]."""
    angle = np.radians(turned)
    vector = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]) + 0j
    zero = np.zeros((1, 2, 2))
    poles = 1j * scale * np.array([pole])
    return Modes(zero, zero, poles, vector[None], vector[None].conj(), np.ones(1))


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize(("second", "column"), [(1.2, [0, 1]), (1.02, [1, 0])])
def test_nearness_weighs_as_a_share_of_the_pole(
    scale: float, second: float, column: list[int]
) -> None:
    """MAC of 0.413 and 0.587 speak for an exchange, by 0.348 in all; it moves the poles by a share
    of 0.2/2.2 or 0.02/2.02 each, which counts eight times."""
    before, after = (by_hand([1.0, second], turned, scale) for turned in (0.0, 50.0))
    assert continued(before, after, [0])[0].tolist() == column


@pytest.mark.parametrize("unit", [1e-6, 1.0, 1e8])
def test_poles_are_expected_where_stiffness_moves_them(unit: float) -> None:
    """ω becomes ω + Δk/(2ω) for a unit mass."""
    stiffness, added = unit * np.array([1.0, 4.0]), unit * np.array([0.1, -0.2])
    before, after = (
        modes(np.diag(k)[None], np.zeros((1, 2, 2))) for k in (stiffness, stiffness + added)
    )
    whole = np.sort(_expected(before, after)[0].imag)[2:]
    assert whole == pytest.approx(np.sqrt(stiffness) + added / (2.0 * np.sqrt(stiffness)), rel=1e-9)
