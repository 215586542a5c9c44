"""What a case asks of the warming of bearings over time (SI; °C, J/K)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Faults
from rotordyn.quantity import Duration, HeatCapacity, Temperature
from rotordyn.scene.spec import Setting, Spec


@dataclass(frozen=True, slots=True)
class WarmUpSpec(Spec):
    """Temperatures and preload over time, the spindle turning at each speed from the start on.

    Heat and what it flows off through are those of `heat_flow` in the conditions; shaft, housing
    and oil keep their temperatures there.
    """

    duration: Annotated[Duration, "length of time that is computed"]
    inner: Annotated[
        HeatCapacity, "heat capacity of an inner ring with the part of the shaft that warms with it"
    ]
    outer: Annotated[
        HeatCapacity,
        "heat capacity of an outer ring with the part of the housing that warms with it",
    ]
    balls: Annotated[
        HeatCapacity | None,
        "heat capacity of all balls of a bearing; by default that of their mass, 460 J/(kg K) of "
        "steel, 700 of silicon nitride",
    ] = None
    start: Annotated[
        Temperature | None,
        "of balls and rings at the start; by default where shaft, housing and oil bring them "
        "without heat",
    ] = None

    def faults_on(self, setting: Setting) -> Faults:
        if setting.conditions.heat_flow is None:
            yield (), "needs to know how heat flows off: give heat_flow in the conditions"
        if setting.spindle.rubs:
            yield (
                (),
                "sleeves that dry friction holds depend on what happened before: leave their "
                "friction out",
            )
