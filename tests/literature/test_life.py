"""Ratings, lives and frequencies of catalogues, data sheets and a commercial code."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from bearings import (
    SILICON_NITRIDE,
    STEEL,
    AngularContactBallBearing,
    DeepGrooveBallBearing,
    life,
)
from bearings.life.rating import geometry_factor
from tests.oracles.known_bearings import DEGREE, ISO_STEEL, RPM, VEX70

GMN_S6014C = AngularContactBallBearing(
    11.906e-3, 90e-3, 21, contact_angle=15 * DEGREE, ball_material=STEEL
)
MASTA = DeepGrooveBallBearing(
    11.5e-3,
    43.5e-3,
    7,
    inner_conformity=0.52,
    outer_conformity=0.53,
    ball_material=ISO_STEEL,
    ring_material=ISO_STEEL,
    radial_clearance=0.0,
)


def test_static_rating_of_hybrids() -> None:
    """GMN prints 0.70 times the C0 of steel balls."""
    hybrid = replace(GMN_S6014C, ball_material=SILICON_NITRIDE)
    ratio = life.static_rating(hybrid) / life.static_rating(GMN_S6014C)
    assert ratio == pytest.approx(0.70, rel=0.01)
    assert life.dynamic_rating(hybrid) == life.dynamic_rating(GMN_S6014C)


@pytest.mark.parametrize(("fine", "factor"), [(0.01, 29.1), (0.10, 55.5), (0.20, 59.9)])
def test_table_of_iso_281(fine: float, factor: float) -> None:
    """Rows of its fc, remembered: the formula with both grooves of 0.52."""
    pitch = 100e-3
    b = DeepGrooveBallBearing(fine * pitch, pitch, 5, radial_clearance=0.0)
    assert geometry_factor(b) == pytest.approx(factor, rel=0.005)


def test_factor_of_thrust_bearings_in_iso_281() -> None:
    """fc 36.7 at D/dm 0.01, remembered: the formula with both grooves of 0.535."""
    from bearings import ThrustBallBearing

    b = ThrustBallBearing(1e-3, 100e-3, 20, inner_conformity=0.535, outer_conformity=0.535)
    assert geometry_factor(b) == pytest.approx(36.7, rel=0.005)


@pytest.mark.parametrize(
    ("rpm", "millions", "race"),
    [(0, 79_320, "i"), (10_000, 98_700, "i"), (20_000, 64_700, "o"), (30_000, 13_260, "o")],
)
def test_reference_life_at_speed(rpm: float, millions: float, race: str) -> None:
    """An independent code's: thrust keeps its balls off the inner race before Qo governs."""
    found = life.life_of(VEX70.equilibrium(load=[610, 0, 0, 0, 0], speed=rpm * RPM), 23_000.0)
    assert found.revolutions == pytest.approx(1e6 * millions, rel=1e-3)
    assert found.limiting == race


@pytest.mark.parametrize(("degrees", "share"), [(25, 0.884), (40, 0.516)])
def test_reference_load_of_pure_thrust_is_not_that_of_iso_281(degrees: float, share: float) -> None:
    """An independent code's Pref/Fa at the nominal angle; Y is 0.87 and 0.57."""
    b = replace(VEX70, contact_angle=degrees * DEGREE, inner_conformity=0.52, outer_conformity=0.52)
    found = life.life_of(b.equilibrium(load=[1e-2, 0, 0, 0, 0]))
    assert found.equivalent_load / 1e-2 == pytest.approx(share, rel=0.015)


def test_reference_load_of_half_the_balls() -> None:
    """An independent code's Pref/Fr of 1.03 at 25° with half the balls loaded."""
    b = replace(VEX70, inner_conformity=0.52, outer_conformity=0.52, balls=100, ball_diameter=2e-3)
    radial = 1000.0
    tilts = [np.nan, np.nan]
    s = b.equilibrium(
        load=[np.nan, radial, 0.0, *tilts], displacement=[0.0, np.nan, np.nan, 0.0, 0.0]
    )
    assert 0.45 < float((s.inner_load > 0.0).mean()) < 0.55
    assert life.life_of(s).equivalent_load / radial == pytest.approx(1.03, rel=0.015)


@pytest.mark.parametrize(
    ("ball", "pitch", "known"),
    [
        (7.94e-3, 39.04e-3, (0.39828, 3.5848, 5.4152, 4.7135 / 2)),
        (7.9375e-3, 38.5e-3, (0.3969, 3.572, 5.428, 2.32)),
    ],
    ids=["6205 (CWRU)", "ER-16K (Curtin)"],
)
def test_frequencies_of_data_sheets(ball: float, pitch: float, known: tuple[float, ...]) -> None:
    b = DeepGrooveBallBearing(ball, pitch, 9, radial_clearance=0.0)
    state = b.equilibrium(load=[0, 100, 0, 0, 0], speed=10.0)
    for found in (life.nominal_frequencies(b), life.frequencies(state)):
        assert found[:4] == pytest.approx(known, rel=1e-3)


def test_equivalent_load_of_a_catalogue() -> None:
    """ISO 281 at 25°: e 0.68, X 0.41, Y 0.87; at 15° Y from 1.47 to 1.00 over i Fa/C0."""
    found = life.dynamic_load([1000, 1000, 0], [600, 800, 500], 25 * DEGREE)
    assert found == pytest.approx([1000, 410 + 0.87 * 800, 435])
    light, heavy = life.dynamic_load(100.0, 1000.0, 15 * DEGREE, [0.0, 0.58])
    assert (light, heavy) == pytest.approx((44 + 1470, 44 + 1000))
    assert life.equivalent_static(1000, 5000, 25 * DEGREE) == pytest.approx(500 + 1900)
    assert math.isclose(life.pair_rating(23_000, 2), 2**0.7 * 23_000)
