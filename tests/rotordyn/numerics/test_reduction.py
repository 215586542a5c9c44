"""The Ritz basis: what it promises about modes, statics and scaling."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import eigh

from rotordyn.numerics.reduction import LEAST_MODES, ritz_basis
from rotordyn.numerics.static_answers import Coupling


def free_chain(seed: int, size: int) -> tuple[np.ndarray, np.ndarray]:
    """Random masses between random springs, free at both ends."""
    draw = np.random.default_rng(seed)
    springs = draw.uniform(0.5, 2.0, size - 1)
    stiffness = np.diag(np.r_[springs, 0.0] + np.r_[0.0, springs])
    stiffness -= np.diag(springs, 1) + np.diag(springs, -1)
    root = np.diag(draw.uniform(0.5, 1.5, size)) + 0.1 * np.diag(np.ones(size - 1), 1)
    return root @ root.T, stiffness


SEEDS = st.integers(0, 10**6)


@settings(max_examples=25)
@given(SEEDS, st.integers(15, 40), st.floats(0.2, 1.5))
def test_unit_mass_and_diagonal_stiffness(seed: int, size: int, cutoff: float) -> None:
    mass, stiffness = free_chain(seed, size)
    loads = np.eye(size)[:, [0, size // 2, size - 1]]
    found = ritz_basis(mass, stiffness, cutoff, loads, np.ones((size, 1)))
    basis, values = found.vectors, found.values
    count = basis.shape[1]
    assert values.shape == (count,)
    assert basis.T @ mass @ basis == pytest.approx(np.eye(count), abs=1e-9)
    assert basis.T @ stiffness @ basis == pytest.approx(np.diag(values), abs=1e-8)
    assert (np.diff(values) >= -1e-12).all()
    assert values[0] == 0.0


@settings(max_examples=25)
@given(SEEDS, st.integers(15, 40), st.floats(0.2, 1.5))
def test_modes_up_to_the_cutoff_are_exact(seed: int, size: int, cutoff: float) -> None:
    mass, stiffness = free_chain(seed, size)
    exact = eigh(stiffness, mass, eigvals_only=True)
    values = ritz_basis(mass, stiffness, cutoff, np.eye(size)[:, [0]], np.ones((size, 1))).values
    below = max(int((exact < cutoff**2).sum()), LEAST_MODES)
    assert values[:below] == pytest.approx(exact[:below], rel=1e-8, abs=1e-10)


@settings(max_examples=25)
@given(SEEDS, st.floats(0.1, 10.0))
def test_statics_at_the_loaded_freedoms(seed: int, spring: float) -> None:
    """Held by springs where loads may act, the reduced system is as flexible as the whole."""
    mass, stiffness = free_chain(seed, 30)
    places = [2, 14, 27]
    loads = np.eye(30)[:, places]
    found = ritz_basis(mass, stiffness, 0.3, loads, np.ones((30, 1)))
    basis, values = found.vectors, found.values
    held = np.diag(loads.sum(axis=1)) * spring
    whole = np.linalg.inv(stiffness + held)[np.ix_(places, places)]
    reduced = basis[places] @ np.linalg.inv(np.diag(values) + basis.T @ held @ basis)
    assert reduced @ basis[places].T == pytest.approx(whole, abs=2e-6 * whole.max())


def test_loads_already_spanned_add_nothing() -> None:
    """As many loads as freedoms: the basis is the whole space and no more."""
    mass, stiffness = free_chain(1, 12)
    found = ritz_basis(mass, stiffness, 10.0, np.eye(12), np.ones((12, 1)))
    basis, values = found.vectors, found.values
    exact = eigh(stiffness, mass, eigvals_only=True)
    assert basis.shape == (12, 12)
    assert basis.T @ mass @ basis == pytest.approx(np.eye(12), abs=1e-9)
    assert values == pytest.approx(exact, abs=1e-9)


def test_two_rigid_motions() -> None:
    """A free beam on unit springs between second differences keeps translation and tilt at zero."""
    size = 20
    second = np.diff(np.eye(size), 2, axis=0)
    rigid = np.stack([np.ones(size), np.arange(size)], axis=1)
    found = ritz_basis(np.eye(size), second.T @ second, 0.5, np.eye(size)[:, [0]], rigid)
    basis, values = found.vectors, found.values
    assert (values[:2] == 0.0).all()
    assert values[2] > 0.0
    slope = np.polyfit(np.arange(size), basis[:, :2], 1)
    assert np.outer(np.arange(size), slope[0]) + slope[1] == pytest.approx(basis[:, :2], abs=1e-6)


def test_coupling_with_what_was_not_kept() -> None:
    """From the loads, where the difference of M-products shows it as well."""
    mass, stiffness = free_chain(3, 40)
    found = ritz_basis(mass, stiffness, 0.3, np.eye(40)[:, [0, 17]], np.ones((40, 1)))
    direct = found.rest.T @ mass @ found.vectors
    assert np.abs(direct).max() > 1e-3
    assert found.rest_mass == pytest.approx(direct, abs=1e-8)


@pytest.mark.parametrize("stiff", [1.0, 1e4, 1e8, 1e12])
def test_answers_of_stiff_links_are_no_modes(stiff: float) -> None:
    """Of the widest of them hardly a mode that it is made of is known."""
    links = np.where(np.arange(29) == 20, stiff, 1.0)
    stretch = np.diff(np.eye(30), axis=0)
    loads = np.stack([np.eye(30)[0], stretch[20]], axis=1)
    found = ritz_basis(
        np.eye(30), stretch.T @ (links[:, None] * stretch), 0.3, loads, np.ones((30, 1))
    )
    assert found.are_modes.tolist() == [True] * LEAST_MODES + [False] * 2


def test_rigid_motions_have_no_rounding() -> None:
    """Taken as given, whatever the stiffness; the others' rounding is that of its entries."""
    mass, stiffness = free_chain(4, 30)
    loads, rigid = np.eye(30)[:, [0]], np.ones((30, 1))
    found = ritz_basis(mass, stiffness, 0.3, loads, rigid)
    assert np.ptp(found.vectors[:, 0]) == 0.0
    assert found.rounding[0] == 0.0
    noise = np.random.default_rng(0).uniform(-1.0, 1.0, (400, 30, 30)) * stiffness
    moved = np.einsum("ij,sik,kj->sj", found.vectors, noise * 2.0**-53, found.vectors)
    assert moved.std(axis=0)[1:] == pytest.approx(found.rounding[1:] / 3.0**0.5, rel=0.2)


def test_a_coupling_that_does_nothing_adds_nothing() -> None:
    """Differences of a rigid motion are rounding, and no force."""
    mass, stiffness = free_chain(5, 30)
    loads, rigid = np.eye(30)[:, [0]], np.ones((30, 1))
    half = np.diff(np.eye(30), axis=0) * np.random.default_rng(1).uniform(0.5, 2.0, (29, 1))
    alone = ritz_basis(mass, stiffness, 0.3, loads, rigid)
    sizes = [
        ritz_basis(mass, stiffness, 0.3, loads, rigid, [Coupling(c)]).values.size
        for c in (np.diag(rigid[:, 0]) @ half.T @ half, np.zeros((30, 30)))
    ]
    assert sizes[0] == alone.values.size + LEAST_MODES - 1
    assert sizes[1] == alone.values.size
