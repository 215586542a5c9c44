"""Spindles at the edge: lost contact, almost vanishing preloads and springs (docs/stress.md)."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from bearings.ball.law import Law
from rotordyn.analyses.axial_cycle.solve import solve as cycle_answer
from rotordyn.analyses.axial_cycle.spec import AxialCycleSpec
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.preload.spec import PreloadSpec
from rotordyn.errors import InvalidInput
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import BearingTemperatures, Temperatures
from rotordyn.preload.state import PreloadState
from rotordyn.preload.together import dynamic_preload
from rotordyn.scene.loads import PointLoad
from rotordyn.scene.scene import Scene
from tests.oracles.spindles import (
    RPM,
    TOP,
    answers,
    case,
    conditions,
    mfw2310,
    pairs,
    scene,
    system_of,
    undamped,
)

LAW = Law("outer", "equal")
STILL = np.zeros(1)


def preloaded(preload: float) -> Spindle:
    """The flagship with the same preload on both sleeves [N]."""
    spindle = mfw2310()
    sleeves = (replace(s, spring=replace(s.spring, preload=preload)) for s in spindle.sleeves)
    return replace(spindle, sleeves=tuple(sleeves))


def on_sleeves(**changes: float) -> Spindle:
    spindle = mfw2310()
    return replace(spindle, sleeves=tuple(replace(s, **changes) for s in spindle.sleeves))


def at_rest(force: float) -> PreloadState:
    return dynamic_preload(mfw2310(), STILL, LAW, force)


def test_a_million_rpm_is_named_and_leaves_the_rest_as_it_is() -> None:
    """Beyond its bearings by far: no state there, every answer at rest as if alone."""
    asked = {
        "preload": PreloadSpec(),
        "campbell": CampbellSpec(2000.0, shapes=False),
        "frf": FrfSpec((100.0, 700.0), pairs("Oc2.y/Oc2.y")),
    }
    both, alone = (answers(mfw2310(), rpm, asked) for rpm in ((0, 1_000_000), (0,)))
    for name, result in both.items():
        assert "no equilibrium at 1000000 rpm" in result.outcome[1], name
        assert result.outcome[0] == ""
    assert both["frf"].receptance[0] == pytest.approx(alone["frf"].receptance[0], rel=1e-3)
    assert both["campbell"].frequency[0] == pytest.approx(alone["campbell"].frequency[0], rel=1e-4)
    assert np.isnan(both["frf"].receptance[1]).all()


@pytest.mark.long
@pytest.mark.parametrize("way", [1.0, -1.0])
def test_edge_of_lost_contact(way: float) -> None:
    """Up to the force that takes the last load off a bearing all is finite, and beyond it.

    The bearing lost is the one whose load falls to nothing, in proportion to none of its rivals.
    """
    inside, outside = 0.0, way * 1e5
    for _ in range(30):
        middle = 0.5 * (inside + outside)
        lost = (at_rest(middle).seat_load() <= 0.0).any()
        inside, outside = (inside, middle) if lost else (middle, outside)
    edge, beyond = at_rest(inside), at_rest(outside)
    load = edge.seat_load()[0]
    assert (load > 0.0).all()
    assert load.min() < 1e-3 * load.max()
    assert np.isfinite(edge.seat_stiffness()).all()
    assert load.argmin() == beyond.seat_load()[0].argmin()
    assert beyond.seat_load()[0].min() == 0.0
    scene = Scene(mfw2310(), conditions(axial_force=inside), STILL, 500.0)
    assert np.isfinite(system_of(scene).modes.pole).all()


@pytest.mark.long
def test_past_unloading_the_state_goes_on() -> None:
    """Against the axial cycle, which follows forces on its own; and as under a faint load across
    the axis, with which every bearing is solved in its five DOF."""
    rpm, forces = [0.0, 12000.0, 24000.0], (-12e3, 90e3)
    cycle = cycle_answer(scene(mfw2310(), rpm), AxialCycleSpec(*forces, 1))
    across = PointLoad(at="Oc2", Fy=1e-6)
    for place, force in enumerate(forces):
        plain = scene(mfw2310(), rpm, axial_force=force)
        faint = scene(mfw2310(), rpm, axial_force=force, loads=(across,))
        assert plain.preload.outcome == ("",) * 3
        load = plain.preload.seat_load()
        assert (load[0] == 0.0).sum() >= 2
        assert load == pytest.approx(cycle.axial_load[:, 0, place], rel=1e-6, abs=1e-3)
        assert plain.preload.shift == pytest.approx(cycle.position[:, 0, place], abs=1e-10)
        assert load == pytest.approx(faint.preload.seat_load(), rel=1e-6, abs=1e-3)
        stiff = np.sqrt(np.einsum("sbii->sbi", plain.tangents))
        scale = stiff[..., :, None] * stiff[..., None, :]
        assert (np.abs(plain.tangents - faint.tangents) <= 1e-6 * scale).all()
        assert np.isfinite(system_of(plain).modes.pole).all()
        slack = [seat.name for seat, one in zip(mfw2310().seats, load[0], strict=True) if one == 0]
        told = [w.split(": ")[0] for w in plain.warnings if ": static loads unload" in w]
        names = [name for words in told for name in re.split(r"[ ,]+", words)]
        assert {*slack} <= {*names}, plain.warnings


def test_stops_that_only_a_large_force_needs() -> None:
    """With the stop open the balance lies far past it, on the way to which bearings come loose."""
    spindle = mfw2310()
    for force in (-1.4e4, -5e4):
        found = at_rest(force)
        assert found.outcome == ("",)
        assert found.net.held[0, 1]
        load = found.seat_load()[0]
        thrust = np.array([seat.thrust for seat in spindle.seats])
        assert float(thrust @ load) == pytest.approx(force, rel=1e-8)
    (word,) = dynamic_preload(on_sleeves(stop_travel=math.inf), STILL, LAW, -1.4e4).outcome
    assert word.startswith("the loads push bearing a, b apart at 0 rpm")


def test_balls_do_not_press_on_the_side_that_takes_no_thrust() -> None:
    """Alone along the axis, and with a faint load across it."""
    spindle = on_sleeves(stop_travel=math.inf)
    for loads in ((), (PointLoad(at="Oc2", Fy=1e-6),)):
        acting = conditions(axial_force=-1.4e4, axial_stiffening=False, loads=loads)
        (word,) = Scene(spindle, acting, STILL).preload.outcome
        assert "apart at 0 rpm" in word
        assert word.endswith("lower the loads, or give the sleeves end stops")


def test_soft_springs_carry_what_unloads_the_bearings_before_them() -> None:
    """Loads fall by more than the imbalance on the way: both springs give way by as much."""
    spindle = case("mfw2310_rigid_or_sprung").variants["sprung"].spindle
    assert spindle is not None
    found = dynamic_preload(spindle, np.array([0.0, 5841.0, 12000.0]) * RPM, LAW, -4367.55)
    assert found.outcome == ("",) * 3
    thrust = np.array([seat.thrust for seat in spindle.seats])
    assert found.seat_load() @ thrust == pytest.approx(np.full(3, -4367.55), rel=1e-8)
    assert found.seat_load()[:, :2] == pytest.approx(0.0)
    travel = -found.network.arrangement.direction * found.shift
    stiffness = [sleeve.spring.stiffness for sleeve in spindle.sleeves]
    force = found.seat_load()[:, 2], found.seat_load()[:, 3:].sum(axis=1)
    for k, sleeve in enumerate(spindle.sleeves):
        pressed = sleeve.spring.preload + stiffness[k] * travel[:, k + 1]
        assert pressed == pytest.approx(force[k], rel=1e-6)


@pytest.mark.parametrize("force", [1.0, 500.0])
def test_a_force_takes_the_shaft_through_the_gap_that_heat_has_left(force: float) -> None:
    """Either way as far: cold rings take away the preload of a mirrored pair."""
    found = case("preload_concepts").variants["back_to_back"].spindle
    assert found is not None
    cold = BearingTemperatures(inner_ring=10.0, outer_ring=30.0, balls=10.0)
    warm = Temperatures(
        shaft=30.0, housing=20.0, bearings={seat.name: cold for seat in found.seats}
    )
    ways = [dynamic_preload(found, STILL, LAW, way * force, warm) for way in (1.0, -1.0)]
    assert [state.outcome for state in ways] == [("",)] * 2
    assert ways[0].seat_load()[0] == pytest.approx([force, 0.0])
    assert ways[1].seat_load()[0] == pytest.approx([0.0, force])
    (lost,) = dynamic_preload(found, STILL, LAW, 0.0, warm).outcome
    assert "preload lost" in lost


@pytest.mark.few(2)
@pytest.mark.parametrize("preload", [5e-324, 1e-5, 1e-2, 0.04])
def test_next_to_no_preload_is_none(preload: float) -> None:
    found = dynamic_preload(preloaded(preload), STILL, LAW)
    given = f"give the springs a preload of 0.05 N or more: given {preload:.3g} N"
    assert found.outcome == (f"no bearing is preloaded at 0 rpm: {given}",)


@pytest.mark.parametrize("preload", [0.1, 30.0])
def test_preload_at_rest_is_what_is_stated(preload: float) -> None:
    """Each of a tandem pair carries half; the tangent goes with the cube root of the load."""
    found = dynamic_preload(preloaded(preload), STILL, LAW)
    assert found.outcome == ("",)
    thrust = np.array([seat.thrust for seat in mfw2310().seats])
    load = found.seat_load()[0]
    assert abs(float(thrust @ load)) < 1e-9 * load.max()
    assert found.spring_force[0] == pytest.approx(preload, rel=1e-9)
    if preload < 1.0:
        stiffer = dynamic_preload(preloaded(8.0 * preload), STILL, LAW)
        rate = stiffer.seat_stiffness()[0, :, 0, 0] / found.seat_stiffness()[0, :, 0, 0]
        assert rate == pytest.approx(2.0, rel=0.01)


def test_more_preload_than_contacts_bear_is_named() -> None:
    (word,) = dynamic_preload(preloaded(1e7), STILL, LAW).outcome
    assert "overloaded at 0 rpm" in word
    assert "lower its preload" in word


@pytest.mark.parametrize("stiffness", [5e-324, 1e-9])
def test_a_spring_of_next_to_no_stiffness_keeps_its_force(stiffness: float) -> None:
    spindle = mfw2310()
    soft = replace(
        spindle,
        sleeves=tuple(
            replace(s, spring=replace(s.spring, stiffness=stiffness), stop_travel=math.inf)
            for s in spindle.sleeves
        ),
    )
    found = dynamic_preload(soft, np.array([0.0, TOP]), LAW)
    assert found.outcome == ("", "")
    stated = [s.spring.preload for s in spindle.sleeves]
    assert found.spring_force == pytest.approx(np.array([stated, stated]), rel=1e-9)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"mass": 1e-300}, "mass: out of range: given 1e-300 kg; allowed: 0, or from 1e-12 kg"),
        ({"radial_stiffness": 1e-300}, "radial_stiffness: out of range: given 1e-300 N/m"),
    ],
)
def test_sleeves_beyond_sense_are_refused(changes: dict[str, float], said: str) -> None:
    with pytest.raises(InvalidInput, match=said) as refused:
        on_sleeves(**changes)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ({"radial_stiffness": 1e12}, {}),
        ({"radial_stiffness": 1e6, "mass": 1e-12}, {"radial_stiffness": 1e6}),
        ({"radial_stiffness": 1.0}, {"radial_stiffness": 1.0, "mass": 1e-6}),
    ],
    ids=["rigid", "weightless", "not held"],
)
def test_sleeves_at_the_ends_of_their_range(one: dict[str, float], other: dict[str, float]) -> None:
    """Next to rigid, next to weightless, next to free: as without."""
    found = []
    for changes in (one, other):
        scene = Scene(undamped(on_sleeves(**changes)), conditions(), STILL, 2000.0)
        pole = np.sort(np.abs(system_of(scene).modes.pole[0].imag))
        found.append(pole[pole > 1.0][:8])
    assert found[0] == pytest.approx(found[1], rel=2e-4)


@pytest.mark.parametrize("travel", [5e-324, 1e-15])
def test_stops_without_travel_are_rigid_preload(travel: float) -> None:
    """From the first speed the sleeve is at its stop, or the bearings alone determine the load."""
    found = dynamic_preload(on_sleeves(stop_travel=travel), np.array([0.0, 6000.0 * RPM]), LAW)
    nought = dynamic_preload(on_sleeves(stop_travel=0.0), np.array([0.0, 6000.0 * RPM]), LAW)
    assert found.outcome == ("", "")
    assert found.seat_load() == pytest.approx(nought.seat_load(), rel=1e-6)
