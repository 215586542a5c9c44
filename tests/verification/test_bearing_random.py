"""A small part of the survey of random bearings (benchmarks/random_bearings), always the same."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from bearings import STEEL, AngularContactBallBearing
from benchmarks.bearing.path_steps import fast_states
from benchmarks.random_bearings import balls, paths, rings, starts
from benchmarks.random_bearings.judged import judged
from tests.oracles.ball_bearing import race
from tests.oracles.ball_equations import contact
from tests.oracles.known_bearings import HARRIS_218, VEX70
from tests.oracles.plain_newton import plain_newton
from tests.oracles.wide_tangent import DIGITS


@pytest.mark.parametrize("bearing", [VEX70, HARRIS_218], ids=["VEX70", "218"])
@pytest.mark.parametrize("side", [1, -1])
def test_the_survey_judges_by_contacts_of_its_own(bearing: Any, side: int) -> None:
    """Elliptic integrals by SciPy against those by quadrature."""
    found, expected = contact(bearing, side), race(bearing, side)
    assert found.k == pytest.approx(expected.k, rel=1e-9)
    assert found.torque == pytest.approx(expected.a1 * expected.e, rel=1e-9)


def test_random_balls_balance_in_equations_of_their_own() -> None:
    found = balls.survey_balls(4000)
    assert found["states"] == 4000
    assert found["not finite"] == found["tensile"] == 0
    assert found["residual above 1e-9"] == found["not closed"] == 0
    assert found["worst"]["force"] < 1e-10
    assert found["worst"]["gap"] < 1e-13
    assert found["no equilibrium, hybrid"] + found["no equilibrium, outer"] <= 5  # of 2000: folds
    assert found["below 5 GPa"] > 0.8 * found["solved"]


def test_plain_newton_finds_other_roots() -> None:
    """Signed contacts: a fifth of the states ends at a root that pulls, or nowhere."""
    drawn, centre, speed = balls.draw_balls(20, 2000)
    state = balls.solve_balls(drawn, centre, speed)
    u, done = plain_newton(drawn.equations, centre, speed, signed=True)
    pulls = done & (u[2:] < 0.0).any(axis=0)
    assert 0.05 < pulls.mean() < 0.5
    held = done & ~pulls & (state.status[:, 0] == "loaded") & (speed > 0.0)
    apart = np.hypot(*(u[:2] - state.ball_centre[..., 0]))
    assert np.median(apart[held]) < 1e-12


def test_random_bearings_balance_and_their_tangents_equal_differences() -> None:
    found = rings.survey_rings(350)
    for name in ("not finite", "tensile", "not closed", "not as asked"):
        assert found[name] == 0
    assert found["ball residual above 1e-9"] == found["ring residual above 1e-9"] == 0
    assert found["at rest"] > 5
    assert found["worst"]["asymmetry at rest"] < 1e-10
    assert found["tangents"] > 40
    assert found["worst"]["tangent"] < 1e-6


@pytest.mark.long
def test_refused_paths_end_and_solved_paths_arrive() -> None:
    found = paths.survey_ball_paths(5, 5)
    assert found["odd"] == []
    assert found["refused, agreed"] == found["solved, agreed"] == 5


def test_a_bearing_path_arrives_where_the_solver_is() -> None:
    found = paths.survey_ring_paths(1, 1)
    assert found["odd"] == []


@pytest.mark.few(1)
@pytest.mark.parametrize("compiled", [False, True])
@pytest.mark.parametrize(("number", "index"), [(10014, 6), (10007, 2)], ids=["twelfth", "7e-4"])
def test_a_path_ends_where_a_contact_opens_with_a_jump(
    number: int, index: int, compiled: bool
) -> None:
    """By that part of the load, which a stride of the path would step over."""
    asked = rings.draw_states(number)
    path = paths.ring_path(asked, index)
    assert path.end == "jump"
    assert path.changes == 1
    assert asked.solve(compiled=compiled).outcome[index] == "no equilibrium"


@pytest.mark.long
def test_a_contact_that_opens_under_outer_control_ends_no_path() -> None:
    """The moment fades with the load; two balls lose their inner race on the way."""
    asked, index = rings.draw_states(10049), 1
    path = paths.ring_path(asked, index)
    assert path.end == "arrived"
    assert path.changes == 2


@pytest.mark.long
def test_a_ring_that_two_balls_hold_moves_on_to_the_next() -> None:
    """On the way nothing resists one direction of the ring; an independent path arrives there."""
    asked, index = rings.draw_states(10056), 34
    state = asked.solve()
    assert state.outcome[index] == ""
    path = paths.ring_path(asked, index)
    assert path.end == "arrived"
    deep = (state.outer_load[index].max() / asked.drawn.equations.outer.k) ** (2.0 / 3.0)
    assert np.abs(path.x - state.ball_centre[:, index]).max() < 1e-6 * deep


@pytest.mark.long
@pytest.mark.parametrize("compiled", [False, True])
def test_a_fold_of_a_soft_ring_is_not_stepped_over(compiled: bool) -> None:
    """Beyond it, by Newton steps turning an angle by 7° there and back, lies another state."""
    asked, index = fast_states(164), 28
    assert paths.ring_path(asked, index).end == "fold"
    assert asked.solve(compiled=compiled).outcome[index] == "no equilibrium"


@pytest.mark.long
def test_a_ball_that_fades_is_met_again_from_the_other_side() -> None:
    """Of three balls two hold the ring, which moves on about them."""
    asked, index = fast_states(152), 46
    state, path = asked.solve(), paths.ring_path(asked, index)
    assert path.end == "arrived"
    assert path.changes == 2
    assert state.outcome[index] == ""
    deep = (state.outer_load[index].max() / asked.drawn.equations.outer.k) ** (2.0 / 3.0)
    assert np.abs(path.x - state.ball_centre[:, index]).max() < 1e-5 * deep


def test_the_start_decides_nothing() -> None:
    found = starts.survey_starts(100)
    assert found["states"] == 100
    assert found["odd"] == []


def test_a_ball_held_by_the_centrifugal_force_far_from_the_bottom_of_its_groove() -> None:
    """It starts deep in the inner race, climbs far up the outer one, and is found all the same."""
    bearing = AngularContactBallBearing(
        ball_diameter=10e-3,
        pitch_diameter=60e-3,
        balls=12,
        contact_angle=math.radians(40.0),
        inner_conformity=0.51,
        outer_conformity=0.54,
        ball_material=STEEL,
    )
    move = np.outer([-150e-6, -100e-6, -50e-6, -10e-6], [1.0, 0.0, 0.0, 0.0, 0.0])
    state = bearing.equilibrium(displacement=move, speed=1500.0, growth=-5e-5, kinematics="outer")
    assert (state.outcome == "").all()
    assert (state.inner_load > 0.0).all()
    assert (np.diff(state.inner_angle[:, 0]) < 0.0).all()


@pytest.mark.parametrize("number", [23, 66, 156])
def test_balls_that_carry_less_than_the_lengths_resolve(number: int) -> None:
    """Millinewtons and less: loads balance although the approach is known to some digits only."""
    drawn, centre, speed = balls.draw_balls(number)
    state = balls.solve_balls(drawn, centre, speed)
    good = np.flatnonzero(state.outcome == "")
    found = judged(drawn.equations, state, good, centre[:, good, None])
    top = np.maximum(state.inner_load, state.outer_load)[good, :1]
    assert (np.abs(found.fault).max(axis=0) <= 1e-10 * top).all()
    assert found.gap.max() < 1e-13


def _flagged(state: Any, asked: rings.Asked) -> Counter[str]:
    tally: Counter[str] = Counter()
    good = np.flatnonzero(state.outcome == "")
    rings._balanced(tally, Counter(), asked, state, good)
    return tally


@pytest.mark.parametrize(
    ("name", "change", "seen"),
    [
        ("inner_load", lambda q: q * (1.0 + 1e-7), "ball residual above 1e-9"),
        ("outer_load", lambda q: q * (1.0 + 1e-7), "ball residual above 1e-9"),
        ("inner_angle", lambda a: a + 1e-7, "ball residual above 1e-9"),
        ("outer_angle", lambda a: a + 1e-7, "ball residual above 1e-9"),
        ("outer_angle", lambda a: a + 1e-11, "not closed"),
        ("displacement", lambda d: d + 1e-13, "not closed"),
        ("ball_centre", lambda x: x * (1.0 + 1e-11), "not closed"),
        ("load", lambda f: f * (1.0 + 1e-8), "ring residual above 1e-9"),
    ],
)
def test_the_judge_sees_what_is_wrong(name: str, change: Any, seen: str) -> None:
    """Every state of which one part is off, by little."""
    asked = rings.draw_states(12)  # by displacement
    state = asked.solve()
    good, right = int((state.outcome == "").sum()), _flagged(state, asked)
    assert good > 20
    assert right["not as asked"] == right[seen] == 0
    wrong = replace(state, **{name: change(getattr(state, name))})
    assert _flagged(wrong, asked)[seen] > 0.9 * good


def test_the_judge_sees_loads_that_balance_each_other_but_not_the_geometry() -> None:
    """At rest every multiple of all loads is in balance."""
    asked = replace(rings.draw_states(12), speed=np.zeros(rings.EACH))
    state = asked.solve()
    more = 1.0 + 1e-6
    wrong = replace(
        state,
        inner_load=more * state.inner_load,
        outer_load=more * state.outer_load,
        load=more * state.load,
    )
    tally = _flagged(wrong, asked)
    assert tally["ball residual above 1e-9"] == tally["ring residual above 1e-9"] == 0
    assert _flagged(state, asked)["not closed"] == 0
    assert tally["not closed"] == (state.inner_load > 0.0).any(axis=-1).sum() > 20


@pytest.mark.parametrize(("number", "index"), [(440, 38), (620, 25), (1916, 33)])
def test_tangents_of_balls_under_millinewtons_equal_differences(number: int, index: int) -> None:
    """K is a thousandth of a contact's and less; also in more digits."""
    asked = rings.draw_states(number)
    state, tally, worst = asked.solve(), Counter(), Counter()
    rings.tangent_errors(tally, worst, asked, state, np.array([index]))
    assert worst["tangent"] < 1e-6
    assert tally["tangents decided in extended precision"] == 0
    k = state.complete_stiffness[index] / asked.lever / asked.lever[:, None]
    if DIGITS:
        assert np.abs(rings._wide(asked, state, index) - k).max() < 1e-6 * np.abs(k).max()


