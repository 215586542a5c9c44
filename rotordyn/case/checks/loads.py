"""Static loads of a case against its machine."""

from __future__ import annotations

from rotordyn.case.build.questions import conditions
from rotordyn.case.build.questions import section_forces as built
from rotordyn.case.build.spindle import spindle as machine
from rotordyn.case.build.spindle import tool as clamped
from rotordyn.case.checks.shaft import span
from rotordyn.case.faults import Faults
from rotordyn.case.loads import misplaced, overheld, unheld
from rotordyn.case.node import Node
from rotordyn.case.schema.case import CaseEntry
from rotordyn.case.schema.shaft import ToolEntry
from rotordyn.case.schema.spindle import SpindleEntry

WAY = ("analyses", "section_forces")


def section_forces(
    entry: CaseEntry, spindle: SpindleEntry, tool: ToolEntry | None, root: Node, faults: Faults
) -> None:
    """Places exist; where nothing else is wrong, the shaft is no free body under its loads."""
    asked, own = entry.analyses.section_forces, entry.conditions
    if asked is None:
        return
    start, end = span(spindle.shaft.start, spindle.shaft.sections)
    points = dict(spindle.points)
    if tool is not None:
        start -= span(0.0, tool.sections)[1]
        points |= tool.points
    for way, sentence in misplaced(asked, points, (start, end), own.gravity):
        faults.at(root, (*WAY, *way), sentence)
    if faults:
        return
    whole = machine(spindle, "")
    if tool is not None:
        whole = whole.with_tool(clamped(tool, ""))
    for sentence in overheld(whole, conditions(own)):
        faults.at(root, ("conditions", "rotor"), sentence)
    for way, sentence in unheld(built(asked), whole, conditions(own)):
        faults.at(root, (*WAY, *way), sentence)
