"""What machines of several rotors cannot be asked."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Protocol

from rotordyn.machine.support import GROUND, SPINDLE
from rotordyn.scene.formulation import INERTIAL

_REFUSED = {
    "stiffness": "the radial stiffness takes no further rotors: ask frf at a low frequency instead",
    "section_forces": "section forces take no further rotors: leave out the rotors",
}


class Conditioned(Protocol):
    """Conditions, as they are given or as they are read."""

    @property
    def formulation(self) -> str: ...
    @property
    def gravity(self) -> str: ...
    @property
    def axial_force(self) -> float: ...


def obstacles_of_rotors(
    conditions: Conditioned, asked: Iterable[str]
) -> Iterator[tuple[tuple[str, ...], str]]:
    """Where a case asks what further rotors do not allow, and a sentence."""
    for name in sorted(set(asked) & set(_REFUSED)):
        yield ("analyses", name), _REFUSED[name]
    if conditions.formulation != INERTIAL:
        yield (
            ("conditions", "formulation"),
            "rotors of different speeds have no common turning frame: given "
            f"'{conditions.formulation}'; allowed: {INERTIAL}",
        )
    if conditions.gravity != "none":
        yield (
            ("conditions", "gravity"),
            "weight along the axis takes no further rotors, on whose supports it would be shared: "
            f"given '{conditions.gravity}'; allowed: none",
        )
    if conditions.axial_force != 0.0:
        yield (
            ("conditions", "axial_force"),
            "an axial force takes no further rotors, on whose supports it would be shared: leave "
            "it out",
        )


class Joining(Protocol):
    """A support with its entries."""

    @property
    def name(self) -> str: ...
    @property
    def ends(self) -> tuple[str, str]: ...
    @property
    def stiffness(self) -> Mapping[tuple[str, str], object]: ...


def joined_along(supports: Iterable[Joining]) -> Iterator[str]:
    """Beside bearings, whose preload moves the shaft along, no other rotor ties it to ground there.

    The preload state is that of the shaft by itself; what only hangs on the shaft goes along.
    """
    ties = [s for s in supports if set(s.ends) != {SPINDLE, GROUND} and _along(s)]
    reached, further = set[str](), {SPINDLE}
    while further:
        reached |= further
        ends = {end for tie in ties for end in tie.ends if reached & set(tie.ends) - {GROUND}}
        further = ends - reached
    if GROUND in reached:
        names = ", ".join(f"'{tie.name}'" for tie in ties if set(tie.ends) <= reached)
        yield (
            f"supports {names} tie the shaft along the axis to ground by way of another rotor, "
            "beside bearings whose preload state is that of the shaft alone: leave out entries of x"
        )


def _along(support: Joining) -> bool:
    return any("x" in pair for pair in support.stiffness)
