"""Preload with bearings that take thrust both ways: play, loads of either sign, laws by seat."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from bearings import BallBearing, DeepGrooveBallBearing, FourPointBallBearing
from bearings.ball.law import Law
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.sleeve import Sleeve, Spring
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.state import PreloadState
from rotordyn.preload.together import dynamic_preload
from tests.oracles.known_bearings import VEX70
from tests.oracles.known_grooves import QJ218, four_point
from tests.oracles.spindles import RPM, mfw2310

LAW = Law("outer", "equal")
DEEP_GROOVE = DeepGrooveBallBearing(0.0103, 0.0775, 13, radial_clearance=15e-6)
PRESSED = replace(DEEP_GROOVE, radial_clearance=-5e-6)
FOUR_POINT = FourPointBallBearing(0.0103, 0.0775, 13, axial_play=60e-6, inner_shim=5e-5)
FIXED: dict[str, BallBearing] = {"deep groove": DEEP_GROOVE, "four point": FOUR_POINT}
PRELOAD, SOFT = 500.0, 5e6
SPEEDS = (0.0, 6000.0, 12000.0)


def spindle(seats: list[BearingSeat], *sprung: str, preload: float = PRELOAD) -> Spindle:
    sleeve = Sleeve("sleeve", sprung, Spring(preload, SOFT))
    return mfw2310(seats=tuple(seats), sleeves=(sleeve,), shortening=None)


def sprung_set(thrust: int, fixed: BallBearing = DEEP_GROOVE) -> Spindle:
    """Two angular-contact bearings on a spring, and one that takes their push in the housing."""
    seats = [BearingSeat("a", VEX70, 0.03, thrust), BearingSeat("b", VEX70, 0.05, thrust)]
    return spindle([*seats, BearingSeat("rear", fixed, 0.38)], "a", "b")


def state(machine: Spindle, rpm: Any = SPEEDS, force: float = 0.0, law: Law = LAW) -> PreloadState:
    return dynamic_preload(machine, np.atleast_1d(np.asarray(rpm, float)) * RPM, law, force)


@pytest.mark.parametrize("kind", FIXED)
@pytest.mark.parametrize("thrust", [1, -1])
@pytest.mark.parametrize("force", [0.0, 250.0, -250.0])
def test_the_fixed_bearing_takes_what_the_spring_and_the_force_leave(
    thrust: int, force: float, kind: str
) -> None:
    """Shaft: F = s (Fa + Fb) + Fr; sleeve: its spring carries Fa + Fb."""
    found = state(sprung_set(thrust, FIXED[kind]), force=force)
    assert found.outcome == ("",) * 3
    front, rear = found.seat_load()[:, :2].sum(axis=1), found.seat_load()[:, 2]
    assert thrust * front + rear == pytest.approx(force, abs=1e-7)
    assert found.spring_force[:, 0] == pytest.approx(front, rel=1e-9)
    assert found.spring_force[:, 0] == pytest.approx(
        PRELOAD + SOFT * thrust * found.shift[:, 1], rel=1e-9
    )
    assert (rear * thrust < 0.0).all()
    shaft = found.net.position[:, 0]
    assert np.sign(shaft).tolist() == np.sign(rear).tolist()


@pytest.mark.parametrize("kind", FIXED)
def test_at_rest_every_bearing_is_where_it_is_alone_under_its_load(kind: str) -> None:
    bearing = FIXED[kind]
    found = state(sprung_set(1, bearing), 0.0)
    alone = bearing.equilibrium(load=[-PRELOAD, 0.0, 0.0, 0.0, 0.0])
    assert found.seat_load()[0] == pytest.approx([PRELOAD / 2, PRELOAD / 2, -PRELOAD], rel=1e-9)
    assert found.rest[0] == pytest.approx(alone.displacement[0], rel=1e-6)


@pytest.mark.parametrize("kind", FIXED)
def test_a_mirrored_spindle_gives_mirrored_answers(kind: str) -> None:
    one = state(sprung_set(1, FIXED[kind]), force=200.0)
    other = state(sprung_set(-1, FIXED[kind]), force=-200.0)
    assert other.net.position == pytest.approx(-one.net.position, rel=1e-6)
    assert other.seat_load()[:, :2] == pytest.approx(one.seat_load()[:, :2], rel=1e-7)
    assert other.seat_load()[:, 2] == pytest.approx(-one.seat_load()[:, 2], rel=1e-7)
    assert other.rest_loads() == pytest.approx(one.rest_loads() * [1.0, -1.0], rel=1e-7)


def test_thrust_of_a_bearing_that_takes_it_both_ways_is_a_name_for_its_sign() -> None:
    machine = sprung_set(1)
    turned = replace(machine, seats=(*machine.seats[:2], replace(machine.seats[2], thrust=-1)))
    one, other = state(machine), state(turned)
    assert other.net.position == pytest.approx(one.net.position, rel=1e-9)
    assert other.seat_load()[:, 2] == pytest.approx(-one.seat_load()[:, 2], rel=1e-9)


@pytest.mark.parametrize("thrust", [1, -1])
def test_a_force_may_unload_a_bearing_beside_one_that_takes_it_whatever_its_sign(
    thrust: int,
) -> None:
    """Against the locked set the shaft leans on the fixed bearing alone."""
    seats = [BearingSeat("a", VEX70, 0.03, 1), BearingSeat("rear", DEEP_GROOVE, 0.38, thrust)]
    locked = Sleeve("sleeve", ("a",), Spring(PRELOAD))
    machine = mfw2310(seats=tuple(seats), sleeves=(locked,), shortening=None)
    found = state(machine, 0.0, -3000.0)
    assert found.seat_load()[0] == pytest.approx([0.0, -3000.0 * thrust], rel=1e-9, abs=1e-6)
    assert found.outcome == ("",)


def test_a_force_pushes_the_shaft_through_the_play() -> None:
    """In the play the balance is that of spring and force alone; beyond it the load turns round."""
    machine = sprung_set(1)
    play = 2.0 * DEEP_GROOVE.grooves.free_distance * math.sin(DEEP_GROOVE.free_angle)
    forces = (500.0, 700.0, 2000.0)
    before, within, after = (state(machine, 0.0, force) for force in forces)
    assert before.seat_load()[0, 2] < 0.0 < after.seat_load()[0, 2]
    assert within.seat_load()[0, 2] == 0.0
    assert "rear is within its clearance at 0 rpm" in within.outcome[0]
    assert "even if other parts restrain the shaft" in within.outcome[0]
    assert "or give the loads across the axis (gravity, loads)" in within.outcome[0]
    assert within.spring_force[0, 0] == pytest.approx(700.0, rel=1e-9)
    assert abs(within.net.position[0, 0]) < play / 2.0
    assert after.outcome == ("",)
    assert after.net.position[0, 0] - before.net.position[0, 0] > play
    assert after.seat_load()[0].sum() == pytest.approx(2000.0, rel=1e-9)


@pytest.mark.parametrize("force", [200.0, -200.0])
def test_a_force_alone_takes_the_shaft_to_the_end_of_the_play(force: float) -> None:
    """Nothing but the bearing holds the shaft, and within its play that does not either."""
    machine = mfw2310(seats=(BearingSeat("f", DEEP_GROOVE, 0.03),), sleeves=(), shortening=None)
    found = state(machine, 0.0, force)
    alone = DEEP_GROOVE.equilibrium(load=[force, 0.0, 0.0, 0.0, 0.0])
    assert found.seat_load()[0] == pytest.approx([force], rel=1e-9)
    assert found.net.position[0] == pytest.approx(alone.displacement[:1], rel=1e-6)


def test_stiffness_along_the_axis_is_that_of_the_parts() -> None:
    """Dx/dF of the shaft: the fixed bearing beside spring and front set in series."""
    machine, step = sprung_set(1), 1.0
    low, high = (state(machine, 0.0, force) for force in (-step, step))
    middle = state(machine, 0.0)
    front, _, rear = middle.seat_stiffness()[0, :, 0, 0]
    together = rear + 1.0 / (1.0 / SOFT + 1.0 / (2.0 * front))
    moved = (high.net.position - low.net.position)[0, 0] / (2.0 * step)
    assert moved == pytest.approx(1.0 / together, rel=1e-4)


def test_two_deep_groove_bearings_on_a_wave_spring() -> None:
    """The spring's push goes through both; a force on the shaft changes the fixed one most."""
    seats = [BearingSeat("f", DEEP_GROOVE, 0.03), BearingSeat("r", DEEP_GROOVE, 0.38, -1)]
    machine = spindle(seats, "r", preload=300.0)
    assert state(machine).seat_load()[0] == pytest.approx([300.0, 300.0], rel=1e-9)
    pushed = state(machine, force=200.0).seat_load()
    assert pushed[:, 0] - pushed[:, 1] == pytest.approx(200.0, abs=1e-7)
    assert (pushed[:, 0] > 400.0).all()


