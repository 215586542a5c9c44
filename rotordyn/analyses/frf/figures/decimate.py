"""Decimation of curves that keeps every peak."""

from __future__ import annotations

import numpy as np

from rotordyn.arrays import Array


def peak_bins(values: Array, coordinate: Array, edges: Array) -> Array:
    """Largest of ``values`` (…, n) in each of the bins between ``edges``, shape (…, bins).

    ``coordinate`` (n) ascends. A bin without a point takes the value interpolated at its middle, so
    coarse data stay continuous. NaN values stay NaN.
    """
    first = np.searchsorted(coordinate, edges[:-1], side="left")
    count = np.searchsorted(coordinate, edges[1:], side="left") - first
    middle = (edges[:-1] + edges[1:]) / 2.0
    reduced = _interpolated(values, coordinate, middle)
    occupied = np.flatnonzero(count)
    if occupied.size:
        stop = first[occupied[-1]] + count[occupied[-1]]
        reduced[..., occupied] = np.maximum.reduceat(values[..., :stop], first[occupied], axis=-1)
    return reduced


def nearest(values: Array, coordinate: Array, wanted: Array) -> Array:
    """Rows of ``values`` (n, …) whose ``coordinate`` is nearest to each of ``wanted``."""
    right = np.clip(np.searchsorted(coordinate, wanted), 1, max(coordinate.size - 1, 1))
    right = np.minimum(right, coordinate.size - 1)
    left = np.maximum(right - 1, 0)
    closer = np.abs(wanted - coordinate[left]) <= np.abs(coordinate[right] - wanted)
    return np.asarray(values[np.where(closer, left, right)])


def _interpolated(values: Array, coordinate: Array, wanted: Array) -> Array:
    if coordinate.size == 1:
        return np.repeat(values, wanted.size, axis=-1)
    right = np.clip(np.searchsorted(coordinate, wanted), 1, coordinate.size - 1)
    left = right - 1
    share = (wanted - coordinate[left]) / (coordinate[right] - coordinate[left])
    share = np.clip(share, 0.0, 1.0)
    return np.asarray(values[..., left] * (1.0 - share) + values[..., right] * share)
