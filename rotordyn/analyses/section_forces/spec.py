"""What a case asks of the shaft at rest under static loads (SI)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description, doubled
from rotordyn.quantity import Choice
from rotordyn.scene.loads import LineLoad, PointLoad, TwistLimit, Unbalance

WEIGHT = ("none", "+x", "-x", "+y", "-y", "+z", "-z")


@dataclass(frozen=True, slots=True)
class SectionForcesSpec(Description):
    """Section forces, deflection and stress of the shaft at rest under static loads.

    ``gravity``: of ``WEIGHT``, the way the weight of the rotor points. Loads add to what the
    preload state puts on the shaft along its axis.
    """

    loads: tuple[PointLoad, ...] = ()
    line_loads: tuple[LineLoad, ...] = ()
    unbalances: tuple[Unbalance, ...] = ()
    gravity: Annotated[str, Choice(WEIGHT)] = "none"
    twist_limits: tuple[TwistLimit, ...] = ()

    def _faults(self) -> Iterator[str]:
        for name in doubled(each.called for each in self.twist_limits):
            yield f"twist_limits: repeated: given '{name}'"

    @property
    def places(self) -> tuple[str | float, ...]:
        """Points and stations at which something acts or is asked for."""
        own = [load.at for load in self.loads] + [load.at for load in self.unbalances]
        own += [at for span in self.line_loads for at in (span.start, span.to)]
        own += [at for span in self.twist_limits for at in (span.start, span.to)]
        return tuple(own)
