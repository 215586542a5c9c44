"""Modes and critical speeds as a few lines of text."""

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
from rotordyn.results.severity import Severity, of_severity
from rotordyn.results.text import from_to, over_speed, unbroken

WAYS = ("backward", "forward")
MODES = 5  # of the lowest bending modes, where variants are compared
NONE = 1e-9  # of a damping ratio: rounding
UNSTABLE = "unstable from"
MOST = 99  # modes of a kind that may be listed
_WHIRL = {1: " fw", -1: " bw", 0: ""}
_TURN = {"forward": " fw", "backward": " bw", "mixed": " mixed"}


def summary(result: CampbellResult) -> list[str]:
    """Return lines on modes over speed, and critical speeds on every line of excitation."""
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
    frame = " in the rotating frame" if turning(result) else ""
    lines = [f"modes [Hz]{frame} {rpm}: " + "; ".join(map(unbroken, entries)), *_overdamped(result)]
    if len(result.speed) == 1:
        return lines
    for name, line in _lines(result):
        margins = _margins(result, line)
        end_rpm = 60.0 * result.max_frequency / line.size
        beyond = (
            f"; {name} leaves the band at {number(end_rpm, 0)} rpm" if end_rpm < speeds[-1] else ""
        )
        none = f"none from {rpm.replace('→', 'to')}"
        if end_rpm < speeds[-1]:
            none = "none in the band asked for"
        else:
            none += _nearest(result, line)
        listed = ", ".join(margins) or none
        lines.append(f"critical   {name}, margin to top speed: {listed}{beyond}")
    return lines


def _overdamped(result: CampbellResult) -> list[str]:
    """Return a line on modes that are overdamped at some of the speeds."""
    texts = []
    for k in np.flatnonzero(result.overdamped.any(axis=0) & ~result.mostly_overdamped):
        rows = np.flatnonzero(result.overdamped[:, k])
        speeds = from_to(result.speed[rows] * RPM.factor, 0)
        texts.append(unbroken(f"{result.mode[k]} {speeds} rpm"))
    if not texts:
        return []
    return [f"           overdamped, with a damping ratio above {OVERDAMPED:g}: {'; '.join(texts)}"]


def _lines(result: CampbellResult) -> Iterator[tuple[str, Line]]:
    """Yield names and lines of excitation by what rotates."""
    ratios = dict(zip(result.rotor, result.speed_ratio.tolist(), strict=True))
    lines = exciting(ratios, result.engine_order.tolist())
    several = len({line.rotor for line in lines}) > 1
    for line in lines:
        yield f"{line.name} of {line.rotor}" if several else line.name, line


def _criticals(result: CampbellResult, line: Line) -> list[int]:
    """Return the numbers of the critical speeds that are excited on a line, ascending."""
    on_it = zip(result.critical_rotor, result.critical_order.tolist(), strict=True)
    excited = zip(on_it, result.critical_excited.tolist(), strict=True)
    wanted = (line.rotor, line.order), True
    return [k for k, entry in enumerate(excited) if entry == wanted and result.speed[-1] > 0.0]


def _margins(result: CampbellResult, line: Line) -> list[str]:
    """Return critical speeds on a line as text, with their margins and damping ratios."""
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
    """Return the damping ratio at a critical speed as text; it says how much the speed matters:
    from 0.2 on hardly any peak is left."""
    if math.isnan(ratio):
        return ""
    return f", ζ {percent(ratio)}" if abs(ratio) > NONE else ", undamped"


def _turn(name: str, whirl: str) -> str:
    """Return the whirl at a critical speed as text, where the name of the mode lacks it."""
    return "" if "forward" in name or "backward" in name else _TURN.get(whirl, "")


def _nearest(result: CampbellResult, line: Line) -> str:
    """Name the mode nearest to a line at the top speed, of those that it may excite, and their
    ratio, in the fixed frame."""
    hertz = np.abs(result.pole[-1].imag) / (2.0 * math.pi)
    drawn = np.isfinite(hertz) & ~result.mostly_overdamped
    chosen = [k for k in np.flatnonzero(drawn) if line.excites(result.excited_by[k])]
    top = line.size * float(result.speed[-1]) / (2.0 * math.pi)
    if not chosen or top == 0.0:
        return ""
    nearest = min(chosen, key=lambda k: abs(float(hertz[k]) - top))
    frame = " in the fixed frame" if turning(result) else ""
    share = float(hertz[nearest]) / top
    ratio = f"{share:.2f}" if share < 100.0 else f"{share:.3g}"
    ratio += " × the line at the top speed"
    return f"; {result.mode[nearest]} is nearest, {ratio}{frame}"


