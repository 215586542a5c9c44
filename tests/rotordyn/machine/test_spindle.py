"""What a spindle says of itself without being solved."""

from __future__ import annotations

from dataclasses import replace

import rotordyn


def test_the_arrangement_is_named_from_the_thrusts():
    spindle = rotordyn.load("cases/mfw2310.yaml").spindle
    assert spindle is not None
    assert spindle.pairings == (("b", "c", "O"),)
    turned = tuple(replace(seat, thrust=-seat.thrust) for seat in spindle.seats)
    assert replace(spindle, seats=turned).pairings == (("b", "c", "X"),)
