"""Reads a case and the models it names, and checks each alone and against the others."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from rotordyn.analyses.frf.spec import MeasuredResponse
from rotordyn.case import expand
from rotordyn.case.checks import bearing as check_bearing
from rotordyn.case.checks import case as check_case
from rotordyn.case.checks import spindle as check_spindle
from rotordyn.case.checks.measured import measured
from rotordyn.case.faults import Faults
from rotordyn.case.node import Node
from rotordyn.case.schema.bearing import BearingEntry, entry_of, kind_in
from rotordyn.case.schema.case import CaseEntry
from rotordyn.case.schema.shaft import ToolEntry
from rotordyn.case.schema.spindle import SpindleEntry
from rotordyn.case.validate import validate

M = TypeVar("M", SpindleEntry, ToolEntry)


@dataclass(frozen=True, slots=True)
class Parts:
    """The entries of a case; a machine that is not named, or not usable, is None."""

    case: CaseEntry
    spindle: SpindleEntry | None
    tool: ToolEntry | None
    bearing: BearingEntry | None
    spindle_name: str
    tool_name: str
    measured: tuple[MeasuredResponse, ...] = ()


@dataclass(frozen=True, slots=True)
class _Trees:
    spindle: Node | None
    tool: Node | None
    bearing: Node | None


def read_parts(root: Node, reader: expand.Reader) -> Parts | None:
    """The parts of the case in ``root``; use them only if ``reader.faults`` stays empty."""
    check_case.machine_named(root, reader.faults)
    case = validate(CaseEntry, root, reader.faults)
    trees = _expanded(root, reader)
    spindle = _entry(SpindleEntry, trees.spindle, reader.faults)
    tool = _entry(ToolEntry, trees.tool, reader.faults)
    bearing = None
    if trees.bearing is not None:
        kind = entry_of(kind_in(trees.bearing.plain()))
        bearing = validate(kind, trees.bearing, reader.faults)
    if spindle is not None and trees.spindle is not None:
        check_spindle.spindle(spindle, trees.spindle, tool, reader.faults)
    if tool is not None and trees.tool is not None:
        check_spindle.tool(tool, trees.tool, spindle, reader.faults)
    if bearing is not None and trees.bearing is not None:
        check_bearing.geometry(bearing, trees.bearing, (), reader.faults)
    if case is None:
        return None
    check_case.questions(case, root, reader.faults)
    if spindle is not None and (tool is not None or root.child("tool") is None):
        check_case.against_machine(case, spindle, tool, root, reader.faults)
    names = (_name(trees.spindle), _name(trees.tool))
    return Parts(case, spindle, tool, bearing, *names, measured(case, root, reader))


def _expanded(root: Node, reader: expand.Reader) -> _Trees:
    override = root.child("override")
    spindle, tool, bearing = (root.child(key) for key in ("spindle", "tool", "bearing"))
    return _Trees(
        spindle=expand.spindle(spindle, override, reader) if spindle else None,
        tool=expand.tool(tool, reader) if tool else None,
        bearing=expand.bearing(bearing, (override,), reader) if bearing else None,
    )


def _entry(model: type[M], tree: Node | None, faults: Faults) -> M | None:
    return None if tree is None else validate(model, tree, faults)


def _name(tree: Node | None) -> str:
    return Path(tree.file).stem if tree else ""
