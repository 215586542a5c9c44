"""Bearings and supports at single frequencies."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Values = NDArray[np.inexact[Any]]


@dataclass(frozen=True, eq=False, slots=True)
class Supported:
    """Bearings, then supports, at one speed: matrices ``held`` and ``damped`` (c, k, k) between
    their ends, k = 2 in circular coordinates (complex), 4 in both planes; ``losses`` (c,)."""

    held: Values
    damped: Values
    losses: Array

    @property
    def whirling(self) -> bool:
        """True where they answer alike in all directions."""
        return self.held.shape[-1] == 2

    def added(self, matrix: Values, rows: Array, omega: Array) -> Values:
        """``matrix`` (n, n, f) with them, of coordinates that move their ends by ``rows``
        (c, k, n)."""
        gathered = [
            np.einsum("cin,cij,cjm->nm", rows, own, rows, optimize=True)
            for own in (self.held, self.damped, self._lossy)
        ]
        where = np.nonzero(sum(np.abs(own) for own in gathered))
        held, damped, lossy = (own[where][:, None] for own in gathered)
        values = _at(held, damped, lossy, omega)
        total = matrix.astype(np.result_type(matrix, values), copy=False)
        total[where] += values
        return total

    def at(self, omega: Array) -> Values:
        """At ``omega`` (f,): (c, k, k, f); real where nothing damps or couples the planes."""
        held, damped, lossy = (m[..., None] for m in (self.held, self.damped, self._lossy))
        return _at(held, damped, lossy, omega)

    def chosen(self, which: Sequence[int]) -> Supported:
        """Some of them."""
        own = list(which)
        return Supported(self.held[own], self.damped[own], self.losses[own])

    @property
    def _lossy(self) -> Values:
        return self.losses[:, None, None] * self.held


def _at(held: Values, damped: Values, lossy: Values, omega: Array) -> Values:
    total = held if held.imag.any() else held.real
    if damped.any():
        total = total + 1j * omega * damped
    if lossy.any():
        total = total + 1j * np.sign(omega) * lossy
    return np.asarray(total)
