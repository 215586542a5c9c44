"""Race control and the motion in the contacts against the motion of rigid bodies in space."""

from __future__ import annotations

from itertools import groupby

import numpy as np
import pytest
from hypothesis import given, settings

from bearings import AngularContactBallBearing
from bearings.ring.motion import contact_motion
from tests.oracles import known_grooves
from tests.oracles.ball_bearing import BallBearingOracle, rolling
from tests.oracles.known_bearings import HARRIS_218, HYPOTHESES, RPM, VEX70
from tests.oracles.random_bearings import solved
from tests.oracles.rigid_balls import AXIS, RigidBalls

FAST = {VEX70: 30000.0 * RPM, HARRIS_218: 10000.0 * RPM}


def thrust(bearing: AngularContactBallBearing, force: float, kinematics: str) -> RigidBalls:
    state = bearing.equilibrium(
        load=[force, 0, 0, 0, 0], speed=FAST[bearing], kinematics=kinematics
    )
    return RigidBalls(BallBearingOracle(bearing, kinematics=kinematics), state)


@settings(max_examples=150)
@given(balls=solved())
def test_spin_to_roll_is_that_of_the_rigid_bodies(balls: RigidBalls) -> None:
    """Ball and race touch without slip; the rotation between them is split by the contact line."""
    s, held = balls.state, balls.state.inner_load > 0.0
    orbit, turning = balls.motion()
    centre = balls.oracle.bearing.pitch_diameter / 2.0 * balls.radial
    for angle, side, race, found in (
        (s.inner_angle, -1.0, AXIS, s.inner_spin_to_roll),
        (s.outer_angle, 1.0, 0.0 * AXIS, s.outer_spin_to_roll),
    ):
        line, slide = balls.line(angle), balls.slide(angle)
        touch = side * balls.oracle.d / 2.0 * line
        ball_speed = orbit[:, None] * np.cross(AXIS, centre) + np.cross(turning, touch)
        race_speed = np.cross(race, centre + touch)
        assert np.abs(ball_speed - race_speed)[held].max(initial=0.0) < 1e-15
        between = turning - race
        ratio = (between * line).sum(axis=1) / (between * slide).sum(axis=1)
        assert np.abs(found - ratio)[held].max(initial=0.0) < 1e-12
        assert (found[~held] == 0.0).all()


@settings(max_examples=100)
@given(balls=solved())
def test_the_controlling_race_of_the_hypothesis_sees_no_spin(balls: RigidBalls) -> None:
    s = balls.state
    ratio = {"inner": s.inner_spin_to_roll, "outer": s.outer_spin_to_roll}
    if s.operation.law.kinematics in ratio:
        assert np.abs(ratio[s.operation.law.kinematics]).max() < 1e-14
    if s.operation.law.kinematics == "geometric":
        sizes = np.abs(s.inner_spin_to_roll), np.abs(s.outer_spin_to_roll)
        assert sizes[0] == pytest.approx(sizes[1], abs=1e-14)


@pytest.mark.parametrize("bearing", [VEX70, HARRIS_218])
def test_geometric_hypothesis_spins_alike_on_both_races(bearing: AngularContactBallBearing) -> None:
    """Noël (2013) 2.17: tan δ [1 + γ sin m / sin δ], δ and m half difference and mean of angles.

    Exact as a quotient; with a product of the two sines, as it may be read, it is 10 % off.
    """
    s = thrust(bearing, 2000.0 if bearing is VEX70 else 17800.0, "geometric").state
    half, mean = (s.inner_angle - s.outer_angle) / 2, (s.inner_angle + s.outer_angle) / 2
    gamma = bearing.ball_diameter / bearing.pitch_diameter
    quotient = np.tan(half) * (1.0 + gamma * np.sin(mean) / np.sin(half))
    product = np.tan(half) * (1.0 + gamma * np.sin(mean) * np.sin(half))
    assert s.inner_spin_to_roll == pytest.approx(quotient, rel=1e-12)
    assert s.outer_spin_to_roll == pytest.approx(-quotient, rel=1e-12)
    assert (np.abs(product / quotient - 1.0) > 0.1).all()


@settings(max_examples=150)
@given(balls=solved())
def test_control_after_jones(balls: RigidBalls) -> None:
    """The stronger friction moment Q a E, reduced by the cosine between the contact lines."""
    s, o = balls.state, balls.oracle
    moments = [
        load ** (4 / 3) * race.a1 * race.e
        for load, race in ((s.inner_load, o.inner), (s.outer_load, o.outer))
    ]
    turned = np.cos(s.inner_angle - s.outer_angle)
    for ball, word in enumerate(s.control):
        inner, outer = moments[0][ball], moments[1][ball]
        if inner == 0.0:
            assert word == ""
            continue
        margins = inner * turned[ball] / outer - 1.0, outer * turned[ball] / inner - 1.0
        if min(map(abs, margins)) > 1e-9:
            expected = "inner" if margins[0] > 0 else "outer" if margins[1] > 0 else "neither"
            assert word == expected
    named = s.operation.law.kinematics in ("inner", "outer")
    wrong = (s.control != "") & (s.control != s.operation.law.kinematics)
    assert (s.control_agrees == ~(wrong & named)).all()


