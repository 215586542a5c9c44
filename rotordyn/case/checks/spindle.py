"""A spindle and its tool: everything on the shaft, and the shaft held."""

from __future__ import annotations

from collections.abc import Sequence

from rotordyn.case.checks.bearing import seats, sleeves
from rotordyn.case.checks.housing import housings
from rotordyn.case.checks.joint import joints
from rotordyn.case.checks.names import exists, unique
from rotordyn.case.checks.references import references
from rotordyn.case.checks.rotor import reaches, rotors
from rotordyn.case.checks.shaft import (
    Span,
    lumped_names,
    masses,
    on_shaft,
    points_on_shaft,
    sections,
    span,
    wall,
)
from rotordyn.case.checks.sweep import ascending
from rotordyn.case.faults import Faults
from rotordyn.case.node import Node
from rotordyn.case.schema.matrix import ENTRIES, entries
from rotordyn.case.schema.shaft import MassEntry, SectionEntry, ToolEntry
from rotordyn.case.schema.spindle import SpindleEntry
from rotordyn.case.schema.support import SupportEntry
from rotordyn.machine.held import held_twice
from rotordyn.machine.naming import name_faults
from rotordyn.machine.squeeze_film import film_faults
from rotordyn.machine.support import (
    SPINDLE,
    acts,
    hold_faults,
    loss_faults,
    rigid_and_elastic,
    table_faults,
)


def spindle(entry: SpindleEntry, root: Node, tool: ToolEntry | None, faults: Faults) -> None:
    """All checks of a spindle file; its points may lie on the tool as well."""
    reach = span(entry.shaft.start, entry.shaft.sections)
    sections(entry.shaft.sections, root, ("shaft", "sections"), faults)
    masses(entry.masses, root, faults)
    seats(entry, root, faults)
    sleeves(entry, root, faults)
    _stations(entry, reach, root, faults)
    points_on_shaft(entry.points, (reach[0] - _length(tool), reach[1]), root, faults)
    _lumped(entry, root, faults)
    _shortening(entry, reach, root, faults)
    _drawbar(entry, reach, root, faults)
    _held(entry, root, faults)
    parts = entry.housings, entry.rotors, entry.bearings, entry.supports
    for kind, place, sentence in name_faults(*parts):
        faults.at(root, (kind, place, "name"), sentence)
    housings(entry, root, faults)
    rotors(entry, root, faults)
    joints(entry.joints, reach, (), root, faults)
    references(entry.references, root, faults)


def tool(entry: ToolEntry, root: Node, machine: SpindleEntry | None, faults: Faults) -> None:
    """All checks of a tool file, in front of ``machine`` where that is known."""
    sections(entry.sections, root, ("sections",), faults)
    masses(entry.masses, root, faults)
    references(entry.references, root, faults)
    if machine is None:
        return
    nose = machine.shaft.start
    reach = (nose - _length(entry), nose)
    machine_end = span(machine.shaft.start, machine.shaft.sections)[1]
    points_on_shaft(entry.points, reach, root, faults)
    for index, mass in enumerate(entry.masses):
        on_shaft(mass.x, reach, "mass", root, ("masses", index, "x"), faults)
    joints(entry.joints, (reach[0], machine_end), machine.joints, root, faults)
    for name in entry.points:
        if name in machine.points:
            faults.at_key(root, ("points", name), "name already taken by a point of the spindle")
    lumped = [m.name for m in machine.masses] + [disc.name for disc in machine.discs]
    _free(entry.masses, lumped, root, ("masses",), faults)
    _free(entry.sections, [s.name for s in machine.shaft.sections], root, ("sections",), faults)


def _free(
    entries: Sequence[MassEntry | SectionEntry],
    taken: Sequence[str],
    root: Node,
    way: tuple[object, ...],
    faults: Faults,
) -> None:
    for index, entry in enumerate(entries):
        if entry.name and entry.name in taken:
            message = f"name already taken in the spindle: '{entry.name}'"
            faults.at(root, (*way, index, "name"), message)


def _length(tool: ToolEntry | None) -> float:
    return 0.0 if tool is None else span(0.0, tool.sections)[1]


