"""Lines of JSON on disk as they come, below one that says of what they are.

Of trials of an optimum and searches of an identification. A last line that was cut short is cut
away.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from rotordyn.errors import InvalidInput


def begun(path: Path, kind: str, signature: str, what: str) -> list[dict[str, Any]]:
    """Lines kept of this ``kind`` of study ("optimum"), ``what`` they are ("trials"); the file is
    begun where there is none.

    Raises
    ------
    InvalidInput : it holds something else, or cannot be written
    """
    head = {kind: signature}
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.is_file():
            if any(path.parent.iterdir()):
                raise InvalidInput(
                    f"{path.parent}: is a folder with other things in it, and no {kind}: choose "
                    "another"
                )
            path.write_text(json.dumps(head) + "\n", encoding="utf-8")
        raw = path.read_bytes()
        whole = raw[: raw.rfind(b"\n") + 1]
        if len(whole) < len(raw):
            os.truncate(path, len(whole))
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be written: {error.strerror}") from None
    try:
        first, *lines = [json.loads(line) for line in whole.splitlines()]
    except (ValueError, RecursionError):
        raise unreadable(path, what) from None
    if first != head:
        raise InvalidInput(
            f"{path.parent}: holds the {what} of another {kind}: choose another folder, or remove "
            "that one"
        )
    return lines


def unreadable(path: Path, what: str) -> InvalidInput:
    """That lines are not what they should be."""
    return InvalidInput(f"{path}: is no record of {what}: choose another folder")


def add(path: Path, line: Mapping[str, Any]) -> None:
    """Write one more line.

    Raises
    ------
    InvalidInput : it cannot be written
    """
    try:
        with path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(line) + "\n")
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be written: {error.strerror}") from None


def withdraw(path: Path) -> None:
    """Remove what was begun and holds nothing of use, with its folder where that is empty then."""
    with suppress(OSError):
        path.unlink()
        path.parent.rmdir()
