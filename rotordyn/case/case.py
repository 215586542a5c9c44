"""A case: one machine, how it is modelled, which speeds, which questions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from bearings.angular_contact import AngularContactBallBearing
from rotordyn.analysis.specs import Conditions, Spec
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle


@dataclass(frozen=True, slots=True)
class Case:
    """Everything a run needs, in SI units.

    Exactly one of ``spindle`` and ``bearing`` is given. ``speeds`` [rad/s] ascend without repeats.
    ``analyses`` maps a name of the registry to its Spec; nothing else is computed. ``references``
    are shown beside the computed values. ``files``: every file read; ``digest``: their hash.
    ``variants``: other cases with the same speeds and questions, by name; where there are any, they
    are answered side by side, and the case itself is not.
    """

    name: str
    title: str
    speeds: tuple[float, ...]
    analyses: Mapping[str, Spec]
    conditions: Conditions = field(default_factory=Conditions)
    spindle: Spindle | None = None
    bearing: AngularContactBallBearing | None = None
    references: tuple[Reference, ...] = ()
    files: tuple[Path, ...] = ()
    digest: str = ""
    variants: Mapping[str, Case] = field(default_factory=dict)

    @property
    def known(self) -> tuple[Reference, ...]:
        """The references that were found under the conditions of this case."""
        return tuple(r for r in self.references if self._holds(r))

    def _holds(self, reference: Reference) -> bool:
        own = self.conditions
        return all(getattr(own, key) == word for key, word in reference.conditions.items())
