"""What holds what: freedoms held once, housings that carry what is there."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import Protocol

from rotordyn.description import doubled
from rotordyn.machine.naming import Called
from rotordyn.machine.station import SLACK
from rotordyn.machine.support import SPINDLE
from rotordyn.quantity import suggestion


class RigidSupport(Protocol):
    """A support, as it is given or as it is read."""

    @property
    def name(self) -> str: ...
    @property
    def x(self) -> float: ...
    @property
    def rigid(self) -> Sequence[str]: ...
    @property
    def against(self) -> str: ...


def held_twice(seats: Iterable[object], supports: Iterable[RigidSupport]) -> Iterator[str]:
    """A sentence where two supports hold one freedom of a station, or one x beside bearings."""
    taken: dict[str, list[RigidSupport]] = {}
    for support in supports:
        for freedom in support.rigid:
            for other in taken.get(freedom, ()):
                if abs(support.x - other.x) <= SLACK:
                    yield f"supports '{other.name}' and '{support.name}' both hold {freedom} there"
            taken.setdefault(freedom, []).append(support)
    if "x" in taken and any(True for _ in seats):
        yield (
            f"support '{taken['x'][0].name}' holds x rigidly beside bearings, whose preload moves "
            "the shaft along: give it a stiffness xx"
        )


class Carrier(Protocol):
    """A housing, as it is given or as it is read."""

    @property
    def name(self) -> str: ...
    @property
    def carries(self) -> Sequence[str]: ...


class Sprung(Protocol):
    """A sleeve, as it is given or as it is read."""

    @property
    def name(self) -> str: ...
    @property
    def bearings(self) -> Sequence[str]: ...
    @property
    def radial_stiffness(self) -> float: ...


def housing_faults(
    housings: Sequence[Carrier],
    seats: Iterable[Called],
    sleeves: Iterable[Sprung],
    supports: Iterable[RigidSupport],
    rotors: Iterable[Called] = (),
) -> Iterator[tuple[int, str]]:
    """What is wrong with what housings carry: which housing, and a sentence."""
    turning = (SPINDLE, *(rotor.name for rotor in rotors))
    bearings = [seat.name for seat in seats]
    held = {support.name: support for support in supports}
    sprung = {n: s.name for s in sleeves if s.radial_stiffness < math.inf for n in s.bearings}
    taken: dict[str, str] = {}
    for place, housing in enumerate(housings):
        for name in dict.fromkeys(housing.carries):
            known = [*bearings, *held]
            if name not in known:
                allowed = ", ".join(known) or "none, there are none"
                yield (
                    place,
                    f"carries an unknown support or bearing '{name}'; allowed: {allowed}"
                    f"{suggestion(name, known)}",
                )
            elif name in bearings and name in held:
                yield place, f"'{name}' is both a support and a bearing: rename one of them"
            elif name in held and held[name].rigid:
                yield place, f"support '{name}' is rigid, and a housing that gives way is not"
            elif name in held and held[name].against in turning:
                yield place, f"support '{name}' stands between two rotors, not on ground"
            elif name in sprung:
                yield (
                    place,
                    f"bearing '{name}' is on sleeve '{sprung[name]}', whose radial_stiffness holds "
                    "it against ground: leave that out, or the bearing off the housing",
                )
            if name in taken:
                yield place, f"'{name}' stands on two housings: {taken[name]} and {housing.name}"
            taken[name] = housing.name
    for name in doubled(housing.name for housing in housings):
        yield 0, f"two housings are named '{name}'"
