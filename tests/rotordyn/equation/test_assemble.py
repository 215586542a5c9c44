"""Links far stiffer than the softest motion are set apart; what rigid ones leave of the others."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotordyn.equation.linear import Linear
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.formulation import SOFTENED
from rotordyn.scene.scene import Scene
from tests.oracles.rotors import STEEL
from tests.oracles.spinning_beam import PinnedBeam

LENGTH, DIAMETER = 0.5, 0.02
DIGITS = 1e6  # what a stiffness takes of the digits of one that is less by so much


def rod(stiffness: float, *places: tuple[str, float]) -> Spindle:
    """A slender one on equal springs."""
    ways = {("y", "y"): stiffness, ("z", "z"): stiffness}
    supports = tuple(LinearSupport(name, x, ways) for name, x in places)
    shaft = Shaft(0.0, (Section(LENGTH, DIAMETER, 0.0, STEEL),))
    return Spindle("rod", shaft, supports=supports)


def equation(spindle: Spindle) -> Linear:
    """Of bending, one plane."""
    scene = Scene(spindle, Conditions(), np.zeros(1), 1000.0)
    (k,) = scene.with_motions(("bending",))
    return scene.linear(k)


def test_the_softened_formulation_takes_mass_by_the_square_of_speed() -> None:
    """K − Ω² M of translation, at every speed."""
    speed = np.array([0.0, 3.0, 700.0])
    conditions = Conditions(formulation=SOFTENED)
    scene = Scene(rod(1e6, ("a", 0.0), ("b", LENGTH)), conditions, speed, 1000.0)
    (k,) = scene.with_motions(("bending",))
    linear = scene.linear(k)
    (component, *_) = linear.components
    taken = (linear.stiffness[0] - linear.stiffness[1:])[:, linear.slices[0], linear.slices[0]]
    mass = component.projected("softening")
    ends = component.is_rigid
    assert np.linalg.eigvalsh(mass)[-1] < 1.0 + 1e-9
    assert mass[ends][:, ends].trace() > 1.9
    for removed, omega in zip(taken, speed[1:], strict=True):
        assert np.abs(removed - omega**2 * mass).max() < 1e-6 * np.abs(linear.stiffness[0]).max()
        assert removed[ends][:, ends].trace() == pytest.approx(
            omega**2 * mass[ends][:, ends].trace(), rel=1e-6
        )


def bending(stiffness: float) -> Linear:
    return equation(rod(stiffness, ("a", 0.0), ("b", LENGTH)))


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


@pytest.mark.parametrize("rigid", ["a", "c"])
def test_stiffness_beside_rigid_supports_is_the_sum_of_all_links(rigid: str) -> None:
    """Of usual springs, link by link and at once."""
    spindle = rod(3e6, ("a", 0.0), ("b", 0.3), ("c", LENGTH))
    supports = tuple(
        LinearSupport(s.name, s.x, {}, rigid=("y", "z")) if s.name == rigid else s
        for s in spindle.supports
    )
    linear = equation(replace(spindle, supports=supports))
    assert linear.allowed is not None
    whole = linear.allowed.T @ linear.stiffness @ linear.allowed
    assert np.abs(linear.allowed_stiffness - whole).max() < 1e-9 * np.abs(whole).max()
    (row,) = (c.motions[c.rigid > 0.0] for c in linear.connections if c.link.name == rigid)
    assert np.abs(row @ linear.allowed).max() < 1e-9 * np.abs(row).max()
