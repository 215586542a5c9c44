"""One race of a ball: its one or two contacts, and the single contact equivalent to them.

The forces of the contacts add up to a resultant, whose direction and load stand for the race where
the motion of the ball needs one contact a race (Fc, Mg, friction). With one contact that is
exact; with two it is a model, continuous as contacts open and close. Plain expressions of floats or
arrays, which compile as they are.

A groove may span ±90° and be straight beyond: its contact is the distance of the ball from a
convex set, which keeps the potential convex. A ball free of a race faces it at the angle of their
centres, the radial part at least a quarter of the gap: continuous where contact is lost, the same
unless the ball's centre is nearly level with that of the groove, within ±90° where it is beyond.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from bearings.ball.plane import Motion, Pair, Triple, direction, dot, some, where
from bearings.geometry import Geometry, Groove

NOWHERE = 1e-300  # m: least distance that is divided by
FACED = 0.25  # least radial part of the vector along which a free ball faces a groove, over its gap


class Contact(NamedTuple):
    """Load of a contact and its slope by the distance of the centres."""

    load: Any
    slope: Any


class Springs(NamedTuple):
    """Contacts as springs: potential, force and symmetric slope (11, 12, 22) by their vector.

    ``couple`` Σ x F_r about the middle of the ring; ``by_tilt``: slopes of the force and of the
    couple by the tilt of the ring.
    """

    energy: Any
    force: Pair
    slope: Triple
    couple: Any
    by_tilt: Triple


class Race(NamedTuple):
    """Race as one contact along its resultant.

    ``sin``, ``cos`` of its angle; ``approach`` δ, ``load`` Q and ``slope`` dQ/dδ. ``middle`` [m]:
    axial place where the resultant acts. ``angle_by``, ``approach_by``, ``middle_by``: derivatives
    by the motion of the groove against the ball.
    """

    sin: Any
    cos: Any
    approach: Any
    load: Any
    slope: Any
    middle: Any
    angle_by: Motion
    approach_by: Motion
    middle_by: Motion


def hertz(stiffness: float, approach: Any) -> Contact:
    """Load k δ^1.5 of a contact and its slope, δ ≥ 0."""
    root = np.sqrt(approach)
    return Contact(stiffness * approach * root, 1.5 * stiffness * root)


def against(centre: Motion, ball: Pair) -> Motion:
    """Vector from the ball to the middle of the inner groove, with the tilt if given."""
    if len(centre) == 2:
        return centre[0] - ball[0], centre[1] - ball[1]
    return centre[0] - ball[0], centre[1] - ball[1], centre[2]


def race(grooves: tuple[Groove, ...], vector: Motion, side: float) -> Race:
    """Combine the contacts of one race.

    ``vector``: from the ball to the middle of the inner groove (``side`` +1, with the tilt of the
    ring where there are two grooves), or from that of the outer groove to the ball (−1).
    """
    if len(grooves) == 1:
        return _single(grooves[0], vector_to(grooves[0], vector, side))
    return _resultant(grooves, vector, side)


def _single(groove: Groove, vector: Motion) -> Race:
    """Race of one groove: its contact itself."""
    sin, cos, approach, angle_by = facing(groove, vector)
    contact = hertz(groove.stiffness, approach)
    along = (sin, cos)
    return Race(sin, cos, approach, contact.load, contact.slope, 0.0, angle_by, along, (0.0, 0.0))


def facing(groove: Groove, vector: Motion) -> tuple[Any, Any, Any, Pair]:
    """sin and cos of the angle at which ball and groove face each other, their approach δ ≥ 0, and
    the derivatives of the angle by the vector."""
    axial, radial = vector[0], vector[1]
    if len(groove.walls) == 0:
        sin, cos, length = direction((axial, radial))
        part = 1.0 / length
        return sin, cos, np.maximum(length - groove.centre_distance, 0.0), (cos * part, -sin * part)
    curved = np.maximum(radial, 0.0)
    length = np.sqrt(axial * axial + curved * curved)
    approach = length - groove.centre_distance
    least = FACED * np.maximum(-approach, 0.0)
    approach = np.maximum(approach, 0.0)
    if some(radial < least):
        faced_radius = np.maximum(radial, least)
        sin, cos, distance = direction((axial, faced_radius))
        ratio = where(least > 0.0, -FACED, 0.0) / where(length > 0.0, length, 1.0)
        free = radial < least
        by_axial = where(free, ratio * axial, 0.0)
        by_radial = where(free, ratio * curved, 1.0)
        part = 1.0 / distance
        return sin, cos, approach, ((cos - sin * by_axial) * part, -sin * by_radial * part)
    part = 1.0 / length
    sin, cos = axial * part, radial * part
    return sin, cos, approach, (cos * part, -sin * part)


def faced(c: Geometry, centre: Motion, ball: Pair) -> tuple[Pair, Pair]:
    """Vectors along which a ball faces the middles of outer and inner groove, not normalised."""
    inner = against(centre, ball)
    if len(c.inner_grooves[0].walls) == 0:
        return ball, (inner[0], inner[1])
    return facing(c.outer_grooves[0], ball)[:2], facing(c.inner_grooves[0], inner)[:2]


def facing_radius(groove: Groove, radial: Any) -> Any:
    """Radial distance of the centres in the contact law: 0 beyond 90°, at a straight wall."""
    if len(groove.walls) == 0:
        return radial
    return np.maximum(radial, 0.0)


def _resultant(grooves: tuple[Groove, ...], vector: Motion, side: float) -> Race:
    """Race of two grooves: the resultant of their contacts, with derivatives."""
    contacts = springs(grooves, vector, side)
    (axial, radial), (a11, a12, a22), (t1, t2, tt) = (
        contacts.force,
        contacts.slope,
        contacts.by_tilt,
    )
    load = np.sqrt(axial * axial + radial * radial)
    bears, k = load > 0.0, grooves[0].stiffness
    part = 1.0 / where(bears, load, 1.0)
    near_sin, near_cos, near_by, offset = _nearer(grooves, vector, side)
    sin, cos = where(bears, axial * part, near_sin), where(bears, radial * part, near_cos)
    approach = (load / k) ** (2.0 / 3.0)
    slope = 1.5 * k * np.sqrt(approach)
    soft = 1.0 / where(bears, slope, 1.0)
    angle_by = (
        where(bears, (cos * a11 - sin * a12) * part, near_by[0]),
        where(bears, (cos * a12 - sin * a22) * part, near_by[1]),
        where(bears, (cos * t1 - sin * t2) * part, near_by[1] * offset),
    )
    approach_by = (
        where(bears, (sin * a11 + cos * a12) * soft, near_sin),
        where(bears, (sin * a12 + cos * a22) * soft, near_cos),
        (sin * t1 + cos * t2) * soft,
    )
    lifted = where(radial != 0.0, radial, 1.0)
    middle = where(radial != 0.0, contacts.couple / lifted, offset)
    middle_by = (
        (t1 - middle * a12) / lifted,
        (t2 - middle * a22) / lifted,
        (tt - middle * t2) / lifted,
    )
    return Race(sin, cos, approach, load, slope, middle, angle_by, approach_by, middle_by)


def by_groove(grooves: tuple[Groove, ...], vector: Motion, side: float) -> tuple[Race, ...]:
    """Return the race once per groove, with derivatives by the vector of that groove, which moves
    by ``side`` times a shift of the groove."""
    if len(grooves) == 1:
        return (race(grooves, vector, side),)
    resultant, races = _resultant(grooves, vector, side), []
    bears = resultant.load > 0.0
    part = where(bears, 1.0, 0.0) / where(bears, resultant.load, 1.0)
    soft = where(bears, 1.0, 0.0) / where(bears, resultant.slope, 1.0)
    radial = resultant.load * resultant.cos
    lifted = where(radial != 0.0, radial, 1.0)
    sin, cos = resultant.sin, resultant.cos
    turn, nearer = _nearer(grooves, vector, side)[2:]
    for groove in grooves:
        a, b, c = spring(groove, vector_to(groove, vector, side)).slope
        arm = (groove.offset - resultant.middle) / lifted
        free = nearer == groove.offset  # faced by a ball without load
        races.append(
            resultant._replace(
                angle_by=(
                    where(bears, (cos * a - sin * b) * part, where(free, turn[0], 0.0)),
                    where(bears, (cos * b - sin * c) * part, where(free, turn[1], 0.0)),
                ),
                approach_by=((sin * a + cos * b) * soft, (sin * b + cos * c) * soft),
                middle_by=(arm * b, arm * c),
            )
        )
    return tuple(races)


def _nearer(grooves: tuple[Groove, ...], vector: Motion, side: float) -> tuple[Any, Any, Pair, Any]:
    """sin, cos and derivatives of the angle to the groove whose centre is farther, and its offset.

    It is the nearer groove to a ball without load, and the one whose straight wall carries a ball.
    """
    v1, v2 = vector_to(grooves[0], vector, side), vector_to(grooves[1], vector, side)
    first = dot(v1, v1) >= dot(v2, v2)
    vector = (where(first, v1[0], v2[0]), where(first, v1[1], v2[1]))
    sin, cos, _, turn = facing(grooves[0], vector)
    return sin, cos, turn, where(first, grooves[0].offset, grooves[1].offset)


def springs(grooves: tuple[Groove, ...], vector: Motion, side: float) -> Springs:
    """Sum the contacts of a race as springs; arguments as for ``race``."""
    if len(grooves) == 1:
        return spring(grooves[0], vector_to(grooves[0], vector, side))
    p = spring(grooves[0], vector_to(grooves[0], vector, side))
    q = spring(grooves[1], vector_to(grooves[1], vector, side))
    x, y = grooves[0].offset, grooves[1].offset
    return Springs(
        p.energy + q.energy,
        (p.force[0] + q.force[0], p.force[1] + q.force[1]),
        (p.slope[0] + q.slope[0], p.slope[1] + q.slope[1], p.slope[2] + q.slope[2]),
        x * p.force[1] + y * q.force[1],
        (
            x * p.slope[1] + y * q.slope[1],
            x * p.slope[2] + y * q.slope[2],
            x * x * p.slope[2] + y * y * q.slope[2],
        ),
    )


def spring(groove: Groove, vector: Motion) -> Springs:
    """One contact along its vector as a spring, without lever to the middle of the ring."""
    radial = facing_radius(groove, vector[1])
    length = np.sqrt(vector[0] * vector[0] + radial * radial)
    length = np.maximum(length, NOWHERE)
    part = 1.0 / length
    sin, cos = vector[0] * part, radial * part
    approach = np.maximum(length - groove.centre_distance, 0.0)
    load, along = hertz(groove.stiffness, approach)
    across = load * part
    difference = along - across
    radially = across + difference * cos * cos
    if len(groove.walls) > 0:
        radially = where(vector[1] > 0.0, radially, 0.0)
    slope = (across + difference * sin * sin, difference * sin * cos, radially)
    return Springs(0.4 * load * approach, (load * sin, load * cos), slope, 0.0, (0.0, 0.0, 0.0))


def vector_to(groove: Groove, vector: Motion, side: float) -> Pair:
    """Vector from the ball to the centre of an inner groove, or from an outer one to the ball."""
    axial, radial = (
        vector[0] + side * (groove.offset + groove.along),
        vector[1] + side * groove.rise,
    )
    if len(vector) == 2:
        return axial, radial
    return axial, radial + vector[2] * groove.offset
