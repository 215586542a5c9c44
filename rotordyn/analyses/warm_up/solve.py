"""Temperatures and preload over time from the start, the steps halved until temperatures stay."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from bearings.bearing import BallBearing
from bearings.heat.temperature import Surroundings
from rotordyn.allowance import require_history, require_time
from rotordyn.analyses.warm_up.result import ENOUGH, WarmUpResult
from rotordyn.analyses.warm_up.spec import WarmUpSpec
from rotordyn.preload.heat_balance import Flow, cold
from rotordyn.preload.warming import Begin, SurroundingsAt, Warming, warming
from rotordyn.scene.scene import Scene

STEPS, MOST_STEPS = 20, 640  # of the coarsest run and the finest
NEAR = 0.1  # of the time up to which temperatures run away: a change by the last halving
STEEL, CERAMIC, LIGHT = 460.0, 700.0, 4500.0  # specific heats [J/(kg K)], the density between them


def answer(scene: Scene, spec: WarmUpSpec) -> WarmUpResult:
    """Every bearing at every speed, also where temperatures will run away.

    Raises
    ------
    TooCostly : that takes more time than is allowed
    """
    heat = scene.conditions.heat_flow
    assert heat is not None, "a fault of the case"
    begin, speed = _begin(scene, spec, heat.flow), scene.speed
    surroundings_at = over_time(spec, heat.flow)

    def run(steps: int) -> Warming:
        require_history(f"warm_up: {steps} steps at {len(speed)} speeds", 0, steps * len(speed))
        machine = scene.warm(speed), speed, scene.spindle, heat.flow
        return warming(*machine, begin, surroundings_at, spec.duration, steps, _watch(scene, steps))

    steps, found = STEPS, run(STEPS)
    while True:
        before, steps = found, 2 * steps
        found = run(steps)
        through, coarse = (np.array(each.ending) == "" for each in (found, before))
        gaps = np.abs(found.temperature[through, ::2] - before.temperature[through])
        error = float(np.nanmax(gaps, initial=0.0))  # what runs away leaves any bound
        end, coarse_end = (each.time[each.last] for each in (found, before))
        settled = (through == coarse) & (np.abs(end - coarse_end) <= NEAR * end)
        if (error <= ENOUGH and settled.all()) or steps >= MOST_STEPS:
            break
    error = error if through.any() else math.nan
    return _result(scene, found, error, surroundings_at)


def _watch(scene: Scene, steps: int) -> Callable[[int], None]:
    def watch(step: int) -> None:
        require_time("warm_up", "broken off")
        scene.progress(f"{step} of {steps} steps")

    return watch


def _begin(scene: Scene, spec: WarmUpSpec, flow: Flow) -> Begin:
    at = cold(flow) if spec.start is None else np.full(3, spec.start)
    capacity = [
        [spec.balls or ball_capacity(seat.bearing), spec.inner, spec.outer]
        for seat in scene.spindle.seats
    ]
    return Begin(np.tile(at, (len(capacity), 1)), np.array(capacity))


def over_time(spec: WarmUpSpec, flow: Flow) -> SurroundingsAt:
    """Temperatures of shaft, housing and oil: what shaft and housing have left of their way from
    the start falls to 1/e in each time constant."""
    end = flow.surroundings

    def on_the_way(last: float, constant: float | None, time: float) -> float:
        if constant is None:
            return last
        assert spec.start is not None, "a fault of the case"
        return last + (spec.start - last) * math.exp(-time / constant)

    def at(time: float) -> Surroundings:
        shaft = on_the_way(end.shaft, spec.shaft_time_constant, time)
        return Surroundings(
            shaft, on_the_way(end.housing, spec.housing_time_constant, time), end.oil
        )

    return at


def ball_capacity(bearing: BallBearing) -> float:
    """Heat capacity of all balls by their mass [J/K]."""
    density = bearing.ball_material.density
    mass = bearing.balls * density * math.pi / 6.0 * bearing.ball_diameter**3
    return mass * (CERAMIC if density < LIGHT else STEEL)


def _result(
    scene: Scene, found: Warming, error: float, surroundings_at: SurroundingsAt
) -> WarmUpResult:
    seats = scene.spindle.seats
    none = np.isnan(found.load[:, 0, 0]).tolist()
    size = np.abs(found.load)
    place = np.nan_to_num(size, nan=-1.0).argmax(axis=1)
    largest = np.take_along_axis(size, place[:, None], axis=1)[:, 0]
    balance, last = scene.heat_balance, scene.unloaded
    words = [hot or why for hot, why in zip(balance.outcome, last.outcome, strict=True)]
    known = np.array([word == "" for word in words])[:, None]
    reached = [balance.temperatures.bearings[seat.name] for seat in seats]
    steady = {
        f"steady_{name}_temperature": np.where(known, np.array(values).T, np.nan)
        for name, values in (
            ("ball", [each.balls for each in reached]),
            ("inner", [each.inner_ring for each in reached]),
            ("outer", [each.outer_ring for each in reached]),
        )
    }
    balls, inner, outer = np.moveaxis(found.temperature, -1, 0)
    shaft, housing, _ = np.array([surroundings_at(t) for t in found.time.tolist()]).T
    return WarmUpResult(
        speed=scene.speed,
        time=found.time,
        bearing=tuple(seat.name for seat in seats),
        outcome=tuple(word if gone else "" for word, gone in zip(found.ending, none, strict=True)),
        ended=found.time[found.last],
        ending=found.ending,
        axial_load=found.load,
        ball_temperature=balls,
        inner_temperature=inner,
        outer_temperature=outer,
        shaft_temperature=shaft,
        housing_temperature=housing,
        heat=found.heat,
        largest_load=largest,
        largest_time=np.where(np.isnan(largest), np.nan, found.time[place]),
        steady_load=np.where(known, last.seat_load(), np.nan),
        **steady,
        unbalanced=tuple(words),
        error=error,
    )
