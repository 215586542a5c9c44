"""Case files written by a test, run through the public interface."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

import rotordyn

Complex = np.ndarray[tuple[int, ...], np.dtype[np.complex128]]


def answered(text: str, folder: Path) -> dict[str, Any]:
    """Datasets by analysis of the case that ``text`` describes."""
    path = folder / "case.yaml"
    path.write_text(text, encoding="utf-8")
    return rotordyn.run(rotordyn.load(path))


def bending_poles(modes: Any, row: int = 0) -> Complex:
    """λ [rad/s] of the bending modes of a ``campbell`` dataset at one speed, by imaginary part."""
    own = modes.isel(speed=row, mode=np.flatnonzero(modes.kind.values == "bending"))
    damped, ratio = 2.0 * np.pi * own.frequency.values, own.damping_ratio.values
    poles = -damped * ratio / np.sqrt(1.0 - ratio**2) + 1j * damped
    return np.asarray(poles[np.argsort(damped)])
