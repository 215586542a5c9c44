"""Lines of text, warnings and headline numbers of stability lobes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.stability_lobes import planned_summary
from rotordyn.analyses.stability_lobes.result import (
    REMOVAL,
    StabilityLobesResult,
    banded,
    in_mm,
)
from rotordyn.analyses.stability_lobes.spec import FLIP, FOLD, WITHOUT_CUT
from rotordyn.arrays import Array, Flags
from rotordyn.results.described import Described
from rotordyn.results.display import (
    MEGAPASCAL,
    MILLIMETRE,
    RPM,
    number,
    rounded_up,
)
from rotordyn.results.headline import Number
from rotordyn.results.severity import Severity, graded
from rotordyn.results.text import unbroken

MOST = 4  # pockets named
LOWER = 0.95  # times the adjacent limits: period doubling below it between speeds is reported
# change of the waves between teeth from speed to speed; at a distance of δ waves from the lowest
# point of a lobe a limit is up to 1/cos 2πδ times as high: steps may lose 24 %, and 8 %
SKIPPED, SEEN = 0.2, 0.125
AS_MUCH = 0.999  # of the highest removal rate
MOVED = 1.25  # least ratio of limits to those of the machine at rest that is reported


def summary(result: StabilityLobesResult) -> list[str]:
    """Return lines with the least limit and its chatter, and the deepest pockets."""
    if not np.isfinite(result.depth).any():
        solved = ", where it is solved" if any(result.cutting_outcome) else ""
        none = f"chatter    no depth of cut is unstable at the speeds of the cutter{solved}"
        further = [*_band(result), *_motor(result), *planned_summary.summary(result)]
        return [*_material(result), none, *further]
    pockets = [
        unbroken(
            f"{in_mm(depth)} at {number(speed * RPM.factor, 0)} rpm "
            f"({number(rate * REMOVAL.factor)} {REMOVAL.unit})"
        )
        for speed, depth, rate in zip(
            result.pocket_speed[:MOST],
            result.pocket_depth[:MOST],
            result.pocket_removal[:MOST],
            strict=True,
        )
    ]
    lines = [*_material(result), *_least(result), *_band(result), *_unlimited(result)]
    if pockets:
        lines.append(f"pockets    {'; '.join(pockets)}")
    for part in (_motor, _even, _at_rest, _measured, planned_summary.summary):
        lines += part(result)
    return lines


def _least(result: StabilityLobesResult) -> list[str]:
    """Return the line of the least limit, and of how many speeds."""
    depth, growing = result.depth, _growing(result)
    depth = np.where(growing, np.nan, depth)
    if np.isnan(depth).all():
        return ["chatter    no depth is stable: the machine is unstable without a cut"]
    if not np.isfinite(depth).any():
        return []
    row, count = int(np.nanargmin(depth)), int((~np.isnan(depth)).sum())
    speeds = f" at {'the other' if growing.any() else 'all'} {count} speeds" if count > 1 else ""
    of_it = np.isin(result.mode_frequency[row], result.workpiece_frequency)
    return [
        f"chatter    stable up to {in_mm(depth[row])}{speeds}, limited at {_rpm(result, row)} by "
        f"the mode at {number(result.mode_frequency[row])} Hz{' of the workpiece' if of_it else ''}"
        f" (chatter at {number(result.chatter[row])} Hz)"
    ]


def _growing(result: StabilityLobesResult) -> Flags:
    """Return flags of the speeds at which the machine is unstable without a cut."""
    return np.array(result.loss) == WITHOUT_CUT


def _material(result: StabilityLobesResult) -> list[str]:
    """Return lines of the modes of the workpiece, and of its cutting coefficients: of the limits,
    then of the band."""
    modes = ", ".join(number(value) for value in result.workpiece_frequency)
    noun = "a mode" if result.workpiece_mode.size == 1 else "modes"
    flexible = [f"workpiece  flexible, {noun} at {modes} Hz"] if modes else []
    if not result.source.size:
        return flexible
    pairs = zip(result.tangential, result.radial, strict=True)
    first, *others = (
        unbroken(" and ".join(number(value * MEGAPASCAL.factor, 0) for value in pair))
        for pair in pairs
    )
    also = f"; from other sources {', '.join(others)}" if others else ""
    name = result.workpiece or "workpiece"
    return [f"material   {name}, Ktc and Krc [MPa]: {first}{also}", *flexible]


def _band(result: StabilityLobesResult) -> list[str]:
    """Return the line of the least limit over intervals and sources."""
    least = np.where(_growing(result), np.nan, result.least)
    if not banded(result) or not np.isfinite(least).any():
        return []
    row = int(np.nanargmin(least))
    return [
        f"band       over intervals and sources stable up to {in_mm(result.least[row])}, limited "
        f"at {_rpm(result, row)}"
    ]


def _unlimited(result: StabilityLobesResult) -> list[str]:
    """Return the line of speeds at which every depth is stable."""
    rows = np.flatnonzero(np.isposinf(result.depth))
    if not rows.size:
        return []
    parts = np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1)
    ranges = [
        f"at {_rpm(result, part[0])}"
        if len(part) == 1
        else f"from {number(result.cutting_speed[part[0]] * RPM.factor, 0)} to "
        f"{_rpm(result, part[-1])}"
        for part in parts
    ]
    more = f" and {len(ranges) - MOST} more ranges" if len(ranges) > MOST + 1 else ""
    shown = ranges if not more else ranges[:MOST]
    return [
        f"no limit   at {rows.size} of {len(result.depth)} speeds every depth is stable: "
        f"{', '.join(shown)}{more}"
    ]


def numbers(result: StabilityLobesResult, _: Described) -> Iterator[Number]:
    """Yield the least limit, infinite where no depth is unstable, that on a measured spindle and of
    the band, the deepest pocket with its speed, the highest removal rate within stability and
    motor, and numbers of a planned cut."""
    yield _lowest("least", result.depth)
    if not np.isnan(result.measured).all():
        yield _lowest("measured least", result.measured)
    if banded(result):
        yield _lowest("least of the band", result.least)
    if result.pocket_depth.size:
        depth, speed = float(result.pocket_depth[0]), float(result.pocket_speed[0])
        yield Number("pocket", "mm", depth * MILLIMETRE.factor, digits=2)
        yield Number("pocket at", "rpm", speed * RPM.factor, digits=0)
    if result.motor:
        most = float(np.fmax.reduce(result.motor_removal))
        yield Number("removal", REMOVAL.unit, most * REMOVAL.factor, digits=1)
    yield from planned_summary.numbers(result)


def _lowest(name: str, depth: Array) -> Number:
    """Return the least of depths over speed."""
    return Number(name, "mm", float(np.fmin.reduce(depth)) * MILLIMETRE.factor, digits=2)


def lacking(_: StabilityLobesResult) -> Iterator[Number]:
    """Yield the numbers of pockets, of which a result may have none, as NaN."""
    yield Number("pocket", "mm", np.nan)
    yield Number("pocket at", "rpm", np.nan)


def _motor(result: StabilityLobesResult) -> list[str]:
    """Return the line of speeds at which the motor limits the cut, and the highest removal rate."""
    if not result.motor:
        return []
    solved = ~np.isnan(result.depth)
    less = int((result.motor_depth < result.depth).sum())
    if len(solved) == 1:
        order = "before" if less else "after"
        line = f"motor      {result.motor}: limits the cut {order} chatter does"
    else:
        where = planned_summary.of_speeds(less, int(solved.sum())) if less else "no speed"
        line = f"motor      {result.motor}: limits the cut before chatter does at {where}"
    rate = np.where(solved, result.motor_removal, 0.0)
    if 0.0 < rate.max() < np.inf:
        depth = np.minimum(result.depth, result.motor_depth)
        most = rate >= AS_MUCH * rate.max()
        margin = np.divide(result.depth, depth, out=np.zeros_like(depth), where=most)
        row = int(margin.argmax())  # of the speeds at which the power is used up, the safest
        line += "; highest removal rate " + unbroken(
            f"{in_mm(depth[row])} at {_rpm(result, row)} ({number(rate[row] * REMOVAL.factor)} "
            f"{REMOVAL.unit})"
        )
        if np.isfinite(result.depth[row]) and margin[row] > 1.0:
            line += f", stable up to {in_mm(result.depth[row])}"
    return [line]


def _even(result: StabilityLobesResult) -> list[str]:
    """Return the line of the least limit of evenly spaced teeth, and where it differs most."""
    even = np.where(_growing(result), np.nan, result.even)
    if np.isnan(even).all():
        return []
    row, ratio = _largest_difference(result.depth, even)
    line = "even pitch evenly spaced teeth would be stable"
    finite = np.isfinite(even).any()
    line += f" up to {in_mm(np.nanmin(even))}" if finite else " at any depth"
    if ratio > 1.0:
        line += (
            f"; the uneven ones differ most at {_rpm(result, row)}: {in_mm(result.depth[row])} in "
            f"place of {in_mm(result.even[row])}"
        )
    return [line]


def _at_rest(result: StabilityLobesResult) -> list[str]:
    """Return the line of the speed at which the machine at rest would mislead most."""
    row, ratio = _largest_difference(result.at_rest, result.depth)
    if ratio <= MOVED:
        return []
    return [
        f"at rest    its limit differs most at {_rpm(result, row)}: "
        f"{in_mm(result.at_rest[row])} in place of {in_mm(result.depth[row])}"
    ]


def _measured(result: StabilityLobesResult) -> list[str]:
    """Return the line of the least limit on the measured spindle, and where it differs most."""
    if not np.isfinite(result.measured).any():
        return []
    row = int(np.nanargmin(result.measured))
    line = (
        f"measured   the tool on the measured spindle is stable up to "
        f"{in_mm(result.measured[row])}, limited at {_rpm(result, row)} (chatter at "
        f"{number(result.measured_chatter[row])} Hz)"
    )
    most, ratio = _largest_difference(result.measured, result.at_rest)
    if ratio > 1.0:
        line += (
            f"; differs most from the machine as computed at rest at {_rpm(result, most)}: "
            f"{in_mm(result.measured[most])} in place of {in_mm(result.at_rest[most])}"
        )
    others = "pockets, removal rates, bands and planned cuts"
    return [f"{line}; {others} are those of the machine as computed"]


def _largest_difference(one: Array, other: Array) -> tuple[int, float]:
    """Return the row at which two limits differ most, and their ratio ≥ 1 there, infinite where one
    is 0; 0 where no pair is finite."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.maximum(one / other, other / one)
    ratio = np.where(np.isfinite(one) & np.isfinite(other), np.nan_to_num(ratio, posinf=np.inf), 0)
    row = int(ratio.argmax())
    return row, float(ratio[row])


