"""The bar in the bore of the shaft that pulls the tool into the nose."""

from __future__ import annotations

from dataclasses import dataclass

EVERYWHERE = "everywhere"


@dataclass(frozen=True, slots=True)
class Drawbar:
    """A bar under the tension ``force`` [N] from station ``start`` to station ``end`` [m].

    It pulls the shaft together between these stations. ``guides``: stations between them at which
    it touches the bore, ascending, or ``"everywhere"``; in between it runs straight. Its mass is
    given with the masses of the shaft.
    """

    force: float
    start: float
    end: float
    guides: tuple[float, ...] | str = ()

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