def _whirl(name: str, whirl: float) -> str:
    """Return the whirl at the top speed as text, where the name lacks it."""
    needless = "forward" in name or "backward" in name or not math.isfinite(whirl)
    return "" if needless else _WHIRL[round(whirl)]


def accuracy(result: CampbellResult) -> list[str]:
    """Return the largest estimated error of a frequency as a line."""
    return [f"frequencies within {rounded_up(result.largest_error)}"] if result.mode else []


def numbers(result: CampbellResult, _: Described) -> Iterator[Number]:
    """Yield pairs of the lowest bending modes and critical speeds of every line, numbered by kind
    from below: names of modes change with the machine, as where both planes become unequal."""
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
        if result.threshold_is_bound:
            text = f"≤ {number(rpm, 0)}"
            yield Number(UNSTABLE, "rpm", math.nan, digits=0, absent=text, bound=rpm)
        else:
            yield Number(UNSTABLE, "rpm", rpm, digits=0)


def _critical_kind(result: CampbellResult, line: Line, critical: int) -> str:
    """Return the kind by which critical speeds are numbered: that of motion; on the line of
    unbalance apart for opposite whirl, hardly excited where both planes are nearly equal."""
    kind, whirl = result.critical_kind[critical], result.critical_whirl[critical]
    against = whirl in WAYS and whirl != line.way and line.order == OF_UNBALANCE
    return f"{kind} {whirl}" if against else kind


def lacking(result: CampbellResult) -> Iterator[Number]:
    """Yield, without value, bending modes, in pairs as those of the machine, and critical speeds
    that it may lack."""
    rpm = (result.speed * RPM.factor).tolist()
    paired = all(number.part for number in _lowest_bending(result))
    name, parts = ("bending pair", WAYS) if paired else ("bending", ("",))
    for k, part, speed in product(range(MODES), parts, rpm):
        yield Number(f"{name} {k + 1}", "Hz", math.nan, part, speed)
    if len(result.speed) == 1:
        return
    for (name, line), kind, k in product(_lines(result), MOTIONS, range(MOST)):
        yield Number(f"critical {name} {kind} ({k + 1})", "rpm", math.nan)
        if line.order == OF_UNBALANCE and kind == "bending":
            yield Number(f"critical {name} {kind} {line.other_way} ({k + 1})", "rpm", math.nan)
    yield Number(UNSTABLE, "rpm", math.nan)


def missing_entries(_: CampbellResult) -> Iterator[tuple[str, list[str]]]:
    """Yield all names that modes, and modes at critical speeds, may have."""
    combinations = product(MOTIONS, range(MOST), ("", *(f" {whirl}" for whirl in WAYS)))
    names = [f"{kind} {k + 1}{whirl}" for kind, k, whirl in combinations]
    yield from (("mode", names), ("critical", names))


def _lowest_bending(result: CampbellResult) -> Iterator[Number]:
    rows = range(len(result.speed))
    for k, at in enumerate(zip(*(_bending(result, row)[:MODES] for row in rows), strict=True)):
        for row, modes in zip(rows, at, strict=True):
            for part, value, mode in modes:
                name = f"bending pair {k + 1}" if part else result.mode[mode]
                missing = np.isnan(result.frequency[row]).all()
                absent_text = "none" if missing else _speeds_of(result, mode)
                rpm = float(result.speed[row] * RPM.factor)
                inner = 0 < row < rows[-1]
                yield Number(name, "Hz", value, part, rpm, absent=absent_text, inner=inner)


def _speeds_of(result: CampbellResult, mode: int) -> str:
    """Say at which speeds a mode exists that is missing at some."""
    rpm = result.speed[np.isfinite(result.frequency[:, mode])] * RPM.factor
    if not rpm.size:
        return "none"
    return f"({rpm[0]:.0f} to {rpm[-1]:.0f} rpm)" if rpm.size > 1 else f"({rpm[0]:.0f} rpm)"