def _rpm(result: StabilityLobesResult, row: int) -> str:
    return f"{number(result.cutting_speed[row] * RPM.factor, 0)} rpm"


def accuracy(result: StabilityLobesResult) -> list[str]:
    """Return the line of the change of limits by a finer model."""
    within = f"within {rounded_up(result.error)}" if np.isfinite(result.error) else "not known"
    return [f"limits {within} by modes up to {number(result.modelled, 0)} Hz"]


def warnings(result: StabilityLobesResult) -> list[str]:
    """Return warnings of failed speeds, period doubling, missed lobes and missing modes, of the
    model and of a measurement."""
    sentences = []
    failed = [row for row, word in enumerate(result.cutting_outcome) if word]
    if failed:
        why = (
            f"stability_lobes: no limit at {len(failed)} of {len(result.depth)} speeds of the "
            f"cutter, first at {_rpm(result, failed[0])}: {result.cutting_outcome[failed[0]]}"
        )
        sentences.append(graded(Severity.NO_STATE, why))
    growing = np.flatnonzero(_growing(result))
    if growing.size:
        first, hertz = growing[0], result.chatter[growing[0]]
        what = (
            f"the mode at {number(hertz)} Hz" if hertz > 0.0 else "a motion that does not oscillate"
        )
        why = (
            "stability_lobes: the machine is unstable without a cut at "
            f"{growing.size} of {len(result.depth)} speeds of the cutter, first at "
            f"{_rpm(result, first)}, where {what} grows: no depth is stable there"
        )
        sentences.append(graded(Severity.NO_STATE, why))
    flips = np.flatnonzero(np.array(result.loss) == FLIP)
    if flips.size:
        rpm = number(result.cutting_speed[flips[0]] * RPM.factor, 0)
        sentences.append(
            f"period doubling limits {flips.size} of {len(result.depth)} speeds, first at {rpm} "
            "rpm: zero-order limits do not include it"
        )
    folds = np.flatnonzero(np.array(result.loss) == FOLD)
    if folds.size:
        rpm = number(result.cutting_speed[folds[0]] * RPM.factor, 0)
        sentences.append(
            f"vibration that repeats with the pattern of teeth limits {folds.size} of "
            f"{len(result.depth)} speeds, first at {rpm} rpm: zero-order limits do not include it"
        )
    if result.measured_doubt:
        sentences.append(f"stability_lobes: on the measured spindle {result.measured_doubt}")
    for part in (_beyond_measurement, _skipped, _flips, planned_summary.warnings):
        sentences += part(result)
    if result.error > result.error_asked:
        percent = f"by {number(100.0 * result.error, 0)} %"
        amount = percent if np.isfinite(result.error) else "from or to no limit"
        why = (
            f"stability_lobes: limits still change {amount} with modes above "
            f"{number(result.modelled, 0)} Hz: raise max_frequency, or give damping to such modes"
        )
        sentences.append(graded(Severity.INVALID, why))
    elif (highest := float(np.nanmax(result.chatter, initial=0.0))) > result.modelled:
        sentences.append(
            f"stability_lobes: chatter at {number(highest, 0)} Hz is above the "
            f"{number(result.modelled, 0)} Hz up to which the machine is modelled: raise "
            "max_frequency"
        )
    return sentences


