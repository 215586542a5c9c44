"""The preload network on the compiled solver, as long studies take it, and without; and balls that
know two branches, which bodies take along without leaving a mark."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from bearings.ball.law import Law
from bearings.geometry import geometry
from bearings.ring.compiled import states
from rotordyn.preload import equilibrium
from rotordyn.preload.state import PreloadState
from rotordyn.preload.together import dynamic_preload
from rotordyn.scene.conditions import Conditions
from tests.oracles.spindles import RPM, mfw2310

SPEED = np.linspace(0.0, 24000.0, 13) * RPM


def _state(
    travel: float, known: set[tuple[int, int, int]], patch: pytest.MonkeyPatch
) -> PreloadState:
    patch.setattr(states, "_loaded", known)
    base = mfw2310()
    sleeves = tuple(replace(sleeve, stop_travel=travel) for sleeve in base.sleeves)
    return dynamic_preload(replace(base, sleeves=sleeves), SPEED, Conditions().law, 50.0)


@pytest.mark.parametrize("travel", [20e-6, math.inf])
def test_both_ways_give_twelve_digits(travel: float, monkeypatch: pytest.MonkeyPatch) -> None:
    plain = _state(travel, set(), monkeypatch)
    quick = _state(travel, {(1, 1, 0)}, monkeypatch)
    assert plain.usable.all()
    assert quick.net.held.tolist() == plain.net.held.tolist()
    assert quick.seat_load() == pytest.approx(plain.seat_load(), rel=1e-12)
    assert quick.net.position == pytest.approx(plain.net.position, rel=1e-12, abs=1e-16)
    np.testing.assert_allclose(quick.stop_speeds(), plain.stop_speeds(), rtol=1e-11)


def test_it_is_taken_where_it_pays(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(states, "_loaded", set())
    monkeypatch.setattr(states, "is_kept", lambda: True)
    grooves = geometry(mfw2310().seats[0].bearing.grooves)
    states.expect(0.5 * states.FROM_DISK, grooves)
    assert not states.loaded(grooves)
    states.expect(2.0 * states.FROM_DISK, grooves)
    assert states.loaded(grooves)


@pytest.mark.parametrize("move", [0.0, 20e-6])
def test_where_balls_of_two_branches_were_moved_to_leaves_no_mark(
    move: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of bodies and balls moved together nothing is taken, or they end at a wrong place: what each
    bearing by itself does decides."""
    law, speed = Law("geometric", "inner"), SPEED[::6]
    found = dynamic_preload(mfw2310(), speed, law)
    together = equilibrium._together

    def astray(*given: Any) -> equilibrium.NetworkState:
        net = together(*given)
        converged = net.converged & (move > 0.0)
        return replace(net, position=net.position + move, converged=converged)

    monkeypatch.setattr(equilibrium, "_together", astray)
    alone = dynamic_preload(mfw2310(), speed, law)
    assert alone.usable.all()
    assert alone.net.held.tolist() == found.net.held.tolist()
    assert alone.seat_load() == pytest.approx(found.seat_load(), rel=1e-9)
