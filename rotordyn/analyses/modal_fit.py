"""A sum of modes through measured receptances: noise is averaged over the band, and what follows
from differences of receptances, as inverse coupling, stays smooth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import InvalidInput
from rotordyn.numerics.vector_fit import Fit, vector_fit

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
LEAST = 1e-3  # of the largest value of an entry: less weighs no more


@dataclass(frozen=True, eq=False)
class ModalFit:
    """Modes common to all entries of a measurement, of shape ``shape`` each.

    ``misfit``: root mean square of what the samples differ from the sum, over their own size; that
    of good measurements is their noise.
    """

    fit: Fit
    shape: tuple[int, ...]
    misfit: float

    @property
    def frequency(self) -> Array:
        """Of the modes [Hz]."""
        return np.abs(self.fit.pole) / (2.0 * np.pi)

    @property
    def damping(self) -> Array:
        """Damping ratios of the modes."""
        return -self.fit.pole.real / np.abs(self.fit.pole)

    def __call__(self, omega: Array) -> Complex:
        """At angular frequencies (f,) within the band: (f, …)."""
        return self.fit(omega).reshape(len(omega), *self.shape)


def modal_fit(omega: Array, values: Complex, modes: int) -> ModalFit:
    """Fit ``modes`` and a constant to ``values`` (f, …) at ``omega`` (f,) [rad/s], ascending.

    The noise is taken to be in proportion to each sample. More modes than the band holds fit
    noise: raise their number until ``misfit`` stays.

    Raises
    ------
    InvalidInput : fewer samples than unknowns, frequencies that do not ascend, no mode
    """
    flat = np.asarray(values, dtype=complex).reshape(len(omega), -1)
    if modes < 1:
        raise InvalidInput(f"modes: given {modes}; allowed: at least 1")
    if len(omega) < 4 * modes + 2:
        raise InvalidInput(
            f"too few frequencies for {modes} modes: given {len(omega)}; allowed: at least "
            f"{4 * modes + 2}"
        )
    if not (np.diff(omega) > 0.0).all() or not omega[0] > 0.0:
        raise InvalidInput("frequencies: they must ascend from above 0 Hz")
    if not np.isfinite(flat).all():
        raise InvalidInput("a measured receptance is not a finite number")
    size = np.maximum(np.abs(flat), LEAST * np.abs(flat).max(axis=0))
    fit = vector_fit(omega, flat, modes, 1.0 / np.maximum(size, 1e-300))
    misfit = float(np.sqrt(np.mean(np.abs(fit.error / np.maximum(size, 1e-300)) ** 2)))
    return ModalFit(fit, values.shape[1:], misfit)
