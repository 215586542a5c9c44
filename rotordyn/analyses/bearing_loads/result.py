"""Loads of every bearing and ball."""

from __future__ import annotations

from dataclasses import dataclass

from rotordyn.arrays import Array, Words
from rotordyn.results.declaration import Absence, coordinate, quantity

BEARING = ("speed", "bearing")
BALL = ("speed", "bearing", "ball")


FEWER = Absence("beyond the last ball of the bearing", last="ball")


@dataclass(frozen=True)
class BearingLoadsResult:
    """Loads on the inner rings and of every ball, angles from y towards z of the spindle.

    Balls beyond the number that a bearing has are NaN. ``loss_share``: share of the loads across
    the axis at which the first ball leaves its inner race; ``loss_azimuth``: where it is.
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    bearing: Words = coordinate("bearing", unit="", label="bearing")
    ball: Array = coordinate("ball", unit="", label="ball")
    outcome: Words = quantity("speed", unit="", label="outcome")
    axial_load: Array = quantity(*BEARING, unit="N", label="axial load")
    radial_load: Array = quantity(*BEARING, unit="N", label="radial load")
    load_angle: Array = quantity(*BEARING, unit="rad", label="direction of the radial load")
    moment: Array = quantity(*BEARING, unit="N·m", label="tilting moment")
    deflection: Array = quantity(*BEARING, unit="m", label="axial displacement")
    radial_displacement: Array = quantity(*BEARING, unit="m", label="radial displacement")
    tilt: Array = quantity(*BEARING, unit="rad", label="tilt")
    loaded_balls: Array = quantity(*BEARING, unit="", label="loaded balls")
    loss_share: Array = quantity(
        *BEARING,
        unit="",
        label="share of the loads at contact loss",
        absent=(
            Absence(
                "where no ball loses contact under the loads, and where contact loss is not "
                "computed",
                by=("speed", "bearing"),
            ),
        ),
    )
    loss_azimuth: Array = quantity(
        *BEARING,
        unit="rad",
        label="azimuth of contact loss",
        absent=(Absence("where no ball loses contact", beside="loss_share"),),
    )
    ball_azimuth: Array = quantity("bearing", "ball", unit="rad", label="azimuth", absent=(FEWER,))
    ball_inner_load: Array = quantity(*BALL, unit="N", label="inner load", absent=(FEWER,))
    ball_outer_load: Array = quantity(*BALL, unit="N", label="outer load", absent=(FEWER,))
    inner_ring_deflection: Array = quantity(
        *BALL, unit="m", label="deflection of the inner raceway, 0 of a rigid ring", absent=(FEWER,)
    )
    outer_ring_deflection: Array = quantity(
        *BALL, unit="m", label="deflection of the outer raceway, 0 of a rigid ring", absent=(FEWER,)
    )
    ball_inner_angle: Array = quantity(
        *BALL,
        unit="rad",
        label="inner angle",
        absent=(
            FEWER,
            Absence("of a ball without load", beside="ball_inner_load"),
        ),
    )
    ball_outer_angle: Array = quantity(
        *BALL,
        unit="rad",
        label="outer angle",
        absent=(
            FEWER,
            Absence("of a ball without load", beside="ball_outer_load"),
        ),
    )
