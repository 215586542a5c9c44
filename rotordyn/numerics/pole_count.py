"""How many poles samples with noise carry, and which.

From one at every peak, and one beyond either end of the band for what lies outside, one more is
added at a time where the sum misses the samples most, until two have been added without evidence.
Then the weakest is left out again, as long as the evidence does not suffer.

The evidence of m poles is Bayes' information criterion, N ln(S/N) + k ln N, of the sum of squares S
over N real samples and k unknowns; it needs no size of the noise, only its shape.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Complex
from rotordyn.numerics.pole_refinement import Refined, refined
from rotordyn.numerics.vector_fit import vector_fit

PROMINENT = 0.35  # of ln |H|: a peak to begin with, 3 dB
IN_VAIN = 2  # poles more without evidence
EXACT = 1e-6  # of the standard deviation: a sum that near has no noise left to explain
DAMPED = 0.01  # damping ratio of a first pole
WINDOW = 7  # samples over which misses are averaged
BEYOND = 1.5  # of either end of the band: where poles outside begin


class Trial(NamedTuple):
    """A number of ``poles``, the ``evidence`` against them (less is better), and ``misfit``: root
    mean square of samples over their standard deviation, by degrees of freedom."""

    poles: int
    evidence: float
    misfit: float


class Counted(NamedTuple):
    """The fit of the chosen number of poles, and every number that was tried."""

    best: Refined
    trials: tuple[Trial, ...]

    @property
    def misfit(self) -> float:
        """Of the chosen one."""
        return next(t.misfit for t in self.trials if t.poles == len(self.best.fit.pole))


def counted(omega: Array, values: Complex, deviation: Array, most: int) -> Counted:
    """The poles of ``values`` (f, e) at ``omega`` (f,) with standard ``deviation`` (f, e) of real
    and imaginary part each, up to ``most``."""
    weight, trials = 1.0 / deviation, list[Trial]()
    for here in _ever_more(omega, values, weight, most):
        trials.append(_trial(here, values))
        if all(trials[-1].evidence < each.evidence for each in trials[:-1]):
            best = here
        elif len(here.fit.pole) - len(best.fit.pole) >= IN_VAIN:
            break
        if trials[-1].misfit < EXACT:
            break
    return Counted(*_without_idle(omega, values, weight, best, trials))


def of_count(omega: Array, values: Complex, deviation: Array, count: int) -> Refined:
    """So many poles of the same."""
    *_, last = _ever_more(omega, values, 1.0 / deviation, count)
    return last


def _ever_more(omega: Array, values: Complex, weight: Array, most: int) -> Iterator[Refined]:
    """From as many poles as there are peaks, and beyond the band, to ``most``."""
    start = np.concatenate([_peaks(omega, values), _outside(omega)])[:most]
    here = refined(omega, values, vector_fit(omega, values, weight, start).pole, weight)
    yield here
    while len(here.fit.pole) < most:
        here = refined(omega, values, _one_more(omega, here, weight), weight)
        yield here


def _without_idle(
    omega: Array, values: Complex, weight: Array, best: Refined, trials: list[Trial]
) -> tuple[Refined, tuple[Trial, ...]]:
    """The fit without poles for which there is no evidence, the weakest first; the best trial of
    each number of poles."""
    every = {each.poles: each for each in trials}
    least = _trial(best, values).evidence
    while len(best.fit.pole) > 1:
        weakest = int(_strength(omega, best, weight).argmin())
        fewer = refined(omega, values, np.delete(best.fit.pole, weakest), weight)
        trial = _trial(fewer, values)
        if not trial.evidence < least:
            break
        best, least = fewer, trial.evidence
        every[trial.poles] = trial
    return best, tuple(every[count] for count in sorted(every))


def _strength(omega: Array, fit: Refined, weight: Array) -> Array:
    """What each pole adds to the samples over their deviation (m,)."""
    s, pole = 1j * omega[:, None], fit.fit.pole
    ahead, back = 1.0 / np.abs(s - pole) ** 2, 1.0 / np.abs(s - pole.conj()) ** 2
    shared = (np.abs(weight) ** 2).T @ (ahead + back)
    return np.asarray((np.abs(fit.fit.residue.T) ** 2 * shared).sum(axis=0))


def _trial(fit: Refined, values: Complex) -> Trial:
    samples = 2 * values.size
    evidence = samples * np.log(fit.squares / samples) + fit.unknowns * np.log(samples)
    misfit = np.sqrt(fit.squares / max(samples - fit.unknowns, 1))
    return Trial(len(fit.fit.pole), float(evidence), float(misfit))


def _outside(omega: Array) -> Complex:
    """A pole on either side of the band."""
    return np.array([omega[-1] * BEYOND, omega[0] / BEYOND]) * (1j - DAMPED)


def _peaks(omega: Array, values: Complex) -> Complex:
    """Lightly damped poles at the peaks of the mean of ln |H|, the most prominent first; at least
    one."""
    from scipy.signal import find_peaks

    size = np.log(np.maximum(np.abs(values), 1e-300)).mean(axis=1)
    tops, how = find_peaks(size, prominence=PROMINENT)
    if not len(tops):
        tops, how = np.array([int(size.argmax())]), {"prominences": np.ones(1)}
    at = omega[tops[np.argsort(-how["prominences"])]]
    return np.asarray(-DAMPED * at + 1j * at)


def _one_more(omega: Array, fit: Refined, weight: Array) -> Complex:
    """The poles and one where samples are missed most: beside a pole so near that both are one
    peak, that is split."""
    missed = (np.abs(weight * fit.fit.error) ** 2).sum(axis=1)
    smooth = np.convolve(missed, np.ones(WINDOW) / WINDOW, mode="same")
    at, pole = omega[smooth.argmax()], fit.fit.pole
    near = int(np.abs(pole - 1j * at).argmin())
    width = abs(pole[near].real)
    if abs(pole[near].imag - at) < 2.0 * width and pole[near].imag > 0.0:
        apart = 0.7j * width
        return np.append(np.delete(pole, near), [pole[near] - apart, pole[near] + apart])
    damped = np.median(np.abs(pole.real) / np.abs(pole))
    return np.append(pole, (-min(max(damped, 1e-4), 0.05) + 1j) * at)
