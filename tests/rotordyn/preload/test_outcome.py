"""Speeds with a usable state: the same for all together as one by one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import rotordyn
from bearings.ball.law import Law
from rotordyn.machine.lumped import PointMass
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.outcome import _outcome, _sound
from rotordyn.preload.together import dynamic_preload
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.rotors import support, uniform
from tests.oracles.spindles import RPM, mfw2310, with_sleeve

SPEED = np.array([0.0, 8000.0, 16000.0, 24000.0, 48000.0]) * RPM


@pytest.mark.parametrize(
    "preloads", [(0.0, 0.0), (1e-3, 1e-3), (20.0, 20.0), (800.0, 0.0), (800.0, 800.0), (5e6, 5e6)]
)
def test_nothing_is_said_of_sound_speeds_and_something_of_others(
    preloads: tuple[float, float],
) -> None:
    """Of preloads from none to far too much, with forces that unload and overload bearings."""
    spindle = mfw2310()
    for sleeve, preload in zip(spindle.sleeves, preloads, strict=True):
        spring = replace(sleeve.spring, preload=preload)
        spindle = with_sleeve(spindle, sleeve.name, spring=spring)
    for force in (0.0, -300.0, 2e5):
        state = dynamic_preload(spindle, SPEED, Law("outer", "equal"), force)
        sound = _sound(state.network, state.net)
        for row, fine in enumerate(sound):
            said = _outcome(spindle, state.network, state.net, row, warm=False)
            assert said == "" or not fine
            assert fine or said or force


def test_usual_speeds_are_sound() -> None:
    state = dynamic_preload(mfw2310(), SPEED[:4], Law("outer", "equal"))
    assert _sound(state.network, state.net).all()


THRUST = rotordyn.model("bearings", "thrust_50x78x22")
HELD = support("front", 0.05, (4e7, 4e7)), support("rear", 0.6, (4e7, 4e7))


def on_thrust_bearing(thrust: int) -> Spindle:
    """A rotor that one thrust ball bearing holds along its axis, supports across it."""
    seat = BearingSeat("t", THRUST, 0.03, thrust)
    wheel = PointMass("wheel", 0.8, 30.0)
    return replace(uniform(0.8, 0.05, masses=[wheel], supports=HELD), seats=(seat,))


@pytest.mark.parametrize("thrust", [1, -1])
def test_a_bearing_that_too_small_a_thrust_does_not_keep_says_its_own_remedy(thrust: int) -> None:
    """As the bearing alone: more load, not less."""
    law, machine = Law("outer", "equal"), on_thrust_bearing(thrust)
    speed = np.array([0.0, 1500.0, 1700.0, 3000.0]) * RPM
    own = THRUST.equilibrium(
        load=[30.0, None, None, None, None],
        displacement=[None, 0.0, 0.0, 0.0, 0.0],
        speed=speed,
        kinematics="outer",
    )
    assert (own.outcome == "").tolist() == [True, True, False, False]
    said = dynamic_preload(machine, speed, law, 30.0 * thrust).outcome
    assert said[:2] == ("", "")
    remedy = "raise the load, lower the speed or give a limit of friction"
    assert said[2:] == tuple(
        f"bearing t has no equilibrium at {rpm} rpm under the 30 N along its axis at rest: {remedy}"
        for rpm in (1700, 3000)
    )
    (alone,) = dynamic_preload(machine, speed[3:], law, 30.0 * thrust).outcome
    assert alone == said[3]
    assert dynamic_preload(machine, speed[3:], law, 500.0 * thrust).outcome == ("",)
    (apart,) = dynamic_preload(machine, speed[3:], law, -30.0 * thrust).outcome
    assert "add one" in apart
    assert f"by an axial_force towards {'+' if thrust > 0 else '-'}x" in apart


@pytest.mark.parametrize(
    ("force", "said"),
    [
        (30.0, "bearing t has no equilibrium at 3000 rpm under the 30 N along its axis at rest"),
        (0.0, "no bearing is preloaded at 3000 rpm"),
    ],
)
def test_the_same_under_its_weight_across_the_axis(force: float, said: str) -> None:
    own = Conditions(kinematics="outer", axial_force=force, gravity="-y")
    scene = Scene(on_thrust_bearing(1), own, np.array([3000.0 * RPM]))
    (outcome,) = scene.outcome
    assert outcome.startswith(said)
