"""Replaces the names of models in a file by what their files hold."""

from __future__ import annotations

import os
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path

from bearings.kinds import KINDS
from rotordyn import units
from rotordyn.case.document import read_bytes, read_document
from rotordyn.case.faults import Faults
from rotordyn.case.keys import COMMON, ModelFiles, bearing_class, keys_of, kinds_with
from rotordyn.case.library import UnknownModel, find
from rotordyn.case.node import UNKNOWN, Node, matching
from rotordyn.case.override import apply
from rotordyn.case.reading import Reading, exact
from rotordyn.case.reduced import NoModel, ReducedModel
from rotordyn.case.table import tabled
from rotordyn.machine.assembly import unknown
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.spindle import Spindle

_MATERIALS_OF_BEARING = (("ball_material",), ("ring_material",))
_MATERIALS_OF_SEAT = tuple(("model", *way) for way in _MATERIALS_OF_BEARING)
_MATERIALS_OF_SPINDLE = (
    ("shaft", "material"),
    ("shaft", "sections", "*", "material"),
    ("discs", "*", "material"),
    ("fits", "housing_material"),
    ("bearings", "*", "fits", "housing_material"),
    ("rotors", "*", "shaft", "material"),
    ("rotors", "*", "shaft", "sections", "*", "material"),
    ("rotors", "*", "discs", "*", "material"),
)
_WORKPIECES = (("analyses", "stability_lobes", "workpiece"),)
_MEASURED_SPINDLES = tuple(
    ("analyses", name, "measured_spindle") for name in ("frf", "stability_lobes")
)
_MATERIALS_OF_TOOL = (("material",), ("sections", "*", "material"))


@dataclass
class Reader:
    """Reads the files of one case, each once.

    ``folders``: of each file as printed, the path that its own references are relative to.
    """

    faults: Faults
    contents: dict[Path, bytes] = field(default_factory=dict)
    folders: dict[str, Path] = field(default_factory=dict)
    trees: dict[Path, Node | None] = field(default_factory=dict)

    def document(self, path: Path) -> Node | None:
        """A tree of the file, free to be changed; None where the file cannot be used."""
        if path not in self.trees:
            self.trees[path] = read_document(path, self.faults, self.contents)
        root = self.trees[path]
        if root is None:
            return None
        self.folders[root.file] = path
        return root.copy()

    def model(self, kind: str, reference: Node) -> Node | None:
        """What ``reference`` names or holds: a mapping in place is taken as it is."""
        if isinstance(reference.value, dict):
            return reference
        name = _named(reference)
        if name is None:
            self.faults.at(reference, (), "not a model: a name, a path or a mapping is needed")
            return None
        try:
            path = find(kind, name, self.folders[reference.file])
        except UnknownModel as error:
            self.faults.at(reference, (), str(error))
            return None
        return self._referred(path, reference)

    def _referred(self, path: Path, reference: Node) -> Node | None:
        if not os.path.exists(path):
            self.faults.at(reference, (), f"no such file: given '{reference.value}'")
            return None
        return self.document(path)


def _named(reference: Node) -> str | None:
    """The name of a model; makers' names may be numbers: ``bearing: 6012``."""
    if isinstance(reference.value, int) and not isinstance(reference.value, bool):
        return reference.raw
    return reference.value if isinstance(reference.value, str) else None


def spindle(reference: Node, override: Node | None, reader: Reader) -> Node | None:
    """The spindle with overrides, bearing models and materials filled in."""
    root = reader.model("spindles", reference)
    if root is None:
        return None
    whole = _override(root, override, reader)
    _fill(root, _MATERIALS_OF_SPINDLE, "materials", reader)
    for holder in matching(root, ("bearings", "*")):
        if id(holder) not in whole:
            _bearing_of_seat(root, holder, reader)
        _fill(holder, _MATERIALS_OF_SEAT, "materials", reader)  # named by an override of its model
    for holder in matching(root, ("supports", "*")):
        _table_of_support(holder, reader)
    for holder in matching(root, ("housings", "*")):
        _model_of_housing(holder, reader)
    return root


