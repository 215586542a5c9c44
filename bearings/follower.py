"""A bearing followed from state to state, for loops and time marching."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from bearings.arrays import Array, Flags
from bearings.ball.law import STANDARD, Law
from bearings.bearing import BallBearing
from bearings.errors import InvalidBearing, NoEquilibrium, shown
from bearings.geometry import acting, geometry, groove_origin
from bearings.ring.assembly import full_assembly
from bearings.ring.equilibrium import one_by_one
from bearings.ring.operation import finite_numbers, five_numbers
from bearings.ring.problem import Problem, compliances, first_displacement, turns

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class Followed(NamedTuple):
    """States: ``load``, ``displacement`` (…, 5), ``stiffness`` (…, 5, 5), ``converged`` (…).

    SI, as in ``BearingState``; NaN where there is no state.
    """

    load: Array
    displacement: Array
    stiffness: Array
    converged: Flags


class Follower:
    """Solver of one bearing at a speed, which starts every state from the last.

    Load, displacement and tangent only, by the compiled solver, which the first call of a process
    loads and the first of all compiles (what that costs: benchmarks). Under inner control and the
    geometric hypothesis, where a light ball may be loaded or free at the same place, every state is
    solved independently instead.

    Parameters
    ----------
    bearing, static_growth, growth : as in ``BallBearing.equilibrium``, single values
    law : hypotheses about the balls
    speed : [rad/s], where a call gives none

    Raises
    ------
    InvalidBearing : not single finite numbers, no contact angle left
    """

    def __init__(
        self,
        bearing: BallBearing,
        *,
        speed: float = 0.0,
        static_growth: float = 0.0,
        growth: float | None = None,
        law: Law = STANDARD,
    ) -> None:
        for argument, kind in ((bearing, BallBearing), (law, Law)):
            if not isinstance(argument, kind):
                raise InvalidBearing(f"a follower takes a {kind.__name__}, got {shown(argument)}")
        static = finite_numbers("static_growth", static_growth, single=True)
        total = static if growth is None else finite_numbers("growth", growth, single=True)
        self._bearing = bearing
        self.speed = float(finite_numbers("speed", speed, single=True)[0])
        self._geometry, self._law = acting(geometry(bearing.grooves), law.dynamics), law
        self._origin = groove_origin(self._geometry, static, total)
        self._compliances = compliances(bearing.grooves)
        if not np.isfinite(self._origin).all():
            raise InvalidBearing("static growth reduces the contact angle to 0; reduce the fit")
        self._last: tuple[Array, Array] | None = None  # (d (1, 5), X (2, 1, n))

    def load(self, displacement: ArrayLike, speed: ArrayLike | None = None) -> Followed:
        """Loads (…, 5) at displacements (…, 5), one after the other, with their tangents.

        Raises
        ------
        InvalidBearing : numbers that are not finite, shapes
        NoEquilibrium : a single state does not exist
        """
        displacements = five_numbers("displacement", displacement)
        return self._followed(displacements, np.zeros_like(displacements), speed, free=False)

    def displacement(self, load: ArrayLike, speed: ArrayLike | None = None) -> Followed:
        """Displacements (…, 5) under loads (…, 5); the rest as for ``load``.

        Raises
        ------
        InvalidBearing : also for a load that this kind cannot carry
        """
        loads = five_numbers("load", load)
        self._bearing.check_load(loads.reshape(-1, 5), np.ones(5, dtype=bool))
        return self._followed(np.zeros_like(loads), loads, speed, free=True)

    def _followed(
        self, move: Array, load: Array, speed: ArrayLike | None, *, free: bool
    ) -> Followed:
        """Solve states in order, in runs that are all at rest or all turning."""
        shape = load.shape[:-1]
        if speed is None:
            omega = np.full(shape, abs(self.speed)).reshape(-1)
        else:
            speeds = np.abs(finite_numbers("speed", speed))
            try:
                omega = np.broadcast_to(speeds, shape).reshape(-1)
            except ValueError as error:
                what = f"speed {speeds.shape} does not fit states {shape}"
                raise InvalidBearing(what) from error
        if not omega.size:
            return Followed(load, move, np.zeros((*shape, 5, 5)), np.zeros(shape, dtype=bool))
        move, load, turn = move.reshape(-1, 5), load.reshape(-1, 5), turns(self._geometry, omega)
        ends = (0, *((turn[1:] != turn[:-1]).nonzero()[0] + 1), len(turn))
        parts: Any = [
            self._solved(move[a:b], load[a:b], omega[a:b], free=free, turning=bool(turn[a]))
            for a, b in itertools.pairwise(ends)
        ]
        states = parts[0]
        if len(parts) > 1:
            states = [np.concatenate(part) for part in zip(*parts, strict=True)]
        converged = states[-1]
        if shape == () and not converged[0]:
            word = "unloaded" if free and not load.any() else "no equilibrium"
            raise NoEquilibrium(word, speed=float(omega[0]), remedy="see `equilibrium` for why")
        return Followed(*[part.reshape((*shape, *part.shape[1:])) for part in states])

    def _solved(
        self, move: Array, load: Array, omega: Array, *, free: bool, turning: bool
    ) -> Followed:
        """Solve states that are all at rest or all turning."""
        problem = Problem(
            geometry=self._geometry,
            law=self._law,
            assembly=full_assembly(self._geometry),
            origin=self._origin.repeat(len(omega), axis=1),
            speed=omega,
            load=load,
            free=np.full(5, free),
            turning=turning,
            compliances=self._compliances,
        )
        last_ball, chained = None, self._law.one_branch
        if self._last is not None and chained:
            last_displacement, last_ball = self._last
            move = np.repeat(last_displacement, len(omega), axis=0) if free else move
        elif free:
            move = first_displacement(problem, move)
        d, ball, carried, stiffness, outcome = one_by_one(problem, move, last_ball, chained=chained)
        converged = outcome == ""
        if free and self._geometry.touching:
            converged &= load.any(axis=1)
        self._last = (d[-1:], ball[:, -1:]) if converged[-1] else None
        if not converged.all():
            for part in (carried, d, stiffness):
                part[~converged] = np.nan
        return Followed(carried, d, stiffness, converged)
