"""A set of bearings as designers call it, DB or TBT, and how it is preloaded.

The letters give the directions in which the bearings take thrust, from front to rear. A set is
equivalent to given thrusts and a sleeve, locked for a rigid preload, on a spring otherwise.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Annotated

from rotordyn.description import Description, Faults, repeated
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.sleeve import CONSTANT, Sleeve, Spring
from rotordyn.quantity import (
    Choice,
    Items,
    Key,
    Load,
    Name,
    Preload,
    Rigidity,
    RingOffset,
    StopTravel,
)

CLASSES = ("light", "medium", "heavy")  # of preload, as makers call them
SETS = {  # +: the shaft pushes towards +x; the mirror image is the same set
    "DB": "+-",
    "DF": "-+",
    "DT": "++",
    "TBT": "++-",
    "TFT": "--+",
    "TT": "+++",
    "QBC": "++--",
    "QFC": "--++",
    "QBT": "+++-",
    "QFT": "---+",
    "QT": "++++",
}
OPPOSITE = {"DF": "DB", "TFT": "TBT", "QFC": "QBC", "QFT": "QBT"}  # all thrusts reversed


def patterns(name: str) -> tuple[str, ...]:
    """Return the signs of thrust of a set from front to rear: as drawn, and its mirror image."""
    drawn = SETS[name]
    mirrored = drawn[::-1].translate(str.maketrans("+-", "-+"))
    return tuple(dict.fromkeys((drawn, mirrored)))


def fitting(name: str, given: Sequence[str]) -> str:
    """Return the signs of thrust of a set, as drawn or mirrored, whichever agrees with the signs
    ``given`` of its bearings (empty: not given); as drawn where neither does."""
    both = patterns(name) if name in [*SETS] else ()
    sets = [signs for signs in both if len(signs) == len(given)] or ["+" * len(given)]
    fits = (s for s in sets if all(g in ("", sign) for g, sign in zip(given, s, strict=True)))
    return next(fits, sets[0])


@dataclass(frozen=True, slots=True)
class SetPreload(Description):
    """How a set is preloaded: one of force, class_force, offset, constant_force."""

    force: Annotated[
        Load | None, "preload as mounted; on the rings of each side in tandem altogether"
    ] = None
    class_force: Annotated[
        Load | None,
        "preload of a pair of these bearings before it is mounted, as in a maker's preload class: "
        "fits and the number of bearings raise it",
    ] = None
    offset: Annotated[
        RingOffset | None,
        "axial offset of the rings that mounting closes, or the difference of spacers or a shim, "
        "before fits",
    ] = None
    constant_force: Annotated[Load | None, "preload by a piston, independent of its travel"] = None
    stiffness: Annotated[
        Rigidity, "stiffness of a spring that gives the force; `rigid` locks the rings"
    ] = math.inf
    stop_travel: Annotated[StopTravel, "travel against the force, from rest to an end stop"] = (
        math.inf
    )
    friction: Annotated[
        Preload, "limit of the dry friction of the rings that the force pushes, in their bore"
    ] = 0.0
    maker_class: Annotated[
        Annotated[str, Choice(CLASSES)] | None,
        Key("class"),
        "a class whose force the model of the bearing prints (`preloads`), as class_force",
    ] = field(default=None, compare=False)

    def _faults(self) -> Faults:
        keys = ("force", "class_force", "offset", "constant_force")
        given = [key for key in keys if getattr(self, key) is not None]
        if len(given) != 1:
            names = ", ".join(given) or "none"
            yield (
                (),
                f"a preload is given in one way: given {names}; allowed: one of force, class (its "
                "class_force), offset, constant_force",
            )
        elif given[0] != "force" and math.isfinite(self.stiffness):
            yield (
                ("stiffness",),
                f"a spring needs its force as mounted: given beside {given[0]}; allowed: with "
                "force",
            )
        acting = {"stop_travel": self.stop_travel < math.inf, "friction": self.friction > 0.0}
        for key, acts in acting.items():
            if acts and math.isinf(self.spring.stiffness):
                yield (
                    (key,),
                    "has no effect where the rings are locked: give the force a stiffness, or a "
                    "constant_force, or leave it out",
                )

    @property
    def spring(self) -> Spring:
        """Spring that loads the sleeve of the set."""
        if self.constant_force is not None:
            return Spring(self.constant_force, CONSTANT)
        if self.offset is not None:
            return Spring(0.0, math.inf, offset=self.offset)
        if self.class_force is not None:
            return Spring(self.class_force, math.inf, free=True)
        return Spring(self.force or 0.0, self.stiffness)


@dataclass(frozen=True, slots=True)
class BearingSet(Description):
    """A set of bearings by its name, with its preload."""

    set: Annotated[str, Choice(tuple(SETS)), "DB, DF, DT; TBT, TFT, TT; QBC, QFC, QBT, QFT, QT"]
    bearings: Annotated[tuple[Name, ...], Items(2, 4), "bearings of the set, from front to rear"]
    preload: Annotated[
        SetPreload | None, "preload of a set whose bearings take opposite thrust"
    ] = None
    name: Annotated[Name, "name of the set and of its sleeve"] = "set"

    def _faults(self) -> Faults:
        yield from repeated("bearings", self.bearings)
        size = len(SETS.get(self.set, ""))
        if size and len(self.bearings) != size:
            yield (
                ("bearings",),
                f"a set {self.set} has {size} bearings: given {len(self.bearings)}",
            )
        if size and len({*SETS[self.set]}) == 1 and self.preload is not None:
            yield (
                ("preload",),
                f"bearings of a set {self.set} all take thrust the same way and do not preload one "
                "another: leave it out, and give a sleeve that preloads them",
            )
        if size and len({*SETS[self.set]}) == 2 and self.preload is None:
            yield ("preload",), f"missing key: a set {self.set} needs it"

    def faults_with(self, seats: Sequence[BearingSeat]) -> Faults:
        """Yield contradictions with the bearings of the spindle, by path from the set on."""
        seat_of = {seat.name: seat for seat in seats}
        members = [seat_of[name] for name in self.bearings if name in seat_of]
        size = len(SETS.get(self.set, ""))
        if not size or not size == len(members) == len(self.bearings) == len({*self.bearings}):
            return
        if [seat.x for seat in members] != sorted(seat.x for seat in members):
            order = ", ".join(seat.name for seat in sorted(members, key=lambda s: s.x))
            yield ("bearings",), f"from front to rear they are {order}: name them in this order"
            return
        signs = "".join("+" if seat.thrust > 0 else "-" for seat in members)
        if signs not in patterns(self.set):
            wanted = " or ".join(patterns(self.set))
            yield (
                ("set",),
                f"the bearings do not make a set {self.set}: their thrusts from front to rear are "
                f"{signs}, and those of {self.set} are {wanted}; turn bearings, or "
                + _alternative(signs),
            )

    def turned(self, seats: tuple[BearingSeat, ...]) -> tuple[BearingSeat, ...]:
        """Return ``seats`` with the thrust of this set where their files give none."""
        seat_of = {seat.name: seat for seat in seats}
        members = [seat_of[name] for name in self.bearings if name in seat_of]
        given = ["" if seat.by_set else "+" if seat.thrust > 0 else "-" for seat in members]
        signs = fitting(self.set, given)
        for seat, sign in zip(members, signs, strict=True):
            if seat.by_set:
                seat_of[seat.name] = replace(seat, thrust=1 if sign == "+" else -1)
        return tuple(seat_of.values())

    def sleeve(self, seats: Sequence[BearingSeat]) -> Sleeve | None:
        """Return the sleeve under the rear side of the set, locked or on a spring."""
        if self.preload is None:
            return None
        thrusts = {seat.name: seat.thrust for seat in seats if seat.name in self.bearings}
        rear = thrusts.get(self.bearings[-1]) if self.bearings else None
        side = tuple(name for name in self.bearings if rear and thrusts.get(name) == rear)
        if not side:
            return None
        load = self.preload
        return Sleeve(self.name, side, load.spring, load.stop_travel, friction=load.friction)


def _alternative(signs: str) -> str:
    names = [name for name in SETS if signs in patterns(name)]
    return f"name the set {names[0]}" if names else "give sleeves in the place of a set"
