"""Loads of a case against its machine, and elements against what is asked of them."""

from __future__ import annotations

from rotordyn.case.build.questions import conditions, questions
from rotordyn.case.build.questions import section_forces as built
from rotordyn.case.build.spindle import spindle as machine
from rotordyn.case.build.spindle import tool as clamped
from rotordyn.case.build.sweep import values
from rotordyn.case.checks.rotor import reaches
from rotordyn.case.checks.shaft import span
from rotordyn.case.faults import Faults
from rotordyn.case.loads import (
    Rotors,
    misplaced,
    misplaced_unbalance,
    overheld,
    rotors_of,
    unheld,
)
from rotordyn.case.node import Node
from rotordyn.case.schema.case import CaseEntry
from rotordyn.case.schema.shaft import ToolEntry
from rotordyn.case.schema.spindle import SpindleEntry
from rotordyn.machine.rotor import Place
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import SPINDLE

WAY, UNBALANCE = ("analyses", "section_forces"), ("analyses", "unbalance")


def section_forces(
    entry: CaseEntry, spindle: SpindleEntry, tool: ToolEntry | None, root: Node, faults: Faults
) -> None:
    """Places exist; where nothing else is wrong, the shaft is no free body under its loads."""
    asked, own = entry.analyses.section_forces, entry.conditions
    if asked is None:
        return
    points, reach = _places(spindle, tool)
    otherwise = bool(spindle.bearings or spindle.drawbar or own.axial_force or own.tension)
    for way, sentence in misplaced(asked, points, reach, own.gravity, otherwise=otherwise):
        faults.at(root, (*WAY, *way), sentence)
    if faults:
        return
    whole = _whole(spindle, tool)
    for sentence in overheld(whole, conditions(own)):
        faults.at(root, ("conditions", "rotor"), sentence)
    for way, sentence in unheld(built(asked), whole, conditions(own)):
        faults.at(root, (*WAY, *way), sentence)


def unbalance(
    entry: CaseEntry, spindle: SpindleEntry, tool: ToolEntry | None, root: Node, faults: Faults
) -> None:
    """Points and places exist, and planes of a grade are of use."""
    asked = entry.analyses.unbalance
    if asked is None:
        return

    known = _rotors(spindle, tool) if faults else rotors_of(_whole(spindle, tool))
    for way, sentence in misplaced_unbalance(asked, known):
        faults.at(root, (*UNBALANCE, *way), sentence)


def elements(
    entry: CaseEntry, spindle: SpindleEntry, tool: ToolEntry | None, root: Node, faults: Faults
) -> None:
    """Elements of a given length carry what is asked; nothing else may be wrong."""
    if entry.conditions.element_length is None:
        return
    from rotordyn.analyses.resolution import beyond_elements

    own, asked = conditions(entry.conditions), questions(entry.analyses)
    top = max(values(entry.speeds), default=0.0)
    for sentence in beyond_elements(_whole(spindle, tool), own, asked, top):
        way = ("conditions", "element_length")
        faults.at(root, way, f"{sentence}: given '{root.at(*way).raw}'")


def _rotors(spindle: SpindleEntry, tool: ToolEntry | None) -> Rotors:
    """What is known of rotors whose files have faults: not where their centres of gravity are."""
    points, reach = _places(spindle, tool)
    places = {name: Place(SPINDLE, x) for name, x in points.items()}
    for rotor in spindle.rotors:
        places |= {f"{rotor.name}.{n}": Place(rotor.name, x) for n, x in rotor.points.items()}
    ratio = {SPINDLE: 1.0} | {rotor.name: rotor.speed_ratio for rotor in spindle.rotors}
    return Rotors(places, {SPINDLE: reach, **reaches(spindle)}, ratio, {})


def _places(
    spindle: SpindleEntry, tool: ToolEntry | None
) -> tuple[dict[str, float], tuple[float, float]]:
    """Points by name, and both ends of the shaft with its tool [m]."""
    start, end = span(spindle.shaft.start, spindle.shaft.sections)
    points = dict(spindle.points)
    if tool is not None:
        start -= span(0.0, tool.sections)[1]
        points |= tool.points
    return points, (start, end)


def _whole(spindle: SpindleEntry, tool: ToolEntry | None) -> Spindle:
    """The machine of entries without faults."""
    whole = machine(spindle, "")
    return whole if tool is None else whole.with_tool(clamped(tool, ""))
