"""The reduction of a free body: its modes, its statics at ports, and the digits it keeps."""

from __future__ import annotations

import math
from collections.abc import Sequence

import mpmath
import numpy as np
import pytest
import scipy.sparse.linalg
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import block_diag, eigh
from scipy.sparse import csr_array, diags_array

from rotordyn.equation import reduce as module
from rotordyn.equation.reduce import LEAST_MODES, Basis, reduce
from rotordyn.errors import InvalidInput
from rotordyn.numerics.sparse import LARGE
from tests.oracles.cylinder_elements import hierarchic_bending

Array = np.ndarray
SEEDS = st.integers(0, 10**6)


def chain(springs: Sequence[float] | Array, masses: Sequence[float] | Array) -> tuple[Array, Array]:
    """Masses between springs, free at both ends."""
    stretch = np.diff(np.eye(len(masses)), axis=0)
    return np.diag(masses), stretch.T @ (np.asarray(springs)[:, None] * stretch)


def random_chain(seed: int, size: int) -> tuple[Array, Array]:
    """The same at random, neighbouring masses joined."""
    draw = np.random.default_rng(seed)
    root = np.diag(draw.uniform(0.5, 1.5, size)) + 0.1 * np.diag(np.ones(size - 1), 1)
    return root @ root.T, chain(draw.uniform(0.5, 2.0, size - 1), np.ones(size))[1]


def beam(lengths: Sequence[float], degree: int, density: float = 7800.0) -> tuple[Array, ...]:
    """Mass, stiffness and rigid motions of a hollow steel cylinder in elements of these lengths."""
    count, inner = len(lengths), 2 * degree - 1 if degree > 1 else 0
    given = (lengths, 0.06, 0.02, 2.1e11, 8e10, density, 0.6)
    own = hierarchic_bending(
        *(np.broadcast_to(a, count).astype(float) for a in given), degree=degree
    )
    size, x = 2 * (count + 1) + inner * count, np.concatenate([[0.0], np.cumsum(lengths)])
    mass, stiffness, rigid = np.zeros((size, size)), np.zeros((size, size)), np.zeros((size, 2))
    for k in range(count):
        rows = np.r_[2 * k : 2 * k + 4, 2 * count + 2 + inner * k : 2 * count + 2 + inner * (k + 1)]
        mass[np.ix_(rows, rows)] += own.mass[k]
        stiffness[np.ix_(rows, rows)] += own.stiffness[k]
    rigid[0 : 2 * count + 2 : 2, 0] = 1.0
    rigid[: 2 * count + 2, 1] = np.stack([x - x.mean(), np.ones_like(x)], axis=1).ravel()
    return mass, stiffness, rigid


def unit(size: int, *places: int) -> Array:
    """Unit loads at some DOF."""
    return np.eye(size)[:, list(places)]


def flexibility(basis: Basis, ports: Array) -> Array:
    """Elastic displacements of the ports by self-equilibrated unit loads."""
    seen = (ports.T @ basis.vectors)[:, basis.values > 0.0]
    return seen / basis.values[basis.values > 0.0] @ seen.T


def exact_flexibility(mass: Array, stiffness: Array, rigid: Array, ports: Array) -> Array:
    """The same of the whole body, by the pseudo-inverse."""
    relief = np.eye(len(mass)) - rigid @ np.linalg.solve(rigid.T @ mass @ rigid, rigid.T @ mass)
    return ports.T @ relief @ np.linalg.pinv(stiffness) @ relief.T @ ports


