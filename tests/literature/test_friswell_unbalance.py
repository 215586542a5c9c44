"""Friswell and others, Dynamics of Rotating Machines (2010), example 6.3.1: unbalance.

The book and its followers show these responses as curves only. The case file is held against a
dense solve of matrices that share nothing with the program, and against the critical speeds that
these matrices give.
"""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

import rotordyn
from tests.oracles.plain_rotor import PlainRotor
from tests.oracles.spindles import CASES

RPM = math.pi / 30.0
NU = 211.0 / 162.2 - 1.0  # E = 211 GPa, G = 81.1 GPa
HUTCHINSON = 6.0 * (1.0 + NU) ** 2 / (7.0 + 12.0 * NU + 4.0 * NU**2)
SOFT = {"even": 1e6, "uneven": 0.8e6}
VARIANTS = pytest.mark.parametrize("variant", SOFT)


def plain(variant: str) -> PlainRotor:
    ends = tuple((node, SOFT[variant], 1e6, 100.0, 100.0) for node in (0, 6))
    discs = ((2, *disc(0.28)), (4, *disc(0.35)))
    return PlainRotor(1.5, 0.05, 6, 211e9, 81.1e9, HUTCHINSON, 7810.0, discs, ends)


def disc(outer: float) -> tuple[float, float, float]:
    """Mass, polar and diametral inertia of a disc of 70 mm with a bore of 50 mm."""
    mass = 7810.0 * math.pi / 4.0 * (outer**2 - 0.05**2) * 0.07
    polar = mass * (outer**2 + 0.05**2) / 8.0
    return mass, polar, polar / 2.0 + mass * 0.07**2 / 12.0


@cache
def answers() -> dict:
    return rotordyn.run(rotordyn.load(CASES / "friswell_unbalance.yaml"))


@pytest.mark.few(1)
@VARIANTS
def test_response_is_that_of_a_dense_solve(variant: str) -> None:
    """Both discs, both directions, every speed, near resonance too."""
    found = answers()[f"{variant}/unbalance"]
    wanted = plain(variant).unbalanced(2, 1e-3, found.speed.values)[:, [2, 4]]
    assert found.point.values.tolist() == ["left_disc", "right_disc"]
    off, size = (np.abs(a).max(axis=(1, 2)) for a in (found.displacement.values - wanted, wanted))
    assert (off[1:] / size[1:]).max() < 1e-8


@VARIANTS
def test_largest_where_it_is_critical(variant: str) -> None:
    """Peaks within the 5 rpm of the speeds; only forward whirl where all directions are alike."""
    found = answers()[f"{variant}/unbalance"]
    critical = plain(variant).synchronous()
    inside = critical[critical < 3000.0 * RPM] / RPM
    assert len(inside) == 4
    excited = inside[1::2] if variant == "even" else inside
    assert found.critical_speed.values / RPM == pytest.approx(excited, rel=1e-4)
    size, rpm = found.major_axis.values[:, 0], found.speed.values / RPM
    top = np.flatnonzero((size[1:-1] > size[:-2]) & (size[1:-1] > size[2:])) + 1
    assert rpm[top] == pytest.approx(excited, abs=5.0)


def test_circles_on_even_bearings_that_lag_by_a_right_angle_at_the_first_critical() -> None:
    found = answers()["even/unbalance"]
    np.testing.assert_allclose(found.minor_axis, found.major_axis, rtol=1e-9)
    first = plain("even").synchronous()[1]
    phase = np.unwrap(found.phase.values[1:, 0, 0])
    lag = np.interp(first, found.speed.values[1:], phase)
    assert phase[0] == pytest.approx(0.0, abs=0.01)
    assert lag == pytest.approx(-math.pi / 2.0, abs=0.2)


def test_backward_between_the_first_two_criticals_of_uneven_bearings() -> None:
    found = answers()["uneven/unbalance"]
    low, high = plain("uneven").synchronous()[:2]
    minor, speed = found.minor_axis.values[:, 0], found.speed.values
    assert (minor[(speed > 1.005 * low) & (speed < 0.995 * high)] < 0.0).all()
    assert (minor[(speed > 0.0) & (speed < 0.99 * low)] > 0.0).all()
