"""Outer rings under the centrifugal force of their balls: both bodies' equations at once."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from bearings import AngularContactBallBearing
from bearings.materials import STEEL
from rotordyn.errors import InvalidInput
from rotordyn.machine.fits import Fits
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.growth import ring_growth
from tests.oracles.spindles import RPM

Array = NDArray[np.float64]
BORE, OUTSIDE = 0.070, 0.110
FITS = Fits(shaft="k5", housing="K6", bore_diameter=BORE, outside_diameter=OUTSIDE)
BEARING = AngularContactBallBearing(
    9.525e-3, 90e-3, 24, contact_angle=math.radians(25.0), ball_material=STEEL
)


def spindle(fits: Fits) -> Spindle:
    seat = BearingSeat("front", BEARING, 0.05, thrust=1, fits=fits)
    return Spindle("one", Shaft(0.0, (Section(0.1, BORE, 0.030, STEEL),)), seats=(seat,))


@pytest.mark.parametrize("housing", ["F6", "K6", "G6"])
def test_balls_expand_the_outer_ring(housing: str) -> None:
    """Free, pressed into its housing, and with play: by the equations of two bodies at once, with
    the pressure in the bore."""
    fits = replace(FITS, housing=housing, taken="most", width=0.020, under_balls=True)
    machine, omega = spindle(fits), 24000.0 * RPM
    race, outside = BEARING.outer_raceway_radius, OUTSIDE / 2
    plain = spindle(replace(fits, under_balls=False))
    with_balls, without = (
        float(ring_growth(each, each.seats[0], np.array([omega]))[0]) for each in (machine, plain)
    )
    gamma = 9.525 / 90.0 * math.cos(math.radians(25.0))
    mass = STEEL.density * math.pi / 6.0 * 9.525e-3**3
    force = 24 * 0.5 * mass * 90e-3 * omega**2 * (0.5 * (1.0 - gamma)) ** 2
    pressure = force / (2.0 * math.pi * race * 0.020)
    grown = [_bored(race, outside, 0.0825, fits.depth("outer"), p) for p in (pressure, 0.0)]
    assert without - with_balls == pytest.approx(grown[0] - grown[1], rel=1e-9)
    assert 0.3e-6 < grown[0] - grown[1] < 6e-6


def _bored(race: float, outside: float, around: float, depth: float, pressure: float) -> float:
    """Growth of the race of a steel ring under ``pressure`` in a steel housing that it overlaps by
    ``depth``, by A r + B/r in both bodies; alone where it does not reach it."""
    e, nu = STEEL.young_modulus, STEEL.poisson_ratio

    def stress(r: float) -> Array:
        return e / (1 - nu**2) * np.array([1 + nu, -(1 - nu) / r**2])

    alone = np.linalg.solve([stress(race), stress(outside)], [-pressure, 0.0])
    if alone @ [outside, 1 / outside] + depth <= 0.0:
        return float(alone @ [race, 1 / race])
    none = np.zeros(2)
    rows = [
        np.concatenate([stress(race), none]),
        np.concatenate([none, stress(around)]),
        np.concatenate([stress(outside), -stress(outside)]),
        np.concatenate([[-outside, -1 / outside], [outside, 1 / outside]]),
    ]
    scale = np.array([e, e, e, 1.0])
    columns = np.array([1.0, outside**2, 1.0, outside**2])
    right = np.array([-pressure, 0.0, 0.0, depth]) / scale
    found = columns * np.linalg.solve(np.array(rows) / scale[:, None] * columns, right)
    return float(found[:2] @ [race, 1 / race])


def test_how_wide_the_ring_is_and_what_holds_it_must_be_known() -> None:
    with pytest.raises(
        InvalidInput, match="width: missing key: the expansion of the outer ring by the balls"
    ):
        replace(FITS, under_balls=True)
    with pytest.raises(
        InvalidInput, match="housing: missing key: the expansion of the outer ring by the balls"
    ):
        replace(FITS, housing="", width=0.020, under_balls=True)
