"""Elements of degree n against closed forms: order h^(2n), no locking, exact at few DOF."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import eigh

from rotordyn.equation.elements.beam import inner_dofs
from tests.oracles.cylinder_elements import hierarchic_bending
from tests.oracles.spinning_beam import PinnedBeam
from tests.oracles.whirl import whirl_frequencies

Array = np.ndarray


def pinned(beam: PinnedBeam, elements: int, degree: int) -> tuple[Array, Array, Array]:
    """Mass, polar and stiffness matrix of a beam between pins."""
    modulus = beam.young_modulus / (2 * (1 + beam.poisson_ratio))
    length = beam.length / elements
    values = (length, beam.diameter, 0.0, beam.young_modulus, modulus, beam.density, beam.kappa)
    own = hierarchic_bending(*(np.full(elements, v) for v in values), degree=degree)
    inner, nodal = inner_dofs(degree), 2 * (elements + 1)
    kept = np.setdiff1d(np.arange(nodal + inner * elements), [0, nodal - 2])
    whole = []
    for blocks in (own.mass, own.polar, own.stiffness):
        matrix = np.zeros((nodal + inner * elements,) * 2)
        for k, block in enumerate(blocks):
            first = nodal + inner * k
            rows = np.r_[2 * k : 2 * k + 4, first : first + inner]
            matrix[np.ix_(rows, rows)] += block
        whole.append(matrix[np.ix_(kept, kept)])
    return whole[0], whole[1], whole[2]


def at_rest(beam: PinnedBeam, elements: int, degree: int, modes: int) -> Array:
    """Lowest frequencies, from the flexible side so that stiff shear does not drown them."""
    mass, _, stiffness = pinned(beam, elements, degree)
    return 1.0 / np.sqrt(eigh(mass, stiffness, eigvals_only=True)[: -modes - 1 : -1])


@pytest.mark.parametrize("slenderness", [1.0, 5.0, 100.0, 1e4])
@pytest.mark.parametrize("degree", [2, 3, 4])
def test_frequencies_converge_with_twice_the_degree(slenderness: float, degree: int) -> None:
    beam = PinnedBeam(0.1 * slenderness, 0.1)
    exact = beam.bending_whirl(1, 0.0)[1]
    errors = np.array([at_rest(beam, n, degree, 1)[0] / exact - 1.0 for n in (2, 4)])
    assert (errors > 0.0).all()
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2 * degree, abs=0.35)


@pytest.mark.parametrize("slenderness", [0.3, 1.0, 10.0, 1e3, 1e4])
def test_nothing_locks_at_any_slenderness(slenderness: float) -> None:
    """Four elements of degree 6: the bending root of the exact quartic is among the frequencies."""
    beam = PinnedBeam(0.1 * slenderness, 0.1)
    found = at_rest(beam, 4, 6, 12)
    for mode in (1, 2, 3):
        exact = beam.bending_whirl(mode, 0.0)[1]
        assert np.abs(found / exact - 1.0).min() < 1e-7


@pytest.mark.parametrize("spin", [0.0, 2000.0])
@pytest.mark.parametrize(("elements", "degree"), [(1, 32), (2, 16), (4, 8)])
def test_six_frequencies_with_the_dof_of_32_standard_elements(
    elements: int, degree: int, spin: float
) -> None:
    """Stubby beam, L/d = 5: at most 68 DOF a plane, where 32 standard ones have 64."""
    beam = PinnedBeam(0.5, 0.1)
    mass, polar, stiffness = pinned(beam, elements, degree)
    assert len(mass) <= 68
    found = whirl_frequencies(mass, polar, stiffness, spin)
    forward, backward = np.sort(found[found > 0])[:6], np.sort(-found[found < 0])[:6]
    exact = np.array([beam.bending_whirl(mode, spin) for mode in range(1, 7)])
    assert np.abs(backward / exact[:, 0] - 1.0).max() < 1e-8
    assert np.abs(forward / exact[:, 1] - 1.0).max() < 1e-8
