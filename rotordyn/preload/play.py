"""Axial motion of shaft and sleeves with dry friction, at many forces at once.

Every sleeve slides in the housing and touches the shaft alone, so that its position follows from
that of the shaft: friction holds it between the positions at which it would slide in either
direction (the play operator). Forces under which the shaft moves one way are solved together.

``rotordyn.preload.history`` solves the same physics event by event, for any history of loads and
temperatures. This solver serves identification, which needs thousands of machines.

Theory: docs/theory/identification.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate

import numpy as np

from bearings.ball.law import Law
from rotordyn.arrays import Array
from rotordyn.errors import NoSolution
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import Temperatures
from rotordyn.preload.arrangement import (
    HOUSING,
    SHAFT,
    Arrangement,
    AxialBearing,
    Push,
    arrangement,
    as_mounted,
    rigid,
)
from rotordyn.preload.axial_curves import BearingCurves, Curve
from rotordyn.preload.on_films import Films
from rotordyn.preload.passed_speeds import passed_speeds

GRID = np.arange(-1500.0, 500.0, 4.0)  # positions of the shaft tried around the last one
STEPS, EXACT, BALANCED = 60, 1e-12, 1e-5  # of the search between two grid points [m], [N]


@dataclass(frozen=True, eq=False, slots=True)
class BearingGroup:
    """Bearings whose outer rings one body carries, each with its curve at speed number ``row``."""

    bearings: tuple[tuple[AxialBearing, Curve], ...]
    row: int

    @classmethod
    def on(cls, body: int, joined: Arrangement, curves: list[Curve], row: int) -> BearingGroup:
        """Return the bearings of a sleeve or of the housing, which may carry none."""
        pairs = zip(joined.bearings, curves, strict=True)
        return cls(tuple((b, curve) for b, curve in pairs if b.outer == body), row)

    def __call__(self, w: Array) -> Array:
        """Return the force of the shaft on the body towards +x [N] at shaft offsets ``w`` [m]."""
        force = 0.0 * w
        for b, curve in self.bearings:
            force = force + b.thrust * len(b.seats) * curve(b.thrust * (w + b.shortening[self.row]))
        return force

    @property
    def places(self) -> Array:
        """Shaft offsets w at the points of the first bearing's curve, ascending [m]."""
        first, curve = self.bearings[0]
        return np.sort(first.thrust * curve.deflection) - first.shortening[self.row]

    def standing(self, force: float) -> float:
        """Return the shaft offset [m] at which it pushes with a ``force`` [N]."""
        w = self.places
        loads = self(w)
        if not loads[0] <= force <= loads[-1]:
            raise NoSolution(f"no bearing carries an axial force of {abs(force):.6g} N")
        return float(np.interp(force, loads, w))


@dataclass(frozen=True, eq=False)
class SlidingSleeve:
    """Sleeve with its spring and stop, its position ``place`` at rest [m], the limit of its
    ``friction`` [N], and its bearings."""

    push: Push
    place: float
    friction: float
    bearings: BearingGroup

    @cached_property
    def sliding(self) -> list[tuple[Array, Array]]:
        """Positions of the shaft, and of the sleeve about to slide towards −x and +x there."""
        w = self.bearings.places
        free = self.push.direction * self.push.preload + self.bearings(w)
        limits = -self.friction, self.friction
        positions = [self.place + (free + limit) / self.push.stiffness for limit in limits]
        return [(x + w, x) for x in positions]

    def between(self, u: Array) -> tuple[Array, ...]:
        """Return the lowest and highest position of a sticking sleeve, the shaft at u [m]."""
        if rigid(self.push):
            return np.full_like(u, self.place), np.full_like(u, self.place)
        end = self.place - self.push.direction * self.push.travel
        stopped = np.maximum if self.push.direction > 0 else np.minimum
        return tuple(stopped(np.interp(u, *table), end) for table in self.sliding)


