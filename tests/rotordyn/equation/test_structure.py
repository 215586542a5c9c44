"""Links between rotors: what moves both alike strains none, whatever the direction."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotordyn.equation.dofs import DIRECTIONS, position
from rotordyn.equation.structure import Structure, slope_rows
from rotordyn.machine.drawbar import Drawbar
from tests.oracles.coaxial import COAXIAL
from tests.oracles.rotors import uniform
from tests.oracles.spindles import scene


def moved(built: Structure, name: str, direction: str, inner: float, outer: float) -> np.ndarray:
    """Relative motion (6,) where both rotors move so far in a direction, each at its node."""
    motion = np.zeros(built.dofs.count)
    support = next(s for s in COAXIAL.supports if s.name == name)
    link = next(each for each in built.connections if each.name == name)
    for rotor, way in (("spindle", inner), ("outer", outer)):
        if rotor in (support.holds, support.against):
            motion[built.node(rotor, support.x)[position(direction)]] = way
    return np.asarray(link.motions @ (built.dofs.sign * motion)[link.dofs])


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_links_take_the_difference_of_what_they_join(direction: str) -> None:
    one, built = np.eye(6)[position(direction)], scene(COAXIAL, [0.0]).rotor
    assert moved(built, "b3", direction, 1.0, 1.0).tolist() == [0.0] * 6
    assert moved(built, "b3", direction, 3.0, 1.0) == pytest.approx(2.0 * one)
    assert moved(built, "b1", direction, 1.0, 7.0) == pytest.approx(one)
    assert moved(built, "b2", direction, 7.0, 1.0) == pytest.approx(one)


def test_a_drawbar_presses_slopes_between_its_ends_alone() -> None:
    bar = Drawbar(2e4, 0.2, 0.7, (0.5,))
    built = scene(replace(uniform(1.0, 0.05), drawbar=bar), [0.0]).rotor
    line = next(line for line in built.dofs.lines if line.kind == "bending")
    pressed = built._pressed(line)
    assert pressed is not None
    every, element = slope_rows(built.shafts["spindle"], built.shown, line.way)
    middle = built.shown.middle[element]
    inside = (middle > bar.start) & (middle < bar.end)
    assert 0 < inside.sum() < len(inside) == pressed[0]
    for (at, _, shapes), (_, _, whole) in zip(pressed[1], every, strict=True):
        assert shapes == pytest.approx(np.where(inside[at][:, :, None], whole, 0.0))
        assert whole.any()
