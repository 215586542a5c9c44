"""Runs of a machine through the speeds of a case, up and down: motion of points and forces of
bearings and supports on the way."""

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
from rotordyn.arrays import Array, Complex, Matrix
from rotordyn.equation.constraint import along
from rotordyn.equation.dofs import position
from rotordyn.equation.linear import Linear
from rotordyn.errors import NoSolution
from rotordyn.numerics.peaks import vertex
from rotordyn.results.display import RPM
from rotordyn.scene.linearity import FAR, RING, departure, ring_rows
from rotordyn.scene.refinement import AT_REST, relative_change, response_accuracy
from rotordyn.scene.scene import Scene

PARTS = (60, 120, 240, 480)  # of the way, until their number changes the motion no more
ACCURATE = 1e-3  # of the peak: so much they may change it where elements are given
SHOWN = 720  # speeds, evenly, up to each of which the largest motion is given
BETWEEN = 20  # instants from one of them to the next
APART = 1e9  # condition of the vectors: motions then keep seven digits


class Largest(NamedTuple):
    """Half axes on every run: ``over_speed`` (runs, n, k), the largest from one speed to the next,
    ``peak`` and the ``speed`` (runs, k) there."""

    over_speed: Array
    peak: Array
    speed: Array


class Runs(NamedTuple):
    """``name`` and ``outcome`` (runs,) of every run, empty or why it has no solution; ``speed``
    (n,) of the spindle [rad/s]; ``moved`` points [m] and ``pushed`` connections [N]; ``departure``
    (runs, connections) of loads of bearings from those of tangents; ``error`` (runs,) of all over
    their peaks; ``growth`` by itself on the way."""

    name: tuple[str, ...]
    outcome: tuple[str, ...]
    speed: Array
    moved: Largest
    pushed: Largest
    departure: Array
    error: Array
    growth: Growth


def runs_of(scene: Scene, spec: UnbalanceSpec, ratio: float, lost: Sequence[str]) -> Runs:
    """Between the first and the last speed of the case; ``ratio`` of the speed of the rotor out of
    balance to that of the spindle; ``lost`` (speeds,) why a speed has no steady motion."""
    ways = [(each, False) for each in spec.run_up] + [(each, True) for each in spec.run_down]
    count, points = len(ways), len(spec.points)
    columns = points + len(scene.rotor.connections)
    names = tuple(f"{'down' if down else 'up'} in {run_name(time)}" for time, down in ways)
    speed = np.linspace(scene.speed[0], scene.speed[-1], SHOWN + 1) if ways else np.zeros(0)
    amplitude = np.full((count, len(speed), columns), np.nan)
    peak, peak_speed = np.full((2, count, columns), np.nan)
    apart = np.full((count, columns - points), np.nan)
    error, outcome, way = np.full(count, np.nan), [""] * count, _Way(scene, spec, ratio)
    for k, (time, down) in enumerate(ways):
        if why := lost[-1 if down else 0]:
            outcome[k] = f"it begins where there is no steady motion ({why})"
            continue
        try:
            axes, rings, error[k] = _converged(way, time, down=down)
        except NoSolution as absent:
            outcome[k] = str(absent)
            continue
        first, last = speed[[-1, 0]] if down else speed[[0, -1]]
        at = np.linspace(first, last, len(axes))
        peak[k], peak_speed[k] = _peaks(at, axes)
        largest = axes[1:].reshape(SHOWN, BETWEEN, columns).max(axis=1)
        if rings.size:
            apart[k, : rings.shape[1]] = _departure(scene, at, axes[:, points:], rings)
        amplitude[k] = np.concatenate([axes[:1], largest])[:: -1 if down else 1]
    found = amplitude, peak, peak_speed
    moved, pushed = (
        Largest(*(each[..., :points] for each in found)),
        Largest(*(each[..., points:] for each in found)),
    )
    return Runs(names, tuple(outcome), speed, moved, pushed, apart, error, way.growth)


def _peaks(speed: Array, axes: Array) -> tuple[Array, Array]:
    """The largest half axes (k,) of those (t, k) at evenly spaced speeds, and the speeds there;
    between instants by the parabola of their inverse squares, as of one resonance."""
    top, columns = axes.argmax(axis=0), np.arange(axes.shape[1])
    middle = np.clip(top, 1, len(axes) - 2)
    shift, height = vertex(
        np.arange(-1.0, 2.0), axes[middle + np.arange(-1, 2)[:, None], columns].T
    )
    between = (top == middle) & np.isfinite(height)
    at = speed[top] + np.where(between, shift, 0.0) * (speed[1] - speed[0])
    return np.where(between, height, axes[top, columns]), at


