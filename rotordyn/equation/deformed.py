"""Equilibrium of a bent shaft: the axial force N acts with the displacement as its lever.

The forces behind a section x turn about its displaced centre, so that

    dMz/dx = −(Ty − N v'),   dMy/dx = Tz − N w',

Ty, Tz along the axes. What shears the shaft is Ty − N v', Tz − N w'. v' is linear over
an element.

Theory: docs/theory/statics.md.
"""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array
from rotordyn.equation.section_forces import SectionForces, behind

BENT = [1, 2, 4, 5]  # y, z, θy, θz of a node


def bent(moved: Array, apart: Array) -> Array:
    """How far the rear end of every element moves beyond its front end in y, z, θy, θz
    (…, elements, 4)."""
    return np.asarray((moved[..., 1:, :] - moved[..., :-1, :] - apart)[..., BENT])


def on_deformed(
    forces: SectionForces, line: Array, axial: Array, bend: Array, pulled: Array, length: Array
) -> tuple[SectionForces, SectionForces, Array]:
    """Of section ``forces`` of the straight shaft: those of the bent one; the same with the forces
    that shear it in place of those along the axes; and the line loads that go with these.

    ``axial`` (states, elements) [N], tension positive; ``bend`` (states, elements, 4); ``pulled``
    (states, elements, 2): forces along y and z of a drawbar that runs straight beside the shaft;
    ``length`` (elements,) [m].
    """
    force, h = axial[..., None], length[:, None]
    turned = force * bend[..., :2] + pulled * h
    couple = turned * np.array([-1.0, 1.0])  # about z by y, about y by z
    later = behind(couple)
    front, rear, sheared = forces.front.copy(), forces.rear.copy(), []
    curvature = bend[..., [3, 2]] * np.array([1.0, -1.0]) / h
    slope, half = bend[..., :2] / h, 0.5 * h * curvature
    for each, moment, along in (
        (front, later + couple, slope - half),
        (rear, later, slope + half),
    ):
        each[..., [5, 4]] += moment
        own = each.copy()
        own[..., 1:3] -= force * along + pulled
        sheared.append(own)
    loads = np.broadcast_to(line, (*axial.shape, 2, 3)).copy()
    loads[..., 1:] += (force * curvature)[..., None, :]
    return SectionForces(front, rear), SectionForces(*sheared), loads
