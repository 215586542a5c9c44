"""Stations along the shaft: what may be where."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from rotordyn.description import doubled
from rotordyn.machine.growth import InterferenceFit
from rotordyn.machine.joint import Joint
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.support import BearingSeat

SLACK = 1e-9  # [m] by which a station may lie beside the shaft
PART = 1e-6  # of a shaft: its shortest part between joints


def off_the_shaft(shaft: Shaft, placed: Iterable[tuple[str, float]]) -> Iterator[str]:
    """A sentence for each of ``placed``, a name and its station [m], that does not lie on it."""
    start, end = shaft.start, shaft.end
    for what, x in placed:
        if not start - SLACK <= x <= end + SLACK:
            yield f"{what} off the shaft: given {x:.6g} m; allowed: {start:.6g} m to {end:.6g} m"


def least_part(start: float, end: float) -> float:
    """The shortest part of a shaft [m] between two joints, or a joint and its end: what is lighter
    than that gives its motions no digits."""
    return max(SLACK, PART * (end - start))


def joint_faults(shaft: Shaft, joints: Sequence[Joint]) -> Iterator[str]:
    """Two joints of one name or station, or one that joins no two parts."""
    for name in doubled(joint.name for joint in joints):
        yield f"two joints are named '{name}'"
    start, end = shaft.start, shaft.end
    least = least_part(start, end)
    taken: list[Joint] = []
    for joint in joints:
        if not start + least < joint.x < end - least:
            yield (
                f"Joint {joint.name} joins no two parts: given {joint.x:.6g} m; allowed: "
                f"between {start:.6g} m and {end:.6g} m"
            )
        for other in taken:
            apart = abs(joint.x - other.x)
            if apart <= SLACK:
                yield f"joints '{other.name}' and '{joint.name}' are at the same station"
            elif apart < least:
                yield (
                    f"joints '{other.name}' and '{joint.name}' leave too short a part of the shaft "
                    f"between them: given {apart:.3g} m; allowed: from {least:.3g} m, {PART:g} of "
                    "the shaft; make them one"
                )
        taken.append(joint)


def fit_faults(shaft: Shaft, seats: Iterable[BearingSeat]) -> Iterator[str]:
    """A fit whose bore is no larger than that of the shaft."""
    for seat in seats:
        fit, hole = seat.growth.centrifugal, shaft.diameters_at(seat.x)[1]
        if isinstance(fit, InterferenceFit) and fit.bore_diameter <= hole:
            yield (
                f"the bore of bearing {seat.name} leaves no shaft: given "
                f"{fit.bore_diameter:.6g} m; allowed: above {hole:.6g} m"
            )
