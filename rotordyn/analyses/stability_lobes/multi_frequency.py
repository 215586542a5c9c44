"""Multi-frequency stability of milling at one speed, with a receptance of any form.

The forces F(t) = e^{iωt} Σ F_k e^{ikω_T t} over all harmonics of the tooth frequency are a periodic
function, expanded in polynomials over the spans of the cut. The result is that of infinitely many
harmonics of the form of Budak and Altintas (1998).

Theory: docs/theory/lobes.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rotordyn.analyses.stability_lobes.spans import Spans, both_signs
from rotordyn.arrays import Array, Complex

Receptance = Callable[[Array], Complex]
AT_ONCE = 1_000_000  # of (n, p, p or harmonics)


@dataclass(frozen=True)
class Harmonics:
    """All harmonics of the forces over ``spans`` on a tip with a ``receptance``."""

    spans: Spans
    receptance: Receptance

    def motion(self, angle: Array) -> Complex:
        """Return motion by force between polynomials (n, p, 2, p, 2) [m/N] at ``angle`` ωT (n,)."""
        at = angle[:, None] + 2.0 * math.pi * self.spans.order
        values = both_signs(self.receptance, at / self.spans.period)
        basis = self.spans.coefficients(at)
        n, p = len(angle), basis.shape[-1]
        result = np.empty((n, p, 2, p, 2), dtype=complex)
        left = np.swapaxes(basis, 1, 2).conj() / self.spans.halves[:, None]
        for i in range(2):
            for j in range(2):
                result[:, :, i, :, j] = (left * values[:, None, :, i, j]) @ basis
        return result

    def matrix(self, angle: Array) -> Complex:
        """Return −H times the motion less that of the previous cut (n, 2p, 2p): its eigenvalues z
        on the positive real axis are 1/a."""
        same, last = self.spans.delayed
        chip = self.spans.cutting - same - np.exp(-1j * angle)[:, None, None] * last
        return -(chip @ self.motion(angle).reshape(chip.shape))

    def eigenvalues(self, angle: Array) -> Complex:
        """Return eigenvalues (n, 2p), some angles at a time to limit memory."""
        size = self.spans.size * max(self.spans.size, len(self.spans.order))
        parts = np.array_split(angle, min(math.ceil(len(angle) * size / AT_ONCE), len(angle)))
        return np.concatenate([np.linalg.eigvals(self.matrix(part)) for part in parts]).astype(
            complex
        )

    def chatter(self, angle: float, value: float) -> float:
        """Return the frequency [Hz] of the largest motion in the mode of eigenvalue ``value``."""
        z, vectors = np.linalg.eig(self.matrix(np.array([angle]))[0])
        force = vectors[:, np.abs(z - value).argmin()]
        return self.spans.chatter(self.receptance, angle, force)
