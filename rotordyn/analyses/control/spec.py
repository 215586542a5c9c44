"""Specification of race control in a single bearing (SI)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Faults
from rotordyn.quantity import Growth, LightLoad, Load, RadialShare
from rotordyn.scene.spec import Spec


@dataclass(frozen=True, slots=True)
class ControlSpec(Spec):
    """Which race controls the balls of a single bearing, over axial load [N]."""

    max_load: Annotated[Load, "highest axial load"]
    min_load: Annotated[LightLoad, "lowest axial load"] = 10.0
    radial: Annotated[RadialShare, "ratio of the radial to the axial load"] = 0.0
    static_growth: Annotated[Growth, "radial growth of the inner groove at rest"] = 0.0

    def _faults(self) -> Faults:
        if self.max_load <= self.min_load:
            yield ("max_load",), f"not above min_load, {self.min_load:g} N: given {{given}}"
