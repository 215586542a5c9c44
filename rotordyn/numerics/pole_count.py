"""Number and values of the poles in samples with noise.

From one at every peak, and one beyond either end of the band for poles outside, one more is added
at a time where the error of the sum is largest, until two have been added without evidence. Then
the weakest are removed, as long as the evidence does not suffer.

The evidence of m poles is Bayes' information criterion, N ln(S/N) + k ln N, of the sum of squares S
over N real samples and k unknowns; it needs no size of the noise, only its shape.

A pole much narrower than the distance of lines, for which there is no evidence without its highest
line, is no mode: that line is an outlier, and poles are counted again without it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Complex, Indices
from rotordyn.numerics.pole_refinement import Refined, refined
from rotordyn.numerics.vector_fit import vector_fit

PROMINENT = 0.35  # of ln |H|: prominence of a peak that gives an initial pole, 3 dB
IN_VAIN = 2  # further poles without evidence end the search
EXACT = 1e-6  # of the standard deviation: a sum this close leaves no noise to explain
DAMPED = 0.01  # damping ratio of an initial pole
WINDOW = 7  # samples over which errors are averaged
NARROW = 0.2  # of the distance of lines: a wider pole is seen on adjacent ones
MOST_OUTLIERS = 0.1  # of the lines: more are no outliers
BEYOND = 1.5  # of either end of the band: initial poles outside


class Trial(NamedTuple):
    """Number of ``poles``, the ``evidence`` against them (less is better), and ``misfit``: root
    mean square of samples over their standard deviation, by degrees of freedom."""

    poles: int
    evidence: float
    misfit: float


class Counted(NamedTuple):
    """Fit with the chosen number of poles, every number that was tried, and the ``outliers`` (k,)
    among the lines, without which it is."""

    best: Refined
    trials: tuple[Trial, ...]
    outliers: Indices = np.zeros(0, dtype=int)

    @property
    def misfit(self) -> float:
        """Misfit of the chosen number of poles."""
        return next(t.misfit for t in self.trials if t.poles == len(self.best.fit.pole))


def counted(omega: Array, values: Complex, deviation: Array, most: int) -> Counted:
    """Return the fit of ``values`` (f, e) at ``omega`` (f,) with the likeliest number of poles, at
    most ``most``; ``deviation`` (f, e): standard, of real and imaginary part each."""
    weight, trials = 1.0 / deviation, list[Trial]()
    for fit in _growing(omega, values, weight, most):
        trials.append(_trial(fit, values))
        if all(trials[-1].evidence < trial.evidence for trial in trials[:-1]):
            best = fit
        elif len(fit.fit.pole) - len(best.fit.pole) >= IN_VAIN:
            break
        if trials[-1].misfit < EXACT:
            break
    return Counted(*_pruned(omega, values, weight, best, trials))


def counted_without_outliers(omega: Array, values: Complex, deviation: Array, most: int) -> Counted:
    """Return the poles likewise, without lines that stand alone."""
    kept = np.arange(len(omega))
    while True:
        found = counted(omega[kept], values[kept], deviation[kept], most)
        alone = _alone(omega[kept], values[kept], found.best, 1.0 / deviation[kept])
        if len(omega) - len(kept) + len(alone) > MOST_OUTLIERS * len(omega):
            return counted(omega, values, deviation, most)
        if not len(alone):
            return found._replace(outliers=np.setdiff1d(np.arange(len(omega)), kept))
        kept = np.delete(kept, alone)


def of_count(omega: Array, values: Complex, deviation: Array, count: int) -> Refined:
    """Return the fit with ``count`` poles of the same samples."""
    *_, last = _growing(omega, values, 1.0 / deviation, count)
    return last


def _growing(omega: Array, values: Complex, weight: Array, most: int) -> Iterator[Refined]:
    """Yield fits from one pole for every peak, and those beyond the band, up to ``most``."""
    start = np.concatenate([_peaks(omega, values), _outside(omega)])[:most]
    fit = refined(omega, values, vector_fit(omega, values, weight, start).pole, weight)
    yield fit
    while len(fit.fit.pole) < most:
        fit = refined(omega, values, _one_more(omega, fit, weight), weight)
        yield fit


def _pruned(
    omega: Array, values: Complex, weight: Array, best: Refined, trials: list[Trial]
) -> tuple[Refined, tuple[Trial, ...]]:
    """Return the fit without poles for which there is no evidence, the weakest removed first, and
    the best trial of each number of poles."""
    by_count = {t.poles: t for t in trials}
    least = _trial(best, values).evidence
    while len(best.fit.pole) > 1:
        weakest = int(_strength(omega, best, weight).argmin())
        fewer = refined(omega, values, np.delete(best.fit.pole, weakest), weight)
        trial = _trial(fewer, values)
        if not trial.evidence < least:
            break
        best, least = fewer, trial.evidence
        by_count[trial.poles] = trial
    return best, tuple(by_count[count] for count in sorted(by_count))


def _alone(omega: Array, values: Complex, fit: Refined, weight: Array) -> Indices:
    """Return the lines for which alone there is a pole: on the other lines there is no evidence of
    it."""
    pole, spacing, lines = fit.fit.pole, np.gradient(omega), []
    by_line = (np.abs(weight * fit.fit.error) ** 2).sum(axis=1)
    for k in range(len(pole) if len(pole) > 1 else 0):
        line = int(np.abs(omega - pole[k].imag).argmin())
        if abs(pole[k].real) > NARROW * spacing[line]:
            continue
        rest = np.delete(np.arange(len(omega)), line)
        fewer = refined(omega[rest], values[rest], np.delete(pole, k), weight[rest])
        others = fit._replace(squares=by_line[rest].sum())
        # beside another pole, or where one moves to the place of this one, there may be a mode
        near = np.abs(fewer.fit.pole.imag - omega[line]) < 2.0 * spacing[line]
        no_evidence = _trial(fewer, values[rest]).evidence < _trial(others, values[rest]).evidence
        if no_evidence and not near.any():
            lines.append(line)
    return np.unique(np.array(lines, dtype=int))


def _strength(omega: Array, fit: Refined, weight: Array) -> Array:
    """Return what each pole adds to the samples over their deviation (m,)."""
    s, pole = 1j * omega[:, None], fit.fit.pole
    direct, conjugate = 1.0 / np.abs(s - pole) ** 2, 1.0 / np.abs(s - pole.conj()) ** 2
    shared = (np.abs(weight) ** 2).T @ (direct + conjugate)
    return np.asarray((np.abs(fit.fit.residue.T) ** 2 * shared).sum(axis=0))


def _trial(fit: Refined, values: Complex) -> Trial:
    samples = 2 * values.size
    evidence = samples * np.log(fit.squares / samples) + fit.unknowns * np.log(samples)
    misfit = np.sqrt(fit.squares / max(samples - fit.unknowns, 1))
    return Trial(len(fit.fit.pole), float(evidence), float(misfit))


def _outside(omega: Array) -> Complex:
    """Return a pole on either side of the band."""
    return np.array([omega[-1] * BEYOND, omega[0] / BEYOND]) * (1j - DAMPED)


def _peaks(omega: Array, values: Complex) -> Complex:
    """Return lightly damped poles at the peaks of the mean of ln |H|, most prominent first; at
    its maximum if it has no peak."""
    from scipy.signal import find_peaks

    size = np.log(np.maximum(np.abs(values), 1e-300)).mean(axis=1)
    tops, properties = find_peaks(size, prominence=PROMINENT)
    if not len(tops):
        tops, properties = np.array([int(size.argmax())]), {"prominences": np.ones(1)}
    at = omega[tops[np.argsort(-properties["prominences"])]]
    return np.asarray(-DAMPED * at + 1j * at)


def _one_more(omega: Array, fit: Refined, weight: Array) -> Complex:
    """Return the poles and one where the error is largest; one whose peak is there is split."""
    error = (np.abs(weight * fit.fit.error) ** 2).sum(axis=1)
    smooth = np.convolve(error, np.ones(WINDOW) / WINDOW, mode="same")
    at, pole = omega[smooth.argmax()], fit.fit.pole
    nearest = int(np.abs(pole - 1j * at).argmin())
    width = abs(pole[nearest].real)
    if abs(pole[nearest].imag - at) < 2.0 * width and pole[nearest].imag > 0.0:
        offset = 0.7j * width
        return np.append(np.delete(pole, nearest), [pole[nearest] - offset, pole[nearest] + offset])
    damped = np.median(np.abs(pole.real) / np.abs(pole))
    return np.append(pole, (-min(max(damped, 1e-4), 0.05) + 1j) * at)
