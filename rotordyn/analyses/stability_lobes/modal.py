"""Tip of a tool as a sum of modes, in feed and normal."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from rotordyn.analyses.stability_lobes.workpiece_mode import WorkpieceMode
from rotordyn.arrays import Array, Complex

RANK = 1e-10  # of a residue: a smaller second singular value is rounding
# offsets from the frequency of a mode at which its peak is sampled, in its decay rate
BESIDE_PEAK = np.array([-4.0, -2.0, -1.2, -0.7, -0.35, 0.0, 0.35, 0.7, 1.2, 2.0, 4.0])


def frequencies_near(pole: Complex) -> Array:
    """Return frequencies [rad/s] that resolve the peaks of ``pole`` (m,), ascending."""
    near = np.abs(pole.imag)[:, None] + np.abs(pole.real)[:, None] * BESIDE_PEAK
    return np.unique(near[near > 0.0])


def feed_and_normal(feed: float) -> Array:
    """Return directions of feed and normal (2, 2) in y and z; ``feed`` [rad] from z towards −y."""
    s, c = math.sin(feed), math.cos(feed)
    return np.array([[-s, c], [c, s]])


class Change(NamedTuple):
    """Factors (s,) on all stiffness and on all damping ratios of the machine."""

    stiffness: Array
    damping: Array


@dataclass(frozen=True, eq=False)
class ModalTip:
    """Receptance Σ shape participation / (iω − pole) plus that of the conjugate poles.

    These are not listed; a real pole is its own conjugate, so that half of its residue is listed.

    ``constant`` (2, 2) [m/N]: static residual of the modes far above.

    ``pole`` (m,) [rad/s], Re < 0 where the tip is stable; ``shape`` (m, 2) and ``participation``
    (m, 2) in feed and normal.
    """

    pole: Complex
    shape: Complex
    participation: Complex
    constant: Array = field(default_factory=lambda: np.zeros((2, 2)))

    def receptance(self, omega: Array) -> Complex:
        """Return receptance (…, 2, 2) [m/N] at angular frequencies (…)."""
        residue = np.einsum("mi,mj->mij", self.shape, self.participation)
        at = 1j * omega[..., None]
        direct = np.tensordot(1.0 / (at - self.pole), residue, axes=1)
        conjugate = np.tensordot(1.0 / (at - self.pole.conj()), residue.conj(), axes=1)
        return np.asarray(direct + conjugate + self.constant)

    @property
    def frequencies(self) -> Array:
        """Frequencies [rad/s] (n,) that resolve the peaks of the receptance, ascending."""
        return frequencies_near(self.pole)

    def below(self, top: float) -> ModalTip:
        """Return the modes of |pole| below ``top`` [rad/s], and others as a static residual."""
        near = np.abs(self.pole) < top
        far = ~near
        residue = np.einsum("mi,mj->mij", self.shape[far], self.participation[far])
        static = -2.0 * np.tensordot(1.0 / self.pole[far], residue, axes=1).real
        parts = self.pole[near], self.shape[near], self.participation[near]
        return ModalTip(*parts, self.constant + static)


def of_workpiece(modes: Sequence[WorkpieceMode]) -> ModalTip:
    """Return the modes of a workpiece in feed and normal: its deflection adds to the motion of the
    tip relative to it, since cutting forces separate both."""
    natural, ratio, stiffness, angle = (
        np.array([getattr(mode, name) for mode in modes], dtype=float)
        for name in ("frequency", "damping", "stiffness", "direction")
    )
    natural = 2.0 * math.pi * natural
    damped = natural * np.sqrt(1.0 - ratio**2)
    way = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    residue = natural**2 / stiffness / (2j * damped)
    return ModalTip(-ratio * natural + 1j * damped, residue[:, None] * way, way.astype(complex))


RIGID = of_workpiece(())


def of_residues(pole: Complex, residue: Complex, constant: Array) -> ModalTip:
    """Return the tip with residues (m, 2, 2) at the poles (m,), of rank up to 2: a pole whose
    residue has rank 2 is listed twice."""
    left, size, right = np.linalg.svd(residue)
    kept = size > RANK * size[:, :1]
    at, motion = np.nonzero(kept)
    shape = left[at, :, motion] * size[at, motion][:, None]
    return ModalTip(pole[at], shape, right[at, motion], constant)
