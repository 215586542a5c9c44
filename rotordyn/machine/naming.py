"""Names of parts: none twice, none that something else has already."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Protocol

from rotordyn.description import doubled
from rotordyn.machine.support import GROUND, SPINDLE


class Called(Protocol):
    """Something that has a name."""

    @property
    def name(self) -> str: ...


def name_faults(
    housings: Sequence[Called],
    rotors: Sequence[Called],
    seats: Iterable[Called],
    supports: Iterable[Called],
) -> Iterator[tuple[str, int, str]]:
    """Housings and rotors that bear the name of something else: of which, its place, a sentence."""
    taken = {seat.name: "a bearing" for seat in seats}
    taken |= {support.name: "a support" for support in supports}
    for place, rotor in enumerate(rotors):
        if rotor.name and (what := taken.get(rotor.name)):
            yield "rotors", place, _taken(what, rotor.name)
    taken |= {rotor.name: "a rotor" for rotor in rotors}
    taken |= {GROUND: "ground", SPINDLE: "the shaft"}
    for place, housing in enumerate(housings):
        if housing.name and (what := taken.get(housing.name)):
            yield "housings", place, _taken(what, housing.name)


def _taken(what: str, name: str) -> str:
    return f"name already taken by {what}: given '{name}'; allowed: any other"


def named_twice(what: str, items: Iterable[Called]) -> Iterator[str]:
    """A sentence for each name that two of the items bear."""
    for name in doubled(item.name for item in items):
        yield f"two {what} are named '{name}'"
