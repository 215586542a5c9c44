"""What a state says of itself, and how much work a question costs."""

from __future__ import annotations

import math
import pickle
import re
from typing import Any

import numpy as np
import pytest

from bearings import AngularContactBallBearing, NoEquilibrium
from bearings import condition as words_of
from bearings.ring import condition, equilibrium, followed_stage
from bearings.ring.linearised import linearise
from benchmarks.random_bearings import rings
from tests.oracles.known_bearings import HARRIS_218, RPM, VEX70
from tests.oracles.known_grooves import R24_14, four_point

FAST = 30000.0 * RPM
FOLDING = dict(
    bearing=HARRIS_218,
    load=[11.0, 5.0, 0.0, 0.0, 0.0],
    speed=12953.0 * RPM,
    kinematics="inner",
    moment_sharing="inner",
    friction=0.1,
)


def test_states_in_words() -> None:
    loads = [
        [1000.0, 0, 0, 0, 0],
        [0.0, 0, 0, 0, 0],
        [60000.0, 0, 0, 0, 0],
        [300.0, 900.0, 0, 0, 0],
    ]
    state = VEX70.equilibrium(load=loads, speed=20000.0 * RPM)
    plain, unloaded, heavy, aside = words_of(state).tolist()
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
    assert str(words_of(state)) == "unloaded"
    assert (state.load == 0.0).all()


@pytest.mark.few(1)
@pytest.mark.parametrize("kinematics", ["inner", "geometric"])
def test_balls_that_are_thrown_off(kinematics: str) -> None:
    """Up to the reported speed there is a state; the balls named then need any friction to stay."""
    ask = dict(load=[60.0, 20.0, 0, 0, 0], kinematics=kinematics, moment_sharing="inner")
    with pytest.raises(NoEquilibrium, match="are thrown off a race") as caught:
        VEX70.equilibrium(speed=FAST, **ask)
    assert caught.value.outcome == "no equilibrium"
    assert "limit of friction" in caught.value.remedy
    limit = float(re.findall(r"above (\d+) rpm at this load", str(caught.value))[0])
    speed = np.array([0.5, 0.999, 1.001, 1.1]) * limit * RPM
    state = VEX70.equilibrium(speed=speed, **ask)
    assert (state.outcome == ["", "", "no equilibrium", "no equilibrium"]).all()
    assert (
        state.inner_required_friction[1].max() > 30.0 > 3.0 > state.inner_required_friction[0].max()
    )
    capped = VEX70.equilibrium(speed=FAST, friction=0.1, **ask)
    assert "slips on the inner race" in str(words_of(capped))


@pytest.mark.long
def test_stiffness_that_vanishes() -> None:
    """Towards the reported speed the softest direction fades; beyond it there is no state."""
    ask = dict(FOLDING)
    bearing = ask.pop("bearing")
    with pytest.raises(NoEquilibrium, match="stiffness vanishes above") as caught:
        bearing.equilibrium(**ask)
    limit = float(re.findall(r"above (\d+) rpm at this load", str(caught.value))[0])
    ask["speed"] = np.array([0.9, 0.99, 0.9995, 1.002]) * limit * RPM
    state = bearing.equilibrium(**ask)
    assert (state.outcome == ["", "", "", "no equilibrium"]).all()
    scale = np.array([1.0, 1.0, 1.0, *[2.0 / bearing.pitch_diameter] * 2])
    k = state.complete_stiffness[:3] * np.outer(scale, scale)
    softest = np.linalg.eigvals(k).real.min(axis=1)
    assert softest[2] < softest[1] < softest[0]
    assert softest[2] < 0.3 * softest[0]


@pytest.mark.parametrize("compiled", [False, True])
def test_a_ring_that_two_balls_hold_turns_as_slowly_as_one_likes(compiled: bool) -> None:
    """Balls that Fc alone holds, by 10⁻⁶ N at 1 rpm, hold the last freedom; it moves as ω²."""
    speed = np.geomspace(0.1, 100.0, 25) * RPM
    load = [11.0, 5.0, 0.0, 0.0, 0.0]
    state = HARRIS_218.equilibrium(load=load, speed=speed, compiled=compiled)
    assert (state.outcome == "").all()
    assert (np.sort(state.inner_load, axis=-1)[:, -3] < 1.0).all()
    step = np.diff(state.displacement[:10, 0])
    assert step[1:] / step[:-1] == pytest.approx((speed[1] / speed[0]) ** 2, rel=1e-3)


def test_states_again_are_reported() -> None:
    state = rings.draw_states(83).only(5).solve()
    (word,) = condition.endings(state.operation, np.array([0]))
    match = re.fullmatch(
        r"balls 3 are thrown off a race above (\d+) rpm at this \w+ "
        r"\(states again, with gaps, from (\d+) to (\d+) rpm\)",
        word,
    )
    assert match, word
    first, again, last = (float(n) for n in match.groups())
    assert first < again < last < state.speed[0] / RPM


def test_balls_that_are_solved(monkeypatch: pytest.MonkeyPatch) -> None:
    """Axial load solves exactly one ball; the least aside solves all of them."""
    widths: set[int] = set()
    whole = linearise

    def counted(problem: Any, *state: Any) -> Any:
        widths.add(problem.assembly.balls)
        return whole(problem, *state)

    for caller in (equilibrium, followed_stage):
        monkeypatch.setattr(caller, "linearise", counted)
    VEX70.equilibrium(load=[1000.0, 0, 0, 0, 0], speed=FAST, compiled=False)
    VEX70.equilibrium(displacement=[20e-6, 0, 0, 0, 0], speed=[0.0, FAST], compiled=False)
    assert widths == {1}
    VEX70.equilibrium(load=[1000.0, 1.0, 0, 0, 0], speed=FAST, compiled=False)
    assert widths == {1, VEX70.balls}


