"""Summary of a run as plain text, in lines of 100 columns."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from bearings.bearing import BallBearing
from bearings.kinds import DEFAULT, kind_of
from rotordyn.analyses.known import matches
from rotordyn.analyses.registry import analysis, in_order
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.seat import BearingSeat
from rotordyn.machine.sleeve import Sleeve
from rotordyn.machine.spindle import Spindle
from rotordyn.report.known import known_lines
from rotordyn.report.rotors import rotor_lines
from rotordyn.results.described import Described
from rotordyn.results.text import opening, unbroken, wrapped


def called(case: Described) -> str:
    """Name and title of a case; the title alone where it begins with the name."""
    if case.title.startswith(case.name):
        return case.title
    return f"{case.name}: {case.title}" if case.title else case.name


def summary(
    case: Described,
    results: Mapping[str, Any],
    warnings: Sequence[str] = (),
    notes: Sequence[str] = (),
    unsolved: Sequence[str] = (),
) -> str:
    """The summary; ``warnings`` come first, ``unsolved`` and ``notes`` below the title."""
    lines = _machine(case.spindle) if case.spindle else []
    if case.bearing is not None:
        lines.append(_single(case.bearing))
    names = in_order(results)
    if accuracies := [word for name in names for word in analysis(name).accuracy(results[name])]:
        lines.append(f"accuracy   estimated errors by refinement: {', '.join(accuracies)}")
    lines += [line for name in names for line in analysis(name).summary(results[name])]
    top = opening(warnings, called(case), notes, unsolved)
    text = [*top, *(part for line in lines for part in wrapped(line))]
    matched = matches(case.known, results, case.spindle)
    return "\n".join([*text, *known_lines(matched)])


def _machine(spindle: Spindle) -> list[str]:
    lines = rotor_lines(spindle)
    if spindle.seats:
        rows = ", ".join(unbroken(f"{s.name}{_which(s)} at {s.x * 1e3:.1f}") for s in spindle.seats)
        pairs = ", ".join(f"{a} and {b} in {word}" for a, b, word in spindle.pairings)
        lines.append(f"bearings   [mm] {rows}{_signs(spindle)}")
        if pairs:
            lines[-1] += f"; {pairs}"
        lines[-1] += f"; balls of {_balls(spindle)}"
    lines += [_sleeve(sleeve) for sleeve in spindle.sleeves]
    return lines if spindle.drawbar is None else [*lines, _drawbar(spindle.drawbar)]


def _single(bearing: BallBearing) -> str:
    kind = kind_of(bearing).replace("_", " ")
    balls = f"{bearing.balls} balls of {bearing.ball_material.name}"
    size = f"{bearing.ball_diameter * 1e3:.6g} mm on {bearing.pitch_diameter * 1e3:.6g} mm"
    angle = f"free contact angle {math.degrees(bearing.free_angle):.3g}°"
    estimated = " (estimate)" if bearing.estimated else ""
    return f"bearing    {kind}{estimated}: {balls}, {size}, {angle}"


def _which(seat: BearingSeat) -> str:
    """Direction of thrust of a seat, unless it takes both; its kind, unless that is the default."""
    kind = kind_of(seat.bearing)
    text = "" if kind == DEFAULT else f" {kind.replace('_', ' ')}"
    text += " (estimate)" if seat.bearing.estimated else ""
    if seat.bearing.both_ways:
        return text
    return f"{text} {'+' if seat.thrust > 0 else '−'}"


def _balls(spindle: Spindle) -> str:
    """The material of the balls, by bearings where it differs among them."""
    groups: dict[str, list[str]] = {}
    for seat in spindle.seats:
        groups.setdefault(seat.bearing.ball_material.name, []).append(seat.name)
    if len(groups) == 1:
        return next(iter(groups))
    return ", ".join(unbroken(f"{name} in {', '.join(seats)}") for name, seats in groups.items())


def _signs(spindle: Spindle) -> str:
    thrusts = [seat.thrust for seat in spindle.seats if not seat.bearing.both_ways]
    if not thrusts:
        return ""
    sign = "+" if max(thrusts) > 0 else "−"
    return f" ({sign}: carries thrust towards {sign}x)"


def _sleeve(sleeve: Sleeve) -> str:
    stop = f", stop after {sleeve.stop_travel * 1e6:g} µm"
    return (
        f"sleeve     {sleeve.name} with {', '.join(sleeve.bearings)}: {sleeve.spring.words}, "
        f"{sleeve.spring.rate}{stop if math.isfinite(sleeve.stop_travel) else ''}{_guide(sleeve)}"
    )


def _guide(sleeve: Sleeve) -> str:
    """Ball guide of a sleeve; empty where it has none."""
    if sleeve.ball_guide is None:
        return ""
    law = sleeve.ball_guide.law
    limit = law.linear_range()
    return (
        f"; ball guide {law.stiffness / 1e6:.4g} N/µm, within 1 % up to {limit * 1e6:.2g} µm or "
        f"{float(law.force(limit)):.3g} N"
    )


def _drawbar(bar: Drawbar) -> str:
    ends = f"from {bar.start * 1e3:.1f} to {bar.end * 1e3:.1f} mm"
    at = ", ".join(f"{x * 1e3:.1f}" for x in bar.contacts[1:-1])
    guides = f"guided at {at} mm" if at else "not guided" if bar.contacts else "guided everywhere"
    return f"drawbar    {bar.force:g} N {ends}, {guides}"
