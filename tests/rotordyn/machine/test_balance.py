"""Permissible residual unbalance and its shares."""

from __future__ import annotations

import math

import pytest

from rotordyn.machine.balance import permissible_unbalance, plane_shares


def test_grade_is_the_speed_of_the_centre_of_mass() -> None:
    """G 6.3 at 3000 rpm: e = 6300/314.16 = 20.05 µm."""
    unbalance = permissible_unbalance(6.3e-3, 40.0, 3000.0 * math.pi / 30.0)
    assert unbalance / 40.0 == pytest.approx(20.05e-6, rel=1e-3)


@pytest.mark.parametrize(
    ("centre", "shares"),
    [(0.5, (0.5, 0.5)), (0.4, (0.6, 0.4)), (0.1, (0.7, 0.3)), (0.99, (0.3, 0.7))],
)
def test_shares_by_levers(centre: float, shares: tuple[float, float]) -> None:
    assert plane_shares(centre, 0.0, 1.0) == pytest.approx(shares)
    assert plane_shares(centre, 1.0, 0.0) == pytest.approx(shares[::-1])
