"""Time and size of an installation from nothing: a new user's command in a copy of the tree."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any

from benchmarks.processes import MEGABYTE, ROOT

LEFT_OUT = shutil.ignore_patterns(".*", "out", "dist", "build", "__pycache__", "*.egg-info")


def measure_installation() -> dict[str, Any]:
    """Seconds, size on disk and number of packages of ``scripts/environment run``.

    Packages come from the index or the cache of pip, as pip chooses.
    """
    with tempfile.TemporaryDirectory() as made:
        tree = Path(made) / "rotordyn"
        shutil.copytree(ROOT, tree, ignore=LEFT_OUT)
        begin = time.perf_counter()
        subprocess.run(
            [tree / "scripts" / "environment", "run"], check=True, stdout=subprocess.DEVNULL
        )
        seconds = time.perf_counter() - begin
        venv = tree / ".venv"
        packages = len(list(venv.glob("lib/python*/site-packages/*.dist-info")))
        return {"seconds": seconds, "megabytes": _size(venv) / MEGABYTE, "packages": packages}


def _size(folder: Path) -> int:
    """Bytes taken on disk by all files below ``folder``."""
    files = (Path(place) / name for place, _, names in os.walk(folder) for name in names)
    return sum(file.lstat().st_blocks * 512 for file in files)
