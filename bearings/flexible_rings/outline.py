"""Outline of a ring's section: where its groove begins and ends, and checks of its sizes."""

from __future__ import annotations

import math
from typing import NamedTuple

from bearings.errors import InvalidBearing
from bearings.flexible_rings.describe import ElasticRing
from bearings.grooves import STEEP, Grooves

USUAL_SHOULDER = math.radians(60.0)  # least angle at which a groove of unknown shoulder ends
BEYOND = math.radians(20.0)  # ... and least angle from the free contact angle to that end
STEEPEST = math.radians(85.0)
EDGE = 0.96  # largest share of the half width up to which the groove reaches
PATCH = 0.1  # half the length of the line that a ball loads, over the ball diameter
ROOM = 1.2  # shortest groove over that line


class Outline(NamedTuple):
    """One ring: ``radius`` f D of its grooves, radius ``centre`` of the circle of their centres,
    ``offset`` of each from the middle plane [m]; angles φ from the radial direction at which a
    groove begins, ``low``, and ends, ``top`` [rad]; ``outward`` ±1: sign of r into the material."""

    radius: float
    centre: float
    offset: float
    low: float
    top: float
    outward: float


def outline(grooves: Grooves, ring: ElasticRing, *, inner: bool) -> Outline:
    """Determine the outline of a ring of a bearing.

    Raises
    ------
    InvalidBearing : no ring left between groove and seat, a groove wider than the ring or ending
        before the balls, a backing on the wrong side of the seat, a thrust bearing
    """
    if grooves.free_angle > STEEP:
        raise InvalidBearing(
            "flexible rings need seats on a shaft and in a housing; the rings of a bearing with a "
            f"free contact angle of {math.degrees(grooves.free_angle):.3g}° rest on faces"
        )
    outward, which = (-1.0, 0) if inner else (1.0, 1)
    radius, centre = grooves.radii[which], grooves.centre_radii[which]
    offset = abs((grooves.inner_offsets, grooves.outer_offsets)[which][0])
    _check(ring, outward, centre + outward * math.sqrt(radius**2 - offset**2))
    low = math.asin(offset / radius)
    widest = math.asin(min(1.0, (EDGE * 0.5 * ring.width + offset) / radius))
    given = ring.shoulder_diameter
    if given is None:
        given = grooves.inner_shoulder if inner else grooves.outer_shoulder
    if given is None:
        top = min(max(USUAL_SHOULDER, grooves.free_angle + BEYOND), STEEPEST, widest)
        if top <= grooves.free_angle:
            raise InvalidBearing(
                f"a ring too narrow for its balls: a width of {ring.width * 1e3:.4g} mm ends the "
                f"groove at {math.degrees(top):.3g}°, before the free contact angle of "
                f"{math.degrees(grooves.free_angle):.3g}°"
            )
        return Outline(radius, centre, offset, low, top, outward)
    height = outward * (0.5 * given - centre) / radius
    top = min(STEEPEST, math.acos(min(max(height, 0.0), 1.0)))
    if top > widest:
        wide = 2e3 * (radius * math.sin(top) - offset)
        raise InvalidBearing(
            f"a groove wider than its ring: {wide:.4g} mm up to the shoulder of {given * 1e3:.5g} "
            f"mm in a width of {ring.width * 1e3:.4g} mm"
        )
    if top <= grooves.free_angle:
        raise InvalidBearing(
            f"a shoulder of {given * 1e3:.5g} mm ends the groove at {math.degrees(top):.3g}°, "
            f"before the free contact angle of {math.degrees(grooves.free_angle):.3g}°"
        )
    length = radius * (top - low if offset else 2.0 * top)
    if length < ROOM * 2.0 * PATCH * grooves.ball_diameter:
        raise InvalidBearing(
            f"a shoulder of {given * 1e3:.5g} mm leaves a groove of {max(length, 0.0) * 1e3:.3g} "
            f"mm along its arc, too short for balls of {grooves.ball_diameter * 1e3:g} mm"
        )
    return Outline(radius, centre, offset, low, top, outward)


def _check(ring: ElasticRing, outward: float, bottom: float) -> None:
    """Raise InvalidBearing unless the groove lies within the ring, the backing beyond the seat."""
    name, side = ("bore", "below") if outward < 0.0 else ("outside", "above")
    if outward * (0.5 * ring.seat_diameter - bottom) <= 0.0:
        raise InvalidBearing(
            f"no ring is left beside the balls: seat_diameter {ring.seat_diameter * 1e3:.5g} mm "
            f"(the {name}) must lie {side} {2e3 * bottom:.5g} mm"
        )
    backing = ring.backing_diameter
    if outward * (backing - ring.seat_diameter) <= 0.0:
        raise InvalidBearing(
            f"backing_diameter {backing * 1e3:.5g} mm must lie {side} the seat's "
            f"{ring.seat_diameter * 1e3:.5g} mm"
        )