def _departure(scene: Scene, speed: Array, force: Array, rings: Complex) -> Array:
    """The largest of every bearing (seats,), of ``rings`` (t, seats, 5) at the instants at which
    forces (t, connections) of bearings are largest."""
    peaks = force[:, : rings.shape[1]].argmax(axis=0)
    ascending, first = np.unique(speed[peaks], return_index=True)
    other = scene.at(ascending)
    found = departure(other, rings[peaks[first[other.usable]]])
    return np.asarray(np.fmax.reduce(found, axis=0, initial=np.nan))


def _converged(way: _Way, time: float, *, down: bool) -> tuple[Array, Complex, float]:
    """Major half axes of orbits and forces (t, points and connections) of a run, the motion of
    rings (t, seats, 5), and the error: the change by twice as many parts over the peak."""
    enough = min(response_accuracy(way.scene), ACCURATE)
    before, error = way.axes(PARTS[0], time, down=down)[0], np.inf
    points = len(way.spec.points)
    for count in PARTS[1:]:
        axes, rings = way.axes(count, time, down=down)
        changed = (
            relative_change(np.nan_to_num(before[:, k]), np.nan_to_num(axes[:, k]), 1, AT_REST)
            for k in (slice(points), slice(points, None))
        )
        error = max(float(each.max(initial=0.0)) for each in changed)
        if error <= enough:
            break
        before = axes
    return axes, rings, error


class _Solved(NamedTuple):
    """A subsystem at every speed of the way: pole, vector, left, damping, stiffness, rows and
    rates, each (s, …); in the coordinates of one plane where both are ``one``; ``force`` and
    ``direct``."""

    arrays: list[NDArray[Any]]
    one: bool
    force: Complex
    direct: Complex


@dataclass(eq=False)
class _Way:
    """A machine on the way between the first and the last speed of a case, solved where it is asked
    for, each speed once."""

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
        """Of motion at the speeds of the case, and at those that were solved on the way."""
        solved, given = np.isfinite(self.slowest), self.scene.speed[self.scene.usable]
        pole = [slowest_pole(self.scene, self.spec), self.slowest[solved]]
        speed = np.concatenate([given, self.speed[solved]])
        return growth_of(self.scene, self.spec, speed, np.concatenate(pole))

    def axes(self, count: int, time: float, *, down: bool) -> tuple[Array, Complex]:
        """Major half axes of the orbits of points, then of forces of connections, (t, both), and
        the motion of rings (t, seats, 5), of a run in ``time`` [s], by two cuts of the way, in
        ``count`` parts and in parts that end in the middle of these. NaN of a force that is not
        determined.

        Raises
        ------
        NoSolution : a speed without a state; motions that nothing holds, or beyond ``FAR``
        """
        step = PARTS[-1] // count
        place = np.arange(0, len(self.speed), step)[:: -1 if down else 1]
        self._solve(place)
        own = abs(self.ratio) * self.speed[place]
        run, instants = Run(own[0], own[-1], time), np.linspace(0.0, 1.0, SHOWN * BETWEEN + 1)
        cuts = (place[1::2], own[::2]), (place[::2], own[[0, *range(1, len(own), 2), -1]])
        with np.errstate(all="ignore"):  # of motion that grows by itself
            even, between = (
                sum(
                    self._parts(k, *cut).moved(run, time * instants)
                    for k in range(len(self.solved))
                )
                for cut in cuts
            )
            moved = blended(np.asarray(even), np.asarray(between), count * instants)
        known = np.isfinite(moved[0])  # not so what rigid supports share
        known[: 2 * len(self.spec.points)] = True
        pairs = len(self.spec.points) + len(self.scene.rotor.connections)
        y, z = np.moveaxis(moved[:, : 2 * pairs].reshape(len(moved), pairs, 2), -1, 0)
        finite = np.isfinite(moved[:, known]).all(axis=1)
        grows = (self.slowest.real > 0.0).any()
        if not (finite.all() or grows):
            raise NoSolution("it is too slow to be computed: take a shorter time")
        with np.errstate(all="ignore"):
            half = orbit(y, z).major
        beyond = ~(finite & (half[:, : len(self.spec.points)] < FAR).all(axis=1))
        if beyond.any():
            spin = abs(run.first + run.acceleration * time * instants[int(beyond.argmax())])
            rpm = spin / abs(self.ratio) * RPM.factor
            how = "grows by itself beyond" if grows else "is wider than"
            raise NoSolution(f"the motion {how} {FAR * 1e3:g} mm, from {rpm:.0f} rpm on")
        return half, moved[:, 2 * pairs :].reshape(len(moved), -1, len(RING))

    def _parts(self, k: int, middles: NDArray[np.intp], edges: Array) -> Parts:
        """Of a subsystem in parts between ``edges`` with the modes of ``middles``. What turns
        against the spindle moves as the conjugate of what turns with it."""
        arrays, _, force, direct = self.solved[k]
        first = 0 if edges[0] <= edges[-1] else -1
        every = *(a[first] for a in arrays[3:5]), *(a[middles] for a in arrays), force, direct
        turned = [np.conj(each) if self.ratio < 0.0 else each for each in every]
        damped, held, pole, vector, left, damping, stiffness, rows, rates, force, direct = turned
        begin = _steady(held, damped, force, edges[0])
        middle, matrices = abs(self.ratio) * self.speed[middles], (damping, stiffness)
        return Parts(
            edges, middle, pole, vector, left, *matrices, force, begin, rows, rates, direct
        )

    def _solve(self, place: NDArray[np.intp]) -> None:
        """The machine at some of the speeds."""
        new = np.sort(place[~self.known[place]])
        if not new.size:
            return
        scene = self.scene.at(self.speed[new])
        lost = [k for k, why in enumerate(scene.outcome) if why]
        if lost:
            raise NoSolution(f"no state on the way, at {scene.speed[lost[0]] * RPM.factor:.6g} rpm")
        self.slowest[new] = slowest_pole(scene, self.spec)
        found = [self._subsystem(scene, k) for k in out_of_balance(scene, self.spec)]
        if self.solved and [each.one for each in found] != [each.one for each in self.solved]:
            self.solved, whole = [], np.flatnonzero(self.known)  # other coordinates: all at once
            self.known[:] = False
            self._solve(np.concatenate([new, whole]))
            return
        if not self.solved:
            self.solved = [
                each._replace(
                    arrays=[np.zeros((len(self.speed), *a.shape[1:]), a.dtype) for a in each.arrays]
                )
                for each in found
            ]
        for kept, each in zip(self.solved, found, strict=True):
            for whole_array, part in zip(kept.arrays, each.arrays, strict=True):
                whole_array[new] = part
        self.known[new] = True

    def _subsystem(self, scene: Scene, k: int) -> _Solved:
        motions = scene.system(k)
        linear, modes = motions.linear, motions.modes
        if (modes.condition > APART).any():
            raise NoSolution(
                "it needs modes that are clearly apart: motions that nothing holds, or that are "
                "just critically damped, have none"
            )
        load = load_of(scene, linear, self.spec)
        force, (*rows, direct) = (
            along(load, linear.basis),
            _asked(scene, linear, self.spec, load),
        )
        rows = [along(each, linear.basis) for each in rows]
        if motions.whirling:
            half = len(force) // 2
            force = force[:half]
            rows = [each[..., :half] - 1j * each[..., half:] for each in rows]
        arrays = [modes.pole, modes.vector, modes.participation, modes.damping, modes.stiffness]
        return _Solved([*arrays, *rows], motions.whirling, force, direct)


