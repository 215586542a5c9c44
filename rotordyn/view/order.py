"""Orders of pictures: plain values that another process can read."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rotordyn.arrays import Array, Complex
from rotordyn.machine.spindle import Spindle


@dataclass(frozen=True, eq=False, slots=True)
class Order:
    """Pictures of mode shapes of a spindle.

    ``node`` [m], ``rotor`` of each and ``shape`` (speeds, modes, nodes, 6) as a ``CampbellResult``
    has them; shapes that do not exist (NaN) have no picture. ``amplitude``: largest
    displacement drawn, over the length of the shaft. ``frames`` of one period, 0 = no animation.
    ``colours`` of the motion: name of a colour map of matplotlib.
    """

    spindle: Spindle
    node: Array
    rotor: tuple[str, ...]
    shape: Complex
    amplitude: float
    frames: int = 0
    colours: str = "YlGn"

    @property
    def places(self) -> list[tuple[int, int]]:
        """Speed and mode of every picture."""
        finite = np.isfinite(self.shape).all(axis=(2, 3))
        return [(int(speed), int(mode)) for speed, mode in np.argwhere(finite)]

    @property
    def pictures(self) -> int:
        """Number of pictures, with those of animations."""
        return len(self.places) * (1 + self.frames)


def still_name(order: int, speed: int, mode: int) -> str:
    """Return the file name of one picture (height, width, 3) of an order, by its number."""
    return f"still_{order}_{speed}_{mode}.npy"


def moving_name(order: int, speed: int, mode: int) -> str:
    """Return the file name of the frames (count, height, width, 3) of an animation."""
    return f"moving_{order}_{speed}_{mode}.npy"
