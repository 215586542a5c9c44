"""The parallel projection of every picture."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array

VIEW = (-0.55, 0.42, 1.0)  # towards the viewer: in front of the nose, above, z towards the viewer


def screen() -> tuple[Array, Array, Array]:
    """Return unit vectors to the right, upwards and towards the viewer; y points upwards."""
    towards = np.array(VIEW) / np.linalg.norm(VIEW)
    right = np.cross([0.0, 1.0, 0.0], towards)
    right /= np.linalg.norm(right)
    return right, np.cross(towards, right), towards


def projected(points: Array) -> Array:
    """Return places on the screen (n, 2) [m], to the right and upwards, of points (n, 3)."""
    right, up, _ = screen()
    return points @ np.stack([right, up], axis=1)
