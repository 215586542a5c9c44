"""The rotor's own damping, of its reduced coordinates and of what these leave out.

Rayleigh's a M + b K and dampers of joints act between the two. So does modal damping
Σ d (M φ)(M φ)ᵀ with d = 2ζω over all modes of the free rotor: static answers are damped as the
modes not kept of which they are made.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
KNOWN = 1e-6  # of a static answer: modes not kept that have all but this of it are all of them


@dataclass(frozen=True, eq=False, slots=True)
class LeftDamping:
    """Beside m coordinates r vectors left out: ``coupling`` (r, m) and ``own`` (r,) damping;
    ``turning``: of the coupling what turns with the rotor, per unit of the spindle's speed."""

    coupling: Array
    own: Array
    turning: Array

    def at_ratio(self, ratio: float) -> LeftDamping:
        """Of a rotor at ``ratio`` times the speed."""
        return replace(self, turning=ratio * self.turning)

    def widened(self, more: int) -> LeftDamping:
        """Beside ``more`` further coordinates."""
        across = (0, 0), (0, more)
        return LeftDamping(np.pad(self.coupling, across), self.own, np.pad(self.turning, across))


def side_by_side(parts: Sequence[LeftDamping]) -> LeftDamping:
    """Of rotors that nothing couples."""
    from scipy.linalg import block_diag

    return LeftDamping(
        block_diag(*(part.coupling for part in parts)),
        np.concatenate([part.own for part in parts]),
        block_diag(*(part.turning for part in parts)),
    )


def modal_damping(rest_mass: Array, rest: Array, given: Array) -> Array:
    """Of modes kept ``given`` (m,), of static answers that of the modes not kept (m, m).

    ``rest_mass`` (r, m): the share of every mode not kept in the coordinates, of which the modes
    kept have none; ``rest`` (r,): damping of those modes. Where they are not all known the answers
    have the damping ``given`` to them.
    """
    added = are_answers(rest_mass)
    known = ((rest_mass[:, added] ** 2).sum(axis=0) >= 1.0 - KNOWN).all()
    answers = rest_mass.T @ (rest[:, None] * rest_mass)
    return np.where(np.outer(added, added) & known, answers, np.diag(given))


def are_answers(rest_mass: Array) -> NDArray[np.bool_]:
    """Which coordinates (m,) are no modes, by the share ``rest_mass`` (r, m) of modes not kept."""
    return np.asarray((rest_mass**2).sum(axis=0) > 0.5)
