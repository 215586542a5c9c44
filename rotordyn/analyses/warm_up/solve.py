"""Solver of a warm-up: temperatures and preload over time, with steps halved to convergence."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from bearings.bearing import BallBearing
from bearings.heat.temperature import Surroundings
from rotordyn.allowance import require_history, require_time
from rotordyn.analyses.warm_up.result import ENOUGH, WarmUpResult
from rotordyn.analyses.warm_up.spec import WarmUpSpec
from rotordyn.arrays import Array
from rotordyn.preload.fit_pressure import fit_pressure
from rotordyn.preload.heat_balance import Flow, cold, tables
from rotordyn.preload.ring_stress import ring_stress
from rotordyn.preload.warming import Begin, SurroundingsAt, Warming, warming
from rotordyn.scene.scene import Scene

STEPS, MOST_STEPS = 20, 640  # of the coarsest and the finest run
NEAR = 0.1  # of the time at which temperatures run away: its largest change by the last halving
STEEL, CERAMIC, LIGHT = 460.0, 700.0, 4500.0  # specific heats [J/(kg K)], the density between them


def solve(scene: Scene, spec: WarmUpSpec) -> WarmUpResult:
    """Return the warm-up of every bearing at every speed, also where temperatures run away.

    Raises
    ------
    TooCostly : it takes more time than allowed
    """
    heat = scene.conditions.heat_flow
    assert heat is not None, "a fault of the case"
    begin, speed = _initial(scene, spec, heat.flow), scene.speed
    surroundings_at = over_time(spec, heat.flow)

    def run(steps: int) -> Warming:
        require_history(f"warm_up: {steps} steps at {len(speed)} speeds", 0, steps * len(speed))
        machine = scene.preload_at(speed), speed, scene.spindle, heat.flow
        return warming(*machine, begin, surroundings_at, spec.duration, steps, _watch(scene, steps))

    steps, fine = STEPS, run(STEPS)
    while True:
        coarse, steps = fine, 2 * steps
        fine = run(steps)
        through, coarse_through = (np.array(each.ending) == "" for each in (fine, coarse))
        # the finer run has every instant of the coarser one
        change = np.abs(fine.temperature[through, ::2] - coarse.temperature[through])
        error = float(np.nanmax(change, initial=0.0))  # runaway has no bound
        end, coarse_end = (each.time[each.last] for each in (fine, coarse))
        converged = (through == coarse_through) & (np.abs(end - coarse_end) <= NEAR * end)
        if (error <= ENOUGH and converged.all()) or steps >= MOST_STEPS:
            break
    error = error if through.any() else math.nan
    return _result(scene, fine, error, surroundings_at, heat.flow)


def _watch(scene: Scene, steps: int) -> Callable[[int], None]:
    def watch(step: int) -> None:
        require_time("warm_up", "broken off")
        scene.clock.progress(f"{step} of {steps} steps")

    return watch


def _initial(scene: Scene, spec: WarmUpSpec, flow: Flow) -> Begin:
    at = cold(flow) if spec.start is None else np.full(3, spec.start)
    capacity = [
        [spec.balls or ball_capacity(seat.bearing), spec.inner, spec.outer]
        for seat in scene.spindle.seats
    ]
    return Begin(np.tile(at, (len(capacity), 1)), np.array(capacity))


def over_time(spec: WarmUpSpec, flow: Flow) -> SurroundingsAt:
    """Return temperatures of shaft, housing and oil over time: the difference of shaft and housing
    from their final temperatures falls to 1/e in each time constant."""
    final = flow.surroundings

    def approach(last: float, constant: float | None, time: float) -> float:
        if constant is None:
            return last
        assert spec.start is not None, "a fault of the case"
        return last + (spec.start - last) * math.exp(-time / constant)

    def at(time: float) -> Surroundings:
        shaft = approach(final.shaft, spec.shaft_time_constant, time)
        return Surroundings(
            shaft, approach(final.housing, spec.housing_time_constant, time), final.oil
        )

    return at


def ball_capacity(bearing: BallBearing) -> float:
    """Return the heat capacity of all balls [J/K], by their mass."""
    density = bearing.ball_material.density
    mass = bearing.balls * density * math.pi / 6.0 * bearing.ball_diameter**3
    return mass * (CERAMIC if density < LIGHT else STEEL)


def _fits(scene: Scene, run: Warming, surroundings_at: SurroundingsAt, flow: Flow) -> Array:
    """Return the pressure of inner and outer rings on their seats, and the stress of inner rings,
    at every instant (3, speeds, t, bearings) [Pa]; NaN where there is none."""
    names = tuple(seat.name for seat in scene.spindle.seats)
    values = np.full((3, *run.load.shape), np.nan)
    for k, time in enumerate(run.time.tolist()):
        rows = ~np.isnan(run.load[:, k, 0])
        speed, now = scene.speed[rows], flow._replace(surroundings=surroundings_at(time))
        if speed.size:
            warm = tables(run.temperature[rows, k], speed, names, now)
            machine = scene.spindle, speed, warm
            values[:, rows, k] = [*fit_pressure(*machine), ring_stress(*machine)]
    return values


def _result(
    scene: Scene, run: Warming, error: float, surroundings_at: SurroundingsAt, flow: Flow
) -> WarmUpResult:
    seats = scene.spindle.seats
    lost = np.isnan(run.load[:, 0, 0]).tolist()
    size = np.abs(run.load)
    place = np.nan_to_num(size, nan=-1.0).argmax(axis=1)
    largest = np.take_along_axis(size, place[:, None], axis=1)[:, 0]
    balance, last = scene.heat_balance, scene.unloaded
    causes = [hot or why for hot, why in zip(balance.outcome, last.outcome, strict=True)]
    balanced = np.array([word == "" for word in causes])[:, None]
    reached = [balance.temperatures.bearings[seat.name] for seat in seats]
    steady = {
        f"steady_{name}_temperature": np.where(balanced, np.array(values).T, np.nan)
        for name, values in (
            ("ball", [part.balls for part in reached]),
            ("inner", [part.inner_ring for part in reached]),
            ("outer", [part.outer_ring for part in reached]),
        )
    }
    balls, inner, outer = np.moveaxis(run.temperature, -1, 0)
    inner_pressure, outer_pressure, stress = _fits(scene, run, surroundings_at, flow)
    shaft, housing, _ = np.array([surroundings_at(t) for t in run.time.tolist()]).T
    return WarmUpResult(
        speed=scene.speed,
        time=run.time,
        bearing=tuple(seat.name for seat in seats),
        outcome=tuple(word if gone else "" for word, gone in zip(run.ending, lost, strict=True)),
        ended=run.time[run.last],
        ending=run.ending,
        axial_load=run.load,
        inner_fit_pressure=inner_pressure,
        outer_fit_pressure=outer_pressure,
        ring_stress=stress,
        ball_temperature=balls,
        inner_temperature=inner,
        outer_temperature=outer,
        shaft_temperature=shaft,
        housing_temperature=housing,
        heat=run.heat,
        largest_load=largest,
        largest_time=np.where(np.isnan(largest), np.nan, run.time[place]),
        steady_load=np.where(balanced, last.seat_load(), np.nan),
        **steady,
        unbalanced=tuple(causes),
        error=error,
    )
