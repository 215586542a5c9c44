"""The results folder appears whole or not at all, and never replaces what is not ours."""

from __future__ import annotations

import errno
import json
import os
import shutil
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from rotordyn.errors import InvalidInput, OutputRefused

RECORD = "run.json"
CASE = "case.json"
MARKER = "rotordyn_results"


@contextmanager
def results_folder(target: Path) -> Iterator[Path]:
    """A temporary sibling of ``target`` that takes its place when the block ends without error.

    Raises
    ------
    OutputRefused : ``target`` is a file, or a folder with something in it and no record of ours
    InvalidInput : the folder cannot be made there
    """
    target = Path(os.path.abspath(target)).resolve()
    check_target(target)
    made = _make_parents(target.parent)
    partial = _make_partial(target)
    try:
        yield partial
        _take_place(partial, target)
    except BaseException:
        shutil.rmtree(partial, ignore_errors=True)
        for parent in made:
            with suppress(OSError):
                parent.rmdir()
        raise


def check_target(target: Path) -> None:
    """Refuse a target that holds anything but results of ours.

    Raises
    ------
    OutputRefused, InvalidInput : as for ``results_folder``
    """
    try:
        while (held := _held_by(target)) == "moved":
            pass
    except OSError as error:
        raise InvalidInput(f"{target} cannot be read: {error.strerror}") from error
    if held == "file":
        raise OutputRefused(f"{target} is a file: give a folder for the results with -o")
    if held == "other":
        raise OutputRefused(
            f"{target} is not empty and holds no {RECORD} of ours: "
            "give another folder with -o, or empty this one"
        )


def _held_by(target: Path) -> str:
    """``nothing``, ``us``, ``other``, ``file``, or ``moved`` when replaced while being read."""
    try:
        before = target.stat()
        if not stat.S_ISDIR(before.st_mode):
            return "file"
        if not any(target.iterdir()):
            return "nothing"
        holder = "us" if is_ours(target) else "other"
        return holder if target.stat().st_ino == before.st_ino else "moved"
    except FileNotFoundError:
        return "nothing"


def is_ours(folder: Path) -> bool:
    """Whether ``folder`` holds the record of a run."""
    try:
        record = json.loads((folder / RECORD).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return False
    return isinstance(record, dict) and MARKER in record


def _make_parents(parent: Path) -> list[Path]:
    """Create ``parent``; returns the folders made, innermost first."""
    missing = [p for p in (parent, *parent.parents) if not p.exists()]
    try:
        parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InvalidInput(f"{parent} cannot be made: {error.strerror}") from error
    return missing


def _make_partial(target: Path) -> Path:
    try:
        partial = Path(tempfile.mkdtemp(prefix=f".{target.name}.", dir=target.parent))
        partial.chmod(0o777 & ~_umask())
    except OSError as error:
        reason = f"{target.parent} cannot be written to: {error.strerror}"
        raise InvalidInput(f"{reason}; give another folder with -o") from error
    return partial


def _umask() -> int:
    value = os.umask(0)
    os.umask(value)
    return value


def _take_place(partial: Path, target: Path) -> None:
    """Move ``partial`` to ``target``; another run may do the same at the same moment."""
    for _ in range(20):
        check_target(target)
        aside = _set_aside(target)
        try:
            os.rename(partial, target)
        except OSError as error:
            if error.errno not in (errno.ENOTEMPTY, errno.EEXIST):
                if aside:
                    os.rename(aside, target)
                raise InvalidInput(f"{target} cannot be made: {error.strerror}") from error
        else:
            return
        finally:
            if aside:
                shutil.rmtree(aside, ignore_errors=True)
    raise InvalidInput(f"{target} is being written by other runs: give each its own folder")


def _set_aside(target: Path) -> Path | None:
    """Move earlier results to a sibling, so that they never stand there half removed."""
    with suppress(FileNotFoundError):
        if not target.is_dir() or not any(target.iterdir()):
            return None
    aside = Path(tempfile.mkdtemp(prefix=f".{target.name}.old.", dir=target.parent))
    with suppress(FileNotFoundError):
        os.rename(target, aside)
    return aside
