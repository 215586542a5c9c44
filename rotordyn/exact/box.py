"""A rectangle of complex frequencies, and how many poles of a rotor lie in it.

The determinant of the shooting equations is an entire function of ω: transfer matrices are power
series in p(ω) and q(ω). Its argument therefore grows by 2π around every pole inside.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import NoSolution
from rotordyn.exact.banded import phases
from rotordyn.exact.shooting import Shooting

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
FIRST = 16  # points a side at first
TURN = 0.8  # rad between neighbouring points at most
MOST = 40000  # points
BATCH = 256


@dataclass(frozen=True, slots=True)
class Box:
    """From corner ``low`` to corner ``high`` [rad/s], both parts ascending."""

    low: complex
    high: complex

    def __contains__(self, omega: complex) -> bool:
        across = self.low.real < omega.real < self.high.real
        return across and self.low.imag < omega.imag < self.high.imag

    @property
    def middle(self) -> complex:
        """Its centre."""
        return 0.5 * (self.low + self.high)

    @property
    def size(self) -> complex:
        """Width and height."""
        return self.high - self.low

    def cut(self, known: Iterable[complex]) -> tuple[Box, Box]:
        """In two across its longer side, near the middle but far from what is ``known``."""
        low, high, size = self.low, self.high, self.size
        wide = size.real >= size.imag
        shares = np.linspace(0.35, 0.65, 13)
        places = [
            ((z - low).real / size.real if wide else (z - low).imag / size.imag) for z in known
        ]
        room = [min((abs(s - p) for p in places), default=abs(s - 0.5) * -1.0) for s in shares]
        share = float(shares[int(np.argmax(room))])
        if wide:
            x = low.real + share * size.real
            return Box(low, complex(x, high.imag)), Box(complex(x, low.imag), high)
        y = low.imag + share * size.imag
        return Box(low, complex(high.real, y)), Box(complex(low.real, y), high)


def poles_inside(equations: Shooting, box: Box) -> int:
    """How many poles, with their multiplicity, lie in ``box``.

    Raises
    ------
    NoSolution : one lies on its edge, or almost
    """
    corners = (
        box.low,
        complex(box.high.real, box.low.imag),
        box.high,
        complex(box.low.real, box.high.imag),
        box.low,
    )
    sides = [np.linspace(a, b, FIRST, endpoint=False) for a, b in zip(corners, corners[1:])]
    points = np.concatenate([*sides, [box.low]])
    angle = _angles(equations, points[:-1])
    angle = np.append(angle, angle[0])
    while True:
        turn = (np.diff(angle) + np.pi) % (2.0 * np.pi) - np.pi
        coarse = np.flatnonzero(~(np.abs(turn) < TURN))
        if not coarse.size:
            return round(float(turn.sum()) / (2.0 * np.pi))
        if len(points) > MOST or not np.isfinite(angle).all():
            raise NoSolution("the poles of the exact shaft could not be counted")
        between = 0.5 * (points[coarse] + points[coarse + 1])
        angle = np.insert(angle, coarse + 1, _angles(equations, between))
        points = np.insert(points, coarse + 1, between)


def _angles(equations: Shooting, omega: Complex) -> Array:
    parts = [omega[k : k + BATCH] for k in range(0, len(omega), BATCH)]
    return np.concatenate([phases(equations.matrix(part)) for part in parts])
