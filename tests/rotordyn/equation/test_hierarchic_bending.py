"""The element of any degree: what its DOF are, and that it contains the standard one."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rotordyn.equation.elements.beam import inner_dofs, shapes
from rotordyn.equation.elements.polynomials import bubbles, points
from rotordyn.machine.cross_section import area, second_moment
from tests.oracles.cylinder_elements import hierarchic_bending
from tests.oracles.standard_beam import plane_bending, shear_parameter

E, G, RHO, KAPPA = 2.1e11, 2.1e11 / 2.6, 7800.0, 0.886
DEGREES = (1, 2, 3, 5, 8)


def arguments(length: float, outer: float, inner: float) -> list[np.ndarray]:
    return [np.array([v]) for v in (length, outer, inner, E, G, RHO, KAPPA)]


def rigidities(outer: float, inner: float) -> tuple[float, float]:
    return E * second_moment(outer, inner), KAPPA * G * area(outer, inner)


@pytest.mark.parametrize("last", [2, 3, 7])
def test_bubbles_vanish_at_both_ends_and_have_orthonormal_slopes(last: int) -> None:
    integral, value, _ = bubbles(last, np.array([-1.0, 1.0]))
    assert np.abs(value).max() < 1e-14
    assert np.abs(integral[0]).max() < 1e-14
    assert np.abs(integral[1, 1:]).max(initial=0.0) < 1e-14
    xi, weight = points(2 * last)
    _, _, slope = bubbles(last, xi)
    assert slope.T @ (weight[:, None] * slope) == pytest.approx(np.eye(last - 1), abs=1e-13)


@pytest.mark.parametrize("degree", DEGREES)
def test_shapes_are_derivatives_of_one_another(degree: int) -> None:
    length, phi, step = np.array([0.07]), np.array([2.3]), 1e-6
    xi = np.array([-0.83, -0.1, 0.4, 0.95])
    here, ahead, behind = (shapes(length, phi, degree, xi + s) for s in (0.0, step, -step))
    for value, slope in (("deflection", "slope"), ("rotation", "curvature")):
        change = (getattr(ahead, value) - getattr(behind, value)) / (2.0 * step) / (0.07 / 2.0)
        assert change == pytest.approx(getattr(here, slope), rel=1e-7, abs=1e-7)


@given(
    st.floats(-3.0, 4.0),
    st.floats(0.0, 0.9),
    st.sampled_from([n for n in DEGREES if n > 1]),
)
def test_stiffness_is_the_energy_of_the_shapes(
    slenderness: float, hollow: float, degree: int
) -> None:
    """Quadrature of EI φ′² + κGA (v′ − φ)² from the shape functions alone."""
    outer = 0.1
    length = outer * 10.0**slenderness
    matrices = hierarchic_bending(*arguments(length, outer, hollow * outer), degree=degree)
    bending, shear = rigidities(outer, hollow * outer)
    phi = shear_parameter(np.array([length]), np.array([bending]), np.array([shear]))
    xi, weight = points(2 * degree + 6)
    shape = shapes(np.array([length]), phi, degree, xi)
    along = (weight * length / 2.0)[:, None]
    bent, sheared = shape.curvature[0], (shape.slope - shape.rotation)[0]
    energy = bending * bent.T @ (along * bent) + shear * sheared.T @ (along * sheared)
    size = np.sqrt(np.diag(energy))
    gap = (matrices.stiffness[0] - energy) / np.outer(size, size)
    assert np.abs(gap).max() < 1e-7 if slenderness > 2.0 else np.abs(gap).max() < 1e-10


@pytest.mark.parametrize("degree", DEGREES)
def test_the_core_is_the_standard_element(degree: int) -> None:
    given_ = arguments(0.04, 0.08, 0.03)
    whole, core = hierarchic_bending(*given_, degree=degree), plane_bending(*given_)
    assert whole.mass.shape[-1] == 4 + inner_dofs(degree)
    for name in ("mass", "translational_mass", "polar", "stiffness"):
        nodal, own = getattr(whole, name)[:, :4, :4], getattr(core, name)
        assert np.abs(nodal - own).max() <= 1e-14 * np.abs(own).max()
        matrix = getattr(whole, name)[0]
        assert np.abs(matrix - matrix.T).max() <= 1e-12 * np.abs(matrix).max()
    assert np.linalg.eigvalsh(whole.mass[0]).min() > 0.0


@pytest.mark.parametrize("degree", [2, 4])
def test_rigid_motion_has_the_exact_inertia(degree: int) -> None:
    """Mass and moment of inertia of a cylinder, all of it in the nodal DOF."""
    length, outer = 0.05, 0.09
    whole = hierarchic_bending(*arguments(length, outer, 0.0), degree=degree)
    inner = np.zeros(inner_dofs(degree))
    shift, tilt = np.r_[1.0, 0.0, 1.0, 0.0, inner], np.r_[0.0, 1.0, length, 1.0, inner]
    mass = RHO * area(outer, 0.0) * length
    assert shift @ whole.mass[0] @ shift == pytest.approx(mass, rel=1e-12)
    diametral = mass * (length**2 / 3.0 + outer**2 / 16.0)
    assert tilt @ whole.mass[0] @ tilt == pytest.approx(diametral, rel=1e-12)
    assert tilt @ whole.polar[0] @ tilt == pytest.approx(mass * outer**2 / 8.0, rel=1e-12)
