"""Run-ups and run-downs through the speeds of a case: motion of points, and bearing forces."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.analyses.unbalance.growth import Growth, growth_of, slowest_pole
from rotordyn.analyses.unbalance.orbit import orbit
from rotordyn.analyses.unbalance.run_up import Parts, Run, blended
from rotordyn.analyses.unbalance.spec import UnbalanceSpec, run_name
from rotordyn.analyses.unbalance.steady import AXES, displacement_rows, load_of, out_of_balance
from rotordyn.arrays import Array, Complex, Indices, Matrix
from rotordyn.equation.dofs import position
from rotordyn.equation.linear import Linear
from rotordyn.errors import NoSolution
from rotordyn.numerics.peaks import vertex
from rotordyn.results.display import RPM
from rotordyn.scene.linearity import FAR, RING, departure, ring_rows
from rotordyn.scene.refinement import AT_REST, relative_change, response_accuracy
from rotordyn.scene.scene import Scene

PARTS = (60, 120, 240, 480)  # of a run, tried until their number hardly changes the motion
ACCURATE = 1e-3  # of the peak: largest change by their number where elements are given
SHOWN = 720  # evenly spaced speeds, up to each of which the largest motion is given
BETWEEN = 20  # instants from one of these speeds to the next
APART = 1e9  # largest condition of the modal vectors, with which motions keep seven digits


class Largest(NamedTuple):
    """Half axes on every run: ``over_speed`` (runs, n, k), the largest from one speed to the next,
    ``peak`` and its ``speed`` (runs, k)."""

    over_speed: Array
    peak: Array
    speed: Array


class Runs(NamedTuple):
    """``name`` and ``outcome`` (runs,) of every run, empty or why it has no solution; ``speed``
    (n,) of the spindle [rad/s]; largest motion of points ``moved`` [m] and forces of connections
    ``pushed`` [N]; ``departure`` (runs, connections) of loads of bearings from those of tangents;
    ``error`` (runs,) of all over their peaks; ``growth`` of unstable motions."""

    name: tuple[str, ...]
    outcome: tuple[str, ...]
    speed: Array
    moved: Largest
    pushed: Largest
    departure: Array
    error: Array
    growth: Growth


def runs_of(scene: Scene, spec: UnbalanceSpec, ratio: float, lost: Sequence[str]) -> Runs:
    """Solve the runs between the first and the last speed of the case; ``ratio`` of the speed of
    the rotor out of balance to that of the spindle; ``lost`` (speeds,): why a speed has no steady
    motion."""
    runs = [(t, False) for t in spec.run_up] + [(t, True) for t in spec.run_down]
    count, points = len(runs), len(spec.points)
    columns = points + len(scene.rotor.connections)
    names = tuple(f"{'down' if down else 'up'} in {run_name(time)}" for time, down in runs)
    speed = np.linspace(scene.speed[0], scene.speed[-1], SHOWN + 1) if runs else np.zeros(0)
    amplitude = np.full((count, len(speed), columns), np.nan)
    peak, peak_speed = np.full((2, count, columns), np.nan)
    departures = np.full((count, columns - points), np.nan)
    error, outcome, machine = np.full(count, np.nan), [""] * count, _SpeedRange(scene, spec, ratio)
    for k, (time, down) in enumerate(runs):
        if why := lost[-1 if down else 0]:
            outcome[k] = f"it begins where there is no steady motion ({why})"
            continue
        try:
            axes, rings, error[k] = _converged(machine, time, down=down)
        except NoSolution as absent:
            outcome[k] = str(absent)
            continue
        first, last = speed[[-1, 0]] if down else speed[[0, -1]]
        at = np.linspace(first, last, len(axes))
        peak[k], peak_speed[k] = _peaks(at, axes)
        largest = axes[1:].reshape(SHOWN, BETWEEN, columns).max(axis=1)
        if rings.size:
            departures[k, : rings.shape[1]] = _departure(scene, at, axes[:, points:], rings)
        amplitude[k] = np.concatenate([axes[:1], largest])[:: -1 if down else 1]
    fields = amplitude, peak, peak_speed
    moved, pushed = (
        Largest(*(values[..., :points] for values in fields)),
        Largest(*(values[..., points:] for values in fields)),
    )
    return Runs(names, tuple(outcome), speed, moved, pushed, departures, error, machine.growth)


def _peaks(speed: Array, axes: Array) -> tuple[Array, Array]:
    """Return the largest half axes (k,) of ``axes`` (t, k) at evenly spaced speeds, and the speeds
    there; between instants by the parabola of their inverse squares, as of one resonance."""
    top, columns = axes.argmax(axis=0), np.arange(axes.shape[1])
    middle = np.clip(top, 1, len(axes) - 2)
    shift, height = vertex(
        np.arange(-1.0, 2.0), axes[middle + np.arange(-1, 2)[:, None], columns].T
    )
    between = (top == middle) & np.isfinite(height)
    at = speed[top] + np.where(between, shift, 0.0) * (speed[1] - speed[0])
    return np.where(between, height, axes[top, columns]), at


def _departure(scene: Scene, speed: Array, force: Array, rings: Complex) -> Array:
    """Return the largest departure of every bearing (seats,), by ``rings`` (t, seats, 5) at the
    instants at which forces (t, connections) of bearings are largest."""
    peaks = force[:, : rings.shape[1]].argmax(axis=0)
    ascending, first = np.unique(speed[peaks], return_index=True)
    solved = scene.at(ascending)
    departures = departure(solved, rings[peaks[first[solved.usable]]])
    return np.asarray(np.fmax.reduce(departures, axis=0, initial=np.nan))


def _converged(machine: _SpeedRange, time: float, *, down: bool) -> tuple[Array, Complex, float]:
    """Return major half axes of orbits and forces (t, points and connections) of a run, motion of
    rings (t, seats, 5), and the error: the change by twice as many parts over the peak."""
    tolerance = min(response_accuracy(machine.scene), ACCURATE)
    coarser, error = machine.axes(PARTS[0], time, down=down)[0], np.inf
    points = len(machine.spec.points)
    for count in PARTS[1:]:
        axes, rings = machine.axes(count, time, down=down)
        changed = (
            relative_change(np.nan_to_num(coarser[:, k]), np.nan_to_num(axes[:, k]), 1, AT_REST)
            for k in (slice(points), slice(points, None))
        )
        error = max(float(change.max(initial=0.0)) for change in changed)
        if error <= tolerance:
            break
        coarser = axes
    return axes, rings, error


class _Solved(NamedTuple):
    """Subsystem at every speed of a range: pole, vector, left, damping, stiffness, rows and rates,
    each (s, …), in the coordinates of the modes; ``force``, ``direct``."""

    arrays: list[NDArray[Any]]
    force: Complex
    direct: Complex


@dataclass(eq=False)
class _SpeedRange:
    """Machine between the first and the last speed of a case, solved at the speeds needed, each
    speed once."""

    scene: Scene
    spec: UnbalanceSpec
    ratio: float
    solved: list[_Solved] = field(default_factory=list)

    def __post_init__(self) -> None:
        ends = float(self.scene.speed[0]), float(self.scene.speed[-1])
        self.speed = np.linspace(*ends, 2 * PARTS[-1] + 1)
        self.known = np.zeros(len(self.speed), dtype=bool)
        self.slowest = np.full(len(self.speed), complex(np.nan, np.nan))

    @property
    def growth(self) -> Growth:
        """Ranges of growth among the speeds of the case, and those that were solved for runs."""
        solved, of_case = np.isfinite(self.slowest), self.scene.speed[self.scene.usable]
        pole = [slowest_pole(self.scene, self.spec), self.slowest[solved]]
        speed = np.concatenate([of_case, self.speed[solved]])
        return growth_of(self.scene, self.spec, speed, np.concatenate(pole))

    def axes(self, count: int, time: float, *, down: bool) -> tuple[Array, Complex]:
        """Return major half axes of the orbits of points, then of forces of connections, (t, both),
        and the motion of rings (t, seats, 5), of a run in ``time`` [s], by two divisions: in
        ``count`` parts, and in parts that end in the middle of these. NaN for a force that is not
        determined.

        Raises
        ------
        NoSolution : a speed without a state; rigid-body motions, or motions beyond ``FAR``
        """
        step = PARTS[-1] // count
        place = np.arange(0, len(self.speed), step)[:: -1 if down else 1]
        self._solve(place)
        spin = abs(self.ratio) * self.speed[place]
        run, instants = Run(spin[0], spin[-1], time), np.linspace(0.0, 1.0, SHOWN * BETWEEN + 1)
        cuts = (place[1::2], spin[::2]), (place[::2], spin[[0, *range(1, len(spin), 2), -1]])
        with np.errstate(all="ignore"):  # of growing motion
            even, between = (
                sum(
                    self._parts(k, *cut).moved(run, time * instants)
                    for k in range(len(self.solved))
                )
                for cut in cuts
            )
            moved = blended(np.asarray(even), np.asarray(between), count * instants)
        determined = np.isfinite(moved[0])  # not the forces that several rigid supports share
        determined[: 2 * len(self.spec.points)] = True
        pairs = len(self.spec.points) + len(self.scene.rotor.connections)
        y, z = np.moveaxis(moved[:, : 2 * pairs].reshape(len(moved), pairs, 2), -1, 0)
        finite = np.isfinite(moved[:, determined]).all(axis=1)
        grows = (self.slowest.real > 0.0).any()
        if not (finite.all() or grows):
            raise NoSolution("it is too slow to be computed: take a shorter time")
        with np.errstate(all="ignore"):
            half = orbit(y, z).major
        too_far = ~(finite & (half[:, : len(self.spec.points)] < FAR).all(axis=1))
        if too_far.any():
            value = abs(run.first + run.acceleration * time * instants[int(too_far.argmax())])
            rpm = value / abs(self.ratio) * RPM.factor
            how = "is unstable and exceeds" if grows else "exceeds"
            raise NoSolution(f"the motion {how} {FAR * 1e3:g} mm, from {rpm:.0f} rpm on")
        return half, moved[:, 2 * pairs :].reshape(len(moved), -1, len(RING))

    def _parts(self, k: int, middles: Indices, edges: Array) -> Parts:
        """Return parts of a subsystem between ``edges`` with the modes of ``middles``. A rotor that
        turns against the spindle moves as the conjugate of one that turns with it."""
        arrays, force, direct = self.solved[k]
        first = 0 if edges[0] <= edges[-1] else -1
        every = *(a[first] for a in arrays[3:5]), *(a[middles] for a in arrays), force, direct
        turned = [np.conj(array) if self.ratio < 0.0 else array for array in every]
        damped, held, pole, vector, left, damping, stiffness, rows, rates, force, direct = turned
        begin = _steady(held, damped, force, edges[0])
        middle, matrices = abs(self.ratio) * self.speed[middles], (damping, stiffness)
        return Parts(
            edges, middle, pole, vector, left, *matrices, force, begin, rows, rates, direct
        )

    def _solve(self, place: Indices) -> None:
        """Solve the machine at some of the speeds."""
        new = np.sort(place[~self.known[place]])
        if not new.size:
            return
        scene = self.scene.at(self.speed[new])
        lost = [k for k, why in enumerate(scene.outcome) if why]
        if lost:
            raise NoSolution(
                f"no solution during the run, at {scene.speed[lost[0]] * RPM.factor:.6g} rpm"
            )
        self.slowest[new] = slowest_pole(scene, self.spec)
        parts = [self._subsystem(scene, k) for k in out_of_balance(scene, self.spec)]
        sizes = [[len(each.force) for each in of] for of in (parts, self.solved)]
        if self.solved and sizes[0] != sizes[1]:
            self.solved, done = [], np.flatnonzero(self.known)  # new coordinates: solve all again
            self.known[:] = False
            self._solve(np.concatenate([new, done]))
            return
        if not self.solved:
            self.solved = [
                each._replace(
                    arrays=[np.zeros((len(self.speed), *a.shape[1:]), a.dtype) for a in each.arrays]
                )
                for each in parts
            ]
        for stored, each in zip(self.solved, parts, strict=True):
            for array, values in zip(stored.arrays, each.arrays, strict=True):
                array[new] = values
        self.known[new] = True

    def _subsystem(self, scene: Scene, k: int) -> _Solved:
        motions = scene.system(k)
        linear, modes = motions.linear, motions.modes
        if (modes.condition > APART).any():
            raise NoSolution(
                "it needs distinct modes: rigid-body modes, and modes that are just critically "
                "damped, are not distinct"
            )
        load = load_of(scene, linear, self.spec)
        *outputs, direct = _output_rows(scene, linear, self.spec, load)
        force, rows = motions.in_modes(load, outputs)
        arrays = [modes.pole, modes.vector, modes.participation, modes.damping, modes.stiffness]
        return _Solved([*arrays, *rows], force, direct)


def _output_rows(
    scene: Scene, linear: Linear, spec: UnbalanceSpec, load: Complex
) -> tuple[Array, Array, Complex]:
    """Return output rows of points, then of forces of connections, along y and z, then of rings of
    bearings: by displacement and by velocity (s, r, n), and by the ``load`` itself (r,), which
    rigid supports carry."""
    axes, connections = [position(axis) for axis in AXES], scene.rotor.connections
    linked = {id(part.link): part for part in linear.connections}
    rigid = linear.rigid_force(np.eye(linear.size, dtype=complex))
    shape = len(linear.speed), len(connections), len(AXES), linear.size
    static, viscous, direct = np.zeros(shape), np.zeros(shape), np.zeros(shape[1:3], dtype=complex)
    for k, link in enumerate(connections):
        if id(link) in linked:
            motions, (stiffness, damping) = linked[id(link)].motions, linked[id(link)].matrices
            static[:, k] = -(stiffness @ motions)[:, axes]
            viscous[:, k] = -(damping @ motions)[:, axes]
        if link.name in rigid:
            carried = rigid[link.name].real[:, axes].T
            static[:, k] -= carried @ linear.stiffness
            viscous[:, k] -= carried @ linear.damping
            direct[k] = carried @ load
    points, rings = (
        np.broadcast_to(a.reshape(-1, linear.size), (len(static), a[..., 0].size, linear.size))
        for a in (displacement_rows(scene, linear, spec), ring_rows(scene, linear))
    )
    rows, rates = (
        np.concatenate([unit * points, part.reshape(len(static), -1, linear.size), unit * rings], 1)
        for unit, part in ((1.0, static), (0.0, viscous))
    )
    zero = [np.zeros(part.shape[1]) for part in (points, rings)]
    return rows, rates, np.concatenate([zero[0], direct.ravel(), zero[1]])


def _steady(stiffness: Matrix, damping: Matrix, force: Complex, omega: float) -> Complex:
    """Return the displacement (n,) of steady rotation, 0 at rest."""
    if omega == 0.0:
        return np.zeros_like(force)
    dynamic = stiffness + 1j * omega * damping - omega**2 * np.eye(len(force))
    return np.asarray(np.linalg.solve(dynamic, omega**2 * force), dtype=complex)
