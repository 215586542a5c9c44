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
