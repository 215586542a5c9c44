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
from rotordyn.machine.support import LinearSupport
from rotordyn.preload.axial_force import axial_force
from tests.oracles.rotors import uniform
from tests.oracles.spindles import mfw2310, scene

SPEEDS = range(0, 24001, 3000)
NEAR = 1e-7  # m


def around(x: float) -> np.ndarray:
    return np.array([x - NEAR, x + NEAR])


@pytest.mark.parametrize("gravity", ["none", "+x", "-x"])
@pytest.mark.parametrize("pushed", [0.0, 300.0, -250.0])
def test_flagship_at_every_speed(gravity: str, pushed: float) -> None:
    """Steps of the bearings are their loads; the push stands at the tip; the tail is free."""
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
    with pytest.raises(InvalidInput, match="nothing holds the shaft along its axis"):
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
