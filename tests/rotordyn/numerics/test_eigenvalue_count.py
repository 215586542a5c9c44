"""Counts of eigenvalues and condensed matrices against dense linear algebra."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import eigh
from scipy.sparse import csr_array

from rotordyn.numerics.eigenvalue_count import condensed, count_below


def chain(seed: int, size: int) -> tuple[np.ndarray, np.ndarray]:
    """A free chain of random springs and coupled masses."""
    draw = np.random.default_rng(seed)
    springs = draw.uniform(0.5, 2.0, size - 1)
    stiffness = np.diag(np.r_[springs, 0.0] + np.r_[0.0, springs])
    stiffness -= np.diag(springs, 1) + np.diag(springs, -1)
    root = np.diag(draw.uniform(0.5, 1.5, size)) + 0.1 * np.diag(np.ones(size - 1), 1)
    return root @ root.T, stiffness


@given(st.integers(0, 10**6), st.integers(4, 40), st.floats(0.01, 0.99))
def test_as_many_as_lie_below(seed: int, size: int, share: float) -> None:
    mass, stiffness = chain(seed, size)
    values = eigh(stiffness, mass, eigvals_only=True)
    place = int(share * (size - 1))
    bound = 0.5 * (values[place] + values[place + 1])
    order = np.random.default_rng(seed).permutation(size)
    assert count_below(csr_array(stiffness), csr_array(mass), bound, order) == place + 1


def test_a_bound_on_which_a_pivot_vanishes_is_moved_aside() -> None:
    """The first pivot of K − μM is zero; the count is that of the matrices."""
    stiffness, mass = csr_array(np.array([[2.0, 1.0], [1.0, 5.0]])), csr_array(np.eye(2))
    assert count_below(stiffness, mass, 2.0, np.arange(2)) == 1


@given(st.integers(0, 10**6), st.integers(6, 30))
def test_condensed_is_the_schur_complement(seed: int, size: int) -> None:
    mass, stiffness = chain(seed, size)
    whole = stiffness + mass
    chosen = np.array([0, size // 2])
    others = np.setdiff1d(np.arange(size), chosen)
    found = condensed(csr_array(whole), chosen, others)
    expected = np.linalg.inv(np.linalg.inv(whole)[np.ix_(chosen, chosen)])
    assert found == pytest.approx(expected, rel=1e-9, abs=1e-12)


def test_condensed_is_nan_where_the_rest_is_not_positive() -> None:
    mass, stiffness = chain(1, 12)
    found = condensed(csr_array(stiffness - 3.0 * mass), np.array([0]), np.arange(1, 12))
    assert np.isnan(found).all()
