#!/usr/bin/env python3
"""Random stepped rotors identified from synthetic noisy responses:
python -m benchmarks.synthetic_rotors [--count N] [--first K]

Each rotor has eight sections, a disc and two damped supports; six diameters and both dampings are
unknown, with starting values up to 20 % off and of a third to three times their value. Responses
are at three points, at rest and at two speeds, with 2 % noise in real and imaginary part of every
sample. The results are: errors of all frequencies of the band at speeds that were not measured, and
whether wrong models are detected: one without a joint of the rotor, one with two sections merged,
fits with one mode too few and too many.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

import rotordyn
from bearings.materials import Material
from benchmarks.kept import keep
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.measured_response import MeasuredResponse, Port
from rotordyn.machine.joint import Joint
from rotordyn.machine.lumped import Disc
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.numerics.pole_count import counted
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from rotordyn.study.identification.certainty import certainty
from rotordyn.study.identification.criterion import FitCriterion
from rotordyn.study.identification.problem import Problem
from rotordyn.study.identification.responses import Responses
from rotordyn.study.identification.search import Fit, search
from rotordyn.study.identification.trial import Trial
from rotordyn.study.identification.unknown import Unknown, sought

Array = NDArray[np.float64]
STEEL = Material("steel", 2.1e11, 0.3, 7800.0)
COUNT, SECTIONS, KNOWN, NOISE, LINES = 20, 8, 2, 0.02, 400
OFF, DAMPED = 0.2, 3.0  # of diameters; times a damping
MEASURED = (0.0, 0.4, 0.8)  # of the top speed
OTHERS = (0.2, 0.6, 1.0)
MODES = 5  # of the rotor at rest, in the band


@dataclass(frozen=True, eq=False)
class RandomRotor:
    """A rotor, its unknown sections by place, its band [Hz] and top speed [rad/s]."""

    spindle: Spindle
    unknown: tuple[int, ...]
    band: tuple[float, float]
    top: float

    @property
    def true(self) -> dict[str, float]:
        """Values of the unknowns by path."""
        sections = self.spindle.shaft.sections
        diameters = {_diameter(k): sections[k].outer_diameter for k in self.unknown}
        return diameters | {
            f"spindle.supports.{s.name}.damping.yy": float(np.min(s.damping["y", "y"]))
            for s in self.spindle.supports
        }

    def case(self, spindle: Spindle) -> rotordyn.Case:
        """A case of a spindle in this band."""
        speeds = tuple(self.top * share for share in sorted({*MEASURED, *OTHERS}))
        return rotordyn.Case(
            "rotor", "rotor", speeds, {"campbell": CampbellSpec(self.band[1])}, spindle=spindle
        )


def _diameter(k: int) -> str:
    return f"spindle.shaft.sections.s{k}.outer_diameter"


def random_rotor(rng: np.random.Generator) -> RandomRotor:
    """A random rotor."""
    length = rng.uniform(0.04, 0.12, SECTIONS)
    outer = rng.uniform(0.03, 0.07, SECTIONS)
    bore = rng.uniform(0.0, 0.4) * outer.min()
    sections = tuple(
        Section(float(a), float(d), float(bore), STEEL, name=f"s{k}")
        for k, (a, d) in enumerate(zip(length, outer, strict=True))
    )
    whole, ends = float(length.sum()), np.cumsum(length)
    stiff = 48.0 * 2.1e11 * np.pi / 64.0 * np.median(outer) ** 4 / whole**3
    places = rng.uniform(0.05, 0.3) * whole, rng.uniform(0.7, 0.95) * whole
    disc = float(rng.choice(ends[2:6]))
    supports = tuple(
        _support(name, x, stiff * rng.uniform(1.0, 6.0))
        for name, x in zip(("front", "rear"), places, strict=True)
    )
    width = 0.5 * float(np.median(outer))
    size = float(rng.uniform(2.0, 3.5) * outer.max())
    spindle = Spindle(
        "rotor",
        Shaft(0.0, sections),
        discs=(Disc("disc", disc, size, float(outer.max()), width, STEEL),),
        supports=supports,
        points={"tip": 0.0, "disc": disc, "tail": whole},
    )
    still = _frequencies(spindle, 0.0, 2e4)[::2][: MODES + 1]
    top = float(rng.uniform(0.5, 1.2) * 2.0 * np.pi * still[1])
    spindle = replace(
        spindle,
        supports=tuple(_damped(s, rng.uniform(0.005, 0.03), still[1]) for s in spindle.supports),
    )
    unknown = tuple(sorted(rng.permutation(SECTIONS)[: SECTIONS - KNOWN].tolist()))
    band = 0.4 * still[0], float(np.sqrt(still[MODES - 1] * still[MODES]))
    return RandomRotor(spindle, unknown, band, top)


def _support(name: str, x: float, stiffness: float) -> LinearSupport:
    held = {("y", "y"): float(stiffness), ("z", "z"): float(stiffness)}
    return LinearSupport(name, float(x), held)


def _damped(support: LinearSupport, ratio: float, hertz: float) -> LinearSupport:
    """With the damping that gives a loss factor of 2 × ``ratio`` at a frequency."""
    size = float(2.0 * ratio * float(np.min(support.stiffness["y", "y"])) / (2.0 * np.pi * hertz))
    return replace(support, damping={("y", "y"): size, ("z", "z"): size})


def _frequencies(spindle: Spindle, speed: float, highest: float) -> Array:
    """|λ|/2π of all oscillating whirl modes, ascending [Hz]."""
    scene = Scene(spindle, Conditions(), np.array([speed]), highest)
    pole = scene.system(scene.with_motions(("bending",))[0]).pole[0]
    swings = pole[pole.imag > 1e-3 * np.abs(pole)]
    found = np.sort(np.abs(swings)) / (2.0 * np.pi)
    return found[found < highest]


def measured(of: RandomRotor, spindle: Spindle, rng: np.random.Generator) -> Responses:
    """Responses of a spindle with noise."""
    frequency = np.linspace(*of.band, LINES)
    nothing, tip = (1.0,) * LINES, Port("tip", "y")
    asked = tuple(
        MeasuredResponse(
            point, Port(point, "y"), tip, tuple(frequency.tolist()), nothing, nothing, of.top * s
        )
        for s in MEASURED
        for point in spindle.points
    )
    machine = Responses(name="responses", responses=asked, noise=NOISE)
    omega = dict.fromkeys(machine.speed, 2.0 * np.pi * frequency)
    found = machine.computed(Trial(of.case(spindle)), omega)
    return replace(machine, responses=tuple(_noisy(o, found[o.speed][o.pair], rng) for o in asked))


def _noisy(one: MeasuredResponse, values: Any, rng: np.random.Generator) -> MeasuredResponse:
    noise = rng.normal(size=(2, LINES))
    noisy = values * (1.0 + NOISE * (noise[0] + 1j * noise[1]))
    return replace(one, real=tuple(noisy.real.tolist()), imaginary=tuple(noisy.imag.tolist()))


def problem(
    of: RandomRotor, responses: Responses, begin: Mapping[str, float], spindle: Spindle
) -> Problem:
    """The unknowns of a spindle and their starting values."""
    asked = {}
    for path, value in of.true.items():
        if "damping" in path:
            also = (path.replace("yy", "zz"),)
            asked[path] = Unknown(value / 30.0, value * 30.0, start=begin[path], also=also)
        elif path.split(".")[3] in {each.name for each in spindle.shaft.sections}:
            asked[path] = Unknown(0.6 * value, 1.5 * value, start=begin[path])
    case = of.case(spindle)
    return Problem(case, sought(case, asked), (responses,))


def start(of: RandomRotor, rng: np.random.Generator) -> dict[str, float]:
    """Starting values of a search."""
    return {
        path: value * float(rng.uniform(1.0 / DAMPED, DAMPED))
        if "damping" in path
        else value * float(rng.uniform(1.0 - OFF, 1.0 + OFF))
        for path, value in of.true.items()
    }


def errors(of: RandomRotor, found: rotordyn.Case) -> Array:
    """Relative errors of all frequencies of the band at speeds that were not measured."""
    assert found.spindle is not None
    every = []
    for share in OTHERS:
        pair = [
            _frequencies(s, share * of.top, 1.5 * of.band[1]) for s in (of.spindle, found.spindle)
        ]
        count = int((pair[0] < of.band[1]).sum())
        every.append(np.abs(pair[1][:count] / pair[0][:count] - 1.0))
    return np.concatenate(every)


def insufficient(of: Problem, fit: Fit) -> bool:
    """Whether the criterion rejects the model."""
    residuals = [w.residual(p) for w, p in zip(of.weighings, fit.predicted, strict=True)]
    criterion = FitCriterion.of(None, of.measurements)
    return bool(criterion.excess(of, residuals, certainty(of, fit)))


def jointed(of: RandomRotor, rng: np.random.Generator) -> Spindle:
    """With a joint behind the second to fourth section that tilts as half a diameter of shaft."""
    k = int(rng.integers(2, 5))
    sections = of.spindle.shaft.sections
    x = float(sum(s.length for s in sections[:k]))
    thin = min(sections[k - 1].outer_diameter, sections[k].outer_diameter)
    bending = 2.1e11 * np.pi / 64.0 * thin**4
    joint = Joint("joint", x, tilt=float(bending / (0.5 * thin)))
    return replace(of.spindle, joints=(joint,))


def merged(of: RandomRotor) -> Spindle:
    """The known section and its neighbour in front of the disc merged, with mean diameter."""
    sections = list(of.spindle.shaft.sections)
    known = next(k for k in range(SECTIONS) if k not in of.unknown)
    k = min(known, SECTIONS - 2)
    one, other = sections[k], sections[k + 1]
    whole = one.length + other.length
    mean = (one.outer_diameter * one.length + other.outer_diameter * other.length) / whole
    sections[k : k + 2] = [replace(one, length=whole, outer_diameter=mean, name="merged")]
    return replace(of.spindle, shaft=replace(of.spindle.shaft, sections=tuple(sections)))


def orders(responses: Responses) -> tuple[int, int, int]:
    """Speeds at which the evidence rejects one mode less, one mode more, and all speeds."""
    fewer = more = 0
    for speed, fit in responses.modes.items():
        count = len(fit.best.fit.pole)
        evidence = {each.poles: each.evidence for each in fit.trials}
        more += evidence.get(count + 1, np.inf) > evidence[count]
        every = responses.of_speed(speed)
        values = np.array([np.array(o.real) + 1j * np.array(o.imaginary) for o in every]).T
        omega = 2.0 * np.pi * np.array(every[0].frequency)
        less = counted(omega, values, NOISE * np.abs(values), count - 1)
        fewer += less.trials[-1].evidence > evidence[count]
    return fewer, more, len(responses.speed)


def outcome(number: int) -> dict[str, Any]:
    """One rotor identified, and its wrong models."""
    rng = np.random.default_rng((58, number))
    of = random_rotor(rng)
    begin = start(of, rng)
    clock = time.process_time()
    responses = measured(of, of.spindle, rng)
    right = problem(of, responses, begin, of.spindle)
    fit = search(right, right.start)
    seconds = time.process_time() - clock
    sure = certainty(right, fit)
    true = np.array([*of.true.values()])
    error = errors(of, right.machine(fit.values))
    fewer, more, speeds = orders(responses)
    reached = dict(zip(of.true, fit.values.tolist(), strict=True))
    lacking = problem(of, measured(of, jointed(of, rng), rng), reached, of.spindle)
    coarse = problem(of, responses, reached, merged(of))
    return {
        "number": number,
        "frequencies": len(error),
        "worst": float(error.max()),
        "off": (fit.values / true - 1.0).tolist(),
        "inside": ((sure.interval[:, 0] <= true) & (true <= sure.interval[:, 1])).tolist(),
        "reduced": sure.reduced,
        "refused": insufficient(right, fit),
        "machines": right.evaluations,
        "seconds": seconds,
        "joint detected": insufficient(lacking, search(lacking, lacking.start)),
        "section detected": insufficient(coarse, search(coarse, coarse.start)),
        "fewer detected": fewer,
        "more detected": more,
        "speeds": speeds,
    }


def main() -> None:
    """Identify rotors as the command line says, and keep the results."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--count", type=int, default=COUNT)
    parser.add_argument("--first", type=int, default=0)
    given = parser.parse_args()
    found = []
    for number in range(given.first, given.first + given.count):
        found.append(outcome(number))
        each = found[-1]
        line = {k: v for k, v in each.items() if k not in ("off", "inside")}
        print(line, flush=True)  # noqa: T201
    if given.count < COUNT:
        return
    inside = [flag for each in found for flag in each["inside"]]
    summed = {
        key: sum(each[key] for each in found)
        for key in (
            "frequencies",
            "refused",
            "joint detected",
            "section detected",
            "fewer detected",
            "more detected",
            "speeds",
        )
    }
    keep(
        synthetic_rotors={
            "rotors": len(found),
            **summed,
            "worst": max(each["worst"] for each in found),
            "median worst": float(np.median([each["worst"] for each in found])),
            "inside": float(np.mean(inside)),
            "diameter off": float(np.median(np.abs([each["off"][:-2] for each in found]))),
            "damping off": float(np.median(np.abs([each["off"][-2:] for each in found]))),
            "seconds": float(np.median([each["seconds"] for each in found])),
            "machines": float(np.median([each["machines"] for each in found])),
        }
    )


if __name__ == "__main__":
    main()
