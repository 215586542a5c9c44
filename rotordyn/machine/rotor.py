"""A further rotor on the axis of the spindle: inside its shaft, around it, or beside it."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple, Protocol

from rotordyn.description import Description, doubled
from rotordyn.machine.damping import RayleighDamping
from rotordyn.machine.joint import Joint
from rotordyn.machine.lumped import Disc, PointMass
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.support import GROUND, MOTIONS, SPINDLE
from rotordyn.quantity import DampingRatio, Name, Share, SpeedRatio, Station, suggestion

HELD = ("y", "z")


class Place(NamedTuple):
    """A station ``x`` [m] on a rotor, the spindle's shaft being ``"spindle"``."""

    rotor: str
    x: float


@dataclass(frozen=True, slots=True)
class Rotor(Description):
    """A shaft of its own, which turns at ``speed_ratio`` times the speed of the spindle.

    Negative: the other way round; 0: it stands still; 1: it turns with the spindle, as a sleeve on
    its shaft. Stations [m] are those of the spindle's axis. All else as of a ``Spindle``, its
    joints included; only linear supports hold it.
    """

    name: Name
    speed_ratio: SpeedRatio
    shaft: Shaft
    masses: tuple[PointMass, ...] = ()
    discs: tuple[Disc, ...] = ()
    points: Mapping[Name, Station] = field(default_factory=dict)
    rotor_damping: tuple[DampingRatio, ...] = ()
    internal_damping: Share = 0.0
    rayleigh: RayleighDamping = field(default_factory=RayleighDamping)
    joints: tuple[Joint, ...] = ()


class Turning(Protocol):
    """A further rotor, as it is given or as it is read."""

    @property
    def name(self) -> str: ...


class Between(Protocol):
    """A support, as it is given or as it is read."""

    @property
    def name(self) -> str: ...
    @property
    def holds(self) -> str: ...
    @property
    def against(self) -> str: ...


def rotor_faults(
    rotors: Sequence[Turning], held: Mapping[str, Collection[str]]
) -> Iterator[tuple[int, str]]:
    """What is wrong with further rotors: which one, and a sentence.

    ``held``: the freedoms in which supports hold each of them.
    """
    names = [rotor.name for rotor in rotors]
    for place, name in enumerate(names):
        if name in (SPINDLE, GROUND):
            taken = f"allowed: any other name than {SPINDLE} and {GROUND}"
            yield place, f"a further rotor cannot be called that: given '{name}'; {taken}"
        if misnamed(names):
            continue
        free = [freedom for freedom in HELD if freedom not in held.get(name, ())]
        if free:
            yield (
                place,
                f"rotor '{name}' is not held: no support with it as an end has a stiffness along "
                f"{' and '.join(free)}",
            )
    for name in doubled(names):
        yield names.index(name), f"two rotors are named '{name}'"


def misnamed(rotors: Sequence[str]) -> bool:
    """Names of rotors are at fault, so that what bears them elsewhere cannot be judged."""
    return bool({SPINDLE, GROUND, ""} & {*rotors}) or any(doubled(rotors))


def ends_faults(
    supports: Iterable[Between], rotors: Sequence[str]
) -> Iterator[tuple[int, str, str]]:
    """What is wrong with what supports join: which support, its key, and a sentence.

    Nothing where rotors are misnamed, which is to be put right first.
    """
    if misnamed(rotors):
        return
    known = (SPINDLE, *rotors)
    for place, support in enumerate(supports):
        for key, allowed in (("holds", known), ("against", (GROUND, *known))):
            given = getattr(support, key)
            if given and given not in allowed:
                yield (
                    place,
                    key,
                    f"unknown rotor: given '{given}'; allowed: {', '.join(allowed)}"
                    f"{suggestion(given, allowed)}",
                )
        if support.holds and support.holds == support.against:
            yield place, "against", f"a rotor is not held against itself: given '{support.holds}'"


def of_one_rotor(given: str) -> str:
    """Why a loss factor, as it is given, is refused beside further rotors."""
    return (
        "loss factors are known of machines with one rotor, since each sees whirl from its own "
        f"speed: given '{given}' beside rotors; allowed: 0, with viscous damping instead"
    )


def freedoms_held(pairs: Iterable[tuple[str, str]], rigid: Iterable[str]) -> frozenset[str]:
    """Freedoms across the axis that stiffness entries hold by themselves, or ``rigid`` supports."""
    held = (*(a for a, b in pairs if a == b), *rigid)
    return frozenset(freedom for freedom in held if MOTIONS.get(freedom) == "bending")
