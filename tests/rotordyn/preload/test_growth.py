"""Radial growth of the groove centres at speed."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from bearings.fit.compound import Cylinder, compound
from rotordyn.machine.growth import InterferenceFit, QuadraticInSpeed, RingGrowth
from rotordyn.preload.growth import ring_growth
from tests.oracles.spindles import TOP, mfw2310

SPEED = np.array([0.0, 0.3, 1.0]) * TOP


def grown(rule: QuadraticInSpeed | InterferenceFit | None, static: float = 5e-6) -> np.ndarray:
    fitted = isinstance(rule, InterferenceFit)
    growth = RingGrowth(static, "computed", rule) if fitted else RingGrowth(static, rule)
    seat = replace(mfw2310().seats[0], growth=growth)
    return ring_growth(mfw2310(), seat, SPEED)


def test_static_only() -> None:
    assert grown(None) == pytest.approx([5e-6] * 3)


def test_prescribed_adds_to_the_static_part() -> None:
    expected = 5e-6 + 7.3e-6 * (SPEED / TOP) ** 2
    assert grown(QuadraticInSpeed(7.3e-6, TOP)) == pytest.approx(expected)


def test_computed_is_what_the_rings_give() -> None:
    """Shaft 40/70 mm and a ring to the raceway contact at (dm − D cos α)/2, pressed 5 µm."""
    bearing, section = mfw2310().seats[0].bearing, mfw2310().shaft.section_at(0.0286)
    race = (0.090 - 9.525e-3 * math.cos(math.radians(25))) / 2
    bodies = (
        Cylinder(0.020, 0.035, section.material),
        Cylinder(0.035, race, bearing.ring_material),
    )
    states = [compound(bodies, [5e-6], w).radial_growth(race) for w in SPEED]
    expected = 5e-6 + np.array(states) - states[0]
    assert grown(InterferenceFit(0.070, 5e-6)) == pytest.approx(expected, rel=1e-9)


def test_interference_does_not_matter_while_the_fit_holds() -> None:
    loose, tight = (grown(InterferenceFit(0.070, s)) for s in (20e-6, 40e-6))
    assert loose == pytest.approx(tight, rel=1e-9)


def test_ring_grows_more_once_the_fit_has_let_go() -> None:
    held, free = (grown(InterferenceFit(0.070, s))[2] for s in (40e-6, 0.0))
    assert free > 1.05 * held
