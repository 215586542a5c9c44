"""A link in the coordinates of a subsystem: its relative motions and its matrices there."""

from __future__ import annotations

from typing import Any, NamedTuple, TypeVar

import numpy as np

from rotordyn.arrays import Array, Complex, Indices, Matrix
from rotordyn.equation.term import Link, LinkMatrices

M = TypeVar("M", bound=Matrix)


def at_rows(values: M, rows: Indices) -> M:
    """Return values (s or 1, …) at the speeds ``rows``; one serves all."""
    chosen: Any = values if len(values) == 1 else values[rows]  # of the type of ``values``
    return chosen


class Connection(NamedTuple):
    """A link in the coordinates: motions (k, n), matrices (s or 1, k, k)."""

    link: Link
    motions: Array
    matrices: LinkMatrices

    def at(self, rows: Indices) -> Connection:
        """Return the connection at the speeds ``rows``."""
        return self._replace(matrices=LinkMatrices(*(at_rows(m, rows) for m in self.matrices)))

    @property
    def rigid(self) -> Array:
        """1 for rigid motions, else 0 (k,)."""
        flags = np.zeros(len(self.motions))
        flags[list(self.link.rigid)] = 1.0
        return flags

    @property
    def stiffness(self) -> Array:
        """Stiffness in the coordinates (s or 1, n, n)."""
        return np.asarray(self.motions.T @ (self.matrices.stiffness @ self.motions))

    @property
    def damping(self) -> Array:
        """Damping in the coordinates (s or 1, n, n)."""
        return np.asarray(self.motions.T @ (self.matrices.damping @ self.motions))

    @property
    def damped(self) -> bool:
        """True if some motion of the coordinates is damped."""
        moving = self.motions.any(axis=1)
        return bool(self.matrices.damping[:, moving][:, :, moving].any())

    def strained(self, least: float) -> Array:
        """Return the rows of ``motions`` with a stiffness of ``least`` or more in the coordinates,
        the largest first (k, n)."""
        diagonal = np.abs(np.diagonal(self.matrices.stiffness, axis1=1, axis2=2)).max(axis=0)
        size = diagonal * (self.motions**2).sum(axis=1)
        chosen = np.flatnonzero(size >= least)
        return self.motions[chosen[np.argsort(-size[chosen], kind="stable")]]

    def force(self, omega: Array, moved: Complex) -> Complex:
        """Return the force of the link's springs and dampers along its motions (s, k), by
        coordinates ``moved`` (s, n) that oscillate at ``omega`` (s,) [rad/s]."""
        lossy = 1.0 + 1j * self.link.loss_factor * np.sign(omega)[:, None, None]
        dynamic = (
            self.matrices.stiffness * lossy + 1j * omega[:, None, None] * self.matrices.damping
        )
        return -np.einsum("sij,sj->si", dynamic, moved @ self.motions.T)
