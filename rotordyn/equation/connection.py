"""A link in the coordinates of a subsystem: its relative motions and its matrices there."""

from __future__ import annotations

from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from rotordyn.equation.term import Array, Link, LinkMatrices, Matrices

Complex = NDArray[np.complex128]
M = TypeVar("M", bound=Matrices)
STIFF = 1e6  # of the softest mode: links so stiff take six of its digits


def at_rows(values: M, rows: NDArray[np.intp]) -> M:
    """Of values (s or 1, …) those of some speeds; one serves all."""
    chosen: Any = values if len(values) == 1 else values[rows]  # of the type of ``values``
    return chosen


class Connection(NamedTuple):
    """A link in the coordinates: motions (k, n), matrices (s or 1, k, k)."""

    link: Link
    motions: Array
    matrices: LinkMatrices

    def at(self, rows: NDArray[np.intp]) -> Connection:
        """At some of the speeds."""
        return self._replace(matrices=LinkMatrices(*(at_rows(m, rows) for m in self.matrices)))

    @property
    def rigid(self) -> Array:
        """1 of motions without give, else 0 (k,)."""
        flags = np.zeros(len(self.motions))
        flags[list(self.link.rigid)] = 1.0
        return flags

    @property
    def stiffness(self) -> Array:
        """By the coordinates (s or 1, n, n)."""
        return np.asarray(self.motions.T @ (self.matrices.stiffness @ self.motions))

    @property
    def damping(self) -> Array:
        """By the coordinates (s or 1, n, n)."""
        return np.asarray(self.motions.T @ (self.matrices.damping @ self.motions))

    def strained(self, softest: float) -> Array:
        """Rows of ``motions`` that by the coordinates are ``STIFF`` times as stiff as ``softest``
        [rad²/s²], or by damping alone decay as much faster, the stiffest first (k, n)."""
        weight = (self.motions**2).sum(axis=1)
        held, damped = (
            weight * np.abs(np.diagonal(part, axis1=1, axis2=2)).max(axis=0)
            for part in self.matrices
        )
        size = np.maximum(held / softest, damped / np.sqrt(softest))
        chosen = np.flatnonzero(size >= STIFF)
        return self.motions[chosen[np.argsort(-size[chosen], kind="stable")]]

    def force(self, omega: Array, moved: Complex) -> Complex:
        """Of the link's springs and dampers on what it holds (s, k), by coordinates ``moved``
        (s, n) that swing at ``omega`` (s,) [rad/s]."""
        lossy = 1.0 + 1j * self.link.loss_factor * np.sign(omega)[:, None, None]
        dynamic = (
            self.matrices.stiffness * lossy + 1j * omega[:, None, None] * self.matrices.damping
        )
        return -np.einsum("sij,sj->si", dynamic, moved @ self.motions.T)
