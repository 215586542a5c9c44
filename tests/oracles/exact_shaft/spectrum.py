"""All modes of an exact rotor in a rectangle of frequencies: as many as are counted there."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import NoSolution
from tests.oracles.exact_shaft.box import Box, poles_inside
from tests.oracles.exact_shaft.count import countable, modes_below
from tests.oracles.exact_shaft.poles import ExactMode, neighbours, reached
from tests.oracles.exact_shaft.shooting import Shooting

Complex = NDArray[np.complex128]
SAME = 1e-6  # of |ω|: nearer roots are one until their vectors are distinguished
DEPTH = 60  # halvings of the rectangle


def modes_inside(equations: Shooting, box: Box, starts: Complex) -> list[ExactMode]:
    """The modes in ``box``, ascending by real part; those that coincide each with its own vector.

    ``starts`` (k,) [rad/s] only save time: their number is compared with the count of poles, and
    what they do not lead to is looked for by halving the rectangle. Pieces must be short enough for
    the whole of it (``ExactRotor.up_to``).

    Raises
    ------
    NoSolution : not as many modes were reached as there are
    """
    found = _Found(equations, box)
    found.take(starts)
    found.complete(box, DEPTH)
    return sorted(found.modes, key=lambda mode: mode.omega.real)


def modes_near(equations: Shooting, box: Box, starts: Complex) -> list[ExactMode]:
    """The modes in ``box`` that are reached from ``starts`` (k,) [rad/s], and those beside them;
    not counted."""
    found = _Found(equations, box)
    found.take(starts)
    if len(found.modes) < len(starts):
        found.part(box)
    return found.modes


def _number(equations: Shooting, box: Box) -> int:
    """Poles in ``box``, by signs of the dynamic stiffness where these tell, else by argument."""
    if countable(equations.rotor) and box.low.real * box.high.real > 0.0:
        if not box.low.imag < 0.0 < box.high.imag:
            return 0
        ends = [modes_below(equations.rotor, end) for end in (box.low.real, box.high.real)]
        return abs(ends[1] - ends[0])
    return poles_inside(equations, box)


class _Found:
    """Modes reached so far."""

    def __init__(self, equations: Shooting, box: Box) -> None:
        self.equations, self.box = equations, box
        self.modes: list[ExactMode] = []

    def take(self, starts: Complex, vectors: Complex | None = None) -> None:
        """Add what is reached from ``starts`` and is new."""
        for mode in reached(self.equations, starts, vectors) if len(starts) else []:
            if mode is not None and mode.omega in self.box and not self._known(mode.omega):
                self.modes.append(mode)

    def complete(self, box: Box, depth: int) -> None:
        """Find what is still missing in ``box``."""
        number = _number(self.equations, box)
        if self._inside(box) < number and self._inside(box):
            self.part(box)
        if self._inside(box) < number:
            self.take(np.array([box.middle]))
        if self._inside(box) == number:
            return
        if self._inside(box) > number or depth == 0:
            raise NoSolution(
                f"{number} modes of the exact shaft were counted from {box.low:.6g} to "
                f"{box.high:.6g} rad/s and {self._inside(box)} were reached"
            )
        for half in box.cut([mode.omega for mode in self.modes if mode.omega in box]):
            self.complete(half, depth - 1)

    def part(self, box: Box) -> None:
        """Find what lies beside the known modes of ``box``; give every mode of a shared root its
        own vector."""
        for mode in [m for m in self.modes if m.omega in box]:
            near = neighbours(self.equations, mode.omega)
            twins = [m for m in near if _same(m.omega, mode.omega)]
            if len(twins) > 1 and sum(_same(m.omega, mode.omega) for m in self.modes) == 1:
                self.modes.remove(mode)
                self.modes += twins
            for other in near:
                if other.omega in box and not self._known(other.omega):
                    self.take(np.array([other.omega]), other.unknowns[None])

    def _inside(self, box: Box) -> int:
        return sum(mode.omega in box for mode in self.modes)

    def _known(self, omega: complex) -> bool:
        return any(_same(mode.omega, omega) for mode in self.modes)


def _same(one: complex, other: complex) -> bool:
    return abs(one - other) <= SAME * abs(other)
