"""Modal and Rayleigh damping of a rotor in coordinates of unit mass.

Modal damping is Σ 2ζω (M φ)(M φ)ᵀ over all modes φ of the free rotor at rest: on coordinates that
are modes it is diagonal, on static modes it is that of the modes they are made of. Ratios are given
in order of the flexible modes, the last one for all that follow; axial motion and torsion have the
last one. A share of both kinds rotates with the rotor (``Component.turning``).

Theory: docs/theory/damping.md.
"""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array
from rotordyn.machine.spindle import Spindle


def modal_damping(spindle: Spindle, values: Array, roots: Array, *, bending: bool) -> Array:
    """Return the damping (m, m) [1/s] of coordinates with stiffness ``values`` ω² (m,) and
    ``roots`` √(M⁻¹K)."""
    zeta = spindle.rotor_damping if bending else spindle.rotor_damping[-1:]
    ratios = np.zeros(len(values))
    if zeta:
        order = np.arange(len(values)) - int((values == 0.0).sum())
        ratios = np.where(order < 0, 0.0, np.array(zeta)[np.clip(order, 0, len(zeta) - 1)])
    rayleigh = spindle.rayleigh.mass + spindle.rayleigh.stiffness * values
    return np.asarray(2.0 * np.sqrt(ratios[:, None] * ratios) * roots + np.diag(rayleigh))
