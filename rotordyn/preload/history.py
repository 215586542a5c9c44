"""The axial network of a spindle with its memory: run up from rest, then loaded along a path.

The states of ``rotordyn.preload.state`` are solved for all speeds at once and know no history; here
friction holds sleeves where they were, so that every state is followed from the one before. The
bearings are tables of their loads and tangents at every speed; between two speeds they go over into
one another with the share of the way.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from rotordyn.preload.arrangement import HOUSING, SHAFT, Arrangement, AxialBearing, at_rest, rigid
from rotordyn.preload.network import Network as Instant
from rotordyn.preload.state import PreloadState
from rotordyn.state import NoEquilibrium
from rotordyn.state.along import along
from rotordyn.state.contacts import State
from rotordyn.state.laws import Law, sloped_table
from rotordyn.state.network import Bearings, Frictions, Load, Network, Springs, Step, Stops
from rotordyn.state.rates import compliance, turned
from rotordyn.state.rest import at_rest as mounted

Array = NDArray[np.float64]
SPACING = 1e-6  # m, of a table
FINER = 2.0 ** -np.arange(1.0, 13.0)  # of the spacing, beside the place where a law begins
REACH = 250e-6  # m
SLIDING = 1e-9  # of the limit of friction
NEAR = 2e-6  # m: a table gives the load at rest that near to where the bearing has it


@dataclass(frozen=True, eq=False, slots=True)
class History:
    """``network`` of the spindle; what acts on it at ``rest`` and at every speed, ``loads``."""

    network: Network
    rest: Load
    loads: tuple[Load, ...]

    def run_up(self) -> Iterator[State | str]:
        """The state at every speed after a run-up from rest, or why there is none."""
        state, before, reason = mounted(self.network, self.rest), self.rest, ""
        for load in self.loads:
            try:
                state = state if reason else along(Step(self.network, before, load), state)[0]
            except NoEquilibrium as none:
                reason = str(none)
            before = load
            yield reason or state

    def loaded(
        self, row: int, state: State, force: Sequence[float], start: Load | None = None
    ) -> list[State]:
        """States under axial forces [N] one after the other, at speed ``row`` from ``state``.

        ``start``: what acts in that state; None: no force besides.

        Raises
        ------
        NoEquilibrium : nothing balances a body
        """
        states, at = [], self.loads[row] if start is None else start
        for value in force:
            after = self.under(row, value)
            state = along(Step(self.network, at, after), state)[0]
            states.append(state)
            at = after
        return states

    def held(self, row: int, state: State, force: float, reach: float) -> float:
        """How much more force than ``force`` [N] the shaft bears before a sleeve that slid there
        slides back [N]; NaN where none slides, one stands at a stop, or ``reach`` is less."""
        limit = self.network.frictions.limit
        slides = np.abs(state.friction) >= limit * (1.0 - SLIDING)
        if not (limit > 0.0).any() or not slides.all() or (np.abs(state.press) > 0.0).any():
            return math.nan
        step = Step(self.network, self.under(row, force), self.under(row, force + reach))
        try:
            events = along(step, state)[1]
        except NoEquilibrium:
            return math.nan
        kinds = [event.kind for event in events]
        slip = next((k for k, kind in enumerate(kinds) if kind.startswith("slip")), None)
        if slip is None or {"open", "close"} & {*kinds[:slip]}:
            return math.nan
        return float(events[slip].share) * reach

    def under(self, row: int, force: float) -> Load:
        """Loads at the speed of ``row`` with a further axial ``force`` [N] on the shaft."""
        load = self.loads[row]
        push = load.force.copy()
        push[SHAFT] += force
        return replace(load, force=push)

    def softness(self, row: int, state: State, force: float, way: float) -> float:
        """Axial displacement of the shaft over an axial force that changes ``way`` ±1 [m/N]."""
        here, there = self.under(row, force), self.under(row, force + way)
        step = Step(self.network, here, there)
        return way * float(compliance(step, turned(step, state))[SHAFT])


def history(preload: PreloadState, reach: float) -> History:
    """The network of a spindle with the friction of its sleeves, at the speeds of ``preload``.

    ``reach``: largest axial force of the paths [N].
    """
    joined, still = preload.network.arrangement, preload.still
    most = 2.0 * (reach + abs(preload.force) + float(np.abs(preload.network.springs.force).sum()))
    resting = at_rest(joined)
    start = Instant(resting, preload.network.springs).deflection(still.position)[0]
    laws = _laws(resting, 0, most)
    deflection = [
        _where(law, load, d)
        for law, load, d in zip(laws, still.response.load[0].tolist(), start.tolist(), strict=True)
    ]
    network = _network(preload, np.array(deflection))
    zero = np.zeros(len(joined.bodies))
    force = zero.copy()
    force[SHAFT] = preload.force
    gap = np.zeros(len(network.springs.force))
    loads = tuple(
        Load(
            force,
            np.array([bearing.shortening[row] for bearing in joined.bearings]),
            gap,
            _laws(joined, row, most),
        )
        for row in range(len(joined.speed))
    )
    return History(network, Load(zero, np.zeros(len(laws)), gap, laws), loads)


def _network(preload: PreloadState, deflection: Array) -> Network:
    joined = preload.network.arrangement
    names = list(joined.bodies)
    rows = np.eye(len(names))
    pushes, sleeves = joined.pushes, preload.spindle.sleeves
    ends = [rows[b.outer] if b.outer != HOUSING else 0.0 * rows[0] for b in joined.bearings]
    along_x = sum(support.along for support in preload.spindle.supports)
    stops = [push for push in pushes if math.isfinite(push.travel) and not rigid(push)]
    rubbing = [k for k, sleeve in enumerate(sleeves) if sleeve.friction > 0.0]
    return Network(
        bodies=joined.bodies,
        bearings=Bearings(
            rows[SHAFT] - np.array(ends),
            np.array([float(bearing.thrust) for bearing in joined.bearings]),
            np.array([float(len(bearing.seats)) for bearing in joined.bearings]),
            deflection,
        ),
        springs=Springs(
            np.array([rows[SHAFT], *(rows[push.body] for push in pushes)]),
            np.array([0.0, *(push.direction * push.preload for push in pushes)]),
            np.array([along_x, *(push.stiffness for push in pushes)]),
        ),
        stops=Stops(
            rows[[push.body for push in stops]],
            np.array([float(push.direction) for push in stops]),
            np.array([-push.direction * push.travel for push in stops]),
        ),
        frictions=Frictions(
            rows[[k + 1 for k in rubbing]],
            np.array([sleeves[k].friction for k in rubbing]),
            np.zeros(len(rubbing)),
        ),
    )


def _laws(joined: Arrangement, row: int, most: float) -> tuple[Law, ...]:
    return tuple(_table(bearing, joined.speed[row], row, most) for bearing in joined.bearings)


def _table(bearing: AxialBearing, speed: float, row: int, most: float) -> Law:
    """Axial loads and tangents of one bearing, up to the load ``most`` [N]."""
    from bearings.ring.tangents import stiffness

    high = 0.25 * REACH
    while True:
        even = np.arange(-round(REACH / SPACING), round(high / SPACING) + 1) * SPACING
        d = np.unique(np.concatenate([even, SPACING * FINER, -SPACING * FINER]))
        displacement = np.zeros((len(d), 5))
        displacement[:, 0] = d
        state = bearing.model.equilibrium(
            displacement=displacement,
            speed=speed,
            static_growth=bearing.static_growth,
            growth=bearing.growth[row],
            **asdict(bearing.law),
        )
        load, slope = state.load[:, 0], stiffness(state, "complete")[:, 0, 0]
        known = np.isfinite(load) & np.isfinite(slope)
        if load[known][-1] >= most or high > REACH or not known[-1]:
            return sloped_table(*(one[known].tolist() for one in (d, load, slope)))
        high *= 2.0


def _where(law: Law, load: float, near: float) -> float:
    """Deflection [m] at which the table has a load at rest."""
    if law(near)[0] == load:
        return near
    return float(brentq(lambda d: law(d)[0] - load, near - NEAR, near + NEAR, xtol=1e-18))
