"""Connections of bearings: tandem pairs, springs, states computed of the bearings."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from bearings import Lubricant
from bearings.ball.law import Law
from bearings.ring import request
from bearings.ring.operation import Operation
from rotordyn.machine.growth import QuadraticInSpeed, RingGrowth
from rotordyn.preload.arrangement import HOUSING, arrangement, rigid
from rotordyn.preload.on_films import Films
from rotordyn.preload.together import dynamic_preload
from tests.oracles.spindles import TOP, mfw2310, with_springs

SPEED = np.array([0.0, 0.5, 1.0]) * TOP
LAW = Law("outer", "equal")
LIKE = np.array([0.2, 0.2, 0.3, 0.4, 0.4])  # equal in a tandem pair


def test_a_tandem_pair_is_one_bearing() -> None:
    bearings = arrangement(mfw2310(), SPEED).bearings
    assert [b.seats for b in bearings] == [(0, 1), (2,), (3, 4)]
    assert [b.thrust for b in bearings] == [1, -1, -1]
    assert [b.outer for b in bearings] == [HOUSING, 1, 2]


def test_tandem_pairs_with_different_growth_are_not_alike() -> None:
    seats = list(mfw2310().seats)
    seats[1] = replace(seats[1], growth=RingGrowth(43.2e-6, QuadraticInSpeed(9e-6, TOP)))
    bearings = arrangement(mfw2310(seats=tuple(seats)), SPEED).bearings
    assert [b.seats for b in bearings] == [(0,), (1,), (2,), (3, 4)]


def test_growth_and_shift_at_speed() -> None:
    bearings = arrangement(mfw2310(), SPEED).bearings
    assert bearings[0].growth == pytest.approx(43.2e-6 + 7.3e-6 * np.array([0, 0.25, 1]))
    assert bearings[2].shortening == pytest.approx(-42.8e-6 * np.array([0, 0.25, 1]))


def test_springs_push_so_that_bearings_load() -> None:
    pushes = arrangement(mfw2310(), SPEED).pushes
    assert [p.direction for p in pushes] == [1, 1]
    assert not any(rigid(p) for p in pushes)
    assert all(rigid(p) for p in arrangement(with_springs(mfw2310(), math.inf), SPEED).pushes)


def test_part_of_the_speeds() -> None:
    whole = arrangement(mfw2310(), SPEED, 100.0)
    part = whole.at(np.array([2]))
    assert part.speed == pytest.approx([TOP])
    assert part.bearings[2].shortening == pytest.approx([-42.8e-6])
    assert part.force == 100.0


def test_states_asked_of_the_bearings(monkeypatch: pytest.MonkeyPatch) -> None:
    """Per speed three bearings of five are ever solved: one of each tandem."""
    widths: set[int] = set()
    original = request.solved

    def counted(operation: Operation, *others: Any) -> Any:
        if len(operation.shape) > 1:  # as mounted, tilts are alike for all
            widths.add(operation.shape[1])
        return original(operation, *others)

    monkeypatch.setattr(request, "solved", counted)
    dynamic_preload(mfw2310(), SPEED, LAW)
    vex70_bearings, vex60_bearings = 2, 1
    assert widths == {vex70_bearings, vex60_bearings}


def test_all_speeds_are_asked_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """The number of calls does not grow with the number of speeds."""
    calls = []
    original = request.solved

    def counted(*asked: Any) -> Any:
        calls.append(1)
        return original(*asked)

    monkeypatch.setattr(request, "solved", counted)
    counts = []
    for speeds in (3, 30):
        calls.clear()
        dynamic_preload(mfw2310(), np.linspace(0.0, TOP, speeds), LAW)
        counts.append(len(calls))
    assert 0 < counts[1] <= counts[0] + 10


def test_films_grow_the_inner_grooves_and_shift_them_the_loading_way() -> None:
    """Beside rings and seats that change with speed; linearly between speeds of the films."""
    growth, axial = (np.outer([1.0, 2.0, 4.0], part) for part in (LIKE * 1e-6, LIKE * 3e-6))
    films = Films(Lubricant(32e-6, 5.4e-6), 40.0, SPEED[[0, 1, 2]], growth, axial, growth)
    with_films, without = (arrangement(mfw2310(), SPEED, films=each) for each in (films, None))
    for found, bare in zip(with_films.bearings, without.bearings, strict=True):
        seat = found.seats[0]
        assert found.growth - bare.growth == pytest.approx(growth[:, seat])
        assert found.shortening - bare.shortening == pytest.approx(found.thrust * axial[:, seat])
