"""A receptance that is given as a function, as the sum of modes that it is."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.stability_lobes.modal import ModalTip, of_residues
from rotordyn.numerics.rational import rational_poles
from rotordyn.numerics.vector_fit import Fit, residues, vector_fit

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
EXACT = 1e-7  # of the largest receptance: a fit that near is the receptance itself
NEAR = 1e-11  # of the largest receptance: how near a rational function comes to give first poles
SPURIOUS = 1e-7  # of the largest receptance: the peak of a mode that a fit does not need


def as_modes(receptance: Callable[[Array], Complex], omega: Array) -> ModalTip | None:
    """The sum of modes that a receptance (f, 2, 2) is at the samples ``omega`` (f,), or None where
    it is none, as one with noise or with a loss factor."""
    values = receptance(omega)
    flat = values.reshape(len(omega), -1)
    size = np.abs(flat).max(axis=1)
    weight = 1.0 / np.sqrt(np.maximum(size, 1e-12 * size.max()))[:, None]
    trace = values[:, 0, 0] + values[:, 1, 1]  # no mode is without a share of it
    start, near = rational_poles(omega, trace, NEAR)
    if near > EXACT:
        return None
    fit = vector_fit(omega, flat, weight, start)
    if not _exact(fit, size):
        return None
    peak = np.abs(fit.residue).max(axis=1) / np.abs(fit.pole.real)
    kept = peak > SPURIOUS * size.max()
    least = residues(omega, flat, fit.pole[kept], weight)
    if not _exact(least, size):
        return None
    shape = (-1, *values.shape[1:])
    return of_residues(least.pole, least.residue.reshape(shape), least.constant.reshape(shape[1:]))


def _exact(fit: Fit, size: Array) -> bool:
    return bool(np.abs(fit.error).max() <= EXACT * size.max())
