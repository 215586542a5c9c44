"""The door of the bearing: what it refuses, and how it says so."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from bearings import (
    AngularContactBallBearing,
    BearingError,
    DeepGrooveBallBearing,
    Follower,
    InvalidBearing,
    NoEquilibrium,
)
from bearings.ring.condition import condition
from tests.oracles.known_bearings import HARRIS_209_DEEP, RPM, VEX70

THRUST = [1000.0, 0.0, 0.0, 0.0, 0.0]
FAST = 30000.0 * RPM


@pytest.mark.parametrize(
    "wrong",
    [
        dict(load=[math.nan, 0, 0, 0, 0]),
        dict(load=[math.inf, 0, 0, 0, 0]),
        dict(displacement=[0, 0, -math.inf, 0, 0]),
        dict(load=THRUST, speed=math.nan),
        dict(load=THRUST, speed=[1.0, math.inf]),
        dict(load=THRUST, static_growth=math.nan),
        dict(load=THRUST, growth=math.inf),
        dict(load=[1000.0, 0, 0]),
        dict(load=1000.0),
        dict(load=[]),
        dict(displacement=np.zeros((5, 4))),
        dict(load=np.ones((3, 5)), speed=[1.0, 2.0]),
        dict(load=np.ones((3, 5)), growth=[1e-6, 2e-6]),
        dict(load="1000 N"),
        dict(load=["a", 0, 0, 0, 0]),
        dict(load=THRUST, speed="fast"),
        dict(load=[[1.0, 0, 0, 0, 0], [1.0, 0]]),
        dict(load=THRUST, kinematics=None),
        dict(load=[10**400, 0, 0, 0, 0]),
        dict(load=[1e13, 0, 0, 0, 0]),
        dict(displacement=[1e200, 0, 0, 0, 0]),
        dict(load=THRUST, speed=1e200),
        dict(load=THRUST, friction=True),
        dict(load=THRUST, friction=0.0),
        dict(load=THRUST, friction=1.01e6),
        dict(load=THRUST, friction=math.inf),
        dict(load=THRUST, friction="0.1"),
        dict(load=THRUST, start="x"),
        dict(load=THRUST, compiled="yes"),
    ],
    ids=str,
)
def test_impossible_arguments(wrong: dict[str, Any]) -> None:
    with pytest.raises(InvalidBearing):
        VEX70.equilibrium(**wrong)


def test_leading_shapes_that_do_not_fit_are_named() -> None:
    with pytest.raises(InvalidBearing, match=r"load \(3,\), .* growth \(2,\)"):
        VEX70.equilibrium(load=np.ones((3, 5)), growth=[1e-6, 2e-6])


def test_exactly_one_of_load_and_displacement() -> None:
    with pytest.raises(InvalidBearing, match="exactly one"):
        VEX70.equilibrium(load=THRUST, displacement=np.zeros(5))
    with pytest.raises(InvalidBearing, match="exactly one"):
        VEX70.equilibrium(speed=100.0)


@pytest.mark.parametrize(
    ("key", "word", "meant"),
    [
        ("kinematics", "hybird", "hybrid"),
        ("kinematics", "outter", "outer"),
        ("kinematics", "geometrical", "geometric"),
        ("moment_sharing", "equall", "equal"),
        ("moment_sharing", "iner", "inner"),
    ],
)
def test_unknown_word_is_answered_with_the_nearest(key: str, word: str, meant: str) -> None:
    with pytest.raises(InvalidBearing, match=rf"{key}.*{word}.*did you mean '{meant}'"):
        VEX70.equilibrium(load=THRUST, **{key: word})


def test_unknown_stiffness_method() -> None:
    with pytest.raises(InvalidBearing, match="method"):
        VEX70.equilibrium(load=THRUST).stiffness("compleat")


def test_errors_are_bearing_errors_and_value_errors() -> None:
    assert issubclass(InvalidBearing, BearingError)
    assert issubclass(InvalidBearing, ValueError)
    assert issubclass(NoEquilibrium, BearingError)


def growth_that_eats_the_angle(bearing: AngularContactBallBearing) -> float:
    free = (bearing.inner_conformity + bearing.outer_conformity - 1.0) * bearing.ball_diameter
    return free * (1.0 - math.cos(bearing.contact_angle))


def test_static_growth_that_takes_the_whole_contact_angle() -> None:
    limit = growth_that_eats_the_angle(VEX70)
    fine = VEX70.equilibrium(load=THRUST, static_growth=0.999 * limit)
    assert np.isfinite(fine.displacement).all()
    with pytest.raises(NoEquilibrium, match="contact angle") as caught:
        VEX70.equilibrium(load=THRUST, static_growth=1.001 * limit, speed=100.0)
    assert caught.value.outcome == "no contact angle"
    assert caught.value.speed == pytest.approx(100.0)
    assert caught.value.remedy


@pytest.mark.parametrize("speed", [0.0, 1000.0])
def test_no_load_is_no_definite_state(speed: float) -> None:
    with pytest.raises(NoEquilibrium) as caught:
        VEX70.equilibrium(load=np.zeros(5), speed=speed)
    assert caught.value.outcome == "unloaded"
    assert caught.value.speed == speed
    assert caught.value.outcome in str(caught.value)
    assert caught.value.remedy in str(caught.value)


def test_thrust_the_wrong_way_is_named() -> None:
    """The grooves would carry it, the ring without a shoulder does not: every ball says so."""
    d = VEX70.equilibrium(load=THRUST).displacement
    through = [-2.0 * 0.1 * 9.525e-3 * math.sin(math.radians(25.0)), 0, 0, 0, 0] - d
    s = VEX70.equilibrium(displacement=[through, d])
    assert (s.status[0] == "open side").all()
    assert (s.inner_angle[0] < 0.0).all()
    assert (s.status[1] == "loaded").all()


def test_balls_in_the_middle_of_the_groove_are_on_the_open_side() -> None:
    """A radial load alone presses balls at 0°, whose sign is rounding."""
    radial = np.zeros((40, 5))
    radial[:, 1] = np.geomspace(1.0, 1e5, 40)
    s = replace(VEX70, contact_angle=math.radians(15.0)).equilibrium(load=radial)
    middle = (s.inner_load > 0.0) & (np.abs(s.inner_angle) < 1e-9)
    assert middle.sum() > 100
    assert (s.status[middle] == "open side").all()


NAN = math.nan


@pytest.mark.parametrize(
    ("load", "displacement"),
    [
        ([-500.0, 0, 0, 0, 0], None),
        ([THRUST, [-500.0, 0, 0, 0, 0]], None),
        ([-500.0, 2e3, 0, 0, 0], None),
        ([-500.0, NAN, NAN, NAN, NAN], [NAN, 1e-6, 0, 0, 0]),
        ([[[-500.0, 10.0, 0, NAN, NAN]]], [NAN, NAN, NAN, 0, 0]),
    ],
)
def test_thrust_that_a_kind_cannot_take_is_refused(load: Any, displacement: Any) -> None:
    """By both doors with the sentence of a case file; a negative zero and rounding are none."""
    said = r"towards \+x only: got -500 N, allowed: 0 N or more.*turn the bearing round"
    with pytest.raises(InvalidBearing, match=said):
        VEX70.equilibrium(load=load, displacement=displacement)
    if displacement is None:
        with pytest.raises(InvalidBearing, match=said):
            Follower(VEX70).displacement(load)


def test_thrust_that_is_rounding_is_not_refused() -> None:
    for axial in (0.0, -0.0, -1e-8):
        assert VEX70.equilibrium(load=[axial, 500.0, 0, 0, 0]).outcome == ""
    assert VEX70.equilibrium(load=[0.0, 500.0, 0, 0, -10.0]).outcome == ""


def test_turning_the_bearing_round_helps_against_thrust_alone() -> None:
    """A moment or a radial load finds the open side either way."""
    pushed = str(condition(VEX70.equilibrium(displacement=[-1e-3, 0, 0, 0, 0])))
    tilted, radial = (
        str(condition(VEX70.equilibrium(load=load)))
        for load in ([0, 0, 0, 5.0, 0], [0, 100.0, 0, 0, 0])
    )
    assert "raise the thrust, or turn the bearing round" in pushed
    for said in (tilted, radial):
        assert "raise the thrust" in said
        assert "turn the bearing" not in said


def test_batch_carries_an_outcome_per_state() -> None:
    load = [THRUST, [0.0] * 5, THRUST]
    limit = growth_that_eats_the_angle(VEX70)
    s = VEX70.equilibrium(load=load, static_growth=[0.0, 0.0, 1.1 * limit], speed=500.0)
    assert s.outcome[0] == ""
    assert s.outcome[1] in {"unloaded", "no equilibrium"}
    assert s.outcome[2] == "no contact angle"
    assert np.isfinite(s.displacement[0]).all()
    assert np.isnan(s.displacement[1:]).all()
    assert np.isnan(s.stiffness()[1:]).all()
    assert np.isnan(s.inner_load[1:]).all()


def test_batch_of_one_does_not_raise() -> None:
    s = VEX70.equilibrium(load=[[0.0] * 5])
    assert s.outcome.shape == (1,)
    assert s.outcome[0]


def test_empty_batch() -> None:
    s = VEX70.equilibrium(load=np.empty((0, 5)), speed=FAST)
    assert s.load.shape == (0, 5)
    assert s.outcome.shape == (0,)


def test_arguments_are_not_written_to() -> None:
    load = np.array([THRUST, THRUST])
    load[1, 1] = 100.0
    kept = load.copy()
    VEX70.equilibrium(load=load, speed=FAST / 3)
    assert np.array_equal(load, kept)


def test_growth_defaults_to_the_static_one() -> None:
    a = VEX70.equilibrium(load=THRUST, speed=FAST, static_growth=8e-6)
    b = VEX70.equilibrium(load=THRUST, speed=FAST, static_growth=8e-6, growth=8e-6)
    c = VEX70.equilibrium(load=THRUST, speed=FAST, static_growth=8e-6, growth=14e-6)
    assert np.array_equal(a.displacement, b.displacement)
    assert c.displacement[0] != pytest.approx(a.displacement[0], rel=1e-3)


def test_defaults_are_hybrid_and_equal() -> None:
    a = VEX70.equilibrium(load=THRUST, speed=FAST)
    b = VEX70.equilibrium(load=THRUST, speed=FAST, kinematics="hybrid", moment_sharing="equal")
    assert np.array_equal(a.inner_load, b.inner_load)


def test_a_deep_groove_of_no_clearance_carries_thrust_both_ways() -> None:
    s = HARRIS_209_DEEP.equilibrium(load=[[800.0, 0, 0, 0, 0], [-800.0, 0, 0, 0, 0]])
    assert s.displacement[0, 0] == pytest.approx(-s.displacement[1, 0], rel=1e-10)


@pytest.mark.parametrize(
    "change",
    [
        dict(ball_diameter=0.0),
        dict(ball_diameter=9.525),
        dict(ball_diameter=math.nan),
        dict(pitch_diameter=-0.09),
        dict(balls=2),
        dict(balls=25.5),
        dict(balls=40),
        dict(contact_angle=25.0),
        dict(contact_angle=-0.1),
        dict(inner_conformity=0.5),
        dict(outer_conformity=math.nan),
    ],
    ids=str,
)
def test_impossible_bearings(change: dict[str, float]) -> None:
    fine: dict[str, Any] = dict(
        ball_diameter=9.525e-3, pitch_diameter=0.09, balls=25, contact_angle=0.44
    )
    AngularContactBallBearing(**fine)
    with pytest.raises(InvalidBearing):
        AngularContactBallBearing(**(fine | change))


@pytest.mark.parametrize(
    "load",
    [[True, 0, 0, 0, 0], np.array([True] * 5), [[1000.0, 0, 0, 0, np.False_]], ["1", 0, 0, 0, 0]],
)
def test_truth_values_and_text_are_no_loads(load: Any) -> None:
    with pytest.raises(InvalidBearing, match="load must be numbers"):
        VEX70.equilibrium(load=load)


def test_a_start_is_a_state_of_the_same_kind() -> None:
    load = [1000.0, 0.0, 0.0, 0.0, 0.0]
    other = DeepGrooveBallBearing(
        VEX70.ball_diameter, VEX70.pitch_diameter, VEX70.balls, radial_clearance=10e-6
    )
    with pytest.raises(InvalidBearing, match="start must be a state of a bearing of this kind"):
        VEX70.equilibrium(load=load, speed=1000.0, start=other.equilibrium(load=load, speed=1000.0))


@pytest.mark.parametrize(
    ("change", "asks"),
    [
        ({"balls": 2}, False),
        ({"inner_conformity": 52.0}, False),
        ({"balls": 10**400}, False),
        ({"ball_diameter": 9.525}, True),
        ({"contact_angle": 25.0}, True),
    ],
)
def test_only_values_with_a_unit_are_asked_for_it(change: dict[str, Any], asks: bool) -> None:
    with pytest.raises(InvalidBearing) as refused:
        replace(VEX70, **change)
    assert ("(did you mean " in str(refused.value)) == asks
    assert len(str(refused.value)) < 200


def test_what_a_question_leaves_open_is_named() -> None:
    with pytest.raises(InvalidBearing, match=r"no number for Fx, .*: give δx, .* by displacement"):
        VEX70.equilibrium(load=[None] * 5)
    with pytest.raises(InvalidBearing, match="no number for δy: give Fy by load"):
        VEX70.equilibrium(displacement=[0.0, None, 0.0, 0.0, 0.0])


@pytest.mark.parametrize("growth", [-0.01, 0.01])
def test_absurd_growth_of_a_ring_is_refused(growth: float) -> None:
    """−10 mm would bring the inner grooves behind the outer ones, +10 mm crush the balls."""
    with pytest.raises(NoEquilibrium, match=r"no contact angle|overloaded"):
        VEX70.equilibrium(load=THRUST, growth=growth)


@pytest.mark.parametrize("speed", [0.0, 500.0])
def test_an_absurd_displacement_is_refused_as_the_load_would_be(speed: float) -> None:
    state = VEX70.equilibrium(displacement=[[1.0, 0, 0, 0, 0], [2e-5, 0, 0, 0, 0]], speed=speed)
    assert state.outcome.tolist() == ["overloaded", ""]
    assert np.isnan(state.load[0]).all()
    with pytest.raises(NoEquilibrium, match="is the unit right"):
        VEX70.equilibrium(displacement=[1.0, 0, 0, 0, 0], speed=speed)
