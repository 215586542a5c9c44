"""What a state says of itself, and how much work a question costs."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

from bearings import NoEquilibrium, equilibrium
from tests.oracles.known_bearings import RPM, VEX70

FAST = 30000.0 * RPM


def test_states_in_words() -> None:
    loads = [
        [1000.0, 0, 0, 0, 0],
        [0.0, 0, 0, 0, 0],
        [60000.0, 0, 0, 0, 0],
        [300.0, 900.0, 0, 0, 0],
    ]
    state = VEX70.equilibrium(load=loads, speed=20000.0 * RPM)
    plain, unloaded, heavy, aside = state.condition.tolist()
    assert not plain
    assert unloaded == "unloaded"
    pressure = max(state.inner_pressure[2].max(), state.outer_pressure[2].max())
    assert heavy == f"overloaded (pressure {pressure / 1e9:.1f} GPa)"
    assert pressure > 4.2e9
    lost = np.flatnonzero(state.status[3] == "lost contact")
    first, last = (int(n) for n in re.findall(r"\d+", aside)[:2])
    assert aside.startswith("lost contact (balls ")
    assert (lost[0], last) == (first, last)
    assert (state.status[3, first : last + 1] == "lost contact").all()


def test_a_ring_that_touches_no_ball_is_unloaded() -> None:
    state = VEX70.equilibrium(displacement=[-200e-6, 0, 0, 0, 0], speed=20000.0 * RPM)
    assert str(state.condition) == "unloaded"
    assert (state.load == 0.0).all()


@pytest.mark.parametrize("kinematics", ["inner", "geometric"])
def test_the_speed_at_which_stiffness_vanishes(kinematics: str) -> None:
    """Just below it there is a state, its softest direction nearly gone; above there is none."""
    load = [60.0, 20.0, 0.0, 0.0, 0.0]
    with pytest.raises(NoEquilibrium, match="stiffness vanishes above") as caught:
        VEX70.equilibrium(load=load, speed=FAST, kinematics=kinematics, moment_sharing="inner")
    limit = float(re.findall(r"above (\d+) rpm", str(caught.value))[0])
    ask = dict(load=load, kinematics=kinematics, moment_sharing="inner")
    near = VEX70.equilibrium(speed=np.array([0.5, 0.9, 1.0]) * limit * RPM, **ask)
    assert (near.outcome == "").all()
    beyond = VEX70.equilibrium(speed=np.array([1.001, 1.02, 1.1]) * limit * RPM, **ask)
    assert (beyond.outcome == "no equilibrium").all()
    softest = np.linalg.eigvals(near.complete_stiffness[:, :3, :3]).real.min(axis=1)
    assert softest[2] < 0.5 * softest[1]


def test_given_displacement_is_named() -> None:
    with pytest.raises(NoEquilibrium, match="at this displacement"):
        VEX70.equilibrium(
            displacement=[-15e-6, 0, 0, 0, 0],
            speed=FAST,
            kinematics="inner",
            moment_sharing="inner",
        )


def test_balls_that_are_solved(monkeypatch: pytest.MonkeyPatch) -> None:
    """Axial load solves exactly one ball; the least aside solves all of them."""
    widths: set[int] = set()
    whole = equilibrium.linearise

    def counted(problem: Any, *state: Any) -> Any:
        widths.add(problem.ring.balls)
        return whole(problem, *state)

    monkeypatch.setattr(equilibrium, "linearise", counted)
    VEX70.equilibrium(load=[1000.0, 0, 0, 0, 0], speed=FAST, compiled=False)
    VEX70.equilibrium(displacement=[20e-6, 0, 0, 0, 0], speed=[0.0, FAST], compiled=False)
    assert widths == {1}
    VEX70.equilibrium(load=[1000.0, 1.0, 0, 0, 0], speed=FAST, compiled=False)
    assert widths == {1, VEX70.balls}


def test_residual_is_told() -> None:
    loads = np.outer([100.0, 1000.0, 10000.0], [1.0, 0.3, 0.1, 0.001, 0.0])
    state = VEX70.equilibrium(load=loads, speed=FAST)
    assert (state.residual < 1e-11).all()
    assert state.residual.shape == (3,)
