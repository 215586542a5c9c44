"""Balls that move with their rings: symmetry, order of the neglected terms, the state reached."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from bearings.ring.assembly import axial_assembly, full_assembly, half_assembly
from bearings.ring.iterate import Iterate, iterate
from bearings.ring.state import BearingState
from tests.oracles.known_bearings import RPM, VEX70

SPEED = np.array([0.0, 6000.0, 18000.0, 30000.0]) * RPM
IN_PLANE = np.array([25e-6, 8e-6, 0.0, 0.0, 2e-4])
PLANE = np.array([True, True, False, False, True])


def solved(displacement: np.ndarray, balls: int = 25) -> BearingState:
    bearing = replace(VEX70, balls=balls)
    return bearing.equilibrium(displacement=displacement, speed=SPEED, kinematics="outer")


@pytest.mark.parametrize("balls", [3, 4, 24, 25])
def test_half_a_ring_is_the_whole_in_the_plane_of_a_ball(balls: int) -> None:
    """Loads, the tangent in the plane and across it, and what it does not couple."""
    state = solved(IN_PLANE, balls)
    whole, half = (iterate(state, ring) for ring in (full_assembly, half_assembly))
    assert half.ball.shape[-1] == balls // 2 + 1
    scale = np.array([1.0, 1.0, 1.0, 0.045, 0.045])
    size = np.abs(whole.load).max()
    assert np.abs((half.load - whole.load) / scale).max() < 1e-12 * size
    k = whole.stiffness / scale[:, None] / scale
    miss = half.stiffness / scale[:, None] / scale - k
    assert np.abs(miss).max() < 1e-12 * np.abs(k).max()
    assert (half.load[:, ~PLANE] == 0.0).all()
    assert (half.stiffness[:, PLANE][:, :, ~PLANE] == 0.0).all()
    assert half.error == pytest.approx(whole.error, abs=1e-15)
    assert half.pressure == pytest.approx(whole.pressure, rel=1e-12)


def test_one_ball_represents_an_axial_state() -> None:
    state = solved(np.array([25e-6, 0.0, 0.0, 0.0, 0.0]))
    one, whole = (iterate(state, ring) for ring in (axial_assembly, full_assembly))
    assert one.ball.shape[-1] == 1
    assert one.load == pytest.approx(whole.load, rel=1e-12, abs=1e-9)
    assert one.load == pytest.approx(state.load, rel=1e-10, abs=1e-9)


def test_a_state_alone_is_a_batch_of_one() -> None:
    how = {"displacement": IN_PLANE, "kinematics": "outer"}
    one = iterate(VEX70.equilibrium(speed=900.0, **how), full_assembly)
    many = iterate(VEX70.equilibrium(speed=[900.0], **how), full_assembly)
    assert one.error.shape == ()
    assert one.load == pytest.approx(many.load[0], rel=1e-12)
    assert one.moved(1.01 * IN_PLANE).ball == pytest.approx(many.moved(1.01 * IN_PLANE).ball[:, 0])


def test_balls_follow_however_they_lie_in_memory() -> None:
    """Of a batch (speeds, places), with the balls as they are and with both exchanged in memory."""
    place = np.array([1.0, 1.1])[:, None] * IN_PLANE
    state = VEX70.equilibrium(displacement=place, speed=SPEED[1:, None], kinematics="outer")
    here = iterate(state, full_assembly)
    turned = np.ascontiguousarray(np.swapaxes(here.ball, 1, 2))
    other = here.at(here.displacement, np.swapaxes(turned, 1, 2))
    change = np.full(here.displacement.shape, 1e-7)
    assert np.array_equal(other.along(change), here.along(change))


def test_load_misses_by_the_square_of_what_balls_miss() -> None:
    """A tenth of the distance of all balls from balance leaves a hundredth in the load."""
    start = iterate(solved(IN_PLANE), full_assembly)
    away = 1e-7 * np.random.default_rng(4).uniform(-1.0, 1.0, start.ball.shape)
    turning = SPEED > 0.0
    found = [start.at(start.displacement, start.ball + share * away) for share in (1.0, 0.1)]
    miss = [np.abs(f.load - start.load)[turning].max(axis=1) for f in found]
    assert np.log10(miss[0] / miss[1]) == pytest.approx(2.0, abs=0.1)
    near = [f.error[turning] for f in found]
    assert np.log10(near[0] / near[1]) == pytest.approx(1.0, abs=0.1)


def test_rings_and_balls_reach_the_state_under_a_load_together() -> None:
    """Newton over the rings alone, balls a step at each move: as many steps as one solve takes."""
    load = np.array([900.0, 200.0, 0.0, 0.0, 3.0])
    axial = VEX70.equilibrium(load=[900.0, 0, 0, 0, 0], speed=SPEED, kinematics="outer")
    expected = VEX70.equilibrium(load=load, speed=SPEED, kinematics="outer")
    here = iterate(axial, half_assembly)
    for _ in range(7):
        here = here.moved(here.displacement + _step(here, load))
    assert here.displacement == pytest.approx(expected.displacement, rel=1e-9, abs=1e-15)
    assert here.ball[:, 1:] == pytest.approx(expected.ball_centre[:, 1:, :13], rel=1e-10)
    assert (here.error < 1e-11).all()


def _step(here: Iterate, load: np.ndarray) -> np.ndarray:
    step = np.zeros_like(here.displacement)
    k = here.stiffness[:, PLANE][:, :, PLANE]
    step[:, PLANE] = np.linalg.solve(k, (load - here.load)[:, PLANE, None])[..., 0]
    return step


def test_without_a_state_nothing_is_said() -> None:
    """2 N at 30 000 rpm: balls are thrown off; the other states do not mind."""
    light = np.array([[900.0, 0, 0, 0, 0]] * 3 + [[2.0, 0, 0, 0, 0]])
    state = VEX70.equilibrium(load=light, speed=SPEED, kinematics="inner")
    assert (state.outcome != "").tolist() == [False, False, False, True]
    found = iterate(state, axial_assembly)
    assert np.isfinite(found.error).tolist() == [True, True, True, False]
    assert found.follows(found).tolist() == [True, True, True, False]


def test_an_angle_that_turns_far_is_reported() -> None:
    start = iterate(solved(IN_PLANE), full_assembly)
    sin, cos = np.sin(0.16), np.cos(0.16)
    turned = np.stack(
        [cos * start.ball[0] + sin * start.ball[1], cos * start.ball[1] - sin * start.ball[0]]
    )
    assert start.follows(start).all()
    assert (start.at(start.displacement, turned).follows(start) == (SPEED == 0.0)).all()
