"""Replaces the names of models in a file by the contents of their files."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from rotordyn.case.document import read_document
from rotordyn.case.faults import Faults
from rotordyn.case.keys import COMMON, MODELS, bearing_class, keys_of, kinds_with
from rotordyn.case.library import find
from rotordyn.case.node import UNKNOWN, Node, merged
from rotordyn.case.override import apply
from rotordyn.case.paths import within_tool
from rotordyn.case.reading import spread
from rotordyn.case.table import tabled
from rotordyn.errors import InvalidInput
from rotordyn.machine.flexible_rings import SIZES
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.tool import Tool

# Folder of the models that a key names, by the last word of the key (``ball_material``).
NAMED = {
    "material": "materials",
    "blank": "tools",
    "tool": "tools",
    "workpiece": "workpieces",
}


@dataclass
class Reader:
    """Reader of the files of one case, each read once.

    ``folders``: path of each file by its printed name; its references are relative to it.
    ``found``: paths of models by kind, name and the file that names them.
    """

    faults: Faults
    contents: dict[Path, bytes] = field(default_factory=dict)
    folders: dict[str, Path] = field(default_factory=dict)
    trees: dict[Path, Node | None] = field(default_factory=dict)
    found: dict[tuple[str, str, Path], Path] = field(default_factory=dict)

    def document(self, path: Path) -> Node | None:
        """Return a copy of the tree of a file; None if the file is unusable."""
        if path not in self.trees:
            self.trees[path] = read_document(path, self.faults, self.contents)
        root = self.trees[path]
        if root is None:
            return None
        self.folders[root.file] = path
        return root.copy()

    def model(self, kind: str, reference: Node) -> Node | None:
        """Return a copy of the tree that ``reference`` names or contains; variants share it."""
        if isinstance(reference.value, dict):
            return reference.copy()
        name = _named(reference)
        if name is None:
            self.faults.at(reference, "not a model: a name, a path or a mapping is needed")
            return None
        asked = kind, name, self.folders[reference.file]
        try:
            path = self.found[asked] = self.found.get(asked) or find(*asked)
        except InvalidInput as error:
            self.faults.at(reference, str(error))
            return None
        root = self.document(path) if self._exists(path, reference) else None
        return root and replace(root, named=reference)

    def named(self, kind: type, node: Node) -> Node | None:
        """Mapping of a model of this ``kind``: the node itself, or that of the file it names."""
        return node if isinstance(node.value, dict) else self.model(MODELS[kind], node)

    def opened(self, key: str, node: Node) -> Node:
        """What a path leads into at ``key``: the mapping of a model if it may be named there."""
        folder = NAMED.get(key.rpartition("_")[2])
        if not folder or isinstance(node.value, dict):
            return node
        return self.model(folder, node) or replace(node, value=UNKNOWN)

    def beside(self, reference: Node) -> Path | None:
        """Path of the file that ``reference`` names, relative to the file with the reference."""
        path = self.folders[reference.file].parent / Path(reference.value).expanduser()
        return path if self._exists(path, reference) else None

    def _exists(self, path: Path, reference: Node) -> bool:
        if os.path.exists(path):
            return True
        self.faults.at(reference, f"no such file: given '{reference.value}'")
        return False


def opened(path: Path) -> tuple[Node, Reader]:
    """Read a file; return its root and a reader for the files that it names.

    Raises
    ------
    InvalidInput : the file is unusable
    """
    reader = Reader(Faults())
    root = reader.document(path)
    if root is None:
        raise InvalidInput(reader.faults.reported)
    return root, reader


def _named(reference: Node) -> str | None:
    """Name of a model; designations may be numbers: ``bearing: 6012``."""
    if isinstance(reference.value, int) and not isinstance(reference.value, bool):
        return reference.raw
    return reference.value if isinstance(reference.value, str) else None


def spindle(reference: Node, override: Mapping[str, Node], reader: Reader) -> Node | None:
    """Tree of the spindle with overrides, bearing models and materials filled in."""
    root = reader.model("spindles", reference)
    if root is None:
        return None

    inner = {path: value for path, value in override.items() if leads_into(path, _INNER)}
    outer = {path: value for path, value in override.items() if path not in inner}
    apply(outer, root, reader.faults, reader.opened)
    for seat in root.listed("bearings"):
        bearing_of_seat(seat, reader, root.child("bearing_override"))
    for kind, way in _SHARING.items():
        if (holder := root.child(*way)) is not None:
            spread(kind, holder)
    apply(inner, root, reader.faults, reader.opened)
    for support in root.listed("supports"):
        _table_of_support(support, reader)
    return root


def of_tool(tool: Node, override: dict[str, Node], reader: Reader) -> None:
    """Make the changes of a spindle in the ``tool`` in its nose where they mean what is of it;
    those of nothing else are removed."""
    changes: dict[str, Node] = {}
    for path in [*override]:
        inner = within_tool(tuple(path.split("."))) or ("", "")
        items, name = tool.listed(inner[0]), inner[1]
        if name == "*" and items:
            changes[".".join(inner)] = override[path]
        elif name in [item.name for item in items]:
            changes[".".join(inner)] = override.pop(path)
    if any(leads_into(path, [each.fills for each in COMMON[Tool]]) for path in changes):
        spread(Tool, tool)
    apply(changes, tool, reader.faults, reader.opened)


_SHARING = {Spindle: (), Shaft: ("shaft",)}  # descriptions whose items share values, their path
_INNER = [("bearings", "*", "model")] + [
    (*way, *common.fills) for kind, way in _SHARING.items() for common in COMMON[kind]
]


def leads_into(path: str, ways: Iterable[Sequence[str]]) -> bool:
    """Whether a path leads into a bearing model or a shared value, which are filled in before."""
    steps = path.split(".")
    return any(
        len(steps) > len(way)
        and all(key in ("*", step) for key, step in zip(way, steps, strict=False))
        for way in ways
    )


def ring_sizes(case: Node, model: Node | None) -> None:
    """Copy ring sizes from the model of a single bearing to its flexible rings."""
    rings = case.child("analyses", "bearing", "flexible_rings")
    if model is None or rings is None or not isinstance(rings.value, dict):
        return
    for size in SIZES:
        known = model.child(size)
        if known is not None:
            rings.value.setdefault(size, known.copy())


def bearing(reference: Node, override: Mapping[str, Node], reader: Reader) -> Node | None:
    """Tree of the bearing model with overrides."""
    root = reader.model("bearings", reference)
    if root is None:
        return None
    apply(override, root, reader.faults, reader.opened)
    _forget_nulls(root)
    return root


def _kind_of(bearing: Node) -> Any:
    kind = bearing.child("kind")
    return bearing_class(None if kind is None else kind.value)


def _forget_nulls(bearing: Node) -> None:
    """Remove keys of other kinds that an override has set to null."""
    kept = {field.keys for field in keys_of(_kind_of(bearing))}
    for key in [k for k, v in bearing.items() if v.value is None and v.file != bearing.file]:
        if (key,) not in kept and kinds_with(str(key)):
            del bearing.value[key]


def bearing_of_seat(seat: Node, reader: Reader, shared: Node | None = None) -> None:
    """Fill in the model of a bearing on the shaft, with its overrides and ``shared`` ones."""
    override = merged(shared, seat.child("model_override"))
    if override is not None and isinstance(seat.value, dict):
        seat.value["model_override"] = override
    if (reference := seat.child("model")) is not None:
        model = bearing(reference, seat.entries("model_override"), reader)
        seat.value["model"] = model or replace(reference, value=UNKNOWN)


def _table_of_support(support: Node, reader: Reader) -> None:
    reference = support.child("table")
    if reference is None or not isinstance(reference.value, str):
        return
    path = reader.beside(reference)
    if path is None:
        support.value["table"] = replace(reference, value=UNKNOWN)
        return
    tabled(support, path, reader.faults, reader.contents)
