"""A rotor's own damping, modal and Rayleigh's, of coordinates on which mass and stiffness are
diagonal.

Modal ratios are those of the flexible modes of the free rotor at rest, in order, the last one for
all that follow; axial motion and torsion have the last one. A share of it turns with the rotor.
"""

from __future__ import annotations

import numpy as np

from rotordyn.machine.spindle import Spindle
from rotordyn.model.term import Array


def modal_damping(spindle: Spindle, values: Array, *, bending: bool) -> Array:
    """2ζω + α + β ω² (m,) [1/s] of coordinates of unit mass and stiffness ``values`` ω² (m,)."""
    given = spindle.rotor_damping if bending else spindle.rotor_damping[-1:]
    ratios = np.zeros(len(values))
    if given:
        order = np.arange(len(values)) - int((values == 0.0).sum())
        ratios = np.where(order < 0, 0.0, np.array(given)[np.clip(order, 0, len(given) - 1)])
    rayleigh = spindle.rayleigh.mass + spindle.rayleigh.stiffness * values
    return np.asarray(2.0 * ratios * np.sqrt(values) + rayleigh)
