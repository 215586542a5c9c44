"""Peaks of resonance curves: their places, and samples that do not miss them.

Near a pole the inverse square of an amplitude is a parabola of the frequency, exactly so for one
mode. Three samples give its vertex; samples spread geometrically about a pole give a curve that
looks the same at every width.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from rotordyn.arrays import Array, Indices

GROWTH = 1.5  # of the distance from a pole, from one sample to the next
NARROW = 1e-4  # of the frequency: least distance of samples about an undamped pole
CLOSER = 1e-3  # of an amplitude: a vertex that exceeds it by more is sampled
PLACED = 1e-5  # of its place: a vertex farther from its highest sample is sampled
SAME = 1e-9  # of a place: closer samples are one
DIP = 1e-6  # of an amplitude: maxima with a shallower dip between them are one
ENDLESS = 1e3  # times the sample next to it: no damping limits a higher peak
BENT = 0.2  # of a logarithm: a sample farther off a straight line is not on it
SEEN = 1e-4  # of the largest amplitude of a curve: its curvature where it is less is ignored
NOTHING = 1e-9  # of the largest of all curves: a curve with less is rounding
ROUNDS = 8  # of further samples, at most


def vertex(x: Array, amplitude: Array) -> tuple[Array, Array]:
    """Return abscissa and height (…) of the parabola of 1/``amplitude``² through samples (…, 3).

    ``x`` ascends and the middle sample is the highest. The height is infinite where the parabola is
    negative at its vertex: these samples show no damping.
    """
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        y = 1.0 / (amplitude / amplitude[..., 1:2]) ** 2
        left, right = x[..., 1] - x[..., 0], x[..., 2] - x[..., 1]
        down, up = (y[..., 1] - y[..., 0]) / left, (y[..., 2] - y[..., 1]) / right
        bend = (up - down) / (left + right)
        slope = (down * right + up * left) / (left + right)
        shift = np.where(bend > 0.0, -0.5 * slope / np.where(bend > 0.0, bend, 1.0), 0.0)
        shift = np.nan_to_num(np.clip(shift, -left, right))
        least = y[..., 1] + shift * (slope + shift * bend)
        height = np.where(least > 0.0, amplitude[..., 1] / np.sqrt(np.abs(least)), np.inf)
    return x[..., 1] + shift, height


def spread(centre: float, width: float, low: float, high: float) -> Array:
    """Return samples from ``low`` to ``high`` about a peak of half ``width``, with growing
    distances; none at its centre, where an undamped response is unbounded."""
    width = max(width, NARROW * abs(centre))
    reach = max(centre - low, high - centre, width)
    steps = np.arange(max(int(np.log(reach / width) / np.log(GROWTH)) + 2, 1))
    distance = width * np.concatenate([[0.25, 0.5, 0.75], GROWTH**steps])
    points = np.concatenate([centre - distance[::-1], centre + distance])
    return np.asarray(points[(points >= low) & (points <= high)])


def spread_between(
    centres: Array, widths: Array, low: float, high: float, *, least: int = 0
) -> Array:
    """Return samples about several peaks, each up to half-way to the next one, and ``least``
    uniform ones in addition."""
    order = np.argsort(centres)
    centres, widths = centres[order], widths[order]
    middles = [low, *(0.5 * (centres[1:] + centres[:-1])).tolist(), high]
    parts = [np.linspace(low, high, least)] if least else []
    for k, (centre, width) in enumerate(zip(centres.tolist(), widths.tolist(), strict=True)):
        parts.append(spread(centre, width, middles[k], middles[k + 1]))
    return np.unique(np.concatenate([np.zeros(0), *parts]))


def tops(amplitude: Array) -> Indices:
    """Return the indices of local maxima of a curve (n,), the highest of those without a ``DIP``
    between them; without its ends, and the ends beside gaps of NaN."""
    before, after = np.append(np.nan, amplitude[:-1]), np.append(amplitude[1:], np.nan)
    kept: list[int] = []
    # an end counts at first, so that rounding on the way up to it makes no peak
    for place in np.flatnonzero(~(amplitude <= before) & ~(amplitude < after)).tolist():
        lower = min(amplitude[kept[-1]], amplitude[place]) if kept else np.inf
        if kept and amplitude[kept[-1] : place].min() > (1.0 - DIP) * lower:
            kept[-1] = max(kept[-1], place, key=lambda k: float(amplitude[k]))
        else:
            kept.append(place)
    inner = (amplitude > before) & (amplitude >= after)
    return np.array([place for place in kept if inner[place]], dtype=int)


def sampled(
    x: Array,
    solve: Callable[[Array], Sequence[NDArray[np.generic]]],
    amplitude: Callable[[Sequence[NDArray[np.generic]]], Array],
) -> tuple[Array, list[NDArray[np.generic]]]:
    """Return samples ``x`` (n,) and what ``solve`` gives for them (n, …), with more at every peak
    and wherever curves bend.

    ``amplitude`` of that (n, curves): the vertex of each of their peaks is sampled until it is the
    highest sample, and intervals are halved until their logarithms are nearly straight from sample
    to sample.
    """
    values = list(solve(x))
    for _ in range(ROUNDS):
        curves = amplitude(values)
        further = _new(np.concatenate([_vertices(x, curves), _bent(x, curves)]), x)
        if not further.size:
            break
        new_values = solve(further)
        x = np.concatenate([x, further])
        order = np.argsort(x)
        x = x[order]
        values = [np.concatenate([a, b])[order] for a, b in zip(values, new_values, strict=True)]
    return x, values


def _bent(x: Array, amplitude: Array) -> Array:
    """Return midpoints of the intervals at samples off the straight line of their neighbours."""
    high = np.fmax.reduce(amplitude, axis=0, initial=0.0)
    significant = (amplitude > SEEN * high) & (high > NOTHING * high.max(initial=0.0))
    level = np.log(np.where(significant & np.isfinite(amplitude), amplitude, np.nan))
    before, after = np.diff(x)[:-1, None], np.diff(x)[1:, None]
    straight = (level[:-2] * after + level[2:] * before) / (before + after)
    wide = np.minimum(before, after) > 2.0 * NARROW * np.abs(x[1:-1, None])
    at = 1 + np.flatnonzero((wide & (np.abs(level[1:-1] - straight) > BENT)).any(axis=1))
    return np.unique(0.5 * np.concatenate([x[at] + x[at - 1], x[at] + x[at + 1]]))


def _vertices(x: Array, amplitude: Array) -> Array:
    """Return vertices that are higher than their highest sample, or beside it."""
    parts = [np.zeros(0)]
    for curve in amplitude.T:
        top = tops(curve)
        three = top[:, None] + np.arange(-1, 2)
        at, height = vertex(x[three], curve[three])
        higher = height > (1.0 + CLOSER) * curve[top]
        beside = np.abs(at - x[top]) > PLACED * np.abs(at)
        parts.append(at[(higher | beside) & (height < ENDLESS * curve[top])])
    return np.concatenate(parts)


def _new(wanted: Array, x: Array) -> Array:
    """Return those ``wanted`` places that differ from one another and from samples ``x`` (n,)."""
    wanted = np.unique(wanted)
    apart = np.diff(wanted, prepend=-np.inf) > SAME * np.abs(wanted)
    known = np.abs(wanted[:, None] - x).min(axis=1) <= SAME * np.abs(wanted)
    return np.asarray(wanted[apart & ~known])
