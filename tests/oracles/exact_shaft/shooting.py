"""All pieces of a rotor together at many whirl frequencies, by multiple shooting.

Unknowns are the states (displacements d, internal forces f) at the start of every piece. The state
at its end, changed by what sits on the node there, is that at the start of the next; both ends of
the rotor are free. What is carried from node to node (``ExactRotor``) is part of d, what acts on it
part of f. Unlike a stiffness matrix these equations stay well conditioned for short pieces.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from tests.oracles.exact_shaft.banded import empty, place
from tests.oracles.exact_shaft.rotor import ExactRotor
from tests.oracles.exact_shaft.segment import Segments, transfer

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
ENTRIES = 2**20  # of the matrices in memory at once


@dataclass(frozen=True, eq=False, slots=True)
class Shooting:
    """The equations of a rotor in its own units, banded.

    ``size``: unknowns; ``half_band``: diagonals on either side of the main one.
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

    @property
    def passage(self) -> float:
        """Time [s] that waves of all circular parts take to pass the shaft."""
        return self.rotor.planes * self.rotor.segments.passage

    def batches(self, frequencies: int, each: int = 1) -> list[slice]:
        """Which of many frequencies to take together, so that ``each`` its matrices find room."""
        most = max(1, ENTRIES // (each * self.size * (3 * self.half_band + 1)))
        return [slice(k, k + most) for k in range(0, frequencies, most)]

    def matrix(self, omega: Complex | Array) -> Complex:
        """Banded matrices (see ``banded``) at each ``omega`` (k,) [rad/s]."""
        w = self.rotor.width
        terms, through = (
            self._terms(omega),
            self._states(self._in_units(self.rotor.segments), omega),
        )
        through[..., w:, :] += terms[:, 1:] @ through[..., :w, :]
        pieces = through.shape[1]
        banded = empty(omega.shape, self.size, self.half_band)
        place(banded, terms[:, :1], np.zeros(1, int), np.zeros(1, int))
        place(banded, -np.eye(w)[None], np.zeros(1, int), np.full(1, w))
        row = w + 2 * w * np.arange(pieces)
        column = 2 * w * np.arange(pieces)
        place(banded, -through[:, :-1], row[:-1], column[:-1])
        ones = np.broadcast_to(np.eye(2 * w), (pieces - 1, 2 * w, 2 * w))
        place(banded, ones, row[:-1], column[1:])
        place(banded, through[:, -1:, w:], row[-1:], column[-1:])
        return banded

    def load(self, node: int, force: Complex) -> Complex:
        """Right side (size,) of forces and moments (w,), in SI, at a node."""
        w, right = self.rotor.width, np.zeros(self.size, dtype=complex)
        own = force * self._units / (self.unit_force * self.unit_length)
        if node == 0:
            right[:w] = own
        elif node == len(self.rotor.segments.length):
            right[self.size - w :] = own
        else:
            right[2 * w * node : 2 * w * node + w] = -own
        return right

    def displacement(self, solution: Complex, omega: Complex | Array, x: Array) -> Complex:
        """Deflections and tilts (k, len(x), w) in SI at stations ``x`` [m] of the solutions (k, …).

        Between nodes they are those of the piece itself.
        """
        w, nodes = self.rotor.width, self.rotor.x
        states = solution.reshape(len(solution), -1, 2 * w)
        piece = np.clip(np.searchsorted(nodes, x, side="right") - 1, 0, len(nodes) - 2)
        inside = self._in_units(self.rotor.segments).cut(
            piece, (x - nodes[piece]) / self.unit_length
        )
        own = self._states(inside, omega)[..., :w, :]
        return np.asarray((own @ states[:, piece, :, None])[..., 0] * self._units)

    @property
    def _units(self) -> Array:
        """Length for deflections, one for tilts (w,)."""
        bent = [self.unit_length, 1.0] * self.rotor.planes
        return np.array(bent + [self.unit_length] * (self.rotor.width - len(bent)))

    def _terms(self, omega: Complex | Array) -> Complex:
        """Dynamic stiffness of the nodes in the units of the rotor (k, nodes, w, w)."""
        units = self._units
        unit = units[:, None] * units / (self.unit_force * self.unit_length)
        return np.asarray(self.rotor.terms.at(omega, self.rotor.spin) * unit)

    def _states(self, scaled: Segments, omega: Complex | Array) -> Complex:
        """From the start to the end of pieces (k, pieces, 2w, 2w), of all that passes them."""
        w, planes = self.rotor.width, self.rotor.planes
        whole = np.zeros((*omega.shape, len(scaled.length), 2 * w, 2 * w), dtype=complex)
        for side in range(planes):
            own = transfer(scaled, omega, self.rotor.spin if side == 0 else -self.rotor.spin)
            d, f = slice(2 * side, 2 * side + 2), slice(w + 2 * side, w + 2 * side + 2)
            whole[..., d, d], whole[..., d, f] = own[..., :2, :2], own[..., :2, 2:]
            whole[..., f, d], whole[..., f, f] = own[..., 2:, :2], own[..., 2:, 2:]
        for carried in range(2 * planes, w):
            whole[..., carried, carried] = whole[..., w + carried, w + carried] = 1.0
        return whole

    def _in_units(self, own: Segments) -> Segments:
        length, force = self.unit_length, self.unit_force
        unit = {
            "length": length,
            "shear": force,
            "bending": force * length**2,
            "line_mass": force / length**2,
            "rotary": force,
            "tension": force,
        }
        return Segments(**{f.name: getattr(own, f.name) / unit[f.name] for f in fields(own)})
