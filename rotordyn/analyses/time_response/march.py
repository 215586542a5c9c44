"""Time steps of q̈ + C q̇ + K q = L g(t) − Rᵀ r(R q), exact where g and r are quadratic in time.

The nonlinear forces r of bearings and stops depend on the displacements R q of rings and sleeves,
which are solved for at the middle and the end of a step. Over a step these are linear in r:
Newton's method has only as many unknowns as rings and sleeves have motions, however many
coordinates the machine has.

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
LAGRANGE = np.array(  # rows: polynomials that are 1 at one node, by powers 1, x, x² of time / step
    [[1.0, -3.0, 2.0], [0.0, 4.0, -4.0], [0.0, -1.0, 2.0]]
)
CONTINUED = np.array([[1.0, -3.0, 3.0], [3.0, -8.0, 6.0]])  # the same, extrapolated to x = 3/2, 2
SUBSTEPS = 16  # of a step, over which means of the forces are taken
_EDGES = np.arange(SUBSTEPS + 1)[:, None] / SUBSTEPS
_MEANS = SUBSTEPS * np.diff(_EDGES ** [1, 2, 3], axis=0) / [1, 2, 3]  # of 1, x, x²
FITTED = np.linalg.pinv(_MEANS @ LAGRANGE.T)
"""(3, substeps): quadratic with the closest means; it preserves the impulse of the force."""
AT_ONCE = 1000  # steps for which forces are computed together
CONVERGED = 1e-9  # of the largest displacement of a ring: size of the last Newton step
ROUNDING = 1e-15  # m, added to that
ITERATIONS = 20  # at most; two are usual, more only where contacts open or close


@dataclass(frozen=True, eq=False, slots=True)
class Step:
    """Map of a time step, of the state z = (q, q̇/ω), ω = ``scale``, and p inputs at three nodes.

    At its end, z = ``by_state`` z₀ + ``by_input`` g, (s, m, m) and (s, m, 3p) with m = 2n. Outputs
    at middle and end likewise: ``seen_by_state`` (s, 2, w, m), ``seen_by_input`` (s, 2, w, 3p).
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
        """Return the map for K and C (s, n, n), L (n, p), rows of outputs ``seen`` (w, n), and a
        step of ``length`` [s].

        Inputs are further states: Van Loan, IEEE Transactions on Automatic Control 23 (1978) 395.
        """
        from scipy.linalg import expm

        s, n, p = *stiffness.shape[:2], inputs.shape[1]
        # velocities are divided by the highest frequency, since K would dwarf all other entries
        scale = max(float(np.sqrt(np.abs(stiffness).max())), 1.0 / length)
        m, powers = 2 * n, NODES * p
        rate = np.zeros((s, m + powers, m + powers))
        rate[:, :n, n:m] = scale * np.eye(n)
        rate[:, n:m, :n], rate[:, n:m, n:m] = -stiffness / scale, -damping
        rate[:, n:m, m : m + p] = inputs / scale
        rate[:, m : m + powers - p, m + p :] = np.eye(powers - p) / length  # inputs 1, x and x²/2
        exponentials = np.stack([expm(0.5 * length * rate), expm(length * rate)], axis=1)
        by_power = exponentials[:, :, :m, m:].reshape(s, 2, m, NODES, p) * [[1.0], [1.0], [2.0]]
        by_node = np.einsum("ak,sjmkp->sjmap", LAGRANGE, by_power).reshape(s, 2, m, powers)
        by_state = exponentials[:, :, :m, :m]
        outputs = seen @ by_state[:, :, :n], seen @ by_node[:, :, :n]
        return cls(scale, by_state[:, 1], by_node[:, 1], *outputs)

    def linear(self, state: Array, inputs: Array) -> tuple[Array, Array]:
        """Return the state after steps under inputs (steps, s, 3, p), and the outputs at their
        middles and ends (s, 2·steps, w)."""
        count, s = inputs.shape[:2]
        g = np.moveaxis(inputs.reshape(count, s, -1), 0, 2)  # (s, 3p, steps)
        forced = np.moveaxis(self.by_input @ g, 2, 0)[..., None].copy()
        starts, z = np.empty((count, *state.shape, 1)), state[..., None]
        for k in range(count):
            starts[k] = z
            z = self.by_state @ z + forced[k]
        states = np.moveaxis(starts[..., 0], 0, 2)[:, None]
        outputs = self.seen_by_state @ states + self.seen_by_input @ g[:, None]
        return z[..., 0], np.transpose(outputs, (0, 3, 1, 2)).reshape(s, 2 * count, -1)

    def end(self, state: Array, inputs: Array) -> Array:
        """Return the state at the end (s, m), by that at the start and inputs (s, 3, p)."""
        g = inputs.reshape(len(state), -1, 1)
        return (self.by_state @ state[..., None] + self.by_input @ g)[..., 0]

    def seen(self, state: Array, inputs: Array) -> Array:
        """Return the outputs at middle and end (s, 2, w)."""
        g = inputs.reshape(len(state), 1, -1, 1)
        return (self.seen_by_state @ state[:, None, :, None] + self.seen_by_input @ g)[..., 0]

    def by_force(self, count: int) -> Array:
        """Return the last ``count`` outputs by as many first inputs (s, 2·count, 2·count), both at
        middle and end."""
        s, _, w, _ = self.seen_by_input.shape
        by_node = self.seen_by_input.reshape(s, 2, w, NODES, -1)
        return by_node[:, :, w - count :, 1:, :count].reshape(s, 2 * count, 2 * count)


