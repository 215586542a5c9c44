"""A spindle turned end for end is the same machine."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotordyn.equation.mesh import build_mesh
from rotordyn.equation.seat import turn
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.spindle import Spindle
from tests.oracles.dense_rotor.assemble import add_at_nodes, rotor_matrices
from tests.oracles.rotors import STEPPED
from tests.oracles.whirl import eigenvalues

FREE_SPIN = 10.0  # rad/s: below are only the numerical traces of the free rotation
BEARINGS = ((0.02, 1), (0.05, 1), (0.20, -1), (0.22, -1))


def own_frame(load: float) -> np.ndarray:
    """An isotropic, slightly unsymmetric stiffness as a loaded bearing has in its own frame."""
    axial, radial, cross, tilt = 6e7, 2e8, 4e6, 2e5
    matrix = np.diag([axial, radial, radial, tilt, tilt]) * load
    matrix[1, 4], matrix[4, 1] = -cross * load, -0.95 * cross * load
    matrix[2, 3], matrix[3, 2] = cross * load, 0.95 * cross * load
    return matrix


def mirrored(spindle: Spindle) -> Spindle:
    """x → −x: sections in reverse, stations with the other sign."""
    shaft = Shaft(-spindle.shaft.end, spindle.shaft.sections[::-1])
    masses = tuple(replace(mass, x=-mass.x) for mass in spindle.masses)
    return replace(spindle, shaft=shaft, masses=masses, points={})


def roots(spindle: Spindle, bearings: tuple[tuple[float, int], ...], spin: float) -> np.ndarray:
    seated = replace(spindle, points={f"b{k}": x for k, (x, _) in enumerate(bearings)})
    mesh = build_mesh(seated, 0.05)
    rotor = rotor_matrices(seated, mesh)
    blocks = np.array([turn(own_frame(1.0), thrust) for _, thrust in bearings])
    stiffness = add_at_nodes(rotor.stiffness, [mesh.node_of(x) for x, _ in bearings], blocks)
    found = eigenvalues(rotor.mass, spin * rotor.gyroscopic, stiffness)
    return found[found.imag > FREE_SPIN][:14]


@pytest.mark.parametrize("spin", [0.0, 2500.0])
def test_mirrored_spindle_with_thrust_reversed(spin: float) -> None:
    other = tuple((-x, -thrust) for x, thrust in BEARINGS)
    expected = roots(STEPPED, BEARINGS, spin)
    assert roots(mirrored(STEPPED), other, spin) == pytest.approx(expected, rel=1e-7, abs=1e-3)


def test_thrust_left_as_it_was_is_another_machine() -> None:
    other = tuple((-x, thrust) for x, thrust in BEARINGS)
    expected = roots(STEPPED, BEARINGS, 0.0)
    assert np.abs(roots(mirrored(STEPPED), other, 0.0) / expected - 1).max() > 1e-3


def test_sense_of_spin_does_not_matter() -> None:
    expected = roots(STEPPED, BEARINGS, 2500.0)
    assert roots(STEPPED, BEARINGS, -2500.0) == pytest.approx(expected, rel=1e-7, abs=1e-3)


def test_back_to_back_is_stiffer_in_tilt_than_face_to_face() -> None:
    """Radial load at a distance from two bearings: with "O" the pressure lines spread the base."""
    spread = []
    for thrusts in ((1, -1), (-1, 1)):
        turned = [turn(own_frame(1.0), thrust) for thrust in thrusts]
        lever = np.zeros((2, 6))
        lever[:, 1], lever[:, 5] = (-0.03, 0.03), 1.0
        spread.append(sum(q @ k @ q for q, k in zip(lever, turned, strict=True)))
    back_to_back, face_to_face = spread
    assert back_to_back > face_to_face
