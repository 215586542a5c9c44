"""Peaks of responses between the poles of the machine and its grid, and curves that show them.

Every pole that swings in the band, and every highest value of the grid, starts a search; the vertex
of 1/|H|² is solved for. The curves of slices are sampled about the poles, ever farther apart.
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

_BESIDE = (0.35, 0.75, 1.5, 3.0, 6.0, 12.0, 30.0)
ABOUT = np.array([-each for each in _BESIDE[::-1]] + [0.0, *_BESIDE])  # half widths from a pole
MIDDLE = len(_BESIDE)  # of these: the pole itself
UNDAMPED = 1e-9  # of the frequency: a pole so near to the axis has no damping
SAME = 1e-10  # of a frequency: samples nearer to one another are one
TOGETHER = 6  # pairs
ROUNDS = 5  # of parabolas
ROUNDING = 1e-7  # of a response: differences below that mean nothing
NEAR = 3.0  # half widths of a mode from its frequency: what peaks there is its own
NOTHING = 1e-10  # of what a mode would give at its own places: less is rounding


class Poles(NamedTuple):
    """Of a subsystem, as responses see them: ``centre`` [Hz] and half ``width`` [Hz] (s, k), NaN of
    those that do not swing in the band; ``size`` (s, k): response of a mode to a force, both where
    it moves most; ``undamped`` (s, k)."""

    centre: Array
    width: Array
    size: Array
    undamped: Flags

    def at(self, row: int) -> tuple[Array, Array]:
        """Centres and widths at one speed."""
        known = np.isfinite(self.centre[row])
        return self.centre[row, known], self.width[row, known]

    def damping_at(self, peak: Array) -> Array:
        """Damping ratio of the mode that makes each ``peak`` [Hz] (s, pairs, n), 0 without damping,
        NaN where no mode is near."""
        if not self.centre.shape[1]:
            return np.full(peak.shape, np.nan)
        away = np.abs(peak[..., None] - self.centre[:, None, None]) / self.width[:, None, None]
        away = np.nan_to_num(away, nan=np.inf)
        mode = away.argmin(axis=-1)
        ratio = np.where(self.undamped, 0.0, self.width / np.hypot(self.width, self.centre))
        at = np.take_along_axis(ratio[:, None], mode.reshape(len(ratio), 1, -1), axis=-1)
        return np.where(away.min(axis=-1) <= NEAR, at.reshape(peak.shape), np.nan)


class Peaks(NamedTuple):
    """``frequency`` [Hz] and ``value`` (s, pairs, n), ascending, NaN where there are fewer; an
    undamped mode has an infinite one."""

    frequency: Array
    value: Complex


def frequency_of(motions: FreeMotions, *, turning: bool) -> Array:
    """Frequencies [Hz] of the poles (s, k), as a frame that is ``turning`` with the shaft sees
    them."""
    omega = motions.pole.imag
    if turning and motions.whirling:
        omega = np.abs(motions.whirl * omega - motions.linear.speed[:, None])
    return np.asarray(omega / (2.0 * math.pi))


def poles_of(motions: FreeMotions, low: float, high: float, *, turning: bool) -> Poles:
    """Poles between ``low`` and ``high`` [Hz]; ``turning``: seen from the shaft."""
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
    """Every peak of ``grid`` (s, pairs, f) at ``frequency`` (f,) and between.

    ``within``: responses of some pairs at frequencies (s, n) of every speed's own. ``reach``
    (pairs,): by how much, times f to a ``power``, they are larger than ``Poles.size``.
    """
    speeds, pairs, _ = grid.shape
    about = poles.centre[..., None] + poles.width[..., None] * ABOUT
    with np.errstate(invalid="ignore"):
        about[(about <= frequency[0]) | (about >= frequency[-1])] = np.nan
    sampled = about.copy()
    sampled[..., MIDDLE][poles.undamped] = np.nan
    near = within(sampled.reshape(speeds, -1), slice(None))
    near = near.reshape(speeds, pairs, *about.shape[1:])
    x = np.concatenate(
        [np.broadcast_to(frequency, (speeds, len(frequency))), about.reshape(speeds, -1)], axis=1
    )
    order = np.argsort(x, axis=1, kind="stable")  # what is NaN comes last
    x = np.take_along_axis(x, order, axis=1)
    with np.errstate(invalid="ignore"):
        x[:, 1:][np.diff(x, axis=1) <= SAME * x[:, 1:]] = np.nan  # modes of one frequency
    again = np.argsort(x, axis=1, kind="stable")
    x, order = (np.take_along_axis(each, again, axis=1) for each in (x, order))
    around = _without_poles(near, poles).reshape(speeds, pairs, -1)
    samples = np.concatenate([np.abs(grid), around], axis=-1)
    samples = np.take_along_axis(samples, order[:, None], axis=-1)
    samples[np.broadcast_to(np.isnan(x)[:, None], samples.shape)] = np.nan
    parts: list[tuple[slice, Peaks]] = []
    for first in range(0, pairs, TOGETHER):
        part = slice(first, first + TOGETHER)
        peak, value = _solved(partial(_each_own, within, part), *_starts(x, samples[:, part]))
        floor = NOTHING * reach[part][None, :, None] * peak**power * _largest(poles, peak)
        kept = Peaks(np.where(np.abs(value) > floor, peak, np.nan), value)
        parts.append((part, _ascending(kept)))
    return joined(parts, (speeds, pairs))


def _each_own(within: Callable[[Array, slice], Complex], part: slice, frequency: Array) -> Complex:
    """Responses of some pairs, each at frequencies of its own (s, pairs, m)."""
    speeds, pairs, many = frequency.shape
    every = within(frequency.reshape(speeds, -1), part).reshape(speeds, pairs, pairs, many)
    return np.asarray(np.moveaxis(np.diagonal(every, axis1=1, axis2=2), -1, 1))


def curve_at(poles: list[tuple[Array, Array]], frequency: Array, peaks: Array) -> Array:
    """Frequencies [Hz] of a curve: those of the grid, of its ``peaks``, and about ``poles``."""
    centre, width = (np.concatenate([np.zeros(0), *parts]) for parts in zip(*poles, strict=True))
    about = spread_between(centre, width, float(frequency[0]), float(frequency[-1]))
    return np.unique(np.concatenate([frequency, about, peaks]))


def _without_poles(near: Complex, poles: Poles) -> Array:
    """Amplitudes about poles (s, pairs, k, about): on an undamped one infinite where it is in the
    response, else the mean of both sides.

    What r / (f − f0) of the pole differs by on its two sides grows towards it, and the rest, which
    is smooth there, differs ever less.
    """
    level = np.abs(near)
    with np.errstate(invalid="ignore"):
        close, far = (np.abs(near[..., MIDDLE + k] - near[..., MIDDLE - k]) for k in (1, 2))
        beside = np.abs(near[..., MIDDLE - 1] + near[..., MIDDLE + 1]) / 2.0
        endless = (close > far) & (close > ROUNDING * beside)
        level[..., MIDDLE] = np.where(
            poles.undamped[:, None], np.where(endless, np.inf, beside), level[..., MIDDLE]
        )
    return level


def _starts(x: Array, samples: Array) -> tuple[Array, Array]:
    """Highest of the ``samples`` (s, pairs, n) at ``x`` (s, n) between two others: places and
    values (s, pairs, m, 3), NaN where there are fewer."""
    with np.errstate(invalid="ignore"):
        inner = samples[..., 1:-1]
        high = (inner > samples[..., :-2]) & (inner >= samples[..., 2:])
    most = int(high.sum(axis=-1).max(initial=0))
    order = np.argsort(~high, axis=-1, kind="stable")[..., :most]
    there = np.take_along_axis(high, order, axis=-1)[..., None]
    place = order[..., None] + np.arange(3)
    three = np.take_along_axis(x[:, None, None], place, axis=-1)
    values = np.take_along_axis(samples[:, :, None], place, axis=-1)
    return np.where(there, three, np.nan), np.where(there, values, np.nan)


def _solved(at: Callable[[Array], Complex], x: Array, size: Array) -> tuple[Array, Complex]:
    """Frequency and value of the peak between three samples each (s, pairs, m, 3); NaN of none."""
    endless = np.isinf(size[..., 1])
    for _ in range(ROUNDS):
        new = np.where(endless, np.nan, vertex(x, size)[0])
        four = np.concatenate([x, new[..., None]], axis=-1)
        sizes = np.concatenate([size, np.abs(at(new))[..., None]], axis=-1)
        order = np.argsort(four, axis=-1, kind="stable")
        four, sizes = (np.take_along_axis(a, order, axis=-1) for a in (four, sizes))
        first = np.where(sizes[..., 2] > sizes[..., 1], 1, 0)[..., None] + np.arange(3)
        moved, sizes = (np.take_along_axis(a, first, axis=-1) for a in (four, sizes))
        x, size = (np.where(endless[..., None], a, b) for a, b in ((x, moved), (size, sizes)))
    peak = x[..., 1]
    value = at(np.where(endless, np.nan, peak))
    return peak, np.where(endless, complex(np.inf), value)


def _largest(poles: Poles, x: Array) -> Array:
    """Largest response at ``x`` (s, pairs, m) of any mode to a force, both where it moves most."""
    centre, width, size = (each[:, None, None] for each in (poles.centre, poles.width, poles.size))
    with np.errstate(invalid="ignore"):
        height = size / np.hypot(1.0, (x[..., None] - centre) / width)
    return np.asarray(np.nan_to_num(height).max(axis=-1, initial=0.0))


def _ascending(peaks: Peaks) -> Peaks:
    """Without places (s, pairs, m) that no speed and pair needs."""
    most = int(np.isfinite(peaks.frequency).sum(axis=-1).max(initial=0))
    order = np.argsort(peaks.frequency, axis=-1, kind="stable")[..., :most]
    at = np.take_along_axis(peaks.frequency, order, axis=-1)
    value = np.take_along_axis(peaks.value, order, axis=-1)
    return Peaks(at, np.where(np.isnan(at), complex(np.nan, np.nan), value))


def joined(parts: Sequence[tuple[Any, Peaks]], shape: tuple[int, int]) -> Peaks:
    """Peaks of several groups of pairs, by the places of the pairs among all: ``shape`` (speeds,
    pairs)."""
    most = max((peaks.frequency.shape[-1] for _, peaks in parts), default=0)
    at = np.full((*shape, most), np.nan)
    value = np.full((*shape, most), complex(np.nan, np.nan))
    for pairs, peaks in parts:
        at[:, pairs, : peaks.frequency.shape[-1]] = peaks.frequency
        value[:, pairs, : peaks.frequency.shape[-1]] = peaks.value
    return Peaks(at, value)
