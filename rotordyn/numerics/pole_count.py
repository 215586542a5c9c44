"""How many poles samples with noise carry, and which: one more at a time where the sum of the last
ones misses the samples most, until the evidence for one more is gone.

The evidence of m poles is Bayes' information criterion, N ln(S/N) + k ln N, of the sum of squares S
over N real samples and k unknowns; it needs no size of the noise, only its shape.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.numerics.pole_refinement import Refined, refined
from rotordyn.numerics.vector_fit import vector_fit

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
PROMINENT = 0.35  # of ln |H|: a peak to begin with, 3 dB
IN_VAIN = 2  # poles more without evidence
DAMPED = 0.01  # damping ratio of a first pole
WINDOW = 7  # samples over which misses are averaged


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
    weight = 1.0 / deviation
    start = _peaks(omega, weight, values)[:most]
    fit = vector_fit(omega, values, len(start), weight, start)
    here = refined(omega, values, fit.pole, weight)
    best, trials = here, [_trial(here, values)]
    while len(here.fit.pole) < most:
        here = refined(omega, values, _one_more(omega, here, weight), weight)
        trials.append(_trial(here, values))
        if trials[-1].evidence < min(each.evidence for each in trials[:-1]):
            best = here
        elif len(here.fit.pole) - len(best.fit.pole) >= IN_VAIN:
            break
    return Counted(best, tuple(trials))


def _trial(fit: Refined, values: Complex) -> Trial:
    samples = 2 * values.size
    evidence = samples * np.log(fit.squares / samples) + fit.unknowns * np.log(samples)
    misfit = np.sqrt(fit.squares / max(samples - fit.unknowns, 1))
    return Trial(len(fit.fit.pole), float(evidence), float(misfit))


def _peaks(omega: Array, weight: Array, values: Complex) -> Complex:
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
