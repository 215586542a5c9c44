"""Modes and critical speeds in a few lines of text."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from itertools import product, zip_longest

import numpy as np

from rotordyn.analyses.campbell.result import CampbellResult
from rotordyn.modes.branches import MOTIONS
from rotordyn.modes.excitation import OF_UNBALANCE, Line, exciting
from rotordyn.modes.overdamped import OVERDAMPED
from rotordyn.results.described import Described
from rotordyn.results.display import RPM, number, percent, rounded_up
from rotordyn.results.frames import turning
from rotordyn.results.headline import Number
from rotordyn.results.text import from_to, over_speed, unbroken

WAYS = ("backward", "forward")
MODES = 5  # of the lowest bending modes, where variants are compared
NONE = 1e-9  # of a damping ratio: rounding
UNSTABLE = "unstable from"
MOST = 99  # modes of a kind that may be asked for
_WHIRL = {1: " fw", -1: " bw", 0: ""}
_TURN = {"forward": " fw", "backward": " bw", "mixed": " mixed"}


def summary(result: CampbellResult) -> list[str]:
    """Modes over speed, critical speeds on every line of excitation."""
    if not result.mode:
        return ["modes      none in the band asked for"]
    speeds = result.speed * RPM.factor
    rpm = f"{from_to(speeds, 0)} rpm"
    entries = [
        f"{result.mode[k]} {over_speed(result.frequency[:, k], result.speed)}"
        f"{_whirl(result.mode[k], result.whirl[-1, k])}"
        for k in np.flatnonzero(~result.mostly_overdamped)
    ]
    if result.mostly_overdamped.any():
        entries.append(f"{result.mostly_overdamped.sum()} more, overdamped")
    frame = " in the turning frame" if turning(result) else ""
    lines = [f"modes [Hz]{frame} {rpm}: " + "; ".join(map(unbroken, entries)), *_overdamped(result)]
    if len(result.speed) == 1:
        return lines
    for name, line in _lines(result):
        known = _margins(result, line)
        leaves = 60.0 * result.max_frequency / line.size
        beyond = (
            f"; {name} leaves the band at {number(leaves, 0)} rpm" if leaves < speeds[-1] else ""
        )
        none = f"none from {rpm.replace('→', 'to')}"
        if leaves < speeds[-1]:
            none = "none in the band asked for"
        else:
            none += _nearest(result, line)
        listed = ", ".join(known) or none
        lines.append(f"critical   {name}, margin to top speed: {listed}{beyond}")
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


def _lines(result: CampbellResult) -> Iterator[tuple[str, Line]]:
    """Lines that something which turns excites, and what they are called."""
    ratios = dict(zip(result.rotor, result.speed_ratio.tolist(), strict=True))
    every = exciting(ratios, result.engine_order.tolist())
    several = len({line.rotor for line in every}) > 1
    for line in every:
        yield f"{line.name} of {line.rotor}" if several else line.name, line


def _criticals(result: CampbellResult, line: Line) -> list[int]:
    """Numbers of the critical speeds that are excited on a line, ascending."""
    on_it = zip(result.critical_rotor, result.critical_order.tolist(), strict=True)
    excited = zip(on_it, result.critical_excited.tolist(), strict=True)
    wanted = (line.rotor, line.order), True
    return [k for k, each in enumerate(excited) if each == wanted and result.speed[-1] > 0.0]


def _margins(result: CampbellResult, line: Line) -> list[str]:
    """Critical speeds on a line in words, with their margins and damping ratios."""
    margin = (result.critical_speed / (result.speed[-1] or 1.0) - 1.0) * 100.0
    return [
        unbroken(
            f"{result.critical[k]}{_turn(result.critical[k], result.critical_whirl[k])} "
            f"{number(result.critical_speed[k] * RPM.factor, 0)} rpm ({margin[k]:+.0f} %"
            f"{_damped(float(result.critical_damping[k]))})"
        )
        for k in _criticals(result, line)
    ]


def _damped(ratio: float) -> str:
    """The damping ratio at a critical speed, which says how much it matters: of 0.2 and more hardly
    any peak is left."""
    if math.isnan(ratio):
        return ""
    return f", ζ {percent(ratio)}" if abs(ratio) > NONE else ", undamped"


def _turn(name: str, whirl: str) -> str:
    """Whirl at a critical speed, where the name of the mode does not say it."""
    return "" if "forward" in name or "backward" in name else _TURN.get(whirl, "")


def _nearest(result: CampbellResult, line: Line) -> str:
    """The mode nearest to a line at the top speed, of those that it may excite, and how far it is,
    in the fixed frame."""
    hertz = np.abs(result.pole[-1].imag) / (2.0 * math.pi)
    drawn = np.isfinite(hertz) & ~result.mostly_overdamped
    chosen = [k for k in np.flatnonzero(drawn) if line.excites(result.excited_by[k])]
    top = line.size * float(result.speed[-1]) / (2.0 * math.pi)
    if not chosen or top == 0.0:
        return ""
    near = min(chosen, key=lambda k: abs(float(hertz[k]) - top))
    frame = " in the fixed frame" if turning(result) else ""
    share = float(hertz[near]) / top
    ratio = f"{share:.2f}" if share < 100.0 else f"{share:.3g}"
    ratio += " × the line at the top speed"
    return f"; {result.mode[near]} is nearest, {ratio}{frame}"


def _whirl(name: str, whirl: float) -> str:
    """Whirl at the top speed, where the name does not say it."""
    known = "forward" in name or "backward" in name or not math.isfinite(whirl)
    return "" if known else _WHIRL[round(whirl)]


def accuracy(result: CampbellResult) -> list[str]:
    """The largest estimated error of a frequency."""
    return [f"frequencies within {rounded_up(result.largest_error)}"] if result.mode else []


def numbers(result: CampbellResult, _: Described) -> Iterator[Number]:
    """Pairs of the lowest bending modes, critical speeds of every line, by kind from below: names
    of modes change with the machine, where both planes are no longer alike."""
    yield from _lowest_bending(result)
    if len(result.speed) == 1:
        return
    for line_name, line in _lines(result):
        count: Counter[str] = Counter()
        for k in _criticals(result, line):
            count[kind := _critical_kind(result, line, k)] += 1
            rpm = float(result.critical_speed[k] * RPM.factor)
            yield Number(f"critical {line_name} {kind} ({count[kind]})", "rpm", rpm, digits=0)
    if math.isfinite(result.stability_threshold):
        rpm = float(result.stability_threshold * RPM.factor)
        yield Number(UNSTABLE, "rpm", rpm, digits=0)


def _critical_kind(result: CampbellResult, line: Line, critical: int) -> str:
    """What is numbered from below: the kind of motion; on the line of unbalance whirl the other way
    round is apart, which it hardly excites where both planes are nearly alike."""
    kind, whirl = result.critical_kind[critical], result.critical_whirl[critical]
    against = whirl in WAYS and whirl != line.way and line.order == OF_UNBALANCE
    return f"{kind} {whirl}" if against else kind


def lacking(result: CampbellResult) -> Iterator[Number]:
    """Bending modes, in pairs as those of the machine are, and critical speeds that it may have
    none of."""
    rpm = (result.speed * RPM.factor).tolist()
    paired = all(number.part for number in _lowest_bending(result))
    name, parts = ("bending pair", WAYS) if paired else ("bending", ("",))
    for k, part, at in product(range(MODES), parts, rpm):
        yield Number(f"{name} {k + 1}", "Hz", math.nan, part, at)
    if len(result.speed) == 1:
        return
    for (name, line), kind, k in product(_lines(result), MOTIONS, range(MOST)):
        yield Number(f"critical {name} {kind} ({k + 1})", "rpm", math.nan)
        if line.order == OF_UNBALANCE and kind == "bending":
            yield Number(f"critical {name} {kind} {line.other_way} ({k + 1})", "rpm", math.nan)
    yield Number(UNSTABLE, "rpm", math.nan)


def unlisted(_: CampbellResult) -> Iterator[tuple[str, list[str]]]:
    """Names that modes, and those at critical speeds, may have."""
    ways = product(MOTIONS, range(MOST), ("", *(f" {way}" for way in WAYS)))
    names = [f"{kind} {k + 1}{way}" for kind, k, way in ways]
    yield from (("mode", names), ("critical", names))


def _lowest_bending(result: CampbellResult) -> Iterator[Number]:
    rows = range(len(result.speed))
    for k, at in enumerate(zip(*(_bending(result, row)[:MODES] for row in rows), strict=True)):
        for row, modes in zip(rows, at, strict=True):
            for part, value, mode in modes:
                name = f"bending pair {k + 1}" if part else result.mode[mode]
                lost = np.isnan(result.frequency[row]).all()
                there = "none" if lost else _there(result, mode)
                rpm = float(result.speed[row] * RPM.factor)
                inner = 0 < row < rows[-1]
                yield Number(name, "Hz", value, part, rpm, absent=there, inner=inner)


def _there(result: CampbellResult, mode: int) -> str:
    """At which speeds there is a mode that some speeds lack."""
    rpm = result.speed[np.isfinite(result.frequency[:, mode])] * RPM.factor
    if not rpm.size:
        return "none"
    return f"({rpm[0]:.0f} to {rpm[-1]:.0f} rpm)" if rpm.size > 1 else f"({rpm[0]:.0f} rpm)"


def _bending(result: CampbellResult, row: int) -> list[list[tuple[str, float, int]]]:
    """Frequencies of the bending modes at a speed, and which they are: of each pair backward and
    forward, or one that has no partner."""
    chosen = [k for k in np.flatnonzero(~result.mostly_overdamped) if result.kind[k] == "bending"]
    values = list(zip(result.frequency[row, chosen].tolist(), map(int, chosen), strict=True))
    if not chosen:
        return []
    known = np.flatnonzero(np.isfinite(result.whirl).any(axis=1))
    whirl = result.whirl[known[-1], chosen]  # at rest twins need not turn either way
    backward, forward = (
        [value for value, way in zip(values, whirl, strict=True) if way == w] for w in (-1.0, 1.0)
    )
    if abs(len(backward) - len(forward)) > 1 or len(backward) + len(forward) < len(values):
        return [[("", *each)] for each in values]
    return [
        [(way, *one) for way, one in zip(WAYS, pair, strict=True) if one is not None]
        for pair in zip_longest(backward, forward)
    ]


def warnings(result: CampbellResult) -> list[str]:
    """Modes that change with the model, and modes that grow by themselves."""
    return [*_unconverged(result), *_unstable_modes(result), *_dropped(result)]


def _unconverged(result: CampbellResult) -> list[str]:
    if not result.unconverged:
        return []
    return [f"modes are less accurate than asked for: {result.unconverged}"]


def _dropped(result: CampbellResult) -> list[str]:
    """Modes that are counted but neither drawn nor listed, at all speeds or at some."""
    sentences = []
    if count := int(result.mostly_overdamped.sum()):
        sentences.append(
            f"{count} of {len(result.mode)} modes are overdamped (damping ratio above "
            f"{OVERDAMPED:g}) at most speeds and left out of figures and lists; results.nc has them"
        )
    solved = result.followed.any(axis=1)
    for k in np.flatnonzero(~result.mostly_overdamped):
        missing = np.flatnonzero(solved & ~result.followed[:, k])
        if not missing.size:
            continue
        speeds = from_to(result.speed[missing] * RPM.factor, 0)
        if result.kind[k] in ("axial", "torsion"):
            sentences.append(
                f"{result.mode[k]} lies above the band asked for at {speeds} rpm: raise "
                "max_frequency to see it there"
            )
        else:
            sentences.append(
                f"{result.mode[k]} is not followed at {missing.size} of the speeds, {speeds} rpm: "
                "no mode that swings has its shape there, in the band or somewhat above it"
            )
    return sentences


def _unstable_modes(result: CampbellResult) -> list[str]:
    sentences = []
    if 0.0 < result.stability_threshold < result.speed[-1]:
        onward = " on" if _lasting(result) else ""
        sentences.append(
            f"{result.first_to_grow} grows by itself from "
            f"{result.stability_threshold * RPM.factor:.0f} rpm{onward}"
        )
    for name, ratio, growing in zip(
        result.mode, result.damping_ratio.T, result.unstable.T, strict=True
    ):
        at = np.flatnonzero(growing)
        if at.size:
            sentences.append(
                f"{name} is unstable at {result.speed[at[0]] * RPM.factor:.0f} rpm"
                + (f" and {at.size - 1} more of the speeds" if at.size > 1 else "")
                + f" (damping ratio down to {percent(np.nanmin(ratio))})"
            )
    return sentences


def _lasting(result: CampbellResult) -> bool:
    """Whether what grows first does so at all speeds above, and is not stable again at some."""
    above = np.flatnonzero(result.speed >= result.stability_threshold)
    first = np.array([name == result.first_to_grow for name in result.mode])
    those = np.ix_(above, np.flatnonzero(first if first.any() else ~first))
    growing = np.atleast_1d(result.unstable[those].any(axis=1))
    known = np.isfinite(result.frequency[those]).any(axis=1)
    return bool(known.any() and growing[known].all())
