"""Files that replace others appear whole or not at all; a folder is one process's at a time."""

from __future__ import annotations

import os
import shutil
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

UNFINISHED = ".unfinished."
ABANDONED = 86400.0  # s after which a folder of a run that was killed is


@contextmanager
def whole_files(folder: Path) -> Iterator[Path]:
    """A folder whose files take their places in ``folder`` when the block ends without error.

    Raises
    ------
    OSError : the folder cannot be written
    """
    for left in folder.glob(f"{UNFINISHED}*"):
        if time.time() - left.stat().st_mtime > ABANDONED:
            shutil.rmtree(left, ignore_errors=True)
    place = Path(tempfile.mkdtemp(prefix=UNFINISHED, dir=folder))
    try:
        yield place
        for path in sorted(place.iterdir()):
            os.replace(path, folder / path.name)
    finally:
        shutil.rmtree(place, ignore_errors=True)


def locked(folder: Path) -> int | None:
    """A lock that ends with this process and its forks, None where the system has none.

    Raises
    ------
    OSError : another process holds it
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
