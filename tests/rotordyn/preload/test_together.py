"""Machines solved together, against each solved alone."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from bearings.ball.law import Law
from rotordyn.case.vary import changed
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import BearingTemperatures, Temperatures
from rotordyn.preload.arrangement import arrangement, side_by_side
from rotordyn.preload.state import PreloadState
from rotordyn.preload.together import Asked, dynamic_preload, dynamic_preloads
from tests.oracles.spindles import RPM, case, mfw2310, with_sleeve, with_springs

LAW = Law("outer", "equal")
SPEED = np.array([0.0, 6000.0, 12000.0, 18000.0, 24000.0]) * RPM
LOST = with_sleeve(mfw2310(), "rear", spring=replace(mfw2310().sleeves[1].spring, preload=0.0))


def asked(spindles: Sequence[Spindle], **how: object) -> list[Asked]:
    return [Asked(spindle, SPEED, LAW, **how) for spindle in spindles]


def varied(count: int, seed: int) -> list[Spindle]:
    """Springs, stops and the shaft between the bearings of the flagship at random."""
    draw, whole = np.random.default_rng(seed), case()
    widest = max(whole.spindle.shaft.sections, key=lambda section: section.length)
    diameter = f"spindle.shaft.sections.{widest.name}.outer_diameter"
    machines = []
    for _ in range(count):
        values = {diameter: widest.outer_diameter * draw.uniform(0.9, 1.02)}
        for sleeve in whole.spindle.sleeves:
            way = f"spindle.sleeves.{sleeve.name}"
            values[f"{way}.spring.preload"] = sleeve.spring.preload * draw.uniform(0.3, 2.0)
            values[f"{way}.spring.stiffness"] = sleeve.spring.stiffness * draw.uniform(0.5, 2.0)
        values["spindle.sleeves.front.stop_travel"] = draw.uniform(20e-6, 90e-6)
        machines.append(changed(whole, values).spindle)
    return machines


def same(one: PreloadState, other: PreloadState) -> None:
    assert one.outcome == other.outcome
    assert np.array_equal(one.net.held, other.net.held)
    assert np.array_equal(one.net.converged, other.net.converged)
    assert one.net.position == pytest.approx(other.net.position, abs=1e-17, nan_ok=True)
    for name in ("seat_load", "seat_stiffness", "rest_loads", "stop_speeds"):
        here, there = getattr(one, name)(), getattr(other, name)()
        assert here == pytest.approx(there, rel=1e-10, abs=1e-3, nan_ok=True)
    assert one.limit == pytest.approx(other.limit, rel=1e-12, nan_ok=True)


@pytest.mark.parametrize("force", [0.0, 150.0])
def test_many_are_as_each_alone(force: float) -> None:
    machines = asked(varied(7, 1), force=force)
    found = dynamic_preloads(machines)
    assert len({state.net.held.sum() for state in found}) > 1
    assert np.isfinite([state.stop_speeds() for state in found]).any()
    for state, machine in zip(found, machines, strict=True):
        same(state, dynamic_preload(machine.spindle, SPEED, LAW, force))


def test_one_without_a_state_at_rest_leaves_the_others_theirs() -> None:
    one, other = varied(2, 2)
    found = dynamic_preloads(asked([one, LOST, other]))
    assert found[1].outcome[0].startswith("bearing d, e is unloaded at 0 rpm")
    for state, spindle in zip(found, (one, LOST, other), strict=True):
        same(state, dynamic_preload(spindle, SPEED, LAW))


def test_machines_that_are_built_otherwise_are_groups_of_their_own() -> None:
    """In the order requested: rigid preload, no sleeves, another bearing, other speeds."""
    fewer = replace(mfw2310().seats[0].bearing, balls=15)
    seats = tuple(replace(seat, bearing=fewer) for seat in mfw2310().seats[:2])
    others = [
        with_springs(mfw2310(), math.inf),
        mfw2310(sleeves=()),
        mfw2310(seats=(*seats, *mfw2310().seats[2:])),
    ]
    machines = asked([*varied(2, 3), *others])
    machines.insert(1, Asked(mfw2310(), SPEED[:2], LAW))
    for state, machine in zip(dynamic_preloads(machines), machines, strict=True):
        same(state, dynamic_preload(machine.spindle, machine.speed, LAW))


def test_what_is_asked_afterwards_is_solved_for_all_and_is_that_of_each() -> None:
    machines, index = varied(3, 4), np.array([1, 4])
    for state, spindle in zip(dynamic_preloads(asked(machines)), machines, strict=True):
        alone = dynamic_preload(spindle, SPEED, LAW)
        for travel in (15e-6, 30e-6):
            short, expected = (
                each.with_travels({"front": travel}, index) for each in (state, alone)
            )
            assert short.net.held.any()
            assert short.seat_load() == pytest.approx(expected.seat_load(), rel=1e-10)
            assert short.outcome == expected.outcome
        for one, other in zip(
            state.under_rest_loads([0, 2]), alone.under_rest_loads([0, 2]), strict=True
        ):
            assert one.places == other.places
            assert one.state.displacement == pytest.approx(other.state.displacement, rel=1e-9)


def test_a_machine_without_any_preload_does_not_disturb() -> None:
    """Its bearings have no load at rest."""
    one, none = varied(1, 5)[0], LOST
    none = with_sleeve(none, "front", spring=replace(none.sleeves[0].spring, preload=0.0))
    found = dynamic_preloads(asked([none, one]))
    assert np.isnan(found[0].rest_loads()).all()
    same(found[1], dynamic_preload(one, SPEED, LAW))
    alone = dynamic_preload(one, SPEED, LAW).under_rest_loads([0, 1, 2])
    for held, other in zip(found[1].under_rest_loads([0, 1, 2]), alone, strict=True):
        assert held.state.displacement == pytest.approx(other.state.displacement, rel=1e-9)


@pytest.mark.parametrize("backwards", [False, True])
def test_machines_whose_bearings_are_alike_at_rest_alone_keep_their_own(backwards: bool) -> None:
    """A stop that is closed at rest is looked for at rest, where the shaft is not shortened and
    bearings are alike that are not so at speed."""
    whole = case("grinding_spindle")
    speed = np.array([0.0, 5000.0, 10000.0, 15000.0]) * RPM
    travels = np.array([0.0, 1e-6, 2e-6, 5e-6, 8e-6, 15e-6])
    machines = [
        Asked(changed(whole, {"spindle.sleeves.rear.stop_travel": t}).spindle, speed, LAW, -500.0)
        for t in (travels[::-1] if backwards else travels)
    ]
    found = [state.stop_speeds() for state in dynamic_preloads(machines)]
    alone = [dynamic_preload(*machine).stop_speeds() for machine in machines]
    assert np.ptp(np.array(found)[:, 0]) > 100.0
    assert np.array(found) == pytest.approx(np.array(alone), rel=1e-9, nan_ok=True)


def test_machines_built_otherwise_are_never_joined() -> None:
    one, other = (arrangement(s, SPEED) for s in (mfw2310(), mfw2310(sleeves=())))
    with pytest.raises(AssertionError, match="of different structure"):
        side_by_side([one, other])


def test_other_travels_at_unlike_numbers_of_speeds() -> None:
    machines = [Asked(s, SPEED[:n], LAW) for s, n in zip(varied(3, 6), (2, 5, 3), strict=True)]
    last = np.array([-1])
    for state, machine in zip(dynamic_preloads(machines), machines, strict=True):
        found = state.with_travels({"front": 20e-6}, last)
        alone = dynamic_preload(*machine).with_travels({"front": 20e-6}, last)
        assert found.seat_load() == pytest.approx(alone.seat_load(), rel=1e-10)


def test_stops_are_met_by_bearings_that_are_alike_at_the_speeds_of_the_case_alone() -> None:
    """The hot ring of d between two speeds is felt where the stop is met there."""
    ring = BearingTemperatures((20.0, 80.0, 20.0), (20.0,) * 3, (20.0,) * 3)
    speeds = (0.0, 10000.0 * RPM, 20000.0 * RPM)
    warm = Temperatures(shaft=20.0, speeds=speeds, bearings={"d": ring})
    machine = with_sleeve(mfw2310(shortening=None), "rear", stop_travel=3e-6)
    coarse, fine = (
        dynamic_preload(machine, np.array(at), LAW, 0.0, warm) for at in (speeds[::2], speeds)
    )
    assert len(coarse.network.arrangement.bearings) == 3
    assert coarse.stop_speeds()[1] == pytest.approx(fine.stop_speeds()[1], rel=1e-9)