def test_control_goes_from_inner_at_rest_to_outer_at_speed() -> None:
    """A groove tighter inside than outside grips better; speed then loads the outer race.

    Between lies a band in which neither race controls (Noël's Fig. 2.8 calls both valid there).
    """
    bearing = AngularContactBallBearing(
        9.525e-3, 90e-3, 25, contact_angle=0.4363, inner_conformity=0.52, outer_conformity=0.56
    )
    speed = np.linspace(0.0, 30000.0, 61) * RPM
    s = bearing.equilibrium(load=[1000.0, 0, 0, 0, 0], speed=speed)
    words = [word for word, _ in groupby(s.control[:, 0].tolist())]
    assert words == ["inner", "neither", "outer"]


@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_at_rest_the_ratio_is_the_limit_of_slow_rotation(kinematics: str) -> None:
    load = [1000.0, 200.0, 0.0, 0.0, 0.0]
    rest, slow = (VEX70.equilibrium(load=load, speed=v, kinematics=kinematics) for v in (0.0, 2.0))
    assert rest.inner_spin_to_roll == pytest.approx(slow.inner_spin_to_roll, abs=1e-5)
    assert rest.outer_spin_to_roll == pytest.approx(slow.outer_spin_to_roll, abs=1e-5)


def test_missing_states_stay_missing() -> None:
    load = [[1000.0, 0, 0, 0, 0], [0.0, 0, 0, 0, 0]]
    state = VEX70.equilibrium(load=load, speed=1000.0, kinematics="outer")
    assert np.isnan(state.inner_spin_to_roll[1]).all()
    assert np.isnan(state.outer_spin_to_roll[1]).all()
    assert (state.control[1] == "").all()
    assert np.isfinite(state.inner_spin_to_roll[0]).all()


def test_control_has_a_meaning_with_one_loaded_contact_a_race_alone() -> None:
    """Balls that sit on both outer arcs, or touch in three points, are controlled by none."""
    bearing = known_grooves.four_point(known_grooves.R20_10)
    s = bearing.equilibrium(load=[2e3, 9e3, 0.0, 0.0, 0.0], speed=600.0, kinematics="inner")
    in_the_arch = (s.inner_load == 0.0) & (s.contacts == 2)
    assert in_the_arch.any()
    assert (s.contacts > 2).any()
    plain = (s.inner_load > 0.0) & (s.contacts == 2)
    assert ((s.control != "") == plain).all()
    assert s.control_agrees[~plain].all()


ARCS = np.array([1.0, -1.0, -1.0, 1.0])  # inner right and left, outer right and left


@pytest.mark.parametrize("way", [1.0, -1.0])
@pytest.mark.parametrize(
    ("load", "rpm", "kinematics", "counts"),
    [
        ([5e3, 0, 0, 0, 0], 1000.0, "outer", {2}),
        ([5e3, 0, 0, 0, 0], 6000.0, "outer", {3}),
        ([5e3, 6e3, 2e3, 50.0, -30.0], 3000.0, "outer", {2, 3, 4}),
        ([5e3, 6e3, 2e3, 0, 0], 8000.0, "inner", {3, 4}),
    ],
    ids=["two contacts", "three", "all", "balls that move back at some"],
)
def test_arcs_of_a_groove_move_as_rigid_bodies(
    load: list[float], rpm: float, kinematics: str, counts: set[int], way: float
) -> None:
    """Roll, spin, slide and entrainment of every contact of a four-point bearing, of the race
    against the ball: velocities of both at the place where they touch, on the side of its arc."""
    bearing = known_grooves.four_point(known_grooves.QJ218)
    s = bearing.equilibrium(load=way * np.array(load), speed=rpm * RPM, kinematics=kinematics)
    assert counts == {*s.contacts[s.inner_load > 0.0]}
    size = bearing.ball_diameter / bearing.pitch_diameter
    orbit, spin, beta = rolling(s.inner_angle, s.outer_angle, size, None, kinematics)
    motion, onward = contact_motion(s), np.array([0.0, 0.0, 1.0])
    for ball, contact in np.argwhere((s.contact_load > 0.0) & (s.inner_load > 0.0)[:, None]):
        angle, inner = ARCS[contact] * s.contact_angle[ball, contact], contact < 2
        normal = np.array([np.sin(angle), np.cos(angle), 0.0])
        along = np.array([np.cos(angle), -np.sin(angle), 0.0])
        touch = (-0.5 if inner else 0.5) * bearing.ball_diameter * normal
        place = np.array([0.0, 0.5 * bearing.pitch_diameter, 0.0]) + touch
        tilt = beta[ball]
        rolls = spin[ball] * np.array([-np.cos(tilt), np.sin(tilt), 0.0])  # seen from the cage
        turns = (float(inner) - orbit[ball]) * AXIS
        surfaces = np.cross(rolls, touch) @ onward, np.cross(turns, place) @ onward
        known = (
            (turns - rolls) @ along,
            (turns - rolls) @ normal,
            surfaces[1] - surfaces[0],
            0.5 * abs(surfaces[0] + surfaces[1]),
        )
        found = [getattr(motion, name)[ball, contact] for name in motion._fields]
        assert found == pytest.approx(known, rel=1e-9, abs=1e-12)
