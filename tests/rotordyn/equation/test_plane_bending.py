"""The element's closed forms against integrals over its shape functions, found independently."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.polynomial import Polynomial

from tests.oracles.beam_column import axial_force_stiffness
from tests.oracles.standard_beam import plane_bending, shear_parameter

OUTER, INNER, YOUNG, SHEAR, DENSITY, KAPPA = 0.08, 0.03, 2.1e11, 8e10, 7850.0, 0.7
AREA = math.pi * (OUTER**2 - INNER**2) / 4
MOMENT = math.pi * (OUTER**4 - INNER**4) / 64
LENGTHS = pytest.mark.parametrize("length", [0.004, 0.05, 2.0])


def element(length: float):
    return plane_bending(*map(np.asarray, (length, OUTER, INNER, YOUNG, SHEAR, DENSITY, KAPPA)))


def shapes(length: float) -> list[tuple[Polynomial, Polynomial]]:
    """(v, φ) for a unit value of each freedom: φ quadratic, v′ − φ = −E I φ″ / (κ G A)."""
    slip = YOUNG * MOMENT / (KAPPA * SHEAR * AREA)
    basis = []
    for coefficients in np.eye(4):
        phi = Polynomial(coefficients[:3])
        v = (phi - slip * phi.deriv(2)).integ() + coefficients[3]
        basis.append((v, phi))
    ends = np.array([[v(0), p(0), v(length), p(length)] for v, p in basis]).T
    weights = np.linalg.inv(ends)
    return [
        (
            sum(w * v for w, (v, _) in zip(column, basis, strict=True)),
            sum(w * p for w, (_, p) in zip(column, basis, strict=True)),
        )
        for column in weights.T
    ]


def integral(length: float, left: list[Polynomial], right: list[Polynomial]) -> np.ndarray:
    return np.array([[(a * b).integ()(length) for b in right] for a in left])


@LENGTHS
def test_matrices_are_the_integrals(length: float) -> None:
    found, functions = element(length), shapes(length)
    v, phi = [f[0] for f in functions], [f[1] for f in functions]
    curvature = [p.deriv() for p in phi]
    strain = [a.deriv() - b for a, b in functions]
    translation = DENSITY * AREA * integral(length, v, v)
    rotary = DENSITY * MOMENT * integral(length, phi, phi)
    stiffness = YOUNG * MOMENT * integral(length, curvature, curvature)
    stiffness += KAPPA * SHEAR * AREA * integral(length, strain, strain)
    for matrix, expected in (
        (found.translational_mass, translation),
        (found.mass, translation + rotary),
        (found.polar, 2 * rotary),
        (found.stiffness, stiffness),
    ):
        assert np.abs(matrix - expected).max() < 1e-9 * np.abs(expected).max()


@LENGTHS
def test_axial_force(length: float) -> None:
    slopes = [v.deriv() for v, _ in shapes(length)]
    expected = 3e4 * integral(length, slopes, slopes)
    phi = shear_parameter(np.asarray(length), YOUNG * MOMENT, KAPPA * SHEAR * AREA)
    found = axial_force_stiffness(np.asarray(length), phi, np.asarray(3e4))
    assert np.abs(found - expected).max() < 1e-9 * np.abs(expected).max()


def test_leading_dimensions_broadcast() -> None:
    lengths = np.array([[0.004], [0.05]])
    outer = np.array([0.05, 0.06, 0.08])
    many = plane_bending(lengths, outer, INNER, YOUNG, SHEAR, DENSITY, np.asarray(KAPPA))
    assert many.mass.shape == many.polar.shape == many.stiffness.shape == (2, 3, 4, 4)
    assert many.stiffness[1, 2] == pytest.approx(element(0.05).stiffness)
    assert many.mass[0, 2] == pytest.approx(element(0.004).mass)


def test_slender_limit_is_the_cubic_beam() -> None:
    length, rigid = 0.3, 1e30
    arguments = (length, 0.01, 0.0, YOUNG, rigid, DENSITY, 1.0)
    found = plane_bending(*map(np.asarray, arguments)).stiffness
    factor = YOUNG * math.pi * 0.01**4 / 64 / length**3
    expected = [12, 6 * length, -12, 6 * length]
    assert found[0] / factor == pytest.approx(expected)
    assert found[1, 1] / factor == pytest.approx(4 * length**2)
    assert found[1, 3] / factor == pytest.approx(2 * length**2)