def _asked(
    scene: Scene, linear: Linear, spec: UnbalanceSpec, load: Complex
) -> tuple[Array, Array, Complex]:
    """Of points, then of forces of connections, along y and z, then of rings of bearings: by
    displacement and by velocity (s, r, n), and by the ``load`` itself (r,), which rigid supports
    take."""
    axes, connections = [position(way) for way in AXES], scene.rotor.connections
    linked = {id(each.link): each for each in linear.connections}
    rigid = linear.rigid_force(np.eye(linear.size, dtype=complex))
    shape = len(linear.speed), len(connections), len(AXES), linear.size
    held, damped, direct = np.zeros(shape), np.zeros(shape), np.zeros(shape[1:3], dtype=complex)
    for k, link in enumerate(connections):
        if id(link) in linked:
            motions, (stiffness, damping) = linked[id(link)].motions, linked[id(link)].matrices
            held[:, k] = -(stiffness @ motions)[:, axes]
            damped[:, k] = -(damping @ motions)[:, axes]
        if link.name in rigid:
            taken = rigid[link.name].real[:, axes].T
            held[:, k] -= taken @ linear.stiffness
            damped[:, k] -= taken @ linear.damping
            direct[k] = taken @ load
    points, rings = (
        np.broadcast_to(each.reshape(-1, linear.size), (len(held), each[..., 0].size, linear.size))
        for each in (displacement_rows(scene, linear, spec), ring_rows(scene, linear))
    )
    rows, rates = (
        np.concatenate([still * points, each.reshape(len(held), -1, linear.size), still * rings], 1)
        for still, each in ((1.0, held), (0.0, damped))
    )
    none = [np.zeros(each.shape[1]) for each in (points, rings)]
    return rows, rates, np.concatenate([none[0], direct.ravel(), none[1]])


def _steady(stiffness: Matrix, damping: Matrix, force: Complex, omega: float) -> Complex:
    """Displacement (n,) of steady rotation; at rest nothing acts."""
    if omega == 0.0:
        return np.zeros_like(force)
    dynamic = stiffness + 1j * omega * damping - omega**2 * np.eye(len(force))
    return np.asarray(np.linalg.solve(dynamic, omega**2 * force), dtype=complex)
