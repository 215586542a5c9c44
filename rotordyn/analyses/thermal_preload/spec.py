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
        "differences added to the temperatures of shaft and inner rings, and to those of balls "
        "where given (else balls have the mean of both rings)",
    ]

    @property
    def heats(self) -> bool:
        return True

    def _faults(self) -> Faults:
        yield from ascending("differences", self.differences)

    def faults_on(self, setting: Setting) -> Faults:
        if setting.conditions.heat_flow is not None:
            yield (
                (),
                "adds to given temperatures, but these follow from conditions.heat_flow; allowed: "
                "without heat_flow",
            )
