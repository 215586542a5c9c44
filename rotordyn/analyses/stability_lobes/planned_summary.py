"""Lines of text, warnings and headline numbers of a planned cut."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.stability_lobes.result import REMOVAL, StabilityLobesResult, in_mm
from rotordyn.arrays import Array, Flags
from rotordyn.results.display import MICROMETRE, MILLIMETRE, RPM, number
from rotordyn.results.headline import Number
from rotordyn.results.text import unbroken

UNSETTLED, DEPARTED = 0.01, 0.25  # of a vibration: largest error, and change by moving contact
COARSE, SEEN = 1 / 6, 1 / 8  # of the width of a resonance: steps that lose 5 % and 3 % of a peak
OF_MARGIN = 0.5  # of the margin to the limit of stability: contact that moves more may cross it
ONE = 1e-3  # of an error of a wall: a smaller range over its depth is written as one number


def summary(result: StabilityLobesResult) -> list[str]:
    """Return lines with the surface, vibration and forces of a planned cut where it is stable."""
    stable = result.cut_is_stable
    if not stable.size:
        return []
    what = f"{in_mm(result.planned_depth)} deep, {_feed(result)} per tooth"
    if not stable.any():
        return [f"cut        {what}: stable at none of {stable.size} speeds"]
    most_removed = number(float(np.nanmax(result.planned_removal)) * REMOVAL.factor)
    where = (
        f"stable at {of_speeds(int(stable.sum()), stable.size)}, removes up to "
        f"{unbroken(f'{most_removed} {REMOVAL.unit}')}"
    )
    worst = _worst(result)
    error = [*_errors(result, int(np.nanargmax(worst)), "largest")]
    if stable.sum() > 1:
        error += _errors(result, int(np.nanargmin(worst)), "smallest")
    vibration = np.where(stable, result.tip_vibration.max(axis=1), 0.0)
    most = int(vibration.argmax())
    force, torque, power = (
        float(np.nanmax(values))
        for values in (result.cutting_force, result.cutting_torque, result.cutting_power)
    )
    against = " against the workpiece" if result.workpiece_mode.size else ""
    return [
        f"cut        {what}: {where}",
        f"surface    error {'; '.join(error)} (positive: material is left)",
        f"vibration  of the tip{against} up to {_micrometre(float(vibration[most]))} from "
        "peak to peak "
        f"at {_milling_rpm(result, most)}",
        unbroken(
            f"forces     up to {number(force)} N; mean torque {number(torque, 3)} N m, power up to "
            f"{number(power * 1e-3, 2)} kW"
        ),
    ]


def numbers(result: StabilityLobesResult) -> Iterator[Number]:
    """Yield the largest amount of the error of the surface, the highest power and removal rate,
    absent unless the cut is stable and its vibration converged at all solved speeds: over different
    speeds machines could not be compared."""
    if not result.cut_is_stable.size:
        return
    stable = not _unstable_cut(result).any() and bool(result.cut_is_stable.any())
    absent = "not converged" if stable else "not stable"
    unsettled = (result.vibration_error > UNSETTLED) | result.edges_chatter
    complete = stable and not unsettled.any()
    worst = float(np.nanmax(_worst(result))) * MICROMETRE.factor if complete else np.nan
    power = float(np.nanmax(result.cutting_power)) / 1e3 if complete else np.nan
    yield Number("surface error", "µm", worst, digits=2, absent=absent)
    yield Number("cutting power", "kW", power, digits=2, absent=absent)
    rate = float(np.nanmax(result.planned_removal)) * REMOVAL.factor if complete else np.nan
    yield Number("planned removal", REMOVAL.unit, rate, absent=absent)


def warnings(result: StabilityLobesResult) -> list[str]:
    """Return warnings of speeds at which a planned cut is unstable or uncertain, and idle teeth."""
    stable, sentences = result.cut_is_stable, []
    if not stable.size:
        return []
    lost = np.flatnonzero(_unstable_cut(result))
    if lost.size:
        sentences.append(
            f"stability_lobes: the planned cut of {in_mm(result.planned_depth)} is not stable at "
            f"{lost.size} of {stable.size} speeds, first at {_milling_rpm(result, int(lost[0]))}: "
            "its vibration and surface are not given there"
        )
    on_measured = np.flatnonzero(stable & (result.measured <= result.planned_depth))
    if on_measured.size:
        sentences.append(
            f"stability_lobes: on the measured spindle the planned cut of "
            f"{in_mm(result.planned_depth)} is not stable at {on_measured.size} of the "
            f"{stable.sum()} speeds at which it is on the machine as computed, first at "
            f"{_milling_rpm(result, int(on_measured[0]))}: choose a speed at which both are"
        )
    weak = np.flatnonzero(stable & (result.motor_depth < result.planned_depth))
    if weak.size:
        sentences.append(
            f"stability_lobes: the planned cut needs more than the motor supplies ({result.motor}) "
            f"at {weak.size} of {stable.size} speeds, first at {_milling_rpm(result, int(weak[0]))}"
        )
    speed = result.milling_speed
    width = result.resonance_width[:-1]
    coarse = np.flatnonzero((width > 0.0) & (np.diff(speed) > COARSE * width * speed[1:]))
    if coarse.size:
        step = SEEN * float((width * speed[1:])[coarse].min()) * RPM.factor
        sentences.append(
            "stability_lobes: speeds are too far apart for the resonances of the planned cut, "
            f"from {_milling_rpm(result, int(coarse[0]))} to "
            f"{_milling_rpm(result, int(coarse[-1]) + 1)}, between which errors of the surface may "
            f"be larger: take steps of {number(step, 0)} rpm to resolve them"
        )
    doubtful = np.flatnonzero(stable & (result.least <= result.planned_depth))
    if doubtful.size:
        sentences.append(
            f"stability_lobes: the planned cut of {in_mm(result.planned_depth)} is not stable "
            f"over the whole band of intervals and sources at {doubtful.size} of {stable.size} "
            f"speeds, first at {_milling_rpm(result, int(doubtful[0]))}"
        )
    edges = np.flatnonzero(result.edges_chatter)
    if edges.size:
        sentences.append(
            "stability_lobes: edge forces follow the vibration where chips begin or end with no "
            f"thickness, and may let the planned cut chatter at {edges.size} of {stable.size} "
            f"speeds, first at {_milling_rpm(result, int(edges[0]))}: vibration and surface are "
            "uncertain there; take less depth or more feed"
        )
    if result.idle_teeth:
        some = "1 tooth removes" if result.idle_teeth == 1 else f"{result.idle_teeth} teeth remove"
        sentences.append(
            f"stability_lobes: by run-out {some} no material in the planned cut: limits of "
            "stability are those of the other teeth, and are valid for that feed alone"
        )
    margin = OF_MARGIN * (result.depth / result.planned_depth - 1.0)
    departed = result.contact_departure > np.fmin(margin, DEPARTED)
    restless = np.flatnonzero((result.vibration_error > UNSETTLED) | departed)
    if restless.size:
        sentences.append(
            f"stability_lobes: in the planned cut teeth lose contact at {restless.size} of "
            f"{stable.size} speeds, first at {_milling_rpm(result, int(restless[0]))}: whether the "
            "periodic motion is stable is not known there, nor are vibration and surface"
        )
    return sentences


def _worst(result: StabilityLobesResult) -> Array:
    """Return the largest amount of the error of a wall at every speed (n,) [m]."""
    ends = np.stack([result.surface_error_least, result.surface_error_most])
    return np.asarray(np.abs(ends).max(axis=(0, 2)))


def _errors(result: StabilityLobesResult, row: int, which: str) -> Iterator[str]:
    """Yield the text of the errors of the walls at a speed where they are ``which``."""
    walls = zip(
        result.wall, result.surface_error_least[row], result.surface_error_most[row], strict=True
    )
    errors = ", ".join(
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
    yield f"{which} {errors} at {_milling_rpm(result, row)}"


def of_speeds(count: int, total: int) -> str:
    """Return a count of speeds as text, such as "3 of 5 speeds"."""
    if total == 1:
        return "the speed"
    return f"all {total} speeds" if count == total else f"{count} of {total} speeds"


def _unstable_cut(result: StabilityLobesResult) -> Flags:
    """Return flags (n,) of the speeds with a limit that a planned cut exceeds."""
    return ~np.isnan(result.depth) & ~result.cut_is_stable


def _feed(result: StabilityLobesResult) -> str:
    return f"{result.planned_feed * MILLIMETRE.factor:.4g} mm"


def _micrometre(value: float) -> str:
    return f"{number(value * MICROMETRE.factor, 2)} µm"


def _milling_rpm(result: StabilityLobesResult, row: int) -> str:
    return f"{number(result.milling_speed[row] * RPM.factor, 0)} rpm"
