"""One race against a ball: its one or two contacts, and the one contact they amount to.

The forces of the contacts add up to a resultant, whose direction and load stand for the race where
the motion of the ball asks for one contact a race (Fc, Mg, friction). With one contact that is
exact; with two it is a model, continuous as contacts come and go. Plain expressions of floats or
arrays, which compile as they stand.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from bearings.ball.constants import Groove
from bearings.ball.plane import Pair, Triple, direction, where


class Contact(NamedTuple):
    """Load of a contact and its slope by the distance of the centres."""

    load: Any
    slope: Any


class Race(NamedTuple):
    """A race as one contact along its resultant.

    ``sin``, ``cos`` of its angle; ``approach`` δ, ``load`` Q and ``slope`` dQ/dδ. ``middle`` [m]:
    axial place where the resultant acts. Derivatives by axial and radial motion of the groove
    against the ball, and by tilt of the ring: ``angle_by``, ``approach_by``, ``middle_by``.
    """

    sin: Any
    cos: Any
    approach: Any
    load: Any
    slope: Any
    middle: Any
    angle_by: Triple
    approach_by: Triple
    middle_by: Triple


def hertz(stiffness: float, approach: Any) -> Contact:
    """k δ^1.5 and its slope, δ ≥ 0."""
    root = np.sqrt(approach)
    return Contact(stiffness * approach * root, 1.5 * stiffness * root)


def race(grooves: tuple[Groove, ...], vector: Pair, tilt: Any, side: float) -> Race:
    """The contacts of one race together.

    ``vector``: from ball to the middle of the inner groove (``side`` +1), or from that of the outer
    groove to the ball (−1); ``tilt``: angle by which the ring turns at the ball.
    """
    if len(grooves) == 1:
        return _single(grooves[0], vector)
    return _joined(grooves, vector, tilt, side)


def _single(groove: Groove, vector: Pair) -> Race:
    sin, cos, length = direction(vector)
    approach = np.maximum(length - groove.reach, 0.0)
    contact = hertz(groove.stiffness, approach)
    part = 1.0 / length
    turn, along, none = (cos * part, -sin * part, 0.0), (sin, cos, 0.0), (0.0, 0.0, 0.0)
    return Race(sin, cos, approach, contact.load, contact.slope, 0.0, turn, along, none)


def _joined(grooves: tuple[Groove, ...], vector: Pair, tilt: Any, side: float) -> Race:
    one, two = place(grooves[0], vector, tilt, side), place(grooves[1], vector, tilt, side)
    k, x1, x2 = grooves[0].stiffness, grooves[0].offset, grooves[1].offset
    axial, radial = one.force[0] + two.force[0], one.force[1] + two.force[1]
    a11, a12, a22 = (
        one.slope[0] + two.slope[0],
        one.slope[1] + two.slope[1],
        (one.slope[2] + two.slope[2]),
    )
    t1, t2 = x1 * one.slope[1] + x2 * two.slope[1], x1 * one.slope[2] + x2 * two.slope[2]
    load = np.sqrt(axial * axial + radial * radial)
    bears, first = load > 0.0, one.gap >= two.gap
    part = 1.0 / where(bears, load, 1.0)
    near_sin, near_cos = where(first, one.sin, two.sin), where(first, one.cos, two.cos)
    near = 1.0 / where(first, one.length, two.length)
    sin, cos = where(bears, axial * part, near_sin), where(bears, radial * part, near_cos)
    approach = (load / k) ** (2.0 / 3.0)
    slope = 1.5 * k * np.sqrt(approach)
    soft = 1.0 / where(bears, slope, 1.0)
    angle_by = (
        where(bears, (cos * a11 - sin * a12) * part, near_cos * near),
        where(bears, (cos * a12 - sin * a22) * part, -near_sin * near),
        (cos * t1 - sin * t2) * part,
    )
    approach_by = (
        where(bears, (sin * a11 + cos * a12) * soft, near_sin),
        where(bears, (sin * a12 + cos * a22) * soft, near_cos),
        (sin * t1 + cos * t2) * soft,
    )
    couple = x1 * one.force[1] + x2 * two.force[1]
    lifted = where(radial != 0.0, radial, 1.0)
    middle = couple / lifted
    middle_by = (
        (x1 * one.slope[1] + x2 * two.slope[1] - middle * a12) / lifted,
        (x1 * one.slope[2] + x2 * two.slope[2] - middle * a22) / lifted,
        (x1 * x1 * one.slope[2] + x2 * x2 * two.slope[2] - middle * t2) / lifted,
    )
    return Race(sin, cos, approach, load, slope, middle, angle_by, approach_by, middle_by)


class Placed(NamedTuple):
    """A contact where it stands.

    Direction and length from groove centre to ball centre, ``gap`` beyond its reach, load, force
    and the symmetric slope of the force (11, 12, 22), and its potential ``energy``.
    """

    sin: Any
    cos: Any
    length: Any
    gap: Any
    load: Any
    force: Pair
    slope: Triple
    energy: Any


def place(groove: Groove, vector: Pair, tilt: Any, side: float) -> Placed:
    """One contact of a race, see ``race``."""
    sin, cos, length = direction(
        (vector[0] + side * groove.offset, vector[1] + tilt * groove.offset)
    )
    gap = length - groove.reach
    approach = np.maximum(gap, 0.0)
    load, along = hertz(groove.stiffness, approach)
    across = load / length
    more = along - across
    slope = (across + more * sin * sin, more * sin * cos, across + more * cos * cos)
    energy = 0.4 * load * approach
    return Placed(sin, cos, length, gap, load, (load * sin, load * cos), slope, energy)
