"""A thrust ball bearing: contacts along the axis, closed forms, balls thrown out at speed."""

from __future__ import annotations

import math

import numpy as np
import pytest

import bearings
from bearings import InvalidBearing, ThrustBallBearing
from bearings.geometry import geometry

BEARING = ThrustBallBearing(ball_diameter=10.3e-3, pitch_diameter=64e-3, balls=16)
THRUST = np.array([5000.0, 0.0, 0.0, 0.0, 0.0])


def test_thrust_at_rest_is_hertz_on_every_ball() -> None:
    s = BEARING.equilibrium(load=THRUST)
    k = geometry(BEARING.grooves).series_stiffness
    share = 5000.0 / 16
    assert s.displacement[0] == pytest.approx((share / k) ** (2.0 / 3.0), rel=1e-9)
    assert s.contact_load == pytest.approx(share)
    assert s.contact_angle == pytest.approx(math.pi / 2.0)
    assert s.stiffness()[0, 0] == pytest.approx(1.5 * 5000.0 / s.displacement[0], rel=1e-9)


def test_tilting_stiffness_is_that_of_a_ring_of_springs() -> None:
    """Axial springs c on a circle of radius dm/2 give z c (dm/2)²/2 against tilt."""
    k = BEARING.equilibrium(load=THRUST).stiffness()
    assert k[3, 3] == pytest.approx(0.5 * k[0, 0] * 0.032**2, rel=1e-9)
    assert k[3, 3] == pytest.approx(k[4, 4])


def test_balls_are_thrown_out_between_the_grooves() -> None:
    """Fc tilts both contact lines: Qo cos αo − Qi cos αi = Fc, α from the radial direction."""
    s = BEARING.equilibrium(load=THRUST, speed=600.0, kinematics="outer", dynamics="frozen")
    force = s.outer_load * np.cos(s.outer_angle) - s.inner_load * np.cos(s.inner_angle)
    assert force == pytest.approx(s.centrifugal_force, rel=1e-9)
    assert (s.outer_angle < math.pi / 2.0).all()
    assert (s.inner_angle > math.pi / 2.0).all()


@pytest.mark.parametrize("kinematics", ["hybrid", "outer", "inner", "geometric"])
def test_tangent_at_speed(kinematics: str) -> None:
    load = THRUST + np.array([0.0, 0.0, 0.0, 20.0, -10.0])
    s = BEARING.equilibrium(load=load, speed=500.0, kinematics=kinematics)
    difference = bearings.stiffness(s, "difference")
    assert np.abs(difference - s.stiffness()).max() < 1e-6 * np.abs(difference).max()


@pytest.mark.parametrize(
    ("load", "sentence"),
    [
        ([5000.0, 10.0, 0.0, 0.0, 0.0], "carries no radial load: got 10 N.*displacement"),
        ([-5.0, 0.0, 0.0, 0.0, 0.0], r"thrust towards \+x only: got -5 N"),
    ],
)
def test_loads_it_cannot_carry(load: list[float], sentence: str) -> None:
    with pytest.raises(InvalidBearing, match=sentence):
        BEARING.equilibrium(load=load)