@dataclass(frozen=True, eq=False, slots=True)
class Path:
    """Motion at the instants (t,): start, middle and end of every step.

    Displacements of the ``points`` (s, t, 3·points), ``sleeves`` (s, t, sleeves) and ``rings``
    (s, t, 5·seats), and the nonlinear ``force`` of the bearings (s, t, 5·seats), NaN from instant
    ``ended`` (s,) on; t where the motion is complete. ``unbalanced`` (s,): it ended since forces of
    the bearings found no balance, otherwise since a displacement exceeded ``FAR``.
    """

    points: Array
    sleeves: Array
    rings: Array
    force: Array
    ended: Indices
    unbalanced: Flags

    def every(self, step: int) -> Path:
        """Return the path at every ``step``-th instant."""
        names = ("points", "sleeves", "rings", "force")
        fewer = {name: getattr(self, name)[:, ::step] for name in names}
        return replace(self, ended=-(-self.ended // step), **fewer)


@np.errstate(over="ignore", invalid="ignore")  # unbounded growth ends the path
def march(
    equation: Equation,
    inputs: Callable[[Array], Array],
    length: float,
    steps: int,
    begun: tuple[Array, Array],
    nonlinear: Nonlinear | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> Path:
    """Integrate the motion in ``steps`` of ``length`` [s] from q and q̇ (s, n), ``begun``.

    ``inputs`` gives means between edges (t + 1,) [s], shape (s, p, t). Without ``nonlinear`` forces
    bearings are linear, and stops stay as they are. Raises TooCostly once the time allowed for a
    run is over.
    """
    rows = equation.rings[:0] if nonlinear is None else nonlinear.rows(equation)
    watched, r = np.concatenate([equation.points, equation.sleeves, rows]), len(rows)
    all_inputs = np.hstack([-rows.T, equation.inputs])
    step = Step.of(equation.stiffness, equation.damping, all_inputs, watched, length)
    speeds, instants = len(equation.stiffness), 2 * steps + 1
    outputs = np.full((speeds, instants, len(watched)), np.nan)
    force, g = np.zeros((speeds, instants, r)), np.zeros((speeds, NODES, all_inputs.shape[1]))
    state = np.concatenate([begun[0], begun[1] / step.scale], axis=1)
    outputs[:, 0] = begun[0] @ watched.T
    newton = None
    if nonlinear is not None:
        newton = _Newton(nonlinear, step.by_force(r))
        force[:, 0] = newton.start(outputs[:, 0, len(watched) - r :])
    unbalanced, ended = np.zeros(speeds, dtype=bool), np.full(speeds, instants)
    for begin in range(0, steps, AT_ONCE):
        require_time("time_response", "not finished")
        progress(f"step {begin} of {steps}")
        external = _nodal_inputs(inputs, length, begin, min(AT_ONCE, steps - begin))
        if newton is None:
            after = slice(2 * begin + 1, 2 * (begin + len(external)) + 1)
            state, outputs[:, after] = step.linear(state, external)
            continue
        for k, values in enumerate(external, start=begin):
            first, last = 2 * k, 2 * k + NODES
            g[:, :, r:] = values
            if k:
                force[:, first + 1 : last] = CONTINUED @ force[:, first - 2 : first + 1]
            g[:, :, :r] = force[:, first:last]
            trial = step.seen(state, g)[:, :, len(watched) - r :]
            force[:, first + 1 : last], balanced = newton.balance(trial, g[:, 1:, :r])
            ended = np.where(~balanced & ~unbalanced, first + 1, ended)
            unbalanced |= ~balanced
            g[:, :, :r] = force[:, first:last]
            outputs[:, first + 1 : last] = step.seen(state, g)
            state = step.end(state, g)
    return _path(equation, outputs, force, ended, unbalanced)


def _nodal_inputs(inputs: Callable[[Array], Array], length: float, first: int, steps: int) -> Array:
    """Return inputs at the three nodes of each of some ``steps`` (steps, s, 3, p)."""
    edges = length * (first + np.arange(steps * SUBSTEPS + 1) / SUBSTEPS)
    means = inputs(edges)
    return np.einsum("ac,spkc->ksap", FITTED, means.reshape(*means.shape[:2], steps, SUBSTEPS))


def _path(
    equation: Equation, moved: Array, force: Array, ended: Indices, unbalanced: Flags
) -> Path:
    """Return the outputs as a path, up to its end."""
    beyond = np.asarray(~(np.abs(moved) < FAR).all(axis=2))  # also NaN
    ended = np.minimum(ended, np.where(beyond.any(axis=1), beyond.argmax(axis=1), moved.shape[1]))
    after_end = np.arange(moved.shape[1]) >= ended[:, None]
    moved[after_end], force[after_end] = np.nan, np.nan
    points, sleeves = len(equation.points), len(equation.sleeves)
    rings = min(len(equation.rings), force.shape[2])
    parts = np.split(moved, np.cumsum([points, sleeves, rings]), axis=2)
    return Path(parts[0], parts[1], parts[2], force[..., :rings], ended, unbalanced)


class _Newton:
    """Balance of bearings and stops over a step, by Newton's method.

    Displacements δ (s, 2r) at middle and end are linear in the nonlinear forces at both:
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
        """Return nonlinear forces (s, r) at the initial displacements ``moved`` (s, r)."""
        repeated = np.repeat(moved[:, None], 2, axis=1)
        force, _, exists = self._evaluate(repeated.reshape(self._last.shape))
        self._alive &= exists
        self._last = np.where(exists[:, None], repeated.reshape(self._last.shape), 0.0)
        return np.where(exists[:, None], force[:, : moved.shape[1]], 0.0)

    def balance(self, trial: Array, force: Array) -> tuple[Array, Flags]:
        """Return nonlinear forces (s, 2, r) in balance, and flags of the speeds that have them; the
        first ``force`` gives displacements ``trial`` (s, 2, r).

        Where a bearing has no state, Newton's method has overshot: the step from the last
        displacements at which all bearings had one is halved.
        """
        shape = force.shape
        delta, force = trial.reshape(self._last.shape), force.reshape(self._last.shape)
        self._alive &= np.isfinite(delta).all(axis=1)
        base, valid = delta - (self._by_force @ force[..., None])[..., 0], self._last.copy()
        valid_force, balanced = force.copy(), np.zeros(len(delta), dtype=bool)
        for _ in range(ITERATIONS):
            delta[~self._alive] = 0.0
            force_at, slope, exists = self._evaluate(delta)
            slope = np.where(exists[:, None, None, None], slope, 0.0)
            force_at = np.where(exists[:, None], force_at, 0.0)
            error = base + (self._by_force @ force_at[..., None])[..., 0] - delta
            feedback = (self._columns @ slope).swapaxes(1, 2).reshape(self._by_force.shape)
            change = np.linalg.solve(np.eye(error.shape[1]) - feedback, error[..., None])[..., 0]
            correction = (slope @ change.reshape(*slope.shape[:3], 1)).reshape(error.shape)
            valid = np.where(exists[:, None], delta, valid)
            valid_force = np.where(exists[:, None], force_at + correction, valid_force)
            size = np.abs(valid * self._lever).max(axis=1)
            small = np.abs(change * self._lever).max(axis=1) <= (
                CONVERGED * np.maximum(self._largest, size) + ROUNDING
            )
            balanced = exists & small
            if (balanced | ~self._alive).all():
                break
            delta = np.where(exists[:, None], delta + change, 0.5 * (delta + valid))
        self._alive &= balanced
        self._last = np.where(balanced[:, None], valid, self._last)
        self._largest = np.where(balanced, np.maximum(self._largest, size), self._largest)
        return np.where(self._alive[:, None], valid_force, 0.0).reshape(shape), self._alive.copy()

    def _evaluate(self, moved: Array) -> tuple[Array, Array, Flags]:
        """Return nonlinear forces (s, 2r), slopes (s, 2, r, r), and speeds with states (s,)."""
        result = self._nonlinear.at(moved.reshape(len(moved), 2, -1))
        self._nonlinear = result.where
        return result.force.reshape(moved.shape), result.slope, result.exists & self._alive
