"""Static answers of free rotors, by sums along the chain, against their assembled stiffness."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.joint import Joint
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.numerics.sparse import filled
from tests.oracles.dense_rotor.assemble import loaded_plane, loaded_rod
from tests.oracles.dense_rotor.selection import AXIAL
from rotordyn.system.flexibility import bending_answer, rod_answer
from rotordyn.system.geometric_stiffness import GeometricStiffness
from rotordyn.system.hierarchic_rotor import (
    axial_properties,
    beams,
    bending_hierarchy,
    rigid_motions,
    rod_hierarchy,
)
from rotordyn.model.mesh import build_mesh
from rotordyn.system.stiffening import stiffening
from tests.oracles.rotors import STEEL, uniform

HZ = 2.0 * math.pi
CONE = Joint("cone", 0.2, radial=3e8, tilt=4e5, axial=5e8, torsion=6e4)


def stepped(**more: object) -> Spindle:
    sizes = [(0.1, 0.05, 0.02), (0.15, 0.08, 0.0), (0.2, 0.03, 0.0), (0.05, 0.09, 0.04)]
    sections = tuple(Section(*size, STEEL) for size in sizes)
    return Spindle("stepped", Shaft(0.0, sections), **more)  # type: ignore[arg-type]


def balanced(rigid: np.ndarray, seed: int) -> np.ndarray:
    """Random loads (n, 5) without resultant."""
    loads = np.random.default_rng(seed).standard_normal((len(rigid), 5))
    return loads - rigid @ np.linalg.solve(rigid.T @ rigid, rigid.T @ loads)


@pytest.mark.parametrize("joints", [(), (CONE,)], ids=["whole", "jointed"])
@pytest.mark.parametrize("highest", [500.0, 20000.0], ids=["standard", "higher degrees"])
def test_bending(joints: tuple[Joint, ...], highest: float) -> None:
    spindle = stepped(joints=joints)
    elements = bending_hierarchy(spindle, HZ * highest, 0.0, 1e-4)
    stiffness = filled(loaded_plane(spindle, elements).stiffness)
    load = balanced(rigid_motions(elements), 3)
    answer = bending_answer(spindle, elements, stiffness)(load)
    assert (answer[:2] == 0.0).all()
    scale = np.abs(stiffness) @ np.abs(answer)
    assert (np.abs(stiffness @ answer - load) < 1e-12 * scale).all()


@pytest.mark.parametrize("joints", [(), (CONE,)], ids=["whole", "jointed"])
def test_rods(joints: tuple[Joint, ...]) -> None:
    spindle = stepped(joints=joints)
    elements = rod_hierarchy(spindle, HZ * 30000.0, 1e-5, axial_properties, "axial")
    stiffness = filled(loaded_rod(spindle, elements, AXIAL).stiffness)
    together = (np.arange(elements.size) < elements.mesh.nodes).astype(float)[:, None]
    load = balanced(together, 4)
    rigidity, _ = axial_properties(elements.mesh)
    answer = rod_answer(rigidity, elements, stiffness)(load)
    scale = np.abs(stiffness) @ np.abs(answer)
    assert (np.abs(stiffness @ answer - load) < 1e-12 * scale).all()


def test_short_elements_keep_the_digits_that_their_stiffness_loses() -> None:
    """Two opposite moments bend a bar into an arc, whatever the length of its elements."""
    bar = uniform(1.0, 0.001)
    mesh = build_mesh(bar, 1e-4)
    elements = beams(bar, mesh, np.ones(mesh.nodes - 1, dtype=np.intp))
    load = np.zeros((elements.size, 1))
    load[[1, -1], 0] = -1e-3, 1e-3
    answer = bending_answer(bar, elements, loaded_plane(bar, elements).stiffness)(load)
    curvature = 1e-3 / (STEEL.young_modulus * math.pi * 0.001**4 / 64.0)
    np.testing.assert_allclose(answer[1::2, 0], curvature * mesh.x, rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(answer[0::2, 0], curvature * mesh.x**2 / 2.0, rtol=1e-11, atol=1e-15)


def test_compressed_rows_hold_the_same_matrices(monkeypatch: pytest.MonkeyPatch) -> None:
    from rotordyn.system import hierarchy

    spindle = replace(stepped(joints=(CONE,)))
    elements = bending_hierarchy(spindle, HZ * 20000.0, 0.0, 1e-4)
    dense = loaded_plane(spindle, elements)
    monkeypatch.setattr(hierarchy, "LARGE", 0)
    compressed = loaded_plane(spindle, elements)
    for name in ("mass", "stiffness", "polar", "translational_mass"):
        one, other = getattr(dense, name), getattr(compressed, name)
        assert other.nnz < one.size / 3
        np.testing.assert_allclose(filled(other), one, rtol=1e-13, atol=0.0)


def test_slopes_answer_axial_forces_as_their_table() -> None:
    """States whose forces are few fields, and one of all its own."""
    draw = np.random.default_rng(5)
    left, right = draw.standard_normal((40, 3)), draw.standard_normal((40, 4))
    entries = np.einsum("eqa,eqb->eab", left.reshape(10, 4, 3), right.reshape(10, 4, 4))
    for force in (draw.standard_normal((6, 10)), np.outer(np.arange(3.0), np.ones(10))):
        expected = np.pad(np.tensordot(force, entries, 1), ((0, 0), (1, 2), (0, 3)))
        found = GeometricStiffness(left, right).padded(before=1, rows=2, columns=3).under(force)
        np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12)
    assert not GeometricStiffness(left, right).under(np.zeros((2, 10))).any()


def test_the_drawbar_by_all_nodes() -> None:
    spindle = stepped(drawbar=Drawbar(20000.0, 0.05, 0.4, (0.2, 0.3)))
    mesh = build_mesh(spindle)
    tension = stiffening(spindle, mesh)
    every = np.eye(2 * mesh.nodes).reshape(mesh.nodes, 2, -1)
    np.testing.assert_allclose(tension.strung(mesh.nodes), tension.bar(every), rtol=1e-14)