@settings(max_examples=25)
@given(SEEDS, st.integers(15, 40), st.floats(0.2, 1.5))
def test_unit_mass_diagonal_stiffness_and_exact_modes(seed: int, size: int, cutoff: float) -> None:
    mass, stiffness = random_chain(seed, size)
    basis = reduce(mass, stiffness, np.ones((size, 1)), unit(size, 0, size // 2), cutoff)
    vectors, values = basis.vectors, basis.values
    assert vectors.T @ mass @ vectors == pytest.approx(np.eye(len(values)), abs=1e-12)
    assert vectors.T @ stiffness @ vectors == pytest.approx(np.diag(values), abs=1e-11)
    assert (np.diff(values) >= 0.0).all()
    assert values[0] == 0.0
    exact = eigh(stiffness, mass, eigvals_only=True)
    kept = max(int((exact < cutoff**2).sum()), LEAST_MODES)
    assert values[basis.modes] == pytest.approx(exact[:kept], rel=1e-10, abs=1e-12)


@settings(max_examples=25)
@given(SEEDS, st.floats(0.1, 10.0))
def test_statics_at_the_ports(seed: int, spring: float) -> None:
    """Held by springs at its ports the reduced body is as flexible as the whole one."""
    mass, stiffness = random_chain(seed, 30)
    ports = unit(30, 2, 14, 27)
    basis = reduce(mass, stiffness, np.ones((30, 1)), ports, 0.3)
    seen = ports.T @ basis.vectors
    whole = ports.T @ np.linalg.solve(stiffness + spring * ports @ ports.T, ports)
    held = seen @ np.linalg.solve(np.diag(basis.values) + spring * seen.T @ seen, seen.T)
    assert held == pytest.approx(whole, rel=1e-8)


@pytest.mark.parametrize(
    ("ports", "added"),
    [
        (np.zeros((30, 0)), 0),
        (np.zeros((30, 1)), 0),
        (np.ones((30, 1)), 0),  # moves the body as it is
        (unit(30, 3, 3, 7), 2),
        (np.eye(30), 30 - LEAST_MODES),
    ],
)
def test_dependent_ports_add_nothing(ports: Array, added: int) -> None:
    mass, stiffness = chain(np.ones(29), np.ones(30))
    basis = reduce(mass, stiffness, np.ones((30, 1)), ports, 0.1)
    assert basis.modes.sum() == LEAST_MODES
    assert len(basis.values) == LEAST_MODES + added


def test_rigid_motions_as_they_stand() -> None:
    mass, stiffness, rigid = beam([0.1] * 10, 3)
    basis = reduce(mass, stiffness, rigid, unit(len(rigid), 0), 1e4)
    assert (basis.values[:2] == 0.0).all()
    assert basis.values[2] > 0.0
    assert np.ptp(basis.vectors[0:22:2, 0]) == 0.0
    assert np.linalg.lstsq(rigid, basis.vectors[:, :2])[1] == pytest.approx(0.0, abs=1e-25)


@pytest.mark.parametrize("size", [100, 2000, 20_000])
def test_closed_form_of_a_chain(size: int) -> None:
    """ω_k = 2 sin(kπ/2n), small and large problems alike."""
    ends = np.r_[1.0, np.full(size - 2, 2.0), 1.0]
    stiffness = diags_array([-np.ones(size - 1), ends, -np.ones(size - 1)], offsets=[-1, 0, 1])
    mass = diags_array(np.ones(size)).tocsr()
    exact = 2.0 * np.sin(np.arange(20) * math.pi / (2 * size))
    ports = np.zeros((size, 2))
    ports[[0, -1], [0, 1]] = 1.0
    basis = reduce(mass, stiffness.tocsr(), np.ones((size, 1)), ports, 1.0001 * exact[-1])
    assert basis.modes.sum() == 20
    assert np.sqrt(basis.values[basis.modes]) == pytest.approx(exact, rel=1e-10)
    ends_apart = (ports[:, 0] - ports[:, 1]) @ basis.vectors
    assert (ends_apart[1:] ** 2 / basis.values[1:]).sum() == pytest.approx(size - 1, rel=1e-9)


@settings(max_examples=5, deadline=None)
@given(SEEDS)
def test_both_ways_agree(seed: int) -> None:
    size = LARGE + 100
    mass, stiffness = random_chain(seed, size)
    rigid, ports = np.ones((size, 1)), unit(size, 5, 200)
    large = reduce(csr_array(mass), csr_array(stiffness), rigid, ports, 0.1)
    exact = eigh(stiffness, mass, eigvals_only=True)
    kept = max(int((exact < 0.01).sum()), LEAST_MODES)
    assert large.values[large.modes] == pytest.approx(exact[:kept], rel=1e-9, abs=1e-12)
    all_modes = reduce(mass, stiffness, rigid, ports, 10.0)
    assert all_modes.modes.all()
    assert len(all_modes.values) == size
    assert flexibility(large, ports) == pytest.approx(flexibility(all_modes, ports), rel=1e-9)
    unity = large.vectors.T @ mass @ large.vectors
    assert unity == pytest.approx(np.eye(len(unity)), abs=1e-11)


@pytest.mark.parametrize("stiff", [1.0, 1e6, 1e12])
def test_stiff_joints_do_not_drown_slow_modes(stiff: float) -> None:
    """Relative motions in joints up to 10¹² as stiff as the springs, against fifty digits."""
    size, springs = 14, np.ones(13)
    springs[[4, 9]] = stiff, stiff**0.5
    motion = np.tril(np.ones((size, size)), -1)  # DOF: steps between neighbours, then all together
    motion[:, -1] = 1.0
    held = np.diag(np.append(springs, 0.0))
    own = np.diag(np.linspace(1.0, 2.0, size))
    mass, rigid = motion.T @ own @ motion, unit(size, size - 1)
    basis = reduce(mass, held, rigid, unit(size, 0), 0.8)
    with mpmath.workdps(50):
        root = mpmath.cholesky(mpmath.matrix(mass.tolist())) ** -1
        exact = mpmath.eigsy(root * mpmath.matrix(held.tolist()) * root.T, eigvals_only=True)
        exact = np.array([float(mpmath.sqrt(abs(v))) for v in exact])
    assert np.sqrt(basis.values[basis.modes])[1:] == pytest.approx(
        exact[1 : basis.modes.sum()], rel=1e-12
    )


@pytest.mark.parametrize("short", [1e-3, 1e-5])
def test_short_elements_do_not_change_a_beam(short: float) -> None:
    """A pair of 10 µm in a metre: the stiffness matrix spans 10²⁰."""
    mass, stiffness, rigid = beam([0.125] * 8, 9)
    whole = reduce(mass, stiffness, rigid, unit(len(rigid), 0), 3e4)
    mass, stiffness, rigid = beam(
        [0.125, 0.15, short, 0.125, 0.1, short, 0.1, 0.15, 0.15, 0.1 - 2.0 * short], 9
    )
    cut = reduce(mass, stiffness, rigid, unit(len(rigid), 0), 3e4)
    assert np.sqrt(cut.values[2:8]) == pytest.approx(np.sqrt(whole.values[2:8]), rel=2e-10)


@pytest.mark.parametrize("density", [7800.0, 1e-3, 1e-6, 1e-9])
def test_light_shaft_under_heavy_discs(density: float) -> None:
    """Modes are those of discs on a massless shaft, and the shaft gives where it is loaded."""
    mass, stiffness, rigid = beam([0.1] * 6, 2, density)
    for node in (1, 5):
        mass[2 * node, 2 * node] += 5.0
        mass[2 * node + 1, 2 * node + 1] += 0.02
    ports = unit(len(rigid), 4, 6, 7, 12)
    basis = reduce(mass, stiffness, rigid, ports, 5e3)
    unity = basis.vectors.T @ mass @ basis.vectors
    assert unity == pytest.approx(np.eye(len(unity)), abs=1e-9)
    exact = exact_flexibility(mass, stiffness, rigid, ports)
    assert flexibility(basis, ports) == pytest.approx(exact, rel=1e-6, abs=1e-8 * exact.max())
    if density < 1.0:
        discs = [2, 3, 10, 11]
        others = np.setdiff1d(np.arange(len(rigid)), discs)
        across = np.linalg.solve(stiffness[np.ix_(others, others)], stiffness[others][:, discs])
        condensed = stiffness[np.ix_(discs, discs)] - stiffness[discs][:, others] @ across
        heavy = eigh(condensed, np.diag([5.0, 0.02] * 2), eigvals_only=True)[2:]
        assert basis.values[2:4] == pytest.approx(heavy, rel=1e-9 + density)


def test_more_modes_than_sparse_elimination_pays_for() -> None:
    size = LARGE + 50
    mass, stiffness = random_chain(7, size)
    basis = reduce(csr_array(mass), csr_array(stiffness), np.ones((size, 1)), unit(size, 0), 1.0)
    exact = eigh(stiffness, mass, eigvals_only=True)
    assert basis.modes.sum() == (exact < 1.0).sum() > size / 8
    assert basis.values[basis.modes] == pytest.approx(exact[: basis.modes.sum()], abs=1e-11)


@pytest.mark.parametrize("size", [20, LARGE + 20])
@pytest.mark.parametrize("fault", ["no mass", "held by nothing", "negative"])
def test_indefinite_matrices_are_refused(size: int, fault: str) -> None:
    mass, stiffness = chain(np.ones(size - 1), np.ones(size))
    if fault == "no mass":
        mass[3, 3] = 0.0
    elif fault == "negative":
        mass[3, 3] = -1.0
    else:
        stiffness = block_diag(*[chain(np.full(size // 2 - 1, 0.3), np.ones(size // 2))[1]] * 2)
    with pytest.raises(InvalidInput, match="cannot be computed"):
        reduce(mass, stiffness, np.ones((size, 1)), unit(size, 0), 0.1)


def test_what_does_not_fit_into_memory_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "MOST_ENTRIES", 10_000)
    mass, stiffness = chain(np.ones(LARGE), np.ones(LARGE + 1))
    with pytest.raises(InvalidInput, match=r"20 modes and 1 loads of a body of \d+ DOF"):
        reduce(mass, stiffness, np.ones((LARGE + 1, 1)), unit(LARGE + 1, 0), 0.21)


def test_a_mode_that_lanczos_misses_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    lanczos = scipy.sparse.linalg.eigsh

    def poorer(mass: Array, count: int, **more: object) -> tuple[Array, Array]:
        values, vectors = lanczos(mass, count + 1, **more)
        others = np.argsort(values) != 2
        return values[others], vectors[:, others]

    monkeypatch.setattr(scipy.sparse.linalg, "eigsh", poorer)
    mass, stiffness = chain(np.ones(LARGE), np.ones(LARGE + 1))
    with pytest.raises(InvalidInput, match="cannot be computed"):
        reduce(mass, stiffness, np.ones((LARGE + 1, 1)), unit(LARGE + 1, 0), 0.21)
