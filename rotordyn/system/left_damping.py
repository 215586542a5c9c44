"""The rotor's own damping, as far as its reduced coordinates do not know it.

Rayleigh's a M + b K and dampers of joints act between the coordinates and what these leave out. So
does modal damping Σ d (M φ)(M φ)ᵀ with d = 2ζω over all modes of the free rotor, of which those not
kept take part in the static answers: on these it is not the diagonal that is given to them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
KNOWN = 1e-6  # of a static answer: modes left out that have all but this of it are all of them


@dataclass(frozen=True, eq=False, slots=True)
class LeftDamping:
    """Beside m coordinates r vectors left out: ``coupling`` (r, m) and ``own`` (r,) damping;
    ``amiss`` (m, m): what that of the coordinates lacks. ``turning``, ``turning_amiss``: of
    coupling and lack what turns with the rotor, per unit of the spindle's speed."""

    coupling: Array
    own: Array
    amiss: Array
    turning: Array
    turning_amiss: Array

    def at_ratio(self, ratio: float) -> LeftDamping:
        """Of a rotor at ``ratio`` times the speed."""
        turning, amiss = ratio * self.turning, ratio * self.turning_amiss
        return replace(self, turning=turning, turning_amiss=amiss)

    def widened(self, more: int) -> LeftDamping:
        """Beside ``more`` further coordinates."""
        across, both = ((0, 0), (0, more)), ((0, more), (0, more))
        return LeftDamping(
            np.pad(self.coupling, across),
            self.own,
            np.pad(self.amiss, both),
            np.pad(self.turning, across),
            np.pad(self.turning_amiss, both),
        )


def side_by_side(parts: Sequence[LeftDamping]) -> LeftDamping:
    """Of rotors that nothing couples."""
    from scipy.linalg import block_diag

    return LeftDamping(
        block_diag(*(part.coupling for part in parts)),
        np.concatenate([part.own for part in parts]),
        block_diag(*(part.amiss for part in parts)),
        block_diag(*(part.turning for part in parts)),
        block_diag(*(part.turning_amiss for part in parts)),
    )


def modal_amiss(rest_mass: Array, rest: Array, given: Array) -> Array:
    """What the diagonal ``given`` (m,) lacks of the modal damping of static answers (m, m).

    ``rest_mass`` (r, m): the share of every mode not kept in the coordinates, of which the modes
    kept have none; ``rest`` (r,): damping of those modes.
    """
    share = (rest_mass**2).sum(axis=0)
    if not (share > 0.0).any() or (share[share > 0.5] < 1.0 - KNOWN).any():
        return np.zeros((len(given), len(given)))
    added = share > 0.5
    return np.where(
        np.outer(added, added), rest_mass.T @ (rest[:, None] * rest_mass) - np.diag(given), 0.0
    )
