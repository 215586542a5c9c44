"""Shaft and sleeves with dry friction: all forces at once, and followed from event to event."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rotordyn
from rotordyn.errors import NoSolution
from rotordyn.machine.temperatures import Temperatures
from rotordyn.preload import axial_curves, play
from rotordyn.preload.friction import operating_state
from rotordyn.preload.history import history
from rotordyn.preload.play import axial_run_up
from rotordyn.scene.scene import Scene
from rotordyn.study.identification.along_axis import RPM

FRONT, REAR = "spindle.sleeves.front.", "spindle.sleeves.rear."
MACHINES = {
    "as identified": {FRONT + "friction": 80.9},
    "both sleeves rub": {FRONT + "friction": 150.0, REAR + "friction": 40.0},
    "no friction, no stop": {FRONT + "stop_travel": np.inf},
    "rear sleeve locked": {FRONT + "friction": 60.0, REAR + "spring.stiffness": np.inf},
    "stops both ways": {FRONT + "stop_travel": 20e-6, REAR + "stop_travel": 45e-6},
}


CONDITIONS = {
    "free": {},
    "under a force": {"conditions.axial_force": -400.0},
    "upright, warm, under a force": {
        "conditions.gravity": "-x",
        "conditions.axial_force": 900.0,
        "conditions.temperatures.housing": 30.0,
        "conditions.temperatures.shaft": 36.0,
    },
}


@pytest.mark.few(4)
@pytest.mark.parametrize("under", CONDITIONS)
@pytest.mark.parametrize("name", MACHINES)
def test_same_path_as_event_by_event(name: str, under: str) -> None:
    case = rotordyn.vary(rotordyn.load("mfw2310"), MACHINES[name] | CONDITIONS[under])
    speed = np.array([4000.0, 20000.0]) * RPM
    scene = Scene(case.spindle, case.conditions, speed)
    path = history(scene.preload, 1900.0)
    force = np.linspace(-1800.0, 1500.0, 7)
    temperatures, weight = case.conditions.temperatures, scene.past.weight
    found = axial_run_up(
        scene.grounded, scene.law, speed, scene.axial_force, temperatures, weight=weight
    )
    rest = path.run_up()
    for row, start in enumerate(rest):
        assert not isinstance(start, str)
        from_mounted = found.standstill - found.mounted
        assert start.x == pytest.approx(found.shift[row] + from_mounted, abs=2e-9)
        *_, top = path.loaded(row, start, [force[-1], force[0], force[-1]])
        falling = path.loaded(row, top, force[-2::-1].tolist(), path.under(row, force[-1]))
        rising = path.loaded(row, falling[-1], force[1:].tolist(), path.under(row, force[0]))
        branches = found.cycle(row, force[::-1], force)
        for states, shifts in zip(([top, *falling], [falling[-1], *rising]), branches, strict=True):
            positions = np.array([state.x for state in states])
            assert positions == pytest.approx(shifts + from_mounted, abs=2e-9)  # of up to 100 µm


@pytest.mark.parametrize("friction", [60.0, 400.0])
def test_runs_up_on_ways_whose_temperatures_turn(friction: float) -> None:
    """As event by event, whatever other speeds there are."""
    speed = np.array([2000.0, 9000.0, 12000.0]) * RPM
    warm = Temperatures(shaft=(20.0, 45.0), housing=(20.0, 30.0), speeds=(0.0, float(speed[-1])))
    case = rotordyn.load("grinding_spindle")
    sleeve = replace(case.spindle.sleeves[0], friction=friction)
    machine, law = replace(case.spindle, sleeves=(sleeve,)), case.conditions.law
    path = history(operating_state(machine, speed, law, 0.0, warm), 0.0)
    states = np.array([state.x for state in path.run_up()])
    every, last = (axial_run_up(machine, law, at, 0.0, warm) for at in (speed, speed[2:]))
    assert every.idle - every.mounted == pytest.approx(states, abs=2e-9)
    assert last.idle[0] == pytest.approx(every.idle[2], abs=1e-12)


def test_weight_shifts_what_is_rest() -> None:
    """At rest without further force nothing has moved, whatever the static force."""
    case = rotordyn.load("mfw2310")
    for force in (0.0, -209.0):
        found = axial_run_up(case.spindle, case.conditions.law, np.zeros(1), force)
        assert found.shift == pytest.approx(0.0, abs=1e-12)


def test_nothing_holds_the_shaft() -> None:
    case = rotordyn.vary(rotordyn.load("mfw2310"), {FRONT + "stop_travel": np.inf})
    found = axial_run_up(case.spindle, case.conditions.law, np.zeros(1))
    with pytest.raises(NoSolution, match="no axial equilibrium under -100000 N"):
        found.under(0, [-1e5])


def test_the_search_meets_a_root_just_behind_a_kink() -> None:
    """1 kN/m up to 1 µm, a million times as stiff beyond."""
    soft, stiff, kink = 1e3, 1e9, 1e-6

    def missing(u: np.ndarray) -> np.ndarray:
        return soft * np.minimum(u, kink) + stiff * np.maximum(u - kink, 0.0) - 7.0

    low, high = np.array([-1e-5]), np.array([6e-5])
    found = play._root(missing, (low, missing(low)), (high, missing(high)))
    assert found == pytest.approx([kink + (7.0 - soft * kink) / stiff], abs=1e-14)


def test_a_bearing_without_any_state_is_named_with_its_speed_and_growth() -> None:
    """Grooves that grow by five balls leave no angle at which a ball could touch both."""
    case = rotordyn.load("mfw2310")
    joined = play.arrangement(case.spindle, np.array([150.0 * RPM]))
    third = replace(joined.bearings[2], growth=np.array([43.21e-3]))
    odd = replace(joined, bearings=(*joined.bearings[:2], third))
    said = r"number 4 of the spindle at 150 rpm, groove growth 4\.321e\+04 µm: no axial"
    with pytest.raises(NoSolution, match=said):
        axial_curves.BearingCurves().of(odd)


def test_a_curve_goes_on_level_below_and_straight_above() -> None:
    """F = 9e6 d + 1e11 d² up to 80 µm is met between its points; beyond, its slope goes on."""
    d = np.linspace(-20e-6, 80e-6, 11)
    pressed = np.maximum(d, 0.0)
    load, slope = 9e6 * pressed + 1e11 * pressed**2, (9e6 + 2e11 * d) * (d >= 0.0)
    curve = axial_curves._curve(d, load, slope, axial_curves.FINE * 1e-6, 1e-6)
    assert curve(np.array([-1e-3, -3e-4])).tolist() == [0.0, 0.0]
    inside = np.array([31e-6, 77e-6])
    assert curve(inside) == pytest.approx(9e6 * inside + 1e11 * inside**2, rel=1e-6)
    end, slope = 9e6 * 80e-6 + 1e11 * 80e-6**2, 9e6 + 2e11 * 80e-6
    beyond = np.array([1e-4, 1e-3, 4e-3])
    assert curve(beyond) == pytest.approx(end + slope * (beyond - 80e-6), rel=0.01)