def test_a_bearing_within_its_play_is_no_support() -> None:
    """A preloaded pair beside it leaves it in its middle; without play it holds, load or not."""
    seats = [BearingSeat("a", VEX70, 0.03, 1), BearingSeat("b", VEX70, 0.08, -1)]
    loose = state(spindle([*seats, BearingSeat("rear", DEEP_GROOVE, 0.38)], "a"))
    assert all("rear is within its clearance" in word for word in loose.outcome)
    assert loose.seat_load()[:, 2].tolist() == [0.0, 0.0, 0.0]
    held = state(spindle([*seats, BearingSeat("rear", PRESSED, 0.38)], "a"))
    assert held.outcome == ("",) * 3
    assert (held.seat_stiffness()[:, 2, 1, 1] > 1e7).all()


@pytest.mark.parametrize("clearance", [15e-6, 0.0])
def test_the_bearing_that_its_own_clearance_does_not_press_is_named(clearance: float) -> None:
    """Beside one that is pressed at rest, whatever its kind, without sleeves and forces."""
    loose = replace(DEEP_GROOVE, radial_clearance=clearance)
    pair = (four_point(QJ218, radial_play=-10e-6), PRESSED)
    for kind in pair:
        seats = (BearingSeat("front", kind, 0.03), BearingSeat("rear", loose, 0.38))
        found = state(mfw2310(seats=seats, sleeves=(), shortening=None), SPEEDS[:2])
        assert all("rear is within its clearance at" in word for word in found.outcome)
    both = (BearingSeat("a", pair[0], 0.03), BearingSeat("b", pair[1], 0.38))
    assert state(mfw2310(seats=both, sleeves=(), shortening=None), 0.0).outcome == ("",)


