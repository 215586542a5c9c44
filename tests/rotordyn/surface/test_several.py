"""Several rotors as surfaces: each moves with its own nodes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotordyn.equation.mesh import build_mesh
from rotordyn.surface.body import together
from rotordyn.surface.several import displacements, holders, section_motions, surfaces
from tests.oracles.coaxial import COAXIAL, INNER, OUTER

MESH = build_mesh(COAXIAL)
NODE, ROTOR = MESH.stations, MESH.rotor


def test_bodies_of_a_further_rotor_bear_its_name() -> None:
    own = surfaces(COAXIAL)
    assert {name: surface.names for name, surface in own.items()} == {
        "spindle": ("shaft", "d1", "d4"),
        "outer": ("outer shaft", "outer d2", "outer d3"),
    }
    tube = own["outer"].volume("outer shaft")
    assert tube == pytest.approx(np.pi / 4.0 * (0.06**2 - 0.05**2) * 0.254, rel=0.01)


@pytest.mark.parametrize("moving", ["spindle", "outer"])
def test_a_rotor_that_moves_takes_its_own_points_along(moving: str) -> None:
    own = surfaces(COAXIAL)
    shape = np.zeros((len(NODE), 6), complex)
    shape[np.array([name == moving for name in ROTOR]), 1] = 1.0
    moved = displacements(COAXIAL, own, NODE, ROTOR, shape)
    assert len(moved) == len(together(list(own.values())).points)
    first = len(own["spindle"].points)
    inner, outer = moved[:first], moved[first:]
    along, still = (inner, outer) if moving == "spindle" else (outer, inner)
    assert along == pytest.approx(np.tile([0.0, 1.0, 0.0], (len(along), 1)), abs=1e-12)
    assert not still.any()
    stations = {"spindle": np.array([0.0, 0.3]), "outer": np.array([0.2])}
    centre = section_motions(COAXIAL, stations, NODE, ROTOR, shape)
    assert centre[:, 1].real == pytest.approx([1, 1, 0] if moving == "spindle" else [0, 0, 1])


def test_what_holds_against_ground_is_shown() -> None:
    found = holders(COAXIAL)
    assert found is not None
    assert found.names == ("b1", "b4", "b2")
    joined = tuple(replace(s, holds="outer", against="spindle") for s in COAXIAL.supports[1:3])
    assert holders(replace(COAXIAL, supports=joined)) is None
    assert holders(INNER) is None


def test_a_further_rotor_is_where_its_shaft_is() -> None:
    x = surfaces(COAXIAL)["outer"].points[:, 0]
    assert x.min() == pytest.approx(OUTER.shaft.start, abs=0.01)