def _override(root: Node, override: Node | None, reader: Reader) -> set[int]:
    """Applies the overrides of a case; those of what stands for all items before single ones.

    Gives the seats (by id) whose models are filled in already, because a path leads through them.
    """
    whole: set[int] = set()
    if override is None or not isinstance(override.value, dict):
        return whole
    shared = [*(fills for _, fills in _SHARED), ("bearings", "*", "model")]
    single = {p for p in override.value if any(_leads(p.split("."), fills) for fills in shared)}
    for paths in (override.value.keys() - single, single):
        values = {path: value for path, value in override.value.items() if path in paths}
        for path in values:
            _share(root, path.split("."))
            _open(root, path.split("."), reader, whole)
        apply(replace(override, value=values), root, reader.faults)
    return whole


def _leads(steps: list[str], fills: tuple[str, ...]) -> bool:
    """A path goes on within what an item shares with others."""
    alike = all(fill in ("*", step) for fill, step in zip(fills, steps, strict=False))
    return alike and len(steps) > len(fills)


def _share(root: Node, steps: list[str]) -> None:
    """Gives an item, on a path that leads into what it shares with others, a value of its own."""
    for keys, fills in _SHARED:
        source = exact(root, keys)
        if source is None or not _leads(steps, fills):
            continue
        *way, _, key = fills
        listed, called = exact(root, tuple(way)), steps[len(way)]
        for holder in listed.value if listed and isinstance(listed.value, list) else ():
            if isinstance(holder.value, dict) and called in ("*", holder.name):
                holder.value.setdefault(key, source.copy())


_SHARED = [
    ((*way, *common.keys), (*way, *common.fills))
    for way, kind in (((), Spindle), (("shaft",), Shaft))
    for common in COMMON[kind]
]


def _open(root: Node, steps: list[str], reader: Reader, whole: set[int]) -> None:
    """Fills in the models that a path leads into, as ``bearings.a.model.contact_angle``.

    ``whole``: seats (by id) whose models are filled in.
    """
    if len(steps) > 3 and steps[0] == "bearings" and steps[2] == "model":
        for seat in matching(root, ("bearings", "*")):
            if steps[1] in ("*", seat.name) and id(seat) not in whole:
                _bearing_of_seat(root, seat, reader)
                whole.add(id(seat))
    elif "material" in steps[:-1]:
        place = steps.index("material")
        for *way, _ in _MATERIALS_OF_SPINDLE:
            fits = len(way) == place and all(
                a in ("*", b) for a, b in zip(way, steps, strict=False)
            )
            for holder in matching(root, tuple(way)) if fits else ():
                if steps[place - 1] in ("*", holder.name, way[-1]):
                    _fill(holder, (("material",),), "materials", reader)


def tool(reference: Node, reader: Reader) -> Node | None:
    """The tool with its materials filled in."""
    root = reader.model("tools", reference)
    if root is not None:
        _fill(root, _MATERIALS_OF_TOOL, "materials", reader)
    return root


def asked(root: Node, reader: Reader) -> None:
    """Fills in the models that analyses of a case name; one that cannot be read, whose fault is
    reported, by any, so that its absence is not reported as well."""
    _fill(root, _WORKPIECES, "workpieces", reader)
    for place in _MEASURED_SPINDLES:
        for holder in matching(root, place):
            if (blank := holder.child("blank")) is not None:
                _set(holder, "blank", tool(blank, reader))
    for *way, key in _WORKPIECES:
        for holder in matching(root, tuple(way)):
            given = holder.child(key)
            if given is not None and given.value is UNKNOWN:
                any_pair = {
                    name: replace(given, value="1 MPa") for name in ("tangential", "radial")
                }
                pairs = replace(given, value=[replace(given, value=any_pair)])
                holder.value[key] = replace(given, value={"coefficients": pairs})


