"""Springs far stiffer than the shaft: what rounding does to slow motions is part of the error, and
none of them is taken for a free one."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from bearings.materials import Material
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.equation.free_directions import free_directions
from rotordyn.errors import InvalidInput
from rotordyn.machine.lumped import Disc
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import Unbalance
from rotordyn.scene.scene import Scene
from tests.oracles.spindles import answers
from tests.oracles.spinning_beam import PinnedBeam

STEEL = Material("steel", 2.1e11, 0.3, 7800.0)
LENGTH, DIAMETER = 0.5, 0.05
SPEEDS, TOP = np.array([0.0, 500.0, 2000.0]), 6000.0


def spring(name: str, x: float, stiffness: float, **more: float) -> LinearSupport:
    ways = {("y", "y"): stiffness, ("z", "z"): stiffness}
    return LinearSupport(name, x, ways | {(way, way): value for way, value in more.items()})


def beam(*supports: LinearSupport) -> Spindle:
    shaft = Shaft(0.0, (Section(LENGTH, DIAMETER, 0.0, STEEL),))
    return Spindle("beam", shaft, supports=supports)


def solved(spindle: Spindle, accuracy: float, top: float = TOP) -> Any:
    scene = Scene(spindle, Conditions(accuracy=accuracy), SPEEDS, top)
    return campbell.solve(scene, CampbellSpec(top, shapes=False))


def exact() -> np.ndarray:
    """Of the beam between pins [Hz], (speeds, modes)."""
    own = PinnedBeam(LENGTH, DIAMETER)
    rows = [np.concatenate([own.frequencies(k, s) for k in (1, 2, 3, 4)]) for s in SPEEDS]
    return np.array([np.sort(np.abs(row))[:8] for row in rows]) / (2.0 * math.pi)


@pytest.mark.parametrize("stiffness", [1e15, 1e16, 1e17, 1e18, 1e19, 1e20])
def test_the_stiffest_springs_are_pins(stiffness: float) -> None:
    """Up to the stiffest that is allowed; its give is 1e20/stiffness · 1e-12."""
    found = solved(beam(spring("a", 0.0, stiffness), spring("b", LENGTH, stiffness)), 1e-8)
    bends = [kind == "bending" for kind in found.kind]
    assert sum(bends) == 8
    frequency = np.sort(found.frequency[:, bends], axis=1)
    assert np.abs(frequency / exact() - 1.0).max() < 2e8 / stiffness + 1e-10
    assert found.frequency_error[:, bends].max() < 1e-10
    assert not found.unconverged


def pendulum(stiffness: float) -> float:
    """About a pin at one end, a soft spring at the other [Hz]; 1e3 N/m: 3.146 Hz."""
    inertia = PinnedBeam(LENGTH, DIAMETER).line_mass * LENGTH**3 / 3.0
    inertia += PinnedBeam(LENGTH, DIAMETER).line_mass * DIAMETER**2 / 16.0 * LENGTH
    return math.sqrt(stiffness * LENGTH**2 / inertia) / (2.0 * math.pi)


@pytest.mark.few(3)
@pytest.mark.parametrize("soft", [1e3, 1.0])
@pytest.mark.parametrize("stiff", [1e12, 1e14, 1e16, 1e18, 1e20])
def test_a_slow_motion_beside_a_stiff_spring_keeps_its_error(soft: float, stiff: float) -> None:
    """Rounding is reported where it counts: of springs not stiff enough to be set apart."""
    ends = spring("a", 0.0, stiff), spring("b", LENGTH, soft)
    found = solved(beam(*ends), 1e-6, 2000.0)
    lowest = int(np.nanargmin(found.frequency[0]))
    error = abs(found.frequency[0, lowest] / pendulum(soft) - 1.0)
    assert error < found.frequency_error[0, lowest] + 3e-8 * soft
    assert found.frequency_error[0, lowest] < 1e-4
    rounds = soft == 1.0 and stiff == 1e12
    assert ("rounding" in found.unconverged) == rounds
    assert ("make them rigid" in found.unconverged) == rounds


@pytest.mark.parametrize("other", [spring("b", LENGTH, 1e-4), spring("b", 0.0, 0.0, thz=3e-5)])
def test_a_motion_that_is_lost_is_refused(other: LinearSupport) -> None:
    """Neither counted as free nor given some frequency."""
    with pytest.raises(InvalidInput, match=r"'a' is so stiff, 1e\+12 N/m, .* make it rigid"):
        solved(beam(spring("a", 0.0, 1e12), other), 1e-6, 2000.0)


def test_free_motions_stay_free_beside_stiff_springs() -> None:
    """A pendulum that nothing holds; and what no spring touches."""
    for stiffness, number in ((1e20, 2), (1e6, 2)):
        scene = Scene(beam(spring("a", 0.0, stiffness)), Conditions(), SPEEDS, TOP)
        for k in scene.with_motions(["bending"]):
            assert free_directions(scene.linear(k), np.array([0, 2])).tolist() == [number, number]
            assert scene.system(k).free_count[0] == 2 * number


def test_stiffer_than_allowed_says_rigid() -> None:
    with pytest.raises(InvalidInput, match="or rigid: no displacement"):
        spring("a", 0.0, 2e20)


@pytest.mark.parametrize("soft", [1e6, 100.0])
@pytest.mark.parametrize("stiff", [1e12, 1e13, 1e17, 1e20])
def test_critical_speeds_and_orbits_are_those_of_a_rigid_support(stiff: float, soft: float) -> None:
    """But for its give: no critical speed by rounding, none twice."""
    shaft = Shaft(0.0, (Section(LENGTH, DIAMETER, 0.0, STEEL),))
    disc, load = Disc("d", 0.25, 0.2, 0.05, 0.02, STEEL), Unbalance(0.25, 1e-5)
    held = LinearSupport("a", 0.05, rigid=("y", "z"))
    rpm = np.linspace(0.0, 10000.0 if soft > 1e3 else 100.0, 11)
    spec = {"campbell": CampbellSpec(2000.0), "unbalance": UnbalanceSpec(("tip",), (load,))}
    found = []
    for first in (held, spring("a", 0.05, stiff)):
        supports, points = (first, spring("b", 0.4, soft)), {"tip": LENGTH}
        machine = Spindle("s", shaft, discs=(disc,), supports=supports, points=points)
        found.append(answers(machine, rpm.tolist(), spec))
    rigid, stiffened = found
    allowed = 2e10 / stiff + 1e-9
    for name in spec:
        expected, speed = rigid[name].critical_speed, stiffened[name].critical_speed
        assert len(speed) == len(expected) > 0
        assert speed == pytest.approx(expected, rel=max(allowed, 1e-9 * 1e6 / soft))
    there = np.abs(rigid["unbalance"].displacement[1:])
    apart = np.abs(np.abs(stiffened["unbalance"].displacement[1:]) / there - 1.0)
    assert apart.max() < 20.0 * max(allowed, 1e-9 * 1e6 / soft)


@pytest.mark.parametrize("stiff", [1e16, 3e17, 1e18, 1e20])
def test_critical_speeds_by_rounding_are_as_exact_as_frequencies(stiff: float) -> None:
    """Very stiff supports of damped machines are not set apart: none is lost, none twice."""
    shaft = Shaft(0.0, (Section(LENGTH, DIAMETER, 0.0, STEEL),))
    disc, damping = Disc("d", 0.25, 0.2, 0.05, 0.02, STEEL), {("y", "y"): 1e3, ("z", "z"): 1e3}
    soft = replace(spring("b", 0.4, 1e6), damping=damping)
    rpm = np.linspace(0.0, 10000.0, 11).tolist()
    found = []
    for first in (LinearSupport("a", 0.05, rigid=("y", "z")), spring("a", 0.05, stiff)):
        machine = Spindle("s", shaft, discs=(disc,), supports=(first, soft))
        found.append(answers(machine, rpm, {"campbell": CampbellSpec(2000.0)})["campbell"])
    rigid, stiffened = found
    assert len(stiffened.critical_speed) == len(rigid.critical_speed) == 2
    error = 10.0 * np.nanmax(stiffened.frequency_error)
    assert stiffened.critical_speed == pytest.approx(rigid.critical_speed, rel=error)
