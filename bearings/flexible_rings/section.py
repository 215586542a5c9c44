"""Mesh of quadrilaterals of the section of a ring, its neighbours, and their backing.

Columns run from the raceway straight to the seat, and on through shaft or housing; the groove is
followed in equal steps of its angle φ, counted from the radial direction through the groove centre,
positive towards +x.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from bearings.arrays import Array, Flags, Index
from bearings.flexible_rings.describe import TOUCHING, ElasticRing
from bearings.flexible_rings.outline import outline
from bearings.grooves import Grooves

STEP = math.radians(6.0)  # along the groove
LAYERS, GROWTH = 5, 1.6  # from the raceway to the seat, each thicker than the last
DEEP = 3  # layers of the backing
FIRST, WIDER = 10.0, 1.5  # ring width over first column beside the ring; growth of the columns
SOLID = 0.02  # hole in a solid shaft over the seat's radius, without measurable effect

Arc = tuple[Index, Array, tuple[float, float]]


@dataclass(frozen=True, eq=False, slots=True)
class Section:
    """Mesh: corners (2, v) [m] (axial, radial), quadrilaterals (4, q), which (q,) are backing.

    ``rings``: middles of the rings along the axis [m], as ``ElasticRing.places``; ``arcs``: for
    each ring its grooves in the order of the contacts, that with its centre at +x first: corners
    (k,), angles φ there, place of the centre. ``radius`` of the grooves; ``outward`` ±1: sign of
    the radial direction into the material; ``half_width`` of a ring; ``far``: ends of the backing
    along the axis.
    """

    corners: Array
    quads: Index
    backing: Flags
    rings: tuple[float, ...]
    arcs: tuple[tuple[Arc, ...], ...]
    radius: float
    outward: float
    half_width: float
    far: tuple[float, float]


def section(grooves: Grooves, ring: ElasticRing, *, inner: bool) -> Section:
    """Mesh the section of one ring of a bearing.

    Raises
    ------
    InvalidBearing : as ``outline``
    """
    radius, centre, offset, low, top, outward = outline(grooves, ring, inner=inner)
    half = np.linspace(low, top, max(3, math.ceil((top - low) / STEP)) + 1)
    right = np.stack(
        [radius * np.sin(half) - offset, centre + outward * radius * np.cos(half)], axis=1
    )
    flat = np.linspace(right[-1, 0], 0.5 * ring.width, 3)[1:]
    right = np.concatenate([right, np.stack([flat, np.full(2, right[-1, 1])], axis=1)])
    raceway = np.concatenate([(right * [-1.0, 1.0])[:0:-1], right])
    even = np.linspace(-0.5 * ring.width, 0.5 * ring.width, len(raceway))
    seat = np.stack(
        [0.5 * (even + raceway[:, 0]), np.full(len(even), 0.5 * ring.seat_diameter)], axis=1
    )
    depth = np.concatenate([[0.0], np.cumsum(GROWTH ** np.arange(LAYERS))])
    share = (depth / depth[-1])[:, None, None]
    body = (1.0 - share) * raceway + share * seat
    single = np.arange(body.shape[0] * body.shape[1]).reshape(body.shape[:2])
    corners = np.concatenate([(body + np.array([x, 0.0])).reshape(-1, 2) for x in ring.places])
    numbers = [single + k * single.size for k in range(len(ring.places))]
    in_row = np.argsort(ring.places)
    for left, right in pairwise(in_row):
        if ring.places[right] - ring.places[left] < (1.0 + TOUCHING) * ring.width:
            numbers[right][-1, 0] = numbers[left][-1, -1]  # both share one corner of the seat
    rings = np.concatenate([_quads(number) for number in numbers])
    grid, added = _backing(ring, outward, [numbers[k][-1] for k in in_row], corners)
    corners, beyond = np.concatenate([corners, added]), _quads(grid)
    backing = np.arange(len(rings) + len(beyond)) >= len(rings)
    quads = np.concatenate([rings, beyond])
    used, place_of = np.unique(quads, return_inverse=True)  # corners that two rings share are one
    corners, quads = corners[used], place_of.reshape(quads.shape)
    middle, count = len(raceway) // 2, len(half)
    arcs = []
    for number, place in zip(numbers, ring.places, strict=True):
        along = np.searchsorted(used, number[0])
        first = along[middle : middle + count], half, (place - offset, centre)
        second = along[middle - count + 1 : middle + 1], -half[::-1], (place + offset, centre)
        joined = np.append(second[0], first[0][1:]), np.append(second[1], half[1:]), (place, centre)
        arcs.append((second, first) if offset > 0.0 else (joined,))
    return Section(
        corners.T,
        _right_handed(corners, quads).T,
        backing,
        ring.places,
        tuple(arcs),
        radius,
        outward,
        0.5 * ring.width,
        (float(corners[:, 0].min()), float(corners[:, 0].max())),
    )


def _backing(
    ring: ElasticRing, outward: float, seats: list[Index], corners: Array
) -> tuple[Index, Array]:
    """Grid of all corners of the backing, its first row with the ``seats`` of the rings from left
    to right, and the places of the new corners, whose numbers continue those of ``corners``."""
    first = ring.width / FIRST
    overhang = 0.5 * (ring.length - ring.width)
    left, right = corners[seats[0][0], 0], corners[seats[-1][-1], 0]
    top = [np.full(0, -1), seats[0]]
    x = [left - _graded(overhang, first)[::-1], corners[seats[0], 0]]
    for left_seat, right_seat in pairwise(seats):
        start, end = corners[left_seat[-1], 0], corners[right_seat[0], 0]
        half = _graded(0.5 * (end - start), first)
        between = np.concatenate([start + half, end - half[-2::-1]])
        shared = int(left_seat[-1] == right_seat[0])
        x += [between, corners[right_seat[shared:], 0]]
        top += [np.full(len(between), -1), right_seat[shared:]]
    x.append(right + _graded(overhang, first))
    top[0] = np.full(len(x[0]), -1)
    top.append(np.full(len(x[-1]), -1))
    along = np.concatenate(x)
    start = 0.5 * ring.seat_diameter
    end = 0.5 * ring.backing_diameter
    if outward < 0.0:
        end = max(end, SOLID * start)
    r = np.linspace(start, end, DEEP + 1)
    grid = np.full((DEEP + 1, len(along)), -1, dtype=np.intp)
    grid[0] = np.concatenate(top)
    new = grid < 0
    grid[new] = len(corners) + np.arange(new.sum())
    place = np.stack(np.broadcast_arrays(along, r[:, None]), axis=-1)
    return grid, place[new]


def _graded(length: float, first: float) -> Array:
    """Ends (k,) of columns along a ``length``, each ``WIDER`` times the last; none if it is 0."""
    if length < TOUCHING * first:
        return np.empty(0)
    columns = max(1, math.ceil(math.log1p((WIDER - 1.0) * length / first) / math.log(WIDER)))
    ends = np.cumsum(WIDER ** np.arange(columns))
    return np.asarray(length * ends / ends[-1])


def _quads(number: Index) -> Index:
    sides = (number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1])
    return np.stack([side.ravel() for side in sides], axis=1)


def _right_handed(corners: Array, quads: Index) -> Index:
    """Order the corners of quadrilaterals (q, 4) counter-clockwise."""
    (x, y) = corners[quads].transpose(2, 0, 1)
    area = (x[:, 2] - x[:, 0]) * (y[:, 3] - y[:, 1]) - (x[:, 3] - x[:, 1]) * (y[:, 2] - y[:, 0])
    return np.where((area < 0.0)[:, None], quads[:, ::-1], quads)
