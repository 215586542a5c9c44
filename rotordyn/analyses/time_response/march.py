"""Steps of q̈ + C q̇ + K q = L g(t) − Rᵀ r(R q), exact where g and r are quadratics of time.

The nonlinear forces r of bearings and stops depend on the displacements R q of rings and sleeves,
which are solved for at the middle and the end of a step. Over a step these are linear in r:
Newton's method has only as many unknowns as these have motions, however many coordinates the
machine has.

Theory: docs/theory/time_response.md.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from rotordyn.allowance import require_time
from rotordyn.analyses.time_response.equation import Equation
from rotordyn.analyses.time_response.nonlinear import Nonlinear
from rotordyn.arrays import Array, Flags, Indices
from rotordyn.scene.linearity import FAR

NODES = 3  # of a quadratic: start, middle and end of a step
LAGRANGE = np.array(  # by powers 1, x, x² of the time over the step: polynomials that are 1 at one
    [[1.0, -3.0, 2.0], [0.0, 4.0, -4.0], [0.0, -1.0, 2.0]]
)
CONTINUED = np.array([[1.0, -3.0, 3.0], [3.0, -8.0, 6.0]])  # the same at x = 3/2 and 2
SUBSTEPS = 16  # of a step, over which means of the forces are taken
_EDGES = np.arange(SUBSTEPS + 1)[:, None] / SUBSTEPS
_MEANS = SUBSTEPS * np.diff(_EDGES ** [1, 2, 3], axis=0) / [1, 2, 3]  # of 1, x, x²
FITTED = np.linalg.pinv(_MEANS @ LAGRANGE.T)
"""(3, substeps): the quadratic whose means are closest; it has the impulse of the force."""
AT_ONCE = 1000  # steps for which forces are computed together
CONVERGED = 1e-9  # of the largest displacement of a ring: a smaller Newton step is the last
ROUNDING = 1e-15  # m, added to that
ITERATIONS = 20  # two are usual; more only where contacts open or close


@dataclass(frozen=True, eq=False, slots=True)
class Step:
    """What a step makes of a state z = (q, q̇/ω), ω = ``scale``, and of p inputs at three nodes.

    At its end, z = ``by_state`` z₀ + ``by_input`` g, (s, m, m) and (s, m, 3p) with m = 2n. What is
    seen at middle and end alike: ``seen_by_state`` (s, 2, w, m), ``seen_by_input`` (s, 2, w, 3p).
    """

    scale: float
    by_state: Array
    by_input: Array
    seen_by_state: Array
    seen_by_input: Array

    @classmethod
    def of(
        cls, stiffness: Array, damping: Array, inputs: Array, seen: Array, length: float
    ) -> Step:
        """For K and C (s, n, n), L (n, p), what is ``seen`` by the coordinates (w, n), and a step
        of ``length`` [s].

        Inputs as further states: Van Loan, IEEE Transactions on Automatic Control 23 (1978) 395.
        """
        from scipy.linalg import expm

        s, n, p = *stiffness.shape[:2], inputs.shape[1]
        # velocities over the highest frequency, or else K dwarfs all other entries
        scale = max(float(np.sqrt(np.abs(stiffness).max())), 1.0 / length)
        m, powers = 2 * n, NODES * p
        rate = np.zeros((s, m + powers, m + powers))
        rate[:, :n, n:m] = scale * np.eye(n)
        rate[:, n:m, :n], rate[:, n:m, n:m] = -stiffness / scale, -damping
        rate[:, n:m, m : m + p] = inputs / scale
        rate[:, m : m + powers - p, m + p :] = np.eye(powers - p) / length  # of 1, x and x²/2
        both = np.stack([expm(0.5 * length * rate), expm(length * rate)], axis=1)
        by_power = both[:, :, :m, m:].reshape(s, 2, m, NODES, p) * [[1.0], [1.0], [2.0]]
        by_node = np.einsum("ak,sjmkp->sjmap", LAGRANGE, by_power).reshape(s, 2, m, powers)
        by_state = both[:, :, :m, :m]
        shown = seen @ by_state[:, :, :n], seen @ by_node[:, :, :n]
        return cls(scale, by_state[:, 1], by_node[:, 1], *shown)

    def linear(self, state: Array, inputs: Array) -> tuple[Array, Array]:
        """The state after steps under inputs (steps, s, 3, p), and what is seen at their middles
        and ends (s, 2·steps, w)."""
        count, s = inputs.shape[:2]
        given = np.moveaxis(inputs.reshape(count, s, -1), 0, 2)  # (s, 3p, steps)
        pushed = np.moveaxis(self.by_input @ given, 2, 0)[..., None].copy()
        begun, now = np.empty((count, *state.shape, 1)), state[..., None]
        for k in range(count):
            begun[k] = now
            now = self.by_state @ now + pushed[k]
        states = np.moveaxis(begun[..., 0], 0, 2)[:, None]
        seen = self.seen_by_state @ states + self.seen_by_input @ given[:, None]
        return now[..., 0], np.transpose(seen, (0, 3, 1, 2)).reshape(s, 2 * count, -1)

    def end(self, state: Array, inputs: Array) -> Array:
        """The state at the end (s, m), of that at the start and inputs (s, 3, p)."""
        given = inputs.reshape(len(state), -1, 1)
        return (self.by_state @ state[..., None] + self.by_input @ given)[..., 0]

    def seen(self, state: Array, inputs: Array) -> Array:
        """What is seen at middle and end (s, 2, w)."""
        given = inputs.reshape(len(state), 1, -1, 1)
        return (self.seen_by_state @ state[:, None, :, None] + self.seen_by_input @ given)[..., 0]

    def by_force(self, count: int) -> Array:
        """The last ``count`` of what is seen by as many first inputs (s, 2·count, 2·count), both at
        middle and end."""
        s, _, w, _ = self.seen_by_input.shape
        whole = self.seen_by_input.reshape(s, 2, w, NODES, -1)
        return whole[:, :, w - count :, 1:, :count].reshape(s, 2 * count, 2 * count)


@dataclass(frozen=True, eq=False, slots=True)
class Path:
    """Motion at the instants (t,): start, middle and end of every step.

    Displacements of the ``points`` (s, t, 3·points), ``sleeves`` (s, t, sleeves) and ``rings``
    (s, t, 5·seats), and the nonlinear ``force`` of the bearings (s, t, 5·seats), NaN from instant
    ``ended`` (s,) on; t where there is an answer to the end. ``unbalanced`` (s,): it ended for want
    of a balance of the bearings, else since it moved farther than ``FAR``.
    """

    points: Array
    sleeves: Array
    rings: Array
    force: Array
    ended: Indices
    unbalanced: Flags

    def every(self, step: int) -> Path:
        """At every so many of the instants."""
        names = ("points", "sleeves", "rings", "force")
        fewer = {name: getattr(self, name)[:, ::step] for name in names}
        return replace(self, ended=-(-self.ended // step), **fewer)


@np.errstate(over="ignore", invalid="ignore")  # what grows without bound ends there
def march(
    equation: Equation,
    inputs: Callable[[Array], Array],
    length: float,
    steps: int,
    begun: tuple[Array, Array],
    nonlinear: Nonlinear | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> Path:
    """In ``steps`` of ``length`` [s] from q and q̇ (s, n) as ``begun``.

    ``inputs`` gives means between edges (t + 1,) [s], shape (s, p, t). Without ``nonlinear`` forces
    bearings are linear, and stops stay as they are. Raises TooCostly where the time of a run is
    over.
    """
    rows = equation.rings[:0] if nonlinear is None else nonlinear.rows(equation)
    seen, r = np.concatenate([equation.points, equation.sleeves, rows]), len(rows)
    joined = np.hstack([-rows.T, equation.inputs])
    step = Step.of(equation.stiffness, equation.damping, joined, seen, length)
    speeds, instants = len(equation.stiffness), 2 * steps + 1
    moved = np.full((speeds, instants, len(seen)), np.nan)
    force, given = np.zeros((speeds, instants, r)), np.zeros((speeds, NODES, joined.shape[1]))
    state = np.concatenate([begun[0], begun[1] / step.scale], axis=1)
    moved[:, 0] = begun[0] @ seen.T
    newton = None
    if nonlinear is not None:
        newton = _Newton(nonlinear, step.by_force(r))
        force[:, 0] = newton.start(moved[:, 0, len(seen) - r :])
    unbalanced, ended = np.zeros(speeds, dtype=bool), np.full(speeds, instants)
    for begin in range(0, steps, AT_ONCE):
        require_time("time_response", "not finished")
        progress(f"step {begin} of {steps}")
        external = _fitted(inputs, length, begin, min(AT_ONCE, steps - begin))
        if newton is None:
            after = slice(2 * begin + 1, 2 * (begin + len(external)) + 1)
            state, moved[:, after] = step.linear(state, external)
            continue
        for k, acting in enumerate(external, start=begin):
            first, last = 2 * k, 2 * k + NODES
            given[:, :, r:] = acting
            if k:
                force[:, first + 1 : last] = CONTINUED @ force[:, first - 2 : first + 1]
            given[:, :, :r] = force[:, first:last]
            trial = step.seen(state, given)[:, :, len(seen) - r :]
            force[:, first + 1 : last], found = newton.balance(trial, given[:, 1:, :r])
            ended = np.where(~found & ~unbalanced, first + 1, ended)
            unbalanced |= ~found
            given[:, :, :r] = force[:, first:last]
            moved[:, first + 1 : last] = step.seen(state, given)
            state = step.end(state, given)
    return _path(equation, moved, force, ended, unbalanced)


def _fitted(inputs: Callable[[Array], Array], length: float, first: int, steps: int) -> Array:
    """At the three nodes of each of some ``steps`` (steps, s, 3, p)."""
    edges = length * (first + np.arange(steps * SUBSTEPS + 1) / SUBSTEPS)
    means = inputs(edges)
    return np.einsum("ac,spkc->ksap", FITTED, means.reshape(*means.shape[:2], steps, SUBSTEPS))


def _path(
    equation: Equation, moved: Array, force: Array, ended: Indices, unbalanced: Flags
) -> Path:
    """What was seen, up to where it ends."""
    lost = np.asarray(~(np.abs(moved) < FAR).all(axis=2))  # numbers that are none, too
    ended = np.minimum(ended, np.where(lost.any(axis=1), lost.argmax(axis=1), moved.shape[1]))
    gone = np.arange(moved.shape[1]) >= ended[:, None]
    moved[gone], force[gone] = np.nan, np.nan
    points, sleeves = len(equation.points), len(equation.sleeves)
    rings = min(len(equation.rings), force.shape[2])
    parts = np.split(moved, np.cumsum([points, sleeves, rings]), axis=2)
    return Path(parts[0], parts[1], parts[2], force[..., :rings], ended, unbalanced)


class _Newton:
    """Balance of bearings and stops over a step, by Newton's method.

    Displacements δ (s, 2r) at middle and end are linear in the nonlinear forces alike:
    ``by_force`` (s, 2r, 2r).
    """

    def __init__(self, nonlinear: Nonlinear, by_force: Array) -> None:
        self._nonlinear, self._by_force = nonlinear, by_force
        speeds, size, _ = by_force.shape
        self._columns = by_force.reshape(speeds, size, 2, -1).swapaxes(1, 2)
        self._lever = np.tile(nonlinear.lever, 2)
        self._last, self._largest = np.zeros((speeds, size)), np.zeros(speeds)
        self._alive = np.ones(speeds, dtype=bool)

    def start(self, moved: Array) -> Array:
        """Nonlinear forces (s, r) at the displacements ``moved`` (s, r) of the beginning."""
        twice = np.repeat(moved[:, None], 2, axis=1)
        force, _, exists = self._evaluate(twice.reshape(self._last.shape))
        self._alive &= exists
        self._last = np.where(exists[:, None], twice.reshape(self._last.shape), 0.0)
        return np.where(exists[:, None], force[:, : moved.shape[1]], 0.0)

    def balance(self, trial: Array, force: Array) -> tuple[Array, Flags]:
        """Nonlinear forces (s, 2, r) in balance, and speeds at which they are; from ``force``, with
        which displacements would be ``trial`` (s, 2, r).

        A place without a state of a bearing is one that Newton's method overshot to: the way there
        from where all had one is halved.
        """
        shape = force.shape
        moved, force = trial.reshape(self._last.shape), force.reshape(self._last.shape)
        self._alive &= np.isfinite(moved).all(axis=1)
        base, good = moved - (self._by_force @ force[..., None])[..., 0], self._last.copy()
        good_force, found = force.copy(), np.zeros(len(moved), dtype=bool)
        for _ in range(ITERATIONS):
            moved[~self._alive] = 0.0
            here, slope, exists = self._evaluate(moved)
            slope = np.where(exists[:, None, None, None], slope, 0.0)
            here = np.where(exists[:, None], here, 0.0)
            gap = base + (self._by_force @ here[..., None])[..., 0] - moved
            turned = (self._columns @ slope).swapaxes(1, 2).reshape(self._by_force.shape)
            change = np.linalg.solve(np.eye(gap.shape[1]) - turned, gap[..., None])[..., 0]
            more = (slope @ change.reshape(*slope.shape[:3], 1)).reshape(gap.shape)
            good = np.where(exists[:, None], moved, good)
            good_force = np.where(exists[:, None], here + more, good_force)
            size = np.abs(good * self._lever).max(axis=1)
            small = np.abs(change * self._lever).max(axis=1) <= (
                CONVERGED * np.maximum(self._largest, size) + ROUNDING
            )
            found = exists & small
            if (found | ~self._alive).all():
                break
            moved = np.where(exists[:, None], moved + change, 0.5 * (moved + good))
        self._alive &= found
        self._last = np.where(found[:, None], good, self._last)
        self._largest = np.where(found, np.maximum(self._largest, size), self._largest)
        return np.where(self._alive[:, None], good_force, 0.0).reshape(shape), self._alive.copy()

    def _evaluate(self, moved: Array) -> tuple[Array, Array, Flags]:
        """Nonlinear forces (s, 2r), slopes (s, 2, r, r), where there are states."""
        found = self._nonlinear.at(moved.reshape(len(moved), 2, -1))
        self._nonlinear = found.where
        return found.force.reshape(moved.shape), found.slope, found.exists & self._alive
