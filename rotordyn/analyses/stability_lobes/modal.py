"""The tip of a tool as a sum of modes."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
RANK = 1e-10  # of a residue: a second motion smaller than that is rounding
ABOUT = np.array([-4.0, -2.0, -1.2, -0.7, -0.35, 0.0, 0.35, 0.7, 1.2, 2.0, 4.0])


class Change(NamedTuple):
    """All stiffness and all damping ratios, times what the model has."""

    stiffness: float
    damping: float

    @property
    def highest(self) -> float:
        """By which frequencies rise."""
        return math.sqrt(self.stiffness)

    def poles(self, pole: Complex) -> tuple[Complex, Array]:
        """Poles, and by how much residues are larger: modal masses stay."""
        size = np.abs(pole)
        ratio = np.where(pole.imag > 0.0, self.damping, 1.0) * -pole.real / size
        ratio = np.where((pole.imag > 0.0) & (ratio >= 1.0), -pole.real / size, ratio)
        own = -ratio + 1j * np.sqrt(np.maximum(1.0 - ratio**2, 0.0))
        turning = np.where(pole.imag > 0.0, pole.imag, 1.0)
        larger = np.where(pole.imag > 0.0, turning / (size * np.maximum(own.imag, 1e-300)), 1.0)
        return self.highest * size * own, larger / self.highest


UNCHANGED = Change(1.0, 1.0)


@dataclass(frozen=True, eq=False)
class ModalTip:
    """Receptance Σ shape participation / (iω − pole), and the same of the conjugates, which are
    not listed: of a real pole half of it is. ``constant`` (2, 2) [m/N]: of all that lies far above.

    ``pole`` (m,) [rad/s], Re < 0 where the tip is stable; ``shape`` (m, 2) and ``participation``
    (m, 2) in feed and normal.
    """

    pole: Complex
    shape: Complex
    participation: Complex
    constant: Array = field(default_factory=lambda: np.zeros((2, 2)))

    def receptance(self, omega: Array) -> Complex:
        """At angular frequencies (…): (…, 2, 2) [m/N]."""
        residue = np.einsum("mi,mj->mij", self.shape, self.participation)
        at = 1j * omega[..., None]
        ahead = np.tensordot(1.0 / (at - self.pole), residue, axes=1)
        back = np.tensordot(1.0 / (at - self.pole.conj()), residue.conj(), axes=1)
        return np.asarray(ahead + back + self.constant)

    @property
    def frequencies(self) -> Array:
        """At which a peak of the receptance is seen [rad/s] (n,), ascending."""
        near = np.abs(self.pole.imag)[:, None] + np.abs(self.pole.real)[:, None] * ABOUT
        return np.unique(near[near > 0.0])

    def below(self, top: float) -> ModalTip:
        """Modes of |pole| below ``top``; of others what they come down to far below them."""
        near = np.abs(self.pole) < top
        far = ~near
        residue = np.einsum("mi,mj->mij", self.shape[far], self.participation[far])
        static = -2.0 * np.tensordot(1.0 / self.pole[far], residue, axes=1).real
        parts = self.pole[near], self.shape[near], self.participation[near]
        return ModalTip(*parts, self.constant + static)

    def changed(self, change: Change) -> ModalTip:
        """With stiffness or damping changed as a whole."""
        pole, larger = change.poles(self.pole)
        shape = self.shape * larger[:, None]
        return ModalTip(pole, shape, self.participation, self.constant / change.stiffness)


def of_residues(pole: Complex, residue: Complex, constant: Array) -> ModalTip:
    """The tip of residues (m, 2, 2), of up to two motions to a pole."""
    left, size, right = np.linalg.svd(residue)
    kept = size > RANK * size[:, :1]
    at, motion = np.nonzero(kept)
    shape = left[at, :, motion] * size[at, motion][:, None]
    return ModalTip(pole[at], shape, right[at, motion], constant)
