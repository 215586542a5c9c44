"""Read case files: either a complete case, or all of its faults."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from typing import Any

from bearings.bearing import BallBearing
from bearings.errors import shown
from rotordyn.case import expand
from rotordyn.case.asked import conflicts
from rotordyn.case.case import Case
from rotordyn.case.forms import reading_of
from rotordyn.case.library import find_case, sources_in
from rotordyn.case.machines import named_once, read_spindle
from rotordyn.case.node import Node
from rotordyn.case.variants import (
    from_the_top,
    of_machine,
    tools_compared,
    variant_trees,
    with_whole_conditions,
)
from rotordyn.description import Faults as Rules
from rotordyn.description import unchecked
from rotordyn.errors import InvalidInput
from rotordyn.machine.tool import Tool

MOST_VARIANTS = 200
# Keys that identify other kinds of files.
_OTHER_FILES = {
    "goals": "optimum",
    "vary": "study",
    "unknowns": "identification",
    "shaft": "spindle",
    "ball_diameter": "bearing",
    "young_modulus": "material",
    "sections": "tool",
}
_NAMED_BY = {kind: f"a case names it by {kind}: PATH" for kind in ("spindle", "bearing", "tool")}
_NAMED_BY["material"] = (
    "sections and discs of a spindle or tool name it by material: PATH, bearings by ring_material "
    "and ball_material"
)
_NAMED_BY |= {
    kind: f"it names a case, and is solved by rotordyn {command}"
    for kind, command in (
        ("optimum", "optimise"),
        ("study", "sweep"),
        ("identification", "identify"),
    )
}


def load(path: str | Path) -> Case:
    """The case in a YAML file, with every model it names, in SI units.

    ``path`` may also be the name of a case that comes with rotordyn (``rotordyn.cases``).

    Raises InvalidInput with all faults of the case, its models and its overrides at once, in the
    order of their files and lines.
    """
    if not isinstance(path, str | os.PathLike):
        raise InvalidInput(f"load takes the path of a case file, or a name: got {shown(path)}")
    file = find_case(path if isinstance(path, str) else Path(path))
    root, reader = expand.opened(file)
    of_tools = "tools" in root.entries()
    root = from_the_top(tools_compared(root, reader.faults), reader.faults)
    whole = _case(root, file.stem, reader)
    made: dict[str, Case] = {}
    if not reader.faults and (many := len(root.entries("compare"))) > MOST_VARIANTS:
        why = f"too many variants: given {many}; allowed: up to {MOST_VARIANTS}, more in a study "
        reader.faults.at_key(root.at("compare"), f"{why}(rotordyn sweep)")
    if not reader.faults:
        for name, tree in variant_trees(root).items():
            reader.faults.variant = name
            variant = _case(tree, name, reader)
            tool = reader.named(Tool, root.at("compare", name, "tool")) if of_tools else None
            title = (tool or tree).child("title")
            if variant is not None:
                written = str(title.value).strip() if title is not None else ""
                if of_tools and written in (other.title for other in made.values()):
                    written = f"{written}, {name}"
                made[name] = _with(variant, title=written or name.replace("_", " "))
        reader.faults.variant = ""
    if whole is not None and not reader.faults:
        for way, sentence in conflicts(whole, made):
            reading_of(reader).at(root, way, sentence)
    reader.faults.require_none(root.file)
    assert whole is not None
    read = {
        "files": tuple(reader.contents),
        "digest": _digest(reader.contents),
        "sources": dict(_sources(reader.trees)),
    }
    return _with(whole, variants={n: _with(v, **read) for n, v in made.items()}, **read)


def _sources(trees: Mapping[Path, Node | None]) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Yield name, title and sources of every file that names a source."""
    for path, root in trees.items():
        content = {} if root is None else root.plain()
        if sources := sources_in(content):
            title = str(content.get("title") or content.get("name") or path.stem)
            yield f"{path.parent.name}/{path.name}", (title, *sources)


def _with(case: Case, **changes: Any) -> Case:
    """Replace fields of a case to which no rule applies."""
    with unchecked():
        return replace(case, **changes)


def _case(root: Node, name: str, reader: expand.Reader) -> Case | None:
    """Read the case in ``root``; valid only if ``reader.faults`` stays empty."""
    faults = reader.faults
    if (other := _other_file(root.value)) and not reader.faults.variant:
        article = "an" if other[0] in "aeiou" else "a"
        faults.at(root, f"this is {article} {other} file, not a case: {_NAMED_BY[other]}")
        return None
    all_known = "references" in root.entries("override")  # also those of the machine
    override = of_machine(root, reader)
    named_once(root, faults)
    reading = reading_of(reader)
    tree = root
    spindle = bearing = fitted = None
    usable = False
    if (reference := root.child("spindle")) is not None:
        clamped = _clamped(root, override, reader)
        expanded = expand.spindle(reference, override, reader)
        usable = expanded is not None and (clamped is not None or root.child("tool") is None)
        if expanded is not None:
            spindle, fitted, machine = read_spindle(reading, expanded, clamped)
            tree = replace(root, value={**root.value, "spindle": machine})
    if (reference := root.child("bearing")) is not None:
        expanded = expand.bearing(reference, override, reader)
        bearing = None if expanded is None else reading.value(BallBearing, expanded)
        expand.ring_sizes(root, expanded)
        usable = usable or bearing is not None
    values = reading.fields(
        Case, with_whole_conditions(root), annotations={"spindle": Any, "bearing": Any}
    )
    given = () if spindle is None or all_known else spindle.references
    values |= {"name": name, "spindle": spindle, "bearing": bearing, "tool": fitted}
    values["references"] = given + values["references"]
    with unchecked():
        case = Case(**values)
    unclear = (case.spindle is None) == (case.bearing is None)  # neither or both given

    def report(rules: Rules) -> None:
        for path, sentence in rules:
            way = [*path]
            if way[:1] == ["references"] and len(way) > 1 and isinstance(way[1], int):
                way[1] -= len(given)  # those of the machine come first
            reading.at(root if way == ["spindle"] else tree, tuple(way), sentence)

    with unchecked():
        report(case.faults_alone() if unclear or not usable else case._faults())
    if not faults:
        report(case._last_faults())
    return case


def _clamped(root: Node, override: dict[str, Node], reader: expand.Reader) -> Node | None:
    """Tree of the tool in the nose, with its share of the changes of the spindle; None if none."""
    named = root.child("tool")
    tool = None if named is None else reader.named(Tool, named)
    if tool is not None:
        if "references" in override:
            tool.value.pop("references", None)  # those of the machine as a whole are given
        expand.of_tool(tool, override, reader)
    return tool


def _other_file(content: Mapping[str, object]) -> str:
    """Kind of file that a mapping belongs to, if it is not a case."""
    if "case" not in content and {"speeds", "analyses", "spindle", "bearing"} & {*content}:
        return ""
    return next((kind for key, kind in _OTHER_FILES.items() if key in content), "")


def _digest(contents: dict[Path, bytes]) -> str:
    parts = (sha256(content).digest() for content in contents.values())
    return sha256(b"".join(parts)).hexdigest()
