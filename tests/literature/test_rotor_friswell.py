"""Friswell, Penny, Garvey, Lees: Dynamics of Rotating Machines (2010), worked examples.

The values are those of an independent finite-element code with the same six elements and
Hutchinson's shear coefficient; they agree with the book's to its print.
"""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import eigh

import rotordyn
from bearings.materials import Material
from rotordyn.equation.elements.shear import shear_coefficient
from rotordyn.equation.mesh import build_mesh
from rotordyn.machine.lumped import Disc, PointMass
from rotordyn.machine.spindle import Spindle
from tests.oracles.beam_column import axial_force_stiffness
from tests.oracles.dense_rotor.assemble import (
    add_at_nodes,
    bending_plane,
    chain,
    rotor_matrices,
    torsion_rod,
)
from tests.oracles.dense_rotor.selection import LATERAL
from tests.oracles.rotors import on_supports, support, uniform
from tests.oracles.spindles import CASES
from tests.oracles.standard_beam import shear_parameter
from tests.oracles.whirl import eigenvalues, frequencies_at_rest

HZ = 2 * math.pi
RPM = math.pi / 30
STEEL = Material("steel", 211e9, 211e9 / (2 * 81.2e9) - 1, 7810.0)
LEFT = Disc("left", 0.5, 0.28, 0.05, 0.07, STEEL)
RIGHT = Disc("right", 1.0, 0.35, 0.05, 0.07, STEEL)
OVERHUNG = Disc("overhung", 1.5, 0.35, 0.05, 0.07, STEEL)


def base(stiffness: tuple[float, ...], damping: float = 0.0) -> Spindle:
    ends = (support("left", 0.0, stiffness, damping), support("right", 1.5, stiffness, damping))
    rotor = uniform(1.5, 0.05, STEEL, shear="hutchinson", supports=ends)
    return replace(rotor, discs=(LEFT, RIGHT))


def overhung() -> Spindle:
    ends = (support("left", 0.0, (1e7, 1e7)), support("middle", 1.0, (1e7, 1e7)))
    rotor = uniform(1.5, 0.05, STEEL, shear="hutchinson", supports=ends)
    return replace(rotor, discs=(OVERHUNG,))


def roots(spindle: Spindle, rpm: float) -> np.ndarray:
    mesh = build_mesh(spindle, 0.25)
    rotor = rotor_matrices(spindle, mesh, LATERAL)
    damping, stiffness = on_supports(rotor, spindle, mesh, LATERAL)
    return eigenvalues(rotor.mass, damping + rpm * RPM * rotor.gyroscopic, stiffness)[:6] / HZ


def criticals(spindle: Spindle) -> np.ndarray:
    mesh = build_mesh(spindle, 0.25)
    rotor = rotor_matrices(spindle, mesh, LATERAL)
    stiffness = on_supports(rotor, spindle, mesh, LATERAL)[1]
    inverse = eigh(rotor.mass - 1j * rotor.gyroscopic, stiffness, eigvals_only=True)
    return np.sort(1.0 / np.sqrt(inverse[inverse > 0])) / RPM


def pairs(*values: float) -> list[float]:
    return [value for value in values for _ in range(2)]


def test_discs() -> None:
    left, right = LEFT.as_point_mass(), RIGHT.as_point_mass()
    found = [left.mass, left.diametral_inertia, left.polar_inertia]
    assert found == pytest.approx([32.5897, 0.178089, 0.329564], rel=3e-6)
    found = [right.mass, right.diametral_inertia, right.polar_inertia]
    assert found == pytest.approx([51.5253, 0.423581, 0.805082], rel=3e-6)