def bearing(reference: Node, override: tuple[Node | None, ...], reader: Reader) -> Node | None:
    """The bearing model with overrides and materials filled in."""
    root = reader.model("bearings", reference)
    if root is None:
        return None
    for changes in override:
        apply(changes, root, reader.faults)
    kind = root.child("kind")
    if kind is not None and kind.value not in tuple(KINDS):
        for why in unknown("kind of bearing", kind.raw or units.shown(kind.plain()), KINDS):
            reader.faults.at(root, ("kind",), why)
        return None
    _forget_nulls(root)
    _fill(root, _MATERIALS_OF_BEARING, "materials", reader)
    return root


def _forget_nulls(bearing: Node) -> None:
    """Takes out keys of other kinds that an override has set to null."""
    kind = bearing.child("kind")
    kept = {field.keys for field in keys_of(bearing_class(kind.value if kind else None))}
    for key in [k for k, v in bearing.items() if v.value is None and v.file != bearing.file]:
        if (key,) not in kept and kinds_with(str(key)):
            del bearing.value[key]


def _bearing_of_seat(root: Node, seat: Node, reader: Reader) -> None:
    reference = seat.child("model")
    if reference is not None:
        override = (root.child("bearing_override"), seat.child("model_override"))
        _set(seat, "model", bearing(reference, override, reader))


def _table_of_support(support: Node, reader: Reader) -> None:
    reference = support.child("table")
    if reference is None or not isinstance(reference.value, str):
        return
    path = _beside(reference, reader)
    if path is None:
        support.value["table"] = replace(reference, value=UNKNOWN)
        return
    tabled(support, path, reader.faults, reader.contents)


def _beside(reference: Node, reader: Reader) -> Path | None:
    """The file that ``reference`` names, relative to the one it is written in."""
    path = reader.folders[reference.file].parent / Path(reference.value).expanduser()
    if os.path.exists(path):
        return path
    reader.faults.at(reference, (), f"no such file: given '{reference.value}'")
    return None


def _model_of_housing(housing: Node, reader: Reader) -> None:
    reference = housing.child("model")
    if reference is not None:
        model = _reduced(reference, reader)
        housing.value["model"] = replace(reference, value=UNKNOWN if model is None else model)


def _reduced(reference: Node, reader: Reader) -> ReducedModel | None:
    """The reduced model of a housing, from an archive or from Matrix Market files."""
    from rotordyn.case.reduced_files import from_archive, from_market

    if isinstance(reference.value, dict):
        before = len(reader.faults.reported)
        files = Reading(reader.faults, {}).value(ModelFiles, reference)
        if len(reader.faults.reported) > before:
            return None
        raw = {}
        for name in ("mass", "stiffness", "damping"):
            if getattr(files, name):
                content = _raw(reference.at(name), reader)
                if content is None:
                    return None
                raw[name] = content
        read = partial(from_market, raw, files.places)
    elif isinstance(reference.value, str):
        content = _raw(reference, reader)
        if content is None:
            return None
        read = partial(from_archive, content)
    else:
        reader.faults.at(reference, (), "not a model: a .npz file or a mapping of files is needed")
        return None
    try:
        return read()
    except NoModel as error:
        reader.faults.at(reference, (), f"no reduced model: {error}")
        return None


def _raw(reference: Node, reader: Reader) -> bytes | None:
    path = _beside(reference, reader)
    return None if path is None else read_bytes(path, reader.faults, reader.contents)


def _fill(root: Node, places: tuple[tuple[str, ...], ...], kind: str, reader: Reader) -> None:
    for *way, key in places:
        for holder in matching(root, tuple(way)):
            reference = holder.child(key)
            if reference is not None and reference.value is not UNKNOWN:
                _set(holder, key, reader.model(kind, reference))


def _set(holder: Node, key: str, model: Node | None) -> None:
    reference = holder.value[key]
    holder.value[key] = model or replace(reference, value=UNKNOWN)
