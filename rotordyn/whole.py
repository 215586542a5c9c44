"""Atomic replacement of files, and locks of folders."""

from __future__ import annotations

import os
import shutil
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

UNFINISHED = ".unfinished."
ABANDONED = 86400.0  # s after which the folder of a killed run is removed


@contextmanager
def whole_files(folder: Path) -> Iterator[Path]:
    """Temporary folder whose files are moved to ``folder`` when the block ends without error.

    Raises
    ------
    OSError : the folder cannot be written
    """
    for unfinished in folder.glob(f"{UNFINISHED}*"):
        if time.time() - unfinished.stat().st_mtime > ABANDONED:
            shutil.rmtree(unfinished, ignore_errors=True)
    place = Path(tempfile.mkdtemp(prefix=UNFINISHED, dir=folder))
    try:
        yield place
        for path in sorted(place.iterdir()):
            os.replace(path, folder / path.name)
    finally:
        shutil.rmtree(place, ignore_errors=True)


def locked(folder: Path) -> int | None:
    """Lock a folder until this process and its forks end; None if the system has no locks.

    Raises
    ------
    OSError : another process holds the lock
    """
    try:
        import fcntl
    except ImportError:  # Windows
        return None
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        os.close(descriptor)
        raise
    return descriptor
