"""A sum of modes through measured receptances.

Noise is averaged over the band, and what follows from differences of receptances, as inverse
coupling, stays smooth.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rotordyn.arrays import Array, Complex
from rotordyn.errors import InvalidInput
from rotordyn.numerics.pole_count import EXACT, counted, of_count
from rotordyn.numerics.pole_refinement import Refined, carried
from rotordyn.numerics.sample_noise import sample_noise
from rotordyn.numerics.vector_fit import Fit

MOST = 24  # modes tried where their number is not given
LEAST = 1e-3  # of the largest value of an entry: smaller values weigh the same at first
ROUNDS = 3  # fits with weights by the noise of the one before, at most
SETTLED = 0.1  # change of ln σ of nearly all samples, apart from one of all of them, that ends them
NEARLY = 95.0  # percent of the samples


@dataclass(frozen=True, eq=False)
class ModalFit:
    """Modes common to all entries of a measurement, of shape ``shape`` each.

    ``misfit``: root mean square of the differences of the samples from the sum, over their size;
    for good measurements it is their noise. ``omega`` (f,) of the samples, and their estimated
    standard ``deviation`` (f, e). ``at_most``: the number of modes is the largest that was tried.
    """

    fit: Fit
    shape: tuple[int, ...]
    misfit: float
    omega: Array
    deviation: Array
    at_most: bool = False

    @property
    def frequency(self) -> Array:
        """Natural frequencies of the modes [Hz]."""
        return np.abs(self.fit.pole) / (2.0 * np.pi)

    @property
    def damping(self) -> Array:
        """Damping ratios of the modes."""
        return -self.fit.pole.real / np.abs(self.fit.pole)

    def __call__(self, omega: Array) -> Complex:
        """Receptances (f, …) at angular frequencies (f,) within the band."""
        return self.fit(omega).reshape(len(omega), *self.shape)

    def carried(self, omega: Array, share: Complex) -> Array:
        """Standard deviations (f, 2) of real and imaginary part of Σ ``share`` (f, e) × entries at
        angular frequencies (f,), from the noise of the samples."""
        return carried(self.fit, self.omega, np.sqrt(2.0) / self.deviation, omega, share)


def modal_fit(
    omega: Array, values: Complex, modes: int | None = None, coherence: Array | None = None
) -> ModalFit:
    """Fit ``modes`` and a constant to ``values`` (f, …) at ``omega`` (f,) [rad/s], ascending; None:
    as many modes as the samples give evidence of.

    Samples weigh by their noise: at first in proportion to each, then by floors and ``coherence``,
    γ² of the shape of ``values``, as well, estimated from what the fit before leaves. More modes
    than the band holds fit noise.

    Raises
    ------
    InvalidInput : fewer samples than unknowns, frequencies that do not ascend, no mode; values or
        coherence of another shape, or not finite
    """
    flat = _checked(omega, values, modes)
    size = np.maximum(np.abs(flat), LEAST * np.abs(flat).max(axis=0))
    size = np.maximum(size, 1e-300)
    gamma = None if coherence is None else _checked_coherence(np.asarray(coherence), values.shape)
    most = min(MOST, (len(omega) - 2) // 4)

    def fitted(deviation: Array) -> Refined:
        if modes is None:
            return counted(omega, flat, deviation, most).best
        return of_count(omega, flat, deviation, modes)

    deviation = size
    for _ in range(ROUNDS):
        refined = fitted(deviation)
        misfit = float(np.sqrt(np.mean(np.abs(refined.fit.error / size) ** 2)))
        before, deviation = deviation, _deviation(omega, refined, gamma)
        change = np.log(deviation / before)
        settled = np.percentile(np.abs(change - np.median(change)), NEARLY) < SETTLED
        if settled or misfit < EXACT:
            break
    fit = refined.fit
    at_most = modes is None and len(fit.pole) >= most
    return ModalFit(fit, values.shape[1:], misfit, np.asarray(omega), deviation, at_most)


def _checked(omega: Array, values: Complex, modes: int | None) -> Complex:
    """Return the values as (f, e); raises InvalidInput."""
    if len(values) != len(omega) or not values.size:
        raise InvalidInput(
            f"values: given the shape {values.shape}; allowed: a value at each of the "
            f"{len(omega)} frequencies"
        )
    flat = np.asarray(values, dtype=complex).reshape(len(omega), -1)
    least = 1 if modes is None else modes
    if least < 1:
        raise InvalidInput(f"modes: given {modes}; allowed: at least 1")
    if len(omega) < 4 * least + 2:
        raise InvalidInput(
            f"too few frequencies for {least} modes: given {len(omega)}; allowed: at least "
            f"{4 * least + 2}"
        )
    if not (np.diff(omega) > 0.0).all() or not omega[0] > 0.0:
        raise InvalidInput("frequencies: they must ascend from above 0 Hz")
    if not np.isfinite(flat).all():
        raise InvalidInput("a measured receptance is not a finite number")
    if not np.abs(flat).max(axis=0).all():
        raise InvalidInput("a measured receptance is zero at all frequencies")
    return flat


def _checked_coherence(coherence: Array, shape: tuple[int, ...]) -> Array:
    """Return the coherence of values of a ``shape`` (f, …) as (f, e)."""
    if coherence.shape != shape:
        raise InvalidInput(
            f"coherence: given the shape {coherence.shape}; allowed: {shape}, that of the values"
        )
    if not ((coherence >= 0.0) & (coherence <= 1.0)).all():
        raise InvalidInput("coherence: allowed are numbers from 0 to 1")
    return coherence.reshape(len(coherence), -1)


def _deviation(omega: Array, refined: Refined, coherence: Array | None) -> Array:
    """Return the standard deviation of the samples (f, e) from what ``refined`` leaves of them, of
    which its unknowns take a part."""
    fit, samples = refined.fit, 2 * refined.fit.error.size
    part = np.sqrt(samples / max(samples - refined.unknowns, 1))
    return part * sample_noise(omega, fit(omega), fit.error, coherence)
