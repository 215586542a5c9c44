"""Rotors on one axis by their exact shafts: against each alone, against dense matrices, and a
joint against a short soft piece of shaft."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotordyn.machine.joint import Joint
from rotordyn.machine.rotor import Rotor
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from tests.oracles.coaxial import COAXIAL, INNER, OUTER, bearing
from tests.oracles.dense_rotor.unreduced import dense_poles
from tests.oracles.exact_shaft.coaxial import coaxial_poles
from tests.oracles.exact_shaft.count import whirl_frequencies
from tests.oracles.exact_shaft.rotor import exact_rotor
from tests.oracles.rotors import STEEL, support

SPIN, HIGHEST = 800.0, 2000.0  # rad/s
NO_SEATS = np.zeros((0, 5, 5))


def poles(spindle: Spindle, spin: float = SPIN) -> np.ndarray:
    """Exact ones, from starts of coarse matrices."""
    found, known = coaxial_poles(spindle, spin, dense_poles(spindle, spin, 1e3, 1e-3), HIGHEST)
    assert known.max() < 1e-10
    return found[np.argsort(np.abs(found))]


def test_rotors_that_nothing_joins_are_each_alone() -> None:
    inner = replace(INNER, supports=(bearing("a", 0.0, 26e6, 26e6), bearing("b", 0.5, 9e6, 9e6)))
    ends = (bearing("c", 0.16, 2e7, 2e7, "outer"), bearing("d", 0.4, 1e7, 1e7, "outer"))
    both = replace(inner, rotors=(OUTER,), supports=(*inner.supports, *ends))
    alone = []
    for part, spin in ((inner, SPIN), (both.part("outer"), OUTER.speed_ratio * SPIN)):
        rotor = exact_rotor(part, spin, NO_SEATS)
        alone += [whirl_frequencies(rotor, 4, direction) for direction in (-1, 1)]
    expected = np.sort(np.concatenate(alone))
    found = np.abs(poles(both))
    assert found == pytest.approx(expected[: len(found)], rel=1e-11)


@pytest.mark.parametrize("spin", [0.0, 1500.0])
def test_the_published_rotor_by_many_elements(spin: float) -> None:
    found = poles(COAXIAL, spin)
    expected = dense_poles(COAXIAL, spin, 1e3, 1e-12)[: len(found)]
    assert len(found) >= 5
    assert np.abs(found / expected - 1.0).max() < 1e-10


def test_a_damped_joint_turns_with_its_rotor() -> None:
    joint = Joint("hinge", 0.28, radial=3e7, tilt=5e4, radial_damping=300.0, tilt_damping=0.8)
    hinged = replace(COAXIAL, rotors=(replace(OUTER, joints=(joint,)),))
    found = poles(hinged)
    expected = dense_poles(hinged, SPIN, 1e3, 1e-11)[: len(found)]
    assert np.abs(found / expected - 1.0).max() < 1e-9
    assert np.abs(found.real).max() > 1.0


def test_a_cone_of_ever_more_cylinders() -> None:
    shaft = Shaft(0.152, (Section(0.254, 0.060, 0.050, STEEL, "cone", 0.080, 0.055),))
    ends = (support("a", 0.0, (2e7, 3e7)), support("b", 0.5, (2e7, 2e7)))
    joined = [bearing(f"j{k}", x, 1e7, 2e7, "outer", "spindle") for k, x in enumerate((0.2, 0.4))]
    conical = Spindle(
        "cone",
        Shaft(0.0, (Section(0.5, 0.03, 0.0, STEEL),)),
        supports=(*ends, *joined),
        rotors=(Rotor("outer", -0.7, shaft),),
    )
    found = poles(conical)
    expected = dense_poles(conical, SPIN, 1e3, 1e-12)[: len(found)]
    assert np.abs(found / expected - 1.0).max() < 1e-9


def test_a_support_far_stiffer_than_the_shafts_leaves_its_rounding() -> None:
    """10¹⁶ N/m beside 10⁷ N/m: poles to what rounding leaves, those of 10¹² N/m to 10⁻⁵."""
    found = []
    for stiff in (1e12, 1e16):
        joined = bearing("b3", 0.406, stiff, stiff, "spindle", "outer")
        rotor = replace(COAXIAL, supports=(*COAXIAL.supports[:2], joined, COAXIAL.supports[3]))
        near = dense_poles(rotor, SPIN, 1e3, 1e-3)
        found.append(np.sort(np.abs(coaxial_poles(rotor, SPIN, near, HIGHEST)[0])))
    assert found[1] == pytest.approx(found[0], rel=1e-5)


def test_almost_equal_planes_have_two_modes_each() -> None:
    """Pairs far nearer to one another than to what leads to them, each found twice."""
    planes = ((26e6, 26e6), (18e6, 18e6), (9e6, 9e6 * (1.0 + 1e-8)), (18e6, 18e6))
    alike = [
        replace(own, stiffness={("y", "y"): y, ("z", "z"): z})
        for own, (y, z) in zip(COAXIAL.supports, planes, strict=True)
    ]
    found = poles(replace(COAXIAL, supports=tuple(alike)), 0.0)
    assert len(found) % 2 == 0
    apart = np.abs(found[1::2] / found[::2] - 1.0)
    assert (apart < 1e-8).all()
    assert np.abs(found[2::2] / found[1:-1:2] - 1.0).min() > 0.01
