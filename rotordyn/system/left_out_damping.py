"""The rotor's own damping of what reduced coordinates leave out, and between the two."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class LeftOutDamping:
    """Beside m coordinates r vectors left out: ``coupling`` (r, m) and ``own`` (r,) damping;
    ``turning``: of the coupling what turns with the rotor, per unit of the spindle's speed."""

    coupling: Array
    own: Array
    turning: Array

    def at_ratio(self, ratio: float) -> LeftOutDamping:
        """Of a rotor at ``ratio`` times the speed."""
        return replace(self, turning=ratio * self.turning)

    def widened(self, more: int) -> LeftOutDamping:
        """Beside ``more`` further coordinates."""
        across = (0, 0), (0, more)
        return LeftOutDamping(np.pad(self.coupling, across), self.own, np.pad(self.turning, across))


def side_by_side(parts: Sequence[LeftOutDamping]) -> LeftOutDamping:
    """Of rotors that nothing couples."""
    from scipy.linalg import block_diag

    return LeftOutDamping(
        block_diag(*(part.coupling for part in parts)),
        np.concatenate([part.own for part in parts]),
        block_diag(*(part.turning for part in parts)),
    )
