"""The dense rotor of the tests: signs, what is decoupled from what, and its two bending planes; the
matrices of the product, not reduced, are its own."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rotordyn.equation.dofs import DIRECTIONS, position
from rotordyn.equation.elements.shear import cowper
from rotordyn.equation.fineness import Fineness
from rotordyn.equation.mesh import build_mesh
from rotordyn.equation.seat import turn
from rotordyn.equation.structure import Structure
from rotordyn.equation.term import State
from rotordyn.machine.lumped import PointMass
from tests.oracles.dense_rotor.assemble import add_at_nodes, bending_plane, rotor_matrices
from tests.oracles.dense_rotor.lumped import lumped_element
from tests.oracles.dense_rotor.selection import LATERAL, PLANE_Y, PLANE_Z
from tests.oracles.dense_rotor.timoshenko import shaft_element
from tests.oracles.dense_rotor.unreduced import unreduced
from tests.oracles.matrices import definite, held
from tests.oracles.rotors import STEPPED, on_supports
from tests.oracles.whirl import eigenvalues, state_space

LENGTH, OUTER, INNER = 0.06, 0.08, 0.03
ELEMENT = shaft_element(*map(np.asarray, (LENGTH, OUTER, INNER, 2.1e11, 8e10, 7850.0, 0.7)))
RING = math.pi * (OUTER**2 - INNER**2) / 4
POLAR = math.pi * (OUTER**4 - INNER**4) / 32
MESH = build_mesh(STEPPED, 0.04)
FULL = rotor_matrices(STEPPED, MESH)
PLANE = bending_plane(STEPPED, MESH)
SPIN = 2500.0
BEARING = np.diag([6e7, 2e8, 2e8, 2e5, 2e5])
BEARING[1, 4], BEARING[4, 1] = -4e6, -3.6e6
BEARING[2, 3], BEARING[3, 2] = 4e6, 3.6e6
SEATS = {2: 1, MESH.nodes - 2: -1}
TURNED = np.array([turn(BEARING, thrust) for thrust in SEATS.values()])
GROUPS = {"x": "axial", "thx": "torsion", "y": "xy", "thz": "xy", "z": "xz", "thy": "xz"}


def row(node: int, freedom: str) -> int:
    return 6 * node + position(freedom)


def test_symmetry() -> None:
    for matrix in (ELEMENT.mass, ELEMENT.translational_mass, ELEMENT.stiffness):
        assert (matrix == matrix.T).all()
    assert (ELEMENT.gyroscopic == -ELEMENT.gyroscopic.T).all()


def test_four_motions_are_decoupled() -> None:
    names = [GROUPS[name] for name in DIRECTIONS * 2]
    apart = np.array([[a != b for b in names] for a in names])
    for matrix in (ELEMENT.mass, ELEMENT.translational_mass, ELEMENT.stiffness):
        assert not matrix[apart].any()
    between = np.array([[{a, b} == {"xy", "xz"} for b in names] for a in names])
    assert not ELEMENT.gyroscopic[~between].any()


def test_shearing_force_sign() -> None:
    """Lifting the right end by y turns the shaft towards +thz; by z towards −thy."""
    assert ELEMENT.stiffness[row(0, "thz"), row(1, "y")] < 0
    assert ELEMENT.stiffness[row(0, "thy"), row(1, "z")] > 0


def test_rods() -> None:
    k, m = ELEMENT.stiffness, ELEMENT.mass
    assert k[row(0, "x"), row(0, "x")] == pytest.approx(2.1e11 * RING / LENGTH)
    assert k[row(0, "thx"), row(1, "thx")] == pytest.approx(-8e10 * POLAR / LENGTH)
    assert m[row(0, "x"), row(1, "x")] == pytest.approx(7850 * RING * LENGTH / 6)
    assert m[row(1, "thx"), row(1, "thx")] == pytest.approx(7850 * POLAR * LENGTH / 3)


@pytest.mark.parametrize("rate", [(0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.3, -0.8)])
def test_gyroscopic_moment_is_the_rate_of_the_spin_momentum(rate: tuple[float, ...]) -> None:
    """Ip Ω d(axis)/dt, the axis turning with θ′: the moment that keeps it turning."""
    spin, polar = 700.0, 0.013
    body = lumped_element(PointMass("disc", 0.0, 5.0, polar, 0.008))
    velocity = np.concatenate([np.zeros(3), rate])
    moment = spin * body.gyroscopic @ velocity
    expected = polar * spin * np.cross(rate, [1.0, 0.0, 0.0])
    assert moment[3:] == pytest.approx(expected)
    assert not moment[:3].any()


def test_element_turns_like_the_rigid_body_it_fills() -> None:
    """Its gyroscopic matrix, for a rotation as a whole, is that of a lumped polar inertia."""
    vector = np.zeros((12, 2))
    for node, lever in ((0, -LENGTH / 2), (1, LENGTH / 2)):
        vector[row(node, "thy"), 0], vector[row(node, "z"), 0] = 1.0, -lever
        vector[row(node, "thz"), 1], vector[row(node, "y"), 1] = 1.0, lever
    polar = 7850 * POLAR * LENGTH
    body = lumped_element(PointMass("body", 0.0, 1.0, polar, polar))
    tilts = [position("thy"), position("thz")]
    found = vector.T @ ELEMENT.gyroscopic @ vector
    assert found == pytest.approx(body.gyroscopic[np.ix_(tilts, tilts)])


def test_lumped_mass() -> None:
    body = lumped_element(PointMass("disc", 0.3, 5.0, 0.013, 0.008))
    assert np.diag(body.mass).tolist() == [5.0, 5.0, 5.0, 0.013, 0.008, 0.008]
    assert np.diag(body.translational_mass).tolist() == [0.0, 5.0, 5.0, 0.0, 0.0, 0.0]
    assert np.count_nonzero(body.mass) == 6


def test_many_elements_at_once() -> None:
    lengths = np.array([0.01, LENGTH])
    many = shaft_element(lengths, *map(np.asarray, (OUTER, INNER, 2.1e11, 8e10, 7850.0, 0.7)))
    assert many.stiffness.shape == many.gyroscopic.shape == (2, 12, 12)
    assert many.stiffness[1] == pytest.approx(ELEMENT.stiffness)
    assert many.mass[1] == pytest.approx(ELEMENT.mass)


def test_full_matrices_element_by_element() -> None:
    """A plain loop over elements and bodies."""
    expected = {key: np.zeros_like(FULL.mass) for key in ("mass", "gyroscopic", "stiffness")}
    for k in range(MESH.nodes - 1):
        outer, inner, nu = MESH.outer[0, k], MESH.inner[0, k], MESH.poisson_ratio[k]
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


@pytest.mark.parametrize("selection", [PLANE_Y, PLANE_Z])
def test_both_planes_have_the_same_matrices(selection: object) -> None:
    found = rotor_matrices(STEPPED, MESH, selection)
    for key in ("mass", "stiffness", "translational_mass"):
        expected = getattr(PLANE, key)
        assert getattr(found, key) == pytest.approx(expected, rel=1e-12, abs=1e-12), key


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


def test_the_matrices_of_the_product_are_the_same() -> None:
    """Standard elements on supports that couple all six directions of a node."""
    numbers = np.random.default_rng(3).uniform(-1.0, 1.0, (2, 6, 6))
    both = (definite(numbers[0], 1e8), definite(numbers[1], 1e3))
    rotor = replace(STEPPED, supports=(held("a", 0.0, *both), held("b", 0.2, *both)))
    mesh = build_mesh(rotor, 0.04)
    structure = Structure(rotor, mesh, Fineness(1000.0))
    none = np.zeros((1, 0, 6, 6)), np.zeros((1, 0), dtype=bool)
    found = unreduced(structure, State(np.zeros(1), *none))
    whole = rotor_matrices(rotor, mesh)
    damping, stiffness = on_supports(whole, rotor, mesh)
    sign = np.outer(structure.dofs.sign, structure.dofs.sign)
    pairs = [
        (found.mass, whole.mass),
        (found.gyroscopic, whole.gyroscopic),
        (found.stiffness + found.held, stiffness),
        (found.damping, damping),
    ]
    for ours, theirs in pairs:  # entries that vanish are rounding of the integration in ours
        rounding = 1e-12 + 1e-15 * np.abs(theirs).max()
        np.testing.assert_allclose(sign * ours, theirs, rtol=1e-12, atol=rounding)
