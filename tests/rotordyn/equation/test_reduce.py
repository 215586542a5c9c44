"""Reduction of a free body: what it promises about modes, statics, scaling and digits."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import eigh

from rotordyn.equation import reduce as module
from rotordyn.equation.reduce import LEAST_MODES, Coupling, reduce
from rotordyn.errors import InvalidInput


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
    found = reduce(mass, stiffness, np.ones((size, 1)), loads, cutoff)
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
    values = reduce(mass, stiffness, np.ones((size, 1)), np.eye(size)[:, [0]], cutoff).values
    below = max(int((exact < cutoff**2).sum()), LEAST_MODES)
    assert values[:below] == pytest.approx(exact[:below], rel=1e-8, abs=1e-10)


@settings(max_examples=25)
@given(SEEDS, st.floats(0.1, 10.0))
def test_statics_at_the_loaded_dof(seed: int, spring: float) -> None:
    """Held by springs where loads may act, the reduced system is as flexible as the whole."""
    mass, stiffness = free_chain(seed, 30)
    places = [2, 14, 27]
    loads = np.eye(30)[:, places]
    found = reduce(mass, stiffness, np.ones((30, 1)), loads, 0.3)
    basis, values = found.vectors, found.values
    held = np.diag(loads.sum(axis=1)) * spring
    whole = np.linalg.inv(stiffness + held)[np.ix_(places, places)]
    reduced = basis[places] @ np.linalg.inv(np.diag(values) + basis.T @ held @ basis)
    assert reduced @ basis[places].T == pytest.approx(whole, abs=2e-6 * whole.max())


def test_loads_already_spanned_add_nothing() -> None:
    """As many loads as DOF: the basis is the whole space and no more."""
    mass, stiffness = free_chain(1, 12)
    found = reduce(mass, stiffness, np.ones((12, 1)), np.eye(12), 10.0)
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
    found = reduce(np.eye(size), second.T @ second, rigid, np.eye(size)[:, [0]], 0.5)
    basis, values = found.vectors, found.values
    assert (values[:2] == 0.0).all()
    assert values[2] > 0.0
    slope = np.polyfit(np.arange(size), basis[:, :2], 1)
    assert np.outer(np.arange(size), slope[0]) + slope[1] == pytest.approx(basis[:, :2], abs=1e-6)


@pytest.mark.parametrize("stiff", [1.0, 1e4, 1e8, 1e12])
def test_answers_of_stiff_links_are_no_modes(stiff: float) -> None:
    """Of the widest of them hardly a mode that it is made of is known."""
    links = np.where(np.arange(29) == 20, stiff, 1.0)
    stretch = np.diff(np.eye(30), axis=0)
    loads = np.stack([np.eye(30)[0], stretch[20]], axis=1)
    found = reduce(np.eye(30), stretch.T @ (links[:, None] * stretch), np.ones((30, 1)), loads, 0.3)
    assert found.modes.tolist() == [True] * LEAST_MODES + [False] * 2


@pytest.mark.parametrize("large", [False, True], ids=["LAPACK", "Lanczos"])
def test_slow_modes_beside_stiff_links_keep_their_digits(
    large: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Two parts of a chain joined by a link 1e6 times as stiff: as by a rigid one, that is the
    chain with both masses in one, to 1e-6."""
    monkeypatch.setattr(module, "LARGE", 0 if large else 10**9)
    size = 120
    stretch = np.diff(np.eye(size), axis=0)
    links = np.where(np.arange(size - 1) == 70, 1e6, 1.0)
    whole = np.delete(np.eye(size), 71, axis=1)
    whole[71, 70] = 1.0
    rest = np.where(np.arange(size - 1) == 70, 0.0, 1.0)
    exact = eigh(
        whole.T @ stretch.T @ (rest[:, None] * stretch) @ whole, whole.T @ whole, eigvals_only=True
    )
    stiffness = stretch.T @ (links[:, None] * stretch)
    found = reduce(np.eye(size), stiffness, np.ones((size, 1)), np.eye(size)[:, [0]], 0.2)
    count = int((exact < 0.2**2).sum())
    assert count > 6
    assert found.values[1:count] == pytest.approx(exact[1:count], rel=1e-6)
    assert np.ptp(found.vectors[:, 0]) == 0.0


