"""Replaces the names of models in a file by the contents of their files."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from bearings.materials import Material
from rotordyn.case.document import read_document
from rotordyn.case.faults import Faults
from rotordyn.case.keys import COMMON, bearing_class, keys_of, kinds_with
from rotordyn.case.library import find
from rotordyn.case.named_models import MODELS, Way, ways_to
from rotordyn.case.node import UNKNOWN, Node, matching, merged
from rotordyn.case.override import apply
from rotordyn.case.reading import spread
from rotordyn.case.table import tabled
from rotordyn.errors import InvalidInput
from rotordyn.machine.flexible_rings import SIZES
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.tool import Tool


@dataclass
class Reader:
    """Reader of the files of one case, each read once.

    ``folders``: path of each file by its printed name; its references are relative to it.
    """

    faults: Faults
    contents: dict[Path, bytes] = field(default_factory=dict)
    folders: dict[str, Path] = field(default_factory=dict)
    trees: dict[Path, Node | None] = field(default_factory=dict)

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
        try:
            path = find(kind, name, self.folders[reference.file])
        except InvalidInput as error:
            self.faults.at(reference, str(error))
            return None
        root = self.document(path) if self._exists(path, reference) else None
        return root and replace(root, named=reference)

    def named(self, kind: type, node: Node) -> Node | None:
        """Mapping of a model of this ``kind``: the node itself, or that of the file it names."""
        return node if isinstance(node.value, dict) else self.model(MODELS[kind], node)

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

    def put(turn: int) -> None:
        changes = {path: value for path, value in override.items() if _turn(path) == turn}
        apply(changes, root, reader.faults)

    put(0)
    _fill(root, Spindle, reader)
    for seat in root.listed("bearings"):
        bearing_of_seat(seat, reader, root.child("bearing_override"))
    put(1)
    for kind, way in _SHARING.items():
        if (holder := root.child(*way)) is not None:
            spread(kind, holder)
    put(2)
    for support in root.listed("supports"):
        _table_of_support(support, reader)
    return root


_SHARING = {Spindle: (), Shaft: ("shaft",)}  # descriptions whose items share values, their path
_INNER = [("bearings", "*", "model")] + [
    (*way, *common.fills) for kind, way in _SHARING.items() for common in COMMON[kind]
]


def _turn(path: str) -> int:
    """Order in which an override is applied: 0, before models are filled in; 1, inside a material;
    2, inside a bearing model or a shared value, after overrides for all items."""
    if _leads(path, _INNER):
        return 2
    return int(_leads(path, ways_to(Material, Spindle)))


def _leads(path: str, ways: Iterable[Way]) -> bool:
    """Whether a path continues inside the value at the end of one of ``ways``."""
    steps = path.split(".")
    return any(
        len(steps) > len(way)
        and all(key in ("*", step) for key, step in zip(way, steps, strict=False))
        for way in ways
    )


def tool(reference: Node, override: Mapping[str, Node], reader: Reader) -> Node | None:
    """Tree of the tool with its materials filled in, and overrides."""
    root = reader.model("tools", reference)
    if root is not None:
        _fill(root, Tool, reader)
        apply(override, root, reader.faults)
    return root


def ring_sizes(case: Node, model: Node | None) -> None:
    """Copy ring sizes from the model of a single bearing to its flexible rings."""
    rings = case.child("analyses", "bearing", "flexible_rings")
    if model is None or rings is None or not isinstance(rings.value, dict):
        return
    for size in SIZES:
        known = model.child(size)
        if known is not None:
            rings.value.setdefault(size, known.copy())


def bearing(
    reference: Node, overrides: Iterable[Mapping[str, Node]], reader: Reader
) -> Node | None:
    """Tree of the bearing model with overrides and materials filled in."""
    root = reader.model("bearings", reference)
    if root is None:
        return None
    for changes in overrides:
        apply(changes, root, reader.faults)
    _forget_nulls(root)
    _fill(root, _kind_of(root), reader)
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
    if override is not None:
        seat.value["model_override"] = override
    if (reference := seat.child("model")) is not None:
        _set(seat, "model", bearing(reference, (seat.entries("model_override"),), reader))


def _table_of_support(support: Node, reader: Reader) -> None:
    reference = support.child("table")
    if reference is None or not isinstance(reference.value, str):
        return
    path = reader.beside(reference)
    if path is None:
        support.value["table"] = replace(reference, value=UNKNOWN)
        return
    tabled(support, path, reader.faults, reader.contents)


def _fill(root: Node, kind: Any, reader: Reader) -> None:
    """Fill in the materials that a file of this ``kind`` names, for overrides within them."""
    for *way, key in ways_to(Material, kind):
        for holder in matching(root, tuple(way)):
            named = holder.child(key)
            if named is not None and named.value is not UNKNOWN:
                _set(holder, key, reader.model(MODELS[Material], named))


def _set(holder: Node, key: str, model: Node | None) -> None:
    reference = holder.value[key]
    holder.value[key] = model or replace(reference, value=UNKNOWN)
