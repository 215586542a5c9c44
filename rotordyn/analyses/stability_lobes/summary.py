"""Stability of milling in a few lines of text."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.stability_lobes.result import REMOVAL, StabilityLobesResult, banded
from rotordyn.analyses.stability_lobes.spec import FLIP, FOLD, WITHOUT_CUT
from rotordyn.results.described import Described
from rotordyn.results.display import (
    MEGAPASCAL,
    MICROMETRE,
    MILLIMETRE,
    RPM,
    number,
    rounded_up,
)
from rotordyn.results.headline import Number
from rotordyn.results.kinds import Array, Flags
from rotordyn.results.text import unbroken

MOST = 4  # pockets named
SKIPPED, SEEN = 0.5, 0.125  # waves between teeth more or less from speed to speed; 1 is a lobe
ONE = 1e-3  # of an error of a wall: as equal over its depth it is one number
MOVED = 1.25  # times: limits so far from those of the machine at rest are said


def summary(result: StabilityLobesResult) -> list[str]:
    """The least limit with its chatter, and the deepest pockets."""
    if not np.isfinite(result.depth).any():
        solved = ", where it is solved" if any(result.cutting_outcome) else ""
        none = f"chatter    no depth of cut is unstable at the speeds of the cutter{solved}"
        return [*_material(result), none, *_band(result), *_planned(result)]
    pockets = [
        unbroken(
            f"{_depth(depth)} at {number(speed * RPM.factor, 0)} rpm "
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
    return lines + _even(result) + _at_rest(result) + _measured(result) + _planned(result)


def _least(result: StabilityLobesResult) -> list[str]:
    """The least limit of the cut, and of how many speeds it is."""
    depth, growing = result.depth, _growing(result)
    depth = np.where(growing, np.nan, depth)
    if np.isnan(depth).all():
        return ["chatter    no depth is stable: the machine is unstable without a cut"]
    if not np.isfinite(depth).any():
        return []
    row, many = int(np.nanargmin(depth)), int((~np.isnan(depth)).sum())
    speeds = f" at {'the other' if growing.any() else 'all'} {many} speeds" if many > 1 else ""
    return [
        f"chatter    stable up to {_depth(depth[row])}{speeds}, limited at {_rpm(result, row)} by "
        f"the mode at {number(result.mode_frequency[row])} Hz (chatter at "
        f"{number(result.chatter[row])} Hz)"
    ]


def _growing(result: StabilityLobesResult) -> Flags:
    """Speeds at which the machine is unstable by itself."""
    return np.array(result.loss) == WITHOUT_CUT


def _material(result: StabilityLobesResult) -> list[str]:
    """Cutting coefficients of a workpiece: those of the limits, then those of the band."""
    if not result.source.size:
        return []
    pairs = zip(result.tangential, result.radial, strict=True)
    own, *others = (
        unbroken(" and ".join(number(each * MEGAPASCAL.factor, 0) for each in pair))
        for pair in pairs
    )
    also = f"; by other sources {', '.join(others)}" if others else ""
    name = result.workpiece or "workpiece"
    return [f"material   {name}, Ktc and Krc [MPa]: {own}{also}"]


def _band(result: StabilityLobesResult) -> list[str]:
    """The least limit over intervals and sources."""
    least = np.where(_growing(result), np.nan, result.least)
    if not banded(result) or not np.isfinite(least).any():
        return []
    row = int(np.nanargmin(least))
    return [
        f"band       over intervals and sources stable up to {_depth(result.least[row])}, limited "
        f"at {_rpm(result, row)}"
    ]


def _unlimited(result: StabilityLobesResult) -> list[str]:
    """Speeds at which every depth is stable."""
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
    """Least limit, infinite where no depth is unstable, and the deepest pocket with its speed; of a
    planned cut the largest amount of the error of the surface and the highest power, absent unless
    it is stable at all speeds that are solved."""
    known = result.depth[~np.isnan(result.depth)]
    least = float(known.min()) if known.size else np.nan
    yield Number("least", "mm", least * MILLIMETRE.factor, digits=2)
    if result.pocket_depth.size:
        depth, speed = float(result.pocket_depth[0]), float(result.pocket_speed[0])
        yield Number("pocket", "mm", depth * MILLIMETRE.factor, digits=2)
        yield Number("pocket at", "rpm", speed * RPM.factor, digits=0)
    if result.cut_is_stable.size:  # over unlike speeds machines could not be compared
        whole, absent = not _unstable_cut(result).any() and result.cut_is_stable.any(), "not stable"
        worst = float(np.nanmax(_worst(result))) * MICROMETRE.factor if whole else np.nan
        power = float(np.nanmax(result.cutting_power)) / 1e3 if whole else np.nan
        yield Number("surface error", "µm", worst, digits=2, absent=absent)
        yield Number("cutting power", "kW", power, digits=2, absent=absent)


def lacking(_: StabilityLobesResult) -> Iterator[Number]:
    """Pockets, of which there may be none."""
    yield Number("pocket", "mm", np.nan)
    yield Number("pocket at", "rpm", np.nan)


def _even(result: StabilityLobesResult) -> list[str]:
    """The least limit of evenly spaced teeth, and where it differs most."""
    even = np.where(_growing(result), np.nan, result.even)
    if np.isnan(even).all():
        return []
    row, ratio = _largest_difference(result.depth, even)
    line = "even pitch evenly spaced teeth would be stable"
    known = np.isfinite(even).any()
    line += f" up to {_depth(np.nanmin(even))}" if known else " at any depth"
    if ratio > 1.0:
        line += (
            f"; the uneven ones differ most at {_rpm(result, row)}: {_depth(result.depth[row])} in "
            f"place of {_depth(result.even[row])}"
        )
    return [line]


def _at_rest(result: StabilityLobesResult) -> list[str]:
    """Where the machine at rest would mislead most."""
    row, ratio = _largest_difference(result.at_rest, result.depth)
    if ratio <= MOVED:
        return []
    return [
        f"at rest    its receptance misleads most at {_rpm(result, row)}: "
        f"{_depth(result.at_rest[row])} in place of {_depth(result.depth[row])}"
    ]


def _measured(result: StabilityLobesResult) -> list[str]:
    """The least limit of the tool on the measured spindle, and where it differs most."""
    if not np.isfinite(result.measured).any():
        return []
    row = int(np.nanargmin(result.measured))
    line = (
        f"measured   the tool on the measured spindle is stable up to "
        f"{_depth(result.measured[row])}, limited at {_rpm(result, row)}"
    )
    most, ratio = _largest_difference(result.measured, result.at_rest)
    if ratio > 1.0:
        line += (
            f"; differs most from the machine as computed at rest at {_rpm(result, most)}: "
            f"{_depth(result.measured[most])} in place of {_depth(result.at_rest[most])}"
        )
    return [line]


def _planned(result: StabilityLobesResult) -> list[str]:
    """What a planned cut does where it is stable: the surface, the tool, the forces."""
    stable = result.cut_is_stable
    if not stable.size:
        return []
    what = f"{_depth(result.planned_depth)} deep, {_feed(result)} by tooth"
    if not stable.any():
        return [f"cut        {what}: stable at none of {stable.size} speeds"]
    where = f"stable at {_of(int(stable.sum()), stable.size)}"
    worst = _worst(result)
    error = [*_errors(result, int(np.nanargmax(worst)), "largest")]
    if stable.sum() > 1:
        error += _errors(result, int(np.nanargmin(worst)), "smallest")
    swing = np.where(stable, result.tip_vibration.max(axis=1), 0.0)
    most = int(swing.argmax())
    force, torque, power = (
        float(np.nanmax(each))
        for each in (result.cutting_force, result.cutting_torque, result.cutting_power)
    )
    return [
        f"cut        {what}: {where}",
        f"surface    error {'; '.join(error)} (positive: material is left)",
        f"vibration  of the tip up to {_micrometre(float(swing[most]))} from peak to peak at "
        f"{_milling_rpm(result, most)}",
        unbroken(
            f"forces     up to {number(force)} N; mean torque {number(torque, 3)} N m, power up to "
            f"{number(power * 1e-3, 2)} kW"
        ),
    ]


def _worst(result: StabilityLobesResult) -> Array:
    """Largest amount of the error of a wall at every speed (n,) [m]."""
    ends = np.stack([result.surface_error_least, result.surface_error_most])
    return np.asarray(np.abs(ends).max(axis=(0, 2)))


def _errors(result: StabilityLobesResult, row: int, which: str) -> Iterator[str]:
    """Errors of the walls at the speed where they are ``which``."""
    walls = zip(
        result.wall, result.surface_error_least[row], result.surface_error_most[row], strict=True
    )
    told = ", ".join(
        unbroken(
            (f"{wall}-milled wall " if len(result.wall) > 1 else "")
            + (
                _micrometre(most)
                if most - least < ONE * abs(most)
                else f"{_micrometre(least)[:-3]} to {_micrometre(most)}"
            )
        )
        for wall, least, most in walls
    )
    yield f"{which} {told} at {_milling_rpm(result, row)}"


def _of(some: int, every: int) -> str:
    if every == 1:
        return "the speed"
    return f"all {every} speeds" if some == every else f"{some} of {every} speeds"


def _unstable_cut(result: StabilityLobesResult) -> Flags:
    """Speeds (n,) with a limit that a planned cut exceeds."""
    return ~np.isnan(result.depth) & ~result.cut_is_stable


def _feed(result: StabilityLobesResult) -> str:
    return f"{result.planned_feed * MILLIMETRE.factor:.4g} mm"


def _micrometre(value: float) -> str:
    return f"{number(value * MICROMETRE.factor, 2)} µm"


def _milling_rpm(result: StabilityLobesResult, row: int) -> str:
    return f"{number(result.milling_speed[row] * RPM.factor, 0)} rpm"


def _largest_difference(one: Array, other: Array) -> tuple[int, float]:
    """Row at which two limits differ most, and their ratio there, from 1, infinite where one is 0;
    0 where none is known."""
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.maximum(one / other, other / one)
    ratio = np.where(np.isfinite(one) & np.isfinite(other), np.nan_to_num(ratio, posinf=np.inf), 0)
    row = int(ratio.argmax())
    return row, float(ratio[row])


def _rpm(result: StabilityLobesResult, row: int) -> str:
    return f"{number(result.cutting_speed[row] * RPM.factor, 0)} rpm"


def accuracy(result: StabilityLobesResult) -> list[str]:
    """By how much limits change with a finer model."""
    within = f"within {rounded_up(result.error)}" if np.isfinite(result.error) else "not known"
    return [f"limits {within} by modes up to {number(result.modelled, 0)} Hz"]


def warnings(result: StabilityLobesResult) -> list[str]:
    """Speeds without a solution, where period doubling limits, modes that are missing."""
    sentences = []
    failed = [row for row, word in enumerate(result.cutting_outcome) if word]
    if failed:
        sentences.append(
            f"stability_lobes: no limit at {len(failed)} of {len(result.depth)} speeds of the "
            f"cutter, first at {_rpm(result, failed[0])}: {result.cutting_outcome[failed[0]]}"
        )
    growing = np.flatnonzero(_growing(result))
    if growing.size:
        first, hertz = growing[0], result.chatter[growing[0]]
        what = f"the mode at {number(hertz)} Hz" if hertz > 0.0 else "a motion that does not swing"
        sentences.append(
            "stability_lobes: unstable by itself, without a cut, at "
            f"{growing.size} of {len(result.depth)} speeds of the cutter, first at "
            f"{_rpm(result, first)}, where {what} grows: no depth is stable there"
        )
    flips = np.flatnonzero(np.array(result.loss) == FLIP)
    if flips.size:
        rpm = number(result.cutting_speed[flips[0]] * RPM.factor, 0)
        sentences.append(
            f"period doubling limits {flips.size} of {len(result.depth)} speeds, first at {rpm} "
            "rpm: zero-order limits do not see it"
        )
    folds = np.flatnonzero(np.array(result.loss) == FOLD)
    if folds.size:
        rpm = number(result.cutting_speed[folds[0]] * RPM.factor, 0)
        sentences.append(
            f"vibration that repeats with the pattern of teeth limits {folds.size} of "
            f"{len(result.depth)} speeds, first at {rpm} rpm: zero-order limits do not see it"
        )
    sentences += _skipped(result) + _of_cut(result)
    if result.error > result.error_asked:
        percent = f"by {number(100.0 * result.error, 0)} %"
        much = percent if np.isfinite(result.error) else "from none or to none"
        sentences.append(
            f"stability_lobes: limits still change {much} with modes above "
            f"{number(result.modelled, 0)} Hz: raise max_frequency, or give damping to such modes"
        )
    elif (highest := float(np.nanmax(result.chatter, initial=0.0))) > result.modelled:
        sentences.append(
            f"stability_lobes: chatter at {number(highest, 0)} Hz is above the "
            f"{number(result.modelled, 0)} Hz up to which the machine is modelled: raise "
            "max_frequency"
        )
    return sentences


def _of_cut(result: StabilityLobesResult) -> list[str]:
    """Speeds at which a planned cut is not stable, or teeth leave the cut."""
    stable, sentences = result.cut_is_stable, []
    if not stable.size:
        return []
    lost = np.flatnonzero(_unstable_cut(result))
    if lost.size:
        sentences.append(
            f"stability_lobes: the planned cut of {_depth(result.planned_depth)} is not stable at "
            f"{lost.size} of {stable.size} speeds, first at {_milling_rpm(result, int(lost[0]))}: "
            "its vibration and surface are not given there"
        )
    speed = result.milling_speed
    wide = np.fmax(result.resonance_width[1:], result.resonance_width[:-1])
    coarse = np.flatnonzero(np.diff(speed) > wide * speed[1:])
    if coarse.size:
        step = 0.5 * float((wide * speed[1:])[coarse].min()) * RPM.factor
        sentences.append(
            "stability_lobes: speeds are farther apart than resonances of the planned cut are "
            f"wide, from {_milling_rpm(result, int(coarse[0]))} to "
            f"{_milling_rpm(result, int(coarse[-1]) + 1)}, between which errors of the surface may "
            f"be larger: steps of {number(step, 0)} rpm show them"
        )
    doubtful = np.flatnonzero(stable & (result.least <= result.planned_depth))
    if doubtful.size:
        sentences.append(
            f"stability_lobes: the planned cut of {_depth(result.planned_depth)} is not stable "
            f"over the whole band of intervals and sources at {doubtful.size} of {stable.size} "
            f"speeds, first at {_milling_rpm(result, int(doubtful[0]))}"
        )
    thin = np.flatnonzero(result.thinnest_chip < 0.0)
    if thin.size:
        sentences.append(
            f"stability_lobes: in the planned cut teeth leave the work at {thin.size} of "
            f"{stable.size} speeds, first at {_milling_rpm(result, int(thin[0]))}: its vibration "
            "and surface, of teeth that stay in it, are not right in size there"
        )
    return sentences


def _skipped(result: StabilityLobesResult) -> list[str]:
    """That lobes pass unseen between speeds, at each of which another number of waves fits between
    two teeth."""
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
        "stability_lobes: lobes are closer than the speeds from "
        f"{number(speed[first] * RPM.factor, 0)} to {_rpm(result, last)}, between which limits may "
        f"be lower: steps of {number(step * RPM.factor, 0)} rpm show them from the first on"
    ]


def _depth(value: float) -> str:
    return f"{number(value * MILLIMETRE.factor, 2)} mm"
