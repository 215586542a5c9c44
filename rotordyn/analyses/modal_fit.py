"""A sum of modes through measured receptances: noise is averaged over the band, and what follows
from differences of receptances, as inverse coupling, stays smooth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import InvalidInput
from rotordyn.numerics.pole_count import counted, of_count
from rotordyn.numerics.pole_refinement import carried
from rotordyn.numerics.vector_fit import Fit

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
MOST = 24  # modes tried where their number is not given
LEAST = 1e-3  # of the largest value of an entry: smaller values weigh the same


@dataclass(frozen=True, eq=False)
class ModalFit:
    """Modes common to all entries of a measurement, of shape ``shape`` each.

    ``misfit``: root mean square of the differences of the samples from the sum, over their size;
    for good measurements it is their noise. ``omega`` (f,) and ``size`` (f, e): of the samples.
    """

    fit: Fit
    shape: tuple[int, ...]
    misfit: float
    omega: Array
    size: Array

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
        """Standard deviation (f,) of the modulus of Σ ``share`` (f, e) × entries at angular
        frequencies (f,), from a noise of every sample as large as the misfit."""
        weight = np.sqrt(2.0) / (max(self.misfit, 1e-300) * self.size)
        return carried(self.fit, self.omega, weight, omega, share)


def modal_fit(omega: Array, values: Complex, modes: int | None = None) -> ModalFit:
    """Fit ``modes`` and a constant to ``values`` (f, …) at ``omega`` (f,) [rad/s], ascending; None:
    as many modes as the samples give evidence of.

    The noise is taken to be in proportion to each sample. More modes than the band holds fit
    noise.

    Raises
    ------
    InvalidInput : fewer samples than unknowns, frequencies that do not ascend, no mode
    """
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
    size = np.maximum(np.abs(flat), LEAST * np.abs(flat).max(axis=0))
    size = np.maximum(size, 1e-300)
    if modes is None:
        fit = counted(omega, flat, size, min(MOST, (len(omega) - 2) // 4)).best.fit
    else:
        fit = of_count(omega, flat, size, modes).fit
    misfit = float(np.sqrt(np.mean(np.abs(fit.error / size) ** 2)))
    return ModalFit(fit, values.shape[1:], misfit, np.asarray(omega), size)
