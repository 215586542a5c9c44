"""A rotor of five sections whose frequency responses are known, with noise."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import rotordyn
from bearings.materials import Material
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.analyses.measured_response import MeasuredResponse, Port
from rotordyn.machine.lumped import Disc
from rotordyn.machine.shaft import Section, Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from rotordyn.study.identification.responses import Responses
from rotordyn.study.identification.trial import Trial
from rotordyn.study.identification.unknown import Unknown

STEEL = Material("steel", 2.1e11, 0.3, 7800.0)
FREQUENCY = np.linspace(150.0, 1900.0, 160)
SPEEDS, OTHER = (0.0, 700.0), 1500.0  # rad/s
OUTER = (0.030, 0.050, 0.060, 0.050, 0.040)
DAMPING = (300.0, 200.0)


def spindle() -> Spindle:
    """Five sections, a disc, two damped supports."""
    lengths = (0.10, 0.14, 0.12, 0.14, 0.11)
    sections = tuple(
        Section(a, d, 0.0, STEEL, name=f"s{k}")
        for k, (a, d) in enumerate(zip(lengths, OUTER, strict=True))
    )
    supports = tuple(
        LinearSupport(name, x, {("y", "y"): k, ("z", "z"): k}, {("y", "y"): c, ("z", "z"): c})
        for name, x, k, c in zip(("front", "rear"), (0.12, 0.52), (8e7, 5e7), DAMPING, strict=True)
    )
    points = {"tip": 0.0, "tail": 0.61}
    disc = Disc("disc", 0.30, 0.16, 0.06, 0.03, STEEL)
    return Spindle("twin", Shaft(0.0, sections), discs=(disc,), supports=supports, points=points)


def case(of: Spindle) -> rotordyn.Case:
    speeds = (*SPEEDS, OTHER)
    return rotordyn.Case("twin", "twin", speeds, {"campbell": CampbellSpec(1900.0)}, spindle=of)


def blank(point: str, speed: float, way: str = "y") -> MeasuredResponse:
    nothing = (1.0,) * len(FREQUENCY)
    ports = Port(point, way), Port("tip", way)
    return MeasuredResponse("r", *ports, tuple(FREQUENCY.tolist()), nothing, nothing, speed)


def measured(of: Spindle, seed: int = 1, noise: float = 0.02, ways: str = "y") -> Responses:
    rng = np.random.default_rng(seed)
    asked = tuple(
        blank(point, speed, way) for speed in SPEEDS for point in of.points for way in ways
    )
    whole = Responses(name="taps", responses=asked, noise=0.02)
    found = whole.computed(Trial(case(of)), dict.fromkeys(SPEEDS, 2.0 * np.pi * FREQUENCY))

    def noisy(one: MeasuredResponse) -> MeasuredResponse:
        parts = rng.normal(size=(2, len(FREQUENCY)))
        values = found[one.speed][one.pair] * (1.0 + noise * (parts[0] + 1j * parts[1]))
        return replace(one, real=tuple(values.real.tolist()), imaginary=tuple(values.imag.tolist()))

    return replace(whole, responses=tuple(map(noisy, asked)))


def unknowns(off: float) -> dict[str, Unknown]:
    """Three diameters from ``off`` below and above, both dampings from a third and three times."""
    found = {
        f"spindle.shaft.sections.s{k}.outer_diameter": Unknown(
            0.6 * OUTER[k], 1.5 * OUTER[k], start=OUTER[k] * (1.0 + way * off)
        )
        for k, way in ((0, -1.0), (2, 1.0), (4, -1.0))
    }
    for name, size, begin in zip(("front", "rear"), DAMPING, (0.35, 3.0), strict=True):
        path = f"spindle.supports.{name}.damping."
        found[path + "yy"] = Unknown(
            size / 20.0, 20.0 * size, start=begin * size, also=(path + "zz",)
        )
    return found


def frequencies(of: Spindle) -> np.ndarray:
    """|λ|/2π at the speed that was not measured [Hz]."""
    scene = Scene(of, Conditions(), np.array([OTHER]), 1900.0)
    pole = scene.system(scene.with_motions(("bending",))[0]).pole[0]
    found = np.sort(np.abs(pole[pole.imag > 1.0])) / (2.0 * np.pi)
    return found[found < 1900.0]
