"""Shaft and sleeves along the axis with dry friction, at many forces at once.

Every sleeve slides in the housing and touches the shaft alone, so that its place follows from that
of the shaft: friction leaves it where it is between the places at which it would slide either way
(the play operator). Where the shaft moves one way, all forces of the way are solved together.

``rotordyn.preload.history`` solves the same physics event by event, for any history of loads and
temperatures. This one stands beside it for identification, which asks for thousands of machines: a
cycle of friction at 3 speeds takes 26 ms here and 330 to 440 ms there; positions agree within 2 nm.

Theory: docs/theory/identification.md.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from bearings.ball.law import Law, Laws
from rotordyn.errors import NoSolution
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.temperatures import Temperatures
from rotordyn.preload.arrangement import (
    HOUSING,
    SHAFT,
    Arrangement,
    AxialBearing,
    arrangement,
    at_rest,
    rigid,
)

Array = NDArray[np.float64]
# dense near 0, by halving steps above it: there the law d^1.5 of a bearing at rest is not smooth
PARTS = ((-300.0, -100.0, 20.0), (-100.0, -40.0, 4.0), (-40.0, 50.0, 1.5), (50.0, 80.1, 5.0))
SOLVED = np.unique(
    np.concatenate([*(np.arange(*each) for each in PARTS), 2.0 ** -np.arange(0.0, 8.0), [0.0]])
)  # µm, deflections at which bearings are solved
FINE = np.unique(
    np.round(np.concatenate([np.arange(-300.0, 80.1), np.arange(-40.0, 40.0, 0.1)]), 1) * 1e-6
)  # m, the spline through them, drawn straight between
FAR = 5e-3  # m, to which a curve goes on beyond the spline: constant below, straight above
GRID = np.arange(-1500.0, 500.0, 4.0) * 1e-6  # m, places of the shaft tried around the last one
STEPS, EXACT, BALANCED = 60, 1e-12, 1e-5  # of the search between two places of the grid [m], [N]
MOST_KEPT = 400  # curves, of which a fit over many machines would fill the memory


@dataclass(frozen=True, eq=False, slots=True)
class Curve:
    """Axial load [N] over deflection [m], never falling; linear between its points."""

    deflection: Array
    load: Array

    def __call__(self, d: Array) -> Array:
        """Loads [N]."""
        return np.interp(d, self.deflection, self.load)


@dataclass
class Tables:
    """Curves of bearings solved so far, by what they depend on."""

    known: dict[tuple[object, ...], Curve] = field(default_factory=dict)

    def of(self, joined: Arrangement) -> list[list[Curve]]:
        """The curve of every bearing at every speed."""
        keys = [
            [_key(b, omega, k) for b in joined.bearings] for k, omega in enumerate(joined.speed)
        ]
        missing = {
            key: (b, k)
            for k, row in enumerate(keys)
            for key, b in zip(row, joined.bearings, strict=True)
            if key not in self.known
        }
        for key in list(self.known)[: max(0, len(self.known) + len(missing) - MOST_KEPT)]:
            if not any(key in row for row in keys):
                del self.known[key]
        alike: dict[tuple[object, Law | Laws], list[tuple[object, ...]]] = {}
        for key, (bearing, _) in missing.items():
            alike.setdefault((bearing.model, bearing.law), []).append(key)
        for group in alike.values():
            self._solve([(key, *missing[key]) for key in group], joined.speed)
        return [[self.known[key] for key in row] for row in keys]

    def _solve(
        self, group: list[tuple[tuple[object, ...], AxialBearing, int]], speed: Array
    ) -> None:
        """Bearings of one model and law, all in one call."""
        from bearings.ring.tangents import stiffness

        first, rows = group[0][1], [k for _, _, k in group]
        displacement = np.zeros((len(group), len(SOLVED), 5))
        displacement[..., 0] = SOLVED * 1e-6
        state = first.model.equilibrium(
            displacement=displacement,
            speed=speed[rows][:, None],
            static_growth=np.array([b.static_growth for _, b, _ in group])[:, None],
            growth=np.array([b.growth[k] for _, b, k in group])[:, None],
            **asdict(first.law),
        )
        slopes = stiffness(state, "complete")[..., 0, 0]
        for (key, b, k), load, slope in zip(group, state.load[..., 0], slopes, strict=True):
            self.known[key] = _curve(load, slope, _stateless(b, speed[k], k))


def _key(bearing: AxialBearing, speed: float, row: int) -> tuple[object, ...]:
    seat = bearing.static_growth, float(bearing.growth[row])
    return bearing.model, bearing.law, *seat, float(speed)


def _stateless(bearing: AxialBearing, speed: float, row: int) -> str:
    """What there is to say of a bearing that no deflection brings into balance."""
    rpm, growth = speed * 30.0 / np.pi, bearing.growth[row] * 1e6
    return (
        f"bearing number {bearing.seats[0] + 1} of the spindle at {rpm:.6g} rpm, groove growth "
        f"{growth:.4g} µm: it has no axial state at any deflection; lower the speed or the growth"
    )


def _curve(load: Array, slope: Array, otherwise: str) -> Curve:
    from scipy.interpolate import CubicHermiteSpline

    good = np.isfinite(load) & np.isfinite(slope)
    if good.sum() < 2:
        raise NoSolution(otherwise)
    d, load, slope = SOLVED[good] * 1e-6, load[good], slope[good]
    inside = FINE[(d[0] <= FINE) & (d[-1] >= FINE)]
    fine = np.maximum.accumulate(CubicHermiteSpline(d, load, slope)(inside))
    step = (fine[-1] - fine[-2]) / (inside[-1] - inside[-2])
    loads = np.concatenate([fine[:1], fine, [fine[-1] + step * (FAR - inside[-1])]])
    return Curve(np.concatenate([[-FAR], inside, [FAR]]), loads)


@dataclass(frozen=True, eq=False, slots=True)
class Carrier:
    """Bearings of one sleeve, or of the housing: ``thrust``, ``count``, ``curve``, ``shift`` [m] of
    the shaft at each."""

    thrust: Array
    count: Array
    curve: tuple[Curve, ...]
    shift: Array

    def __call__(self, w: Array) -> Array:
        """Force of the shaft on it towards +x where the shaft stands by w [m] off [N]."""
        parts = zip(self.thrust, self.count, self.curve, self.shift, strict=True)
        return np.asarray(sum(t * n * c(t * (w + s)) for t, n, c, s in parts) + 0.0 * w)

    @property
    def places(self) -> Array:
        """Offsets w of the shaft at which the first of its curves has points, ascending [m]."""
        return np.sort(self.thrust[0] * self.curve[0].deflection) - self.shift[0]

    def standing(self, force: float) -> float:
        """Where the shaft stands off as it pushes with a force [m]."""
        w = self.places
        loads = self(w)
        if not loads[0] <= force <= loads[-1]:
            raise NoSolution(f"no bearing carries an axial force of {abs(force):.6g} N")
        return float(np.interp(force, loads, w))


@dataclass(frozen=True, eq=False)
class Slide:
    """A sleeve: ``pushes`` [N] at its ``place`` at rest [m], spring ``stiffness`` [N/m], limit of
    ``friction`` [N], ends of its way [m]; ``way``: +1 where the spring pushes towards
    +x; its bearings."""

    way: int
    pushes: float
    place: float
    stiffness: float
    friction: float
    low: float
    high: float
    carrier: Carrier

    @cached_property
    def sliding(self) -> list[tuple[Array, Array]]:
        """Positions of the shaft, and of the sleeve that just slides towards −x and +x there."""
        w = self.carrier.places
        free = self.pushes + self.carrier(w)
        found = [self.place + (free + f) / self.stiffness for f in (-self.friction, self.friction)]
        return [(x + w, x) for x in found]

    def between(self, u: Array) -> tuple[Array, ...]:
        """Lowest and highest place at which friction holds the sleeve, the shaft at u [m]."""
        if np.isinf(self.stiffness):
            return np.full_like(u, self.place), np.full_like(u, self.place)
        low, high = (np.interp(u, *each) for each in self.sliding)
        return tuple(np.minimum(np.maximum(x, self.low), self.high) for x in (low, high))


@dataclass(frozen=True, eq=False, slots=True)
class Instant:
    """The machine at one speed: sleeves, bearings in the housing, ``support`` [N/m] along the axis
    that holds the shaft at ``place`` [m]."""

    slides: tuple[Slide, ...]
    fixed: Carrier
    support: float
    place: float

    def solved(self, force: Array, before: Array) -> Array:
        """Positions (n, bodies) under forces on the shaft that rise, or fall, from ``before``
        (bodies,)."""

        def total(u: Array) -> tuple[Array, list[Array]]:
            held = self.support * (u - self.place) + self.fixed(u)
            places = []
            for slide, x in zip(self.slides, before[SHAFT + 1 :], strict=True):
                low, high = slide.between(u)
                places.append(np.minimum(np.maximum(x, low), high))
                held = held + slide.carrier(u - places[-1])
            return held, places

        grid = before[SHAFT] + GRID
        held = total(grid)[0]
        right = np.searchsorted(held, force)
        outside = (right == 0) | (right == len(grid))
        if outside.any():
            raise NoSolution(
                f"the shaft has no axial equilibrium under {force[outside][0]:.6g} N: nothing "
                "holds it any longer; lower the force, or hold it with a spring or a stop"
            )
        left = right - 1
        ends = (grid[left], held[left] - force), (grid[right], held[right] - force)
        u = _root(lambda u: total(u)[0] - force, *ends)
        return np.stack([u, *total(u)[1]], axis=1)


def _root(
    call: Callable[[Array], Array], low: tuple[Array, Array], high: tuple[Array, Array]
) -> Array:
    """Roots between places with their values, of functions that rise, by the Illinois rule."""
    (a, fa), (b, fb) = low, high
    for _ in range(STEPS):
        rise = np.where(fb != fa, fb - fa, 1.0)
        u = np.where(fb != fa, b - fb * (b - a) / rise, 0.5 * (a + b))
        f = call(u)
        across = f * fb < 0.0
        a, fa = np.where(across, b, a), np.where(across, fb, 0.5 * fa)
        moved, b, fb = np.abs(u - b), u, f
        done = (np.abs(f) < BALANCED) | (np.minimum(moved, np.abs(b - a)) < EXACT)
        if done.all():
            break
    return b


@dataclass(frozen=True, eq=False, slots=True)
class Axial:
    """A machine run up from rest through ``speed`` [rad/s], under the static ``force`` [N].

    ``bodies``: shaft, then sleeves. ``mounted`` (bodies,): where they stand at rest under stated
    preloads alone, ``still`` under that force and at the temperatures, too; ``idle`` (speeds,
    bodies): at every speed after the run-up [m].
    """

    bodies: tuple[str, ...]
    speed: Array
    force: float
    mounted: Array
    still: Array
    idle: Array
    instants: tuple[Instant, ...]

    @property
    def shift(self) -> Array:
        """How far bodies are from where they stand at rest (speeds, bodies) [m]."""
        return self.idle - self.still

    def under(self, row: int, forces: Sequence[float] | Array) -> Array:
        """The same under further axial forces [N] one after the other, from the idle state."""
        state, found = self.idle[row], []
        for part in _ways(np.asarray(forces, dtype=float)):
            found.append(self.instants[row].solved(self.force + part, state))
            state = found[-1][-1]
        return np.concatenate(found) - self.still

    def cycle(
        self,
        row: int,
        falling: Array,
        rising: Array,
        lowest: float | None = None,
        highest: float | None = None,
    ) -> tuple[Array, Array]:
        """Shifts on both branches of a closed cycle, at forces in the order of the branch [N].

        From ``highest`` to ``lowest`` and back, by default those of the forces.
        """
        every = np.concatenate([falling, rising])
        high = float(every.max()) if highest is None else highest
        low = float(every.min()) if lowest is None else lowest
        path = np.concatenate([[high, low, high], falling, [low], rising])
        shifts, first = self.under(row, path)[3:], len(falling)
        return shifts[:first], shifts[first + 1 :]


def _ways(forces: Array) -> Iterator[Array]:
    """Parts along which forces do not turn."""
    sign = np.sign(np.diff(forces))
    start, way = 0, 0.0
    for k, one in enumerate(sign):
        if one * way < 0.0:
            yield forces[start : k + 1]
            start, way = k + 1, one
        way = one or way
    yield forces[start:]


def axial(
    spindle: Spindle,
    law: Law,
    speed: Array,
    force: float = 0.0,
    temperatures: Temperatures | None = None,
    tables: Tables | None = None,
    without_stop: str | None = None,
) -> Axial:
    """``spindle`` run up through ``speed`` [rad/s], in this order.

    ``force``: static one on the shaft [N]; ``without_stop``: a sleeve whose stop is left out.

    Raises
    ------
    NoSolution : nothing holds the shaft, or a bearing has no state
    """
    joined = arrangement(spindle, speed, force, law, temperatures)
    tables = tables or Tables()
    mounted = _mounted(at_rest(joined), tables)
    warm = arrangement(spindle, np.zeros(1), force, law, temperatures)
    rest = _instant(spindle, warm, 0, tables.of(warm)[0], mounted, without_stop)
    states = [rest.solved(np.array([force]), mounted)[0]]
    instants = []
    for row, curves in enumerate(tables.of(joined)):
        instants.append(_instant(spindle, joined, row, curves, mounted, without_stop))
        states.append(instants[-1].solved(np.array([force]), states[-1])[0])
    idle = np.array(states[1:]).reshape(len(instants), len(mounted))
    return Axial(joined.bodies, speed, force, mounted, states[0], idle, tuple(instants))


def _carrier(joined: Arrangement, row: int, curves: list[Curve], body: int) -> Carrier:
    """Bearings whose outer rings a body holds; a housing may hold none."""
    carried = [k for k, bearing in enumerate(joined.bearings) if bearing.outer == body]
    bearings = [joined.bearings[k] for k in carried]
    return Carrier(
        np.array([float(bearing.thrust) for bearing in bearings]),
        np.array([float(len(bearing.seats)) for bearing in bearings]),
        tuple(curves[k] for k in carried),
        np.array([float(bearing.shortening[row]) for bearing in bearings]),
    )


def _mounted(resting: Arrangement, tables: Tables) -> Array:
    """Positions at rest under the stated preloads alone (bodies,) [m]."""
    curves = tables.of(resting)[0]
    fixed = _carrier(resting, 0, curves, HOUSING)
    pushed = sum(push.direction * push.preload for push in resting.pushes)
    shaft = fixed.standing(pushed) if fixed.curve else 0.0
    off = [
        _carrier(resting, 0, curves, push.body).standing(-push.direction * push.preload)
        for push in resting.pushes
    ]
    return np.array([shaft, *(shaft - each for each in off)])


def _instant(
    spindle: Spindle,
    joined: Arrangement,
    row: int,
    curves: list[Curve],
    mounted: Array,
    without_stop: str | None,
) -> Instant:
    slides = []
    for push, sleeve in zip(joined.pushes, spindle.sleeves, strict=True):
        place = float(mounted[push.body])
        travel = np.inf if rigid(push) or sleeve.name == without_stop else push.travel
        end = place - push.direction * travel
        slides.append(
            Slide(
                push.direction,
                push.direction * push.preload,
                place,
                push.stiffness,
                sleeve.friction,
                end if push.direction > 0 else -np.inf,
                end if push.direction < 0 else np.inf,
                _carrier(joined, row, curves, push.body),
            )
        )
    support = sum(each.along for each in spindle.supports)
    fixed = _carrier(joined, row, curves, HOUSING)
    return Instant(tuple(slides), fixed, support, float(mounted[SHAFT]))
