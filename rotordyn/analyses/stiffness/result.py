"""Radial stiffness by bearing model."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rotordyn.arrays import Array, Words
from rotordyn.results.declaration import Absence, coordinate, quantity

ALONG = ("speed", "force", "bearing")
WITHOUT_FULL_MODEL = Absence("without the full bearing model")
SHORT_STOP = "short_stop"  # variant with the other travels of ``second_stop``
NONE = Absence("where no ball is unloaded", beside="unloading_force")


@dataclass(frozen=True)
class StiffnessResult:
    """Deflection of a point under a radial force, for each way of modelling the bearings.

    Loads of bearings (axial ones in their own frames, x loads the balls) and where balls lose their
    contact are those along the curve of the full bearing model; balls count from 1 and the
    azimuth from y towards z of the spindle; of two balls that are mirror images one is named.
    ``stop_speed``: on both sides of each speed at which a stop closes, where curves bend or jump.
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    variant: Words = coordinate("variant", unit="", label="bearing model")
    force: Array = coordinate("force", unit="N", label="radial force")
    bearing: Words = coordinate("bearing", unit="", label="bearing")
    stop_speed: Array = coordinate(
        "stop_speed", unit="rad/s", label="speed beside that at which a stop closes"
    )
    outcome: Words = quantity("speed", unit="", label="outcome")
    deflection: Array = quantity("speed", "variant", "force", unit="m", label="deflection")
    tangent: Array = quantity("speed", "variant", unit="N/m", label="tangent stiffness at no load")
    stop_tangent: Array = quantity(
        "stop_speed",
        "variant",
        unit="N/m",
        label="tangent stiffness where a stop closes",
        absent=(
            Absence(
                "of other stops, which close elsewhere, and without a stable state",
                by=("stop_speed", "variant"),
            ),
        ),
    )
    secant: Array = quantity("speed", "variant", unit="N/m", label="secant stiffness at full load")
    axial_load: Array = quantity(*ALONG, unit="N", label="axial load", absent=(WITHOUT_FULL_MODEL,))
    radial_load: Array = quantity(
        *ALONG, unit="N", label="radial load", absent=(WITHOUT_FULL_MODEL,)
    )
    ball_load: Array = quantity(
        *ALONG, unit="N", label="largest inner load of a ball", absent=(WITHOUT_FULL_MODEL,)
    )
    unloading_force: Array = quantity(
        "speed",
        "bearing",
        unit="N",
        label="radial force from which a ball carries no load",
        absent=(Absence("where no force of the range unloads a ball", by=("speed", "bearing")),),
    )
    unloaded_ball: Array = quantity(
        "speed", "bearing", unit="1", label="ball that is unloaded first", absent=(NONE,)
    )
    unloaded_azimuth: Array = quantity(
        "speed",
        "bearing",
        unit="rad",
        label="azimuth of the ball that is unloaded first",
        absent=(NONE,),
    )

    @property
    def curves(self) -> tuple[Array, Array]:
        """Tangents over all speeds (speeds + stop speeds,) and (…, variants), ascending; those of
        other stops are interpolated where a stop of the machine closes."""
        speed = np.concatenate([self.speed, self.stop_speed])
        between = [np.interp(self.stop_speed, self.speed, column) for column in self.tangent.T]
        other = np.array([name == SHORT_STOP for name in self.variant], dtype=bool)
        at_stops = np.where(other, np.transpose(between), self.stop_tangent)
        order = np.argsort(speed, kind="stable")
        return speed[order], np.concatenate([self.tangent, at_stops])[order]
