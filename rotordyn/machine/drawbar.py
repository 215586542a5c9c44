"""The bar in the bore of the shaft that pulls the tool into the nose."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

from rotordyn.description import Description, Faults, ascending
from rotordyn.quantity import Choice, Key, Pull, Station

EVERYWHERE = "everywhere"


@dataclass(frozen=True, slots=True)
class Drawbar(Description):
    """The bar in the bore: it pulls the shaft together between two stations.

    ``guides`` ascend; between them the bar runs straight, with ``"everywhere"`` it follows the
    shaft. Its mass is given with the masses of the shaft.
    """

    force: Annotated[Pull, "tension in the bar, which compresses the shaft between its ends"]
    start: Annotated[Station, Key("from"), "front station where it pulls the shaft"]
    end: Annotated[Station, Key("to"), "rear station where it pulls the shaft"]
    guides: Annotated[
        Annotated[str, Choice((EVERYWHERE,))] | tuple[Station, ...],
        "stations between its ends where it touches the bore; between these it is straight",
    ] = ()

    def _faults(self) -> Faults:
        if self.start >= self.end:
            yield ("to",), "no length left: given {given:from} to {given}; allowed: to above from"
            return
        if isinstance(self.guides, str):
            return
        yield from ascending("guides", self.guides)
        for index, x in enumerate(self.guides):
            if x <= self.start or x >= self.end:
                yield ("guides", index), "guide beyond the bar: given {given}; allowed: inside it"

    @property
    def contacts(self) -> tuple[float, ...]:
        """Stations at which the bar follows the shaft, with its ends; none if everywhere."""
        if isinstance(self.guides, str):
            return ()
        return (self.start, *self.guides, self.end)

    @property
    def stations(self) -> tuple[float, ...]:
        """All stations at which it acts on the shaft."""
        return self.contacts or (self.start, self.end)
