"""The MFW 2310 solved once, rigid and flexible, and the tables and rows of its results."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np

import rotordyn
from docs.generate.marked import table
from docs.generate.places import ROOT
from docs.generate.rows import Row
from rotordyn.analyses.campbell.known import bending_frequencies
from rotordyn.case.case import Case
from rotordyn.job import solve
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.shortening import strain_integral
from rotordyn.scene.conditions import Conditions

RPM = math.pi / 30.0
TOP = 24000.0 * RPM
KNOWN = "independent code, the same rotor"


@dataclass(frozen=True, slots=True)
class Flagship:
    """The case with its results, and those of a rotor that does not bend."""

    case: Case
    results: Mapping[str, Any]
    rigid: Mapping[str, Any]

    @property
    def spindle(self) -> Spindle:
        """The machine of the case."""
        if self.case.spindle is None:
            raise ValueError("the case has no spindle")
        return self.case.spindle

    def tangent(self, rpm: float, variant: str = "full", *, rigid: bool = False) -> float:
        """Radial stiffness at no load [N/µm]."""
        found = (self.rigid if rigid else self.results)["stiffness"]
        column = found.variant.index(variant)
        return float(np.interp(rpm * RPM, found.speed, found.tangent[:, column])) / 1e6

    def deviation(self, rpm: float, variant: str) -> float:
        """Deviation of a variant from the full tangent [%]."""
        return 100.0 * (self.tangent(rpm, variant) / self.tangent(rpm) - 1.0)

    def shift(self, station: str) -> float:
        """Shift of a point at top speed by centrifugal shortening [µm], from midway of a and b."""
        points = self.spindle.points
        strain = strain_integral(self.spindle.shaft, points["O1"], points[station])
        return strain * TOP**2 * 1e6


@cache
def flagship(*, fitted: bool = False) -> Flagship:
    """Solve the case unchanged, and with a rigid rotor at rest and at top speed.

    ``fitted``: with the VEX 60 that the rotor was fitted with; the independent values are for it.
    """
    case = _case(fitted=fitted)
    rigid = _at_both_ends(replace(case.conditions, rotor="rigid"), fitted=fitted)
    return Flagship(case, solve(case).results, rigid)


def under(reference: Reference) -> Mapping[str, Any]:
    """Results under the conditions of a known value of the machine."""
    case, results = flagship().case, flagship().results
    conditions = replace(case.conditions, **reference.conditions)
    return results if conditions == case.conditions else _at_both_ends(conditions)


@cache
def _at_both_ends(conditions: Conditions, *, fitted: bool = False) -> Mapping[str, Any]:
    """The case at rest and at top speed under other conditions, without receptances."""
    case = _case(fitted=fitted)
    asked = {name: spec for name, spec in case.analyses.items() if name != "frf"}
    return solve(replace(case, speeds=(0.0, TOP), conditions=conditions, analyses=asked)).results


@cache
def _case(*, fitted: bool = False) -> Case:
    case = rotordyn.load(ROOT / "cases" / "mfw2310.yaml")
    if not fitted:
        return case
    old = rotordyn.model("bearings", "vex60_fitted")
    balls = {key: getattr(old, key) for key in ("ball_diameter", "balls")}
    where = "spindle.bearings.{}.model.{}"
    return case.vary({where.format(n, key): v for n in "de" for key, v in balls.items()})


def bearing_table() -> str:
    """The flagship with the VEX 60 that its rotor was fitted with, and with that of the maker."""
    old, new = flagship(fitted=True), flagship()

    def each(what: str, value: Callable[[Flagship], str]) -> tuple[str, str, str]:
        return what, value(old), value(new)

    def modes(known: Flagship, speed: float) -> str:
        return ", ".join(f"{f:.0f}" for f in _modes(known.results, speed)[:4])

    def stiffness(known: Flagship) -> str:
        return ", ".join(f"{known.tangent(rpm):.1f}" for rpm in (0, 12000, 18000, 24000))

    def preloads(known: Flagship) -> str:
        found = known.results["preload"]
        sleeves = [found.bearing.index(b) for s in known.spindle.sleeves for b in s.bearings]
        return f"{found.axial_load[-1, sleeves].sum():.0f}"

    rows = [
        each("bending modes at rest [Hz]", lambda known: modes(known, 0.0)),
        each("bending modes at 24 000 rpm, mean of both whirls [Hz]", lambda k: modes(k, TOP)),
        each("radial stiffness at Oc2 at 0, 12, 18, 24 krpm [N/µm]", stiffness),
        each("sum of preloads, 24 000 rpm [N]", preloads),
    ]
    return table(("", "21 balls of 9.525 mm (fitted)", "25 balls of 7.938 mm (maker)"), rows)


def rest_rows() -> list[Row]:
    """At rest, where results do not depend on the hypotheses of the bearing model."""
    known = flagship(fitted=True)
    return [
        _row("rigid rotor, radial modes [Hz]", _modes(known.rigid, 0.0), (1083.0, 1523.0)),
        _row("rigid rotor, stiffness at Oc2 [N/µm]", (known.tangent(0, rigid=True),), (458.0,)),
        _row("bending modes [Hz]", _modes(known.results, 0.0)[:4], (903.4, 1349.0, 1587.0, 2859.0)),
        _row("stiffness at Oc2, full K [N/µm]", (known.tangent(0),), (142.7,)),
        _row(
            "diagonal K, deviation of the stiffness [%]",
            (known.deviation(0, "diagonal"),),
            (-14.6,),
        ),
        _row("torsion, free-free [Hz]", (_torsion(known.results),), (2974.0,)),
    ]


def speed_rows() -> list[Row]:
    """At speed, with the physical sign of the gyroscopic moment."""
    known = flagship(fitted=True)
    preload = known.results["preload"]
    sleeves = [preload.bearing.index(b) for s in known.spindle.sleeves for b in s.bearings]
    total = float(preload.axial_load[-1, sleeves].sum())
    rear = 1e6 * float(preload.position[-1, preload.body.index("rear")])
    stiff = tuple(known.tangent(rpm) for rpm in (6000, 12000, 18000, 24000))
    variants = tuple(known.deviation(24000, v) for v in ("diagonal", "constant_preload"))
    return [
        _row(
            "stiffness at Oc2 at 6, 12, 18, 24 krpm [N/µm]", stiff, (138.0, 106.8, 83.3, 88.4), 0.01
        ),
        _row(
            "24 krpm: sum of preloads [N], rear sleeve [µm]", (total, rear), (2550.0, -115.2), 0.01
        ),
        _row(
            "24 krpm, rigid rotor: stiffness at Oc2 [N/µm]",
            (known.tangent(24000, rigid=True),),
            (166.3,),
            0.01,
        ),
        _row(
            "24 krpm, rigid rotor: radial modes, mean of both whirls [Hz]",
            _modes(known.rigid, TOP),
            (475.2, 946.7),
            0.01,
        ),
        _row(
            "24 krpm: diagonal K, constant preload, deviation of the stiffness [%]",
            variants,
            (-11.95, -63.4),
            0.01,
        ),
        _row(
            "24 krpm, shift by shortening at d/e, c, nose [µm]",
            tuple(known.shift(point) for point in ("O3", "O2", "nose_face")),
            (-29.4, -3.1, 2.9),
            0.02,
        ),
    ]


def _row(
    what: str, found: tuple[float, ...], expected: tuple[float, ...], allowed: float = 0.005
) -> Row:
    return Row(f"MFW 2310, {what}", found, allowed, KNOWN, expected)


def _modes(results: Mapping[str, Any], speed: float) -> tuple[float, ...]:
    """Bending frequencies [Hz], mean of forward and backward whirl."""
    found = results["campbell"]
    if speed == 0.0:
        return tuple(float(f) for f in bending_frequencies(found, 0.0))
    at = int(np.argmin(np.abs(found.speed - speed)))
    bending = np.array([kind == "bending" for kind in found.kind])
    both = [np.sort(found.frequency[at, bending & (found.whirl[at] == w)]) for w in (-1.0, 1.0)]
    return tuple((float(low) + float(high)) / 2.0 for low, high in zip(*both, strict=False))


def _torsion(results: Mapping[str, Any]) -> float:
    found = results["campbell"]
    return float(found.frequency[0, found.kind.index("torsion")])
