"""A case: one machine, how it is modelled, which speeds, which questions."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields
from pathlib import Path

from bearings.bearing import BallBearing
from rotordyn.analyses.contract import Spec
from rotordyn.case.agreement import (
    housings_agree,
    questions_agree,
    references_agree,
    resolved_agree,
    speeds_agree,
    supports_agree,
)
from rotordyn.description import Description
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle
from rotordyn.quantity import Name, Speed
from rotordyn.scene.conditions import Conditions


@dataclass(frozen=True, slots=True)
class Case(Description):
    """Everything a run needs, in SI units.

    Exactly one of ``spindle`` and ``bearing`` is given. ``speeds`` [rad/s] ascend without repeats.
    ``analyses`` maps a name of the registry to its Spec; nothing else is computed. ``references``
    are shown beside the computed values. ``files``: every file read; ``digest``: their hash, with
    the changes that ``vary`` made to them. ``variants``: other cases with the same speeds and
    questions, by name; where there are any, they are answered side by side, and the case itself is
    not.
    """

    name: str
    title: str
    speeds: tuple[Speed, ...]
    analyses: Mapping[Name, Spec]
    conditions: Conditions = field(default_factory=Conditions)
    spindle: Spindle | None = None
    bearing: BallBearing | None = None
    references: tuple[Reference, ...] = ()
    files: tuple[Path, ...] = ()
    digest: str = ""
    variants: Mapping[Name, Case] = field(default_factory=dict)

    @property
    def known(self) -> tuple[Reference, ...]:
        """The references that were found under the conditions of this case."""
        return tuple(r for r in self.references if self._holds(r))

    def _holds(self, reference: Reference) -> bool:
        own = self.conditions
        return all(getattr(own, key) == word for key, word in reference.conditions.items())

    def vary(self, changes: Mapping[str, object]) -> Case:
        """This case with other values at dotted paths; see ``rotordyn.vary``."""
        from rotordyn.case.vary import vary

        return vary(self, changes)

    def _repr_html_(self) -> str:
        """What it asks of which machine, in a short table, which notebooks show."""
        from rotordyn.markup import table

        return table(self.title or self.name, self._rows())

    def _rows(self) -> Iterator[tuple[str, str]]:
        yield "case", self.name
        if self.spindle is not None:
            yield "spindle", self.spindle.title or self.spindle.name
        else:
            yield "bearing", type(self.bearing).__name__
        ends = dict.fromkeys((self.speeds[0], self.speeds[-1]))
        rpm = " to ".join(f"{speed * 30.0 / math.pi:.6g}" for speed in ends)
        yield "speeds", f"{rpm} rpm, {len(self.speeds)} in all"
        yield "conditions", ", ".join(_changed(self.conditions)) or "the defaults"
        yield "analyses", ", ".join(self.analyses)
        if self.variants:
            yield "variants", ", ".join(self.variants)

    def _faults(self) -> Iterator[str]:
        if (self.spindle is None) == (self.bearing is None):
            given = "neither" if self.spindle is None else "both"
            yield f"a case has either a spindle or a bearing: given {given}"
            return
        yield from speeds_agree(self.speeds, self.analyses)
        yield from questions_agree(self.spindle, self.conditions, self.analyses)
        if self.spindle is not None:
            yield from supports_agree(self.spindle, self.conditions, self.speeds)
            yield from resolved_agree(self.spindle, self.conditions, self.analyses, self.speeds)
            yield from housings_agree(self.spindle, self.conditions, self.analyses)
        yield from references_agree(self.references, self.conditions)
        for name, variant in self.variants.items():
            if variant.speeds != self.speeds or variant.analyses != self.analyses:
                yield f"variant {name}: its speeds and analyses must be those of the case"
            if variant.variants:
                yield f"variant {name}: a variant has no variants of its own"


def _changed(conditions: Conditions) -> Iterator[str]:
    """Conditions that are not the defaults."""
    usual = Conditions()
    for each in fields(conditions):
        value = getattr(conditions, each.name)
        if value != getattr(usual, each.name):
            yield f"{each.name}: {value}"
