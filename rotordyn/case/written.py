"""A case written as a file: the file it was read from, with other values at some paths."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import partial
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
    kept = {key: value for key, value in held.items() if key not in COMPARED}
    whole = _renamed(kept, partial(_placed, source.parent))
    whole["title"] = title
    for dotted, value in changes.items():
        room, _, rest = dotted.partition(".")
        if room in MACHINES and rest:
            whole.setdefault("override", {})[rest] = value
        else:
            _put(whole, dotted.split("."), value)
    held = whole if home is None else _renamed(whole, partial(_near, home.resolve()))
    text = yaml.safe_dump(held, sort_keys=False, allow_unicode=True, width=100)
    try:
        path.write_text(text, encoding="utf-8", newline="\n")
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be written: {error.strerror}") from None


def _put(held: Any, steps: list[str], value: Any) -> None:
    """Into a mapping, or a list whose items have a ``name`` or their place from 1."""
    step, rest = steps[0], steps[1:]
    key: Any = _names(held).index(step) if isinstance(held, list) else step
    if not rest:
        held[key] = value
        return
    if isinstance(held, dict) and not isinstance(held.get(key), dict | list):
        held[key] = {}
    _put(held[key], rest, value)


def _names(items: list[Any]) -> list[str]:
    named = (
        (k, item.get("name") if isinstance(item, dict) else None) for k, item in enumerate(items)
    )
    return [str(k + 1 if name is None else name) for k, name in named]


def _renamed(value: Any, name: Callable[[str], str]) -> Any:
    """The same with another name for every text in it."""
    if isinstance(value, dict):
        return {key: _renamed(each, name) for key, each in value.items()}
    if isinstance(value, list):
        return [_renamed(each, name) for each in value]
    return name(value) if isinstance(value, str) else value


def _near(home: Path, text: str) -> str:
    """A file of a whole path named from ``home``; not one on another drive (Windows)."""
    if os.path.isabs(text) and os.path.isfile(text):
        with suppress(ValueError):
            return Path(os.path.relpath(text, home)).as_posix()
    return text


def _placed(beside: Path, text: str) -> str:
    """The name of a file beside the old file, from anywhere."""
    file = beside / text
    return str(file.resolve()) if file.suffix and os.path.isfile(file) else text
