"""What a case asks of the response to unbalance (SI)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from rotordyn.description import Description, doubled
from rotordyn.quantity import PointName
from rotordyn.scene.loads import BalanceGrade, EccentricSpan, Unbalance


@dataclass(frozen=True, slots=True)
class UnbalanceSpec(Description):
    """Steady response to unbalance at every speed of the case.

    All of ``unbalances``, ``spans`` and ``grade`` act together; motion is given at ``points``.
    """

    points: tuple[PointName, ...]
    unbalances: tuple[Unbalance, ...] = ()
    spans: tuple[EccentricSpan, ...] = ()
    grade: BalanceGrade | None = None

    def _faults(self) -> Iterator[str]:
        if not self.points:
            yield "no points: at least one is needed"
        for name in doubled(self.points):
            yield f"points: repeated: given '{name}'"
        if not (self.unbalances or self.spans or self.grade):
            yield "no unbalance: give unbalances, spans or grade"

    @property
    def places(self) -> tuple[str | float, ...]:
        """Points and stations at which something acts or is asked for."""
        return (*self.points, *self.acting)

    @property
    def acting(self) -> tuple[str | float, ...]:
        """Points and stations at which unbalance acts; both ends of a span."""
        own = [each.at for each in self.unbalances]
        own += [at for span in self.spans for at in (span.start, span.to)]
        return (*own, *(self.grade.planes if self.grade else ()))
