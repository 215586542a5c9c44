"""Tension: an axial force in the shaft that needs no support along the axis."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from bearings.materials import Material
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.section_forces import solve as section_forces
from rotordyn.analyses.section_forces.spec import SectionForcesSpec
from rotordyn.errors import InvalidInput, NoSolution
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.joint import Joint
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.preload.axial_force import axial_force
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.loads import PointLoad
from rotordyn.scene.scene import Scene
from tests.oracles.spinning_beam import PinnedBeam

STEEL = Material("steel", 2.1e11, 0.3, 7800.0)
LENGTH, DIAMETER = 1.0, 0.02
SPEEDS = np.array([0.0, 1000.0])
EULER = math.pi**2 * 2.1e11 * math.pi * DIAMETER**4 / 64 / LENGTH**2
SHEAR = PinnedBeam(LENGTH, DIAMETER).shear
BUCKLING = EULER / (1.0 + EULER / SHEAR)
FINE = Conditions(accuracy=1e-8)


def beam(*ways: str, **more: Any) -> Spindle:
    """Between pins, the front one held in ``ways`` besides."""
    shaft = Shaft(0.0, (Section(LENGTH, DIAMETER, 0.0, STEEL),))
    pins = (
        LinearSupport("a", 0.0, rigid=("y", "z", *ways)),
        LinearSupport("b", LENGTH, rigid=("y", "z")),
    )
    return Spindle("beam", shaft, supports=pins, points={"mid": LENGTH / 2}, **more)


def bending(spindle: Spindle, conditions: Conditions, highest: float = 1000.0) -> Any:
    found = campbell.solve(Scene(spindle, conditions, SPEEDS, highest), CampbellSpec(highest))
    return np.sort(found.frequency[:, [kind == "bending" for kind in found.kind]], axis=1)


@pytest.mark.few(2)
@pytest.mark.parametrize("tension", [-0.9 * BUCKLING, 0.5 * BUCKLING, 20.0 * BUCKLING])
@pytest.mark.parametrize("ways", [(), ("x",)])
def test_pinned_beam_in_closed_form(tension: float, ways: tuple[str, ...]) -> None:
    own = PinnedBeam(LENGTH, DIAMETER, tension=tension)
    found = bending(beam(*ways), replace(FINE, tension=tension))
    for row, speed in enumerate(SPEEDS):
        exact = np.concatenate([own.frequencies(k, speed) for k in (1, 2, 3, 4, 5)])
        exact = np.sort(np.abs(exact))[: found.shape[1]] / (2.0 * math.pi)
        assert found[row] == pytest.approx(exact, rel=2e-8)


@pytest.mark.parametrize("accuracy", [1e-3, 1e-4])
def test_near_buckling_the_reported_error_is_the_true_one(accuracy: float) -> None:
    """f² is all but linear in the force: what is left of it at 1 − 1e-6 of the buckling load has
    an error a million times that of the unloaded beam, and it is reported."""
    for share in (1e-1, 1e-3, 1e-5, 1e-6):
        own = PinnedBeam(LENGTH, DIAMETER, tension=-(1.0 - share) * BUCKLING)
        given = Conditions(accuracy=accuracy, tension=-(1.0 - share) * BUCKLING)
        scene = Scene(beam(), given, np.zeros(1), 500.0)
        found = campbell.solve(scene, CampbellSpec(500.0, shapes=False))
        exact = np.sort(np.concatenate([own.frequencies(k, 0.0)[2:3] for k in (1, 2, 3)]))
        for omega in exact / (2.0 * math.pi):
            near = int(np.nanargmin(np.abs(found.frequency[0] - omega)))
            error = abs(found.frequency[0, near] / omega - 1.0)
            assert error < accuracy
            if error > 1e-8:
                assert found.frequency_error[0, near] == pytest.approx(error, rel=0.5)
    slow = [
        PinnedBeam(LENGTH, DIAMETER, tension=-s * BUCKLING).frequencies(1, 0.0)[2]
        for s in (0.5, 0.9)
    ]
    assert (slow[0] / slow[1]) ** 2 == pytest.approx(5.0, rel=1e-3)


def test_a_column_buckles_at_the_load_of_euler_and_engesser() -> None:
    def scene(share: float) -> Scene:
        return Scene(beam(), replace(FINE, tension=-share * BUCKLING), SPEEDS, 200.0)

    assert not any(scene(1.0 - 1e-6).outcome)
    words = scene(1.0 + 1e-6).outcome
    assert all(re.match(r"the tension of -[\d.]+ kN buckles the shaft", word) for word in words)
    with pytest.raises(NoSolution, match=r"0\.5 times that force would not"):
        scene(2.0).require_solution()


@pytest.mark.long
def test_a_drawbar_in_part_of_the_shaft_buckles_it_where_the_lowest_mode_stands_still() -> None:
    """Held by the bar between its guides; f² falls to zero as the force grows."""
    given = replace(FINE, axial_stiffening=True)

    def pressed(force: float) -> Spindle:
        return beam("x", drawbar=Drawbar(force, 0.2, 0.7, (0.3,)))

    def lowest(force: float) -> float:
        return float(bending(pressed(force), given, 200.0)[0, 0]) ** 2

    last, here = (0.0, lowest(1e-3)), (4.0 * BUCKLING, lowest(4.0 * BUCKLING))
    for _ in range(9):  # nearer and nearer from below, since f² bends downwards
        zero = here[0] + here[1] * (here[0] - last[0]) / (last[1] - here[1])
        last, here = here, (force := here[0] + 0.5 * (zero - here[0]), lowest(force))
    zero = here[0] + here[1] * (here[0] - last[0]) / (last[1] - here[1])
    assert here[1] < 1e-2 * lowest(1e-3)
    for factor, word in ((0.9999, ""), (1.0001, "buckles the shaft")):
        (found,) = Scene(pressed(factor * zero), given, np.zeros(1), 200.0).outcome
        assert word in found
        assert bool(word) == bool(found)


def test_section_forces_take_it() -> None:
    spec = SectionForcesSpec(loads=(PointLoad("mid", Fy=1.0),))
    found = section_forces.solve(Scene(beam(), Conditions(tension=1e3), np.zeros(1)), spec)
    assert found.normal_force == pytest.approx(1e3)


def test_an_axial_force_that_nothing_holds_is_still_refused() -> None:
    with pytest.raises(InvalidInput, match="or take tension, which pulls both ends"):
        bending(beam(), replace(FINE, axial_force=10.0))


def test_one_rigid_support_takes_all_of_an_axial_force() -> None:
    """Force on the front end, held at the rear: the whole shaft is pressed."""
    spindle = beam()
    rear = replace(spindle.supports[1], rigid=("x", "y", "z"))
    spindle = replace(spindle, supports=(spindle.supports[0], rear))
    pressed = bending(spindle, replace(FINE, axial_force=0.5 * BUCKLING))
    assert pressed == pytest.approx(bending(beam(), replace(FINE, tension=-0.5 * BUCKLING)))


def test_between_two_rigid_supports_the_shaft_keeps_its_length() -> None:
    """Two walls, a force at the step: each side takes it by its rigidity, E A over length."""
    thick, thin = Section(0.4, 0.04, 0.0, STEEL), Section(0.6, 0.02, 0.01, STEEL)
    supports = tuple(LinearSupport(n, x, rigid=("x", "y", "z")) for n, x in (("a", 0), ("b", 1)))
    spindle = Spindle("clamped", Shaft(0.0, (thick, thin)), supports=supports)
    spindle = replace(spindle, drawbar=None, joints=(Joint("j", 0.7, axial=1e8),))
    weighed = axial_force(spindle, np.zeros((1, 0)), gravity=9.81, force=100.0, tension=7.0)
    x = np.linspace(0.0, 1.0, 200001)
    x = (x[1:] + x[:-1]) / 2.0
    area = np.where(x < 0.4, 0.04**2, 0.02**2 - 0.01**2) * math.pi / 4
    force = weighed.at(x)[0]
    length = np.mean(force / (2.1e11 * area)) + weighed.at(np.array([0.7]))[0, 0] / 1e8
    assert abs(length) < 1e-7 * np.mean(np.abs(force) / (2.1e11 * area))
    mass = 7800.0 * np.mean(area)
    assert force[0] - force[-1] == pytest.approx(9.81 * mass, rel=1e-4)
