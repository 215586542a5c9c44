"""The dynamic preload state: conventions at rest, limits, symmetries, stops."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from bearings.ball.law import Law
from bearings.ring.compiled import states
from bearings.ring.iterate import Iterate
from rotordyn.machine.growth import PrescribedShortening
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.sleeve import Spring
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.network import Network
from rotordyn.preload.state import PreloadState
from rotordyn.preload.together import dynamic_preload
from tests.oracles.spindles import RPM, TOP, mfw2310, with_sleeve, with_springs

LAW = Law("outer", "equal")
OPEN = with_sleeve(mfw2310(), "front", stop_travel=math.inf)


def state(spindle: Spindle, rpm: Any, force: float = 0.0) -> PreloadState:
    return dynamic_preload(spindle, np.atleast_1d(np.asarray(rpm, float)) * RPM, LAW, force)


def loads(found: PreloadState) -> np.ndarray:
    return found.net.response.load


def test_rest_is_what_the_springs_state() -> None:
    found = state(mfw2310(), [0.0])
    assert loads(found)[0] == pytest.approx([551, 574, 264], rel=1e-10)
    assert found.shift[0] == pytest.approx(0.0, abs=1e-14)
    assert found.spring_force[0] == pytest.approx([574, 528], rel=1e-10)
    assert found.rest_loads() == pytest.approx([551, 574, 264], rel=1e-10)


def test_every_body_is_balanced() -> None:
    """Shaft: F − ΣFx s = 0; sleeve: its spring, its stop and its bearings."""
    found = state(mfw2310(), [0, 12000, 24000], 150.0)
    f1, f2, f3 = loads(found).T
    assert 2 * f1 - f2 - 2 * f3 == pytest.approx(150.0, abs=1e-7)
    carried = found.spring_force + found.stop_force
    assert carried == pytest.approx(np.stack([f2, 2 * f3], axis=1), rel=1e-9)
    assert (found.stop_force[:, 0] > 0).tolist() == found.net.held[:, 1].tolist()


def test_one_speed_alone_is_the_same_as_in_a_sweep() -> None:
    rpm = np.array([0, 3000, 9000, 15000, 20000, 21000, 24000])
    sweep = state(mfw2310(), rpm)
    for k, n in enumerate(rpm):
        alone = state(mfw2310(), n)
        assert loads(alone)[0] == pytest.approx(loads(sweep)[k], rel=1e-9)
        assert alone.shift[0] == pytest.approx(sweep.shift[k], abs=1e-14)


def test_order_of_speeds_does_not_matter() -> None:
    rpm = np.array([24000, 0, 20000, 6000, 21000])
    mixed, sorted_ = state(mfw2310(), rpm), state(mfw2310(), np.sort(rpm))
    assert loads(mixed)[np.argsort(rpm)] == pytest.approx(loads(sorted_), rel=1e-9)
    assert (mixed.net.held[np.argsort(rpm)] == sorted_.net.held).all()


def test_sense_of_rotation_does_not_matter() -> None:
    assert loads(state(OPEN, -18000)) == pytest.approx(loads(state(OPEN, 18000)), rel=1e-9)


def test_mirrored_spindle_shifts_the_other_way() -> None:
    """x → −x with thrusts reversed: same loads, opposite shifts, stop at the same speed."""
    ours = mfw2310()
    seats = tuple(replace(s, x=-s.x, thrust=-s.thrust) for s in ours.seats)
    rule = ours.shortening
    other = replace(
        ours,
        shaft=Shaft(-ours.shaft.end, ours.shaft.sections[::-1]),
        seats=seats,
        shortening=PrescribedShortening(rule.speed, {n: -v for n, v in rule.shift.items()}),
        masses=(),
        points={},
    )
    rpm = [0, 12000, 24000]
    a, b = state(ours, rpm, 80.0), state(other, rpm, -80.0)
    assert loads(b) == pytest.approx(loads(a), rel=1e-9)
    assert b.shift == pytest.approx(-a.shift, abs=1e-14)
    assert b.spring_force == pytest.approx(a.spring_force, rel=1e-9)
    assert b.stop_force == pytest.approx(a.stop_force, rel=1e-9, abs=1e-6)
    assert b.stop_speeds()[0] == pytest.approx(a.stop_speeds()[0], rel=1e-9)


def test_rigid_preload_is_the_limit_of_stiff_springs() -> None:
    """The error of springs of finite stiffness K falls with 1/K."""
    limit = loads(state(with_springs(mfw2310(), math.inf), 18000))[0]
    gaps = [
        np.abs(loads(state(with_springs(mfw2310(), k), 18000))[0] - limit).max()
        for k in (1e10, 1e11, 1e12)
    ]
    assert np.array(gaps[:-1]) / np.array(gaps[1:]) == pytest.approx(10.0, rel=0.1)
    assert gaps[-1] < 1e-3 * limit.max()


def test_rigid_sleeves_do_not_move_and_carry_what_bearings_ask() -> None:
    found = state(with_springs(mfw2310(), math.inf), [0, 18000])
    assert found.shift[:, 1:] == pytest.approx(0.0, abs=1e-18)
    assert found.spring_force[0] == pytest.approx([574, 528], rel=1e-9)
    carried = np.stack([loads(found)[1, 1], 2 * loads(found)[1, 2]])
    assert found.spring_force[1] == pytest.approx(carried, rel=1e-9)


def test_soft_springs_keep_their_force() -> None:
    """Constant-force springs: loads do not change with speed."""
    found = state(with_springs(mfw2310(), 1e2), [0, 18000])
    assert loads(found)[1] == pytest.approx(loads(found)[0], rel=1e-4)


def test_force_on_the_shaft_is_shared_by_stiffness() -> None:
    """A small force towards +x loads position 1 and unloads 2 and 3, as their tangents say."""
    base, pushed = state(mfw2310(), 6000), state(mfw2310(), 6000, 1.0)
    k1, k2, k3 = base.net.response.slope[0] * base.network.tandem
    series = [1 / (1 / k2 + 1 / 6.20e6), 1 / (1 / k3 + 1 / 5.49e6)]
    total = k1 + sum(series)
    change = (loads(pushed) - loads(base))[0] * base.network.tandem
    expected = [k1 / total, -series[0] / total, -series[1] / total]
    assert change == pytest.approx(expected, rel=1e-3)
    assert (pushed.shift - base.shift)[0, 0] == pytest.approx(1.0 / total, rel=1e-3)


def test_springs_are_set_without_external_force() -> None:
    """A force moves the bodies from there and changes what the bearings carry at rest."""
    pushed = state(mfw2310(), 0.0, 200.0)
    assert state(mfw2310(), 0.0).rest_loads() == pytest.approx([551, 574, 264], rel=1e-10)
    assert pushed.rest_loads() == pytest.approx(loads(pushed)[0], rel=1e-9)
    assert pushed.shift[0, 0] > 0.0
    assert 2 * loads(pushed)[0, 0] - loads(pushed)[0, 1] - 2 * loads(pushed)[0, 2] == (
        pytest.approx(200.0, rel=1e-9)
    )


def test_stop_speed_agrees_with_bisection_by_plain_runs() -> None:
    found = state(mfw2310(), np.arange(0, 24001, 2000)).stop_speeds()
    low, high = 16000.0, 24000.0
    for _ in range(24):
        middle = 0.5 * (low + high)
        reached = state(OPEN, middle).shift[0, 1] <= -52.2e-6
        low, high = (low, middle) if reached else (middle, high)
    assert found[0] / RPM == pytest.approx(low, rel=1e-6)
    assert np.isnan(found[1])


@pytest.mark.parametrize("step", [24000, 12000, 500])
def test_stop_speed_does_not_depend_on_the_speeds_asked(step: int) -> None:
    found = state(mfw2310(), np.arange(0, 24001, step)).stop_speeds()[0]
    assert found / RPM == pytest.approx(20401.56, rel=1e-5)


@pytest.mark.parametrize(
    ("preload", "stiffness", "travel", "top"),
    [(50.0, 1e6, 5e-6, 24000), (200.0, 1e6, 2e-6, 12000), (200.0, 5e6, 4.5e-5, 24000)],
)
def test_stop_speeds_of_two_stops_from_few_speeds(
    preload: float, stiffness: float, travel: float, top: int
) -> None:
    """Two speeds tell the same as sixty; each stop is met with the other one as it then is."""
    soft = mfw2310(
        sleeves=tuple(
            replace(s, spring=Spring(preload, stiffness), stop_travel=travel)
            for s in mfw2310().sleeves
        )
    )
    fine = state(soft, np.linspace(0, top, 61)).stop_speeds()
    assert state(soft, [0, top]).stop_speeds() == pytest.approx(fine, rel=1e-4)


def test_stop_is_closed_exactly_where_the_open_sleeve_would_overrun() -> None:
    rpm = np.array([20390, 20400, 20403, 20410])
    found = state(mfw2310(), rpm)
    beyond = state(OPEN, rpm).shift[:, 1] < -52.2e-6
    assert found.net.held[:, 1].tolist() == beyond.tolist() == [False, False, True, True]
    assert found.shift[2:, 1] == pytest.approx(-52.2e-6, rel=1e-12)


def test_stop_force_grows_from_zero() -> None:
    force = state(mfw2310(), [20402, 20500, 22000, 24000]).stop_force[:, 0]
    assert 0.0 < force[0] < 1.0
    assert (np.diff(force) > 0).all()


def test_both_stops_may_close() -> None:
    both = with_sleeve(with_sleeve(mfw2310(), "front", stop_travel=20e-6), "rear", stop_travel=4e-5)
    found = state(both, [0, 24000])
    assert found.net.held.tolist() == [[False, False, False], [False, True, True]]
    assert (found.stop_force[1] > 0.0).all()
    assert found.usable.all()


def test_stop_without_travel_holds_the_sleeve_from_the_first_speed() -> None:
    tight = with_sleeve(mfw2310(), "front", stop_travel=0.0)
    found = state(tight, [6000, 12000])
    assert found.net.held[:, 1].all()
    assert found.shift[:, 1] == pytest.approx(0.0, abs=1e-15)


def test_second_speed_of_contact_is_found_with_force() -> None:
    """A pull on the shaft moves the speed at which the stop is reached."""
    rpm = np.arange(0, 24001, 2000)
    plain, pulled = (state(mfw2310(), rpm, f).stop_speeds()[0] for f in (0.0, -100.0))
    assert abs(plain - pulled) > 20 * RPM


def test_seat_states_are_in_the_order_of_the_seats() -> None:
    found = state(mfw2310(), [0, TOP / RPM])
    assert found.seat_stiffness().shape == (2, 5, 5, 5)
    assert found.seat_growth()[1] == pytest.approx([50.5e-6] * 5)
    k = found.seat_stiffness()[:, :, 0, 0]
    assert (k[:, 0] == k[:, 1]).all()
    assert (k[:, 3] == k[:, 4]).all()
    assert (k[:, 1] != k[:, 2]).all()
    balls = [s.inner_load.shape[-1] for s, _ in found.seat_states()]
    assert balls == [25, 25, 25, 21, 21]


def test_pulled_shaft_unloads_the_front_pair_at_rest() -> None:
    found = state(mfw2310(), [0, 6000], -3000.0)
    assert found.usable.all()
    assert loads(found)[0, 0] == 0.0
    assert (loads(found)[0, 1:] > 0.0).all()
    assert (loads(found)[1] > 0.0).all()
    assert (found.seat_stiffness()[0, :2] == 0.0).all()


def test_lost_preload_names_bearing_speed_and_remedy() -> None:
    """Seats that shift further than the rear spring can follow (528 N / 5.49 N/µm = 96.2 µm)."""
    far = PrescribedShortening(6000 * RPM, {"d": 300e-6, "e": 300e-6})
    found = state(mfw2310(shortening=far), [0, 3000, 6000])
    assert found.usable.tolist() == [True, True, False]
    assert "bearing d, e is unloaded at 6000 rpm" in found.outcome[2]
    assert found.outcome[2].endswith("raise the preload")
    assert found.spring_force[2, 1] == pytest.approx(0.0, abs=1e-6)
    assert found.shift[2, 2] == pytest.approx(528 / 5.49e6, rel=1e-9)


def test_spring_without_preload_leaves_its_bearing_unloaded_at_rest() -> None:
    idle = with_sleeve(mfw2310(), "front", spring=replace(mfw2310().sleeves[0].spring, preload=0.0))
    found = state(idle, [0, 12000])
    assert found.usable.tolist() == [False, True]
    assert "bearing c is unloaded at 0 rpm" in found.outcome[0]


def test_overloaded_bearing_is_named() -> None:
    heavy = with_sleeve(
        mfw2310(), "front", spring=replace(mfw2310().sleeves[0].spring, preload=3e6)
    )
    found = state(heavy, [0.0])
    first = next(of for of in found.net.response.states.values() if 0 in of.places)
    peak = float(first.state.contact_pressure[0, list(first.places).index(0)].max())
    assert 10e9 < peak < 100e9
    assert "bearing a, b is overloaded" in found.outcome[0]
    assert f"peak pressure {peak / 1e9:.1f} GPa, at most 10 GPa" in found.outcome[0]


def test_no_preload_at_all_is_an_outcome() -> None:
    nothing = tuple(replace(s, spring=replace(s.spring, preload=0.0)) for s in mfw2310().sleeves)
    found = state(mfw2310(sleeves=nothing), [0, 12000])
    assert not found.usable[0]
    assert "no bearing is preloaded at 0 rpm" in found.outcome[0]


def test_without_a_sleeve_nothing_presses_bearings() -> None:
    found = state(mfw2310(sleeves=()), [0])
    assert "and no sleeve preloads any: put one on a sleeve" in found.outcome[0]
    assert "springs a preload" not in found.outcome[0]


def test_bearings_between_shaft_and_housing_only() -> None:
    """Without sleeves nothing preloads; a force loads one direction, rotation both."""
    found = state(mfw2310(sleeves=()), [0, 12000], 500.0)
    assert found.usable.all()
    assert loads(found)[0] == pytest.approx([250.0, 0.0, 0.0], rel=1e-9)
    assert 2 * loads(found)[1, 0] - loads(found)[1, 1] - 2 * loads(found)[1, 2] == (
        pytest.approx(500.0, rel=1e-9)
    )
    assert found.spring_force.shape == found.stop_force.shape == (2, 0)


def test_balls_moved_with_the_bodies_or_solved_at_every_move(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The same states and stop speeds where no ball is ever taken to follow."""
    rpm = np.arange(0, 24001, 3000)
    together = state(mfw2310(), rpm, 50.0)
    speeds = together.stop_speeds()
    monkeypatch.setattr(Iterate, "follows", lambda one, _: np.zeros(one.error.shape, dtype=bool))
    alone = state(mfw2310(), rpm, 50.0)
    assert loads(together) == pytest.approx(loads(alone), rel=1e-9)
    assert together.shift == pytest.approx(alone.shift, rel=1e-9, abs=1e-15)
    assert (together.net.held == alone.net.held).all()
    assert speeds == pytest.approx(alone.stop_speeds(), rel=1e-9, nan_ok=True)


