"""One model as a frozen description, from the library or from a file of one's own."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Literal, TypeVar, overload

from bearings.bearing import BallBearing
from bearings.materials import Material
from rotordyn.case import expand
from rotordyn.case.build import bearing as build_bearing
from rotordyn.case.build import spindle as build_spindle
from rotordyn.case.checks import bearing as check_bearing
from rotordyn.case.checks import spindle as check_spindle
from rotordyn.case.faults import Faults
from rotordyn.case.library import UnknownModel, find
from rotordyn.case.node import Node
from rotordyn.case.read import in_order
from rotordyn.case.schema.bearing import BearingEntry, entry_of, kind_in
from rotordyn.case.schema.material import MaterialEntry
from rotordyn.case.schema.shaft import ToolEntry
from rotordyn.case.schema.spindle import SpindleEntry
from rotordyn.case.shipped import known_kind
from rotordyn.case.validate import validate
from rotordyn.errors import InvalidInput
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.tool import Tool

Model = Spindle | Tool | BallBearing | Material
T = TypeVar("T")
E = TypeVar("E", SpindleEntry, ToolEntry, BearingEntry, MaterialEntry)


@overload
def model(kind: Literal["spindles"], reference: str | Path) -> Spindle: ...
@overload
def model(kind: Literal["tools"], reference: str | Path) -> Tool: ...
@overload
def model(kind: Literal["bearings"], reference: str | Path) -> BallBearing: ...
@overload
def model(kind: Literal["materials"], reference: str | Path) -> Material: ...
def model(kind: str, reference: str | Path) -> Model:
    """A model as a frozen description in SI units: by name from the library, or from a file.

    Parameters
    ----------
    kind : "spindles", "tools", "bearings" or "materials"
    reference : a name, or a path from the working directory (with a separator or ending in .yaml)

    Raises
    ------
    InvalidInput : no such kind or model; or all faults of the file, each with its line
    """
    root, reader = _document(known_kind(kind), reference)
    name = Path(root.file).stem
    if kind == "spindles":
        return build_spindle.spindle(_spindle(root, reader), name)
    if kind == "tools":
        return build_spindle.tool(_tool(root, reader), name)
    if kind == "bearings":
        return build_bearing.bearing(_bearing(root, reader))
    return build_bearing.material(_entry(MaterialEntry, root, reader))


def _document(kind: str, reference: object) -> tuple[Node, expand.Reader]:
    if not isinstance(reference, str | os.PathLike):
        raise InvalidInput(f"a model is called by its name or path: got {reference!r}")
    reader = expand.Reader(Faults())
    try:
        root = reader.document(find(kind, str(reference), Path("here")))
    except UnknownModel as error:
        raise InvalidInput(str(error)) from None
    return _whole(root, reader), reader


def _spindle(root: Node, reader: expand.Reader) -> SpindleEntry:
    tree = _whole(expand.spindle(root, None, reader), reader)
    entry = _entry(SpindleEntry, tree, reader)
    check_spindle.spindle(entry, tree, None, reader.faults)
    return _whole(entry, reader)


def _tool(root: Node, reader: expand.Reader) -> ToolEntry:
    tree = _whole(expand.tool(root, reader), reader)
    entry = _entry(ToolEntry, tree, reader)
    check_spindle.tool(entry, tree, None, reader.faults)
    return _whole(entry, reader)


def _bearing(root: Node, reader: expand.Reader) -> BearingEntry:
    tree = _whole(expand.bearing(root, (), reader), reader)
    entry: BearingEntry = _entry(entry_of(kind_in(tree.plain())), tree, reader)
    check_bearing.geometry(entry, tree, (), reader.faults)
    return _whole(entry, reader)


def _entry(shape: type[E], tree: Node, reader: expand.Reader) -> E:
    return _whole(validate(shape, tree, reader.faults), reader)


def _whole(found: T | None, reader: expand.Reader) -> T:
    """What was found, where nothing is wrong with it."""
    if found is None or reader.faults:
        raise InvalidInput(in_order(reader.faults.found))
    return found
