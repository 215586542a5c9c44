"""Lines of plain text: their width, their numbers, the lines at the head."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Sequence

import numpy as np

from rotordyn.arrays import Array, Flags
from rotordyn.results.display import RPM, number

WIDTH = 100
INDENT = " " * 11  # of what follows the first word of a line
WARNING = "WARNING: "
BEYOND = 0.02  # of the largest value: extremes less than that beyond both ends are not printed
_NO_BREAK = "\u00a0"
_NUMBER = re.compile(r"(?<![\w.])[+-]?\d[\d.]*\b")


def opening(
    warnings: Sequence[str], title: str, notes: Sequence[str], unsolved: Sequence[str] = ()
) -> list[str]:
    """Warnings first, then the title, why speeds have no solution, and what the user chose that
    changes how results read."""
    shown = [f"{WARNING}{sentence}" for sentence in warnings]
    shown += [title, *(f"not solved {sentence}" for sentence in grouped(unsolved))]
    shown += [f"note       {sentence}" for sentence in notes]
    return [part for line in shown for part in wrapped(line)]


def grouped(sentences: Sequence[str]) -> list[str]:
    """The first of sentences that differ by numbers alone, with the count of the others.

    >>> grouped(["a is unloaded at 0 rpm", "no state", "a is unloaded at 900 rpm"])
    ['a is unloaded at 0 rpm (1 more, the last at 900 rpm)', 'no state']
    """
    groups: dict[str, list[str]] = {}
    for sentence in sentences:
        groups.setdefault(_NUMBER.sub("", sentence), []).append(sentence)
    lines = []
    for first, *rest in groups.values():
        last = re.search(r"at \S+ rpm", rest[-1]) if rest else None
        end = f", the last {last[0]}" if last else ""
        lines.append(f"{first} ({len(rest)} more{end})" if rest else first)
    return lines


def unbroken(entry: str) -> str:
    """An entry that is not broken over two lines, unless it is longer than one."""
    return entry.replace(" ", _NO_BREAK)


def wrapped(line: str) -> list[str]:
    """Lines of at most ``WIDTH`` columns, continuation lines indented."""
    room = WIDTH - len(INDENT)
    entries = [e.replace(_NO_BREAK, " ") if len(e) > room else e for e in line.split(" ")]
    text = " ".join(entries)
    lines = textwrap.wrap(text, WIDTH, subsequent_indent=INDENT, break_on_hyphens=False)
    return [part.replace(_NO_BREAK, " ") for part in lines]


def aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    """A line per row, columns as wide as their widest entry."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return ["  ".join(map(str.ljust, row, widths)).rstrip() for row in rows]


def over_speed(values: Array, speed: Array, digits: int = 1) -> str:
    """The first and the last value over ``speed`` [rad/s], and extremes beyond both.

    >>> over_speed(np.array([94.1, 7.71, 13.7]), np.array([0.0, 628.3, 942.5]))
    '94.1 → 13.7 (least 7.71 at 6000 rpm)'
    """
    more = [
        f"{word} {number(value, digits)} at {number(speed[k] * RPM.factor, 0)} rpm"
        for word, k, value in outside(values)
    ]
    ends = from_to(values, digits)
    return f"{ends} ({', '.join(more)})" if more else ends


def outside(values: Array) -> list[tuple[str, int, float]]:
    """The least and the largest value, with their indices, where they lie beyond the first and the
    last one."""
    finite = np.where(np.isfinite(values), values, np.nan)
    if np.isnan(finite).all():
        return []
    extremes = ("least", int(np.nanargmin(finite)), -1.0), ("most", int(np.nanargmax(finite)), 1.0)
    margin = BEYOND * float(np.nanmax(np.abs(finite)))
    return [
        (word, k, float(values[k]))
        for word, k, side in extremes
        if not (side * values[k] <= side * values[[0, -1]] + margin).any()
    ]


def which_of(speed: Array, holds: Flags) -> str:
    """Speeds [rad/s], as text, at which a condition ``holds`` (speeds, ...), at least at one.

    >>> which_of(np.array([0.0, 100.0, 200.0]), np.array([False, True, False]))
    'at 955 rpm'
    """
    rows = np.flatnonzero(holds.reshape(len(speed), -1).any(axis=1))
    first = f"{speed[rows[0]] * RPM.factor:.0f} rpm"
    if rows.size == len(speed) - rows[0]:
        return f"from {first} on"
    if rows.size == 1:
        return f"at {first}"
    return f"at {rows.size} of {len(speed)} speeds, first at {first}"


def from_to(values: Array, digits: int = 1) -> str:
    """The first and the last value over speed; where there is but one speed, its value."""
    ends = values[[0, -1]] if len(values) > 1 else values
    return " → ".join(number(value, digits) for value in ends)
