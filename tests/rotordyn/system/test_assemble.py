"""All ways of assembling the rotor agree with each other and with its definition."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.oracles.dense_rotor.lumped import lumped_element
from rotordyn.model.elements.shear import cowper
from rotordyn.model.seat import turn
from tests.oracles.dense_rotor.timoshenko import shaft_element
from tests.oracles.dense_rotor.assemble import (
    add_at_nodes,
    axial_rod,
    bending_plane,
    chain,
    rotor_matrices,
    torsion_rod,
)
from tests.oracles.dense_rotor.selection import (
    ALL,
    AXIAL,
    LATERAL,
    PLANE_Y,
    PLANE_Z,
    TORSION,
    Selection,
)
from rotordyn.model.mesh import build_mesh
from tests.oracles.rotors import STEPPED
from tests.oracles.whirl import eigenvalues, state_space

MESH = build_mesh(STEPPED, 0.04)
FULL = rotor_matrices(STEPPED, MESH)
PLANE = bending_plane(STEPPED, MESH)
SPIN = 2500.0
BEARING = np.diag([6e7, 2e8, 2e8, 2e5, 2e5])
BEARING[1, 4], BEARING[4, 1] = -4e6, -3.6e6
BEARING[2, 3], BEARING[3, 2] = 4e6, 3.6e6
SEATS = {2: 1, MESH.nodes - 2: -1}
TURNED = np.array([turn(BEARING, thrust) for thrust in SEATS.values()])


def part(matrix: np.ndarray, rows: Selection, columns: Selection | None = None) -> np.ndarray:
    """What a selection sees of the full matrix, entry by entry."""
    columns = columns or rows
    nodes = range(MESH.nodes)
    row = [ALL.row(n, name) for n in nodes for name in rows.names]
    column = [ALL.row(n, name) for n in nodes for name in columns.names]
    signs = np.outer(rows.signs * MESH.nodes, columns.signs * MESH.nodes)
    return matrix[np.ix_(row, column)] * signs


def test_full_matrices_element_by_element() -> None:
    """A plain loop over elements and bodies."""
    expected = {key: np.zeros_like(FULL.mass) for key in ("mass", "gyroscopic", "stiffness")}
    for k in range(MESH.nodes - 1):
        outer, inner, nu = MESH.outer_diameter[k], MESH.inner_diameter[k], MESH.poisson_ratio[k]
        element = shaft_element(
            MESH.x[k + 1] - MESH.x[k],
            outer,
            inner,
            MESH.young_modulus[k],
            MESH.young_modulus[k] / 2 / (1 + nu),
            MESH.density[k],
            cowper(nu, inner / outer),
        )
        for key, matrix in expected.items():
            matrix[6 * k : 6 * k + 12, 6 * k : 6 * k + 12] += getattr(element, key)
    for body in STEPPED.lumped:
        at = slice(6 * MESH.node_of(body.x), 6 * MESH.node_of(body.x) + 6)
        expected["mass"][at, at] += lumped_element(body).mass
        expected["gyroscopic"][at, at] += lumped_element(body).gyroscopic
    for key, matrix in expected.items():
        assert getattr(FULL, key) == pytest.approx(matrix, rel=1e-12), key


@pytest.mark.parametrize("selection", [LATERAL, PLANE_Y, PLANE_Z, AXIAL, TORSION])
def test_selected_freedoms_are_the_part_of_the_whole(selection: Selection) -> None:
    found = rotor_matrices(STEPPED, MESH, selection)
    for key in ("mass", "gyroscopic", "stiffness", "translational_mass"):
        expected = part(getattr(FULL, key), selection)
        assert getattr(found, key) == pytest.approx(expected, rel=1e-13), key


@pytest.mark.parametrize("selection", [PLANE_Y, PLANE_Z])
def test_both_planes_have_the_same_matrices(selection: Selection) -> None:
    for key in ("mass", "stiffness", "translational_mass"):
        expected = part(getattr(FULL, key), selection)
        assert getattr(PLANE, key) == pytest.approx(expected, rel=1e-12, abs=1e-12), key


def test_polar_matrix_couples_the_planes() -> None:
    assert part(FULL.gyroscopic, PLANE_Y, PLANE_Z) == pytest.approx(PLANE.polar, rel=1e-12)
    assert part(FULL.gyroscopic, PLANE_Z, PLANE_Y) == pytest.approx(-PLANE.polar, rel=1e-12)


def test_rods() -> None:
    for rod, selection in ((axial_rod, AXIAL), (torsion_rod, TORSION)):
        found = rod(STEPPED, MESH)
        assert found.mass == pytest.approx(part(FULL.mass, selection), rel=1e-12)
        assert found.stiffness == pytest.approx(part(FULL.stiffness, selection), rel=1e-12)


def test_full_rotor_has_the_roots_of_the_complex_form() -> None:
    """λ of K + λ Ω(−i Jp) + λ² M and their conjugates; bearings isotropic but unsymmetric."""
    stiffness = add_at_nodes(PLANE.stiffness, tuple(SEATS), PLANE_Y.take(TURNED))
    half = state_space(PLANE.mass, -1j * SPIN * PLANE.polar, stiffness)[0]
    half = np.where(half.imag > 0, half, half.conj())
    lateral = rotor_matrices(STEPPED, MESH, LATERAL)
    seated = add_at_nodes(lateral.stiffness, tuple(SEATS), LATERAL.take(TURNED))
    found = eigenvalues(lateral.mass, SPIN * lateral.gyroscopic, seated)[:16]
    distance = np.abs(half[:, None] - found).min(axis=0)
    assert (distance < 1e-6 * np.abs(found)).all()


def test_forward_whirl_is_positive_and_rises_with_speed() -> None:
    """Of a pair the faster one turns with the shaft: z lags y by a quarter turn."""
    lateral = rotor_matrices(STEPPED, MESH, LATERAL)
    isotropic = LATERAL.take(TURNED + TURNED.swapaxes(-1, -2)) / 2
    seated = add_at_nodes(lateral.stiffness, tuple(SEATS), isotropic)
    values, shapes = state_space(lateral.mass, SPIN * lateral.gyroscopic, seated)
    positive = np.flatnonzero(values.imag > 0)
    slow, fast = positive[np.argsort(values[positive].imag)][:2]
    tip = [LATERAL.row(0, name) for name in ("y", "z")]
    for mode, turning in ((slow, 1j), (fast, -1j)):
        y, z = shapes[tip, mode]
        assert z / y == pytest.approx(turning, abs=1e-6)


def test_chain_is_banded() -> None:
    rows, columns = np.nonzero(FULL.stiffness)
    assert np.abs(rows - columns).max() < 12
    rows, columns = np.nonzero(PLANE.mass)
    assert np.abs(rows - columns).max() < 4


def test_chain_of_two() -> None:
    blocks = np.array([[[1.0, -1.0], [-1.0, 1.0]], [[5.0, -5.0], [-5.0, 5.0]]])
    expected = [[1.0, -1.0, 0.0], [-1.0, 6.0, -5.0], [0.0, -5.0, 5.0]]
    assert chain(blocks).tolist() == expected


def test_adding_at_nodes() -> None:
    matrix, block = np.zeros((4, 4)), np.array([[1.0, 2.0], [3.0, 4.0]])
    total = add_at_nodes(matrix, (1, 1), np.array([block, block]))
    assert total[2:, 2:].tolist() == (2 * block).tolist()
    assert not total[:2].any()
    assert not matrix.any()


def test_adding_a_batch_at_nodes() -> None:
    blocks = np.arange(24.0).reshape(3, 2, 2, 2)
    total = add_at_nodes(np.zeros((4, 4)), (0, 1), blocks)
    assert total.shape == (3, 4, 4)
    assert total[2, 2:, 2:].tolist() == blocks[2, 1].tolist()


def test_no_lumped_masses() -> None:
    bare = replace(STEPPED, masses=())
    found = bending_plane(bare, MESH)
    assert np.abs(found.mass).sum() < np.abs(PLANE.mass).sum()
    assert found.stiffness == pytest.approx(PLANE.stiffness)
