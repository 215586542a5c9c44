"""Nodes where something is, and no element too long."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotordyn.equation.mesh import ELEMENTS_OVER_LENGTH, build_mesh
from rotordyn.errors import InvalidInput
from rotordyn.machine.lumped import Disc
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from tests.oracles.rotors import STEEL, STEPPED, support, uniform

FULL = replace(
    STEPPED,
    supports=(LinearSupport("s", 0.033, {("y", "y"): 1.0}),),
    discs=(Disc("d", 0.111, 0.2, 0.1, 0.01, STEEL),),
)


def test_every_station_is_a_node() -> None:
    mesh = build_mesh(FULL, 1.0)
    expected = [-0.05, 0.0, 0.033, 0.06, 0.10, 0.111, 0.24, 0.27]
    assert mesh.x == pytest.approx(expected)
    assert [mesh.node_of(x) for x in expected] == list(range(8))


@pytest.mark.parametrize("start", [-0.05, 40.0])
def test_no_node_is_taken_for_one_beside_it_wherever_a_shaft_begins(start: float) -> None:
    """Stations are one to 3e-7 of the length of the shaft, not of where it lies."""
    shaft = Shaft(start, (Section(0.32, 0.05, 0.0, STEEL),))
    mesh = build_mesh(Spindle("far", shaft, supports=(support("s", start, (1e7, 1e7)),)), 0.1)
    assert mesh.node_of(start + 0.32 * 2.9e-7) == 0
    with pytest.raises(InvalidInput, match="no node at x"):
        mesh.node_of(start + 0.32 * 3.1e-7)


@pytest.mark.parametrize("longest", [0.004, 0.011, 0.05])
def test_no_element_is_longer_than_asked(longest: float) -> None:
    mesh = build_mesh(FULL, longest)
    assert mesh.length.max() <= longest * (1 + 1e-6)
    assert mesh.length.min() > 0
    assert mesh.length.sum() == pytest.approx(0.32)


def test_whole_division_takes_no_extra_element() -> None:
    assert build_mesh(uniform(1.3, 0.1), 0.1).nodes == 14


def test_default_length() -> None:
    assert build_mesh(uniform(3.0, 0.1)).nodes == ELEMENTS_OVER_LENGTH + 1


def test_elements_have_the_section_they_lie_in() -> None:
    mesh = build_mesh(FULL, 0.013)
    for left, right, outer, density in zip(
        mesh.x, mesh.x[1:], mesh.outer[0], mesh.density, strict=False
    ):
        section = FULL.shaft.section_at((left + right) / 2)
        assert (outer, density) == (section.outer_diameter, section.material.density)


def test_coincident_stations_are_one_node() -> None:
    third = 0.1 + 0.1 + 0.1  # not the same float as 0.3
    sections = tuple(Section(0.1, 0.05, 0.0, STEEL) for _ in range(5))
    rotor = Spindle("s", Shaft(0.0, sections), points={"a": 0.3, "b": third, "c": 0.5})
    mesh = build_mesh(rotor, 1.0)
    assert third != 0.3
    assert mesh.nodes == 6
    assert mesh.node_of(0.3) == mesh.node_of(third) == 3


def test_no_node_there() -> None:
    with pytest.raises(InvalidInput, match=r"no node at x = 0\.0123 m"):
        build_mesh(FULL, 0.05).node_of(0.0123)


@pytest.mark.parametrize("x", [-0.051, 0.2701])
def test_off_the_shaft(x: float) -> None:
    with pytest.raises(InvalidInput, match=r"point far at x = .* is off the shaft"):
        build_mesh(replace(STEPPED, points={"far": x}))


@pytest.mark.parametrize("longest", [0.0, -0.01, float("nan"), float("inf")])
def test_impossible_element_length(longest: float) -> None:
    with pytest.raises(InvalidInput, match="element_length"):
        build_mesh(STEPPED, longest)


def test_finer_mesh_keeps_the_stations() -> None:
    coarse, fine = build_mesh(FULL, 0.05), build_mesh(FULL, 0.003)
    assert all(np.abs(fine.x - x).min() < 1e-12 for x in (-0.05, 0.0, 0.033, 0.06, 0.1, 0.24))
    assert fine.nodes > coarse.nodes
