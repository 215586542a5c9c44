"""Description of an analysis of the warm-up of bearings over time (SI; °C, J/K)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Faults
from rotordyn.quantity import CoolTemperature, Duration, HeatCapacity
from rotordyn.scene.spec import Setting, Spec


@dataclass(frozen=True, slots=True)
class WarmUpSpec(Spec):
    """Temperatures and preload over time, the spindle turning at each speed from the start on.

    Heat and its flow are those of `heat_flow` in the conditions; oil has its temperature there, and
    so have shaft and housing, or they approach it with time constants.
    """

    duration: Annotated[Duration, "simulated time"]
    inner: Annotated[
        HeatCapacity, "heat capacity of an inner ring with the part of the shaft that warms with it"
    ]
    outer: Annotated[
        HeatCapacity,
        "heat capacity of an outer ring with the part of the housing that warms with it",
    ]
    balls: Annotated[
        HeatCapacity | None,
        "heat capacity of all balls of a bearing; by default that of their mass, 460 J/(kg K) for "
        "steel, 700 for silicon nitride",
    ] = None
    start: Annotated[
        CoolTemperature | None,
        "temperature of balls and rings at the start; by default thermal balance with "
        "shaft, housing and oil without heat",
    ] = None
    shaft_time_constant: Annotated[
        Duration | None,
        "time constant of the shaft: within it 63 % of the change from `start` to its final "
        "temperature takes place, and its length follows; by default it has the final temperature "
        "from the start",
    ] = None
    housing_time_constant: Annotated[Duration | None, "time constant of the housing, likewise"] = (
        None
    )

    def faults_on(self, setting: Setting) -> Faults:
        if setting.conditions.heat_flow is None:
            yield (), "needs the heat flow: give heat_flow in the conditions"
        for key in ("shaft_time_constant", "housing_time_constant"):
            if getattr(self, key) is not None and self.start is None:
                yield (key,), "needs the temperature at the start: give start, too"
        if setting.spindle.rubs:
            yield (
                (),
                "the positions of sleeves with dry friction depend on their history: leave their "
                "friction out",
            )
