"""Exact modal form of a receptance that is given as a function."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rotordyn.analyses.stability_lobes.modal import ModalTip, of_residues
from rotordyn.arrays import Array, Complex
from rotordyn.numerics.rational import rational_poles
from rotordyn.numerics.vector_fit import Fit, residues, vector_fit

EXACT = 1e-7  # of the largest receptance: largest error of a fit that counts as exact
NEAR = 1e-11  # of the largest receptance: tolerance of the rational function of first poles
SPURIOUS = 1e-7  # of the largest receptance: highest peak of a mode that a fit does not need


def as_modes(receptance: Callable[[Array], Complex], omega: Array) -> ModalTip | None:
    """Return the modes whose sum is a receptance (f, 2, 2) at samples ``omega`` (f,); None if it is
    no such sum, as with noise or a loss factor."""
    values = receptance(omega)
    flat = values.reshape(len(omega), -1)
    size = np.abs(flat).max(axis=1)
    weight = 1.0 / np.sqrt(np.maximum(size, 1e-12 * size.max()))[:, None]
    trace = values[:, 0, 0] + values[:, 1, 1]  # every mode contributes to it
    start, error = rational_poles(omega, trace, NEAR)
    if error > EXACT:
        return None
    fit = vector_fit(omega, flat, weight, start)
    if not _is_exact(fit, size):
        return None
    peak = np.abs(fit.residue).max(axis=1) / np.abs(fit.pole.real)
    kept = peak > SPURIOUS * size.max()
    final = residues(omega, flat, fit.pole[kept], weight)
    if not _is_exact(final, size):
        return None
    shape = (-1, *values.shape[1:])
    return of_residues(final.pole, final.residue.reshape(shape), final.constant.reshape(shape[1:]))


def _is_exact(fit: Fit, size: Array) -> bool:
    return bool(np.abs(fit.error).max() <= EXACT * size.max())
