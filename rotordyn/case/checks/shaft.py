"""Sections and stations: walls, materials, and nothing beside the shaft."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from rotordyn.case.checks.names import unique
from rotordyn.case.faults import Faults
from rotordyn.case.node import Node
from rotordyn.case.schema.shaft import DiscEntry, MassEntry, SectionEntry
from rotordyn.machine.shaft import taper_faults
from rotordyn.units import format_quantity

Span = tuple[float, float]
_SLACK = 1e-9


def sections(
    entries: Sequence[SectionEntry], root: Node, way: tuple[object, ...], faults: Faults
) -> None:
    """Every section has a wall, a material (its own or the one beside the list), its own name."""
    unique([entry.name for entry in entries], root, way, faults)
    common = root.at(*way[:-1]).child("material") is not None
    for index, entry in enumerate(entries):
        here = (*way, index)
        wall(entry, root, here, faults)
        _rear_wall(entry, root, here, faults)
        if not common and root.at(*here).child("material") is None:
            faults.missing(root, (*here, "material"), "missing key: this section has no material")


def wall(
    entry: SectionEntry | DiscEntry, root: Node, way: tuple[object, ...], faults: Faults
) -> None:
    """The outer diameter is above the inner one."""
    if entry.inner_diameter >= entry.outer_diameter:
        inner = root.at(*way, "inner_diameter").raw
        outer = root.at(*way, "outer_diameter").raw
        faults.at(
            root,
            (*way, "inner_diameter"),
            f"no wall left: given inner diameter '{inner}'; allowed: below the outer, '{outer}'",
        )


def _rear_wall(entry: SectionEntry, root: Node, way: tuple[object, ...], faults: Faults) -> None:
    """A cone has a wall at its rear end, and is not too steep."""
    known = (*entry.outer, *entry.inner)
    if entry.inner_diameter >= entry.outer_diameter or any(math.isnan(d) for d in known):
        return
    for sentence in taper_faults(entry.outer, entry.inner):
        faults.at(root, way, sentence)


def span(start: float, entries: Sequence[SectionEntry]) -> Span:
    """First and last station of sections laid end to end [m]."""
    return start, start + math.fsum(entry.length for entry in entries)


def masses(entries: Sequence[MassEntry], root: Node, faults: Faults) -> None:
    """A flat body has Jp = 2 Jd, a slender one less: Jp cannot exceed 2 Jd."""
    unique([entry.name for entry in entries], root, ("masses",), faults)
    for index, entry in enumerate(entries):
        if entry.polar_inertia > 2.0 * entry.diametral_inertia * (1.0 + 1e-6):
            faults.at(
                root,
                ("masses", index, "polar_inertia"),
                f"impossible body: given '{root.at('masses', index, 'polar_inertia').raw}'; "
                "allowed: up to twice the diametral inertia",
            )


def lumped_names(
    masses: Sequence[MassEntry], discs: Sequence[DiscEntry], root: Node, faults: Faults
) -> None:
    """No disc bears the name of another one or of a mass."""
    taken = [mass.name for mass in masses]
    unique([disc.name for disc in discs], root, ("discs",), faults)
    for index, disc in enumerate(discs):
        if disc.name and disc.name in taken:
            faults.at(root, ("discs", index, "name"), f"name taken by a mass: '{disc.name}'")


def on_shaft(
    x: float, reach: Span, what: str, root: Node, way: tuple[object, ...], faults: Faults
) -> None:
    """Station ``x`` lies on the shaft."""
    if x < reach[0] - _SLACK or x > reach[1] + _SLACK:
        ends = " to ".join(format_quantity(end, "mm") for end in reach)
        given = root.at(*way).raw
        faults.at(root, way, f"{what} off the shaft: given '{given}'; allowed: {ends}")


def points_on_shaft(points: Mapping[str, float], reach: Span, root: Node, faults: Faults) -> None:
    """Every named point lies on the shaft."""
    for name, x in points.items():
        on_shaft(x, reach, "point", root, ("points", name), faults)
