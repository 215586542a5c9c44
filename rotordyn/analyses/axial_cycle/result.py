"""A closed cycle of axial force."""

from __future__ import annotations

from dataclasses import dataclass

from rotordyn.arrays import Array, Words
from rotordyn.results.declaration import Absence, coordinate, quantity

BRANCHES = ("falling", "rising")
CYCLE = ("speed", "branch", "force")


NOT_HELD = Absence("without friction, and at a stop", by=("speed", "force"))


@dataclass(frozen=True)
class AxialCycleResult:
    """Positions, loads and axial stiffness while the force falls and rises again.

    ``stiffness``: of bearings and sleeves; the shaft and its joints are rigid along the axis.
    ``held_force``: where sleeves slide on the falling branch, half the rise of force at which one
    of them slides back, about ``held_mean``: under a smaller cyclic force they are rigid; NaN
    without friction, and at a stop.
    """

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    branch: Words = coordinate("branch", unit="", label="branch")
    force: Array = coordinate("force", unit="N", label="axial force")
    body: Words = coordinate("body", unit="", label="body")
    bearing: Words = coordinate("bearing", unit="", label="bearing")
    sleeve: Words = coordinate("sleeve", unit="", label="sleeve")
    outcome: Words = quantity("speed", unit="", label="outcome")
    position: Array = quantity(*CYCLE, "body", unit="m", label="axial shift from rest")
    axial_load: Array = quantity(*CYCLE, "bearing", unit="N", label="axial load")
    friction: Array = quantity(*CYCLE, "sleeve", unit="N", label="friction force")
    stop_force: Array = quantity(*CYCLE, "sleeve", unit="N", label="stop force")
    stiffness: Array = quantity(*CYCLE, unit="N/m", label="axial stiffness")
    held_force: Array = quantity(
        "speed", "force", unit="N", label="cyclic force without sliding", absent=(NOT_HELD,)
    )
    held_mean: Array = quantity(
        "speed",
        "force",
        unit="N",
        label="mean of the cyclic force without sliding",
        absent=(NOT_HELD,),
    )
    no_load_stiffness: Array = quantity(
        "speed",
        "branch",
        unit="N/m",
        label="axial stiffness at no load",
        absent=(Absence("where the cycle does not pass zero force"),),
    )
    loss: Array = quantity("speed", unit="J", label="energy lost per cycle")
