"""Bearings and their materials."""

from __future__ import annotations

from bearings.kinds.angular_contact import AngularContactBallBearing
from bearings.materials import Material
from rotordyn.case.schema.bearing import BearingEntry
from rotordyn.case.schema.material import MaterialEntry


def material(entry: MaterialEntry | None) -> Material:
    """The material of an entry that is known to have one."""
    if entry is None:
        raise ValueError("a material was not read")
    return Material(entry.name, entry.young_modulus, entry.poisson_ratio, entry.density)


def bearing(entry: BearingEntry) -> AngularContactBallBearing:
    """The bearing; raises InvalidBearing where its geometry is impossible."""
    return AngularContactBallBearing(
        ball_diameter=entry.ball_diameter,
        pitch_diameter=entry.pitch_diameter,
        balls=entry.balls,
        contact_angle=entry.contact_angle,
        inner_conformity=entry.inner_conformity,
        outer_conformity=entry.outer_conformity,
        ball_material=material(entry.ball_material),
        ring_material=material(entry.ring_material),
    )
