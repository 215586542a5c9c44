"""Specification of the preload over temperature difference (SI)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Faults, ascending
from rotordyn.quantity import Items, Sweep, TemperatureDifference
from rotordyn.scene.spec import Setting, Spec


@dataclass(frozen=True, slots=True)
class ThermalPreloadSpec(Spec):
    """Preload of every bearing with shaft, inner rings and balls warmer or cooler."""

    differences: Annotated[
        tuple[TemperatureDifference, ...],
        Sweep(),
        Items(2, 1000),
        "added to the temperatures of shaft, inner rings and, where given, balls (else the mean of "
        "both rings) in the conditions",
    ]

    def _faults(self) -> Faults:
        yield from ascending("differences", self.differences)

    def faults_on(self, setting: Setting) -> Faults:
        if setting.conditions.heat_flow is not None:
            yield (
                (),
                "adds to given temperatures, and these follow from conditions.heat_flow; allowed: "
                "without heat_flow",
            )
