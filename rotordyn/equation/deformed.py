"""Equilibrium of a bent shaft: the axial force N acts with the displacement as its lever.

The forces behind a section x have moments about its displaced centre, so that

    dMz/dx = −(Ty − N v'),   dMy/dx = Tz − N w',

Ty, Tz along the axes. Its shear forces are Ty − N v', Tz − N w'. v' is linear over an element.

Theory: docs/theory/statics.md.
"""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array
from rotordyn.equation.section_forces import SectionForces, behind

BENT = [1, 2, 4, 5]  # y, z, θy, θz of a node


def bent(moved: Array, apart: Array) -> Array:
    """Return the motion y, z, θy, θz of rear ends of elements from front ends (…, elements, 4)."""
    return np.asarray((moved[..., 1:, :] - moved[..., :-1, :] - apart)[..., BENT])


def on_deformed(
    forces: SectionForces, line: Array, axial: Array, bend: Array, pulled: Array, length: Array
) -> tuple[SectionForces, SectionForces, Array]:
    """Return from section ``forces`` of the straight shaft those of the bent one; the same with its
    shear forces in place of those along the axes; and the line loads that go with these.

    ``axial`` (states, elements) [N], tension positive; ``bend`` (states, elements, 4); ``pulled``
    (states, elements, 2): forces along y and z of a drawbar that runs straight beside the shaft;
    ``length`` (elements,) [m].
    """
    force, h = axial[..., None], length[:, None]
    shifted = force * bend[..., :2] + pulled * h
    couple = shifted * np.array([-1.0, 1.0])  # about z by y, about y by z
    later = behind(couple)
    front, rear, sheared = forces.front.copy(), forces.rear.copy(), []
    curvature = bend[..., [3, 2]] * np.array([1.0, -1.0]) / h
    slope, half = bend[..., :2] / h, 0.5 * h * curvature
    for section, moment, slope_there in (
        (front, later + couple, slope - half),
        (rear, later, slope + half),
    ):
        section[..., [5, 4]] += moment
        shear = section.copy()
        shear[..., 1:3] -= force * slope_there + pulled
        sheared.append(shear)
    loads = np.broadcast_to(line, (*axial.shape, 2, 3)).copy()
    loads[..., 1:] += (force * curvature)[..., None, :]
    return SectionForces(front, rear), SectionForces(*sheared), loads
