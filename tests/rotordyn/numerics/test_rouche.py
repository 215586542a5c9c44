"""The count of a reduced problem and that of the whole one."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.numerics.modes import modes
from rotordyn.numerics.rouche import same_count, to_circle, to_segment, wide_gap


def whole_and_bound(
    seed: int, coupling: float, stiff: float, beside: float | None = None
) -> tuple[int, int, float]:
    """Eigenvalues in the disc of the whole problem and of its first block, and the bound.

    s² + s C + K with unit mass; the second block rests on ``stiff``. ``beside``: only those between
    Im s = 0 and a chord so far beside a pole of the first block, of a stiffness that is complex.
    """
    rng = np.random.default_rng(seed)
    n, m, radius = 6, 5, 3.0
    size = n + m
    stiffness = rng.normal(size=(size, size)) * coupling
    damping = 0.2 * rng.normal(size=(size, size)) * coupling
    stiffness[:n, :n] += np.diag(rng.uniform(0.5, 60.0, n))
    stiffness[n:, n:] += stiff * np.eye(m)
    if beside is not None:
        stiffness = stiffness + 1j * rng.normal(size=(size, size)) * coupling
    pole = modes(stiffness, damping).pole
    found = modes(stiffness[:n, :n], damping[:n, :n])
    own = np.linalg.norm(stiffness[n:, n:] / stiff - np.eye(m), 2)
    own += (radius**2 + radius * np.linalg.norm(damping[n:, n:], 2)) / stiff
    down, up = (
        (stiffness[a, b], damping[a, b])
        for a, b in ((np.s_[n:], np.s_[:n]), (np.s_[:n], np.s_[n:]))
    )
    right = sum(
        np.linalg.norm(f @ found.vector, axis=0) * w
        for f, w in zip(down, (1.0, radius), strict=True)
    )
    left = sum(
        np.linalg.norm(found.participation @ e, axis=1) * w
        for e, w in zip(up, (1.0, radius), strict=True)
    )
    edge = np.array(radius)
    apart = to_circle(found.pole, edge)
    inside = [np.abs(each) < radius for each in (pole, found.pole)]
    if beside is not None:
        swinging = np.sort(found.pole.imag[inside[1] & (found.pole.imag > 0.0)])
        middle = swinging[len(swinging) // 2] if len(swinging) else 1.0
        low, high = np.array(0.0), np.array(middle + beside)
        apart = to_segment(found.pole, edge, low, high)
        inside = [
            i & (low < p.imag) & (p.imag < high)
            for i, p in zip(inside, (pole, found.pole), strict=True)
        ]
    bound = same_count(apart, right, left / stiff, edge, np.array(own))
    return int(inside[0].sum()), int(inside[1].sum()), float(bound)


def test_a_bound_below_one_proves_the_count() -> None:
    """Weak and strong coupling; where the counts differ the bound says so."""
    proven = different = 0
    for seed in range(300):
        coupling, stiff = 10.0 ** np.random.default_rng(seed).uniform([-2.0, 0.7], [1.0, 2.5])
        whole, reduced, bound = whole_and_bound(seed, coupling, stiff)
        proven += bound < 1.0
        different += whole != reduced
        assert whole == reduced or bound >= 1.0, seed
    assert proven > 50
    assert different > 20


def test_a_bound_below_one_proves_the_count_between_chords() -> None:
    """Of a part of the disc, for complex matrices, whose poles do not come in pairs."""
    proven = different = 0
    for seed in range(300):
        rng = np.random.default_rng(seed)
        coupling, stiff = 10.0 ** rng.uniform([-2.0, 0.7], [0.5, 2.5])
        beside = rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(-3.0, -0.5)
        whole, reduced, bound = whole_and_bound(seed, coupling, stiff, beside)
        proven += bound < 1.0
        different += whole != reduced
        assert whole == reduced or bound >= 1.0, seed
    assert proven > 50
    assert different > 10


def test_a_block_without_stiffness_proves_nothing() -> None:
    edge = same_count(np.array([2.0]), np.zeros(1), np.zeros(1), np.array(3.0), np.array(1.0))
    assert edge == np.inf


def test_the_disc_ends_in_the_widest_gap() -> None:
    size = np.array([[0.5, 1.1, 1.2, 1.45, 9.0], [0.5, 2.0, 3.0, 4.0, 5.0]])
    assert wide_gap(size, np.ones(2), 1.5) == pytest.approx([(1.2 + 1.45) / 2, 1.25])
