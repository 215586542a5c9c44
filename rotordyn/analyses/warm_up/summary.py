"""Lines of text, warnings and headline numbers of a warm-up."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.warm_up.result import ENOUGH, WarmUpResult
from rotordyn.arrays import Array
from rotordyn.preload.ring_stress import YIELD
from rotordyn.results.described import Described
from rotordyn.results.display import RPM
from rotordyn.results.headline import Number, each_speed
from rotordyn.results.severity import Severity, graded, of_severity
from rotordyn.results.text import unbroken

OVERSHOOT = 1.2  # times the load at the end: a larger maximum is reported
EARLY = 0.02  # of a load, or the rise of a temperature: tolerance of thermal balance


def summary(result: WarmUpResult) -> list[str]:
    """Return lines of axial loads at the start, at the maximum and at the end, and of the hottest
    part, at the first and the last speed."""
    lines = []
    for row in sorted({0, len(result.speed) - 1}):
        if result.outcome[row]:
            continue
        last, load = _last(result, row), result.axial_load[row]
        most = np.searchsorted(result.time, result.largest_time[row])
        loads = ", ".join(
            unbroken(
                f"{name} {load[0, k]:.0f} → {load[most[k], k]:.0f} "
                f"({in_words(result.largest_time[row, k])}) → {load[last, k]:.0f}"
            )
            for k, name in enumerate(result.bearing)
        )
        lines.append(
            f"warm-up    at {_rpm(result, row)}, axial load [N] at the start, largest, after "
            f"{in_words(result.time[last])}: {loads}"
        )
        lines.append(f"           {_hottest(result, row)}")
    return lines


def _last(result: WarmUpResult, row: int) -> int:
    return int(np.searchsorted(result.time, result.ended[row]))


def in_words(seconds: float) -> str:
    """Format a time in s, min or h."""
    if seconds < 60.0:
        return f"{seconds:.3g} s"
    return f"{seconds / 60.0:.3g} min" if seconds < 7200.0 else f"{seconds / 3600.0:.3g} h"


def _hottest(result: WarmUpResult, row: int) -> str:
    """Return text of the hottest part at a speed, its bearing and time."""
    parts = {name: values[row] for name, (values, _) in _parts(result).items()}
    part = max(parts, key=lambda name: float(np.nanmax(parts[name])))
    values = parts[part]
    at, k = np.unravel_index(int(np.nanargmax(values)), values.shape)
    return (
        f"hottest {values[at, k]:.0f} °C, {part} of bearing {result.bearing[k]} after "
        f"{in_words(result.time[at])}"
    )


def _parts(result: WarmUpResult) -> dict[str, tuple[Array, Array]]:
    """Return temperatures of the parts of bearings over time, and in balance."""
    return {
        "balls": (result.ball_temperature, result.steady_ball_temperature),
        "inner ring": (result.inner_temperature, result.steady_inner_temperature),
        "outer ring": (result.outer_temperature, result.steady_outer_temperature),
    }


def _rpm(result: WarmUpResult, row: int) -> str:
    return f"{result.speed[row] * RPM.factor:.0f} rpm"


def numbers(result: WarmUpResult, _: Described) -> Iterator[Number]:
    """Yield the largest axial load over speed, for each bearing."""
    for k, name in enumerate(result.bearing):
        yield from each_speed(result, "load", "N", result.largest_load[:, k], part=name)


def accuracy(result: WarmUpResult) -> list[str]:
    """Return the line of the error of temperatures by time steps, at speeds solved to the end."""
    if np.isnan(result.error):
        return []
    where = " at speeds computed to the end of the run" * any(result.ending)
    return [f"temperatures over time within {max(result.error, 0.001):.2g} K{where}"]


def warnings(result: WarmUpResult) -> Iterator[str]:
    """Yield warnings of early ends, long steps, load maxima, fits and missing thermal balance."""
    for row, why in enumerate(result.ending):
        if why and not result.outcome[row]:
            yield graded(Severity.NO_STATE, f"at {_rpm(result, row)} {why}")
    if result.error > ENOUGH:
        yield (
            f"the shortest time steps still change temperatures by {result.error:.2g} K, and "
            "loads with them: take a shorter duration"
        )
    yield from _overshoot(result)
    yield from _loose_rings(result)
    yield from _yielding_rings(result)
    yield from _unbalanced(result)
    yield from _still_warming(result)


def _unbalanced(result: WarmUpResult) -> Iterator[str]:
    """Yield warnings of speeds solved to the end that have no thermal balance."""
    for row, why in enumerate(result.unbalanced):
        if why and not result.ending[row]:
            yield (
                f"no thermal balance, {why}; the first {in_words(result.ended[row])} do not show "
                "it, take a longer duration"
            )


def _still_warming(result: WarmUpResult) -> Iterator[str]:
    """Yield a warning of the load farthest from balance at the end, or else the temperature."""
    end, steady = result.axial_load[:, -1], result.steady_load
    ratio = _share(np.abs(end - steady), np.fmax(np.abs(end), np.abs(steady)))
    if ratio.max(initial=0.0) > EARLY:
        row, k = (int(place) for place in np.unravel_index(int(ratio.argmax()), ratio.shape))
        what = f"{end[row, k]:.0f} N at {_rpm(result, row)}, {steady[row, k]:.0f} N in balance"
    else:
        values, balance = (np.stack(each) for each in zip(*_parts(result).values(), strict=True))
        end = values[:, :, -1]
        remaining, rise = np.abs(balance - end), np.abs(balance - values[:, :, 0])
        ratio = np.where(remaining > ENOUGH, _share(remaining, rise), 0.0)
        if ratio.max(initial=0.0) <= EARLY:
            return
        part, row, k = (int(place) for place in np.unravel_index(int(ratio.argmax()), ratio.shape))
        what = (
            f"{[*_parts(result)][part]} {end[part, row, k]:.0f} °C at {_rpm(result, row)}, "
            f"{balance[part, row, k]:.0f} °C in balance"
        )
        if remaining[part, row, k] < rise[part, row, k]:
            what += f", {100.0 * ratio[part, row, k]:.0f} % of the change remaining"
    yield (
        f"bearing {result.bearing[k]} is still warming up at the end: {what}; take a longer "
        "duration"
    )


def _overshoot(result: WarmUpResult) -> Iterator[str]:
    """Yield a warning of load maxima during warm-up above those at the end."""
    rows = np.arange(len(result.speed))
    last = [_last(result, int(row)) for row in rows]
    end = np.where(np.array(result.ending)[:, None] == "", result.axial_load[rows, last], np.nan)
    warm = np.fmax(np.abs(end), np.abs(result.steady_load))
    share = _share(result.largest_load, np.where(np.isnan(result.steady_load), np.nan, warm))
    above = share > OVERSHOOT
    if not above.any():
        return
    worst = np.where(above, result.largest_load, 0.0)
    row, k = (int(place) for place in np.unravel_index(int(worst.argmax()), worst.shape))
    others = [name for j, name in enumerate(result.bearing) if j != k and above[:, j].any()]
    also = f" (also, to a lesser extent, {', '.join(others)})" if others else ""
    yield (
        f"bearing {result.bearing[k]} carries {result.largest_load[row, k]:.0f} N axially "
        f"{in_words(result.largest_time[row, k])} after the start at {_rpm(result, row)}, "
        f"{share[row, k]:.2g} times that of the warm spindle{also}: pressure, friction and life "
        "are worse there than in the steady state; warm it up at lower speeds, or use springs"
    )


@of_severity(Severity.LOAD)
def _loose_rings(result: WarmUpResult) -> Iterator[str]:
    """Yield a warning of the inner rings, and one of the outer rings, that lose their fit on the
    way: that which is loose longest, with the others."""
    for ring, pressure, part in (
        ("inner", result.inner_fit_pressure, "shaft"),
        ("outer", result.outer_fit_pressure, "housing"),
    ):
        loose = pressure <= 0.0  # not where it is NaN
        first, last = loose.argmax(axis=1), loose.shape[1] - 1 - loose[:, ::-1].argmax(axis=1)
        length = np.where(loose.any(axis=1), result.time[last] - result.time[first], -1.0)
        if length.max(initial=-1.0) < 0.0:
            continue
        row, k = (int(place) for place in np.unravel_index(int(length.argmax()), length.shape))
        begin, end = (in_words(result.time[at[row, k]]) for at in (first, last))
        others = [
            name for j, name in enumerate(result.bearing) if j != k and (length[:, j] >= 0.0).any()
        ]
        also = f" (as do those of {', '.join(others)}, for no longer)" if others else ""
        on = last[row, k] == _last(result, row)
        span = begin if begin == end else f"{begin} to {end}"
        when = f"from {begin} after the start on" if on else f"{span} after the start"
        yield (
            f"bearing {result.bearing[k]}: the fit of its {ring} ring loosens during "
            f"warm-up, {when} at {_rpm(result, row)}{also}; there the ring expands without the "
            f"{part}: raise its interference, or warm it up at lower speeds"
        )


@of_severity(Severity.LOAD)
def _yielding_rings(result: WarmUpResult) -> Iterator[str]:
    """Yield a warning of the inner ring that its fit stresses most, where it yields."""
    stress = np.nan_to_num(result.ring_stress)
    if stress.max(initial=0.0) <= YIELD:
        return
    row, at, k = (int(place) for place in np.unravel_index(int(stress.argmax()), stress.shape))
    yield (
        f"bearing {result.bearing[k]}: its inner ring yields under its fit during warm-up, Tresca "
        f"stress {stress[row, at, k] / 1e6:.0f} MPa {in_words(result.time[at])} after the "
        f"start at {_rpm(result, row)}, allowed {YIELD / 1e6:g} MPa; lower the interference"
    )


def _share(part: Array, whole: Array) -> Array:
    """Return the ratio of sizes (…, speeds, bearings); 0 where one is NaN, or ``whole`` is 0."""
    valid = np.isfinite(part) & (whole > 0.0)
    return np.divide(part, whole, out=np.zeros_like(part), where=valid)
