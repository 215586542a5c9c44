"""Tip of a tool on a measured spindle as a sum of modes, the same at every cutter speed."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rotordyn.analyses.on_measured import OnMeasured
from rotordyn.analyses.stability_lobes.modal import (
    RIGID,
    ModalTip,
    feed_and_normal,
    frequencies_near,
    of_residues,
)
from rotordyn.analyses.stability_lobes.tip_modes import TipModes
from rotordyn.arrays import Array, Complex
from rotordyn.errors import InvalidInput
from rotordyn.numerics.rational import rational_poles
from rotordyn.numerics.vector_fit import Fit, vector_fit

SAMPLES = 2000  # evenly over the band; further ones resolve the peaks of its poles
NEAR = 1e-4  # of the largest receptance: tolerance of the rational function of first poles
FURTHER, DAMPED = 20, 0.1  # modes added where the error is largest, and their damping ratio
WITHIN = 1e-2  # of the largest receptance: tolerance of the sum of modes, and of negative damping
BEYOND = 1.2  # times the band, within which no mode may drive the tip
REACH = 1.5  # times the highest mode of the workpiece
STILL = 0.5  # of the largest receptance: a band that ends above it ends within a peak


@dataclass(frozen=True)
class MeasuredTip:
    """Tip of the tool on ``machine``, measured at rest; ``feed`` [rad] from z in the sense of
    rotation; modes of the ``workpiece``.

    Modes above the band of the measurement act by their static residual.
    """

    machine: OnMeasured
    feed: float
    workpiece: ModalTip = RIGID

    @cached_property
    def omega(self) -> Array:
        """Samples of the band [rad/s]."""
        return np.linspace(self.machine.omega[0], self.machine.omega[-1], SAMPLES)

    @cached_property
    def _fit(self) -> Fit:
        """Modes of the tip in y and z.

        Raises
        ------
        InvalidInput : a band that ends within a peak; a tip that is no sum of modes in it
        """
        omega = self.omega
        values = self._receptance(omega)
        size = np.abs(values).max(axis=1)
        if size[-1] > STILL * size.max():
            hertz = omega[-1] / 2.0 / math.pi
            raise InvalidInput(
                f"stability_lobes: the measured receptances end at {hertz:.5g} Hz, where the tip "
                f"has {size[-1] / size.max():.0%} of its largest response: measure beyond the peak"
            )
        pole = rational_poles(omega, values.sum(axis=1), NEAR).pole
        checked = np.linspace(0.0, BEYOND * omega[-1], SAMPLES)[1:]
        fit: Fit | None = None
        for _ in range(FURTHER):
            peaks = frequencies_near(pole)  # peaks may lie between the samples
            omega = np.union1d(omega, peaks[(peaks > omega[0]) & (peaks < omega[-1])])
            values = self._receptance(omega)
            size = np.abs(values).max(axis=1)
            if fit is not None:
                gain = fit(np.union1d(checked, peaks[peaks < checked[-1]])).imag.max()
                error = np.abs(values - fit(omega)).max(axis=1)
                if max(error.max(), gain) <= WITHIN * size.max():
                    return fit
                pole = np.append(pole, (1j - DAMPED) * omega[error.argmax()])
            fit = vector_fit(omega, values, 1.0 / size[:, None], pole)
            pole = fit.pole
        raise InvalidInput(
            "stability_lobes: the tip on the measured spindle is not a sum of damped modes within "
            f"{WITHIN:.0%}: give fewer modes of the measurement, or less loss_factor"
        )

    def _receptance(self, omega: Array) -> Complex:
        """Return receptance of the tip in y and z (f, 2); one measured plane stands for both."""
        by_plane = {plane: self.machine.tip(plane, omega) for plane in self.machine.fits}
        first = next(iter(by_plane.values()))
        return np.stack([by_plane.get(plane, first) for plane in "yz"], axis=1)

    @cached_property
    def modes(self) -> TipModes:
        """Modes of the receptance in feed and normal."""
        fit, rotation = self._fit, feed_and_normal(self.feed)
        residue = np.einsum("ik,mk,jk->mij", rotation, fit.residue, rotation)
        constant = np.einsum("ik,k,jk->ij", rotation, fit.constant, rotation)
        tip = of_residues(fit.pole, residue, constant)
        own = TipModes(tip.pole[None], tip.shape[None], tip.participation[None], tip.constant[None])
        return own.beside(self.workpiece)

    @cached_property
    def poles(self) -> Complex:
        """Poles of the modes in the band, and of the workpiece (1, k) [rad/s]."""
        pole = self._fit.pole
        in_band = pole[(pole.imag > self.omega[0]) & (pole.imag < self.omega[-1])]
        return np.concatenate([in_band, self.workpiece.pole])[None]

    @property
    def growing(self) -> Complex:
        """Zero (1,): no motion grows, since a fit with negative damping is refused."""
        return np.zeros(1, dtype=complex)

    @property
    def tops(self) -> Array:
        """Highest frequency of the measurement, or one beyond the modes of the workpiece (1,)
        [rad/s]."""
        workpiece = REACH * self.workpiece.pole.imag.max(initial=0.0)
        return np.maximum(self.omega[-1:], workpiece)

    def about_poles(self, row: int) -> Array:
        """Return frequencies that resolve the peaks, ascending [rad/s]."""
        near = frequencies_near(self.poles[row])
        return near[near <= self.tops[0]]
