#!/usr/bin/env python3
"""Computing time over the size of machine and analyses:  python -m benchmarks.scaling [SWEEP …]

Each sweep enlarges one size and keeps the others: sections of a shaft, speeds and frequencies of
the flagship, bearings on a shaft, balls of a bearing. Times are the fastest of some calls. Every
shaft has a separate process; its memory is reported, and its first call also loads the libraries.
"""

from __future__ import annotations

import argparse
import json
import math
import resource
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

import rotordyn
from bearings.kinds.angular_contact import AngularContactBallBearing
from bearings.materials import Material
from benchmarks.kept import keep
from benchmarks.processes import MEGABYTE, ROOT, python
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.contract import Spec
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.preload.spec import PreloadSpec
from rotordyn.analyses.solving import solve_spindle
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.sleeve import Sleeve, Spring
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions

RPM = math.pi / 30.0
STEEL = Material("steel", 2.1e11, 0.3, 7800.0)
SECTIONS = (60, 200, 600, 2000, 6000, 10_000, 20_000)
SPEEDS = (25, 50, 100, 200, 400)
FREQUENCIES = (1000, 2000, 4000, 8000, 16_000)
BEARINGS = (2, 4, 8, 16, 32)
BALLS = (8, 16, 32, 64, 128)
RUNS = 7
BAND = 1500.0  # Hz: more than ten modes of the shaft
STATES = 200


def fastest(call: Callable[[], Any], runs: int = RUNS) -> float:
    """Seconds of the fastest call."""
    seconds = []
    for _ in range(runs):
        begin = time.perf_counter()
        call()
        seconds.append(time.perf_counter() - begin)
    return min(seconds)


def results_of(
    spindle: Spindle, conditions: Conditions, speeds: Any, analyses: Mapping[str, Spec]
) -> dict[str, Any]:
    """Results of a spindle by name."""
    turning = tuple(float(speed) for speed in speeds)
    return solve_spindle(spindle, conditions, turning, analyses, lambda name: None).results


def long_shaft(sections: int) -> Spindle:
    """A metre of as many sections, no two of them alike, on two supports."""
    length, wave = 1.0 / sections, 7.0 / sections
    diameters = [0.06 + 0.01 * math.sin(wave * k) for k in range(sections)]
    pieces = tuple(Section(length, diameter, 0.02, STEEL) for diameter in diameters)
    held = tuple(
        LinearSupport(
            name, x, {("y", "y"): 1e8, ("z", "z"): 1e8}, {("y", "y"): 1e3, ("z", "z"): 1e3}
        )
        for name, x in (("front", 0.1), ("rear", 0.9))
    )
    return Spindle("long", Shaft(0.0, pieces), supports=held)


def one_shaft(sections: int) -> dict[str, Any]:
    """A shaft's modes at one speed, in this process."""
    spindle = long_shaft(sections)

    def call() -> Any:
        asked = {"campbell": CampbellSpec(BAND)}
        return results_of(spindle, Conditions(), (1000.0,), asked)["campbell"]

    begin = time.perf_counter()
    found = call()
    first = time.perf_counter() - begin
    seconds = fastest(call)
    per_unit = 1.0 if sys.platform == "darwin" else 1024.0
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * per_unit / MEGABYTE
    return {
        "size": sections,
        "modes": len(found.mode),
        "reported": float(np.nanmax(found.frequency_error)),
        "first": first,
        "seconds": seconds,
        "memory": memory,
    }


def shafts() -> list[dict[str, Any]]:
    """A line per number of sections."""
    lines = []
    for sections in SECTIONS:
        command = python("-m", "benchmarks.scaling", "--shaft", str(sections))
        done = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True)
        lines.append(json.loads(done.stdout))
    return lines


def flagship(name: str) -> tuple[Spindle, Conditions, Any]:
    """The flagship, its conditions, and the analysis of its case of a name."""
    case = rotordyn.load(ROOT / "cases" / "mfw2310.yaml")
    assert case.spindle is not None, "the flagship is a spindle"
    return case.spindle, case.conditions, case.analyses[name]


