"""The door for case files: one call, either a whole case or every fault in it."""

from __future__ import annotations

import hashlib
import os
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from rotordyn.case.case import Case
from rotordyn.case.faults import Faults
from rotordyn.errors import Fault, InvalidInput

if TYPE_CHECKING:
    from rotordyn.case.parts import Parts
    from rotordyn.machine.spindle import Spindle


def load(path: str | Path) -> Case:
    """The case in a YAML file, with every model it names, in SI units.

    ``path`` may also be the name of a case that comes with rotordyn (``rotordyn.cases``).

    Raises InvalidInput with all faults of the case, its models and its overrides at once, in the
    order of their files and lines.
    """
    from rotordyn.case.expand import Reader
    from rotordyn.case.library import find_case
    from rotordyn.case.parts import read_parts
    from rotordyn.case.variants import variant_trees

    if not isinstance(path, str | os.PathLike):
        raise InvalidInput(f"load takes the path of a case file, or a name: got {path!r}")
    file = find_case(path if isinstance(path, str) else Path(path))
    reader = Reader(Faults())
    root = reader.document(file)
    parts = None if root is None else read_parts(root, reader)
    variants: dict[str, Parts | None] = {}
    if root is not None and not reader.faults:
        trees = variant_trees(root)
        for name, tree in trees.items():
            reader.faults.variant = name
            variants[name] = read_parts(tree, reader)
    if parts is None or reader.faults:
        raise InvalidInput(in_order(reader.faults.found))
    return _build(file, parts, variants, reader.contents)


def in_order(faults: list[Fault]) -> list[Fault]:
    """Faults by file, in the order the files were met, then by line."""
    files = [fault.file for fault in faults]
    return sorted(faults, key=lambda f: (files.index(f.file), f.line, f.column))


def _build(
    path: Path, parts: Parts, variants: dict[str, Parts | None], contents: dict[Path, bytes]
) -> Case:
    whole = _case(path.stem, parts, contents)
    made = {
        name: replace(_case(name, other, contents), title=_title(name, parts))
        for name, other in variants.items()
        if other is not None
    }
    return replace(whole, variants=made)


def _title(name: str, whole: Parts) -> str:
    """The title of a variant, or its name."""
    return whole.case.compare[name].title.strip() or name.replace("_", " ")


def _case(name: str, parts: Parts, contents: dict[Path, bytes]) -> Case:
    from rotordyn.case.build.bearing import bearing
    from rotordyn.case.build.questions import conditions, questions
    from rotordyn.case.build.spindle import references
    from rotordyn.case.build.sweep import values

    entry = parts.case
    machine = _machine(parts)
    return Case(
        name=name,
        title=entry.title,
        speeds=values(entry.speeds),
        analyses=questions(entry.analyses, parts.measured),
        conditions=conditions(entry.conditions),
        spindle=machine,
        bearing=bearing(parts.bearing) if parts.bearing else None,
        references=(machine.references if machine else ()) + references(entry.references),
        files=tuple(contents),
        digest=_digest(contents),
    )


def _machine(parts: Parts) -> Spindle | None:
    from rotordyn.case.build.spindle import spindle, tool

    if parts.spindle is None:
        return None
    machine = spindle(parts.spindle, parts.spindle_name)
    return machine.with_tool(tool(parts.tool, parts.tool_name)) if parts.tool else machine


def _digest(contents: dict[Path, bytes]) -> str:
    total = hashlib.sha256()
    for content in contents.values():
        total.update(hashlib.sha256(content).digest())
    return total.hexdigest()
