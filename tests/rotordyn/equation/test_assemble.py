"""Links far stiffer than the softest motion are set apart from it, others are not."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.equation.linear import Linear
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.rotors import STEEL
from tests.oracles.spinning_beam import PinnedBeam

LENGTH, DIAMETER = 0.5, 0.02
DIGITS = 1e6  # what a stiffness takes of the digits of one that is less by so much


def bending(stiffness: float) -> Linear:
    """A slender rod on equal springs at both ends, one plane."""
    ends = [("a", 0.0), ("b", LENGTH)]
    ways = {("y", "y"): stiffness, ("z", "z"): stiffness}
    supports = tuple(LinearSupport(name, x, ways) for name, x in ends)
    shaft = Shaft(0.0, (Section(LENGTH, DIAMETER, 0.0, STEEL),))
    spindle = Spindle("rod", shaft, supports=supports)
    scene = Scene(spindle, Conditions(), np.zeros(1), 1000.0)
    (k,) = scene.with_motions(("bending",))
    return scene.linear(k)


def test_springs_that_take_six_digits_are_set_apart() -> None:
    """The softest motion of the free rod: ω = 4.730² √(EI/m L³). A spring at an end is 4 k/m by
    each coordinate of unit mass at most, and by those of rigid motion together."""
    rod = PinnedBeam(LENGTH, DIAMETER)
    mass = rod.line_mass * LENGTH
    softest = 4.730**4 * rod.bending / (mass * LENGTH**3)
    clear = DIGITS * softest * mass / 4.0
    apart = bending(1.2 * clear)
    assert apart.allowed is not None
    together = bending(clear / (2.0 * apart.size))
    assert together.allowed is None
    assert together.size == pytest.approx(apart.size)