@pytest.mark.parametrize(
    ("stiffness", "rpm", "expected"),
    [
        ((1e6, 1e6), 0, pairs(13.792, 43.661, 114.082)),
        ((1e6, 1e6), 4000, [13.591, 13.974, 40.075, 46.909, 95.524, 131.637]),
        ((1e6, 0.8e6), 0, [13.155, 13.792, 40.510, 43.661, 108.146, 114.082]),
        ((1e6, 0.8e6), 4000, [13.103, 13.825, 38.142, 45.721, 92.867, 128.424]),
        ((1e6, 0.2e6), 4000, [8.546, 13.771, 22.355, 44.067, 78.757, 120.385]),
        ((1e6, 1e6, 0.5e6), 0, [11.663, 14.802, 33.971, 49.198, 97.969, 126.617]),
        ((1e6, 1e6, 0.5e6), 4000, [11.652, 14.789, 33.156, 49.692, 89.417, 133.790]),
    ],
    ids=["5.9.1-rest", "5.9.1", "5.9.2-rest", "5.9.2", "5.9.3", "5.9.4-rest", "5.9.4"],
)
def test_two_discs(stiffness: tuple[float, ...], rpm: float, expected: list[float]) -> None:
    assert roots(base(stiffness), rpm).imag == pytest.approx(expected, abs=6e-4)


@pytest.mark.parametrize(
    ("rpm", "natural", "damped"),
    [
        (0, pairs(13.906, 48.181, 137.056), pairs(13.888, 46.543, 103.225)),
        (
            4000,
            [13.698, 14.092, 43.610, 52.184, 122.350, 149.81],
            [13.682, 14.072, 41.984, 50.653, 104.233, 105.665],
        ),
    ],
)
def test_damped_bearings(rpm: float, natural: list[float], damped: list[float]) -> None:
    """5.9.5"""
    found = roots(base((1e6, 1e6), damping=3e3), rpm)
    assert found.imag == pytest.approx(damped, abs=6e-4)
    assert np.sort(np.abs(found))[:5] == pytest.approx(natural[:5], abs=6e-4)
    assert np.sort(np.abs(found))[5] == pytest.approx(natural[5], abs=6e-3 if rpm else 6e-4)


@pytest.mark.parametrize(
    ("rpm", "expected"),
    [
        (0, pairs(14.347, 100.393, 132.178)),
        (4000, [12.127, 16.539, 90.093, 100.951, 103.101, 186.886]),
    ],
)
def test_overhung(rpm: float, expected: list[float]) -> None:
    """5.9.9"""
    assert roots(overhung(), rpm).imag == pytest.approx(expected, abs=6e-4)


def test_synchronous_criticals() -> None:
    expected = [825.16, 829.90, 2487.90, 2756.31, 5379.57, 8841.20]
    assert criticals(base((1e6, 1e6)))[:6] == pytest.approx(expected, abs=6e-3)
    expected = [832.73, 890.82, 5026.38, 6063.89, 6117.71]
    assert criticals(overhung())[:5] == pytest.approx(expected, abs=6e-3)


def test_torsion_free_free() -> None:
    """650.41 rad/s, as an established six-freedom code lists it."""
    spindle = base((1e6, 1e6))
    rod = torsion_rod(spindle, build_mesh(spindle, 0.25))
    assert frequencies_at_rest(rod.mass, rod.stiffness)[1] == pytest.approx(650.41, abs=0.006)


