"""Sleeves and shifts of bearings: those that are there, each once."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from rotordyn.description import doubled
from rotordyn.machine.support import BearingSeat, Sleeve
from rotordyn.quantity import suggestion


def sleeve_faults(seats: Sequence[BearingSeat], sleeves: Sequence[Sleeve]) -> Iterator[str]:
    """Bearings that are not there, of unlike thrust, or on two sleeves."""
    thrust = {seat.name: seat.thrust for seat in seats}
    for sleeve in sleeves:
        for name in sleeve.bearings:
            yield from _unknown(name, f"sleeve {sleeve.name}", tuple(thrust))
        if len({thrust.get(name, 0) for name in sleeve.bearings}) > 1:
            yield f"sleeve {sleeve.name}: its bearings must all have the same thrust"
    for name in doubled(name for sleeve in sleeves for name in sleeve.bearings):
        yield f"bearing '{name}' is on more than one sleeve"


def shift_faults(seats: Sequence[BearingSeat], shifted: Iterable[str]) -> Iterator[str]:
    """Bearings that are not there."""
    for name in shifted:
        yield from _unknown(name, "shortening.shift", [seat.name for seat in seats])


def _unknown(name: str, where: str, names: Sequence[str]) -> Iterator[str]:
    if name not in names:
        allowed = ", ".join(names) or "none, there are no seats"
        yield f"{where}: unknown bearing '{name}'; allowed: {allowed}{suggestion(name, names)}"
