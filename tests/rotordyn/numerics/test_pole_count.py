"""Poles of noisy samples: as many as there are, where they are, as sure as is said."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.numerics import pole_count
from rotordyn.numerics.pole_count import (
    Counted,
    Trial,
    _one_more,
    _outside,
    _peaks,
    _strength,
    _trial,
    counted,
    counted_without_outliers,
)
from rotordyn.numerics.pole_refinement import Refined, refined
from rotordyn.numerics.vector_fit import residues

HERTZ = np.array([180.0, 300.0, 304.0, 520.0])
RATIO = np.array([0.01, 0.008, 0.008, 0.002])
POLE = 2.0 * np.pi * HERTZ * (-RATIO + 1j * np.sqrt(1.0 - RATIO**2))
SHAPE = np.array([[1.0, 0.6, -0.4], [0.8, -1.0, 0.3], [-0.7, 0.5, 1.0], [0.5, 0.4, 0.9]])
OMEGA = 2.0 * np.pi * np.linspace(100.0, 600.0, 300)
NOISE = 0.02


def values() -> np.ndarray:
    """Receptances of three places under a force at the first (f, 3)."""
    residue = SHAPE * SHAPE[:, :1] / (2j * POLE.imag[:, None])
    s = 1j * OMEGA[:, None]
    ahead = (1.0 / (s - POLE)) @ residue
    return ahead + (1.0 / (s - POLE.conj())) @ residue.conj()


def measured(seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng, exact = np.random.default_rng(seed), values()
    noise = rng.normal(size=(2, *exact.shape))
    return exact * (1.0 + NOISE * (noise[0] + 1j * noise[1])), NOISE * np.abs(exact)


def inside(found: Counted) -> np.ndarray:
    pole = found.best.fit.pole
    return (pole.imag > OMEGA[0]) & (pole.imag < OMEGA[-1])


@pytest.mark.parametrize(("further", "chosen"), [((7.0, 6.0, 1.0), 0), ((7.0, 4.0, 8.0, 8.0), 2)])
def test_another_count_is_chosen_where_it_is_better_than_the_best(
    monkeypatch: pytest.MonkeyPatch, further: tuple[float, ...], chosen: int
) -> None:
    """Not where it is better than the one before; after two in vain no more are tried."""
    samples, deviation = measured(0)
    told = dict(enumerate((5.0, *further), start=1))

    def trial(fit: Refined, _: np.ndarray) -> Trial:
        count = len(fit.fit.pole)
        return Trial(count, told.get(count, 9.0), 1.0)

    monkeypatch.setattr(pole_count, "_trial", trial)
    monkeypatch.setattr(pole_count, "_peaks", lambda *_: POLE[:1])
    monkeypatch.setattr(pole_count, "_outside", lambda _: POLE[:0])
    found = counted(OMEGA, samples, deviation, 12)
    assert len(found.best.fit.pole) == 1 + chosen


@pytest.mark.parametrize("seed", range(3))
def test_number_of_poles_follows_from_the_evidence(seed: int) -> None:
    """A pair 4 Hz apart, whose peaks are 5 Hz wide, is two; one pole fewer leaves more than the
    noise, one more has no evidence."""
    found = counted(OMEGA, *measured(seed), 12)
    assert inside(found).sum() == len(POLE)
    assert found.misfit == pytest.approx(1.0, abs=0.08)
    evidence = {each.poles: each.evidence for each in found.trials}
    count = len(found.best.fit.pole)
    assert evidence[count + 1] > evidence[count]
    few = counted(OMEGA, *measured(seed), len(POLE) - 1)
    assert few.misfit > 1.5


def test_deviations_are_those_of_repeated_measurements() -> None:
    """Of 24: the scatter over what is said has a standard error of 15 % in each of eight parts."""
    apart = []
    for seed in range(24):
        samples, deviation = measured(seed)
        found = refined(OMEGA, samples, POLE, 1.0 / deviation)
        error = found.fit.pole - POLE
        apart.append(np.stack([error.real, error.imag], axis=1) / found.deviation)
    scatter = np.sqrt(np.mean(np.square(apart), axis=0))
    assert scatter.mean() == pytest.approx(1.0, abs=0.15)
    assert np.abs(np.mean(apart, axis=0)).max() < 0.8


def test_least_squares_have_no_slope_at_the_refined_poles() -> None:
    samples, deviation = measured(5)
    found = refined(OMEGA, samples, 1.003 * POLE, 1.0 / deviation)
    assert np.abs(found.fit.pole / POLE - 1.0).max() < 2e-3
    for k in range(len(POLE)):
        for step in (found.deviation[k, 0], 1j * found.deviation[k, 1]):
            moved = found.fit.pole.copy()
            moved[k] += 0.1 * step
            basis = np.concatenate(
                [1.0 / (1j * OMEGA[:, None] - q) for q in (moved, moved.conj())], 1
            )
            columns = np.concatenate([basis, np.ones((len(OMEGA), 1))], axis=1)
            assert squares(columns, samples, deviation) > found.squares - 0.05


def squares(columns: np.ndarray, samples: np.ndarray, deviation: np.ndarray) -> float:
    """Of residues that need not be conjugate of one another, in real arithmetic of both."""
    half, total = (columns.shape[1] - 1) // 2, 0.0
    one, other = columns[:, :half], columns[:, half : 2 * half]
    real = np.concatenate([one + other, 1j * (one - other), columns[:, -1:]], axis=1)
    for k in range(samples.shape[1]):
        left = real / deviation[:, k, None]
        rows = np.concatenate([left.real, left.imag])
        right = samples[:, k] / deviation[:, k]
        both = np.concatenate([right.real, right.imag])
        rest = both - rows @ np.linalg.lstsq(rows, both, rcond=None)[0]
        total += float(rest @ rest)
    return total


def test_a_peak_of_two_is_split_about_its_pole() -> None:
    """One pole for the pair 4 Hz apart: two in its place, one below and one above."""
    samples, deviation = measured(0)
    few = refined(OMEGA, samples, POLE[[0, 1, 3]], 1.0 / deviation)
    found = _one_more(OMEGA, few, 1.0 / deviation)
    (left,) = few.fit.pole[~np.isin(few.fit.pole, found)]
    below, above = np.sort_complex(found[~np.isin(found, few.fit.pole)] / 1j)[::-1] * 1j
    assert (below + above) / 2.0 == pytest.approx(left)
    assert abs(below.imag - above.imag) > abs(left.real)


def test_a_missed_peak_gets_a_pole_damped_like_the_others() -> None:
    """Far from the poles there are: at the frequency of the peak, within two samples of it."""
    weight = np.ones_like(values(), dtype=float)
    few = Refined(residues(OMEGA, values(), POLE[:3], weight), np.zeros((3, 2)), 1.0, 21)
    *before, new = _one_more(OMEGA, few, weight)
    assert before == POLE[:3].tolist()
    assert abs(new.imag - POLE[3].imag) < 2.0 * (OMEGA[1] - OMEGA[0])
    assert -new.real / new.imag == pytest.approx(np.median(RATIO[:3]))


def test_poles_outside_decay_beyond_either_end() -> None:
    above, below = _outside(OMEGA)
    assert above.imag > OMEGA[-1]
    assert 0.0 < below.imag < OMEGA[0]
    for pole in (above, below):
        assert -0.1 * pole.imag < pole.real < 0.0


def test_strength_of_a_pole_is_what_it_adds_to_the_samples() -> None:
    """|R/(s − p)|² and that of the conjugate over the variance, one sample after another."""
    samples, deviation = measured(0)
    found = refined(OMEGA, samples, POLE, 1.0 / deviation)
    strength = _strength(OMEGA, found, 1.0 / deviation)
    for pole, residue, known in zip(found.fit.pole, found.fit.residue, strength, strict=True):
        total = 0.0
        for omega, width in zip(OMEGA, deviation, strict=True):
            for root, share in ((pole, residue), (pole.conjugate(), residue.conj())):
                total += float((np.abs(share / (1j * omega - root) / width) ** 2).sum())
        assert known == pytest.approx(total, rel=1e-12)


def test_evidence_and_misfit_by_hand() -> None:
    """Bayes' criterion N ln(S/N) + k ln N of N = 1800 real numbers, misfit √(S/(N − k))."""
    one = Refined(
        residues(OMEGA, values(), POLE[:2], np.ones((300, 3))), np.zeros((2, 2)), 90.0, 16
    )
    found = _trial(one, values())
    assert found.poles == 2
    assert found.evidence == pytest.approx(1800.0 * np.log(0.05) + 16.0 * np.log(1800.0))
    assert found.misfit == pytest.approx(np.sqrt(90.0 / 1784.0))


