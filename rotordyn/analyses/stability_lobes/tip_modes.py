"""Modes of the tip of the tool at many speeds, and their sums as receptances."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rotordyn.analyses.stability_lobes.modal import ModalTip
from rotordyn.arrays import Array, Complex, Indices

FAR = 3.0  # times the highest frequency: modes beyond are a power series in frequency
AT_ONCE = 30_000  # products of frequencies and modes: larger arrays leave the cache
TERMS = 12  # of that series, whose remainder is 3^−12 of a mode


@dataclass(frozen=True, eq=False)
class TipModes:
    """Modes at every speed: ``pole`` (s, k) [rad/s], NaN where a speed has fewer; ``shape`` and
    ``participation`` (s, k, 2) in feed and normal; ``constant`` (s, 2, 2) [m/N], None for 0; their
    sum is that of ``ModalTip``."""

    pole: Complex
    shape: Complex
    participation: Complex
    constant: Array | None = None

    def beside(self, workpiece: ModalTip) -> TipModes:
        """Return these modes and those of a ``workpiece``, the same at all speeds; no residual."""

        def joined(values: Complex, more: Complex) -> Complex:
            repeated = np.broadcast_to(more, (len(values), *more.shape))
            return np.concatenate([values, repeated], axis=1)

        return TipModes(
            joined(self.pole, workpiece.pole),
            joined(self.shape, workpiece.shape),
            joined(self.participation, workpiece.participation),
            self.constant,
        )

    def at(self, row: int) -> ModalTip:
        """Return the modes at one speed, given by its ``row``."""
        kept = np.isfinite(self.pole[row])
        parts = self.pole[row, kept], self.shape[row, kept], self.participation[row, kept]
        return ModalTip(*parts) if self.constant is None else ModalTip(*parts, self.constant[row])

    def of(self, rows: Indices, top: float, directions: int = 2) -> TipSums:
        """Return sums of modes at some of the speeds, for frequencies up to ``top`` [rad/s]; motion
        in feed and normal, or in the feed alone, by forces in both."""
        pole = self.pole[rows]
        exists = np.isfinite(pole)
        residue = self.shape[rows, :, :directions, None] * self.participation[rows][..., None, :]
        residue = np.where(exists[..., None, None], residue, 0.0).reshape(*pole.shape, -1)
        pole = np.where(exists, pole, -1.0)
        near = exists & (np.abs(pole) < FAR * top)
        order = np.argsort(~near, axis=1, kind="stable")[:, : int(near.sum(axis=1).max())]
        tail = np.empty((TERMS, len(rows), residue.shape[-1]))
        far = np.where((near | ~exists)[..., None], 0.0, residue)
        for power in range(TERMS):  # of 1/(s − p) = −Σ sⁿ/pⁿ⁺¹
            far = far / pole[..., None]
            sign = (1.0, 1.0, -1.0, -1.0)[power % 4]  # of iⁿ
            tail[power] = -2.0 * sign * far.sum(axis=1).real
        if self.constant is not None:
            tail[0] += self.constant[rows, :directions].reshape(len(rows), -1)
        near_residue = np.where(near[..., None], residue, 0.0)
        return TipSums(
            np.take_along_axis(pole, order, axis=1),
            np.take_along_axis(near_residue, order[..., None], axis=1),
            tail,
        )


@dataclass(frozen=True, eq=False)
class TipSums:
    """Receptances as sums: ``pole`` (s, k) near the band with ``residue`` (s, k, 2d); ``tail``:
    coefficients (n, s, 2d) of powers of ω of other modes, real for even, imaginary for odd ones."""

    pole: Complex
    residue: Complex
    tail: Array

    def receptance(self, omega: Array) -> Complex:
        """Return receptance (s, f, d, 2) [m/N] at the frequencies (s, f) of each speed."""
        width = max(1, AT_ONCE // (self.pole.shape[1] + 1))
        speeds = max(1, width // omega.shape[1])
        values = np.empty((*omega.shape, self.residue.shape[-1]), dtype=complex)
        for first in range(0, len(omega), speeds):
            rows = slice(first, first + speeds)
            for begin in range(0, omega.shape[1], width):
                part = rows, slice(begin, begin + width)
                values[part] = self._at_rows(rows, omega[part])
        return values.reshape(*omega.shape, -1, 2)

    def _at_rows(self, rows: slice, omega: Array) -> Complex:
        """Return the receptance at some of the speeds (s, f, 2d).

        A pair is (iω 2 Re R − 2 Re(R p̄)) / ((iω)² − 2 iω Re p + |p|²).
        """
        at, pole, residue = omega[..., None], self.pole[rows, None], self.residue[rows]
        size, decay = np.abs(pole) ** 2, pole.real
        real, imag = size - at**2, 2.0 * at * decay
        inverse = 1.0 / (real**2 + imag**2)
        slope, constant = 2.0 * residue.real, -2.0 * (residue * self.pole[rows].conj()[..., None])
        coefficients = np.concatenate([slope, constant.real], axis=-1)
        values = ((inverse * real) @ coefficients) + 1j * ((inverse * imag) @ coefficients)
        values = values[..., : slope.shape[-1]] * (1j * at) + values[..., slope.shape[-1] :]
        square = np.cumprod(np.where(np.arange(TERMS // 2) > 0, at**2, 1.0), axis=-1)
        even, odd = (np.moveaxis(self.tail[k::2, rows], 0, 1) for k in (0, 1))
        values.real += square @ even
        values.imag += (at * square) @ odd
        return np.asarray(values)
