"""A rectangle of complex frequencies, and how many poles of a rotor lie in it.

The determinant of the shooting equations is an entire function of ω: transfer matrices are power
series in p(ω) and q(ω). Its argument therefore grows by 2π around every pole inside.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import NoSolution
from tests.oracles.exact_shaft.banded import phases
from tests.oracles.exact_shaft.shooting import Shooting

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
SPACING = 0.2  # of its shorter side, of the points at first
PASSED = 1.0  # rad by which waves turn from point to point at first
TURN = 0.8  # rad between neighbouring points at most
MOST = 40000  # points


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

    Points on its edge are halved where the argument turns far, and all once more until the number
    stays.

    Raises
    ------
    NoSolution : one lies on its edge, or almost
    """
    points = _edge(equations, box)
    angle = _angles(equations, points[:-1])
    angle = np.append(angle, angle[0])
    before = None
    while len(points) < MOST and np.isfinite(angle).all():
        turn = (np.diff(angle) + np.pi) % (2.0 * np.pi) - np.pi
        coarse = np.flatnonzero(np.abs(turn) > TURN)
        if not coarse.size:
            number = round(float(turn.sum()) / (2.0 * np.pi))
            if number == before:
                return number
            before, coarse = number, np.arange(len(turn))
        between = 0.5 * (points[coarse] + points[coarse + 1])
        angle = np.insert(angle, coarse + 1, _angles(equations, between))
        points = np.insert(points, coarse + 1, between)
    raise NoSolution("the poles of the exact shaft could not be counted")


def _edge(equations: Shooting, box: Box) -> Complex:
    """Points around ``box``, the first again at the end.

    They are close against the distance of poles inside, and against what the argument turns by as
    waves pass the shaft.
    """
    low, high = box.low, box.high
    corners = (low, complex(high.real, low.imag), high, complex(low.real, high.imag), low)
    spacing = min(SPACING * min(box.size.real, box.size.imag), PASSED / equations.passage)
    sides = [
        np.linspace(a, b, 2 + min(MOST // 8, int(abs(b - a) / spacing)), endpoint=False)
        for a, b in pairwise(corners)
    ]
    return np.concatenate([*sides, [low]])


def _angles(equations: Shooting, omega: Complex) -> Array:
    parts = equations.batches(len(omega))
    return np.concatenate([phases(equations.matrix(omega[part])) for part in parts])
