"""The results folder appears whole or not at all, and never replaces other files.

Results are made in a workshop, a hidden folder beside the target, and moved when they are complete.
A run locks its workshop as long as it lives; the lock of a run that was killed is gone with it, and
the next run into the same folder removes its workshop. Earlier results that it had set aside, with
nothing in their place yet, are put back first.
"""

from __future__ import annotations

import errno
import json
import os
import re
import shutil
import stat
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from typing import Any

from rotordyn.errors import InvalidInput, OutputRefused
from rotordyn.whole import locked

RECORD = "run.json"
CASE = "case.json"
MARKER = "rotordyn_results"
NEW, OLD = "new", "old"  # what a workshop holds: results being made, results they replace
ABANDONED = 86400.0  # s after which a workshop is, where the system has no locks
PATIENCE = (0.05, 0.1, 0.2, 0.4, 0.8)  # s between attempts to move a folder that is in use
_DISK = (
    errno.ENOSPC,
    errno.EDQUOT,
    errno.EFBIG,
    errno.EIO,
    errno.EROFS,
    errno.EACCES,
    errno.EPERM,
)


@dataclass(slots=True)
class Place:
    """``folder``: where to write results; ``target``: where they are once they are complete.

    ``moved``: ``target`` is not the requested folder, but a sibling; ``kept``: since that folder
    holds complete results.
    """

    folder: Path
    target: Path
    moved: bool = False
    kept: bool = False


@contextmanager
def results_folder(target: Path, *, ended: bool = False) -> Iterator[Place]:
    """A folder that takes the place of ``target`` when the block ends without error.

    Where ``target`` cannot be moved away, since a file of it is open in another program (Windows),
    or holds complete results and those of a run that was ``ended`` are fewer, the results go to a
    folder beside it, ``target_2`` or further, which ``Place.target`` names.

    Raises
    ------
    OutputRefused : ``target`` is a file, or a folder that is not empty and has no record of a run
    InvalidInput : the folder cannot be made there, or the disk takes nothing more
    """
    requested, target = target, absolute(target)
    check_target(target)
    with ExitStack() as stack:
        for parent in reversed(_make_parents(target.parent)):
            stack.callback(_remove_if_empty, parent)
        workshop = _make_workshop(target, stack)
        place = Place(workshop / NEW, requested)
        try:
            yield place
        except OSError as error:
            if error.errno not in _DISK:
                raise
            raise InvalidInput(_unwritable(target.parent, error.strerror)) from error
        place.kept = ended and _holds_all(target)
        taken = _take_place(workshop, _sibling(target) if place.kept else target)
        if taken != target:
            place.target, place.moved = taken, True
        _recover(target)  # workshops that a killed run still locked at the beginning


def absolute(target: Path) -> Path:
    """Absolute path of ``target``, links followed.

    Raises
    ------
    InvalidInput : it is relative to a removed working directory, or its links form a circle
    """
    try:
        return Path(os.path.abspath(target)).resolve()
    except FileNotFoundError as error:
        reason = "the working directory has been removed"
        raise InvalidInput(f"{target}: {reason}; give a full path with -o") from error
    except (OSError, RuntimeError) as error:  # links form a circle
        raise InvalidInput(f"{target} cannot be read: links that lead in a circle") from error


def check_target(target: Path) -> None:
    """Refuse a target that holds anything but results of rotordyn.

    Raises
    ------
    OutputRefused, InvalidInput : as for ``results_folder``
    """
    target = absolute(target)
    try:
        while (content := _content_of(target)) == "moved":
            pass
    except OSError as error:
        raise InvalidInput(f"{target} cannot be read: {error.strerror}") from error
    if content == "file":
        raise OutputRefused(f"{target} is a file: give a folder for the results with -o")
    if content == "other":
        raise OutputRefused(
            f"{target} is not empty and holds no {RECORD} of rotordyn: "
            "give another folder with -o, or empty this one"
        )
    if os.path.ismount(target):
        raise OutputRefused(f"{target} is where a disk is mounted: give a folder in it with -o")
    above = next(folder for folder in target.parents if folder.exists())
    try:
        place = tempfile.mkdtemp(prefix=_prefix(target), dir=above)
        with suppress(FileNotFoundError):  # another run has taken it for one left over
            os.rmdir(place)
    except OSError as error:
        raise InvalidInput(_unwritable(above, error.strerror)) from error


def _content_of(target: Path) -> str:
    """Content of a target: ``nothing``, ``us``, ``other``, ``file``; ``moved`` if just replaced."""
    try:
        before = target.stat()
        if not stat.S_ISDIR(before.st_mode):
            return "file"
        if not any(target.iterdir()):
            return "nothing"
        content = "other" if record_in(target) is None else "us"
        return content if target.stat().st_ino == before.st_ino else "moved"
    except FileNotFoundError:
        return "nothing"


