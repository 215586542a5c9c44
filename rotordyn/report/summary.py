"""One screen of plain text about a run: at most 40 lines of 100 columns."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any, Protocol

import numpy as np

from bearings.kinds import DEFAULT, kind_of
from rotordyn.analyses.bearing.summary import bearing_lines
from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.analyses.control.result import ControlResult
from rotordyn.analyses.control.solve import BOUNDARY_WORDS, fit_words
from rotordyn.analyses.frf.summary import measured_lines
from rotordyn.analyses.known import matches
from rotordyn.analyses.preload.result import PreloadResult
from rotordyn.analyses.section_forces.summary import section_force_lines
from rotordyn.analyses.stiffness.result import StiffnessResult
from rotordyn.analyses.unbalance.summary import unbalance_lines
from rotordyn.machine.drawbar import Drawbar
from rotordyn.machine.inertia import rotor_inertia
from rotordyn.machine.reference import Reference
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import SPINDLE, BearingSeat, Sleeve
from rotordyn.modes.excitation import Line, exciting
from rotordyn.modes.overdamped import OVERDAMPED
from rotordyn.report.accuracy import accuracy_words
from rotordyn.report.known import known_lines
from rotordyn.results.display import RPM, STIFFNESS, number
from rotordyn.results.frames import turning
from rotordyn.results.text import from_to, opening, unbroken, wrapped

HEIGHT = 40
_WHIRL = {1: " fw", -1: " bw", 0: ""}
_TURN = {"forward": " fw", "backward": " bw", "mixed": " mixed"}


class Described(Protocol):
    """What the summary needs to know of a case."""

    @property
    def name(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def spindle(self) -> Spindle | None: ...
    @property
    def known(self) -> Sequence[Reference]: ...


def called(case: Described) -> str:
    """Name and title of a case."""
    return f"{case.name}: {case.title}" if case.title else case.name


def summary(
    case: Described,
    results: Mapping[str, Any],
    warnings: Sequence[str] = (),
    notes: Sequence[str] = (),
) -> str:
    """The summary; ``warnings`` come first, ``notes`` below the title."""
    lines = _machine(case.spindle) if case.spindle else []
    if "campbell" in results:
        lines += _modes(results["campbell"])
    if words := accuracy_words(results):
        lines.append(f"accuracy   estimated errors by refinement: {', '.join(words)}")
    if "frf" in results:
        lines += measured_lines(results["frf"])
    if "preload" in results:
        lines += _preload(results["preload"])
    if "bearing" in results:
        lines += bearing_lines(results["bearing"])
    if "control" in results:
        lines += _control(results["control"])
    if "stiffness" in results:
        lines += _stiffness(results["stiffness"])
    if "section_forces" in results:
        lines += section_force_lines(results["section_forces"])
    if "unbalance" in results:
        lines += unbalance_lines(results["unbalance"])
    top = opening(warnings, called(case), notes)
    text = [*top, *(part for line in lines for part in wrapped(line))]
    found = matches(case.known, results, case.spindle)
    return "\n".join(_screen(text + known_lines(found, HEIGHT - len(text))))


def _screen(lines: list[str]) -> list[str]:
    """At most ``HEIGHT`` lines; where some are left out, the last one says how many."""
    if len(lines) <= HEIGHT:
        return lines
    kept = lines[: HEIGHT - 1]
    return [*kept, f"… and {len(lines) - len(kept)} more lines: see the tables and results.nc"]


def _machine(spindle: Spindle) -> list[str]:
    lines = []
    for name, ratio in spindle.ratios.items():
        m = rotor_inertia(spindle.part(name))
        turns = f"{name}, {ratio:g} × the speed, " if name != SPINDLE else ""
        lines.append(
            f"rotor      {turns}{_mass(m.mass)}, centre of gravity at {m.centre * 1e3:.1f} mm, "
            f"inertia polar {m.polar:.4g}, diametral {m.diametral:.4g} kg m²"
        )
    if spindle.seats:
        rows = ", ".join(unbroken(f"{s.name}{_which(s)} at {s.x * 1e3:.1f}") for s in spindle.seats)
        pairs = ", ".join(f"{a} and {b} in {word}" for a, b, word in spindle.pairings)
        lines.append(f"bearings   [mm] {rows}{_signs(spindle)}")
        if pairs:
            lines[-1] += f"; {pairs}"
    lines += [_sleeve(sleeve) for sleeve in spindle.sleeves]
    return lines if spindle.drawbar is None else [*lines, _drawbar(spindle.drawbar)]


def _which(seat: BearingSeat) -> str:
    """The way it takes thrust, where that is one; its kind, where that is not the usual one."""
    kind = kind_of(seat.bearing)
    named = "" if kind == DEFAULT else f" {kind.replace('_', ' ')}"
    if seat.bearing.both_ways:
        return named
    return f"{named} {'+' if seat.thrust > 0 else '−'}"


def _signs(spindle: Spindle) -> str:
    thrusts = [seat.thrust for seat in spindle.seats if not seat.bearing.both_ways]
    if not thrusts:
        return ""
    sign = "+" if max(thrusts) > 0 else "−"
    return f" ({sign}: a push towards {sign}x loads it)"


def _sleeve(sleeve: Sleeve) -> str:
    spring = sleeve.spring
    stiff = f"{spring.stiffness / 1e6:g} N/µm" if math.isfinite(spring.stiffness) else "rigid"
    stop = f", stop after {sleeve.stop_travel * 1e6:g} µm"
    return (
        f"sleeve     {sleeve.name} with {', '.join(sleeve.bearings)}: {spring.preload:g} N, "
        f"{stiff}{stop if math.isfinite(sleeve.stop_travel) else ''}"
    )


def _drawbar(bar: Drawbar) -> str:
    ends = f"from {bar.start * 1e3:.1f} to {bar.end * 1e3:.1f} mm"
    at = ", ".join(f"{x * 1e3:.1f}" for x in bar.contacts[1:-1])
    guides = f"guided at {at} mm" if at else "not guided" if bar.contacts else "guided everywhere"
    return f"drawbar    {bar.force:g} N {ends}, {guides}"


def _mass(mass: float) -> str:
    return f"{mass:.2f} kg" if mass >= 0.1 else f"{mass * 1e3:.3g} g"


def _modes(result: CampbellResult) -> list[str]:
    if not result.mode:
        return ["modes      none in the band asked for"]
    speeds = result.speed * RPM.factor
    rpm = f"{from_to(speeds, 0)} rpm"
    entries = [
        f"{result.mode[k]} {from_to(result.frequency[:, k])}"
        f"{_whirl(result.mode[k], result.whirl[-1, k])}"
        for k in np.flatnonzero(~result.mostly_overdamped)
    ]
    if result.mostly_overdamped.any():
        entries.append(f"{result.mostly_overdamped.sum()} more, overdamped")
    frame = " in the turning frame" if turning(result) else ""
    lines = [f"modes [Hz]{frame} {rpm}: " + "; ".join(map(unbroken, entries)), *_overdamped(result)]
    if len(result.speed) == 1:
        return lines
    ratios = dict(zip(result.rotor, result.speed_ratio.tolist(), strict=True))
    every = exciting(ratios, result.engine_order.tolist())
    several = len({line.rotor for line in every}) > 1
    for line in every:
        known = _criticals(result, line)
        of = f" of {line.rotor}" if several else ""
        name, leaves = f"{line.name}{of}", 60.0 * result.max_frequency / line.size
        beyond = (
            f"; {name} leaves the band at {number(leaves, 0)} rpm" if leaves < speeds[-1] else ""
        )
        none = f"none from {rpm.replace('→', 'to')}"
        if leaves < speeds[-1]:
            none = "none in the band asked for"
        elif (line.rotor, line.order) == (SPINDLE, 1.0):
            none += _nearest(result)
        told = ", ".join(known) or none
        lines.append(f"critical   {name}, margin to top speed: {told}{beyond}")
    return lines


def _overdamped(result: CampbellResult) -> list[str]:
    """Modes that hardly swing at some of the speeds."""
    words = []
    for k in np.flatnonzero(result.overdamped.any(axis=0) & ~result.mostly_overdamped):
        at = np.flatnonzero(result.overdamped[:, k])
        speeds = from_to(result.speed[at] * RPM.factor, 0)
        words.append(unbroken(f"{result.mode[k]} {speeds} rpm"))
    if not words:
        return []
    return [f"           overdamped, with a damping ratio above {OVERDAMPED:g}: {'; '.join(words)}"]


def _criticals(result: CampbellResult, line: Line) -> list[str]:
    """Critical speeds on a line that something which turns excites."""
    last = result.speed[-1]
    return [
        unbroken(
            f"{name}{_turn(name, whirl)} {number(speed * RPM.factor, 0)} rpm "
            f"({(speed / last - 1.0) * 100.0:+.0f} %)"
        )
        for name, whirl, speed, rotor, own, excited in zip(
            result.critical,
            result.critical_whirl,
            result.critical_speed,
            result.critical_rotor,
            result.critical_order,
            result.critical_excited,
            strict=True,
        )
        if (rotor, own) == (line.rotor, line.order) and excited and last > 0.0
    ]


def _turn(name: str, whirl: str) -> str:
    """Whirl at a critical speed, where the name of the mode does not say it."""
    return "" if "forward" in name or "backward" in name else _TURN.get(whirl, "")


def _nearest(result: CampbellResult) -> str:
    """The bending mode nearest to the 1× line at the top speed, and how far it is."""
    hertz = result.speed[-1] / (2.0 * math.pi)
    chosen = [
        k
        for k in np.flatnonzero(~result.mostly_overdamped)
        if result.kind[k] == "bending" and result.whirl[-1, k] >= 0.0 and hertz > 0.0
    ]
    if not chosen:
        return ""
    if turning(result):  # the 1× line stands still there, at 0 Hz
        near = min(chosen, key=lambda k: float(result.frequency[-1, k]))
        return f"; {result.mode[near]} is nearest, {number(result.frequency[-1, near], 0)} Hz away"
    near = min(chosen, key=lambda k: abs(float(result.frequency[-1, k]) - hertz))
    ratio = float(result.frequency[-1, near]) / hertz
    return f"; {result.mode[near]} is nearest, {ratio:.2f} × the top speed"


def _whirl(name: str, whirl: float) -> str:
    """Whirl at the top speed, where the name does not say it."""
    known = "forward" in name or "backward" in name or not math.isfinite(whirl)
    return "" if known else _WHIRL[round(whirl)]


def _control(result: ControlResult) -> list[str]:
    """Which race controls under heavy load, both boundaries with their fits, or why none."""
    weight = result.resting_weight
    heavy = "inner race" if weight > 1.0 else "outer race" if weight < 1.0 else "neither race"
    radial = f", radial {result.radial:g} of it" if result.radial else ""
    lines = [
        f"control    under heavy load: {heavy} (C = {weight:.3f}); boundaries, axial load{radial}"
    ]
    fits = fit_words(result)
    for place, (race, word) in enumerate(BOUNDARY_WORDS.items()):
        load, absent = result.boundary_load[place], result.boundary_absence[place]
        known = np.flatnonzero(np.isfinite(load))
        if known.size:
            ends = " → ".join(_at_speed(load[k], result.speed[k]) for k in known[[0, -1]])
            lines.append(f"           {word} {ends}")
        if race in fits:
            lines.append(f"           fit: {fits[race]}")
        lines += [
            f"           {sentence}, at {count} of {len(load)} speeds"
            for sentence, count in Counter(absent[absent != ""].tolist()).items()
        ]
    several = int((result.changes > 1).any(axis=0).sum())
    if several:
        lines.append(f"           at {several} speeds control changes more than once; highest told")
    return lines


def _at_speed(load: float, speed: float) -> str:
    return f"{load:.0f} N at {speed * RPM.factor:.0f} rpm"


def _preload(result: PreloadResult) -> list[str]:
    loads = ", ".join(
        unbroken(f"{name} {from_to(load, 0)}")
        for name, load in zip(result.bearing, result.axial_load.T, strict=True)
    )
    lines = [f"preload    [N] {loads}"]
    for name, speed in zip(result.sleeve, result.stop_speed, strict=True):
        when = f"reached at {speed * RPM.factor:.0f} rpm" if math.isfinite(speed) else "not reached"
        lines.append(f"stop       {name}: {when}")
    return lines


def _stiffness(result: StiffnessResult) -> list[str]:
    values = ", ".join(
        unbroken(f"{name.replace('_', ' ')} {from_to(values)}")
        for name, values in zip(result.variant, result.tangent.T * STIFFNESS.factor, strict=True)
    )
    return [f"stiffness  radial, tangent [N/µm] {values}"]
