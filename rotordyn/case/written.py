"""Write a case as a file: the file it was read from, with other values at some paths."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

import yaml

from rotordyn.case.case import Case
from rotordyn.case.expand import opened
from rotordyn.case.paths import IN_FILES, from_top
from rotordyn.errors import InvalidInput

COMPARED = ("compare", "tools")


def write_changed(
    case: Case, changes: Mapping[str, Any], path: Path, *, title: str, home: Path | None = None
) -> None:
    """Write the file of ``case`` with ``changes`` to ``path``; its variants are omitted.

    ``changes``: values as files write them, by dotted path as in ``vary``. ``home``: folder to
    which file names are made relative where possible; by default they become absolute.

    Raises
    ------
    InvalidInput : the case was not read from a file, or the new one cannot be written
    """
    if not case.files:
        raise InvalidInput(
            f"case {case.name}: was not read from a file, so that it cannot be written"
        )
    source = case.files[0]
    content = opened(source)[0].plain()
    kept = {key: value for key, value in content.items() if key not in COMPARED}
    whole = _renamed(kept, partial(_placed, source.parent))
    whole["title"] = title
    override = {**whole.get("override", {}), **changes}
    machine = "spindle" in whole
    whole["override"] = {from_top(path, machine, IN_FILES): v for path, v in override.items()}
    content = whole if home is None else _renamed(whole, partial(_near, home.resolve()))
    text = yaml.safe_dump(content, sort_keys=False, allow_unicode=True, width=100)
    try:
        path.write_text(text, encoding="utf-8", newline="\n")
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be written: {error.strerror}") from None


def _renamed(value: Any, name: Callable[[str], str]) -> Any:
    """Apply ``name`` to every text in a value."""
    if isinstance(value, dict):
        return {key: _renamed(each, name) for key, each in value.items()}
    if isinstance(value, list):
        return [_renamed(each, name) for each in value]
    return name(value) if isinstance(value, str) else value


def _near(home: Path, text: str) -> str:
    """Make an absolute file name relative to ``home``, unless on another drive (Windows)."""
    if os.path.isabs(text) and os.path.isfile(text):
        with suppress(ValueError):
            return Path(os.path.relpath(text, home)).as_posix()
    return text


def _placed(beside: Path, text: str) -> str:
    """Make a file name relative to the old file absolute."""
    file = beside / text
    return str(file.resolve()) if file.suffix and os.path.isfile(file) else text
