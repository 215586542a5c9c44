"""Bearings at their seats: coupling that is rounding is omitted, in the measure of both ways."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.equation.seat import in_spindle_frame, seat_law
from rotordyn.equation.term import State
from tests.oracles.spindles import mfw2310


@pytest.mark.parametrize("unit", [1e-3, 1.0, 1e4])
@pytest.mark.parametrize(("share", "kept"), [(1e-9, True), (3e-12, True), (3e-13, False)])
def test_coupling_beside_what_both_ways_resist(unit: float, share: float, *, kept: bool) -> None:
    """1e8 N/m across and 1e4 N·m about: their coupling counts beside √(k c), in any unit."""
    across, about = 1e8 * unit, 1e4 * unit
    tangent = np.diag([across, across, across, about, about])
    coupling = share * np.sqrt(across * about)
    tangent[1, 4] = tangent[4, 1] = coupling
    seats = mfw2310().seats[:1]
    tangents = in_spindle_frame(seats, tangent[None, None])
    state = State(np.zeros(1), tangents, np.zeros((1, 0), dtype=bool))
    found = seat_law(seats[0], 0).matrices(state).stiffness[0]
    assert np.count_nonzero(np.diagonal(found)) == 5
    assert np.count_nonzero(found) == (7 if kept else 5)
    assert np.abs(found - np.diag(np.diagonal(found))).max() == (coupling if kept else 0.0)


def test_each_bearing_is_turned_by_its_own_thrust() -> None:
    """Two bearings that bear either way, at two speeds."""
    front, *_, rear = mfw2310().seats
    seats = (front, rear)
    assert [seat.thrust for seat in seats] == [1, -1]
    draw = np.random.default_rng(3)
    tangents = draw.uniform(0.5, 1.0, (2, 2, 5, 5)) + np.eye(5)
    found = in_spindle_frame(seats, tangents)
    for row in range(2):
        for place, seat in enumerate(seats):
            alone = np.zeros((6, 6))
            signs = np.array([-1.0, 1.0, -1.0, 1.0, -1.0]) if seat.thrust < 0 else np.ones(5)
            at = np.array([0, 1, 2, 4, 5])
            alone[np.ix_(at, at)] = np.diag(signs) @ tangents[row, place] @ np.diag(signs)
            assert (found[row, place] == alone).all()