@pytest.mark.skipif(not DIGITS, reason="longdouble has the digits of double here")
def test_more_digits_decide_where_differences_disagree(monkeypatch: pytest.MonkeyPatch) -> None:
    """A difference that is off condemns no K that is right; a K that is off is found."""
    asked, chosen = rings.draw_states(440), np.array([38])
    state = asked.solve()
    off = replace(state, complete_stiffness=state.complete_stiffness * (1.0 + 4e-6))
    tally: Counter[str] = Counter()
    rings.tangent_errors(tally, Counter(), asked, off, chosen)
    assert tally["tangents off by more than 1e-6"] == 1
    whole = rings._differences
    monkeypatch.setattr(rings, "_differences", lambda *ask: (1.0 + 4e-6) * whole(*ask))
    tally.clear()
    rings.tangent_errors(tally, Counter(), asked, state, chosen)
    assert tally["tangents decided in extended precision"] == 1
    assert tally["tangents off by more than 1e-6"] == 0


@pytest.mark.long
def test_differences_with_more_digits_agree_with_the_solver() -> None:
    """Under ordinary loads."""
    asked = rings.draw_states(22)
    state = asked.solve()
    k = state.complete_stiffness / asked.lever / asked.lever[:, None]
    some = np.flatnonzero((asked.speed > 0.0) & (state.inner_load.min(axis=1) > 1.0))
    assert some.size > 5
    for i in some:
        apart = np.abs(rings._wide(asked, state, i) - k[i]).max()
        assert apart < 1e-7 * np.abs(k[i]).max()
