"""A case written as a file: the file it was read from, with other values at some paths."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import yaml

from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput

MACHINES = ("spindle", "bearing")
COMPARED = ("compare", "tools")


def write_changed(
    case: Case, changes: Mapping[str, Any], path: Path, *, title: str, home: Path | None = None
) -> None:
    """Write the file of ``case`` with ``changes`` to ``path``; what it compares is left out.

    ``changes``: dotted paths, as of ``vary``, to what a file says there. ``home``: the folder that
    it is for, from which files are named where one can; by default they have their whole paths.

    Raises
    ------
    InvalidInput : the case was read from no file, or the new one cannot be written
    """
    if not case.files:
        raise InvalidInput(f"case {case.name}: was read from no file, so that it cannot be written")
    source = case.files[0]
    held = yaml.safe_load(source.read_text(encoding="utf-8"))
    whole = {k: _placed(v, source.parent) for k, v in held.items() if k not in COMPARED}
    whole["title"] = title
    for dotted, value in changes.items():
        room, _, rest = dotted.partition(".")
        if room in MACHINES and rest:
            whole.setdefault("override", {})[rest] = value
        else:
            _put(whole, dotted.split("."), value)
    held = whole if home is None else _near(whole, home.resolve())
    text = yaml.safe_dump(held, sort_keys=False, allow_unicode=True, width=100)
    try:
        path.write_text(text, encoding="utf-8", newline="\n")
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be written: {error.strerror}") from None


def _put(whole: dict[str, Any], steps: list[str], value: Any) -> None:
    for step in steps[:-1]:
        if not isinstance(whole.get(step), dict):
            whole[step] = {}
        whole = whole[step]
    whole[steps[-1]] = value


def _near(value: Any, home: Path) -> Any:
    """Files of whole paths named from ``home``; not those on another drive (Windows)."""
    if isinstance(value, dict):
        return {key: _near(each, home) for key, each in value.items()}
    if isinstance(value, list):
        return [_near(each, home) for each in value]
    if isinstance(value, str) and os.path.isabs(value) and os.path.isfile(value):
        try:
            return Path(os.path.relpath(value, home)).as_posix()
        except ValueError:
            return value
    return value


def _placed(value: Any, beside: Path) -> Any:
    """Names of files beside the old file, from anywhere."""
    if isinstance(value, dict):
        return {key: _placed(each, beside) for key, each in value.items()}
    if isinstance(value, list):
        return [_placed(each, beside) for each in value]
    if isinstance(value, str) and Path(value).suffix and (beside / value).is_file():
        return str((beside / value).resolve())
    return value