@dataclass(frozen=True, eq=False, slots=True)
class AtSpeed:
    """Machine at one speed: sleeves, bearings in the housing, ``support`` [N/m] along the axis that
    holds the shaft at ``place`` [m]; ``unit``: 1/1000 of the largest free distance [m]."""

    sleeves: tuple[SlidingSleeve, ...]
    fixed: BearingGroup
    support: float
    place: float
    unit: float

    def solved(self, force: Array, before: Array) -> Array:
        """Return positions (n, bodies) under forces on the shaft that rise, or fall, from
        ``before`` (bodies,)."""

        def load_at(u: Array) -> tuple[Array, list[Array]]:
            load = self.support * (u - self.place) + self.fixed(u)
            places = []
            for sleeve, x in zip(self.sleeves, before[SHAFT + 1 :], strict=True):
                low, high = sleeve.between(u)
                places.append(np.minimum(np.maximum(x, low), high))
                load = load + sleeve.bearings(u - places[-1])
            return load, places

        grid = before[SHAFT] + GRID * self.unit
        load = load_at(grid)[0]
        right = np.searchsorted(load, force)
        outside = (right == 0) | (right == len(grid))
        if outside.any():
            raise NoSolution(
                f"the shaft has no axial equilibrium under {force[outside][0]:.6g} N: it is "
                "no longer restrained; lower the force, or restrain it by a spring or a stop"
            )
        left = right - 1
        ends = (grid[left], load[left] - force), (grid[right], load[right] - force)
        u = _root(lambda u: load_at(u)[0] - force, *ends)
        return np.stack([u, *load_at(u)[1]], axis=1)


def _root(
    call: Callable[[Array], Array], low: tuple[Array, Array], high: tuple[Array, Array]
) -> Array:
    """Return roots of increasing functions between brackets with values, by the Illinois method."""
    (a, fa), (b, fb) = low, high
    for _ in range(STEPS):
        rise = np.where(fb != fa, fb - fa, 1.0)
        u = np.where(fb != fa, b - fb * (b - a) / rise, 0.5 * (a + b))
        f = call(u)
        across = f * fb < 0.0
        a, fa = np.where(across, b, a), np.where(across, fb, 0.5 * fa)
        change, b, fb = np.abs(u - b), u, f
        done = (np.abs(f) < BALANCED) | (np.minimum(change, np.abs(b - a)) < EXACT)
        if done.all():
            break
    return b


@dataclass(frozen=True, eq=False, slots=True)
class AxialRunUp:
    """A machine run up from rest through ``speed`` [rad/s], then under the static ``force`` [N].

    ``bodies``: shaft, then sleeves. Positions [m]: ``mounted`` (bodies,) at rest under stated
    preloads alone, ``standstill`` also at the temperatures and under that force; ``idle``
    (speeds, bodies) under it at every speed of the run-up; ``at``: the machine at each of them.
    """

    bodies: tuple[str, ...]
    speed: Array
    force: float
    mounted: Array
    standstill: Array
    idle: Array
    at: tuple[AtSpeed, ...]

    @property
    def shift(self) -> Array:
        """Displacement of the bodies from standstill (speeds, bodies) [m]."""
        return self.idle - self.standstill

    def under(self, row: int, forces: Sequence[float] | Array) -> Array:
        """Return displacements from standstill under successive further axial forces [N], beginning
        in the idle state (forces, bodies) [m]."""
        state, positions = self.idle[row], []
        for part in _monotonic(np.asarray(forces, dtype=float)):
            positions.append(self.at[row].solved(self.force + part, state))
            state = positions[-1][-1]
        return np.concatenate(positions) - self.standstill

    def cycle(
        self,
        row: int,
        falling: Array,
        rising: Array,
        lowest: float | None = None,
        highest: float | None = None,
    ) -> tuple[Array, Array]:
        """Return shifts on both branches of a closed cycle, at forces in order of the branch [N].

        From ``highest`` to ``lowest`` and back, by default those of the forces.
        """
        forces = np.concatenate([falling, rising])
        high = float(forces.max()) if highest is None else highest
        low = float(forces.min()) if lowest is None else lowest
        path = np.concatenate([[high, low, high], falling, [low], rising])
        shifts, first = self.under(row, path)[3:], len(falling)
        return shifts[:first], shifts[first + 1 :]


