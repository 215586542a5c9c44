"""All analyses of a case solved by one call."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from bearings.bearing import BallBearing
from rotordyn.allowance import STOPS, Stop, heeding_stops, keeps_finished, require_time
from rotordyn.analyses.contract import Result
from rotordyn.analyses.registry import analysis
from rotordyn.analyses.unlimited import unlimited
from rotordyn.machine.plausibility import estimates
from rotordyn.machine.rotor import Place
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.expansions import (
    bearing_materials,
    expanding_materials,
    unknown_expansions,
)
from rotordyn.scene.spec import Spec

if TYPE_CHECKING:
    from rotordyn.scene.checks import Checks
    from rotordyn.scene.scene import Scene
    from rotordyn.scene.stage import Memo

DEFAULT_BAND = 1000.0  # Hz, where no analysis names a frequency
Progress = Callable[[str], None]


@dataclass(frozen=True, slots=True)
class MachineResults:
    """Results by analysis name; seconds by stage, and its first caller (``asked``); residuals where
    errors are estimated.

    ``skipped``: stages that did not run -> why; ``spared``: work that the structure of the
    machine saves. ``warnings``: on the machine, for its designer; ``notes``: on choices that change
    how results read. Sentences. ``stop``: what ended the run before all analyses
    had results.
    """

    results: dict[str, Result]
    seconds: dict[str, float] = field(default_factory=dict)
    asked: dict[str, str] = field(default_factory=dict)
    skipped: dict[str, str] = field(default_factory=dict)
    spared: tuple[str, ...] = ()
    tolerances: dict[str, float] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    stop: Stop | None = None


def solve_spindle(
    spindle: Spindle,
    conditions: Conditions,
    speeds: tuple[float, ...],
    analyses: Mapping[str, Spec],
    progress: Progress,
    memo: Memo | None = None,
    checks: Checks | None = None,
) -> MachineResults:
    """Solve ``analyses`` for a spindle at ``speeds`` [rad/s]; shared stages are solved once.

    ``memo``: stages of similar machines, reused where their inputs are the same; ``checks``:
    whether errors are estimated with a finer model, as they are by default.

    Raises
    ------
    NoSolution : no speed has a physical solution, and an analysis needs one
    """
    from rotordyn.numerics.threads import linear_algebra_alone
    from rotordyn.scene.plan import reasons, spared
    from rotordyn.scene.scene import Scene
    from rotordyn.scene.stage import SOLVE, Clock

    for name, spec in analyses.items():
        marks = analysis(name).marks
        spindle = spindle if marks is None else marks(spindle, spec)
    scene = Scene(
        spindle,
        conditions,
        np.array(speeds),
        max_frequency=_highest(analyses, speeds[-1] * max(map(abs, spindle.ratios.values()))),
        ports=_ports(spindle, analyses),
        memo=memo,
        clock=Clock(report=progress),
        checks=checks,
    )

    def solve(name: str, spec: Spec) -> Result:
        return scene.timed(SOLVE + name, partial(analysis(name).solve, scene, spec))

    with linear_algebra_alone():
        if not all(analysis(name).unsteady for name in analyses):
            scene.require_solution()
        results, stop = _solved_in_turn(analyses, solve, progress)
        return MachineResults(
            results,
            seconds=scene.clock.seconds,
            asked=scene.clock.asked,
            skipped=reasons(scene),
            spared=spared(scene),
            tolerances=scene.tolerances if scene.checks.wanted else {},
            warnings=(
                *scene.warnings,
                *_unknown_expansions(scene, analyses),
                *unlimited(spindle, analyses),
            ),
            notes=scene.notes,
            stop=stop,
        )


def _unknown_expansions(scene: Scene, analyses: Mapping[str, Spec]) -> Iterable[str]:
    """Warnings of materials without α where analyses alone change temperatures."""
    thermal = scene.conditions.temperatures or scene.conditions.heat_flow
    if thermal is not None or not any(spec.heats for spec in analyses.values()):
        return ()
    return unknown_expansions(expanding_materials(scene.spindle))


def _solved_in_turn(
    analyses: Mapping[str, Spec], solve: Callable[[str, Spec], Result], progress: Progress
) -> tuple[dict[str, Result], Stop | None]:
    """Solve analyses in turn: results by name, and what ended a run that keeps those finished."""
    results: dict[str, Result] = {}
    try:
        for name, spec in analyses.items():
            progress(name)
            with heeding_stops():
                results[name] = solve(name, spec)
    except STOPS as stop:
        if not (results and keeps_finished()):
            raise
        return results, stop
    return results, None


def solve_bearing(
    bearing: BallBearing,
    conditions: Conditions,
    speeds: tuple[float, ...],
    analyses: Mapping[str, Spec],
    progress: Progress,
) -> MachineResults:
    """Solve ``analyses`` for a single bearing at ``speeds`` [rad/s]."""
    seconds: dict[str, float] = {}

    def solve(name: str, spec: Spec) -> Result:
        require_time(name)
        begin = time.perf_counter()
        result: Result = analysis(name).solve(bearing, conditions, np.array(speeds), spec)
        seconds[name] = time.perf_counter() - begin
        return result

    results, stop = _solved_in_turn(analyses, solve, progress)
    flows = [flow for spec in analyses.values() for flow in spec.heat_flows]
    return MachineResults(
        results,
        seconds,
        dict.fromkeys(seconds, ""),
        warnings=(
            *estimates({"": bearing}),
            *(sentence for flow in flows for sentence in flow.guesses()),
            *(unknown_expansions(bearing_materials(bearing)) if flows else ()),
        ),
        notes=tuple(flow.note for flow in flows),
        stop=stop,
    )


def _highest(analyses: Mapping[str, Spec], top: float) -> float:
    """Highest frequency of any analysis [Hz]; ``top``: highest speed of all rotors [rad/s]."""
    frequencies = (analysis(name).highest(spec, top) for name, spec in analyses.items())
    return max(frequencies, default=0.0) or DEFAULT_BAND


def _ports(spindle: Spindle, analyses: Mapping[str, Spec]) -> tuple[Place, ...]:
    """Places where forces act or responses are read."""
    points = {at for name, spec in analyses.items() for at in analysis(name).ports(spec)}
    return tuple(sorted({spindle.place(at) for at in points}))