def test_lanczos_gives_what_lapack_gives(monkeypatch: pytest.MonkeyPatch) -> None:
    mass, stiffness = free_chain(8, 200)
    arguments = mass, stiffness, np.ones((200, 1)), np.eye(200)[:, [0, 90]], 0.3
    dense = reduce(*arguments)
    monkeypatch.setattr(module, "LARGE", 0)
    monkeypatch.setattr(module, "MOST_DENSE", 0)
    few = reduce(*arguments)
    assert few.modes.tolist() == dense.modes.tolist()
    assert few.values == pytest.approx(dense.values, rel=1e-10, abs=1e-14)
    alike = np.abs(np.diagonal(few.vectors.T @ mass @ dense.vectors))
    assert alike == pytest.approx(np.ones(len(alike)), abs=1e-9)


def test_a_mode_that_lanczos_misses_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """As many as the inertia of K − ω² M tells must lie below the cutoff."""
    import scipy.sparse.linalg

    whole = scipy.sparse.linalg.eigsh

    def poorer(matrix: np.ndarray, count: int, **given: object) -> tuple[np.ndarray, np.ndarray]:
        values, vectors = whole(matrix, count + 1, **given)
        kept = np.delete(np.argsort(values), 1)
        return values[kept], vectors[:, kept]

    monkeypatch.setattr(scipy.sparse.linalg, "eigsh", poorer)
    monkeypatch.setattr(module, "LARGE", 0)
    monkeypatch.setattr(module, "MOST_DENSE", 0)
    mass, stiffness = free_chain(8, 200)
    with pytest.raises(InvalidInput, match="modes of a free body cannot be computed"):
        reduce(mass, stiffness, np.ones((200, 1)), np.eye(200)[:, [0]], 0.3)


def test_what_does_not_fit_into_memory_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "LARGE", 0)
    monkeypatch.setattr(module, "MOST_DENSE", 0)
    monkeypatch.setattr(module, "MOST_ENTRIES", 1000)
    mass, stiffness = free_chain(8, 200)
    with pytest.raises(InvalidInput, match="do not fit into memory"):
        reduce(mass, stiffness, np.ones((200, 1)), np.eye(200)[:, [0]], 0.3)


def test_moments_of_slow_modes_keep_their_static_modes() -> None:
    """As flexible as the whole to the loads that a matrix brings on slow modes."""
    mass, stiffness = free_chain(5, 40)
    rigid, loads = np.ones((40, 1)), np.eye(40)[:, [0]]
    half = np.diff(np.eye(40), axis=0) * np.random.default_rng(1).uniform(0.5, 2.0, (39, 1))
    matrix = half.T @ half
    alone = reduce(mass, stiffness, rigid, loads, 0.3)
    found = reduce(mass, stiffness, rigid, loads, 0.3, [Coupling(matrix, 0.2)])
    slow = alone.vectors[:, alone.modes & (alone.values < 0.2**2)]
    moment = matrix @ slow[:, 1:]
    moment = moment - mass @ slow[:, :1] @ (slow[:, :1].T @ moment)
    whole = moment.T @ np.linalg.pinv(stiffness) @ moment
    kept = found.vectors[:, 1:].T @ moment
    assert kept.T @ (kept / found.values[1:, None]) == pytest.approx(whole, abs=1e-7 * whole.max())
    poor = alone.vectors[:, 1:].T @ moment
    assert np.abs(poor.T @ (poor / alone.values[1:, None]) - whole).max() > 1e-3 * whole.max()