def test_what_was_given_is_named() -> None:
    """The speed that is searched for belongs to the same load, displacement, or both."""
    move = np.zeros((300, 5))
    move[:, 0] = np.linspace(0.0, -100e-6, 300)
    how = dict(speed=24000.0 * RPM, kinematics="inner", moment_sharing="inner")
    state = VEX70.equilibrium(displacement=move, **how)
    lost = int(np.flatnonzero(state.outcome == "no equilibrium")[0])
    with pytest.raises(NoEquilibrium, match=r"above \d+ rpm at this displacement"):
        VEX70.equilibrium(displacement=move[lost], **how)
    mixed = dict(load=[None, 0.0, 0.0, 0.0, 0.0], displacement=[move[lost, 0], *[None] * 4])
    with pytest.raises(NoEquilibrium, match=r"above \d+ rpm at this load and displacement"):
        VEX70.equilibrium(**mixed, **how)


def test_contacts_beyond_the_groove_and_both_races_slipping() -> None:
    state = rings.draw_states(17).only(7).solve()
    angle = np.maximum(np.abs(state.inner_angle), np.abs(state.outer_angle))[0]
    wide = np.flatnonzero((angle > np.pi / 2.0) & (state.inner_load[0] > 0.0))
    assert words_of(state)[0].startswith(f"beyond the groove (balls {wide[0]}–{wide[-1]})")
    both = VEX70.equilibrium(load=[900.0, 0, 0, 0, 0], speed=FAST, friction=0.002)
    assert (both.slipping != "").all()


def test_light_and_absurd_loads_at_rest() -> None:
    """A millinewton is found; what no groove holds is not called a lack of load."""
    light = VEX70.equilibrium(
        load=[[1e-3, 3e-4, 0, 0, 0], [1e-3, 2e-3, 0, 0, 0], [0, 0.1, 0.01, 0, 0]]
    )
    assert (light.outcome == "").all()
    assert light.residual.max() < 1e-10
    with pytest.raises(NoEquilibrium, match="is the unit right"):
        VEX70.equilibrium(load=[1e9, 0, 0, 0, 0])


def test_nothing_presses_a_ring_that_may_retreat() -> None:
    with pytest.raises(NoEquilibrium, match="unloaded"):
        VEX70.equilibrium(load=[0, 0, 0, None, None], displacement=[None, None, None, 0, 0])


def test_remedies_of_a_four_point_bearing_are_a_list_without_clauses() -> None:
    state = four_point(R24_14).equilibrium(load=[20e3, 0, 0, 0, 0], speed=10.0, kinematics="inner")
    *_, look, last = condition.remedy(state).split(", ")
    assert look == 'look at dynamics "frozen" (it counts the contacts of every ball)'
    assert last == "give a limit of friction or use outer or hybrid kinematics"


def test_the_error_travels_and_names_what_helps() -> None:
    ask = dict(load=[60.0, 20.0, 0, 0, 0], speed=FAST, kinematics="inner", moment_sharing="inner")
    with pytest.raises(NoEquilibrium) as caught:
        VEX70.equilibrium(**ask)
    again = pickle.loads(pickle.dumps(caught.value))
    assert str(again) == str(caught.value)
    assert again.remedy.endswith("give a limit of friction or use outer or hybrid kinematics")
    folding = {name: value for name, value in FOLDING.items() if name != "bearing"}
    with pytest.raises(NoEquilibrium) as limited:
        HARRIS_218.equilibrium(**folding)
    assert "limit" not in limited.value.remedy


@pytest.mark.parametrize("kinematics", ["inner", "geometric"])
def test_a_start_decides_nothing(kinematics: str) -> None:
    """Where two branches exist a neighbour is no start."""
    speed, load = 13500.0 * RPM, np.array([[70.0, 29.0, 0, 0, 0]])
    how = dict(speed=speed, kinematics=kinematics)
    heavier = VEX70.equilibrium(load=1.3 * load, **how)
    cold, warm = (
        VEX70.equilibrium(load=load, **how),
        VEX70.equilibrium(load=load, start=heavier, **how),
    )
    assert (cold.outcome == warm.outcome).all()
    assert np.array_equal(cold.inner_load, warm.inner_load, equal_nan=True)


def test_residual_is_reported() -> None:
    loads = np.outer([100.0, 1000.0, 10000.0], [1.0, 0.3, 0.1, 0.001, 0.0])
    state = VEX70.equilibrium(load=loads, speed=FAST)
    assert (state.residual < 1e-11).all()
    assert state.residual.shape == (3,)


def test_balls_that_the_inner_race_lifts() -> None:
    """A ring moved by more than the gap of the groove centres reaches around some balls."""
    far = [-1.4e-5, -1.9e-4, -2.7e-4, 0.028, 0.020]
    bearing = AngularContactBallBearing(
        ball_diameter=5e-3,
        pitch_diameter=18e-3,
        balls=8,
        contact_angle=math.radians(34.0),
        inner_conformity=0.507,
        outer_conformity=0.543,
    )
    message = "the inner race lifts balls off the outer race .*: displace the ring less$"
    with pytest.raises(NoEquilibrium, match=message):
        bearing.equilibrium(displacement=far, speed=3000.0, dynamics="frozen")
