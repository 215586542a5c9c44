"""Receptances of rotors on their supports, by elimination where that keeps its digits."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import InvalidInput
from rotordyn.system.dynamic_stiffness.coordinates import Array, Coordinates, Values
from rotordyn.system.dynamic_stiffness.elimination import Eliminated
from rotordyn.system.dynamic_stiffness.end import End
from rotordyn.system.dynamic_stiffness.links import Links
from rotordyn.system.dynamic_stiffness.motion import Equation, motion
from rotordyn.system.dynamic_stiffness.shafts import Shafts
from rotordyn.system.dynamic_stiffness.supports import Supported
from rotordyn.system.dynamic_stiffness.whirling_shaft import Whirl
from rotordyn.system.dynamic_stiffness.whole import Whole
from rotordyn.system.hysteresis import signs_of
from rotordyn.system.whirl_in_planes import are_apart

Complex = NDArray[np.complex128]
Pairs = Sequence[tuple[End, End]]
DOUBTFUL = 1e5  # terms of a pivot over their sum: five digits fewer, and all freedoms are kept
BATCH = 2048  # frequencies at once, so that what is worked on stays near the processor
ENTRIES = 2**22  # of dense matrices at once
MOST_AT_ONCE = 3000  # freedoms a plane that are solved without elimination


@dataclass(frozen=True, eq=False, slots=True)
class DirectBending:
    """Rotors on their bearings and supports at every ``speed`` (speeds,) [rad/s].

    ``supported``: of each speed; ``force`` (speeds, elements) [N]: axial force that acts on
    bending, None where it does not; ``softened``: Ω² M_ω is subtracted; ``frame`` (speeds,): the
    speed at which the coordinates turn.
    """

    shafts: Shafts
    links: Links
    speed: Array
    supported: Sequence[Supported]
    force: Array | None
    softened: bool
    frame: Array

    @property
    def whirling(self) -> bool:
        """True where forward and backward whirl are apart."""
        return self.supported[0].whirling

    @property
    def planar(self) -> NDArray[np.bool_]:
        """Speeds (speeds,) at which nothing couples the planes, of those that whirl."""
        held = np.stack([own.held for own in self.supported])
        damped = np.stack([own.damped for own in self.supported])
        return are_apart(held, damped, self.speed)

    @property
    def rounding(self) -> float:
        """Stiffness to ground that rounding may come to [N/m]."""
        return max(shaft.rounding for shaft in self.shafts.of.values())

    def receptance(self, row: int, omega: Array, pairs: Pairs) -> Complex:
        """Receptances (response, force) at one of the speeds and at ``omega`` (f,) (pairs, f).

        Of whirl in circular coordinates, where ω has either sign, if they are apart. Where the
        doubt of the elimination is large all freedoms are solved, unless they are too many.

        Raises
        ------
        InvalidInput : modal damping, which joins all freedoms, and these are too many
        """
        with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
            if any(shaft.spindle.rotor_damping for shaft in self.shafts.of.values()):
                self._refuse_too_many()
                return self._by_all_freedoms(row, omega, pairs)
            found, doubt = self._by_elimination(row, omega, pairs)
            lost = np.flatnonzero(~(doubt <= DOUBTFUL))
            if lost.size and self.shafts.size <= MOST_AT_ONCE:
                found[:, lost] = self._by_all_freedoms(row, omega[lost], pairs)
        return found

    def _refuse_too_many(self) -> None:
        if self.shafts.size > MOST_AT_ONCE:
            raise InvalidInput(
                f"modal damping joins all freedoms, and {self.shafts.size} a plane are too many to "
                f"solve at every frequency: allowed: up to {MOST_AT_ONCE}; take damping.rayleigh, "
                "method: reduced, or longer elements"
            )

    def _by_elimination(self, row: int, omega: Array, pairs: Pairs) -> tuple[Complex, Array]:
        """Receptances (pairs, f), and their doubt (f,)."""
        local = self.links.local if self.whirling else []
        few = Eliminated(self.shafts, self._kept(pairs, local))
        elements = sum(len(shaft.elements.degree) for shaft in self.shafts.of.values())
        most = max(16, min(BATCH, ENTRIES // (8 * elements)))
        found, doubt = np.empty((len(pairs), len(omega)), dtype=complex), np.empty(len(omega))
        for own in _batches(len(omega), most):
            found[:, own], doubt[own] = self._solved(row, omega[own], pairs, few, local)
        return found, doubt

    def _by_all_freedoms(self, row: int, omega: Array, pairs: Pairs) -> Complex:
        """Receptances (pairs, f)."""
        whole, most = Whole(self.shafts), max(1, ENTRIES // (2 * self.shafts.size) ** 2)
        found = np.empty((len(pairs), len(omega)), dtype=complex)
        for own in _batches(len(omega), most):
            found[:, own] = self._solved(row, omega[own], pairs, whole)[0]
        return found

    def _kept(self, pairs: Pairs, local: Sequence[int]) -> list[int]:
        """Nodes with forces, those joined to others, and one of each rotor that nothing moves."""
        nodes = {force.node for _, force in pairs} | self.links.nodes(self._others(local))
        spans = self.shafts.mesh.spans.values()
        for response, _ in pairs:
            span = next(own for own in spans if own.start <= response.node < own.stop)
            if not any(span.start <= node < span.stop for node in nodes):
                nodes.add(response.node)
        return sorted(nodes)

    def _others(self, local: Sequence[int]) -> list[int]:
        return [c for c in range(len(self.links.ends)) if c not in local]

    def _solved(
        self,
        row: int,
        omega: Array,
        pairs: Pairs,
        coordinates: Coordinates,
        local: Sequence[int] = (),
    ) -> tuple[Complex, Array]:
        """Receptances (pairs, f), and the doubt (f,) of the coordinates, which ``local``
        connections join before the others."""
        equation = self._equation(row, omega + self.frame[row], coordinates, local)
        forces = {end: column for column, end in enumerate(dict.fromkeys(f for _, f in pairs))}
        moved = motion(equation, list(forces), {response.node for response, _ in pairs})
        values = [
            end.sign * moved[end.plane, end.node][end.place, forces[force]] for end, force in pairs
        ]
        doubt = equation.dynamic.doubt.reshape(-1, len(omega)).max(axis=0)
        return np.array(values, dtype=complex), doubt

    def _equation(
        self, row: int, omega: Array, coordinates: Coordinates, local: Sequence[int]
    ) -> Equation:
        """At ``omega`` (f,) of the fixed frame."""
        whirl, own = self._whirl(row, omega), self.supported[row]
        force = None if self.force is None or not self.force[row].any() else self.force[row]
        dynamic = coordinates.dynamic(whirl, force, self._at_nodes(own, omega, local))
        matrix = self.links.widened(coordinates, dynamic.matrix, whirl.omega)
        others = self._others(local)
        rows = self.links.rows(coordinates, others)
        return Equation(coordinates, dynamic, matrix, rows, own.chosen(others), omega)

    def _whirl(self, row: int, omega: Array) -> Whirl:
        """At ω; where both ways are coupled, then at −ω."""
        turning = omega if self.whirling else np.concatenate([omega, -omega])
        spin = float(self.speed[row])
        sign = signs_of(turning, np.array(spin), whirling=True)[..., 0].astype(float)
        return Whirl(turning, sign, spin, self.softened)

    def _at_nodes(
        self, supports: Supported, omega: Array, local: Sequence[int]
    ) -> Mapping[int, Values]:
        """What the ``local`` connections add at each node (2, 2, f or 1)."""
        at: dict[int, Values] = {}
        for c, matrix in zip(local, supports.chosen(local).at(omega), strict=True):
            node = int(np.flatnonzero(self.links.ends[c])[0])
            at[node] = at[node] + matrix if node in at else matrix
        return at


def _batches(count: int, most: int) -> Iterator[slice]:
    return (slice(k, min(k + most, count)) for k in range(0, count, most))