def _monotonic(forces: Array) -> Iterator[Array]:
    """Yield the monotonic parts of ``forces``."""
    signs = np.sign(np.diff(forces))
    start, direction = 0, 0.0
    for k, step in enumerate(signs):
        if step * direction < 0.0:
            yield forces[start : k + 1]
            start, direction = k + 1, step
        direction = step or direction
    yield forces[start:]


def axial_run_up(
    spindle: Spindle,
    law: Law,
    speed: Array,
    force: float = 0.0,
    temperatures: Temperatures | None = None,
    curves: BearingCurves | None = None,
    films: Films | None = None,
    weight: float = 0.0,
) -> AxialRunUp:
    """Run ``spindle`` up through ``speed`` [rad/s], in this order.

    ``force``: static force on the shaft [N], of which the ``weight`` acts from assembly on, the
    rest once a speed is reached, as without a ``history`` of the conditions; ``curves``: those
    solved for previous machines; ``films`` of the balls at speed.

    Raises
    ------
    NoSolution : nothing holds the shaft, or a bearing has no state
    """
    curves = curves or BearingCurves()
    between = passed_speeds(spindle, float(speed.max(initial=0.0)), temperatures)
    speeds = np.concatenate([between, speed])
    joined = arrangement(spindle, speeds, force, law, temperatures, films)
    at_rest = [temperatures] if weight == 0.0 or temperatures is None else [None, temperatures]
    resting = [arrangement(spindle, np.zeros(1), force, law, t) for t in at_rest]
    mounted = _mounted(as_mounted(joined), curves)
    at = [
        _at_speed(spindle, arranged, of_bearings, row, mounted)
        for arranged in (*resting, joined)
        for row, of_bearings in enumerate(curves.of(arranged))
    ]
    resting_count, passing = len(resting), len(resting) + len(between)

    def under_weight(machine: AtSpeed, before: Array) -> Array:
        return machine.solved(np.array([weight]), before)[0]

    def loaded(machine: AtSpeed, before: Array) -> Array:
        state = under_weight(machine, before)
        return state if force == weight else machine.solved(np.array([force]), state)[0]

    way = list(accumulate(at[:passing], lambda state, at: under_weight(at, state), initial=mounted))
    standstill = loaded(at[resting_count - 1], way[resting_count - 1])
    begins = np.searchsorted(between, speed) + resting_count
    idle = [loaded(at_speed, way[k]) for at_speed, k in zip(at[passing:], begins, strict=True)]
    positions = np.array(idle).reshape(-1, len(mounted))
    return AxialRunUp(
        joined.bodies, speed, force, mounted, standstill, positions, tuple(at[passing:])
    )


def _mounted(resting: Arrangement, known: BearingCurves) -> Array:
    """Return the positions at rest under the stated preloads alone (bodies,) [m]."""
    curves = known.of(resting)[0]
    fixed = BearingGroup.on(HOUSING, resting, curves, 0)
    preload = sum(push.direction * push.preload for push in resting.pushes)
    shaft = fixed.standing(preload) if fixed.bearings else 0.0
    offsets = [
        BearingGroup.on(p.body, resting, curves, 0).standing(-p.direction * p.preload)
        for p in resting.pushes
    ]
    return np.array([shaft, *(shaft - offset for offset in offsets)])


def _at_speed(
    spindle: Spindle, joined: Arrangement, curves: list[Curve], row: int, mounted: Array
) -> AtSpeed:
    """Return the machine at speed number ``row``; ``mounted`` (bodies,): mounted positions [m]."""

    def group(body: int) -> BearingGroup:
        return BearingGroup.on(body, joined, curves, row)

    sleeves = tuple(
        SlidingSleeve(push, float(mounted[push.body]), sleeve.friction, group(push.body))
        for push, sleeve in zip(joined.pushes, spindle.sleeves, strict=True)
    )
    support = sum(s.along for s in spindle.supports)
    unit = 1e-3 * max(bearing.model.free_distance for bearing in joined.bearings)
    place = float(mounted[SHAFT] - joined.support_shift[row])
    return AtSpeed(sleeves, group(HOUSING), support, place, unit)
