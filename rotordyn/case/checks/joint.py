"""Joints: each gives way somewhere, lies between two parts, and suits the questions."""

from __future__ import annotations

from collections.abc import Sequence

from rotordyn.case.build.joint import springs
from rotordyn.case.checks.names import unique
from rotordyn.case.faults import Faults
from rotordyn.case.node import Node
from rotordyn.case.schema.case import CaseEntry
from rotordyn.case.schema.joint import JointEntry
from rotordyn.case.schema.shaft import ToolEntry
from rotordyn.case.schema.spindle import SpindleEntry
from rotordyn.machine.joint import joint_faults
from rotordyn.machine.station import SLACK, least_part
from rotordyn.scene.on_joints import obstacles_of_joints
from rotordyn.units import format_quantity


def joints(
    entries: Sequence[JointEntry],
    reach: tuple[float, float],
    taken: Sequence[JointEntry],
    root: Node,
    faults: Faults,
) -> None:
    """All checks of the joints of a file; those ``taken`` are of the other file."""
    unique([joint.name for joint in entries], root, ("joints",), faults)
    low, high = reach
    least = least_part(low, high)
    for index, joint in enumerate(entries):
        way = ("joints", index)
        for sentence in joint_faults(springs(joint)):
            faults.at(root, way, sentence)
        if not low + least < joint.x < high - least and joint.x == joint.x:
            given = root.at(*way, "x").raw
            ends = [format_quantity(x, "mm") for x in reach]
            message = f"joins no two parts: given '{given}'; allowed: between {' and '.join(ends)}"
            faults.at(root, (*way, "x"), message)
        for other in (*entries[:index], *taken):
            if abs(other.x - joint.x) <= SLACK:
                faults.at(root, (*way, "x"), f"joint '{other.name}' is at the same station")
            elif abs(other.x - joint.x) < least:
                message = f"joint '{other.name}' is nearer than {least:.3g} m: make them one"
                faults.at(root, (*way, "x"), message)
            elif other.name == joint.name and other in taken:
                faults.at(root, (*way, "name"), f"name already taken: '{joint.name}'")


def on_joints(
    entry: CaseEntry, spindle: SpindleEntry, tool: ToolEntry | None, root: Node, faults: Faults
) -> None:
    """The questions and conditions of a case take joints."""
    if spindle.joints or (tool is not None and tool.joints):
        for way, sentence in obstacles_of_joints(entry.analyses.model_fields_set):
            faults.at_key(root, way, sentence)
