"""The warming in a few lines of text."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from rotordyn.analyses.warm_up.result import ENOUGH, WarmUpResult
from rotordyn.results.described import Described
from rotordyn.results.display import RPM
from rotordyn.results.headline import Number, ends
from rotordyn.results.kinds import Array
from rotordyn.results.text import unbroken

OVERSHOOT = 1.2  # of the load at the end, from which the largest one is worth a word
EARLY = 0.02  # of a load: closer to the steady one than that, it is reached


def summary(result: WarmUpResult) -> list[str]:
    """Axial loads at the start, at most and at the end at the first and the last speed, and the
    hottest part."""
    lines = []
    for row in sorted({0, len(result.speed) - 1}):
        if result.outcome[row]:
            continue
        last, load = _last(result, row), result.axial_load[row]
        most = np.searchsorted(result.time, result.largest_time[row])
        words = ", ".join(
            unbroken(
                f"{name} {load[0, k]:.0f} → {load[most[k], k]:.0f} "
                f"({in_words(result.largest_time[row, k])}) → {load[last, k]:.0f}"
            )
            for k, name in enumerate(result.bearing)
        )
        lines.append(
            f"warm-up    at {result.speed[row] * RPM.factor:.0f} rpm, axial load [N] at the start, "
            f"largest, after {in_words(result.time[last])}: {words}"
        )
        lines.append(f"           {_hottest(result, row)}")
    return lines


def _last(result: WarmUpResult, row: int) -> int:
    return int(np.searchsorted(result.time, result.ended[row]))


def in_words(seconds: float) -> str:
    """A time in words."""
    if seconds < 60.0:
        return f"{seconds:.3g} s"
    return f"{seconds / 60.0:.3g} min" if seconds < 7200.0 else f"{seconds / 3600.0:.3g} h"


def _hottest(result: WarmUpResult, row: int) -> str:
    """The hottest part at a speed, where and when."""
    parts = {
        "balls": result.ball_temperature,
        "inner ring": result.inner_temperature,
        "outer ring": result.outer_temperature,
    }
    part = max(parts, key=lambda name: float(np.nanmax(parts[name][row])))
    values = parts[part][row]
    at, k = np.unravel_index(int(np.nanargmax(values)), values.shape)
    return (
        f"hottest {values[at, k]:.0f} °C, {part} of bearing {result.bearing[k]} after "
        f"{in_words(result.time[at])}"
    )


def numbers(result: WarmUpResult, _: Described) -> Iterator[Number]:
    """Largest axial load at the first and last speed, for each bearing."""
    for k, name in enumerate(result.bearing):
        yield from ends(result, "load", "N", result.largest_load[:, k], part=name)


def accuracy(result: WarmUpResult) -> list[str]:
    """How far the steps of time move temperatures, where they are followed to the end."""
    if np.isnan(result.error):
        return []
    where = " at speeds followed to the end" * any(result.ending)
    return [f"temperatures over time within {max(result.error, 0.001):.2g} K{where}"]


def warnings(result: WarmUpResult) -> Iterator[str]:
    """Where it ends early, steps too long, and loads on the way that the end does not show."""
    for row, why in enumerate(result.ending):
        if why and not result.outcome[row]:
            yield f"at {result.speed[row] * RPM.factor:.0f} rpm {why}"
    if result.error > ENOUGH:
        yield (
            f"the shortest steps of time still move temperatures by {result.error:.2g} K, and "
            "loads with them: take a shorter duration"
        )
    yield from _on_the_way(result)
    end, steady = result.axial_load[:, -1], result.steady_load
    late = _share(np.abs(end - steady), np.fmax(np.abs(end), np.abs(steady)))
    if late.max(initial=0.0) > EARLY:
        row, k = (int(place) for place in np.unravel_index(int(late.argmax()), late.shape))
        yield (
            f"bearing {result.bearing[k]} is still warming up at the end: "
            f"{end[row, k]:.0f} N at {result.speed[row] * RPM.factor:.0f} rpm, "
            f"{steady[row, k]:.0f} N in balance; take a longer duration"
        )


def _on_the_way(result: WarmUpResult) -> Iterator[str]:
    """Loads while the spindle warms up that are larger than those in the end."""
    rows = np.arange(len(result.speed))
    last = [_last(result, int(row)) for row in rows]
    end = np.where(np.array(result.ending)[:, None] == "", result.axial_load[rows, last], np.nan)
    share = _share(result.largest_load, np.fmax(np.abs(end), np.abs(result.steady_load)))
    above = share > OVERSHOOT
    if not above.any():
        return
    worst = np.where(above, result.largest_load, 0.0)
    row, k = (int(place) for place in np.unravel_index(int(worst.argmax()), worst.shape))
    others = [name for j, name in enumerate(result.bearing) if j != k and above[:, j].any()]
    also = f" (so, less, {', '.join(others)})" if others else ""
    yield (
        f"bearing {result.bearing[k]} carries {result.largest_load[row, k]:.0f} N along its axis "
        f"{in_words(result.largest_time[row, k])} after the start at "
        f"{result.speed[row] * RPM.factor:.0f} rpm, {share[row, k]:.2g} times that of the warm "
        f"spindle{also}: pressure, friction and life are worse there than in the steady state; "
        "warm it up at lower speeds, or take springs"
    )


def _share(part: Array, whole: Array) -> Array:
    """Of sizes of loads (speeds, bearings); 0 where one is not known, or there is no load."""
    known = np.isfinite(part) & (whole > 0.0)
    return np.divide(part, whole, out=np.zeros_like(part), where=known)