@pytest.mark.parametrize(
    ("force", "expected"),
    [
        (0.0, [13.792067, 43.658247, 114.080085]),
        (1e4, [13.935788, 43.913150, 114.759565]),
        (1e5, [15.020440, 46.132265, 120.620287]),
        (-1e4, [13.642635, 43.401542, 113.394556]),
    ],
)
def test_axial_force(force: float, expected: list[float]) -> None:
    """5.9.7 as an established open code prints it; tension stiffens."""
    rotor = base((1e6, 1e6))
    spindle = replace(rotor, shaft=replace(rotor.shaft, shear_coefficient="cowper"))
    mesh = build_mesh(spindle, 0.25)
    plane = bending_plane(spindle, mesh)
    kappa = shear_coefficient("cowper", mesh.poisson_ratio, 0.0)
    area, moment = math.pi * 0.05**2 / 4, math.pi * 0.05**4 / 64
    phi = shear_parameter(
        mesh.length, mesh.young_modulus * moment, kappa * mesh.shear_modulus * area
    )
    tension = chain(axial_force_stiffness(mesh.length, phi, np.full(len(phi), force)))
    ends = np.array([[[1e6, 0.0], [0.0, 0.0]]] * 2)
    stiffness = add_at_nodes(plane.stiffness + tension, (0, mesh.nodes - 1), ends)
    found = frequencies_at_rest(plane.mass, stiffness)[:3] / HZ
    assert found == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize(
    ("rpm", "expected"),
    [(0, pairs(44.322, 397.537)), (1000, [42.250, 46.404, 389.801])],
)
def test_slender_overhung(rpm: float, expected: list[float]) -> None:
    """6.8.1"""
    ends = (support("left", 0.0, (1e7, 1e7)), support("middle", 1.0, (1e7, 1e7)))
    disc = PointMass("disc", 1.5, 15.3, 0.120, 0.062)
    material = Material("steel", 211e9, 0.3, 7810.0)
    rotor = uniform(1.5, 0.025, material, masses=(disc,), supports=ends)
    found = roots(rotor, rpm).imag * HZ
    assert found[: len(expected)] == pytest.approx(expected, abs=6e-4)


def campbell(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Damped frequencies [Hz] and damping ratios of the bending modes, at rest and 4000 rpm."""
    case = rotordyn.load(path)
    found = rotordyn.run(replace(case, analyses={"campbell": case.analyses["campbell"]}))
    modes = found["campbell"].sel(speed=found["campbell"].speed[[0, -1]])
    bending = modes.isel(mode=np.flatnonzero(modes.kind == "bending"))
    assert bending.speed_rpm.values == pytest.approx([0, 4000])
    order = np.argsort(bending.frequency.values, axis=1)
    return tuple(
        np.take_along_axis(bending[name].values, order, axis=1)
        for name in ("frequency", "damping_ratio")
    )  # type: ignore[return-value]


def test_cross_coupled_bearings_from_a_case_file() -> None:
    """5.9.4, its matrices written whole."""
    found, _ = campbell(CASES / "friswell_cross_coupled.yaml")
    assert found[0] == pytest.approx([11.663, 14.802, 33.971, 49.198, 97.969, 126.617], abs=6e-4)
    assert found[1] == pytest.approx([11.652, 14.789, 33.156, 49.692, 89.417, 133.790], abs=6e-4)


DAMPED = """\
spindle: friswell_two_discs
override:
  supports.left.damping: &damping {dof: [z, y], matrix: [[3e3 N s/m, 0], [0, 3 kN s/m]]}
  supports.right.damping: *damping
conditions: {element_length: 250 mm}
speeds: [0 rpm, 2000 rpm, 4000 rpm]
analyses: {campbell: {max_frequency: 120 Hz}}
"""


def test_damped_bearings_from_a_case_file(tmp_path: Path) -> None:
    """5.9.5: damped and natural frequencies."""
    path = tmp_path / "damped.yaml"
    path.write_text(DAMPED, encoding="utf-8")
    damped, ratio = campbell(path)
    assert damped[0] == pytest.approx(pairs(13.888, 46.543, 103.225), abs=6e-4)
    expected = [13.682, 14.072, 41.984, 50.653, 104.233, 105.665]
    assert damped[1] == pytest.approx(expected, abs=6e-4)
    natural = damped / np.sqrt(1.0 - ratio**2)
    assert natural[0] == pytest.approx(pairs(13.906, 48.181, 137.056), abs=1e-3)
    assert np.sort(natural[1])[:5] == pytest.approx(
        [13.698, 14.092, 43.610, 52.184, 122.350], abs=1e-3
    )
    assert np.sort(natural[1])[5] == pytest.approx(149.81, abs=0.01)
