"""Read machines: a spindle with the tool in its nose, or a single bearing."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from bearings.bearing import BallBearing
from rotordyn.case.arranged import arrange
from rotordyn.case.faults import Faults
from rotordyn.case.keys import COMMON
from rotordyn.case.node import Node, merged
from rotordyn.case.reading import Reading
from rotordyn.description import unchecked
from rotordyn.machine.spindle import OF_TOOL, Spindle
from rotordyn.machine.tool import Tool


def named_once(root: Node, faults: Faults) -> None:
    """Report a case without exactly one of spindle and bearing, and a tool without spindle."""
    spindle, bearing = (root.child(key) for key in ("spindle", "bearing"))
    if spindle is None and bearing is None:
        faults.missing(root, "spindle", "missing key: a case needs a spindle, or a bearing")
    if spindle is not None and bearing is not None:
        key = "spindle" if spindle.path.startswith("compare.") else "bearing"
        faults.at_key(root.at(key), "a case has either a spindle or a bearing: given both")
    if root.child("tool") is not None and spindle is None:
        faults.at_key(root.at("tool"), "a tool needs a spindle: given none")


def read_spindle(
    reading: Reading, tree: Node, tool: Node | None
) -> tuple[Spindle, Tool | None, Node]:
    """Read the spindle in ``tree``, with a tool in its nose; return spindle, tool and the tree of
    both."""
    arrange(tree, reading.faults)
    with unchecked():
        values = reading.fields(Spindle, tree) | {"name": Path(tree.file).stem}
        made = reading.made(Spindle, values, tree)
        _pushed(reading, tree, made)
        _of_bearings(reading, tree)
        if tool is None:
            return made, None, tree
        clamped: Tool = reading.value(Tool, tool)
        for path, sentence in clamped.faults_in(made.shaft.start, made.points):
            reading.at(tool, path, sentence)
        made, tree = made.with_tool(clamped), _clamped(tree, tool)
        if not reading.faults:
            for path, sentence in made._faults():
                reading.at(tree, path, sentence)
    return made, clamped, tree


def _clamped(spindle: Node, tool: Node) -> Node:
    """Merge the tool's sections, masses, points and joints into the tree of a spindle."""
    content: dict[str, Any] = dict(spindle.value)
    if shaft := spindle.entries("shaft"):
        sections = merged(tool.child("sections"), shaft.get("sections"))
        content["shaft"] = replace(content["shaft"], value={**shaft, "sections": sections})
    for key in (*OF_TOOL, "points"):
        content[key] = merged(spindle.child(key), tool.child(key))
    return replace(spindle, value={key: node for key, node in content.items() if node is not None})


def _of_bearings(reading: Reading, tree: Node) -> None:
    """Report values for all bearings if the spindle has none."""
    bearings = tree.child("bearings")
    if bearings is not None and bearings.value:
        return
    for common in COMMON[Spindle]:
        given = tree.child(*common.keys)
        if given is not None and given.value is not None:
            reading.faults.at_key(given, "needs bearings, and this spindle has none: leave it out")


def _pushed(reading: Reading, tree: Node, made: Spindle) -> None:
    """Report a bearing for both thrust directions on a sleeve without a stated thrust: the spring
    of the sleeve pushes one way."""
    on_sleeves = {name for sleeve in made.sleeves for name in sleeve.bearings}
    for index, seat in enumerate(made.seats):
        bearing: object = seat.bearing
        both = isinstance(bearing, BallBearing) and bearing.both_ways
        node = tree.child("bearings", index)
        if both and seat.name in on_sleeves and node is not None and node.child("thrust") is None:
            reading.faults.missing(
                node,
                "thrust",
                "missing key: the spring of its sleeve pushes in one direction; allowed: +x, -x, "
                "the direction in which the shaft pushes the inner ring against the spring",
            )
