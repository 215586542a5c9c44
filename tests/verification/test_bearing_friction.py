"""Friction that limits the gyroscopic moment: the axis of a ball yields until its races hold it."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from bearings import condition, stiffness
from tests.oracles.ball_bearing import BallBearingOracle
from tests.oracles.known_bearings import HYPOTHESES, RPM, SHARINGS, VEX70
from tests.oracles.slipping import axis, imbalance

MU = 0.03
SPEED = 26000.0 * RPM
SHARE = {"equal": 1.0, "outer": 0.0, "inner": 2.0}
LOAD = np.array([900.0, 150.0, -60.0, 1.5, 0.5])


@pytest.mark.parametrize("sharing", SHARE)
@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_every_ball_balances_with_the_moment_its_races_hold(kinematics: str, sharing: str) -> None:
    how = dict(kinematics=kinematics, moment_sharing=sharing)
    state = VEX70.equilibrium(load=LOAD, speed=SPEED, friction=MU, **how)
    oracle = BallBearingOracle(VEX70, **how)
    loaded = np.flatnonzero(state.inner_load > 0.0)
    assert loaded.size > 10
    for ball in loaded:
        assert imbalance(oracle, SPEED, state, ball, MU, SHARE[sharing]) < 1e-8
    assert max(state.inner_required_friction.max(), state.outer_required_friction.max()) <= MU * (
        1.0 + 1e-9
    )
    slipping = set(state.slipping[loaded].tolist()) - {""}
    assert slipping == {"outer" if sharing == "outer" else "inner"}
    for race in slipping:
        assert f"slips on the {race} race" in str(condition(state))


@pytest.mark.parametrize("sharing", SHARINGS)
@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_friction_that_suffices_changes_nothing(kinematics: str, sharing: str) -> None:
    how = dict(kinematics=kinematics, moment_sharing=sharing)
    free = VEX70.equilibrium(load=[3000.0, 0, 0, 0, 0], speed=SPEED, **how)
    enough = 1.01 * max(free.inner_required_friction.max(), free.outer_required_friction.max())
    held = VEX70.equilibrium(load=[3000.0, 0, 0, 0, 0], speed=SPEED, friction=enough, **how)
    assert held.complete_stiffness == pytest.approx(free.complete_stiffness, rel=1e-12)
    assert (held.slipping == "").all()
    assert not str(condition(held))
    less = VEX70.equilibrium(load=[3000.0, 0, 0, 0, 0], speed=SPEED, friction=enough / 2.0, **how)
    assert (less.slipping != "").all()
    assert less.gyroscopic_moment[0] < 0.99 * free.gyroscopic_moment[0]


@pytest.mark.parametrize("sharing", ["equal", "inner", "hybrid"])
@pytest.mark.parametrize("kinematics", HYPOTHESES)
def test_tangent_of_slipping_balls_equals_differences(kinematics: str, sharing: str) -> None:
    """Of states without a ball at the border of slipping, where the tangent has a kink."""
    loads = np.outer([1.0, 1.2, 1.5, 2.0, 2.6, 3.5, 5.0], LOAD)
    how = dict(load=loads, speed=SPEED, kinematics=kinematics, moment_sharing=sharing)
    less, state, more = (VEX70.equilibrium(friction=mu, **how) for mu in (0.0398, 0.04, 0.0402))
    smooth = (less.slipping == more.slipping).all(axis=1)
    assert smooth.sum() >= 2
    assert (state.slipping[smooth] != "").any(axis=1).sum() >= 2
    radius = VEX70.pitch_diameter / 2.0
    weight = np.outer(*[np.array([1.0, 1.0, 1.0, 1.0 / radius, 1.0 / radius])] * 2)
    complete, measured = (
        k[smooth] * weight for k in (state.stiffness(), stiffness(state, "difference"))
    )
    fault = np.abs(complete - measured).max((1, 2)) / np.abs(measured).max((1, 2))
    assert fault.max() < 1e-6


@pytest.mark.few(1)
@pytest.mark.parametrize("sharing", ["inner", "equal"])
@pytest.mark.parametrize("kinematics", ["inner", "geometric"])
def test_a_light_ball_fades_out_of_contact(kinematics: str, sharing: str) -> None:
    """Unlimited, the inner race would need more friction than any; the loaded branch ends there."""
    away = np.zeros((2000, 5))
    away[:, 0] = np.linspace(20e-6, -130e-6, len(away))
    how = dict(displacement=away, speed=24000.0 * RPM, kinematics=kinematics)
    unlimited = VEX70.equilibrium(moment_sharing=sharing, **how)
    assert (unlimited.outcome == "no equilibrium").sum() > 100 or sharing == "equal"
    grip = unlimited.inner_required_friction[unlimited.inner_load[:, 0] > 0.0, 0]
    assert np.nanmax(grip) > 1.0
    state = VEX70.equilibrium(moment_sharing=sharing, friction=0.1, **how)
    assert (state.outcome == "").all()
    last = int(np.flatnonzero(state.inner_load[:, 0] > 0.0)[-1])
    assert state.inner_load[last, 0] < 0.02
    assert state.inner_required_friction[last, 0] == pytest.approx(0.1, rel=1e-9)
    steps = np.diff(state.load[:, 0])
    assert np.abs(np.diff(steps)).max() < 0.1 * np.abs(steps).max()  # no jump
    assert np.abs(np.diff(state.outer_load[last - 50 :, 0])).max() < 0.1
    assert state.centrifugal_force[last, 0] == pytest.approx(
        state.centrifugal_force[last + 1, 0], rel=1e-3
    )


def test_spin_of_slipping_balls_is_that_of_the_yielded_axis() -> None:
    how = dict(load=[800.0, 0, 0, 0, 0], speed=SPEED, kinematics="inner")
    free, held = (VEX70.equilibrium(friction=mu, **how) for mu in (None, 0.05))
    assert np.abs(free.inner_spin_to_roll).max() < 1e-12
    assert (held.slipping == "inner").all()
    oracle = BallBearingOracle(VEX70, kinematics="inner")
    state = SimpleNamespace(**{n: getattr(held, n) for n in ("inner_load", "outer_load")})
    state.inner_angle, state.outer_angle = held.inner_angle, held.outer_angle
    beta = axis(oracle, SPEED, state, 0, 0.05, 1.0)[0]
    g, ai = oracle.g, float(held.inner_angle[0])
    expected = (1.0 - g * np.cos(ai)) * np.tan(ai - beta) + g * np.sin(ai)
    assert held.inner_spin_to_roll[0] == pytest.approx(expected, rel=1e-8)
