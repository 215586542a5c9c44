"""The bar in the bore of the shaft that pulls the tool into the nose."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated

from rotordyn.description import Description
from rotordyn.quantity import Choice, Pull, Station

EVERYWHERE = "everywhere"


@dataclass(frozen=True, slots=True)
class Drawbar(Description):
    """A bar under the tension ``force`` [N] from station ``start`` to station ``end`` [m].

    It pulls the shaft together between these stations. ``guides``: stations between them at which
    it touches the bore, ascending, or ``"everywhere"``; in between it runs straight. Its mass is
    given with the masses of the shaft.
    """

    force: Pull
    start: Station
    end: Station
    guides: tuple[Station, ...] | Annotated[str, Choice((EVERYWHERE,))] = ()

    def _faults(self) -> Iterator[str]:
        for before, here in pairwise(self.stations):
            if here <= before:
                yield (
                    "its start, guides and end must ascend: given "
                    f"{here:.6g} m after {before:.6g} m"
                )

    @property
    def contacts(self) -> tuple[float, ...]:
        """Stations at which the bar follows the shaft, ends included; none where it always does."""
        if isinstance(self.guides, str):
            return ()
        return (self.start, *self.guides, self.end)

    @property
    def stations(self) -> tuple[float, ...]:
        """All stations at which it acts on the shaft."""
        return self.contacts or (self.start, self.end)
