"""Lines of JSON, appended to a file as results come, so that an interrupted study can resume.

A line for every point of a sweep, trial of an optimum or search of an identification, in the order
in which they were solved. The first line is the signature of the study. An incomplete last line,
left by a killed process, is removed. Floats are restored bit for bit; NaN and infinities, which
JSON lacks, are written as words.
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
    """Lock a folder, so that no other process solves ``what`` into it meanwhile.

    Raises
    ------
    InvalidInput : another process has the lock; the folder cannot be created
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
    """Read the lines of a file, or create it; ``kind`` of study ("optimum"), ``what`` the lines are
    ("trials").

    Raises
    ------
    InvalidInput : the file holds something else, or cannot be written
    """
    header = {kind: signature}
    first_line = json.dumps(header).encode() + b"\n"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.is_file() and any(path.parent.iterdir()):
            raise InvalidInput(
                f"{path.parent}: is a folder with other things in it, and no {kind}: choose another"
            )
        raw = path.read_bytes() if path.is_file() else b""
        if first_line.startswith(raw):  # new, or killed before a line was kept
            path.write_bytes(first_line)
            return []
        complete = raw[: raw.rfind(b"\n") + 1]
        first, *lines = [_numbers(json.loads(line)) for line in complete.splitlines()]
        if first != header:
            raise InvalidInput(
                f"{path.parent}: holds the {what} of another {kind}: choose another folder, or "
                "remove that one"
            )
        if len(complete) < len(raw):
            os.truncate(path, len(complete))
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be written: {error.strerror}") from None
    except (ValueError, RecursionError):
        raise unreadable(path, what) from None
    return lines


def unreadable(path: Path, what: str) -> InvalidInput:
    """Return the error for lines of another format."""
    return InvalidInput(f"{path}: is not a record of {what}: choose another folder")


def add(path: Path, line: Mapping[str, Any]) -> None:
    """Append a line.

    Raises
    ------
    InvalidInput : the file cannot be written
    """
    try:
        with path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(_words(line), allow_nan=False) + "\n")
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be written: {error.strerror}") from None


def _words(value: Any) -> Any:
    """Replace NaN and infinities in a value by words."""
    if isinstance(value, float) and not math.isfinite(value):
        return "NaN" if math.isnan(value) else ("Infinity" if value > 0.0 else "-Infinity")
    return _within(value, _words)


def _numbers(value: Any) -> Any:
    """Replace the words for NaN and infinities in a value by numbers."""
    return WORDS.get(value, value) if isinstance(value, str) else _within(value, _numbers)


def _within(value: Any, each: Callable[[Any], Any]) -> Any:
    if isinstance(value, Mapping):
        return {key: each(inner) for key, inner in value.items()}
    return [each(inner) for inner in value] if isinstance(value, list | tuple) else value


def withdraw(path: Path) -> None:
    """Remove a file that holds no results, and its folder if that is then empty."""
    with suppress(OSError):
        path.unlink()
        path.parent.rmdir()
