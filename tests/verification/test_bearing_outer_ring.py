"""The load on the outer ring against forces at points in space, and against all that acts."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings

from bearings.ring.state import BearingState
from tests.oracles.known_bearings import RPM, VEX70
from tests.oracles.random_bearings import solved
from tests.oracles.rigid_balls import AXIS, RigidBalls, pair


@settings(max_examples=150)
@given(balls=solved())
def test_load_is_that_of_the_forces_at_the_contacts(balls: RigidBalls) -> None:
    force, moment = pair(balls.state.outer_ring_load)
    torque = np.cross(balls.outer_contact, balls.outer_force).sum(axis=0)
    size = np.abs(balls.outer_force).sum() + 1e-9
    assert np.abs(force - balls.outer_force.sum(axis=0)).max() < 1e-11 * size
    assert np.abs(moment - torque).max() < 1e-11 * size * balls.oracle.ri


@settings(max_examples=150)
@given(balls=solved())
def test_whole_bearing_is_in_equilibrium(balls: RigidBalls) -> None:
    """Shaft on inner ring + balls' inertia = balls on outer ring, moments about one point.

    Two things the ring's moment neglects are put back: that grown or tilted grooves lie a little
    off the circle of radius Ri, and that the ball is pressed in where friction acts, which takes
    (λi δi + λo δo)/D of Mg from the balance of the balls.
    """
    s, o = balls.state, balls.oracle
    force, moment = pair(s.load)
    centre = np.array([o.a1, 0.0, 0.0]) + s.displacement[:3]
    off = balls.inner_groove - centre - o.ri * balls.radial
    inertia = s.centrifugal_force[:, None] * balls.radial
    pressed = (balls.share * balls.approach[0] + (2 - balls.share) * balls.approach[1]) / o.d
    couple = -(s.gyroscopic_moment * (1.0 - pressed))[:, None] * balls.onward
    carried = moment + np.cross(centre, force) + np.cross(off, balls.inner_force).sum(axis=0)
    carried = carried + (np.cross(balls.centre, inertia) + couple).sum(axis=0)
    outer_force, outer_moment = pair(s.outer_ring_load)
    size = np.abs(s.outer_load).sum() + 1e-9
    assert np.abs(carried - outer_moment).max() < 1e-9 * size * o.ri
    assert np.abs(force + inertia.sum(axis=0) - outer_force).max() < 1e-9 * size
    assert outer_force[0] == pytest.approx(s.load[0], rel=1e-9, abs=1e-9 * size)
    assert (pressed < 0.02).all()


@settings(max_examples=60)
@given(balls=solved())
def test_each_ball_balances_about_its_outer_groove_centre(balls: RigidBalls) -> None:
    """m_i − m_o + (A2 − Ri + Ro) fa − A1 fr = X1 Fc − Mg, m the moments per ball of both rings."""
    s, o = balls.state, balls.oracle
    held = s.inner_load > 0.0
    radial, fi, fo = balls.radial, o.bearing.inner_conformity, o.bearing.outer_conformity
    fa, fr = balls.inner_force @ AXIS, (balls.inner_force * radial).sum(axis=1)
    a1, a2 = o.centres(s.displacement, o.azimuths())
    x1 = (balls.centre - balls.outer_groove) @ AXIS
    ro = o.ri - o.bd * np.cos(o.bearing.contact_angle)
    inner = o.ri * fa - balls.share * fi * s.gyroscopic_moment
    outer = ro * fa + (2.0 - balls.share) * fo * s.gyroscopic_moment
    pressed = (balls.share * balls.approach[0] + (2 - balls.share) * balls.approach[1]) / o.d
    left = inner - outer + (a2 - o.ri + ro) * fa - a1 * fr
    right = x1 * s.centrifugal_force - (1.0 - pressed) * s.gyroscopic_moment
    size = np.abs(s.outer_load).max() * o.d + 1e-12
    assert np.abs(left - right)[held].max(initial=0.0) < 1e-9 * size


def test_shapes_follow_the_batch_and_missing_states_stay_missing() -> None:
    load = np.ones((3, 2, 5)) * [1000.0, 100.0, 0.0, 1.0, 0.0]
    load[1, 1] = 0.0
    state = VEX70.equilibrium(load=load, speed=np.array([0.0, 2000.0]))
    assert state.outer_ring_load.shape == (3, 2, 5)
    assert np.isnan(state.outer_ring_load[1, 1]).all()
    assert np.isfinite(state.outer_ring_load[state.outcome == ""]).all()
    alone = VEX70.equilibrium(load=load[0, 1], speed=2000.0)
    assert state.outer_ring_load[0, 1] == pytest.approx(alone.outer_ring_load, rel=1e-9, abs=1e-9)


def test_balls_that_ride_the_outer_race_load_it_with_their_centrifugal_force() -> None:
    state: BearingState = VEX70.equilibrium(displacement=[-150e-6, 0, 0, 0, 0], speed=20000 * RPM)
    assert (state.status == "lost contact").all()
    one_sided = VEX70.equilibrium(displacement=[-40e-6, 60e-6, 0, 0, 0], speed=20000 * RPM)
    lost = one_sided.status == "lost contact"
    assert 0 < lost.sum() < lost.size
    assert one_sided.outer_load[lost] == pytest.approx(one_sided.centrifugal_force[lost])
    assert np.abs(state.outer_ring_load).max() < 1e-10 * state.outer_load.sum()
    spare = one_sided.outer_ring_load[1] - one_sided.load[1]
    psi = 2.0 * np.pi * np.arange(25) / 25
    assert spare == pytest.approx(one_sided.centrifugal_force @ np.cos(psi), rel=1e-9)