def test_counting_begins_at_peaks_the_most_prominent_first() -> None:
    """Of three poles alone 1, 4 and 2 times as high as the rest; a smooth rise has one, its top."""
    pole = (-0.005 + 1j) * 2.0 * np.pi * np.array([200.0, 350.0, 500.0])
    height = np.array([[3.0], [40.0], [9.0]])
    s = 1j * OMEGA[:, None]
    curve = 1.0 + np.abs(pole.real / (s - pole)) ** 2 @ height + 0j
    found = _peaks(OMEGA, curve)
    assert found.imag == pytest.approx(pole.imag[[1, 2, 0]], rel=0.01)
    assert found.real == pytest.approx(-0.01 * found.imag)
    rise = _peaks(OMEGA, np.exp(OMEGA[:, None] / 1e3) + 0j)
    assert rise.imag.tolist() == [OMEGA[-1]]


@pytest.mark.parametrize("stated", [1.0, 0.1, 10.0])
@pytest.mark.parametrize("seed", range(3))
def test_a_line_that_is_alone_is_no_pole(seed: int, stated: float) -> None:
    """Of one response, twice its size off; a peak narrower than the distance of lines, which
    extends over many of them, is a pole. The noise may be stated wrongly."""
    samples, deviation = measured(seed)
    rng = np.random.default_rng(100 + seed)
    wrong = np.array([12, 77, 140, 205, 290])
    samples[wrong, rng.integers(3, size=len(wrong))] *= 3.0
    sharp = 2.0 * np.pi * 420.4 * (-1e-4 + 1j)
    samples += (0.02 * SHAPE[3] / (1j * OMEGA[:, None] - sharp)) * 2e-4
    deviation = stated * np.abs(samples) * NOISE
    found = counted_without_outliers(OMEGA, samples, deviation, 24)
    assert found.outliers.tolist() == wrong.tolist()
    assert inside(found).sum() == len(POLE) + 1
    assert np.abs(found.best.fit.pole - sharp).min() < 2.0 * np.pi * 0.1
    assert found.misfit * stated == pytest.approx(1.0, abs=0.1)
    assert inside(counted(OMEGA, samples, deviation, 24)).sum() > len(POLE) + 1


def test_more_outliers_than_a_tenth_are_none() -> None:
    samples, deviation = measured(0)
    samples[::8] *= 3.0
    assert not counted_without_outliers(OMEGA, samples, deviation, 8).outliers.size