def test_a_speed_alone_is_the_same_as_in_a_sweep() -> None:
    sweep = state(sprung_set(1), force=300.0)
    for k, rpm in enumerate(SPEEDS):
        alone = state(sprung_set(1), rpm, 300.0)
        assert alone.seat_load()[0] == pytest.approx(sweep.seat_load()[k], rel=1e-8)


def test_each_seat_is_solved_under_its_law() -> None:
    """Alike bearings under unlike laws are not solved together, and each as it is alone."""
    machine = sprung_set(1)
    first = replace(machine.seats[0], kinematics="inner", moment_sharing="inner", friction=0.2)
    found = state(replace(machine, seats=(first, *machine.seats[1:])), 9000.0)
    assert len(found.network.arrangement.bearings) == 3
    laws = (Law("inner", "inner", 0.2), LAW, LAW)
    for k, ((solved, column), law) in enumerate(zip(found.seat_states(), laws, strict=True)):
        alone = machine.seats[k].bearing.equilibrium(
            displacement=solved.displacement[0, column],
            speed=9000.0 * RPM,
            kinematics=law.kinematics,
            moment_sharing=law.moment_sharing,
            friction=law.friction,
        )
        assert found.seat_load()[0, k] == pytest.approx(alone.load[0], rel=1e-9)
    assert found.seat_load()[0, 0] != pytest.approx(found.seat_load()[0, 1], rel=1e-4)


@pytest.mark.parametrize("shim", [1e-6, 5e-5])
def test_a_shim_too_small_for_two_arcs_is_reported(shim: float) -> None:
    small = FourPointBallBearing(
        0.0103, 0.0775, 13, contact_angle=math.radians(25.0), inner_shim=shim
    )
    found = state(sprung_set(1, small), (6000.0, 12000.0)).small_shims()
    if shim < 1e-5:
        (word,) = found
        said = "bearing rear: an arc presses beyond the middle of its groove, first at 6000 rpm;"
        assert word.startswith(said)
    else:
        assert not found
