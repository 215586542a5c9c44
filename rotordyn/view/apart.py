"""Rendering in a process of its own, which a machine without OpenGL may end without a message."""

from __future__ import annotations

import os
import pickle
import re
import signal
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import not_installed
from rotordyn.view.order import Order, moving_name, still_name

Pixels = NDArray[np.uint8]
PROGRAM = ("-m", "rotordyn.view")
LONGEST = 60.0  # s allowed for the first picture
LONGEST_EACH = 5.0  # s for each further picture
REMEDY = (
    "install Mesa's EGL (on Debian and Ubuntu: libegl1 libgl1-mesa-dri libx11-6), or run where "
    "there is a display"
)
# pyvista adds a message of its own about missing VTK after that of Python: search all lines
_MISSING = re.compile(r"No module named '((?:pyvista|vtk)[^']*)'|No module named '([^']+)'\Z")


class NoPictures(Exception):
    """Raised where nothing can be rendered; its text says why and what to do."""


class Rendering:
    """Pictures rendered in another process. ``finish`` waits for them; ``close`` ends it anyway.

    Use it as a context: its temporary files are removed afterwards. They are in ``folder``, or in
    the system's folder of such files.
    """

    def __init__(self, orders: Sequence[Order], folder: Path | None = None) -> None:
        self._temporary = tempfile.TemporaryDirectory(prefix="pictures.", dir=folder)
        self.folder = Path(self._temporary.name)
        (self.folder / "orders").write_bytes(pickle.dumps(list(orders)))
        self._longest = LONGEST + LONGEST_EACH * sum(order.pictures for order in orders)
        paths = os.pathsep.join(os.path.abspath(path) for path in sys.path)
        command = [sys.executable, *PROGRAM, str(self.folder)]
        orders_file, errors_file = self.folder / "orders", self.folder / "said"
        with orders_file.open("rb") as into, errors_file.open("wb") as out:
            self._process = subprocess.Popen(
                command,
                stdin=into,
                stdout=out,
                stderr=out,
                env={**os.environ, "PYTHONPATH": paths},
            )

    def __enter__(self) -> Rendering:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def running(self) -> bool:
        """Whether pictures are being rendered."""
        return self._process.poll() is None

    def finish(self) -> None:
        """Wait until everything is rendered.

        Raises
        ------
        NoPictures : the process fails, is ended by the system, or takes too long
        """
        try:
            code = self._process.wait(self._longest)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
            raise NoPictures(f"rendering took more than {self._longest:.0f} s; {REMEDY}") from None
        missing = _MISSING.search("\n".join(self._output())) if code > 0 else None
        why = not_installed(missing[1] or missing[2]) if missing else None
        if why:
            raise NoPictures(why)
        if code:
            raise NoPictures(f"this computer cannot render in 3D ({self._reason(code)}): {REMEDY}")

    def still(self, order: int, speed: int, mode: int) -> Pixels:
        """Return the picture of a mode at a speed, (height, width, 3); ``order``: its number."""
        return self._load(still_name(order, speed, mode))

    def moving(self, order: int, speed: int, mode: int) -> Pixels:
        """Return the frames of a mode's period, (count, height, width, 3)."""
        return self._load(moving_name(order, speed, mode))

    def close(self) -> None:
        """End the process if it still runs, and remove its files."""
        if self.running:
            self._process.kill()
            self._process.wait()
        self._temporary.cleanup()

    def _load(self, name: str) -> Pixels:
        pixels: Any = np.load(self.folder / name)
        return pixels

    def _reason(self, code: int) -> str:
        """Return the signal that ended the process, or the last line of its output."""
        if code < 0:
            return f"OpenGL ended the process: {signal.Signals(-code).name}"
        lines = self._output()
        return lines[-1].strip() if lines else f"exit code {code}"

    def _output(self) -> list[str]:
        return (self.folder / "said").read_text(errors="replace").strip().splitlines()
