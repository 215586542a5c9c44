"""Bending of rotors on their supports by their assembled matrices, frequency by frequency.

No modes: what lies between the places where something acts, or is asked for, is eliminated exactly
(``whirling_shaft``), and the few equations left are solved. With supports that answer alike in all
directions forward and backward whirl are apart, and ω has either sign; otherwise the two planes
stand side by side, A + iB on y + iz being [[A, −B], [B, A]] on (y, z).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from rotordyn.errors import InvalidInput
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import SPINDLE, Sleeve
from rotordyn.numerics.chain import Chain
from rotordyn.numerics.sparse import filled
from rotordyn.system.connections import connections
from rotordyn.system.hierarchic_rotor import deflections
from rotordyn.system.hysteresis import signs_of
from rotordyn.system.mesh import Mesh
from rotordyn.system.stiffening import stiffening
from rotordyn.system.whirling_shaft import Whirl, WhirlingShaft

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Values = NDArray[np.inexact[Any]]
Motion = dict[int, Values]
DOUBTFUL = 1e5  # terms of a pivot over their sum: five digits fewer, and all freedoms are kept
BATCH = 2048  # frequencies at once, so that what is worked on stays near the processor
ENTRIES = 2**22  # of dense matrices at once
MOST_AT_ONCE = 3000  # freedoms a plane that are solved without elimination


@dataclass(frozen=True, slots=True)
class End:
    """A freedom of a ``node`` of the mesh: ``place`` 0 deflection, 1 tilt; ``plane`` 0 (y) or 1
    (z); ``sign`` −1 where the coordinate is minus the freedom."""

    node: int
    place: int
    plane: int
    sign: float


@dataclass(frozen=True, eq=False, slots=True)
class Supported:
    """Bearings, then supports, at one speed: matrices ``held`` and ``damped`` (c, k, k) between
    their ends, k = 2 in circular coordinates (complex), 4 in both planes; ``losses`` (c,)."""

    held: Values
    damped: Values
    losses: Array

    @property
    def whirling(self) -> bool:
        """True where they answer alike in all directions."""
        return self.held.shape[-1] == 2

    def added(self, matrix: Values, rows: Array, omega: Array) -> Values:
        """``matrix`` (n, n, f) with them, of coordinates that move their ends by ``rows``
        (c, k, n)."""
        gathered = [
            np.einsum("cin,cij,cjm->nm", rows, own, rows, optimize=True)
            for own in (self.held, self.damped, self._lossy)
        ]
        where = np.nonzero(sum(np.abs(own) for own in gathered))
        held, damped, lossy = (own[where][:, None] for own in gathered)
        values = _at(held, damped, lossy, omega)
        total = matrix.astype(np.result_type(matrix, values), copy=False)
        total[where] += values
        return total

    def chosen(self, which: Sequence[int]) -> Supported:
        """Some of them."""
        own = list(which)
        return Supported(self.held[own], self.damped[own], self.losses[own])

    @property
    def _lossy(self) -> Values:
        return self.losses[:, None, None] * self.held

    def at(self, omega: Array) -> Values:
        """At ``omega`` (f,): (c, k, k, f); real where nothing damps or couples the planes."""
        held, damped, lossy = (m[..., None] for m in (self.held, self.damped, self._lossy))
        return _at(held, damped, lossy, omega)


def _at(held: Values, damped: Values, lossy: Values, omega: Array) -> Values:
    total = held if held.imag.any() else held.real
    if damped.any():
        total = total + 1j * omega * damped
    if lossy.any():
        total = total + 1j * np.sign(omega) * lossy
    return np.asarray(total)


class Dynamic(Protocol):
    """All rotors in a plane at some frequencies: their ``matrix`` (n, n, f), ``doubt`` (f,) of the
    pivots, and ``motion`` of nodes (2, e, f) by that of the coordinates (n, e, f)."""

    @property
    def matrix(self) -> Values: ...
    @property
    def doubt(self) -> Array: ...
    def motion(self, moved: Values, wanted: Collection[int]) -> Motion: ...


class Coordinates(Protocol):
    """n coordinates of all rotors in a plane, and the ``rows`` (2, n) by which a node moves."""

    @property
    def size(self) -> int: ...
    def rows(self, node: int) -> Array: ...
    def dynamic(self, whirl: Whirl, force: Array | None, at: Mapping[int, Values]) -> Dynamic: ...


@dataclass(frozen=True, eq=False, slots=True)
class Shafts:
    """Every rotor by name, and the ``mesh`` that numbers their nodes."""

    mesh: Mesh
    of: Mapping[str, WhirlingShaft]

    def place(self, node: int) -> tuple[str, float]:
        """The rotor of a node, and where it is there [m]."""
        name = next(n for n, own in self.mesh.spans.items() if own.start <= node < own.stop)
        return name, float(self.mesh.stations[node])

    def element_node(self, node: int) -> int:
        """A node as the elements of its rotor count it."""
        name, x = self.place(node)
        return self.of[name].elements.mesh.node_of(x)


@dataclass(frozen=True, eq=False, slots=True)
class Eliminated:
    """The motion of the nodes ``kept``, ascending."""

    shafts: Shafts
    kept: Sequence[int]

    @property
    def size(self) -> int:
        """Deflection and tilt of each."""
        return 2 * len(self.kept)

    def rows(self, node: int) -> Array:
        """Of one of the nodes kept."""
        place = self.kept.index(node)
        return np.eye(self.size)[2 * place : 2 * place + 2]

    def dynamic(self, whirl: Whirl, force: Array | None, at: Mapping[int, Values]) -> _Chains:
        """With matrices (2, 2, f or 1) added ``at`` nodes, kept or not."""
        chains = {}
        for name, span in self.shafts.mesh.spans.items():
            own = [node for node in self.kept if span.start <= node < span.stop]
            if own:
                added = {
                    self.shafts.element_node(node): matrix
                    for node, matrix in at.items()
                    if span.start <= node < span.stop
                }
                nodes = [self.shafts.element_node(node) for node in own]
                pulled = force if name == SPINDLE else None
                chains[name] = self.shafts.of[name].chain(whirl, nodes, added, pulled)
        return _Chains(self.shafts, chains)


@dataclass(frozen=True, eq=False, slots=True)
class _Chains:
    shafts: Shafts
    chains: Mapping[str, Chain]

    @property
    def matrix(self) -> Values:
        blocks = [chain.condensed() for chain in self.chains.values()]
        return _side_by_side([b.reshape(2 * len(b), 2 * len(b), -1) for b in blocks])

    @property
    def doubt(self) -> Array:
        return np.asarray(np.max([chain.doubt for chain in self.chains.values()], axis=0))

    def motion(self, moved: Values, wanted: Collection[int]) -> Motion:
        found: Motion = {}
        begin = 0
        for name, chain in self.chains.items():
            own = moved[begin : begin + 2 * len(chain.kept)]
            begin += len(own)
            span = self.shafts.mesh.spans[name]
            nodes: dict[int, list[int]] = {}
            for node in wanted:
                if span.start <= node < span.stop:
                    nodes.setdefault(self.shafts.element_node(node), []).append(node)
            shaped = own.reshape(-1, 2, *own.shape[1:])
            for element_node, motion in chain.motion(shaped, nodes):
                found |= dict.fromkeys(nodes[element_node], motion)
        return found


@dataclass(frozen=True, eq=False, slots=True)
class Whole:
    """All freedoms of all rotors."""

    shafts: Shafts

    @property
    def size(self) -> int:
        """Of all rotors."""
        return sum(shaft.elements.size for shaft in self.shafts.of.values())

    def rows(self, node: int) -> Array:
        """Of any node."""
        return self.rows_of([node])[0]

    def rows_of(self, nodes: Sequence[int]) -> Array:
        """Of some of them (nodes, 2, n)."""
        rows = np.zeros((len(nodes), 2, self.size))
        begin = 0
        for name, span in self.shafts.mesh.spans.items():
            shaft = self.shafts.of[name]
            own = [k for k, node in enumerate(nodes) if span.start <= node < span.stop]
            x = self.shafts.mesh.stations[np.array([nodes[k] for k in own], dtype=np.intp)]
            size = shaft.elements.size
            if own:
                seen = filled(deflections(shaft.spindle, shaft.elements, x))
                rows[own, :, begin : begin + size] = seen.reshape(len(own), 2, size)
            begin += size
        return rows

    def dynamic(self, whirl: Whirl, force: Array | None, at: Mapping[int, Values]) -> _Assembled:
        """With matrices (2, 2, f or 1) added ``at`` nodes."""
        whole = _side_by_side(
            [
                shaft.assembled(whirl, force if name == SPINDLE else None)
                for name, shaft in self.shafts.of.items()
            ]
        )
        for node, added in at.items():
            rows = self.rows(node)
            whole = whole + np.einsum("in,ijf,jm->nmf", rows, added, rows)
        return _Assembled(self, whole)


@dataclass(frozen=True, eq=False, slots=True)
class _Assembled:
    coordinates: Whole
    matrix: Values

    @property
    def doubt(self) -> Array:
        return np.ones(self.matrix.shape[-1])

    def motion(self, moved: Values, wanted: Collection[int]) -> Motion:
        nodes = list(wanted)
        found = np.tensordot(self.coordinates.rows_of(nodes), moved, 1)
        return dict(zip(nodes, found, strict=True))


@dataclass(frozen=True, eq=False, slots=True)
class DirectBending:
    """Rotors on their bearings and supports at every ``speed`` (speeds,) [rad/s].

    ``supported``: of each speed; ``force`` (speeds, elements) [N]: axial force that acts on
    bending, None where it does not; ``softened``: Ω² M_ω is subtracted; ``frame`` (speeds,): the
    speed at which the coordinates turn.
    """

    spindle: Spindle
    shafts: Shafts
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
        still = [not (own.held.imag.any() or own.damped.imag.any()) for own in self.supported]
        return np.array(still) & (self.speed == 0.0)

    @property
    def rounding(self) -> float:
        """Stiffness to ground that rounding may come to [N/m]."""
        return max(shaft.rounding for shaft in self.shafts.of.values())

    def receptance(self, row: int, omega: Array, pairs: Sequence[tuple[End, End]]) -> Complex:
        """Receptances (response, force) at one of the speeds and at ``omega`` (f,) (pairs, f).

        Of whirl in circular coordinates, where ω has either sign, if they are apart. Where the
        doubt of the elimination is large all freedoms are solved, unless they are too many.

        Raises
        ------
        InvalidInput : modal damping, which joins all freedoms, and these are too many
        """
        whole, local = Whole(self.shafts), self._local
        dense = any(shaft.spindle.rotor_damping for shaft in self.shafts.of.values())
        many = whole.size > MOST_AT_ONCE
        if dense and many:
            raise InvalidInput(
                f"modal damping joins all freedoms, and {whole.size} a plane are too many to solve "
                f"at every frequency: allowed: up to {MOST_AT_ONCE}; take damping.rayleigh, "
                "method: reduced, or longer elements"
            )
        kept = self._kept(pairs, local)
        found = np.empty((len(pairs), len(omega)), dtype=complex)
        with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
            if dense:
                lost = np.ones(len(omega), dtype=bool)
            else:
                doubt = np.empty(len(omega))
                few = Eliminated(self.shafts, kept)
                for own in _batches(len(omega), self._most_at_once):
                    found[:, own], doubt[own] = self._solved(row, omega[own], pairs, few, local)
                lost = ~(doubt <= DOUBTFUL) & (not many)
            again = np.flatnonzero(lost)
            for part in _batches(len(again), max(1, ENTRIES // (2 * whole.size) ** 2)):
                at = again[part]
                found[:, at] = self._solved(row, omega[at], pairs, whole, ())[0]
        return found

    @property
    def _most_at_once(self) -> int:
        elements = sum(len(shaft.elements.degree) for shaft in self.shafts.of.values())
        return max(16, min(BATCH, ENTRIES // (8 * elements)))

    @property
    def _local(self) -> tuple[int, ...]:
        """Connections of one node with ground, which whirl on their own."""
        if not self.whirling:
            return ()
        ends, sleeves = self._ends, self._on_sleeves
        alone = (np.abs(ends).sum(axis=1) == 1.0) & ~np.abs(sleeves).any(axis=1)
        return tuple(np.flatnonzero(alone).tolist())

    @property
    def _ends(self) -> Array:
        return connections(self.spindle, self.shafts.mesh)

    @property
    def _sprung(self) -> list[Sleeve]:
        return [s for s in self.spindle.sleeves if math.isfinite(s.radial_stiffness)]

    @property
    def _on_sleeves(self) -> Array:
        """−1 where a connection stands on a sprung sleeve (connections, sleeves)."""
        rows = np.zeros((len(self._ends), len(self._sprung)))
        for k, seat in enumerate(self.spindle.seats):
            for place, sleeve in enumerate(self._sprung):
                rows[k, place] = -float(seat.name in sleeve.bearings)
        return rows

    def _kept(self, pairs: Sequence[tuple[End, End]], local: tuple[int, ...]) -> list[int]:
        """Nodes with forces, and those that connections or the drawbar join to others."""
        ends = np.delete(self._ends, list(local), axis=0)
        nodes = {force.node for _, force in pairs} | set(np.flatnonzero(ends.any(axis=0)).tolist())
        for left, right, _ in self._spans:
            nodes |= {left, right}
        for response, _ in pairs:
            span = next(
                s for s in self.shafts.mesh.spans.values() if s.start <= response.node < s.stop
            )
            if not any(span.start <= node < span.stop for node in nodes):
                nodes.add(response.node)  # of a rotor that nothing moves
        return sorted(nodes)

    @property
    def _spans(self) -> tuple[tuple[int, int, float], ...]:
        if self.force is None:
            return ()
        return stiffening(self.spindle, self.shafts.mesh).spans

    def _solved(
        self,
        row: int,
        omega: Array,
        pairs: Sequence[tuple[End, End]],
        coordinates: Coordinates,
        local: tuple[int, ...],
    ) -> tuple[Complex, Array]:
        """Receptances (pairs, f), and the doubt (f,) of the elimination."""
        spin, seen = float(self.speed[row]), omega + self.frame[row]
        signed = seen if self.whirling else np.concatenate([seen, -seen])
        sign = signs_of(signed, np.array(spin), whirling=True)[..., 0].astype(float)
        own = self.supported[row]
        ends = self._ends
        at: dict[int, Values] = {}
        for c, matrix in zip(local, own.chosen(local).at(seen), strict=True):
            node = int(np.flatnonzero(ends[c])[0])
            at[node] = at[node] + matrix if node in at else matrix
        force = None if self.force is None else self.force[row]
        force = force if force is not None and force.any() else None
        dynamic = coordinates.dynamic(Whirl(signed, sign, spin, self.softened), force, at)
        others = [c for c in range(len(ends)) if c not in local]
        rows = self._rows(coordinates, others)
        matrix = self._widened(coordinates, dynamic.matrix, signed)
        joined = partial(own.chosen(others).added, rows=rows, omega=seen)
        forces = list(dict.fromkeys(end for _, end in pairs))
        wanted = {response.node for response, _ in pairs}
        column = [forces.index(end) for _, end in pairs]
        solve = self._whirled if self.whirling else self._in_planes
        motion = solve(coordinates, dynamic, matrix, joined, forces, wanted)
        values = [
            end.sign * motion[end.plane, end.node][end.place, k]
            for (end, _), k in zip(pairs, column, strict=True)
        ]
        doubt = dynamic.doubt.reshape(-1, len(omega)).max(axis=0)
        return np.array(values, dtype=complex), doubt

    def _rows(self, coordinates: Coordinates, chosen: Sequence[int]) -> Array:
        """Deflection and tilt between the ends of connections (chosen, 2·planes, n·planes)."""
        more = len(self._sprung)
        rows = np.zeros((len(chosen), 2, coordinates.size + more))
        for own, c in zip(rows, chosen, strict=True):
            for node in np.flatnonzero(self._ends[c]):
                own[:, : coordinates.size] += self._ends[c, node] * coordinates.rows(int(node))
            own[0, coordinates.size :] = self._on_sleeves[c]
        if self.whirling:
            return rows
        n = rows.shape[-1]
        both = np.zeros((len(chosen), 4, 2 * n))
        both[:, :2, :n], both[:, 2:, n:] = rows, rows
        return both

    def _widened(self, coordinates: Coordinates, matrix: Values, omega: Array) -> Values:
        """With sleeves behind the coordinates, and the drawbar between nodes."""
        more = len(self._sprung)
        wide = np.pad(matrix, ((0, more), (0, more), (0, 0))) if more else matrix
        for place, sleeve in enumerate(self._sprung, start=coordinates.size):
            wide[place, place] += sleeve.radial_stiffness - omega**2 * sleeve.mass
        for left, right, stiffness in self._spans:
            stretch = np.zeros(len(wide))
            stretch[: coordinates.size] = (coordinates.rows(right) - coordinates.rows(left))[0]
            wide = wide + stiffness * np.outer(stretch, stretch)[..., None]
        return wide

    def _whirled(
        self,
        coordinates: Coordinates,
        dynamic: Dynamic,
        matrix: Values,
        joined: Callable[[Values], Values],
        forces: Sequence[End],
        wanted: Collection[int],
    ) -> dict[tuple[int, int], Values]:
        """Motion of nodes in circular coordinates, the same of either plane."""
        matrix = joined(matrix)
        right = np.zeros((len(matrix), len(forces)))
        for column, end in zip(right.T, forces, strict=True):
            column[: coordinates.size] = end.sign * coordinates.rows(end.node)[end.place]
        moved = _answers(matrix, right)[: coordinates.size]
        found = dynamic.motion(moved, wanted)
        return {(plane, node): motion for node, motion in found.items() for plane in (0, 1)}

    def _in_planes(
        self,
        coordinates: Coordinates,
        dynamic: Dynamic,
        matrix: Values,
        joined: Callable[[Values], Values],
        forces: Sequence[End],
        wanted: Collection[int],
    ) -> dict[tuple[int, int], Values]:
        """Motion of nodes in each plane; ``matrix`` (n, n, 2f): of whirl at ω, then at −ω."""
        n, (plus, minus) = len(matrix), np.split(matrix, 2, axis=-1)
        whole = np.empty((2 * n, 2 * n, plus.shape[-1]), dtype=complex)
        whole[:n, :n] = whole[n:, n:] = 0.5 * (plus + minus.conj())
        whole[n:, :n] = -0.5j * (plus - minus.conj())
        whole[:n, n:] = -whole[n:, :n]
        whole = joined(whole)
        right = np.zeros((2, n, len(forces)))
        for k, end in enumerate(forces):
            own = end.sign * coordinates.rows(end.node)[end.place]
            right[end.plane, : coordinates.size, k] = own
        y, z = _answers(whole, right.reshape(2 * n, -1)).reshape(2, n, len(forces), -1)
        turning = np.concatenate([y + 1j * z, (y - 1j * z).conj()], axis=-1)
        motion: dict[tuple[int, int], Values] = {}
        for node, each in dynamic.motion(turning[: coordinates.size], wanted).items():
            ahead, back = np.split(each, 2, axis=-1)
            motion[0, node] = 0.5 * (ahead + back.conj())
            motion[1, node] = -0.5j * (ahead - back.conj())
        return motion


def _answers(matrix: Values, right: Array) -> Values:
    """Solutions (n, e, f) of a batch (n, n, f); infinite where a matrix has no inverse."""
    each = np.ascontiguousarray(np.moveaxis(matrix, -1, 0))
    try:
        found = np.linalg.solve(each, right)
    except np.linalg.LinAlgError:
        found = np.stack([_answer(one, right) for one in each])
    return np.ascontiguousarray(np.moveaxis(found, 0, -1))


def _answer(matrix: Values, right: Array) -> Values:
    try:
        return np.asarray(np.linalg.solve(matrix, right))
    except np.linalg.LinAlgError:
        return np.full(right.shape, np.inf + 0j)


def _side_by_side(matrices: Sequence[Values]) -> Values:
    """Block diagonal of (k, k, f) matrices."""
    if len(matrices) == 1:
        return matrices[0]
    sizes = [len(matrix) for matrix in matrices]
    frequencies = matrices[0].shape[-1]
    kind = np.result_type(*matrices)
    whole = np.zeros((sum(sizes), sum(sizes), frequencies), dtype=kind)
    begin = 0
    for matrix in matrices:
        own = slice(begin, begin + len(matrix))
        whole[own, own] = matrix
        begin = own.stop
    return whole


def _batches(count: int, most: int) -> Iterator[slice]:
    return (slice(k, min(k + most, count)) for k in range(0, count, most))