def _bending(result: CampbellResult, row: int) -> list[list[tuple[str, float, int]]]:
    """Return whirl, frequency and number of the bending modes at a speed: of each pair backward and
    forward, or one without partner."""
    chosen = [k for k in np.flatnonzero(~result.mostly_overdamped) if result.kind[k] == "bending"]
    values = list(zip(result.frequency[row, chosen].tolist(), map(int, chosen), strict=True))
    if not chosen:
        return []
    rows = np.flatnonzero(np.isfinite(result.whirl).any(axis=1))
    turns = result.whirl[rows[-1], chosen]  # at rest the modes of a pair need not whirl
    backward, forward = (
        [value for value, turn in zip(values, turns, strict=True) if turn == w] for w in (-1.0, 1.0)
    )
    if abs(len(backward) - len(forward)) > 1 or len(backward) + len(forward) < len(values):
        return [[("", *each)] for each in values]
    return [
        [(turn, *mode) for turn, mode in zip(WAYS, pair, strict=True) if mode is not None]
        for pair in zip_longest(backward, forward)
    ]


def warnings(result: CampbellResult) -> list[str]:
    """Return warnings about modes that change with the model, unstable ones, and omitted ones."""
    return [*_unconverged(result), *_unstable_modes(result), *_omitted_modes(result)]


@of_severity(Severity.INVALID)
def _unconverged(result: CampbellResult) -> list[str]:
    if not result.unconverged:
        return []
    return [f"modes are less accurate than asked for: {result.unconverged}"]


def _omitted_modes(result: CampbellResult) -> list[str]:
    """Return sentences on modes that are neither drawn nor listed, at all speeds or at some."""
    sentences = []
    if count := int(result.mostly_overdamped.sum()):
        sentences.append(
            f"{count} of {len(result.mode)} modes are overdamped (damping ratio above "
            f"{OVERDAMPED:g}) at most speeds and omitted from figures and lists; results.nc has "
            "them"
        )
    solved = result.followed.any(axis=1)
    for k in np.flatnonzero(~result.mostly_overdamped):
        missing = np.flatnonzero(solved & ~result.followed[:, k])
        if not missing.size:
            continue
        speeds = from_to(result.speed[missing] * RPM.factor, 0)
        if result.kind[k] in ("axial", "torsion"):
            sentences.append(
                f"{result.mode[k]} is above max_frequency at {speeds} rpm: raise it to include the "
                "mode there"
            )
        else:
            sentences.append(
                f"{result.mode[k]} is not followed at {missing.size} of the speeds, {speeds} rpm: "
                "there no oscillating mode in the band, or slightly above it, has its shape"
            )
    return sentences


@of_severity(Severity.NO_STATE)
def _unstable_modes(result: CampbellResult) -> list[str]:
    """Return a sentence for each unstable mode, that of the threshold with its speed."""
    grown = {}
    for name, ratio, growing in zip(
        result.mode, result.damping_ratio.T, result.unstable.T, strict=True
    ):
        rows = np.flatnonzero(growing)
        if rows.size:
            grown[name] = rows, f"(damping ratio down to {percent(np.nanmin(ratio))})"
    sentences = []
    if result.threshold_is_bound or 0.0 < result.stability_threshold < result.speed[-1]:
        rpm = f"{result.stability_threshold * RPM.factor:.0f} rpm"
        onward = " on" if _stays_unstable(result) else ""
        speeds = ""
        if result.unstable_mode in grown:
            rows, lowest = grown.pop(result.unstable_mode)
            first = "" if onward else f", first {result.speed[rows[0]] * RPM.factor:.0f} rpm"
            speeds = f", at {len(rows)} of {len(result.speed)} speeds{first} {lowest}"
        sentences.append(
            f"{result.unstable_mode} is unstable at {rpm} already, the lowest speed at which "
            f"it is solved{speeds}: add lower speeds to find its threshold"
            if result.threshold_is_bound
            else f"{result.unstable_mode} is unstable from {rpm}{onward}{speeds}"
        )
    for name, (rows, lowest) in grown.items():
        more = f" and {rows.size - 1} more of the speeds" if rows.size > 1 else ""
        first = f"{result.speed[rows[0]] * RPM.factor:.0f} rpm"
        sentences.append(f"{name} is unstable at {first}{more} {lowest}")
    return sentences


def _stays_unstable(result: CampbellResult) -> bool:
    """Return whether the first unstable motion stays unstable at all speeds above."""
    above = np.flatnonzero(result.speed >= result.stability_threshold)
    first = np.array([name == result.unstable_mode for name in result.mode], dtype=bool)
    block = np.ix_(above, np.flatnonzero(first if first.any() else ~first))
    growing = np.atleast_1d(result.unstable[block].any(axis=1))
    valid = np.isfinite(result.frequency[block]).any(axis=1)
    return bool(valid.any() and growing[valid].all())