@pytest.mark.parametrize(("compiled", "count"), [(False, 4), (True, 2)])
def test_bearings_are_seldom_solved_by_themselves(
    monkeypatch: pytest.MonkeyPatch, compiled: bool, count: int
) -> None:
    """Under their likely loads to seat them, to confirm the answer, and to start at rest and at
    speed where nothing is compiled; at speed balls come into balance with the network, though a
    stop closes on the way."""
    monkeypatch.setattr(states, "loaded", lambda kind: compiled)
    solves = []
    solve = Network.solve_bearings
    monkeypatch.setattr(
        Network, "solve_bearings", lambda *a, **k: (solves.append(1), solve(*a, **k))[1]
    )
    found = state(mfw2310(), np.arange(0, 24001, 3000))
    assert found.net.held.any()
    assert len(solves) == count
    found.rest_loads()
    assert len(solves) == count


@pytest.mark.parametrize("travel", [45e-6, 80e-6])
def test_other_travels_are_those_of_a_spindle_that_has_them(travel: float) -> None:
    index = np.array([1, 3])
    found = state(mfw2310(), [0, 12000, 18000, 24000]).with_travels({"front": travel}, index)
    expected = state(with_sleeve(mfw2310(), "front", stop_travel=travel), [12000, 24000])
    assert found.spindle == expected.spindle
    assert loads(found) == pytest.approx(loads(expected), rel=1e-9)
    assert found.shift == pytest.approx(expected.shift, rel=1e-9, abs=1e-15)
    assert (found.net.held == expected.net.held).all()
    assert found.outcome == expected.outcome


def test_forces_on_bodies_are_those_of_springs_bearings_and_friction() -> None:
    """Towards +x; a spring takes its stiffness of a shift, friction is added unchanged."""
    found = state(mfw2310(), [0, 12000])
    there, response = found.net.position, found.net.response
    rubbed = np.array([[0.0, 10.0, -3.0], [0.0, -20.0, 5.0]])
    plain, rubbing = found.network, replace(found.network, friction=rubbed)
    assert rubbing.forces(there, response) - plain.forces(there, response) == pytest.approx(rubbed)
    moved = np.array([0.0, 1e-6, -2e-6])
    pulled = plain.forces(there + moved, response) - plain.forces(there, response)
    stiffness = np.array([0.0, *(sleeve.spring.stiffness for sleeve in mfw2310().sleeves)])
    assert pulled == pytest.approx(np.tile(-stiffness * moved, (2, 1)), rel=1e-6)
    pushed = replace(plain.arrangement, force=plain.arrangement.force + 70.0)
    more = replace(plain, arrangement=pushed).forces(there, response)
    assert more - plain.forces(there, response) == pytest.approx(np.tile([70.0, 0.0, 0.0], (2, 1)))
