"""The bearing against an independent formulation followed from rest in small steps of speed."""

from __future__ import annotations

import numpy as np
import pytest

from bearings.ring.state import BearingState
from tests.oracles.ball_bearing import BallBearingOracle, OracleState
from tests.oracles.known_bearings import HYPOTHESES, RPM, SHARINGS, VEX70

GROWTH = dict(static_growth=6e-6, growth=1.1e-5)


def assert_same(ours: BearingState, theirs: OracleState) -> None:
    largest = theirs.outer_load.max()
    assert ours.displacement == pytest.approx(theirs.displacement, rel=1e-6, abs=1e-11)
    assert ours.load == pytest.approx(theirs.load, rel=1e-6, abs=1e-6 * np.abs(theirs.load).max())
    for name in ("inner_load", "outer_load", "centrifugal_force"):
        assert getattr(ours, name) == pytest.approx(getattr(theirs, name), abs=1e-6 * largest)
    moment = theirs.gyroscopic_moment
    assert ours.gyroscopic_moment == pytest.approx(moment, abs=1e-6 * np.abs(moment).max())
    loaded = theirs.inner_load > 0.0
    assert ours.inner_angle[loaded] == pytest.approx(theirs.inner_angle[loaded], abs=1e-6)
    assert ours.outer_angle[loaded] == pytest.approx(theirs.outer_angle[loaded], abs=1e-6)


@pytest.mark.few(5)
@pytest.mark.parametrize("sharing", SHARINGS)
@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_under_thrust(kinematics: str, sharing: str) -> None:
    how = dict(kinematics=kinematics, moment_sharing=sharing, **GROWTH)
    load, speed = [900.0, 0.0, 0.0, 0.0, 0.0], 22000.0 * RPM
    theirs = BallBearingOracle(VEX70, **how).from_load(load, speed, steps=25, free="x")
    ours = VEX70.equilibrium(load=load, speed=speed, **how)
    assert ours.displacement == pytest.approx(theirs.displacement, rel=1e-7, abs=1e-12)
    assert ours.inner_load == pytest.approx(theirs.inner_load[0], rel=1e-7)
    assert ours.outer_angle == pytest.approx(theirs.outer_angle[0], rel=1e-7)
    assert ours.gyroscopic_moment == pytest.approx(theirs.gyroscopic_moment[0], rel=1e-7)


@pytest.mark.few(2)
@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_under_combined_load(kinematics: str) -> None:
    how = dict(kinematics=kinematics, **GROWTH)
    load, speed = [1500.0, 350.0, -200.0, 2.0, 4.0], 18000.0 * RPM
    theirs = BallBearingOracle(VEX70, **how).from_load(load, speed, steps=12)
    assert_same(VEX70.equilibrium(load=load, speed=speed, **how), theirs)


def test_at_rest_with_unloaded_balls() -> None:
    """Radial load above the thrust: part of the ring carries nothing."""
    load = [300.0, 900.0, 100.0, 0.0, 3.0]
    theirs = BallBearingOracle(VEX70).from_load(load, 0.0)
    ours = VEX70.equilibrium(load=load)
    assert np.count_nonzero(theirs.inner_load == 0.0) > 0
    assert ours.displacement == pytest.approx(theirs.displacement, rel=1e-6, abs=1e-12)
    assert ours.inner_load == pytest.approx(theirs.inner_load, rel=1e-6, abs=1e-6)


def random_displacements(count: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(20130)
    thrown = rng.uniform(-1.0, 1.0, (count, 5))
    middle = np.array([20e-6, 0.0, 0.0, 0.0, 0.0])
    return middle + thrown * [35e-6, 25e-6, 25e-6, 5e-4, 5e-4], rng.uniform(4e3, 3e4, count) * RPM


@pytest.mark.long
@pytest.mark.parametrize("kinematics", ["hybrid", "outer"])
def test_from_random_displacements(kinematics: str) -> None:
    """Loaded, lightly held and lost balls in one bearing; both hypotheses that fade with αo."""
    given, speeds = random_displacements(5)
    ours = VEX70.equilibrium(displacement=given, speed=speeds, kinematics=kinematics)
    oracle = BallBearingOracle(VEX70, kinematics=kinematics)
    assert (ours.outcome == "").all()
    for i, (d, speed) in enumerate(zip(given, speeds, strict=True)):
        theirs = oracle.from_displacement(d, speed, steps=16)
        largest = theirs.outer_load.max()
        assert ours.load[i] == pytest.approx(theirs.load, abs=2e-6 * largest * VEX70.balls)
        assert ours.inner_load[i] == pytest.approx(theirs.inner_load, abs=2e-6 * largest)
        assert ours.outer_load[i] == pytest.approx(theirs.outer_load, abs=2e-6 * largest)
        assert ((ours.status[i] == "lost contact") == (theirs.inner_load == 0.0)).all()


LOST_UNDER_LOAD = [
    ([320.8, -279.6, 12.0, -4.9, -2.4], 16021.0),
    ([594.9, -402.8, -563.2, 5.0, -7.2], 31219.0),
    ([1552.8, -387.0, 654.9, 10.5, -28.0], 31967.0),
    ([760.0, -180.2, 502.6, -15.1, 8.7], 10988.0),
]
LOOSE_WHEN_SLOW = [
    ([2412.4, -2216.8, -890.9, -47.7, 2.1], 146.0),
    ([627.7, 468.8, -402.5, -5.7, 1.8], 1440.0),
    ([5021.5, 3688.5, 3946.3, -15.5, 54.6], 1123.0),
]


@pytest.mark.few(4)
@pytest.mark.parametrize(("load", "rpm"), LOST_UNDER_LOAD + LOOSE_WHEN_SLOW)
@pytest.mark.parametrize("kinematics", ["hybrid", "outer"])
def test_load_that_takes_some_balls_out_of_contact(
    kinematics: str, load: list[float], rpm: float
) -> None:
    """Part of the ring is lost at speed, or held by Fc alone: a state exists all the same."""
    theirs = BallBearingOracle(VEX70, kinematics=kinematics).from_load(load, rpm * RPM, steps=20)
    back = VEX70.equilibrium(
        displacement=theirs.displacement, speed=rpm * RPM, kinematics=kinematics
    )
    assert back.load == pytest.approx(theirs.load, rel=1e-5, abs=1e-5 * max(load))
    assert_same(VEX70.equilibrium(load=load, speed=rpm * RPM, kinematics=kinematics), theirs)
