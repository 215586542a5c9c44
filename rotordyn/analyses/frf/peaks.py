"""Peaks of responses at and between the frequencies of a grid, and curves that show them.

Responses are sampled on the grid and about every oscillating pole in the band; each local maximum
starts a search for the vertex of 1/|H|². Slices are sampled about poles in growing steps.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from rotordyn.arrays import Array, Complex, Flags
from rotordyn.equation.free_motion import FreeMotions
from rotordyn.numerics.peaks import NARROW, spread_between, vertex

_OFFSETS = (0.35, 0.75, 1.5, 3.0, 6.0, 12.0, 30.0)
ABOUT = np.array([-x for x in _OFFSETS[::-1]] + [0.0, *_OFFSETS])  # half widths from a pole
MIDDLE = len(_OFFSETS)  # index of the pole itself
UNDAMPED = 1e-9  # of |pole|: a smaller real part is no damping
SAME = 1e-10  # of a frequency: closer samples are merged
TOGETHER = 6  # pairs solved at once
ROUNDS = 5  # iterations of the parabola
ROUNDING = 1e-7  # of a response: smaller differences are no more than rounding
NEAR = 3.0  # half widths from the frequency of a mode: a peak within them is its own
NOTHING = 1e-10  # of the response of a mode where it moves most: less is rounding


class Poles(NamedTuple):
    """Poles of a subsystem: ``centre`` [Hz] and half ``width`` [Hz] (s, k) of their resonances, NaN
    of those that do not oscillate in the band; ``size`` (s, k): response of a mode to a force, both
    where it moves most; ``undamped`` (s, k)."""

    centre: Array
    width: Array
    size: Array
    undamped: Flags

    def at(self, row: int) -> tuple[Array, Array]:
        """Centres and half widths at one speed."""
        finite = np.isfinite(self.centre[row])
        return self.centre[row, finite], self.width[row, finite]

    def damping_at(self, peak: Array) -> Array:
        """Damping ratio of the mode that makes each ``peak`` [Hz] (s, pairs, n), 0 without damping,
        NaN where no mode lies within ``NEAR`` half widths."""
        if not self.centre.shape[1]:
            return np.full(peak.shape, np.nan)
        distance = np.abs(peak[..., None] - self.centre[:, None, None]) / self.width[:, None, None]
        distance = np.nan_to_num(distance, nan=np.inf)
        mode = distance.argmin(axis=-1)
        ratio = np.where(self.undamped, 0.0, self.width / np.hypot(self.width, self.centre))
        damping = np.take_along_axis(ratio[:, None], mode.reshape(len(ratio), 1, -1), axis=-1)
        return np.where(distance.min(axis=-1) <= NEAR, damping.reshape(peak.shape), np.nan)


class Peaks(NamedTuple):
    """``frequency`` [Hz] and ``value`` (s, pairs, n), ascending, NaN where there are fewer; an
    undamped mode has an infinite one."""

    frequency: Array
    value: Complex


def frequency_of(motions: FreeMotions, *, turning: bool) -> Array:
    """Frequencies [Hz] of the poles (s, k); ``turning``: in the frame that rotates with the
    shaft."""
    omega = motions.turning_frequency if turning else motions.pole.imag
    return np.asarray(omega / (2.0 * math.pi))


def poles_of(motions: FreeMotions, low: float, high: float, *, turning: bool) -> Poles:
    """Poles between ``low`` and ``high`` [Hz]; ``turning``: in the frame of the shaft."""
    pole, hertz = motions.pole, frequency_of(motions, turning=turning)
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        inside = (hertz > low) & (hertz < high) & (pole.imag > 0.0)
        undamped = np.abs(pole.real) <= UNDAMPED * np.abs(pole)
        width = np.where(undamped, NARROW * hertz, np.abs(pole.real) / (2.0 * math.pi))
        largest = np.abs(motions.vector).max(axis=1) * np.abs(motions.left).max(axis=2)
        size = largest / (2.0 * math.pi * width)
    keep = np.argsort(~inside, axis=1, kind="stable")[:, : int(inside.sum(axis=1).max(initial=0))]
    kept = [np.take_along_axis(a, keep, axis=1) for a in (hertz, width, size, undamped, inside)]
    hertz, width, size, undamped, inside = kept
    hertz, width, size = (np.where(inside, a, np.nan) for a in (hertz, width, size))
    return Poles(hertz, width, size, undamped & inside)


def peaks_of(
    within: Callable[[Array, slice], Complex],
    poles: Poles,
    frequency: Array,
    grid: Complex,
    reach: Array,
    power: int,
) -> Peaks:
    """Solve for every peak of responses ``grid`` (s, pairs, f) at ``frequency`` (f,) and between.

    ``within``: responses of a slice of the pairs at frequencies (s, n), a row per speed. ``reach``
    (pairs,): factor that, times f to a ``power``, scales ``Poles.size`` to responses of a pair.
    """
    speeds, pairs, _ = grid.shape
    about = poles.centre[..., None] + poles.width[..., None] * ABOUT
    with np.errstate(invalid="ignore"):
        about[(about <= frequency[0]) | (about >= frequency[-1])] = np.nan
    sampled = about.copy()
    sampled[..., MIDDLE][poles.undamped] = np.nan
    pole_responses = within(sampled.reshape(speeds, -1), slice(None))
    pole_responses = pole_responses.reshape(speeds, pairs, *about.shape[1:])
    x = np.concatenate(
        [np.broadcast_to(frequency, (speeds, len(frequency))), about.reshape(speeds, -1)], axis=1
    )
    order = np.argsort(x, axis=1, kind="stable")  # NaN comes last
    x = np.take_along_axis(x, order, axis=1)
    with np.errstate(invalid="ignore"):
        x[:, 1:][np.diff(x, axis=1) <= SAME * x[:, 1:]] = np.nan  # modes of one frequency
    by_frequency = np.argsort(x, axis=1, kind="stable")
    x, order = (np.take_along_axis(array, by_frequency, axis=1) for array in (x, order))
    pole_amplitudes = _amplitudes_about(pole_responses, poles).reshape(speeds, pairs, -1)
    samples = np.concatenate([np.abs(grid), pole_amplitudes], axis=-1)
    samples = np.take_along_axis(samples, order[:, None], axis=-1)
    samples[np.broadcast_to(np.isnan(x)[:, None], samples.shape)] = np.nan
    parts: list[tuple[slice, Peaks]] = []
    for first in range(0, pairs, TOGETHER):
        part = slice(first, first + TOGETHER)
        peak, value = _solved(partial(_by_pair, within, part), *_maxima(x, samples[:, part]))
        floor = NOTHING * reach[part][None, :, None] * peak**power * _largest(poles, peak)
        significant = Peaks(np.where(np.abs(value) > floor, peak, np.nan), value)
        parts.append((part, _ascending(significant)))
    return joined(parts, (speeds, pairs))


def _by_pair(within: Callable[[Array, slice], Complex], part: slice, frequency: Array) -> Complex:
    """Responses of some pairs at frequencies (s, pairs, m) that differ between pairs."""
    speeds, pairs, count = frequency.shape
    all_pairs = within(frequency.reshape(speeds, -1), part).reshape(speeds, pairs, pairs, count)
    return np.asarray(np.moveaxis(np.diagonal(all_pairs, axis1=1, axis2=2), -1, 1))


def curve_at(poles: list[tuple[Array, Array]], frequency: Array, peaks: Array) -> Array:
    """Frequencies [Hz] of a curve: those of the grid, of its ``peaks``, and about ``poles``
    (centres and half widths)."""
    centre, width = (np.concatenate([np.zeros(0), *parts]) for parts in zip(*poles, strict=True))
    about = spread_between(centre, width, float(frequency[0]), float(frequency[-1]))
    return np.unique(np.concatenate([frequency, about, peaks]))


def _amplitudes_about(values: Complex, poles: Poles) -> Array:
    """Amplitudes about poles (s, pairs, k, about): on an undamped one infinite where the pole takes
    part in the response, else the mean of both sides.

    The difference of r / (f − f0) between both sides of the pole grows towards it; that of the
    remainder, which is smooth there, decreases.
    """
    level = np.abs(values)
    with np.errstate(invalid="ignore"):
        close, far = (np.abs(values[..., MIDDLE + k] - values[..., MIDDLE - k]) for k in (1, 2))
        mean = np.abs(values[..., MIDDLE - 1] + values[..., MIDDLE + 1]) / 2.0
        unbounded = (close > far) & (close > ROUNDING * mean)
        level[..., MIDDLE] = np.where(
            poles.undamped[:, None], np.where(unbounded, np.inf, mean), level[..., MIDDLE]
        )
    return level


def _maxima(x: Array, samples: Array) -> tuple[Array, Array]:
    """Local maxima of ``samples`` (s, pairs, n) at ``x`` (s, n), each with its neighbours:
    abscissae and values (s, pairs, m, 3), NaN where there are fewer."""
    with np.errstate(invalid="ignore"):
        inner = samples[..., 1:-1]
        is_top = (inner > samples[..., :-2]) & (inner >= samples[..., 2:])
    count = int(is_top.sum(axis=-1).max(initial=0))
    order = np.argsort(~is_top, axis=-1, kind="stable")[..., :count]
    exists = np.take_along_axis(is_top, order, axis=-1)[..., None]
    place = order[..., None] + np.arange(3)
    abscissae = np.take_along_axis(x[:, None, None], place, axis=-1)
    values = np.take_along_axis(samples[:, :, None], place, axis=-1)
    return np.where(exists, abscissae, np.nan), np.where(exists, values, np.nan)


def _solved(at: Callable[[Array], Complex], x: Array, size: Array) -> tuple[Array, Complex]:
    """Solve for the peak between every three samples (s, pairs, m, 3): frequency and value, NaN
    without one."""
    unbounded = np.isinf(size[..., 1])
    for _ in range(ROUNDS):
        trial = np.where(unbounded, np.nan, vertex(x, size)[0])
        four = np.concatenate([x, trial[..., None]], axis=-1)
        sizes = np.concatenate([size, np.abs(at(trial))[..., None]], axis=-1)
        order = np.argsort(four, axis=-1, kind="stable")
        four, sizes = (np.take_along_axis(a, order, axis=-1) for a in (four, sizes))
        first = np.where(sizes[..., 2] > sizes[..., 1], 1, 0)[..., None] + np.arange(3)
        bracket, sizes = (np.take_along_axis(a, first, axis=-1) for a in (four, sizes))
        x, size = (np.where(unbounded[..., None], a, b) for a, b in ((x, bracket), (size, sizes)))
    peak = x[..., 1]
    value = at(np.where(unbounded, np.nan, peak))
    return peak, np.where(unbounded, complex(np.inf), value)


def _largest(poles: Poles, x: Array) -> Array:
    """Largest response at ``x`` (s, pairs, m) of a mode to a force, both where it moves most."""
    centre, width, size = (
        array[:, None, None] for array in (poles.centre, poles.width, poles.size)
    )
    with np.errstate(invalid="ignore"):
        height = size / np.hypot(1.0, (x[..., None] - centre) / width)
    return np.asarray(np.nan_to_num(height).max(axis=-1, initial=0.0))


def _ascending(peaks: Peaks) -> Peaks:
    """Sort peaks by frequency; drop entries (s, pairs, m) that no speed and pair needs."""
    count = int(np.isfinite(peaks.frequency).sum(axis=-1).max(initial=0))
    order = np.argsort(peaks.frequency, axis=-1, kind="stable")[..., :count]
    frequency = np.take_along_axis(peaks.frequency, order, axis=-1)
    value = np.take_along_axis(peaks.value, order, axis=-1)
    return Peaks(frequency, np.where(np.isnan(frequency), complex(np.nan, np.nan), value))


def joined(parts: Sequence[tuple[Any, Peaks]], shape: tuple[int, int]) -> Peaks:
    """Join the peaks of groups of pairs, each given with the indices of its pairs; ``shape``:
    (speeds, pairs) of the whole."""
    count = max((peaks.frequency.shape[-1] for _, peaks in parts), default=0)
    frequency = np.full((*shape, count), np.nan)
    value = np.full((*shape, count), complex(np.nan, np.nan))
    for pairs, peaks in parts:
        frequency[:, pairs, : peaks.frequency.shape[-1]] = peaks.frequency
        value[:, pairs, : peaks.frequency.shape[-1]] = peaks.value
    return Peaks(frequency, value)
