"""Labels of axes, and labels in a row that do not overlap."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rotordyn.results.declaration import declared


def axis_label(result: Any, name: str) -> str:
    """Label and printed unit of a quantity or coordinate of ``result``."""
    info = declared(result)[name].metadata
    return f"{info['label']} [{info['printed'].unit}]"


def spread(
    wanted: Sequence[float], sizes: Sequence[float], low: float, high: float
) -> NDArray[np.float64]:
    """Centres near ``wanted`` such that labels of ``sizes`` neither overlap nor leave low … high.

    Labels that touch move as one block about the mean of where they want to be. When they do not
    all fit they are set evenly over the whole range.
    """
    centres = np.asarray(wanted, float)
    if not centres.size:
        return centres
    order = np.argsort(centres, kind="stable")
    width = np.asarray(sizes, float)[order]
    if width.sum() >= high - low:
        width = width * (high - low) / width.sum()
    placed = np.empty(centres.size)
    placed[order] = _blocks(centres[order], width, low, high)
    return placed


def _blocks(
    wanted: NDArray[np.float64], width: NDArray[np.float64], low: float, high: float
) -> NDArray[np.float64]:
    """Merge neighbours into blocks until none overlap; returns centres in order."""
    offset = np.cumsum(width) - width / 2.0
    blocks: list[tuple[int, int, float]] = []
    for index in range(wanted.size):
        block = _placed(wanted, width, offset, low, high, index, index + 1)
        while blocks and blocks[-1][2] + _length(width, blocks[-1]) > block[2] + 1e-12:
            first = blocks.pop()[0]
            block = _placed(wanted, width, offset, low, high, first, index + 1)
        blocks.append(block)
    centres = np.empty(wanted.size)
    for first, last, left in blocks:
        centres[first:last] = left + offset[first:last] - (offset[first] - width[first] / 2.0)
    return centres


def _length(width: NDArray[np.float64], block: tuple[int, int, float]) -> float:
    return float(width[block[0] : block[1]].sum())


def _placed(
    wanted: NDArray[np.float64],
    width: NDArray[np.float64],
    offset: NDArray[np.float64],
    low: float,
    high: float,
    first: int,
    last: int,
) -> tuple[int, int, float]:
    """The block of labels ``first`` … ``last`` with its left edge where they suffer least."""
    inside = offset[first:last] - (offset[first] - width[first] / 2.0)
    left = float((wanted[first:last] - inside).mean())
    room = high - float(width[first:last].sum())
    return first, last, min(max(left, low), max(room, low))
