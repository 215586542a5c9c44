"""What the approximation of a radial ring takes, and what it refuses."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from bearings import AngularContactBallBearing, InvalidBearing
from bearings.debongnie import (
    PowerLaw,
    RadialRing,
    approximate,
    deflection,
    distribution,
    equivalent_factors,
    load,
    peak,
    power_law,
    race_weights,
)

RING = RadialRing(2.5e-7, 2.0e-7, 9, 1.5e-3, 10e-3, 50e-3)
SPEED, LOAD = 4000.0, 800.0


def test_functions_broadcast() -> None:
    x, ratio = np.array([0.0, 0.1, 10.0])[:, None], np.array([0.5, 2.0])
    y = load(x, ratio)
    assert y.shape == (3, 2)
    assert deflection(y, ratio) == pytest.approx(np.broadcast_to(x, (3, 2)), rel=1e-14)
    law = power_law(ratio)
    assert np.isfinite(peak(np.array([[0.1], [1.0]]), law)).all()


def test_unloaded_balls_carry_nothing() -> None:
    assert load([-1.0, 0.0], 1.0).tolist() == [0.0, 0.0]
    assert PowerLaw(0.5, 1.4)([-1.0, 0.0]).tolist() == [0.0, 0.0]
    assert load(1e-300, 1.0) >= 0.0


def test_clearance_widens_the_displacement_and_narrows_the_zone() -> None:
    tight, loose = (approximate(replace(RING, clearance=c), LOAD, SPEED) for c in (-2e-6, 1e-5))
    plain = approximate(RING, LOAD, SPEED)
    assert tight.displacement < plain.displacement < loose.displacement
    assert tight.zone > plain.zone > loose.zone
    assert tight.inner_peak < plain.inner_peak < loose.inner_peak


def test_original_differs_by_its_slips() -> None:
    corrected, original = (approximate(RING, LOAD, SPEED, v) for v in ("corrected", "original"))
    orbit = 1.0 - RING.size_ratio
    ratio = corrected.centrifugal_force / original.centrifugal_force
    assert ratio == pytest.approx(orbit**2 * RING.pitch_diameter / RING.ball_diameter)
    assert original.displacement > 100.0 * corrected.displacement  # not even a length


def test_a_bearing_is_its_ring() -> None:
    bearing = AngularContactBallBearing(
        ball_diameter=10e-3, pitch_diameter=50e-3, balls=9, contact_angle=0.0
    )
    assert approximate(bearing, LOAD, SPEED) == approximate(RadialRing.of(bearing), LOAD, SPEED)
    assert RadialRing.of(bearing).clearance == 0.0
    loose = replace(bearing.grooves, radial_gap=bearing.grooves.radial_gap - 5e-6, touching=False)
    assert RadialRing.of(SimpleNamespace(grooves=loose)).clearance == pytest.approx(1e-5)  # type: ignore[arg-type]
    with pytest.raises(InvalidBearing, match="contact angle of 0"):
        approximate(replace(bearing, contact_angle=0.3), LOAD, SPEED)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"balls": 0}, "balls must lie from 3"),
        ({"inner_compliance": float("nan")}, "inner_compliance must be"),
        ({"outer_conformity": 0.5}, "outer_conformity must lie above 0.5"),
        ({"pitch_diameter": 5e-3}, "below pitch_diameter"),
        ({"clearance": float("inf")}, "clearance must be a finite number"),
        ({"ball_mass": 1e60}, "ball_mass must lie from"),
    ],
)
def test_impossible_rings(change: dict[str, Any], message: str) -> None:
    with pytest.raises(InvalidBearing, match=message):
        replace(RING, **change)


def test_loads_and_speeds_out_of_reach() -> None:
    for force, speed, message in (
        (0.0, SPEED, "load must be"),
        (LOAD, 0.0, "speed must be"),
        (LOAD, float("nan"), "speed must be"),
        (LOAD, 10.0, "solve the full ring"),
        (1e-6, SPEED, "solve the full ring"),
    ):
        with pytest.raises(InvalidBearing, match=message):
            approximate(RING, force, speed)
    with pytest.raises(InvalidBearing, match="compresses every ball"):
        approximate(replace(RING, clearance=-1e-3), LOAD, SPEED)
    with pytest.raises(InvalidBearing, match="no clearance"):
        approximate(replace(RING, clearance=1e-6), LOAD, SPEED, "original")
    with pytest.raises(InvalidBearing, match="corrected, original"):
        approximate(RING, LOAD, SPEED, "new")


@pytest.mark.parametrize(
    "value", ["a", None, True, np.array([1.0, 2.0]), 0.0, -1.0, np.nan, 10**400]
)
@pytest.mark.parametrize("place", ["load", "speed"])
def test_what_is_no_load_or_speed_is_refused(place: str, value: Any) -> None:
    asked: dict[str, Any] = {"load": LOAD, "speed": SPEED, place: value}
    with pytest.raises(InvalidBearing, match=f"{place} must be a finite number above zero"):
        approximate(RING, **asked)


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: approximate(RING, LOAD, 1e-200), "speed 1e-200 rad/s must lie from"),
        (lambda: approximate(RING, LOAD, 1e200), "speed 1e.200 rad/s must lie from"),
        (lambda: approximate(cast(Any, None), LOAD, SPEED), "ring must be a RadialRing or a"),
        (lambda: replace(RING, balls=cast(Any, 9.5)), "balls must be a whole number"),
        (lambda: replace(RING, ball_mass=cast(Any, "a")), "ball_mass must be a finite number"),
        (lambda: replace(RING, clearance=cast(Any, "a")), "clearance must be a finite number"),
        (lambda: race_weights(1.2), "size_ratio must lie above 0 and below 1"),
        (lambda: race_weights(0.2, 0.5, 0.5), "inner must lie above 0.5"),
        (lambda: equivalent_factors(-5.0), "exponent must be a finite number above zero"),
        (lambda: load([1.0], 0.0), "ratio must be finite numbers above zero"),
        (lambda: load([np.nan], 1.0), "x must be finite numbers"),
        (lambda: deflection(-1.0, 1.0), "y must be finite numbers from 0 up"),
        (lambda: power_law(-1.0), "ratio must be finite numbers above zero"),
        (lambda: distribution(-1.0, power_law(1.0)), "peak must be finite numbers above zero"),
        (lambda: distribution(1.0, power_law(1.0), 0.0), "gap must be a finite number above zero"),
    ],
)
def test_what_makes_no_sense_is_refused(call: Callable[[], object], sentence: str) -> None:
    with pytest.raises(InvalidBearing, match=sentence):
        call()
