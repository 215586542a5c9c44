"""Which speeds have a usable state: told of all at once as one by one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from bearings.ball.law import Law
from rotordyn.preload.outcome import _outcome, _sound
from rotordyn.preload.together import dynamic_preload
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
