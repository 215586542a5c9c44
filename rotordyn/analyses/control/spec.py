"""What a case asks of race control of a single bearing (SI)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from rotordyn.description import Description
from rotordyn.quantity import Growth, LightLoad, Load, RadialShare


@dataclass(frozen=True, slots=True)
class ControlSpec(Description):
    """Which race controls the balls of a single bearing, at every speed of the case.

    Axial loads from ``min_load`` to ``max_load`` [N]; ``radial``: radial over axial load.
    """

    max_load: Load
    min_load: LightLoad = 10.0
    radial: RadialShare = 0.0
    static_growth: Growth = 0.0

    def _faults(self) -> Iterator[str]:
        if self.max_load <= self.min_load:
            yield (
                f"max_load: not above min_load: given {self.max_load:.6g} N after "
                f"{self.min_load:.6g} N"
            )
