"""The process that renders: orders come in pickled, pictures go out as files of numpy.

python -m rotordyn.view FOLDER < orders
"""

from __future__ import annotations

import os
import pickle
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from rotordyn.view.order import Order, moving_name, still_name

if TYPE_CHECKING:
    from rotordyn.view.scene import RotorScene

STILL, MOVING = 1200, 640  # pixels across
WINDOW = "VTK_DEFAULT_OPENGL_WINDOW"


def main() -> None:
    """Render every order on standard input into the folder named first."""
    folder = Path(sys.argv[1])
    orders: list[Order] = pickle.load(sys.stdin.buffer)
    if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
        os.environ.setdefault(WINDOW, "vtkEGLRenderWindow")
    for number, order in enumerate(orders):
        render(order, number, folder)


def render(order: Order, number: int, folder: Path) -> None:
    """Save one picture of every mode at every speed, then the frames of animations."""
    from rotordyn.surface.orbit import phases

    for speed, mode, scene in _shown(order, STILL):
        np.save(folder / still_name(number, speed, mode), scene.picture(0.0))
    for speed, mode, scene in _shown(order, 2 * MOVING) if order.frames else ():
        frames = [_halved(scene.picture(float(phase))) for phase in phases(order.frames)]
        np.save(folder / moving_name(number, speed, mode), np.stack(frames))


def _shown(order: Order, width: int) -> Iterator[tuple[int, int, RotorScene]]:
    """Yield speed and mode of every picture with its scene, ``width`` pixels wide."""
    from rotordyn.view.scene import RotorScene

    scene = RotorScene(order.spindle, order.amplitude, order.colours, width)
    for speed, mode in order.places:
        scene.show(order.node, order.rotor, order.shape[speed, mode])
        yield speed, mode, scene
    scene.close()


def _halved(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return the mean of every four pixels, which smooths edges."""
    height, width = (size // 2 for size in picture.shape[:2])
    blocks = picture[: 2 * height, : 2 * width].reshape(height, 2, width, 2, 3)
    return blocks.mean(axis=(1, 3)).round().astype(np.uint8)


if __name__ == "__main__":
    main()
