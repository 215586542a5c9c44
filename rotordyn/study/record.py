"""Lines of JSON on disk as they come, so that a study that was stopped goes on where it was.

A line for every point of a sweep, trial of an optimum or search of an identification, in the order
in which they were solved. The first line is the signature of the study. A line that was cut short
by a kill stands last and is cut away. Floats are read back bit for bit; those that are not finite,
of which JSON knows none, are words.
"""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from rotordyn.errors import InvalidInput
from rotordyn.whole import locked

WORDS = {"NaN": math.nan, "Infinity": math.inf, "-Infinity": -math.inf}


@contextmanager
def alone(folder: Path, what: str) -> Iterator[None]:
    """Keep other processes from solving ``what`` into a folder meanwhile.

    Raises
    ------
    InvalidInput : another one does; the folder cannot be made
    """
    lock = None
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InvalidInput(f"{folder}: cannot be written: {error.strerror}") from None
    try:
        lock = locked(folder)
    except BlockingIOError:
        raise InvalidInput(
            f"{folder}: another process solves the {what} of a study there: wait for it, or choose "
            "another folder"
        ) from None
    except OSError:  # a file system without locks
        pass
    try:
        yield
    finally:
        if lock is not None:
            os.close(lock)


def begun(path: Path, kind: str, signature: str, what: str) -> list[dict[str, Any]]:
    """Lines kept of this ``kind`` of study ("optimum"), ``what`` they are ("trials"); the file is
    begun where there is none.

    Raises
    ------
    InvalidInput : it holds something else, or cannot be written
    """
    head = {kind: signature}
    begin = json.dumps(head).encode() + b"\n"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.is_file() and any(path.parent.iterdir()):
            raise InvalidInput(
                f"{path.parent}: is a folder with other things in it, and no {kind}: choose another"
            )
        raw = path.read_bytes() if path.is_file() else b""
        if begin.startswith(raw):  # new, or killed before a line was kept
            path.write_bytes(begin)
            return []
        whole = raw[: raw.rfind(b"\n") + 1]
        first, *lines = [_numbers(json.loads(line)) for line in whole.splitlines()]
        if first != head:
            raise InvalidInput(
                f"{path.parent}: holds the {what} of another {kind}: choose another folder, or "
                "remove that one"
            )
        if len(whole) < len(raw):
            os.truncate(path, len(whole))
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be written: {error.strerror}") from None
    except (ValueError, RecursionError):
        raise unreadable(path, what) from None
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
            file.write(json.dumps(_words(line), allow_nan=False) + "\n")
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be written: {error.strerror}") from None


def _words(value: Any) -> Any:
    """A value of a line with words for what is no finite number."""
    if isinstance(value, float) and not math.isfinite(value):
        return "NaN" if math.isnan(value) else ("Infinity" if value > 0.0 else "-Infinity")
    return _within(value, _words)


def _numbers(value: Any) -> Any:
    """The same read back; lines of earlier versions have no such words."""
    return WORDS.get(value, value) if isinstance(value, str) else _within(value, _numbers)


def _within(value: Any, each: Callable[[Any], Any]) -> Any:
    if isinstance(value, Mapping):
        return {key: each(inner) for key, inner in value.items()}
    return [each(inner) for inner in value] if isinstance(value, list | tuple) else value


def withdraw(path: Path) -> None:
    """Remove what was begun and holds nothing of use, with its folder where that is empty then."""
    with suppress(OSError):
        path.unlink()
        path.parent.rmdir()
