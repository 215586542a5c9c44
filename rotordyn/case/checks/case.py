"""A case against its machine: questions that can be asked, points and speeds that exist."""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import suppress

from rotordyn.analyses.bearing.spec import LISTS, contradictions
from rotordyn.analyses.registry import analysis, built_in
from rotordyn.case.agreement import (
    MOST_ELEMENTS,
    OF_BALLS,
)
from rotordyn.case.build.spindle import support
from rotordyn.case.build.sweep import values
from rotordyn.case.checks.conditions import conditions, sideways
from rotordyn.case.checks.frf import frf, slices
from rotordyn.case.checks.housing import on_housings
from rotordyn.case.checks.joint import on_joints
from rotordyn.case.checks.loads import elements, section_forces, unbalance
from rotordyn.case.checks.names import exists
from rotordyn.case.checks.references import references
from rotordyn.case.checks.rotor import on_rotors
from rotordyn.case.checks.sweep import ascending, sweep
from rotordyn.case.faults import Faults
from rotordyn.case.node import Node
from rotordyn.case.schema.analyses import (
    CampbellEntry,
    ControlEntry,
    StiffnessEntry,
)
from rotordyn.case.schema.case import CaseEntry
from rotordyn.case.schema.shaft import ToolEntry
from rotordyn.case.schema.spindle import SpindleEntry
from rotordyn.errors import InvalidInput
from rotordyn.machine.rotor import misnamed
from rotordyn.machine.support import LinearSupport, entry_name
from rotordyn.units import format_quantity


def machine_named(root: Node, faults: Faults) -> None:
    """Exactly one of spindle and bearing is named, and a tool only with a spindle."""
    spindle, bearing = (root.child(key) for key in ("spindle", "bearing"))
    if spindle is None and bearing is None:
        faults.missing(root, ("spindle",), "missing key: a case needs a spindle, or a bearing")
    if spindle is not None and bearing is not None:
        key = "spindle" if spindle.path.startswith("compare.") else "bearing"
        faults.at_key(root, (key,), "a case has either a spindle or a bearing: given both")
    if root.child("tool") is not None and spindle is None:
        faults.at_key(root, ("tool",), "a tool needs a spindle: given none")


def questions(entry: CaseEntry, root: Node, faults: Faults) -> None:
    """What can be said of speeds and analyses without the machine."""
    sweep(entry.speeds, "rpm", root, ("speeds",), faults)
    references(entry.references, root, faults)
    asked = entry.analyses.model_fields_set
    if not asked:
        faults.at(root, ("analyses",), "nothing is asked: name at least one analysis")
    _apply(asked, root, faults)
    _of_bearing(entry, root, faults)
    _lists(entry, root, faults)


def _apply(asked: set[str], root: Node, faults: Faults) -> None:
    single, spindle = (root.child(key) is not None for key in ("bearing", "spindle"))
    if single == spindle:
        return
    for name in sorted(asked):
        if (analysis(name).machine == "bearing") != single:
            kind = "single bearing" if single else "spindle"
            faults.at_key(root, ("analyses", name), f"this question does not apply to a {kind}")


def _of_bearing(entry: CaseEntry, root: Node, faults: Faults) -> None:
    """A single bearing has no rotor, no preload, no axis of weight that conditions could change."""
    if root.child("bearing") is None or root.child("spindle") is not None:
        return
    for name in sorted(entry.conditions.model_fields_set - set(OF_BALLS)):
        message = f"does not apply to a single bearing; allowed: {', '.join(OF_BALLS)}"
        faults.at_key(root, ("conditions", name), message)


def _lists(entry: CaseEntry, root: Node, faults: Faults) -> None:
    way, analyses = ("analyses",), entry.analyses
    if analyses.bearing is not None:
        for name in LISTS.values():
            ascending(getattr(analyses.bearing, name), root, (*way, "bearing", name), faults)
        for key, sentence in contradictions(analyses.bearing):
            place = (key,) if key else ()
            faults.at_key(root, (*way, "bearing", *place), sentence)
        _once(analyses.bearing.tangents, root, (*way, "bearing", "tangents"), faults)
    if analyses.control is not None:
        _range_of_loads(analyses.control, root, faults)
    if analyses.campbell is not None:
        for name in ("teeth", "engine_orders"):
            ascending(getattr(analyses.campbell, name), root, (*way, "campbell", name), faults)
        _in_space(analyses.campbell, root, faults)
    if analyses.frf is not None:
        if analyses.frf.frequencies is not None:
            sweep(analyses.frf.frequencies, "Hz", root, (*way, "frf", "frequencies"), faults)
        ascending(analyses.frf.engine_orders, root, (*way, "frf", "engine_orders"), faults)
        ascending(analyses.frf.slices, root, (*way, "frf", "slices"), faults)
        slices(analyses.frf, entry, root, faults)
    if analyses.stiffness is not None:
        _once(analyses.stiffness.variants, root, (*way, "stiffness", "variants"), faults)