def speeds() -> list[dict[str, Any]]:
    """The flagship's Campbell diagram, bearings solved at every speed."""
    spindle, conditions, spec = flagship("campbell")
    return [
        _line(
            count,
            results_of,
            spindle,
            conditions,
            np.linspace(0.0, 24000.0, count) * RPM,
            {"campbell": spec},
        )
        for count in SPEEDS
    ]


def frequencies() -> list[dict[str, Any]]:
    """The flagship's receptances at seven speeds."""
    spindle, conditions, spec = flagship("frf")
    assert isinstance(spec, FrfSpec), "the flagship asks for receptances"
    return [
        _line(
            count,
            results_of,
            spindle,
            conditions,
            np.linspace(0.0, 24000.0, 7) * RPM,
            {"frf": replace(spec, frequencies=tuple(np.linspace(5.0, 4000.0, count).tolist()))},
        )
        for count in FREQUENCIES
    ]


def bearing(balls: int) -> AngularContactBallBearing:
    """A ring of the same filling with any number of balls of 9.525 mm."""
    size = 9.525e-3
    pitch = 1.16 * size / math.sin(math.pi / balls)
    return AngularContactBallBearing(
        size,
        pitch,
        balls,
        contact_angle=math.radians(25.0),
        inner_conformity=0.56,
        outer_conformity=0.54,
    )


def on_bearings(count: int) -> Spindle:
    """A shaft on as many bearings, no two of them alike, the rear half on a sprung sleeve."""
    seats = tuple(
        BearingSeat(
            f"b{k}",
            replace(bearing(25), contact_angle=math.radians(20.0 + 5.0 * k / count)),
            0.05 + 0.9 * (k + 0.5) / count,
            1 if k < count // 2 else -1,
            radial_damping=1e3,
        )
        for k in range(count)
    )
    rear = tuple(seat.name for seat in seats[count // 2 :])
    sleeve = Sleeve("rear", rear, Spring(300.0 * count, 1e7))
    shaft = Shaft(0.0, (Section(1.0, 0.06, 0.02, STEEL),))
    return Spindle("on bearings", shaft, seats=seats, sleeves=(sleeve,))


def bearings() -> list[dict[str, Any]]:
    """Preload, tangents and modes at 25 speeds."""
    turning = np.linspace(0.0, 20000.0, 25) * RPM
    asked: dict[str, Spec] = {"preload": PreloadSpec(), "campbell": CampbellSpec(BAND)}
    return [
        _line(count, results_of, on_bearings(count), Conditions(), turning, asked)
        for count in BEARINGS
    ]


def balls() -> list[dict[str, Any]]:
    """States of one bearing under thrust, radial load and moment, all solved together."""
    draw = np.random.default_rng(1)
    lines = []
    for count in BALLS:
        own = bearing(count)
        load = np.zeros((STATES, 5))
        load[:, 0] = draw.uniform(20.0, 40.0, STATES) * count
        load[:, 1:3] = draw.uniform(-5.0, 5.0, (STATES, 2)) * count
        turning = 800.0 * 90e-3 / own.pitch_diameter

        def call(own: Any = own, load: Any = load, turning: float = turning) -> Any:
            return own.equilibrium(load=load, speed=turning, compiled=True)

        call()
        lines.append({"size": count, "seconds": fastest(call) / STATES})
    return lines


def _line(size: int, call: Callable[..., Any], *arguments: Any) -> dict[str, Any]:
    call(*arguments)
    return {"size": size, "seconds": fastest(lambda: call(*arguments))}


SWEEPS: dict[str, Callable[[], list[dict[str, Any]]]] = {
    "sections": shafts,
    "speeds": speeds,
    "frequencies": frequencies,
    "bearings": bearings,
    "balls": balls,
}


def main() -> None:
    """Measure the named sweeps, all by default, and keep the results."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("sweeps", nargs="*", metavar="SWEEP", help=", ".join(SWEEPS))
    parser.add_argument("--shaft", type=int, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.shaft:
        print(json.dumps(one_shaft(arguments.shaft)))  # noqa: T201
        return
    for name in arguments.sweeps or SWEEPS:
        lines = SWEEPS[name]()
        for line in lines:
            print(name, line)  # noqa: T201
        keep("scaling", **{name: lines})


if __name__ == "__main__":
    main()
