"""Radial stiffness by bearing model."""

from __future__ import annotations

from dataclasses import dataclass

from rotordyn.results.declaration import Absence, coordinate, quantity
from rotordyn.results.kinds import Array, Words


@dataclass(frozen=True)
class StiffnessResult:
    """Deflection of a point under a radial force, for each way of modelling the bearings."""

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    variant: Words = coordinate("variant", unit="", label="bearing model")
    force: Array = coordinate("force", unit="N", label="radial force")
    bearing: Words = coordinate("bearing", unit="", label="bearing")
    outcome: Words = quantity("speed", unit="", label="outcome")
    deflection: Array = quantity("speed", "variant", "force", unit="m", label="deflection")
    tangent: Array = quantity("speed", "variant", unit="N/m", label="tangent stiffness at no load")
    secant: Array = quantity("speed", "variant", unit="N/m", label="secant stiffness at full load")
    unloading_force: Array = quantity(
        "speed",
        "bearing",
        unit="N",
        label="radial force from which balls carry nothing",
        absent=(Absence("where no force of the range unloads a ball", by=("speed", "bearing")),),
    )
