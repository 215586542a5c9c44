"""Centrifugal force or gyroscopic moment alone."""

from __future__ import annotations

import numpy as np
import pytest

from bearings import life, stiffness
from tests.oracles.known_bearings import RPM, VEX70

LOAD = [610.0, 0.0, 0.0, 0.0, 0.0]
SPEED = np.array([0.0, 8e3, 16e3, 24e3]) * RPM


def test_centrifugal_force_alone_is_between_two_contacts() -> None:
    """Each race carries its share of the thrust, and the outer one Fc = ½ m dm ωm² as well."""
    state = VEX70.equilibrium(load=LOAD, speed=SPEED, dynamics="centrifugal")
    whole = VEX70.equilibrium(load=LOAD, speed=SPEED)
    inner, outer = state.inner_angle, state.outer_angle
    assert (state.gyroscopic_moment == 0.0).all()
    assert (whole.gyroscopic_moment[1:] > 0.0).all()
    assert state.inner_load * np.sin(inner) == pytest.approx(610.0 / 25, rel=1e-9)
    assert state.outer_load * np.sin(outer) == pytest.approx(610.0 / 25, rel=1e-9)
    pushed = state.outer_load * np.cos(outer) - state.inner_load * np.cos(inner)
    assert pushed == pytest.approx(state.centrifugal_force, rel=1e-9, abs=1e-9)
    g = state.operation.geometry
    assert state.centrifugal_force[:, 0] == pytest.approx(
        0.5 * g.ball_mass * g.pitch_diameter * (SPEED * life.frequencies(state).cage) ** 2, rel=1e-9
    )


@pytest.mark.parametrize("sharing", ["equal", "outer"])
def test_gyroscopic_moment_alone_keeps_equal_loads(sharing: str) -> None:
    """Without centrifugal force the moment turns the ball's forces but feeds no race: the balance
    along the axis holds, and by an equal share both races keep one angle."""
    state = VEX70.equilibrium(load=LOAD, speed=SPEED, dynamics="gyroscopic", moment_sharing=sharing)
    share = 1.0 if sharing == "equal" else 0.0
    held = share * state.gyroscopic_moment / VEX70.ball_diameter
    axial = state.inner_load * np.sin(state.inner_angle) + held * np.cos(state.inner_angle)
    assert axial.sum(axis=-1) == pytest.approx([610.0] * 4, rel=1e-9)
    assert (state.centrifugal_force == 0.0).all()
    assert (state.gyroscopic_moment[1:] > 0.0).all()
    same = np.isclose(state.inner_angle, state.outer_angle, atol=1e-9).all()
    assert same == (sharing == "equal")


@pytest.mark.parametrize("dynamics", ["centrifugal", "gyroscopic"])
def test_tangent_of_either_alone(dynamics: str) -> None:
    state = VEX70.equilibrium(
        load=[610, 100, 0, 0, 0], speed=16e3 * RPM, dynamics=dynamics, kinematics="outer"
    )
    difference = stiffness(state, "difference")
    size = np.abs(difference).max()
    assert np.abs(state.complete_stiffness - difference).max() < 1e-6 * size
