"""Stresses of the hollow circular section at its outer fibre (Timoshenko, Strength of Materials).

The shear stress of Ty and Tz vanishes where that of bending is largest and is neglected.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array
from rotordyn.machine.cross_section import area, second_moment

ROUNDING = 1e-9  # of the bending stress: a smaller axial stress does not decide the sign


class Stress(NamedTuple):
    """``axial`` N/A (signed), ``bending`` M c/I ≥ 0, ``torsion`` Mt c/Ip (signed) [Pa]."""

    axial: Array
    bending: Array
    torsion: Array

    @property
    def normal(self) -> Array:
        """Largest normal stress at the outer fibre, by amount, with its sign [Pa]; in pure bending
        that of tension."""
        compressed = self.axial < -ROUNDING * self.bending
        return np.asarray(np.where(compressed, -1.0, 1.0) * (abs(self.axial) + self.bending))

    @property
    def von_mises(self) -> Array:
        """Equivalent stress √(σ² + 3 τ²) at the worst point of the outer fibre [Pa]."""
        return np.sqrt(self.normal**2 + 3.0 * self.torsion**2)


def outer_fibre(forces: Array, outer_diameter: Array, inner_diameter: Array) -> Stress:
    """Stresses under section forces (…, 6): N, Ty, Tz [N], Mt, My, Mz [N·m]; diameters [m]."""
    n, mt, my, mz = (forces[..., k] for k in (0, 3, 4, 5))
    moment, radius = second_moment(outer_diameter, inner_diameter), outer_diameter / 2.0
    return Stress(
        axial=n / area(outer_diameter, inner_diameter),
        bending=np.hypot(my, mz) * radius / moment,
        torsion=mt * radius / (2.0 * moment),
    )
