"""Eigenvalues of damped systems and the receptances they sum up to, on random systems."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rotordyn.numerics.modes import FEW, _held, grows, modes, residual, unsolved

OMEGA = np.array([0.0, 0.7, 3.0, 11.0, -4.0])


def system(seed: int, size: int, kind: str) -> tuple[np.ndarray, np.ndarray]:
    """A batch of two stable systems: symmetric, with gyroscopic coupling, or complex."""
    draw = np.random.default_rng(seed)
    root = draw.normal(size=(2, size, size))
    stiffness = root @ root.swapaxes(1, 2) + 0.5 * np.eye(size)
    half = draw.normal(size=(2, size, size))
    damping = 0.05 * half @ half.swapaxes(1, 2) + 0.01 * np.eye(size)
    if kind == "gyroscopic":
        damping = damping + (half - half.swapaxes(1, 2))
    if kind == "complex":
        damping = damping - 1j * (half + half.swapaxes(1, 2))
    return stiffness, damping


def direct(
    stiffness: np.ndarray, damping: np.ndarray, omega: float, out: np.ndarray, into: np.ndarray
) -> np.ndarray:
    """rᵀ (K + iωD − ω²)⁻¹ e of paired rows, (batch, pairs)."""
    dynamic = stiffness + 1j * omega * damping - omega**2 * np.eye(stiffness.shape[-1])
    return np.einsum("pn,bnm,pm->bp", out, np.linalg.inv(dynamic), into)


@settings(max_examples=40)
@given(
    st.integers(0, 10**6), st.integers(1, 7), st.sampled_from(["plain", "gyroscopic", "complex"])
)
def test_receptance_equals_direct_solution(seed: int, size: int, kind: str) -> None:
    stiffness, damping = system(seed, size, kind)
    out, into = np.random.default_rng(seed + 1).normal(size=(2, 3, size))
    found = modes(stiffness, damping)
    ours = found.receptance(OMEGA, out, into)
    assert ours.shape == (2, 3, len(OMEGA))
    for k, omega in enumerate(OMEGA):
        exact = direct(stiffness, damping, omega, out, into)
        assert np.abs(ours[..., k] - exact).max() < 1e-8 * max(1.0, np.abs(exact).max())


@pytest.mark.parametrize("kind", ["plain", "gyroscopic", "complex"])
def test_receptances_without_poles_are_those_of_the_modes(kind: str) -> None:
    """More frequencies than are solved for at a time, and loads that several pairs share."""
    stiffness, damping = system(5, 6, kind)
    out, into = np.random.default_rng(6).normal(size=(2, 4, 6))
    into[2] = into[0]
    omega = np.linspace(-9.0, 9.0, 2 * FEW + 3)
    expected = modes(stiffness, damping).receptance(omega, out, into)
    found = unsolved(stiffness, damping)
    assert found.pole.shape == (2, 0)
    assert found.receptance(omega, out, into) == pytest.approx(expected, rel=1e-9, abs=1e-12)


@settings(max_examples=40)
@given(
    st.integers(0, 10**6), st.integers(1, 7), st.sampled_from(["plain", "gyroscopic", "complex"])
)
def test_every_eigenpair_satisfies_its_equation(seed: int, size: int, kind: str) -> None:
    stiffness, damping = system(seed, size, kind)
    found = modes(stiffness, damping)
    assert found.pole.shape == (2, 2 * size)
    assert found.vector.shape == (2, size, 2 * size)
    assert residual(found, stiffness, damping) < 1e-11
    assert (found.pole.real < 0.0).all()


def test_sum_and_product_of_poles() -> None:
    """Σ λ = −trace D, Π λ = det K."""
    stiffness, damping = system(7, 4, "gyroscopic")
    found = modes(stiffness, damping)
    assert found.pole.sum(axis=1) == pytest.approx(-np.trace(damping, axis1=1, axis2=2))
    assert found.pole.prod(axis=1) == pytest.approx(np.linalg.det(stiffness))


def test_residual_notices_a_wrong_pole() -> None:
    stiffness, damping = system(3, 3, "plain")
    found = modes(stiffness, damping)
    wrong = replace(found, pole=found.pole * 1.01)
    assert residual(wrong, stiffness, damping) > 1e-4


def test_residual_is_what_equations_miss_beside_their_terms() -> None:
    """Of λ² + dλ + k with any λ: |λ² + dλ + k| over |λ|² + d |λ| + k."""
    found = modes(np.array([[100.0]]), np.array([[8.0]]))
    for factor in (1.2, 0.3):
        pole = factor * found.pole[0]
        missed = np.abs(pole**2 + 8.0 * pole + 100.0)
        beside = np.abs(pole) ** 2 + 8.0 * np.abs(pole) + 100.0
        wrong = replace(found, pole=factor * found.pole)
        told = residual(wrong, np.array([[[100.0]]]), np.array([[[8.0]]]))
        assert told == pytest.approx((missed / beside).max())


@pytest.mark.parametrize("soft", [1e-6, 1.0, 1e9])
def test_what_holds_is_counted_in_the_measure_of_each_coordinate(soft: float) -> None:
    """A soft spring beside a stiff one holds as well; two coordinates of one spring hold once."""
    turn = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, -3.0]])
    both = turn.T @ np.diag([1e9, soft]) @ turn
    assert _held(np.array([both, np.diag([1e9, soft, soft])])).tolist() == [2, 3]


def test_single_oscillator() -> None:
    """ω = 10, ζ = 0.1: pole −1 ± i √99."""
    found = modes(np.array([[100.0]]), np.array([[2.0]]))
    assert np.sort_complex(found.pole) == pytest.approx([-1 - 1j * 99**0.5, -1 + 1j * 99**0.5])


def test_one_damping_for_many_stiffnesses() -> None:
    stiffness, damping = system(5, 3, "plain")
    found = modes(stiffness, damping[0])
    assert found.pole[1] == pytest.approx(modes(stiffness[1], damping[0]).pole)


def test_free_body_answers_with_its_inertia() -> None:
    """A coordinate without spring and damper moves by −f/ω² beside the others."""
    stiffness, damping = np.diag([0.0, 100.0]), np.diag([0.0, 0.1])
    rows = np.array([[1.0, 1.0]])
    ours = modes(stiffness, damping).receptance(np.array([3.0, 20.0]), rows, rows)[0]
    exact = [-1 / 9 + 1 / (91 + 0.3j), -1 / 400 + 1 / (-300 + 2j)]
    assert ours == pytest.approx(exact, rel=1e-9)


def test_motions_at_rest_are_those_that_nothing_holds() -> None:
    """One free, one on a spring of 10⁻²⁰ of the stiffest."""
    stiffness = np.diag([0.0, 1e-6, 50.0, 1e14])
    stiffness[2:, 2:] += 3.0 * np.ones((2, 2))
    seen = modes(stiffness, np.zeros((4, 4)))
    rest, size = seen.at_rest(), np.abs(seen.pole)
    assert rest.sum() == 2
    assert size[rest].max() < 1e-12
    assert np.sort(size[~rest])[:2] == pytest.approx([1e-3, 1e-3], rel=1e-9)


def test_a_hinged_body_has_one_free_motion() -> None:
    """Stiffness without one direction, in coordinates that do not show it, and a slow growth."""
    turn = np.linalg.qr(np.random.default_rng(7).normal(size=(3, 3)))[0]
    stiffness = turn @ np.diag([0.0, 1.0, 4.0]) @ turn.T
    damping = turn @ np.diag([0.0, -1e-3, 0.1]) @ turn.T
    found = modes(stiffness, damping)
    assert found.at_rest().sum() == 2
    growing = grows(found.pole, found.largest) & ~found.at_rest()
    assert growing.sum() == 2


@pytest.mark.parametrize("damping", [0.0, 0.4, 30.0])
def test_one_of_each_pair_represents_both(damping: float) -> None:
    """Sums over all poles of what conjugates share, also where some systems of a batch hardly
    oscillate and rows are filled up; of complex matrices every pole represents itself."""
    draw = np.random.default_rng(8)
    root = draw.standard_normal((6, 5, 5))
    damper = np.linspace(0.0, damping, 6)[:, None, None] * np.diag(np.arange(5.0))
    found = modes(root @ np.swapaxes(root, 1, 2) + np.eye(5), damper)
    columns, many = found.representatives()
    assert (columns.shape[1] > 5) == (damping > 1.0)
    chosen = np.take_along_axis(np.abs(found.pole), columns, axis=1)
    assert (many * chosen).sum(axis=1) == pytest.approx(np.abs(found.pole).sum(axis=1), rel=1e-12)
    whirling = modes(found.stiffness + 0j, 1j * found.damping)
    assert whirling.representatives()[0].shape == (6, 10)