def _beyond_measurement(result: StabilityLobesResult) -> list[str]:
    """Return the warning that the cut is limited by chatter above the measured frequencies."""
    chatter = np.nan_to_num(result.measured_chatter)
    rows = np.flatnonzero(chatter > result.measured_to)
    if not rows.size:
        return []
    last, highest = number(result.measured_to, 0), number(chatter.max(), 0)
    return [
        f"stability_lobes: the spindle is measured to {last} Hz, above which the machine as "
        f"computed at rest chatters, at up to {highest} Hz, at {rows.size} of {len(chatter)} "
        f"speeds, first at {_rpm(result, rows[0])}: the limits on the measured spindle there are "
        "those of the machine as computed: measure beyond that frequency"
    ]


def _skipped(result: StabilityLobesResult) -> list[str]:
    """Return the warning that speeds are too far apart for lobes, each of which has another number
    of waves between two teeth."""
    speed, chatter = result.cutting_speed, np.where(_growing(result), np.nan, result.chatter)
    delay = result.waves / chatter * speed  # times speed: the longest pitch
    chatter = np.fmax(chatter[1:], chatter[:-1])
    if not np.isfinite(delay).any():
        return []
    passing = chatter * np.nanmax(delay) * np.abs(np.diff(1.0 / speed))
    rows = np.flatnonzero(passing > SKIPPED)
    if not rows.size:
        return []
    first, last = rows[0], rows[-1] + 1
    step = (speed[first + 1] - speed[first]) * SEEN / passing[first]
    return [
        "stability_lobes: speeds are too far apart for the lobes from "
        f"{number(speed[first] * RPM.factor, 0)} to {_rpm(result, last)}, between which limits may "
        f"be lower: take steps of {number(step * RPM.factor, 0)} rpm there to resolve them"
    ]


def _flips(result: StabilityLobesResult) -> list[str]:
    """Return the warning that period doubling limits the cut between speeds."""
    adjacent = np.fmin(result.depth[:-1], result.depth[1:])
    rows = np.flatnonzero(result.flip_depth[:-1] < LOWER * adjacent)
    if not rows.size:
        return []
    lowest = rows[np.argmin(result.flip_depth[rows])]
    speed = [number(value * RPM.factor, 0) for value in result.flip_speed]
    others = [speed[row] for row in rows if row != lowest]
    also = f", and at about {', '.join(others[:MOST])} rpm" if others else ""
    more = f" and {len(others) - MOST} more speeds" if len(others) > MOST else ""
    return [
        "stability_lobes: between speeds period doubling limits the cut, at about "
        f"{speed[lowest]} rpm to {in_mm(result.flip_depth[lowest])}, where adjacent limits are "
        f"{in_mm(adjacent[lowest])} and more{also}{more}: add speeds there"
    ]
