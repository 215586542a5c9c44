"""Runs of a machine through the speeds of a case, up and down: motion of points on the way."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from rotordyn.analyses.unbalance.orbit import orbit
from rotordyn.analyses.unbalance.run_up import WELL_CONDITIONED, Parts, Run, blended
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.analyses.unbalance.steady import displacement_rows, load_of, out_of_balance
from rotordyn.arrays import Array, Complex, Indices, Matrix
from rotordyn.errors import NoSolution
from rotordyn.results.display import RPM
from rotordyn.scene.refinement import response_accuracy
from rotordyn.scene.scene import Scene

PARTS = (60, 120, 240, 480)  # of the way, until their number changes the motion no more
SHOWN = 720  # speeds, evenly, at which the motion is given beside the first one
BETWEEN = 20  # instants from one of these to the next, among which the largest motion is sought


class Runs(NamedTuple):
    """Motion of points on every run: ``name`` (runs,), ``speed`` (n,) of the spindle [rad/s];
    ``amplitude`` (runs, n, points) [m]; largest ``peak`` and its ``peak_speed`` (runs, points);
    ``error`` (runs,) of the motion over its peak."""

    name: tuple[str, ...]
    speed: Array
    amplitude: Array
    peak: Array
    peak_speed: Array
    error: Array


def runs_of(scene: Scene, spec: UnbalanceSpec, ratio: float) -> Runs:
    """Between the first and the last speed of the case; ``ratio`` of the speed of the rotor out of
    balance to that of the spindle.

    Raises
    ------
    NoSolution : a speed on the way without a state; motions that nothing holds
    """
    ways = [(each, False) for each in spec.run_up] + [(each, True) for each in spec.run_down]
    count, points = len(ways), len(spec.points)
    names = [f"{'down' if down else 'up'} in {duration:.4g} s" for duration, down in ways]
    ends = float(scene.speed[0]), float(scene.speed[-1])
    speed = np.linspace(*ends, SHOWN + 1) if ways else np.zeros(0)
    amplitude = np.empty((count, len(speed), points))
    peak, peak_speed, error = *np.empty((2, count, points)), np.empty(count)
    for way in sorted({down for _, down in ways}):
        on_way = ends[::-1] if way else ends
        at = np.linspace(*on_way, SHOWN * BETWEEN + 1)
        these = [k for k, (_, down) in enumerate(ways) if down == way]
        first, last = (abs(ratio) * each for each in on_way)
        runs = [Run(first, last, ways[k][0]) for k in these]
        every, error[these] = _converged(scene, spec, ratio, on_way, runs)
        for k, axes in zip(these, every, strict=True):
            peak[k], peak_speed[k] = axes.max(axis=0), at[axes.argmax(axis=0)]
            amplitude[k] = axes[:: -BETWEEN if way else BETWEEN]
    return Runs(tuple(names), speed, amplitude, peak, peak_speed, error)


def _converged(
    scene: Scene, spec: UnbalanceSpec, ratio: float, ends: tuple[float, float], runs: list[Run]
) -> tuple[list[Array], list[float]]:
    """Major half axes of the orbits of points (t, points) of every run, and their errors: changes
    by twice as many parts over the peak."""
    before, error = list[Array](), [np.inf] * len(runs)
    for count in PARTS:
        cuts = _cuts(scene, spec, ratio, ends, count)
        every = [_axes(cuts, run, count) for run in runs]
        changes = zip(every, before, strict=False)
        error = [_change(one, other) for one, other in changes]
        if before and max(error) <= response_accuracy(scene):
            break
        before = every
    return every, error


def _change(one: Array, other: Array) -> float:
    """Largest change of a point's half axes (t, points) over its peak, where it moves at all."""
    peak = one.max(axis=0)
    change = np.abs(one - other).max(axis=0)
    return float(np.divide(change, peak, out=np.zeros_like(peak), where=peak > 0.0).max())


