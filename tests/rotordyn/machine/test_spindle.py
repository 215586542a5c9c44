"""What a spindle says of itself without being solved."""

from __future__ import annotations

from dataclasses import replace

import pytest

import rotordyn
from rotordyn.equation.mesh import build_mesh
from rotordyn.machine import shaft
from rotordyn.machine.lumped import PointMass
from tests.oracles.rotors import uniform


def test_the_arrangement_is_named_from_the_thrusts():
    spindle = rotordyn.load("cases/mfw2310.yaml").spindle
    assert spindle is not None
    assert spindle.pairings == (("b", "c", "O"),)
    turned = tuple(replace(seat, thrust=-seat.thrust) for seat in spindle.seats)
    assert replace(spindle, seats=turned).pairings == (("b", "c", "X"),)


def test_the_work_of_checking_is_linear(monkeypatch: pytest.MonkeyPatch) -> None:
    """The ends of the shaft are summed up as often for a hundred masses as for ten."""
    asked: list[int] = []
    summed = shaft.accumulate
    monkeypatch.setattr(shaft, "accumulate", lambda *a, **k: asked.append(1) or summed(*a, **k))
    counts = []
    for masses in (10, 100):
        asked.clear()
        held = tuple(PointMass(f"m{k}", 0.3 * k / masses, 0.1) for k in range(masses))
        spindle = replace(uniform(0.3, 0.05), masses=held, points={m.name: m.x for m in held})
        build_mesh(spindle)
        counts.append(len(asked))
    assert 0 < counts[0] == counts[1]
