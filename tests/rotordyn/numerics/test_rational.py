"""Poles of rational functions through responses whose poles are known."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.numerics.rational import rational_poles

OMEGA = np.linspace(10.0, 400.0, 800)


def _sum(pole: np.ndarray, residue: np.ndarray) -> np.ndarray:
    s = 1j * OMEGA[:, None]
    pair = residue / (s - pole) + residue.conj() / (s - pole.conj())
    return np.asarray(np.where(pole.imag == 0.0, pair / 2.0, pair).sum(axis=1) + 1e-4)


@pytest.mark.parametrize("seed", range(8))
def test_poles_of_a_sum_of_modes_are_found(seed: int) -> None:
    """One to ten lightly damped pairs, and in every second trial one that does not oscillate."""
    chance = np.random.default_rng(seed)
    at = np.sort(chance.uniform(20.0, 380.0, 1 + seed))
    pole = at * (-chance.uniform(0.005, 0.05, len(at)) + 1j)
    if seed % 2:
        pole = np.append(pole, -60.0 + 0.0j)
    residue = chance.uniform(0.5, 2.0, len(pole)) * np.where(pole.imag == 0.0, 1.0, 1j)
    found, near = rational_poles(OMEGA, _sum(pole, residue), 1e-11)
    assert near < 1e-11
    nearest = np.abs(found[:, None] - pole).min(axis=0)
    allowed = np.where(pole.imag == 0.0, 1e-3, 1e-6)  # the other is far from all samples
    assert (nearest < allowed * np.abs(pole)).all()


def test_rounding_decides_nothing() -> None:
    """A response that is no sum of modes, as its loss does not depend on the frequency, and the
    same but for the last digit."""
    square = (OMEGA[:, None] / [60.0, 150.0, 290.0]) ** 2
    response = (1.0 / (1.0 - square + 0.04j)).sum(axis=1)
    for near in (1e-1, 1e-2, 1e-3):
        one, other = (
            rational_poles(OMEGA, r, near).pole for r in (response, response * (1.0 + 3e-16))
        )
        assert other == pytest.approx(one, rel=1e-9)


def test_a_response_without_poles_gives_one_at_the_end_of_the_band() -> None:
    """Far from all that is sampled within."""
    found, _ = rational_poles(OMEGA, np.full(len(OMEGA), 2.0 + 0.0j), 1e-11)
    assert len(found) == 1
    assert abs(found[0]) == pytest.approx(OMEGA[-1])


def test_noise_is_no_rational_function() -> None:
    """How near it comes is reported."""
    chance = np.random.default_rng(2)
    noise = chance.standard_normal(len(OMEGA)) + 1j * chance.standard_normal(len(OMEGA))
    assert rational_poles(OMEGA, 1.0 + 1e-3 * noise, 1e-11).near > 1e-5
