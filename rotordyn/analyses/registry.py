"""The questions by name, and one call that answers those a case asks."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from bearings.bearing import BallBearing
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.contract import Result, Spec
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.stiffness.spec import StiffnessSpec
from rotordyn.analyses.unbalance.spec import UnbalanceSpec
from rotordyn.machine.rotor import Place
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.conditions import Conditions

if TYPE_CHECKING:
    from rotordyn.scene.stage import Memo

SPINDLE_ANALYSES = {
    "preload": "rotordyn.analyses.preload.solve",
    "campbell": "rotordyn.analyses.campbell.solve",
    "frf": "rotordyn.analyses.frf.solve",
    "stiffness": "rotordyn.analyses.stiffness.solve",
    "section_forces": "rotordyn.analyses.section_forces.solve",
    "unbalance": "rotordyn.analyses.unbalance.solve",
}
BEARING_ANALYSES = {
    "bearing": "rotordyn.analyses.bearing.solve",
    "control": "rotordyn.analyses.control.solve",
}
UNASKED_BAND = 1000.0  # Hz, where no question names a frequency
Progress = Callable[[str], None]


@dataclass(frozen=True, slots=True)
class Answers:
    """Results by analysis name; seconds by stage, and who ``asked`` for it first; residuals.

    ``skipped``: stages that did not run -> why; ``spared``: what the structure of the machine
    saved. ``warnings``: what a designer should know about the machine; ``notes``: what was chosen
    that changes how the results read. Sentences.
    """

    results: dict[str, Result]
    seconds: dict[str, float] = field(default_factory=dict)
    asked: dict[str, str] = field(default_factory=dict)
    skipped: dict[str, str] = field(default_factory=dict)
    spared: tuple[str, ...] = ()
    tolerances: dict[str, float] = field(default_factory=dict)
    warnings: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()


def answer_spindle(
    spindle: Spindle,
    conditions: Conditions,
    speeds: tuple[float, ...],
    analyses: Mapping[str, Spec],
    progress: Progress,
    memo: Memo | None = None,
) -> Answers:
    """Answer ``analyses`` for a spindle at ``speeds`` [rad/s]; shared stages are solved once.

    ``memo``: stages of like machines, of which those of the same inputs are taken over.

    Raises
    ------
    NoSolution : no speed has a physical solution
    """
    from rotordyn.analyses.unbalance.loads import marked
    from rotordyn.numerics.threads import linear_algebra_alone
    from rotordyn.scene.plan import reasons, spared
    from rotordyn.scene.scene import Scene

    for spec in analyses.values():
        if isinstance(spec, UnbalanceSpec):
            spindle = marked(spindle, spec)
    scene = Scene(
        spindle,
        conditions,
        np.array(speeds),
        max_frequency=_highest(analyses, speeds[-1] * max(map(abs, spindle.ratios.values()))),
        ports=_ports(spindle, analyses),
        memo=memo,
    )
    results: dict[str, Result] = {}
    with linear_algebra_alone():
        scene.require_solution()
        for name, spec in analyses.items():
            progress(name)
            answer = import_module(SPINDLE_ANALYSES[name]).answer
            results[name] = scene.timed(f"answer {name}", partial(answer, scene, spec))
        return Answers(
            results,
            seconds=scene.clock.seconds,
            asked=scene.clock.asked,
            skipped=reasons(scene),
            spared=spared(scene),
            tolerances=scene.tolerances,
            warnings=scene.warnings,
            notes=scene.notes,
        )


def answer_bearing(
    bearing: BallBearing,
    conditions: Conditions,
    speeds: tuple[float, ...],
    analyses: Mapping[str, Spec],
    progress: Progress,
) -> Answers:
    """Answer ``analyses`` for a single bearing at ``speeds`` [rad/s]."""
    results, seconds = {}, {}
    for name, spec in analyses.items():
        progress(name)
        begin = time.perf_counter()
        answer: Any = import_module(BEARING_ANALYSES[name]).answer
        results[name] = answer(bearing, conditions, np.array(speeds), spec)
        seconds[name] = time.perf_counter() - begin
    return Answers(results, seconds, dict.fromkeys(seconds, ""))


def _highest(analyses: Mapping[str, Spec], top: float) -> float:
    """Highest frequency any question asks for [Hz]; of unbalance that of the ``top`` speed."""
    asked = [s.max_frequency for s in analyses.values() if isinstance(s, CampbellSpec)]
    asked += [max(s.frequencies) for s in analyses.values() if isinstance(s, FrfSpec)]
    asked += [top / (2.0 * math.pi) for s in analyses.values() if isinstance(s, UnbalanceSpec)]
    return max(asked, default=0.0) or UNASKED_BAND


def _ports(spindle: Spindle, analyses: Mapping[str, Spec]) -> tuple[Place, ...]:
    """Places where forces act or responses are read."""
    found: set[str | float] = set()
    for spec in analyses.values():
        if isinstance(spec, FrfSpec):
            found |= {port.point for pair in spec.pairs for port in pair}
        elif isinstance(spec, StiffnessSpec):
            found.add(spec.point)
        elif isinstance(spec, UnbalanceSpec):
            found |= set(spec.places)
    return tuple(sorted({spindle.place(at) for at in found}))
