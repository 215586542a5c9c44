"""A receptance that is given as a function, as the sum of modes that it is."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.modal import ModalTip, of_residues
from rotordyn.numerics.vector_fit import Fit, residues, vector_fit

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
PAIRS = (1, 2, 3, 4, 6, 8, 12, 18)  # of conjugate poles, tried in this order
EXACT = 1e-7  # of the largest receptance: a fit that near is the receptance itself
SPURIOUS = 1e-7  # of the largest receptance: the peak of a mode that a fit does not need


def as_modes(receptance: Callable[[Array], Complex], omega: Array) -> ModalTip | None:
    """The sum of modes that a receptance (f, 2, 2) is at the samples ``omega`` (f,), or None where
    it is none, as one with noise or with a loss factor."""
    values = receptance(omega)
    flat = values.reshape(len(omega), -1)
    size = np.abs(flat).max(axis=1)
    weight = 1.0 / np.sqrt(np.maximum(size, 1e-12 * size.max()))[:, None]
    for pairs in PAIRS:
        fit = vector_fit(omega, flat, pairs, weight)
        if not _exact(fit, size):
            continue
        peak = np.abs(fit.residue).max(axis=1) / np.abs(fit.pole.real)
        kept = peak > SPURIOUS * size.max()
        least = residues(omega, flat, fit.pole[kept], weight)
        if _exact(least, size):
            shape = (-1, *values.shape[1:])
            return of_residues(
                least.pole, least.residue.reshape(shape), least.constant.reshape(shape[1:])
            )
    return None


def _exact(fit: Fit, size: Array) -> bool:
    return bool(np.abs(fit.error).max() <= EXACT * size.max())
