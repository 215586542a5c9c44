"""All pieces of a rotor together at one whirl frequency, by multiple shooting.

Unknowns are the states (displacements d, internal forces f) at the start of every piece. The state
at its end, changed by what sits on the node there, is that at the start of the next; both ends of
the rotor are free. Unlike a stiffness matrix these equations stay well conditioned for short
pieces.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from rotordyn.exact.rotor import ExactRotor
from rotordyn.exact.segment import Segments, transfer

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True, eq=False, slots=True)
class Shooting:
    """The equations of a rotor in its own units, banded.

    ``size``: unknowns; ``half_band``: of the matrix.
    """

    rotor: ExactRotor
    unit_length: float
    unit_force: float

    @classmethod
    def of(cls, rotor: ExactRotor) -> Shooting:
        """Units in which pieces have lengths and rigidities around one."""
        length = float(np.median(rotor.segments.length))
        return cls(rotor, length, float(np.median(rotor.segments.bending)) / length**2)

    @property
    def size(self) -> int:
        """Unknowns."""
        return 2 * self.rotor.width * len(self.rotor.segments.length)

    @property
    def half_band(self) -> int:
        """Diagonals on either side of the main one."""
        return 3 * self.rotor.width - 1

    def matrix(self, omega: complex) -> Complex:
        """Banded matrix at ``omega`` [rad/s], (2·half_band + 1, size), as LAPACK has it."""
        w, b = self.rotor.width, self.half_band
        through = self._through(omega)
        pieces = len(through)
        banded = np.zeros((2 * b + 1, self.size), dtype=complex)
        start = np.concatenate([self._terms(omega)[0], -np.eye(w)], axis=1)
        _place(banded, start[None], np.zeros(1, int), np.zeros(1, int))
        row = w + 2 * w * np.arange(pieces)
        column = 2 * w * np.arange(pieces)
        _place(banded, -through[:-1], row[:-1], column[:-1])
        ones = np.broadcast_to(np.eye(2 * w), (pieces - 1, 2 * w, 2 * w))
        _place(banded, ones, row[:-1], column[1:])
        _place(banded, through[-1:, w:], row[-1:], column[-1:])
        return banded

    def load(self, node: int, freedom: int) -> Complex:
        """Right side of a unit force or moment (in SI) at a node."""
        w, right = self.rotor.width, np.zeros(self.size, dtype=complex)
        unit = 1.0 / (self._units[freedom] * self.unit_force)
        if node == 0:
            right[freedom] = unit
        elif node == len(self.rotor.segments.length):
            right[self.size - w + freedom] = unit
        else:
            right[w + 2 * w * (node - 1) + w + freedom] = -unit
        return right

    def displacement(self, solution: Complex, omega: complex) -> Complex:
        """Deflections and tilts of all nodes (nodes, w) in SI, from the unknowns."""
        w = self.rotor.width
        states = solution.reshape(-1, 2 * w)
        last = (self._through(omega)[-1] @ states[-1])[:w]
        return np.asarray(np.concatenate([states[:, :w], last[None]]) * self._units)

    @property
    def _units(self) -> Array:
        """Length for deflections, one for tilts (w,)."""
        return np.array([self.unit_length, 1.0] * self.rotor.planes)

    def _terms(self, omega: complex) -> Complex:
        """Dynamic stiffness of the nodes in the units of the rotor (nodes, w, w)."""
        units = self._units
        unit = units[:, None] * units / (self.unit_force * self.unit_length)
        return np.asarray(self.rotor.terms.at(omega, self.rotor.spin) * unit)

    def _through(self, omega: complex) -> Complex:
        """From the start of each piece to behind the node at its end (pieces, 2w, 2w)."""
        w = self.rotor.width
        scaled = self._scaled
        sides = (self.rotor.spin, -self.rotor.spin)[: self.rotor.planes]
        whole = np.zeros((len(scaled.length), 2 * w, 2 * w), dtype=complex)
        for side, spin in enumerate(sides):
            own = transfer(scaled, omega, spin)
            d, f = slice(2 * side, 2 * side + 2), slice(w + 2 * side, w + 2 * side + 2)
            whole[:, d, d], whole[:, d, f] = own[:, :2, :2], own[:, :2, 2:]
            whole[:, f, d], whole[:, f, f] = own[:, 2:, :2], own[:, 2:, 2:]
        whole[:, w:] += self._terms(omega)[1:] @ whole[:, :w]
        return whole

    @property
    def _scaled(self) -> Segments:
        length, force = self.unit_length, self.unit_force
        unit = {
            "length": length,
            "shear": force,
            "bending": force * length**2,
            "line_mass": force / length**2,
            "rotary": force,
        }
        own = self.rotor.segments
        return Segments(**{f.name: getattr(own, f.name) / unit[f.name] for f in fields(own)})


def _place(
    banded: Complex, blocks: Complex | Array, row: NDArray[np.intp], column: NDArray[np.intp]
) -> None:
    """Write blocks with their upper left corners at (row, column) into band storage."""
    half = (len(banded) - 1) // 2
    down, across = np.indices(blocks.shape[1:])
    i = row[:, None, None] + down
    j = column[:, None, None] + across
    banded[half + i - j, j] = blocks
