"""Steps of q̈ + C q̇ + K q = L g(t), exact where g is a quadratic of time.

What bearings push depends on where their rings are, at the middle and the end of the step too. The
equation is linear but for that: over a step the motion of the rings is linear in what bearings
push, and Newton's method has only as many unknowns as rings have motions, however many coordinates
the machine has. The error falls with the fourth power of the step.

Theory: docs/theory/time_response.md.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from rotordyn.allowance import require_time
from rotordyn.analyses.time_response.equation import Equation
from rotordyn.analyses.time_response.remainder import Remainder
from rotordyn.arrays import Array, Flags, Indices

NODES = 3  # of a step: start, middle, end
LAGRANGE = np.array(  # by powers 1, x, x² of the time over the step: polynomials that are 1 at one
    [[1.0, -3.0, 2.0], [0.0, 4.0, -4.0], [0.0, -1.0, 2.0]]
)
BEYOND = np.array([[1.0, -3.0, 3.0], [3.0, -8.0, 6.0]])  # the same at x = 3/2 and 2
SETTLED = 1e-9  # of the largest way of a ring: a smaller Newton step is the last
NEARLY = 1e-15  # m, added to that
ITERATIONS = 12
AT_ONCE = 1000  # steps for which forces are sampled together
SUBSTEPS = 64  # of a step, at whose middles forces are sampled
PLACES = (np.arange(SUBSTEPS) + 0.5) / SUBSTEPS
FITTED = np.linalg.pinv(np.vander(PLACES, 3, increasing=True) @ LAGRANGE.T)
"""(3, substeps): of a force the quadratic with its impulse and first moments, so that jumps and
corners within a step do no harm; at start, middle and end."""


@dataclass(frozen=True, eq=False, slots=True)
class Step:
    """Of states z = (q, q̇/ω), ω some scale, those at middle and end of a step.

    z = ``free`` z₀ + Σ ``forced`` g, ``free`` (s, 2, m, m) and ``forced`` (s, 2, 3, m, p) with
    m = 2n coordinates, p inputs and the three nodes of g.
    """

    free: Array
    forced: Array

    @classmethod
    def of(cls, stiffness: Array, damping: Array, inputs: Array, length: float) -> Step:
        """For K and C (s, n, n), L (n, p) and a step of ``length`` [s]."""
        from scipy.linalg import expm

        s, n, p = *stiffness.shape[:2], inputs.shape[1]
        scale = max(float(np.sqrt(np.abs(stiffness).max())), 1.0 / length)
        m, powers = 2 * n, NODES * p
        rate = np.zeros((s, m + powers, m + powers))
        rate[:, :n, n:m] = scale * np.eye(n)
        rate[:, n:m, :n], rate[:, n:m, n:m] = -stiffness / scale, -damping
        rate[:, n:m, m : m + p] = inputs / scale
        rate[:, m : m + powers - p, m + p :] = np.eye(powers - p) / length  # of 1, x and x²/2
        both = np.stack([expm(0.5 * length * rate), expm(length * rate)], axis=1)
        by_power = both[:, :, :m, m:].reshape(s, 2, m, NODES, p) * [[1.0], [1.0], [2.0]]
        return cls(both[:, :, :m, :m], np.einsum("ak,sjmkp->sjamp", LAGRANGE, by_power))


@dataclass(frozen=True, eq=False, slots=True)
class Path:
    """Motion at the instants (t,): start, middle and end of every step.

    ``watched`` (s, t, points and sleeves), ``rings`` (s, t, 5·seats) and what bearings push beyond
    their tangents, ``beyond``, alike. ``lost`` (s,): the instant from which on a speed has no
    answer, t where there is none; ``unsettled`` (s,): since no balance was found with such steps.
    """

    watched: Array
    rings: Array
    beyond: Array
    lost: Indices
    unsettled: Flags

    def every(self, step: int) -> Path:
        """At every so many of the instants."""
        return replace(
            self,
            watched=self.watched[:, ::step],
            rings=self.rings[:, ::step],
            beyond=self.beyond[:, ::step],
            lost=-(-self.lost // step),
        )


def march(
    equation: Equation,
    force: Callable[[Array], Array],
    length: float,
    steps: int,
    bearings: Remainder | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> Path:
    """From rest in ``steps`` of ``length`` [s] under inputs ``force``: (s, inputs, t) at instants
    (t,) [s]. Without ``bearings`` these are linear."""
    watch = np.concatenate([equation.points, equation.sleeves])
    rings = equation.rings if bearings is not None else equation.rings[:0]
    inputs = np.hstack([-rings.T, equation.pushed])
    step = Step.of(equation.stiffness, equation.damping, inputs, length)
    speeds, (n, p), r, instants = len(equation.stiffness), inputs.shape, len(rings), 2 * steps + 1
    seen = np.concatenate([watch, rings])
    free = seen @ step.free[:, :, :n]
    forced = np.moveaxis(seen @ step.forced[:, :, :, :n], 2, 3).reshape(speeds, 2, len(seen), -1)
    to_end = np.moveaxis(step.forced[:, 1], 1, 2).reshape(speeds, 2 * n, -1)
    by_push = np.moveaxis(rings @ step.forced[:, :, 1:, :n, :r], 2, 3).reshape(speeds, 2 * r, 2 * r)

    state, pushed = np.zeros((speeds, 2 * n)), np.zeros((speeds, NODES, p))
    path, beyond = np.zeros((speeds, instants, len(seen))), np.zeros((speeds, instants, r))
    lost, unsettled = np.full(speeds, instants), np.zeros(speeds, dtype=bool)
    for k in range(0, instants - 1, 2):
        if k % (2 * AT_ONCE) == 0:
            require_time("time_response", "not finished")
            progress(f"step {k // 2} of {steps}")
            every = np.arange(k // 2, min(k // 2 + AT_ONCE, steps))[:, None] + PLACES
            sampled = force(length * every.ravel()).reshape(speeds, -1, *every.shape)
            of_steps = np.einsum("ap,sikp->ksai", FITTED, sampled)
        pushed[:, :, r:] = of_steps[k // 2 % AT_ONCE]
        if k:
            beyond[:, k + 1 : k + NODES] = BEYOND @ beyond[:, k - 2 : k + 1]
        pushed[:, :, :r] = beyond[:, k : k + NODES]
        moved = _sum(free, state, forced, pushed)
        if bearings is not None:
            alive = lost == instants
            way = moved[:, :, len(watch) :].reshape(speeds, -1)
            push, exists, found = _settled(bearings, by_push, way, pushed[:, 1:, :r], alive)
            lost[alive & ~(exists & found)] = k + 1
            unsettled |= alive & exists & ~found
            pushed[:, 1:, :r] = beyond[:, k + 1 : k + NODES] = push
            moved = _sum(free, state, forced, pushed)
        path[:, k + 1 : k + NODES] = moved
        state = (step.free[:, 1] @ state[..., None] + to_end @ pushed.reshape(speeds, -1, 1))[
            ..., 0
        ]
    endless = np.asarray(~np.isfinite(path).all(axis=2))
    lost = np.minimum(lost, np.where(endless.any(axis=1), endless.argmax(axis=1), instants))
    gone = np.arange(instants) >= lost[:, None]
    path[gone], beyond[gone] = np.nan, np.nan
    return Path(path[..., : len(watch)], path[..., len(watch) :], beyond, lost, unsettled)


def _sum(free: Array, state: Array, forced: Array, pushed: Array) -> Array:
    """What is seen at middle and end (s, 2, seen)."""
    of_force = pushed.reshape(len(pushed), 1, -1, 1)
    return (free @ state[:, None, :, None] + forced @ of_force)[..., 0]


def _settled(
    bearings: Remainder, by_push: Array, way: Array, push: Array, alive: Flags
) -> tuple[Array, Flags, Flags]:
    """What bearings push beyond their tangents (s, 2, 5·seats) where rings move by ``by_push``
    (s, 10·seats, 10·seats) of it: Newton's method from ``push``, with which they move by ``way``
    (s, 10·seats). Then speeds at which every bearing has a state, and at which this is found.
    """
    shape, (speeds, size) = push.shape, way.shape
    push, exists, found = push.reshape(speeds, size), alive.copy(), np.zeros(speeds, dtype=bool)
    scale = np.tile(bearings.lever, 2)
    for _ in range(ITERATIONS):
        way[~exists] = 0.0
        there = bearings.at(way.reshape(speeds, 2, -1, 5))
        exists &= there.exists
        beyond = np.where(exists[:, None], there.beyond.reshape(speeds, size), 0.0)
        slope = np.where(exists[:, None, None, None], there.slope.reshape(speeds, -1, 5, 5), 0.0)
        turned = np.einsum("sabi,sbij->sabj", by_push.reshape(speeds, size, -1, 5), slope)
        gap = by_push @ (beyond - push)[..., None]
        change = np.linalg.solve(np.eye(size) - turned.reshape(by_push.shape), gap)[..., 0]
        more = np.einsum("sbij,sbj->sbi", slope, change.reshape(speeds, -1, 5))
        push, way = beyond + more.reshape(speeds, size), way + change
        bearings.largest = np.maximum(bearings.largest, np.abs(way * scale).max(axis=1))
        found = np.abs(change * scale).max(axis=1) <= SETTLED * bearings.largest + NEARLY
        if (found | ~exists).all():
            break
    return push.reshape(shape), exists, found
