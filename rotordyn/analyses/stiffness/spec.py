"""What a case asks of the radial stiffness of a point (SI)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Annotated

from rotordyn.description import Description, doubled
from rotordyn.quantity import Choice, LightLoad, Name, Travel, Whole

VARIANTS = ("nonlinear", "full", "diagonal", "constant_preload")
MOST_STEPS = 1000


@dataclass(frozen=True, slots=True)
class StiffnessSpec(Description):
    """Quasi-static radial stiffness at ``point``: deflection under 0 … ``max_force`` [N].

    ``steps``: load steps; ``variants``: of ``VARIANTS``; ``second_stop``: other stop travels [m] by
    sleeve, computed as one more (nonlinear) variant when given.
    """

    point: Name
    max_force: LightLoad = 500.0
    steps: Annotated[int, Whole(1, MOST_STEPS)] = 10
    variants: tuple[Annotated[str, Choice(VARIANTS)], ...] = VARIANTS
    second_stop: Mapping[Name, Travel] = field(default_factory=dict)

    def _faults(self) -> Iterator[str]:
        if not self.variants and not self.second_stop:
            yield "no variants: at least one is needed"
        for name in doubled(self.variants):
            yield f"variants: repeated: given '{name}'"