def _range_of_loads(entry: ControlEntry, root: Node, faults: Faults) -> None:
    if entry.max_load <= entry.min_load:
        way = ("analyses", "control")
        given = root.at(*way, "max_load").raw
        message = f"not above min_load, {entry.min_load:g} N: given '{given}'"
        faults.at(root, (*way, "max_load"), message)


def _in_space(entry: CampbellEntry, root: Node, faults: Faults) -> None:
    """Shapes in space are of shapes that are kept, each file once."""
    way = ("analyses", "campbell")
    if entry.shapes_3d is None:
        return
    if not entry.shapes:
        faults.at_key(root, (*way, "shapes_3d"), "needs the shapes: given shapes: false")
    _once(entry.shapes_3d.files, root, (*way, "shapes_3d", "files"), faults)


def _once(names: Sequence[str], root: Node, way: tuple[str, ...], faults: Faults) -> None:
    for index, name in enumerate(names):
        if name and name in names[:index]:
            faults.at(root, (*way, index), f"repeated: given '{name}'")


def against_machine(
    entry: CaseEntry,
    spindle: SpindleEntry,
    tool: ToolEntry | None,
    root: Node,
    faults: Faults,
) -> None:
    """Points, sleeves and bearings that the questions name exist.

    Where rotors are misnamed, so may be their points: these wait.
    """
    _elements(entry, spindle, tool, root, faults)
    supports = _supports(spindle)
    conditions(entry.conditions, supports, spindle, root, faults)
    _known_there(entry, supports, root, faults)
    on_housings(entry, spindle, root, faults)
    on_joints(entry, spindle, tool, root, faults)
    on_rotors(entry, spindle, supports, root, faults)
    if misnamed([rotor.name for rotor in spindle.rotors]):
        return
    points = [*spindle.points, *(tool.points if tool else {})]
    points += [f"{rotor.name}.{point}" for rotor in spindle.rotors for point in rotor.points]
    for name in built_in():
        asked = getattr(entry.analyses, name) is not None
        if asked and analysis(name).bearings and not spindle.bearings:
            faults.at_key(root, ("analyses", name), "needs bearings: this spindle has none")
    if entry.analyses.frf is not None:
        frf(entry.analyses.frf, spindle, points, supports, root, faults)
    if entry.analyses.stiffness is not None:
        _stiffness(entry.analyses.stiffness, points, spindle, root, faults)
        _one_plane(supports, root, faults)
    if entry.analyses.section_forces is not None:
        section_forces(entry, spindle, tool, root, faults)
    unbalance(entry, spindle, tool, root, faults)
    if spindle.bearings:
        sideways(entry, supports, root, faults)
    if not faults:
        elements(entry, spindle, tool, root, faults)


def _known_there(
    entry: CaseEntry, supports: Sequence[LinearSupport], root: Node, faults: Faults
) -> None:
    """Tables of supports reach over the speeds of the case."""
    for each in supports:
        for sentence in each.unknown_at(values(entry.speeds)):
            faults.at(root, ("speeds",), sentence)


def _supports(spindle: SpindleEntry) -> list[LinearSupport]:
    """The supports without those whose faults are reported already."""
    found = []
    for entry in spindle.supports:
        with suppress(InvalidInput):
            found.append(support(entry))
    return found


def _one_plane(supports: list[LinearSupport], root: Node, faults: Faults) -> None:
    """The radial stiffness is solved in plane y: no support may couple it to other motions."""
    for held in supports:
        across = [entry_name(*ends) for ends in held.out_of_plane]
        if across:
            faults.at_key(
                root,
                ("analyses", "stiffness"),
                f"support '{held.name}' couples plane y or the axis to other motions "
                f"({', '.join(across)}): the radial stiffness is solved in plane y alone; ask frf "
                "at a low frequency instead",
            )


def _elements(
    entry: CaseEntry, spindle: SpindleEntry, tool: ToolEntry | None, root: Node, faults: Faults
) -> None:
    """Not more elements than a run can solve."""
    longest = entry.conditions.element_length
    sections = [*spindle.shaft.sections, *(tool.sections if tool else [])]
    least = math.fsum(section.length for section in sections) / MOST_ELEMENTS
    if longest is not None and longest < least:
        way = ("conditions", "element_length")
        faults.at(
            root,
            way,
            f"more than {MOST_ELEMENTS} elements: given '{root.at(*way).raw}'; allowed: from "
            f"{format_quantity(least, 'mm')}",
        )


def _stiffness(
    entry: StiffnessEntry, points: list[str], spindle: SpindleEntry, root: Node, faults: Faults
) -> None:
    way = ("analyses", "stiffness")
    exists(entry.point, points, "point", root, (*way, "point"), faults)
    sleeves = [sleeve.name for sleeve in spindle.sleeves]
    for name in entry.second_stop:
        exists(name, sleeves, "sleeve", root, (*way, "second_stop", name), faults)
