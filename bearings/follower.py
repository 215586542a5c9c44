"""A bearing followed from state to state, for loops and time marching."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bearings.ball.law import STANDARD, Law
from bearings.bearing import BallBearing
from bearings.errors import InvalidBearing, NoEquilibrium
from bearings.geometry import geometry, groove_origin
from bearings.ring.compiled.states import Answer, compiled_states
from bearings.ring.equilibrium import solve
from bearings.ring.problem import Problem, first_displacement, turns
from bearings.ring.question import finite, five_numbers, single
from bearings.ring.sums import full_ring

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

Array = NDArray[np.float64]


class Followed(NamedTuple):
    """``load`` (…, 5), ``displacement`` (…, 5), ``stiffness`` (…, 5, 5), ``found`` (…).

    SI, as in ``BearingState``; NaN where no state was found.
    """

    load: Array
    displacement: Array
    stiffness: Array
    found: NDArray[np.bool_]


class Follower:
    """One bearing at a speed, every state started from the last.

    Load, displacement and tangent only, by the compiled solver, which the first call of a process
    loads and the first of all compiles (what that costs: benchmarks). Under inner control and the
    geometric hypothesis, where a light ball may be loaded or lost at the same place, every state is
    found on its own instead.

    Parameters
    ----------
    bearing, static_growth, growth : as in ``BallBearing.equilibrium``, single values
    law : what is assumed of the balls
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
        for given, kind in ((bearing, BallBearing), (law, Law)):
            if not isinstance(given, kind):
                raise InvalidBearing(f"a follower takes a {kind.__name__}, got {given!r}")
        static = single("static_growth", static_growth)
        total = static if growth is None else single("growth", growth)
        self.speed = float(single("speed", speed)[0])
        self._geometry, self._law = geometry(bearing.grooves), law
        self._origin = groove_origin(self._geometry, static, total)
        if not np.isfinite(self._origin).all():
            raise InvalidBearing("static growth takes the whole contact angle; reduce the fit")
        self._last: Answer | None = None

    def load(self, displacement: ArrayLike, speed: ArrayLike | None = None) -> Followed:
        """Loads (…, 5) at displacements (…, 5), one after the other, with their tangents.

        Raises
        ------
        InvalidBearing : numbers that are not finite, shapes
        NoEquilibrium : a single state does not exist
        """
        given = five_numbers("displacement", displacement)
        return self._found(given, np.zeros_like(given), speed, free=False)

    def displacement(self, load: ArrayLike, speed: ArrayLike | None = None) -> Followed:
        """Displacements (…, 5) under loads (…, 5), one after the other, with their tangents.

        Raises
        ------
        InvalidBearing : numbers that are not finite, shapes
        NoEquilibrium : a single state does not exist
        """
        given = five_numbers("load", load)
        return self._found(np.zeros_like(given), given, speed, free=True)

    def _found(self, move: Array, load: Array, speed: ArrayLike | None, *, free: bool) -> Followed:
        shape = load.shape[:-1]
        turning = np.abs(finite("speed", self.speed if speed is None else speed))
        try:
            omega = np.broadcast_to(turning, shape).reshape(-1)
        except ValueError as error:
            raise InvalidBearing(f"speed {turning.shape} does not fit states {shape}") from error
        if not omega.size:
            nothing = np.zeros(shape, dtype=bool)
            return Followed(load, move, np.zeros((*shape, 5, 5)), nothing)
        answer = self._alike(move.reshape(-1, 5), load.reshape(-1, 5), omega, free=free)
        found = answer.found
        if shape == () and not found[0]:
            word = "unloaded" if free and not load.any() else "no equilibrium"
            raise NoEquilibrium(word, speed=float(omega[0]), remedy="see `equilibrium` for why")
        if not found.all():
            for part in (answer.load, answer.displacement, answer.stiffness):
                part[~found] = np.nan
        return Followed(
            answer.load.reshape(*shape, 5),
            answer.displacement.reshape(*shape, 5),
            answer.stiffness.reshape(*shape, 5, 5),
            found.reshape(shape),
        )

    def _alike(self, move: Array, load: Array, omega: Array, *, free: bool) -> Answer:
        """States at rest and turning ones apart, in their order."""
        turning = turns(self._geometry, omega)
        if turning.all() or not turning.any():
            return self._answer(move, load, omega, free=free, turning=bool(turning[0]))
        borders = np.flatnonzero(np.diff(turning)) + 1
        answers = [
            self._answer(move[k], load[k], omega[k], free=free, turning=bool(turning[k[0]]))
            for k in np.split(np.arange(len(omega)), borders)
        ]
        joined = {
            name: np.concatenate([getattr(a, name) for a in answers])
            for name in ("displacement", "load", "stiffness", "found")
        }
        return Answer(ball=answers[-1].ball, **joined)

    def _answer(
        self, move: Array, load: Array, omega: Array, *, free: bool, turning: bool
    ) -> Answer:
        """States that are all at rest or all turning."""
        problem = Problem(
            geometry=self._geometry,
            law=self._law,
            ring=full_ring(self._geometry),
            origin=np.broadcast_to(self._origin, (2, len(omega))),
            speed=omega,
            load=load,
            free=np.full(5, free),
            turning=turning,
        )
        near, last, chained = None, self._last, self._law.one_branch
        if last is not None and last.found[-1] and self._law.one_branch:
            near = last.ball[:, -1:]
            move = np.repeat(last.displacement[-1:], len(omega), axis=0) if free else move
        elif free:
            move = first_displacement(problem, move)
        answer = _second_look(problem, compiled_states(problem, move, near, chained=chained))
        if free:
            answer.found[~load.any(axis=1)] = False
        self._last = answer
        return answer


def _second_look(problem: Problem, answer: Answer) -> Answer:
    """States that the compiled solver refuses are looked for by the batched one, which knows more.

    It follows free motions (``bearings.ring.free_motion``).
    """
    missing = np.flatnonzero(~answer.found)
    if missing.size:
        part = problem.take(missing)
        found = solve(part, first_displacement(part, answer.displacement[missing]))
        answer.displacement[missing], answer.load[missing] = found.displacement, found.ring_load
        answer.ball[:, missing], answer.stiffness[missing] = found.ball, found.stiffness
        answer.found[missing] = found.outcome == ""
    return answer
