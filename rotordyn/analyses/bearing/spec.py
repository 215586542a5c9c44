"""What a case asks of a single bearing over load and speed (SI)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated

from bearings.ball.law import DYNAMICS
from rotordyn.description import Description, ascending, doubled
from rotordyn.quantity import Choice, Force, Growth, Load, Moment
from rotordyn.scene.conditions import TANGENTS, Tangent

TILTS = ("free", "blocked")
AXIAL, RADIAL, MOMENT = SWEPT = ("axial", "radial", "moment")
LISTS = dict(zip(SWEPT, ("loads", "radial_loads", "moments"), strict=True))
FIXED = dict(zip(SWEPT, ("axial_load", "radial_load", "moment"), strict=True))


@dataclass(frozen=True, slots=True)
class BearingMapSpec(Description):
    """A single bearing under a list of loads at every speed of the case.

    One of ``loads`` (axial) [N], ``radial_loads`` along y [N] and ``moments`` about z [N·m] is the
    list, ascending; ``axial_load``, ``radial_load`` [N] and ``moment`` [N·m] of the other two act
    all the time. ``tilt``: of ``TILTS``; ``"blocked"`` holds both tilts of the ring at zero.
    ``dynamics``: of ``bearings.ball.law.DYNAMICS``. ``tangents``: of ``TANGENTS``, the stiffness
    matrices to compute.
    """

    loads: tuple[Load, ...] = ()
    static_growth: Growth = 0.0
    tangents: tuple[Tangent, ...] = TANGENTS[:1]
    radial_loads: tuple[Force, ...] = ()
    moments: tuple[Moment, ...] = ()
    axial_load: Force = 0.0
    radial_load: Force = 0.0
    moment: Moment = 0.0
    tilt: Annotated[str, Choice(TILTS)] = TILTS[0]
    dynamics: Annotated[str, Choice(DYNAMICS)] = DYNAMICS[0]

    def _faults(self) -> Iterator[str]:
        if not self.tangents:
            yield "no tangents: at least one is needed"
        for name in doubled(self.tangents):
            yield f"tangents: repeated: given '{name}'"
        for name in LISTS.values():
            yield from ascending(name, getattr(self, name))
        for _, fault in contradictions(self):
            yield fault

    @property
    def swept(self) -> str:
        """Of ``SWEPT``: which component the list gives."""
        return next(name for name, given in LISTS.items() if getattr(self, given))

    @property
    def values(self) -> tuple[float, ...]:
        """The list [N, N·m]."""
        given: tuple[float, ...] = getattr(self, LISTS[self.swept])
        return given

    @property
    def combined(self) -> bool:
        """Whether balls differ: more than a thrust acts."""
        return self.swept != AXIAL or self.radial_load != 0.0 or self.moment != 0.0


def contradictions(asked: object) -> Iterator[tuple[str, str]]:
    """Key and sentence for each fault between the keys of a ``BearingMapSpec`` or of its entry."""
    given = [name for name in LISTS.values() if getattr(asked, name)]
    if len(given) != 1:
        yield (
            (given or [""])[-1],
            f"give exactly one list of {', '.join(LISTS.values())}: got "
            f"{' and '.join(given) or 'none'}",
        )
        return
    component = next(name for name, each in LISTS.items() if each == given[0])
    if abs(getattr(asked, FIXED[component])) > 0.0:  # not NaN, whose fault is known
        yield FIXED[component], f"{FIXED[component]} is given by the list {given[0]} already"
    turned = bool(getattr(asked, "moments", ())) or abs(getattr(asked, "moment", 0.0)) > 0.0
    if turned and getattr(asked, "tilt", "") == "blocked":
        yield "tilt", "tilt blocked takes no moment: the ring's guide carries it; allowed: free"
