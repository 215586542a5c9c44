"""What sits on a shaft: stations on it, names once, joints between two parts."""

from __future__ import annotations

from collections.abc import Sequence

from rotordyn.description import Faults, Path, named_twice
from rotordyn.machine.joint import Joint
from rotordyn.machine.lumped import Disc, PointMass
from rotordyn.machine.shaft import Shaft
from rotordyn.units import format_quantity

SLACK = 1e-9  # [m] by which a station may lie beside the shaft


def on_the_shaft(what: str, x: float, shaft: Shaft, path: Path) -> Faults:
    """A fault where station ``x`` [m], given at ``path``, does not lie on the shaft."""
    if x < shaft.start - SLACK or x > shaft.end + SLACK:
        ends = " to ".join(format_quantity(end, "mm") for end in (shaft.start, shaft.end))
        yield path, f"{what} off the shaft: given {{given}}; allowed: {ends}"


def turning_faults(
    shaft: Shaft, masses: Sequence[PointMass], discs: Sequence[Disc], joints: Sequence[Joint]
) -> Faults:
    """Faults of what turns with a shaft: each on it, and called by a name of its own."""
    yield from named_twice("masses", masses)
    yield from named_twice("discs", discs)
    for index, mass in enumerate(masses):
        yield from on_the_shaft("mass", mass.x, shaft, ("masses", index, "x"))
    for index, disc in enumerate(discs):
        yield from on_the_shaft("disc", disc.x, shaft, ("discs", index, "x"))
    taken = {mass.name for mass in masses}
    for index, disc in enumerate(discs):
        if disc.name and disc.name in taken:
            yield ("discs", index, "name"), f"name taken by a mass: '{disc.name}'"
    yield from named_twice("joints", joints)
    ends = [format_quantity(x, "mm") for x in (shaft.start, shaft.end)]
    for index, joint in enumerate(joints):
        way = ("joints", index, "x")
        if joint.x <= shaft.start + SLACK or joint.x >= shaft.end - SLACK:
            between = " and ".join(ends)
            yield way, f"joins no two parts: given {{given}}; allowed: between {between}"
        for other in joints[:index]:
            if abs(joint.x - other.x) <= SLACK:
                yield way, f"joint '{other.name}' is at the same station"