def _axes(cuts: Sequence[Sequence[Parts]], run: Run, count: int) -> Array:
    """Of one run (t, points), by two cuts into parts of the same length."""
    instants = np.linspace(0.0, 1.0, SHOWN * BETWEEN + 1)
    with np.errstate(over="ignore", invalid="ignore"):  # of motion that grows by itself
        even, between = (
            sum(each.moved(run, run.duration * instants) for each in parts) for parts in cuts
        )
    share = 1.0 - 2.0 * np.abs((count * instants) % 1.0 - 0.5)
    moved = blended(np.asarray(even), np.asarray(between), share)
    y, z = np.moveaxis(moved.reshape(len(moved), -1, 2), -1, 0)
    if not (np.isfinite(y) & np.isfinite(z)).all():
        raise NoSolution(
            f"unbalance: the motion of a run through the speeds in {run.duration:.4g} s grows by "
            "itself beyond all numbers: leave it out, or give damping"
        )
    return orbit(y, z).major


def _cuts(
    scene: Scene, spec: UnbalanceSpec, ratio: float, ends: tuple[float, float], count: int
) -> list[list[Parts]]:
    """The way in ``count`` parts, and in parts that end in the middle of these: modes of every
    subsystem out of balance in their middle, at the ends of the way at these."""
    speed = np.linspace(*ends, 2 * count + 1)
    order = slice(None, None, -1 if ends[0] > ends[1] else 1)
    other = scene.at(speed[order])
    lost = [k for k, why in enumerate(other.outcome) if why]
    if lost:
        raise NoSolution(
            f"unbalance: no state at {other.speed[lost[0]] * RPM.factor:.6g} rpm, on the way of "
            "run_up and run_down: leave them out, or end below that speed"
        )
    every = np.arange(len(speed))
    rows = every[order]
    even, between = (rows[1::2], speed[::2]), (rows[::2], speed[[0, *every[1::2], -1]])
    return [
        [_subsystem(other, spec, ratio, k, middles, edges) for k in out_of_balance(other, spec)]
        for middles, edges in (even, between)
    ]


def _subsystem(
    scene: Scene, spec: UnbalanceSpec, ratio: float, k: int, middles: Indices, edges: Array
) -> Parts:
    """Of parts between ``edges`` (s + 1,) with the modes of the speeds in the rows ``middles`` (s,)
    of the scene; where both planes are one, plane y alone. What turns against the spindle moves as
    the conjugate of what turns with it."""
    motions = scene.system(k)
    linear, modes = motions.linear, motions.modes
    if (modes.condition > WELL_CONDITIONED).any():
        raise NoSolution(
            "unbalance: run_up and run_down need modes that are clearly apart, and motions that "
            "nothing holds, or that are just critically damped, have none: leave them out"
        )
    force = load_of(scene, linear, spec) @ linear.basis
    rows = displacement_rows(scene, linear, spec).reshape(-1, linear.size) @ linear.basis
    if motions.whirling:
        half = len(force) // 2
        force, rows = force[:half], rows[:, :half] - 1j * rows[:, half:]
    parts = [modes.pole, modes.vector, modes.participation, modes.damping, modes.stiffness]
    first = [each[0 if edges[0] <= edges[-1] else -1] for each in parts[3:]]
    if len(modes.pole) > 1:
        parts = [each[middles] for each in parts]
    every = [np.asarray(each, dtype=complex) for each in (*parts[:4], *first, force, rows)]
    turned = [each.conj() if ratio < 0.0 else each for each in every]
    pole, vector, left, damping, first_damping, first_stiffness, load, shown = turned
    speed = abs(ratio) * edges
    begin = _steady(first_stiffness, first_damping, load, speed[0])
    return Parts(speed, pole, vector, left, damping, load, begin, shown)


def _steady(stiffness: Matrix, damping: Matrix, force: Complex, omega: float) -> Complex:
    """Displacement (n,) of steady rotation; at rest nothing acts."""
    if omega == 0.0:
        return np.zeros_like(force)
    dynamic = stiffness + 1j * omega * damping - omega**2 * np.eye(len(force))
    return np.asarray(np.linalg.solve(dynamic, omega**2 * force), dtype=complex)
