"""With the centrifugal force frozen a bearing is a convex problem, whatever its kind.

The potential of contacts and loads falls at every step of the search, and the state does not depend
on where the search starts, whether all motions of the ring are held or not.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any
from unittest import mock

import numpy as np
import pytest
from numpy.typing import NDArray

from bearings import BallBearing, DeepGrooveBallBearing
from bearings.ring import convex_stage
from tests.oracles import known_grooves
from tests.oracles.groove_balance import balanced
from tests.oracles.known_bearings import RPM
from tests.oracles.random_kinds import KINDS, Asked, draw

Array = NDArray[np.float64]
SMALL = DeepGrooveBallBearing(8e-3, 40e-3, 9, radial_clearance=10e-6)
R20_10 = known_grooves.four_point(known_grooves.R20_10)


def _potential(problem: Any, energy: Array, displacement: Array) -> Array:
    """Contacts less the work of the load (states,) [J]."""
    return np.asarray(energy - (problem.load * displacement)[:, problem.free].sum(axis=-1))


@pytest.mark.parametrize("kind", KINDS)
def test_the_potential_falls_at_every_step(kind: str) -> None:
    steps: list[float] = []
    search = convex_stage._searched

    def watched(problem: Any, d: Array, now: Any, step: Array) -> Any:
        before = _potential(problem, now.energy, d)
        after = search(problem, d, now, step)
        change = _potential(problem, after[1].energy, after[0]) - before
        steps.extend(change / (np.abs(before) + np.abs(change) + 1e-300))
        return after

    batched = mock.patch("bearings.ring.request.pays", return_value=False)
    with batched, mock.patch.object(convex_stage, "_searched", watched):
        for number in range(6):
            asked = replace(draw(kind, number, 20), dynamics="frozen")
            solved = asked.solve().outcome == ""
            assert solved.mean() > (0.8 if kind == "thrust" else 0.999)  # some throw balls out
    assert len(steps) > 100
    assert max(steps) < 1e-11  # rounding of a sum
    assert np.median(steps) < -1e-9


@pytest.mark.parametrize("draws", [2, pytest.param(50, marks=pytest.mark.long)])
@pytest.mark.parametrize("kind", KINDS)
def test_the_state_does_not_depend_on_the_start(kind: str, draws: int) -> None:
    """Of 1000 states of each kind among the long tests."""
    for number in range(draws):
        asked = replace(draw(kind, number, 20), dynamics="frozen")
        cold, warm = asked.solve(), asked.solve(asked.rolled().solve())
        assert (warm.outcome == cold.outcome).all()
        largest = np.abs(cold.contact_load).max(axis=(1, 2))
        apart = np.abs(warm.contact_load - cold.contact_load).max(axis=(1, 2))
        solved = cold.outcome == ""
        assert (apart[solved] <= 1e-6 * largest[solved]).all()


@pytest.mark.parametrize("compiled", [False, True])
def test_a_ring_tilted_far_finds_its_way_from_rest(compiled: bool) -> None:
    """Balls opposite the load end on the straight wall beyond 90°, pressed along the axis alone."""
    asked = draw("four point", 312, 50)
    near, one = _alone(asked, 3), _alone(asked, 4)
    cold = mock.patch("bearings.ring.request.pays", return_value=compiled)
    with cold:
        there = one.solve()
    assert there.outcome.tolist() == [""]
    # 93° on a groove that were a circle throughout; the normal of a straight wall stays at 90°
    assert np.degrees(np.abs(there.inner_angle)).max() == pytest.approx(90.0, abs=1e-9)
    loaded = there.inner_load > 0.0
    assert (np.abs(there.inner_angle[loaded]) == math.pi / 2.0).any()
    warm = one.solve(near.solve())
    assert there.contact_load == pytest.approx(warm.contact_load, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("compiled", [False, True])
@pytest.mark.parametrize(
    ("kind", "number", "place", "times"),
    [
        ("four point", 3, 3, 10.0),  # balls between two straight walls, where Fc finds no hold
        ("four point", 6, 1, 10.0),
        (
            "four point",
            28,
            0,
            10.0,
        ),  # far behind the level of the inner groove, free of it at first
        ("deep groove", 26, 3, 30.0),
        ("deep groove", 40, 1, 30.0),
        ("deep groove", 55, 0, 30.0),  # level with the far half of the circle of the outer groove
    ],
)
def test_a_ring_displaced_far_has_a_state(
    kind: str, number: int, place: int, times: float, compiled: bool
) -> None:
    """At a given displacement every ball has one place, on its outer race wherever the ring is."""
    asked = _alone(draw(kind, number, 4), place)
    far = replace(
        asked,
        free=np.zeros(5, dtype=bool),
        displacement=times * asked.displacement,
        dynamics="frozen",
    )
    with mock.patch("bearings.ring.request.pays", return_value=compiled):
        there = far.solve()
    assert there.outcome.tolist() == [""]
    assert np.degrees(np.abs(there.inner_angle)).max() == pytest.approx(90.0, abs=1e-6)
    assert there.outer_load.min() >= 0.999 * there.centrifugal_force.min() > 0.0
    fault = balanced(asked.oracle, there, "frozen", asked.shift)
    assert max(fault.ball[0], fault.ring[0], fault.motion[0]) < 1e-9
    assert fault.gap[0] < 1e-9 * asked.oracle.drawing.ball_diameter


@pytest.mark.few(1)
@pytest.mark.parametrize(("number", "place"), [(938, 38), (1052, 30), (1938, 18)])
def test_no_state_is_lost_by_a_start_that_leads_astray(number: int, place: int) -> None:
    """Of 100 000 random states those three that were lost with another start."""
    asked = draw("four point", number, 50)
    cold, astray = _alone(asked, place).solve(), _alone(asked.rolled(), place).solve()
    warm = _alone(asked, place).solve(astray)
    assert warm.outcome.tolist() == cold.outcome.tolist() == [""]
    assert warm.contact_load == pytest.approx(cold.contact_load, rel=1e-6, abs=1e-6)


def _alone(asked: Asked, place: int) -> Asked:
    parts = {n: getattr(asked, n)[[place]] for n in ("load", "displacement", "speed")}
    return replace(asked, **parts)


@pytest.mark.few(5)
@pytest.mark.parametrize("speed", [0.0, 0.2, 200.0, 8000.0 * RPM])
@pytest.mark.parametrize("dynamics", ["frozen", "resultant"])
@pytest.mark.parametrize("bearing", [SMALL, R20_10], ids=["deep groove", "four point"])
def test_a_load_that_one_ball_carries_has_a_state(
    bearing: BallBearing, dynamics: str, speed: float
) -> None:
    """Nothing holds the ring across that ball; its load is met all the same."""
    load = np.array([0.0, 10.0, 0.0, 0.0, 0.0])
    s = bearing.equilibrium(load=load, speed=speed, dynamics=dynamics)
    assert (s.inner_load > 0.0).sum() == 1
    again = bearing.equilibrium(displacement=s.displacement, speed=speed, dynamics=dynamics)
    assert again.load == pytest.approx(load, abs=1e-7)


@pytest.mark.parametrize("speed", [0.0, 500.0])
def test_a_centred_ring_rests_under_no_load(speed: float) -> None:
    """With play nothing presses a ball; pressed at rest, the loads cancel by symmetry."""
    loose = SMALL.equilibrium(load=np.zeros(5), speed=speed)
    tight = replace(SMALL, radial_clearance=-5e-6).equilibrium(load=np.zeros(5), speed=speed)
    for s in (loose, tight):
        assert s.displacement == pytest.approx(0.0, abs=1e-15)
    assert not loose.inner_load.any()
    assert tight.inner_load.min() > 1.0