def _stations(entry: SpindleEntry, reach: Span, root: Node, faults: Faults) -> None:
    for key, what in (
        ("bearings", "bearing"),
        ("masses", "mass"),
        ("discs", "disc"),
        ("dampers", "damper"),
    ):
        for index, item in enumerate(getattr(entry, key)):
            on_shaft(item.x, reach, what, root, (key, index, "x"), faults)
    unique([support.name for support in entry.supports], root, ("supports",), faults)
    for sentence in held_twice(entry.bearings, entry.supports):
        faults.at(root, ("supports",), sentence)
    taken = [support.name for support in entry.supports]
    unique([damper.name for damper in entry.dampers], root, ("dampers",), faults)
    for index, damper in enumerate(entry.dampers):
        if damper.name in taken:
            message = f"name already taken by a support: '{damper.name}'"
            faults.at(root, ("dampers", index, "name"), message)
        for sentence in film_faults(damper):
            faults.at(root, ("dampers", index, "clearance"), sentence)
    every = {SPINDLE: reach, **reaches(entry)}
    for index, support in enumerate(entry.supports):
        for end in support.ends:
            if end in every:
                what = "support" if end == SPINDLE else f"support on {end}"
                on_shaft(support.x, every[end], what, root, ("supports", index, "x"), faults)
        _support(support, root, ("supports", index), faults)


def _support(entry: SupportEntry, root: Node, way: tuple[object, ...], faults: Faults) -> None:
    """It holds something, and nothing both rigidly and elastically."""
    here = root.at(*way)
    if here.child("stiffness") is None and here.child("rigid") is None:
        message = "missing key: it must be given, or rigid"
        faults.missing(root, (*way, "stiffness"), message)
    named = (*entries(entry.stiffness), *entries(entry.damping))
    for sentence in rigid_and_elastic(entry.rigid, named):
        faults.at(root, (*way, "rigid"), sentence)
    ascending(entry.speeds, root, (*way, "speeds"), faults)
    for sentence in hold_faults(entry.beyond, entry.speeds):
        faults.at(root, (*way, "beyond"), sentence)
    found = [*table_faults(entries(entry.stiffness), entries(entry.damping), entry.speeds)]
    for place, sentence in found:
        faults.at(root, (*way, *place), sentence)
    for sentence in () if found else loss_faults(entries(entry.stiffness), entry.loss_factor):
        faults.at(root, (*way, "loss_factor"), sentence)


def _lumped(entry: SpindleEntry, root: Node, faults: Faults) -> None:
    lumped_names(entry.masses, entry.discs, root, faults)
    for index, disc in enumerate(entry.discs):
        wall(disc, root, ("discs", index), faults)


def _shortening(entry: SpindleEntry, reach: Span, root: Node, faults: Faults) -> None:
    given, way = entry.shortening, ("shortening",)
    if given is None:
        return
    if given.reference is not None:
        on_shaft(given.reference, reach, "reference", root, (*way, "reference"), faults)
    if isinstance(given.shift, str):
        if given.shift and given.reference is None:
            faults.missing(
                root, (*way, "reference"), "missing key: the station that does not shift"
            )
        return
    if given.at is None:
        faults.missing(root, (*way, "at"), "missing key: the speed of these shifts")
    names = [seat.name for seat in entry.bearings]
    for name in given.shift:
        exists(name, names, "bearing", root, (*way, "shift", name), faults)


def _drawbar(entry: SpindleEntry, reach: Span, root: Node, faults: Faults) -> None:
    """It lies in the shaft from front to rear, its guides between its ends."""
    bar, way = entry.drawbar, ("drawbar",)
    if bar is None:
        return
    for key, x in (("from", bar.start), ("to", bar.to)):
        on_shaft(x, reach, "drawbar", root, (*way, key), faults)
    if bar.start >= bar.to:
        start, to = root.at(*way, "from").raw, root.at(*way, "to").raw
        faults.at(
            root,
            (*way, "to"),
            f"no length left: given '{start}' to '{to}'; allowed: to above from",
        )
    elif not isinstance(bar.guides, str):
        ascending(bar.guides, root, (*way, "guides"), faults)
        for index, x in enumerate(bar.guides):
            place = (*way, "guides", index)
            if not bar.start < x < bar.to:
                given = root.at(*place).raw
                faults.at(root, place, f"guide beyond the bar: given '{given}'; allowed: inside it")


def _held(entry: SpindleEntry, root: Node, faults: Faults) -> None:
    if entry.bearings:
        return
    free = [
        key
        for key in ("yy", "zz")
        if not any(
            acts(entries(support.stiffness).get(ENTRIES[key], 0.0))
            or ENTRIES[key][0] in support.rigid
            for support in entry.supports
            if SPINDLE in support.ends
        )
    ]
    if free:
        faults.at(
            root,
            ("supports",),
            f"the shaft is not held: no bearings, no support with stiffness {' and '.join(free)}",
        )
