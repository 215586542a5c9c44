"""Contact ellipses of a solved state against the ends of their grooves.

Angles are measured in the section of the ring about the centre of the groove, from the radial
direction. The major axis, of half-length a, lies along the groove of radius f D and so takes the
angle a/(f D) either side of the contact angle (Lacroix 2014, section 2.4).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bearings.arguments import checked
from bearings.arrays import Array, Flags
from bearings.geometry import Geometry, geometry
from bearings.ring.state import BearingState


@dataclass(frozen=True, eq=False)
class Truncation:
    """Contact ellipses on their grooves, in the order of the bearing's ``contact_names``.

    By contact (…, balls, contacts): half-axes ``major`` along the groove and ``minor`` [m], 0
    without load; ``lower_end`` and ``upper_end`` of the major axis [rad], NaN without load: a
    contact angle less and plus a/(f D), counted towards the shoulder that the contact is closer to;
    ``beyond_shoulder`` and ``beyond_middle``: shares of the length of the major axis that lie past
    the shoulder, and past the line where the two arcs of a groove meet.

    By contact alone (contacts,): ``shoulder_angle`` [rad], NaN where the shoulder diameter is not
    known; ``middle_angle`` [rad] where the arcs meet, NaN in a groove of one arc.
    """

    major: Array
    minor: Array
    lower_end: Array
    upper_end: Array
    beyond_shoulder: Array
    beyond_middle: Array
    shoulder_angle: Array
    middle_angle: Array

    @property
    def shoulder_margin(self) -> Array:
        """Angle from the upper end to the shoulder (…, balls, contacts) [rad]; negative past it."""
        return self.shoulder_angle - self.upper_end

    @property
    def middle_margin(self) -> Array:
        """Angle from the groove's middle to the lower end (…, balls, contacts) [rad]; negative past
        the middle."""
        return self.lower_end - self.middle_angle

    @property
    def across_middle(self) -> Flags:
        """Contacts whose centre is beyond the middle of their groove (…, balls, contacts)."""
        with np.errstate(invalid="ignore"):
            return np.asarray(0.5 * (self.lower_end + self.upper_end) < self.middle_angle)

    @property
    def lost(self) -> Array:
        """Share of the length of the major axis outside its groove (…, balls, contacts)."""
        return np.minimum(self.beyond_shoulder + self.beyond_middle, 1.0)

    @property
    def lost_load(self) -> Array:
        """Share of the load of an uncut ellipse that would lie outside its groove (…, balls,
        contacts): s² (3 − 2 s) of Hertz' pressure beyond a share s of the length at either end."""
        ends = (self.beyond_shoulder, self.beyond_middle)
        return np.minimum(sum(s**2 * (3.0 - 2.0 * s) for s in ends), 1.0)


@checked
def truncation(state: BearingState) -> Truncation:
    """Compute the places of contact ellipses on their grooves, and the shares that grooves cut off.

    A groove of one arc has equal shoulders on both sides where the bearing takes thrust both ways;
    an ellipse may then pass either. An angular-contact ring has its shoulder on the loaded side.
    """
    grooves = state.operation.grooves
    g, load = geometry(grooves), np.nan_to_num(state.contact_load)
    major, minor = half_axes(g, load)
    radii, shoulder, middle = (
        g.by_contact(*of_rings)
        for of_rings in (grooves.radii, grooves.shoulder_angles, grooves.middle_angles)
    )
    symmetric = np.isnan(middle) & g.both_ways
    angle = np.where(symmetric, np.abs(state.contact_angle), state.contact_angle)
    lower, upper = angle - major / radii, angle + major / radii
    other_shoulder = np.where(symmetric, -shoulder, np.nan)
    unbounded = np.full_like(shoulder, np.nan)
    return Truncation(
        major=major,
        minor=minor,
        lower_end=lower,
        upper_end=upper,
        beyond_shoulder=share_outside(lower, upper, other_shoulder, shoulder),
        beyond_middle=share_outside(lower, upper, middle, unbounded),
        shoulder_angle=shoulder,
        middle_angle=middle,
    )


def half_axes(g: Geometry, load: Array) -> tuple[Array, Array]:
    """Half-axes a and b under the ``load`` Q ≥ 0 of all contacts (…, contacts) [m]."""
    size = np.cbrt(load)
    return (
        g.by_contact(g.inner.semi_axis_major, g.outer.semi_axis_major) * size,
        g.by_contact(g.inner.semi_axis_minor, g.outer.semi_axis_minor) * size,
    )


def share_outside(lower: Array, upper: Array, least: Array, most: Array) -> Array:
    """Share of the length lower … upper outside least … most; a NaN bound means no bound."""
    low = np.where(np.isnan(least), -np.inf, least)
    high = np.where(np.isnan(most), np.inf, most)
    beyond = np.maximum(upper - np.maximum(high, lower), 0.0)
    beyond += np.maximum(np.minimum(low, upper) - lower, 0.0)
    length = upper - lower
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(length > 0.0, np.minimum(beyond / length, 1.0), 0.0)
