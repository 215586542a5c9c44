"""A network on one axis: bodies joined by bearings, springs, stops and friction.

Bodies are rigid and have one position each [m], from the mounted state at rest; the ground is at 0.
A joint of two bodies is a row of ±1 over the bodies: row · x is the position of one relative to
the other.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Flags
from rotordyn.state.laws import AxialLaw, Blend

Pieces = NDArray[np.int_]
EDGE = 1e-12  # m from a kink of a law
SMALL = 1.0  # N, least reference of rounding errors


@dataclass(frozen=True, eq=False, slots=True)
class Bearings:
    """Bearings: ``row`` (bearings, bodies): inner against outer ring; all others (bearings,):
    ``side`` ±1 by the thrust; ``count`` in tandem; ``rest``: deflection of each at rest [m]."""

    row: Array
    side: Array
    count: Array
    rest: Array


@dataclass(frozen=True, eq=False, slots=True)
class Springs:
    """Springs: ``row`` (springs, bodies); ``force`` (springs,) on the first body at rest, towards
    +x [N]; ``stiffness`` (springs,) [N/m], infinite where rigid.

    ``rigid``: springs of constant gap; with 0 for those: stiffness ``soft`` [N/m], force at rest
    ``push`` [N], and the stiffness ``matrix`` of all (bodies, bodies) [N/m].
    """

    row: Array
    force: Array
    stiffness: Array
    rigid: Flags = field(init=False)
    soft: Array = field(init=False)
    push: Array = field(init=False)
    matrix: Array = field(init=False)

    def __post_init__(self) -> None:
        rigid = np.isinf(self.stiffness)
        soft = np.where(rigid, 0.0, self.stiffness)
        derived = {
            "rigid": rigid,
            "soft": soft,
            "push": np.where(rigid, 0.0, self.force),
            "matrix": (self.row.T * soft) @ self.row,
        }
        for name, value in derived.items():
            object.__setattr__(self, name, value)


@dataclass(frozen=True, eq=False, slots=True)
class Stops:
    """One-sided constraints side·(row·x − limit) ≥ 0 [m]; ``row`` (stops, bodies), ``side``
    (stops,) +1 of a lower, −1 of an upper limit."""

    row: Array
    side: Array
    limit: Array


@dataclass(frozen=True, eq=False, slots=True)
class Frictions:
    """Coulomb friction: force on the first body within ±``limit`` (frictions,) [N]; ``start``:
    that at rest."""

    row: Array
    limit: Array
    start: Array


@dataclass(frozen=True, eq=False, slots=True)
class Network:
    """Bodies by name, and the joints between them."""

    bodies: tuple[str, ...]
    bearings: Bearings
    springs: Springs
    stops: Stops
    frictions: Frictions


@dataclass(frozen=True, eq=False, slots=True)
class Load:
    """Loads on a network: ``force`` (bodies,) [N], ``shift`` (bearings,) of the seats of inner
    rings, ``gap`` (springs,) by which springs are displaced [m], the law of every bearing."""

    force: Array
    shift: Array
    gap: Array
    laws: tuple[AxialLaw, ...]


def limits(laws: Sequence[AxialLaw], piece: Pieces) -> tuple[Array, Array]:
    """Deflections (bearings,) [m] between which every law is on its ``piece``."""
    ends = [(-np.inf, *law.kinks, np.inf) for law in laws]
    low = [kinks[k] for kinks, k in zip(ends, piece.tolist(), strict=True)]
    high = [kinks[k + 1] for kinks, k in zip(ends, piece.tolist(), strict=True)]
    return np.array(low), np.array(high)


def pieces(laws: Sequence[AxialLaw], deflection: Array, near: Pieces | None = None) -> Pieces:
    """Number of kinks of every law below its ``deflection`` (bearings,) [m].

    ``near``: the pieces before; they stay where the deflection is at a kink.
    """
    counts = [bisect_left(law.kinks, d) for law, d in zip(laws, deflection.tolist(), strict=True)]
    piece = np.array(counts, dtype=int)
    if near is None:
        return piece
    most = np.array([len(law.kinks) for law in laws], dtype=int)
    near = np.minimum(near, most)
    low, high = limits(laws, near)
    stays = (low - EDGE <= deflection) & (deflection <= high + EDGE)
    return np.where(stays, near, piece)


@dataclass(frozen=True, eq=False, slots=True)
class Forces:
    """Forces without those of stops, friction and rigid springs.

    ``force`` on the bodies (bodies,) [N]; ``stiffness`` (bodies, bodies) [N/m]; ``size``: the sum
    of the magnitudes that are added, and of 1 N [N]; of every bearing its ``deflection`` [m] and
    ``load`` [N]; ``slope`` of the law, of all in tandem [N/m].
    """

    force: Array
    stiffness: Array
    size: float
    deflection: Array
    load: Array
    slope: Array


@dataclass(frozen=True, eq=False, slots=True)
class Step:
    """Path from one load to the next; every quantity varies linearly with the share done."""

    network: Network
    start: Load
    end: Load

    @property
    def single(self) -> bool:
        """Whether only one force changes: every body then moves in one direction (K is an M-matrix:
        its inverse has no negative entry)."""
        start, end = self.start, self.end
        same = np.array_equal(start.shift, end.shift) and np.array_equal(start.gap, end.gap)
        forces = np.count_nonzero(end.force - start.force)
        return same and start.laws == end.laws and bool(forces <= 1)

    def load(self, share: float) -> Load:
        """Load at ``share`` of the step."""
        a, b = self.start, self.end
        laws = tuple(
            old if old is new else Blend(old, new, share)
            for old, new in zip(a.laws, b.laws, strict=True)
        )
        return Load(
            (1.0 - share) * a.force + share * b.force,
            (1.0 - share) * a.shift + share * b.shift,
            (1.0 - share) * a.gap + share * b.gap,
            laws,
        )

    def forces(self, x: Array, load: Load) -> Forces:
        """Compute forces and stiffness at positions ``x`` (bodies,)."""
        bearings, springs = self.network.bearings, self.network.springs
        deflection = bearings.side * (bearings.row @ x + load.shift) + bearings.rest
        pairs = [law(d) for law, d in zip(load.laws, deflection.tolist(), strict=True)]
        bearing_load, slope = np.array(pairs).reshape(-1, 2).T
        push = bearings.count * bearings.side * bearing_load
        pull = springs.push - springs.soft * (springs.row @ x - load.gap)
        return Forces(
            force=load.force + pull @ springs.row - push @ bearings.row,
            stiffness=springs.matrix + (bearings.row.T * (bearings.count * slope)) @ bearings.row,
            size=SMALL + float(np.abs(load.force).sum() + np.abs(pull).sum() + np.abs(push).sum()),
            deflection=deflection,
            load=bearing_load,
            slope=bearings.count * slope,
        )

    def beside(self, at: Forces, load: Load, piece: Pieces) -> Forces:
        """Replace the slope of every law at a kink by that of its ``piece`` (bearings,)."""
        low, high = limits(load.laws, piece)
        inside = np.clip(at.deflection, low + EDGE, high - EDGE)
        at_kink = np.flatnonzero(inside != at.deflection).tolist()
        if not at_kink:
            return at
        bearings, slope = self.network.bearings, at.slope.copy()
        for k in at_kink:
            slope[k] = bearings.count[k] * load.laws[k](inside[k])[1]
        change = (bearings.row.T * (slope - at.slope)) @ bearings.row
        return replace(at, stiffness=at.stiffness + change, slope=slope)

    def rate(self, at: Forces) -> tuple[Array, Array, float]:
        """Change of the forces (bodies,) [N] at fixed positions, and of the gaps of springs [m],
        over the whole step; the sum of the magnitudes of force that are added [N]."""
        a, b = self.start, self.end
        bearings, springs = self.network.bearings, self.network.springs
        push = at.slope * (b.shift - a.shift)
        if a.laws != b.laws:
            blended = [
                0.0 if old is new else new(d)[0] - old(d)[0]
                for old, new, d in zip(a.laws, b.laws, at.deflection.tolist(), strict=True)
            ]
            push += bearings.count * bearings.side * np.array(blended)
        gap = b.gap - a.gap
        outer, pull = b.force - a.force, springs.soft * gap
        size = float(np.abs(outer).sum() + np.abs(push).sum() + np.abs(pull).sum())
        return outer - push @ bearings.row + pull @ springs.row, gap, size
