"""Modes fitted to responses with noise: as near as the noise allows, as sure as is said."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.analyses.modal_fit import MOST, modal_fit
from rotordyn.numerics.pole_refinement import refined
from rotordyn.numerics.sample_noise import sample_noise

OMEGA = 2.0 * np.pi * np.arange(100.0, 5001.0, 10.0)
HERTZ = np.array([889.0, 1074.0, 1758.0, 3703.0, 6389.0, 9240.0])  # two above the band
RATIO = np.array([0.0168, 0.0182, 0.0162, 0.0031, 0.003, 0.0015])
POLE = 2.0 * np.pi * HERTZ * (-RATIO + 1j)
SHAPE = np.array([[1.0, 0.8], [0.9, 0.6], [1.0, 0.4], [1.1, -0.3], [1.0, -0.6], [0.9, -0.7]])
NOISE = 0.01


def responses() -> np.ndarray:
    """Of two places, front, across and behind (f, 3) [m/N]."""
    product = np.stack([SHAPE[:, 0] ** 2, SHAPE[:, 0] * SHAPE[:, 1], SHAPE[:, 1] ** 2], axis=1)
    residue = product / (2j * POLE.imag[:, None])
    s = 1j * OMEGA[:, None]
    return np.asarray((1.0 / (s - POLE)) @ residue + (1.0 / (s - POLE.conj())) @ residue.conj())


def unit_noise(seed: int) -> np.ndarray:
    """Complex normal numbers (f, 3) of mean square 1."""
    noise = np.random.default_rng(seed).normal(size=(2, len(OMEGA), 3)) / np.sqrt(2.0)
    return np.asarray(noise[0] + 1j * noise[1])


def noisy(seed: int) -> np.ndarray:
    return np.asarray(responses() * (1.0 + NOISE * unit_noise(seed)))


def of_an_accelerometer() -> np.ndarray:
    """Deviation (f, 3) of receptances: 0.3 %, and 0.1 % of the peak inertance at every line."""
    exact, square = responses(), OMEGA[:, None] ** 2
    return np.asarray(np.hypot(3e-3 * np.abs(exact), 1e-3 * np.abs(exact * square).max(0) / square))


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("modes", [6, None])
def test_what_is_left_of_noisy_responses_is_their_noise(modes: int | None, seed: int) -> None:
    """And the sum of modes is much nearer to the exact responses than the samples are."""
    found = modal_fit(OMEGA, noisy(seed), modes)
    assert found.misfit == pytest.approx(NOISE, rel=0.05)
    off = np.abs(found(OMEGA) - responses()) / np.abs(responses())
    assert np.median(off) < 0.15 * NOISE
    for pole in POLE[:4]:
        assert np.abs(found.fit.pole - pole).min() < 0.02 * abs(pole.real)


def test_the_noise_that_is_carried_is_the_scatter_of_repeated_fits() -> None:
    """Of 12, in a difference of entries, whose errors are not independent; a mean
    square of some 40 numbers in each fit has a standard error below 5 %."""
    share = np.array([1.0, -2.0, 1.0]) * np.ones((len(OMEGA), 1))
    exact, apart = responses(), []
    for seed in range(12):
        found = modal_fit(OMEGA, noisy(seed), 6)
        off = ((found(OMEGA) - exact) * share).sum(axis=1)
        apart.append(np.abs(off) / np.linalg.norm(found.carried(OMEGA, share), axis=1))
    assert np.sqrt(np.mean(np.square(apart))) == pytest.approx(1.0, abs=0.15)
    assert np.median(np.sqrt(np.mean(np.square(apart), axis=0))) == pytest.approx(1.0, abs=0.15)


@pytest.mark.parametrize("count", [6, 9, 14, 17])
def test_few_frequencies_leave_more_samples_than_unknowns(count: int) -> None:
    """Four to a mode and two, as where their number is given."""
    for seed in range(6):
        samples = slice(0, 10 * count, 10)
        found = modal_fit(OMEGA[samples], noisy(seed)[samples, :1])
        assert len(found.fit.pole) <= (count - 2) // 4


@pytest.mark.parametrize("seed", range(3))
def test_the_floor_of_a_sensor_is_found_and_weighs_as_it_does(seed: int) -> None:
    """The sum of modes is as near to the exact responses as one by weights that are known and poles
    that begin at the exact ones; noise in proportion to the samples led to the most modes tried."""
    deviation = of_an_accelerometer()
    values = responses() + deviation * unit_noise(seed)
    found = modal_fit(OMEGA, values)
    assert not found.at_most
    assert len(found.fit.pole) <= 9
    assert np.percentile(np.abs(found.deviation / deviation - 1.0), 95.0) < 0.2
    best = refined(OMEGA, values, POLE, 1.0 / deviation).fit(OMEGA)
    off, least = (np.abs((each - responses()) / deviation) for each in (found(OMEGA), best))
    assert np.sqrt(np.mean(off**2)) < 1.5 * np.sqrt(np.mean(least**2))


def test_noise_by_coherence_is_distinguished_from_a_share_of_every_sample() -> None:
    """H₁ of 20 averages with a coherence that falls from line to line at random."""
    rng, exact = np.random.default_rng(3), responses()
    gamma = rng.uniform(0.3, 0.999, exact.shape)
    relative = np.sqrt((1.0 - gamma) / (20.0 * gamma))
    remainder = relative * np.abs(exact) * unit_noise(4)
    found = sample_noise(OMEGA, exact, remainder, gamma)
    assert np.percentile(np.abs(found / (relative * np.abs(exact)) - 1.0), 95.0) < 0.2
    values = exact + remainder
    with_it, without = (modal_fit(OMEGA, values, None, given) for given in (gamma, None))
    off = [np.median(np.abs((fit(OMEGA) - exact) / exact)) for fit in (with_it, without)]
    assert off[0] < 0.5 * off[1]


def test_the_most_modes_that_are_tried_are_reported() -> None:
    """Three modes between few frequencies, which allow two."""
    samples = slice(0, 420, 38)
    found = modal_fit(OMEGA[samples], noisy(0)[samples])
    assert len(found.fit.pole) == 2 < MOST
    assert found.at_most
    assert not modal_fit(OMEGA, noisy(0)).at_most
