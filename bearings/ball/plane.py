"""Small matrices in a plane, and values with derivatives, entry by entry.

Plain expressions of floats or arrays, which compile as they are. A pair is a plane vector (axial,
radial), a block a 2×2 matrix by rows. A motion of a ring at a ball is a pair, with the tilt as a
third part where the ring has two grooves: the tilt about its own centre does not move one groove.
Lengths of tuples are known when a function is compiled.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

EPS = 2.0**-52  # rounding of a number of size 1

Pair = tuple[Any, Any]
Block = tuple[Pair, Pair]
Row = tuple[Any, ...]
Motion = tuple[Any, ...]
Triple = tuple[Any, Any, Any]


def where(condition: Any, yes: Any, no: Any) -> Any:
    """Choose between two values entry by entry; compiled for one ball it is a conditional."""
    return np.where(condition, yes, no)


def some(condition: Any) -> Any:
    """Whether a condition holds anywhere; compiled for one ball it is the condition itself."""
    return np.any(condition)


def direction(v: Pair) -> tuple[Any, Any, Any]:
    """sin, cos and length of (axial, radial), the angle counted from the radial direction."""
    length = np.sqrt(v[0] * v[0] + v[1] * v[1])
    part = 1.0 / length
    return v[0] * part, v[1] * part, length


def turned_far(before: Pair, now: Pair, angle: float) -> Any:
    """Whether a pair has turned by more than ``angle`` < π/2 [rad]."""
    cross = before[0] * now[1] - before[1] * now[0]
    return np.abs(cross) > math.tan(angle) * dot(before, now)


def dot(a: Pair, b: Pair) -> Any:
    """Scalar product of two pairs."""
    return a[0] * b[0] + a[1] * b[1]


def combined(a: Any, row: Row, b: Any, other: Row) -> Any:
    """a times one row of 2 to 4 numbers plus b times another."""
    x, y = a * row[0] + b * other[0], a * row[1] + b * other[1]
    if len(row) == 2:
        return x, y
    z = a * row[2] + b * other[2]
    if len(row) == 3:
        return x, y, z
    return x, y, z, a * row[3] + b * other[3]


def plus(a: Row, b: Row) -> Any:
    """Sum of two rows of 2 to 4 numbers."""
    x, y = a[0] + b[0], a[1] + b[1]
    if len(a) == 2:
        return x, y
    if len(a) == 3:
        return x, y, a[2] + b[2]
    return x, y, a[2] + b[2], a[3] + b[3]


def determinant(m: Block) -> Any:
    """Determinant of a block."""
    return m[0][0] * m[1][1] - m[0][1] * m[1][0]


def inverse(m: Block) -> Block:
    """Inverse of a block; zero where it is singular."""
    size = determinant(m)
    part = where(size != 0.0, 1.0, 0.0) / where(size != 0.0, size, 1.0)
    return (m[1][1] * part, -m[0][1] * part), (-m[1][0] * part, m[0][0] * part)


class Polar(NamedTuple):
    """Value with ``by``: its derivatives by αi, δi, αo and δo, of the races' resultants."""

    value: Any
    by: tuple[Any, Any, Any, Any]


def exchanged(p: Polar) -> Polar:
    """Value with the two races exchanged."""
    return Polar(p.value, (p.by[2], p.by[3], p.by[0], p.by[1]))


def times(p: Polar, q: Polar) -> Polar:
    """Product of two values."""
    return Polar(p.value * q.value, combined(p.value, q.by, q.value, p.by))


def scaled(vary: float, factor: float, p: Polar) -> Polar:
    """Multiply a value by ``factor``, its derivatives by ``vary`` as well."""
    f = vary * factor
    return Polar(factor * p.value, (f * p.by[0], f * p.by[1], f * p.by[2], f * p.by[3]))


def more_by(p: Polar, q: Polar) -> Polar:
    """Sum of two values."""
    return Polar(p.value + q.value, plus(p.by, q.by))


def less_by(p: Polar, q: Polar) -> Polar:
    """Difference of two values."""
    a, b = p.by, q.by
    return Polar(p.value - q.value, (a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]))
