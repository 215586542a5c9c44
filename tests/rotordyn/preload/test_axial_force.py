"""The axial force in the shaft is in balance: nothing at both ends, steps where something acts."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rotordyn.errors import InvalidInput
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.preload.axial_force import axial_force
from tests.oracles.rotors import STEEL, uniform
from tests.oracles.spindles import mfw2310, scene

SPEEDS = range(0, 24001, 3000)
NEAR = 1e-7  # m


def around(x: float) -> np.ndarray:
    return np.array([x - NEAR, x + NEAR])


@pytest.mark.parametrize("gravity", ["none", "+x", "-x"])
@pytest.mark.parametrize("pushed", [0.0, 300.0, -250.0])
def test_flagship_at_every_speed(gravity: str, pushed: float) -> None:
    """Steps of the bearings are their loads; the push acts at the tip; the tail is free."""
    found = scene(mfw2310(), SPEEDS, gravity=gravity, axial_force=pushed)
    along, load, shaft = found.shaft_force, found.preload.seat_load(), found.spindle.shaft
    largest = np.abs(load).max()
    assert along.at(np.array([shaft.start - NEAR]))[:, 0] == pytest.approx(0.0, abs=1e-12)
    assert along.at(np.array([shaft.start + NEAR]))[:, 0] == pytest.approx(-pushed, abs=1e-4)
    assert np.abs(along.at(np.array([shaft.end + NEAR]))).max() < 1e-8 * largest
    for k, seat in enumerate(found.spindle.seats):
        before, behind = along.at(around(seat.x)).T
        step = behind - before
        if all(abs(m.x - seat.x) > NEAR for m in found.spindle.lumped):
            assert step == pytest.approx(seat.thrust * load[:, k], rel=1e-6, abs=1e-3)


def test_preload_stretches_the_shaft_between_its_groups() -> None:
    """Back to back: a and b push it forward, c, d and e to the rear; 528 N lie behind c."""
    found = scene(mfw2310(), (0,))
    between = found.shaft_force.at(np.array([0.0, 0.0386, 0.06, 0.2, 0.391, 0.41]))[0]
    assert between == pytest.approx([0.0, 551.0, 1102.0, 528.0, 264.0, 0.0], abs=1e-6)
    assert not found.shaft_force.compresses


@pytest.mark.parametrize("gravity", [0.0, 9.81])
@pytest.mark.parametrize("x", [0.2, 0.5, 0.9])
def test_a_force_compresses_the_shaft_up_to_what_holds_it(x: float, gravity: float) -> None:
    """Pushed at its front end, held at x; or standing on a support at x with what is before it."""
    held = LinearSupport("foot", x, {("x", "x"): 1e7})
    rotor = uniform(1.0, 0.05, supports=(held,))
    force = 0.0 if gravity else 100.0
    assert axial_force(rotor, np.zeros((1, 0)), force, gravity).compresses
    assert axial_force(rotor, np.zeros((1, 0)), -force, -gravity).compresses == bool(gravity)
    assert not axial_force(rotor, np.zeros((1, 0))).compresses


def test_weight_is_spread_over_sections_and_masses() -> None:
    """Held at its front end, the shaft hangs (+x down): tension is the weight behind the cut."""
    held = LinearSupport("top", 0.0, {("x", "x"): 1e7})
    rotor = uniform(1.0, 0.05, masses=(PointMass("tail", 0.8, 3.0),), supports=(held,))
    g = 9.81
    along = axial_force(rotor, np.zeros((1, 0)), gravity=g)
    line = (rotor_inertia(rotor).mass - 3.0) * g
    x = np.array([0.1, 0.5, 0.79, 0.81, 0.99])
    expected = line * (1.0 - x) + 3.0 * g * (x < 0.8)
    assert along.at(x)[0] == pytest.approx(expected, rel=1e-12)
    assert not along.compresses
    assert axial_force(rotor, np.zeros((1, 0)), gravity=-g).compresses


def test_supports_share_by_stiffness() -> None:
    held = tuple(
        LinearSupport(n, x, {("x", "x"): k}) for n, x, k in (("a", 0.2, 1e7), ("b", 0.8, 3e7))
    )
    along = axial_force(uniform(1.0, 0.05, supports=held), np.zeros((2, 0)), force=-400.0)
    expected = [400.0, 300.0, 0.0]
    assert along.at(np.array([0.1, 0.5, 0.9])) == pytest.approx(np.tile(expected, (2, 1)))


def test_something_must_hold_the_shaft() -> None:
    with pytest.raises(InvalidInput, match="the shaft is unrestrained along its axis"):
        axial_force(uniform(1.0, 0.05), np.zeros((1, 0)), force=1.0)
    axial_force(uniform(1.0, 0.05), np.zeros((1, 0)))


@pytest.mark.parametrize(("guides", "bending"), [((0.5,), -2e4), ((), -2e4), ("everywhere", 0.0)])
def test_drawbar_compresses_the_shaft_between_its_ends(guides: object, bending: float) -> None:
    bar = Drawbar(2e4, 0.2, 0.7, guides)  # type: ignore[arg-type]
    along = axial_force(replace(uniform(1.0, 0.05), drawbar=bar), np.zeros((1, 0)))
    x = np.array([0.1, 0.3, 0.6, 0.8])
    assert along.at(x)[0] == pytest.approx([0.0, -2e4, -2e4, 0.0])
    assert along.bending(x)[0] == pytest.approx([0.0, bending, bending, 0.0])
    assert along.compresses == (bending < 0.0)


def test_state_that_is_not_known_stays_unknown() -> None:
    load = np.full((1, 5), math.nan)
    assert np.isnan(axial_force(mfw2310(), load).at(np.array([0.2]))).all()


@pytest.mark.parametrize("turned", [1.0, -1.0])
def test_rigid_supports_hold_the_length_between_them(turned: float) -> None:
    """A rod between two of them hangs by half from the upper one and rests by half on
    the lower one; a force between them is carried in inverse ratio of the ways, n L = n₁ L₁."""
    ends = tuple(LinearSupport(n, x, {}, rigid=("x",)) for n, x in (("a", 0.0), ("b", 1.0)))
    rod = uniform(1.0, 0.05, supports=ends)
    weight = rotor_inertia(rod).mass * 9.81 * turned
    along = axial_force(rod, np.zeros((1, 0)), gravity=9.81 * turned)
    x = np.array([1e-9, 0.25, 0.5, 1.0 - 1e-9])
    expected = weight * (0.5 - x)
    assert along.at(x)[0] == pytest.approx(expected, rel=1e-6, abs=1e-6 * abs(weight))
    pushed = axial_force(rod, np.zeros((1, 0)), point_forces=((0.3, 1000.0 * turned),))
    assert pushed.at(np.array([0.1, 0.9]))[0] == pytest.approx([700.0 * turned, -300.0 * turned])


def test_rigid_supports_share_by_how_far_each_part_gives() -> None:
    """Two thicknesses between them: of a force at the step each part takes EA/L of its own."""
    ends = tuple(LinearSupport(n, x, {}, rigid=("x",)) for n, x in (("a", 0.0), ("b", 1.0)))
    thin, thick = Section(0.4, 0.04, 0.0, STEEL), Section(0.6, 0.06, 0.03, STEEL)
    rod = Spindle("rod", Shaft(0.0, (thin, thick)), supports=ends)
    rates = np.array([0.04**2 / 0.4, (0.06**2 - 0.03**2) / 0.6])
    along = axial_force(rod, np.zeros((1, 0)), point_forces=((0.4, 1000.0),))
    share = 1000.0 * rates / rates.sum()
    assert along.at(np.array([0.2, 0.7]))[0] == pytest.approx([share[0], -share[1]])


@pytest.mark.parametrize(("share", "compressed"), [(0.2, True), (-0.2, False)])
def test_a_hanging_shaft_pressed_from_below_is_compressed_at_its_end(
    share: float, *, compressed: bool
) -> None:
    """By less than its weight: its upper part stays in tension."""
    held = LinearSupport("top", 0.0, {("x", "x"): 1e7})
    rod = uniform(1.0, 0.05, supports=(held,))
    force = share * rotor_inertia(rod).mass * 9.81
    along = axial_force(rod, np.zeros((1, 0)), gravity=9.81, point_forces=((1.0, -force),))
    assert along.at(np.array([0.1]))[0, 0] > 0.0
    assert along.at(np.array([0.999]))[0, 0] == pytest.approx(-force, rel=0.01)
    assert along.compresses == compressed
