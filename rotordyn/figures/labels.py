"""Labels of axes, and labels in a row that do not overlap."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rotordyn.arrays import Array
from rotordyn.results.declaration import declared


def axis_label(result: Any, name: str) -> str:
    """Return label and printed unit of a quantity or coordinate of ``result``."""
    info = declared(result)[name].metadata
    return f"{info['label']} [{info['printed'].unit}]"


def broken(path: str, longest: int) -> str:
    """Break a dotted path into lines of at most ``longest`` characters, or of one step.

    >>> print(broken("sleeves.rear.spring.preload", 24))
    sleeves.rear.spring.
    preload
    """
    lines = [""]
    for step in path.replace(".", ".\0").split("\0"):
        if lines[-1] and len(lines[-1]) + len(step) > longest:
            lines.append("")
        lines[-1] += step
    return "\n".join(lines)


def spread(wanted: Sequence[float], sizes: Sequence[float], low: float, high: float) -> Array:
    """Return centres near ``wanted``, with labels of ``sizes`` not overlapping and in low … high.

    Labels that touch move as one block about the mean of their wanted centres. If they do not all
    fit, they fill the whole range with reduced sizes.
    """
    centres = np.asarray(wanted, float)
    order = np.argsort(centres, kind="stable")
    width = np.asarray(sizes, float)[order]
    if width.sum() >= high - low:
        width = width * (high - low) / width.sum()
    before = np.cumsum(width) - width / 2.0  # centres of the labels laid end to end from zero
    blocks: list[tuple[float, int]] = []  # shift from there, and number of labels, of each
    for shift in (centres[order] - before).tolist():
        blocks.append((shift, 1))
        while len(blocks) > 1 and blocks[-2][0] > blocks[-1][0]:
            (later, m), (earlier, n) = blocks.pop(), blocks.pop()
            blocks.append(((n * earlier + m * later) / (n + m), n + m))
    shifts = np.array([shift for shift, count in blocks for _ in range(count)])
    placed = np.empty(centres.size)
    placed[order] = before + np.clip(shifts, low, max(high - width.sum(), low))
    return placed
