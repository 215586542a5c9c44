"""The preload table: every bearing at its state, in the order of the seats."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest

from rotordyn.analyses.preload.spec import PreloadSpec
from tests.oracles.ball_bearing import BallBearingOracle
from tests.oracles.spindles import answers, mfw2310

SPEEDS = (0, 12000, 24000)


@cache
def table() -> Any:
    return answers(mfw2310(), SPEEDS, {"preload": PreloadSpec()})["preload"]


def test_names() -> None:
    assert table().bearing == ("a", "b", "c", "d", "e")
    assert table().sleeve == ("front", "rear")
    assert table().body == ("shaft", "front", "rear")


@pytest.mark.few(1)
@pytest.mark.parametrize("seat", [0, 2, 4])
def test_ball_values_of_an_independent_bearing(seat: int) -> None:
    """Loads, angles, inertia and tangent under the load of the table, at 12 000 rpm."""
    ours, speed = table(), table().speed[1]
    oracle = BallBearingOracle(
        mfw2310().seats[seat].bearing,
        kinematics="outer",
        static_growth=43.2e-6,
        growth=float(ours.growth[1, seat]),
    )
    state = oracle.from_load([ours.axial_load[1, seat], 0, 0, 0, 0], speed, steps=12, free="x")
    for name in ("inner_load", "outer_load", "inner_angle", "outer_angle",
                 "centrifugal_force", "gyroscopic_moment"):  # fmt: skip
        assert getattr(ours, name)[1, seat] == pytest.approx(getattr(state, name)[0], rel=1e-6)
    assert ours.deflection[1, seat] == pytest.approx(state.displacement[0], rel=1e-6)
    mg, d = ours.gyroscopic_moment[1, seat], 9.525e-3
    assert ours.inner_required_friction[1, seat] == pytest.approx(
        mg / (d * ours.inner_load[1, seat])
    )
    assert ours.outer_required_friction[1, seat] == pytest.approx(
        mg / (d * ours.outer_load[1, seat])
    )
    step = np.array([1e-8, 0, 0, 0, 0])
    ends = [
        oracle.from_displacement(state.displacement + s * step, speed, steps=12).load[0]
        for s in (1, -1)
    ]
    assert ours.stiffness[1, seat, 0, 0] == pytest.approx((ends[0] - ends[1]) / 2e-8, rel=1e-4)


def test_load_at_rest_is_the_sum_over_the_balls() -> None:
    balls = np.array([25, 25, 25, 21, 21])
    sums = balls * table().inner_load[0] * np.sin(table().inner_angle[0])
    assert sums == pytest.approx(table().axial_load[0], rel=1e-9)


def test_speed_factor_is_rpm_times_pitch_diameter() -> None:
    expected = 24000 * np.array([90, 90, 90, 77.5, 77.5])
    assert table().speed_factor[2] == pytest.approx(expected)
    assert (table().speed_factor[0] == 0).all()


def test_growth_and_position() -> None:
    assert table().growth[:, 3] == pytest.approx([43.2e-6, 45.025e-6, 50.5e-6])
    assert table().position[0] == pytest.approx(0.0, abs=1e-14)
    assert table().position[2, 1] == pytest.approx(-52.2e-6)


def test_springs_and_stops() -> None:
    spring = table().spring_force[2]
    assert spring[0] == pytest.approx(574 + 6.20 * 52.2, rel=1e-9)
    assert table().stop_force[2, 0] == pytest.approx(table().axial_load[2, 2] - spring[0], rel=1e-8)
    assert table().stop_reached.tolist() == [[False, False], [False, False], [True, False]]


def test_contact_angles_part_with_speed() -> None:
    gap = table().inner_angle - table().outer_angle
    assert gap[0] == pytest.approx(0.0, abs=1e-12)
    assert (np.diff(gap, axis=0) > math.radians(3)).all()


def test_static_bearings_repeat_their_state_at_rest() -> None:
    found = answers(mfw2310(), SPEEDS, {"preload": PreloadSpec()}, bearings="static")["preload"]
    for name in ("axial_load", "stiffness", "inner_pressure", "position"):
        values = getattr(found, name)
        assert (values == values[0]).all(), name
    assert found.speed_factor[2, 0] == pytest.approx(24000 * 90)
    assert not found.stop_reached.any()