def record_in(folder: Path) -> dict[str, Any] | None:
    """The record of a run in ``folder``; None where there is none.

    Raises
    ------
    InvalidInput : this user may not read it
    """
    path = folder / RECORD
    try:
        record = json.loads(path.read_text(encoding="utf-8")) if path.is_file() else None
    except PermissionError as error:
        raise InvalidInput(f"{path} cannot be read: {error.strerror}") from error
    except (OSError, ValueError, RecursionError):
        return None
    return record if isinstance(record, dict) and MARKER in record else None


def _holds_all(target: Path) -> bool:
    """Whether ``target`` holds results of a run that was not ended before its end."""
    record = record_in(target)
    return record is not None and not record.get("ended")


def _make_parents(parent: Path) -> list[Path]:
    """Create ``parent``; returns the folders made, innermost first."""
    missing = [p for p in (parent, *parent.parents) if not p.exists()]
    try:
        parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InvalidInput(f"{parent} cannot be made: {error.strerror}") from error
    return missing


def _make_workshop(target: Path, stack: ExitStack) -> Path:
    """A locked workshop for ``target``, those of runs that were killed removed."""
    try:
        _recover(target)
        workshop = _new_workshop(target, stack)
        (workshop / NEW).mkdir()
    except OSError as error:
        raise InvalidInput(_unwritable(target.parent, error.strerror)) from error
    return workshop


def _new_workshop(target: Path, stack: ExitStack) -> Path:
    while True:
        workshop = Path(tempfile.mkdtemp(prefix=_prefix(target), dir=target.parent))
        with suppress(BlockingIOError, FileNotFoundError):
            lock = locked(workshop)
            if lock is not None:
                stack.callback(os.close, lock)
            # Before the lock another run may have taken it for one left over.
            if workshop.exists():
                stack.callback(shutil.rmtree, workshop, ignore_errors=True)
                return workshop


def _unwritable(folder: Path, reason: str | None) -> str:
    return f"{folder} cannot be written to: {reason}; give another folder with -o"


def _prefix(target: Path) -> str:
    return f".{target.name}.rotordyn."


def _recover(target: Path) -> None:
    """Remove what runs that were killed have left beside ``target``."""
    ours = re.compile(re.escape(_prefix(target)) + "[a-z0-9_]{8}")
    for path in [p for p in target.parent.iterdir() if ours.fullmatch(p.name)]:
        lock = None
        with suppress(OSError):
            lock = locked(path)
            if lock is None and time.time() - path.stat().st_mtime < ABANDONED:
                continue
            with suppress(OSError):  # results that are there already stay
                os.rename(path / OLD, target)
            shutil.rmtree(path, ignore_errors=True)
        if lock is not None:
            os.close(lock)


def _take_place(workshop: Path, target: Path) -> Path:
    """Move new results to ``target``, or to a sibling where that is in use; returns the folder.

    Another run may do the same at the same moment.
    """
    for _ in range(20):
        check_target(target)
        try:
            _retried(_set_aside, workshop, target)
        except PermissionError:
            target = _sibling(target)
            continue
        try:
            _retried(os.rename, workshop / NEW, target)
        except OSError as error:
            if error.errno not in (errno.ENOTEMPTY, errno.EEXIST):
                with suppress(OSError):
                    os.rename(workshop / OLD, target)
                raise InvalidInput(f"{target} cannot be made: {error.strerror}") from error
            shutil.rmtree(workshop / OLD, ignore_errors=True)  # another run has replaced them
        else:
            return target
    raise InvalidInput(f"{target} is being written by other runs: give each its own folder")


def _retried(move: Callable[[Path, Path], None], source: Path, target: Path) -> None:
    """Call ``move(source, target)``, again where Windows locks a file for a moment."""
    for pause in PATIENCE:
        try:
            return move(source, target)
        except PermissionError:
            time.sleep(pause)
    return move(source, target)


def _set_aside(workshop: Path, target: Path) -> None:
    """Move earlier results to the workshop, so that ``target`` is never half removed."""
    with suppress(FileNotFoundError):
        os.rename(target, workshop / OLD)  # an empty folder too: Windows replaces none


def _sibling(target: Path) -> Path:
    """The first of ``target_2``, ``target_3`` … that holds nothing."""
    for number in count(2):
        path = target.with_name(f"{target.name}_{number}")
        if _content_of(path) == "nothing":
            return path
    raise AssertionError


def _remove_if_empty(folder: Path) -> None:
    with suppress(OSError):
        folder.rmdir()
