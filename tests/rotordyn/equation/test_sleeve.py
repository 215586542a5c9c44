"""Sleeves: what a closed stop adds to the spring, and the mass of what has none."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rotordyn.equation.dofs import Dofs
from rotordyn.equation.fineness import USUAL, WEIGHTLESS, Fineness
from rotordyn.equation.sleeve import CLOSED, Sleeves
from rotordyn.equation.term import State
from tests.oracles.spindles import mfw2310, with_sleeve, with_springs

FINE = Fineness(1000.0, accuracy=USUAL)
# 25 balls of 8.29e9 N/m^1.5, pressed by a thousandth of 1.25 mm
LEAST = 3e-3 * 25 * 8288439893.606 * math.sqrt(1.247775e-6)


def test_a_closed_stop_is_far_stiffer_than_the_bearings_behind_it() -> None:
    spindle = mfw2310()
    (link, *_) = Sleeves(Dofs(), spindle, FINE).links(spindle)
    carried = [k for k, s in enumerate(spindle.seats) if s.name in spindle.sleeves[0].bearings]
    tangents = np.zeros((2, len(spindle.seats), 6, 6))
    tangents[:, carried, 0, 0] = 7e7
    stops = np.array([[False, True], [True, False]])
    open_, closed = link.matrices(State(np.zeros(2), tangents, stops)).stiffness[:, 0, 0]
    spring = spindle.sleeves[0].spring.stiffness
    assert open_ == spring
    assert closed == pytest.approx(spring + CLOSED * 7e7 * len(carried))


@pytest.mark.parametrize("stiffness", [1.0, 5e6, 3e8])
def test_a_sleeve_without_mass_swings_far_above_the_band(stiffness: float) -> None:
    """√(k/m) is ``WEIGHTLESS`` times the band; of next to no spring as of 3e-3 of its bearing's
    stiffness."""
    spindle = with_springs(with_sleeve(mfw2310(), "front", mass=0.0), stiffness)
    (part, *_) = (
        each for each in Sleeves(Dofs(), spindle, FINE).parts(spindle) if each.matrix == "mass"
    )
    swings = math.sqrt(max(stiffness, LEAST) / part.blocks.item())
    assert swings == pytest.approx(WEIGHTLESS * 2.0 * math.pi * 1000.0)


def test_the_error_by_a_fictitious_mass_is_requested_as_all_else() -> None:
    """It falls as the square of the frequency: a hundred times as accurate is ten times as high;
    a step finer doubles it."""
    exact = Fineness(1000.0, accuracy=USUAL / 100.0)
    assert exact.weightless == pytest.approx(10.0 * FINE.weightless)
    assert Fineness(1000.0, accuracy=1.0).weightless == FINE.weightless
    finer = Fineness(1000.0, accuracy=USUAL, finer=1)
    assert finer.weightless == pytest.approx(2.0 * FINE.weightless)
