"""What machines whose supports stand on housings cannot be asked."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rotordyn.scene.formulation import ROTATING

_REFUSED = {
    "stiffness": "the radial stiffness takes no housings: ask frf at a low frequency instead",
}


def obstacles_on_housings(
    formulation: str, asked: Iterable[str]
) -> Iterator[tuple[tuple[str, ...], str]]:
    """Where a case asks what housings do not allow, and a sentence."""
    for name in sorted(set(asked) & set(_REFUSED)):
        yield ("analyses", name), _REFUSED[name]
    if formulation == ROTATING:
        yield (
            ("conditions", "formulation"),
            "a turning frame cannot describe housings, which stand still: given 'rotating'; "
            "allowed: inertial",
        )


def directions_on_housings(named: Iterable[str], bearings: bool, loaded: bool) -> Iterator[str]:
    """The static state along the axis is found on ground: no housing may give way there then."""
    if "x" in named and (bearings or loaded):
        what = "of bearings" if bearings else "of axial force and weight"
        yield f"a housing moves along x, and the static state {what} is that on ground: leave x out"
