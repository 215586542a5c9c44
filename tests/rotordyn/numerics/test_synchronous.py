"""Synchronous motions of small systems."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rotordyn.numerics.modes import modes
from rotordyn.numerics.synchronous import synchronous


@pytest.mark.parametrize("order", [0.43, 1, 1.5, 1.6001, 2, 3])
def test_a_tilting_disc(order: float) -> None:
    """κ φ = (nΩ)² (Id ∓ Ip/n) φ; forward whirl of a flat disc never meets its own 1×."""
    stiff, polar = 7.0, 1.6  # over Id
    for side in (1.0, -1.0):
        own = 1.0 - side * polar / order
        gyroscopic = np.array([[-1j * side * polar]])
        found, _ = synchronous(np.array([[stiff]]), gyroscopic, order)
        expected = [math.sqrt(stiff / own) / order] if own > 0.0 else []
        assert found == pytest.approx(expected)


@pytest.mark.parametrize("order", [0.43, 1, 1.5, 2, 4])
def test_every_spin_found_is_one_at_which_a_pole_turns_at_the_multiple(order: float) -> None:
    """And all that a fine sweep over spin shows are among them."""
    rng = np.random.default_rng(3)
    half = rng.normal(size=(5, 5))
    stiffness = half @ half.T + np.eye(5)
    skew = rng.normal(size=(5, 5)) * 0.2
    skew = skew - skew.T
    found, vectors = synchronous(stiffness, skew, order)
    for spin, vector in zip(found, vectors.T, strict=True):
        s = 1j * order * spin
        rest = (stiffness + s * spin * skew + s * s * np.eye(5)) @ vector
        assert np.abs(rest).max() < 1e-10 * np.abs(stiffness @ vector).max()
    sweep = np.linspace(1e-3, 1.2 * found.max(), 4001)
    poles = modes(stiffness, sweep[:, None, None] * skew).pole
    turning = np.sort(poles.imag, axis=1)[:, 5:]
    miss = np.sign(turning - order * sweep[:, None])
    assert int((miss[1:] * miss[:-1] < 0).sum()) == len(found)


@pytest.mark.parametrize(
    ("stiffness", "slope", "order", "expected"),
    [
        (2.0, 3.0, 1, [(3.0 + math.sqrt(17.0)) / 2.0]),
        (-2.0, 5.0, 1, [(5.0 - math.sqrt(17.0)) / 2.0, (5.0 + math.sqrt(17.0)) / 2.0]),
        (-1.5, 5.0, 2, [0.5, 0.75]),
        (2.0, -3.0, 2, [(math.sqrt(41.0) - 3.0) / 8.0]),
        (-2.0, 1.0, 2, []),
    ],
)
def test_a_spring_that_follows_a_straight_line(
    stiffness: float, slope: float, order: int, expected: list[float]
) -> None:
    """k₀ + Ω k₁ = (nΩ)²: none, one or two."""
    matrices = (np.array([[value]]) for value in (stiffness, 0.0))
    found, _ = synchronous(*matrices, order, np.array([[slope]]))
    assert found == pytest.approx(expected)


@pytest.mark.parametrize("order", [0.43, 1, 2.37, 3])
def test_every_spin_of_matrices_on_a_straight_line(order: float) -> None:
    rng = np.random.default_rng(8)
    stiffness, slope = (half @ half.T + np.eye(5) for half in rng.normal(size=(2, 5, 5)))
    skew = rng.normal(size=(5, 5)) * 0.2
    skew = skew - skew.T
    found, vectors = synchronous(stiffness, skew, order, slope)
    for spin, vector in zip(found, vectors.T, strict=True):
        s, held = 1j * order * spin, stiffness + spin * slope
        rest = (held + s * spin * skew + s * s * np.eye(5)) @ vector
        assert np.abs(rest).max() < 1e-10 * np.abs(held @ vector).max()
    sweep = np.linspace(1e-3, 1.2 * found.max(), 4001)
    along = sweep[:, None, None]
    poles = modes(stiffness + along * slope, along * skew).pole
    miss = np.sign(np.sort(poles.imag, axis=1)[:, 5:] - order * sweep[:, None])
    assert int((miss[1:] * miss[:-1] < 0).sum()) == len(found)
