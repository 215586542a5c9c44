"""Parts on a shaft: stations within it, unique names, joints between two parts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rotordyn.description import Faults, Path, known, named_twice
from rotordyn.machine.joint import Joint
from rotordyn.machine.lumped import Disc, PointMass
from rotordyn.machine.shaft import Shaft
from rotordyn.units import format_quantity

Reach = tuple[float, float]
SLACK = 1e-9  # [m] by which a station may lie off the shaft
PART = 1e-6  # of a shaft: its shortest part between joints


def on_the_shaft(what: str, x: float, reach: Reach, path: Path, holder: str = "shaft") -> Faults:
    """Yield a fault where station ``x`` [m], given at ``path``, is off a shaft, or another
    ``holder``, of that reach, if that is known."""
    if all(map(known, reach)) and (x < reach[0] - SLACK or x > reach[1] + SLACK):
        ends = " to ".join(format_quantity(end, "mm") for end in reach)
        yield path, f"{what} off the {holder}: given {{given}}; allowed: {ends}"


def all_on_the_shaft(
    what: str, key: str, items: Sequence[Any], reach: Reach, holder: str = "shaft"
) -> Faults:
    """Yield a fault for every item of the list ``key`` whose station is off the shaft."""
    for index, item in enumerate(items):
        yield from on_the_shaft(what, item.x, reach, (key, index, "x"), holder)


def least_part(start: float, end: float) -> float:
    """Return the shortest part of a shaft [m] between joints, or a joint and an end: a lighter one
    has motions without significant digits."""
    return max(SLACK, PART * (end - start))


def turning_faults(
    shaft: Shaft, masses: Sequence[PointMass], discs: Sequence[Disc], joints: Sequence[Joint]
) -> Faults:
    """Yield faults of what turns with a shaft: each part on it, names unique."""
    reach = shaft.reach
    yield from named_twice("masses", masses)
    yield from named_twice("discs", discs)
    yield from all_on_the_shaft("mass", "masses", masses, reach)
    yield from all_on_the_shaft("disc", "discs", discs, reach)
    taken = {mass.name for mass in masses}
    for index, disc in enumerate(discs):
        if disc.name and disc.name in taken:
            yield ("discs", index, "name"), f"name taken by a mass: '{disc.name}'"
    yield from _parts(reach, joints)


def _parts(reach: Reach, joints: Sequence[Joint]) -> Faults:
    """Yield faults of joints: one name for several, or no part of sufficient length between
    them."""
    yield from named_twice("joints", joints)
    if not all(map(known, reach)):
        return
    (start, end), least = reach, least_part(*reach)
    for index, joint in enumerate(joints):
        path = ("joints", index, "x")
        if joint.x <= start + least or joint.x >= end - least:
            between = " and ".join(format_quantity(x, "mm") for x in reach)
            yield path, f"joins no two parts: given {{given}}; allowed: between {between}"
        for other in joints[:index]:
            gap = abs(joint.x - other.x)
            if gap <= SLACK:
                yield path, f"joint '{other.name}' is at the same station"
            elif gap < least:
                yield (
                    path,
                    f"too short a part of the shaft to joint '{other.name}': given {gap:.3g} m; "
                    f"allowed: from {least:.3g} m, {PART:g} of the shaft; make them one",
                )
