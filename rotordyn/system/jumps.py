"""Joints of the shaft as jumps: the part behind moves rigidly against the part in front.

Every direction in which a joint gives way is one more freedom, the relative motion, on top of the
freedoms of a shaft without it: behind the joint the displacement is that of the shaft plus the
rigid motion R of the jump. That strains nothing but the spring of the joint.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.machine.joint import Joint
from rotordyn.machine.spindle import Spindle

Array = NDArray[np.float64]
BENDING = ("radial", "tilt")


@dataclass(frozen=True, slots=True)
class Jump:
    """One direction of a joint at station ``x`` [m]: stiffness and damping of the relative motion.

    ``tilt``: a rotation about the joint, else a displacement (or the one freedom of a rod).
    """

    x: float
    stiffness: float
    damping: float
    tilt: bool = False

    def motion(self, x: Array, width: int) -> Array:
        """Motion of the part behind at stations ``x``, node by node (width·stations,)."""
        if width == 1:
            return np.ones_like(x)
        rows = np.zeros((len(x), 2))
        rows[:, 0] = x - self.x if self.tilt else 1.0
        rows[:, 1] = 1.0 if self.tilt else 0.0
        return rows.ravel()


def jumps(spindle: Spindle, ways: tuple[str, ...]) -> tuple[Jump, ...]:
    """The directions among ``ways`` in which joints give way, from front to rear."""
    return tuple(
        Jump(joint.x, getattr(joint, way), getattr(joint, f"{way}_damping"), way == "tilt")
        for joint in sorted(spindle.joints, key=lambda joint: joint.x)
        for way in ways
        if math.isfinite(getattr(joint, way))
    )


def hinged(stiffness: Array, joint: Joint) -> Array:
    """Static stiffness (4, 4) of a bending element whose front end is fixed by ``joint``.

    The element's own front end, behind the joint, is condensed: exact where nothing acts on it.
    """
    free = [k for k, way in enumerate(BENDING) if math.isfinite(getattr(joint, way))]
    if not free:
        return stiffness
    springs = np.diag([getattr(joint, BENDING[k]) for k in free])
    own = stiffness[np.ix_(free, free)] + springs
    return np.asarray(stiffness - stiffness[:, free] @ np.linalg.solve(own, stiffness[free]))
