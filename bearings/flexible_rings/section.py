"""Quadrilaterals that fill the section of a ring and of what it sits on.

Columns run from the raceway straight to the seat, and on through shaft or housing; the groove is
followed in equal steps of its angle φ, counted from the radial direction through the groove centre,
positive towards +x.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearings.arrays import Array, Index
from bearings.flexible_rings.describe import ElasticRing
from bearings.flexible_rings.outline import outline
from bearings.grooves import Grooves

STEP = math.radians(6.0)  # along the groove
LAYERS, GROWTH = 5, 1.6  # from the raceway to the seat, each thicker than the last
DEEP = 3  # layers of the backing
FIRST, WIDER = 10.0, 1.5  # of the width: the first column beside the ring, and how they widen
SOLID = 0.02  # of the seat's radius: the hole in a solid shaft, without measurable effect


@dataclass(frozen=True, eq=False, slots=True)
class Section:
    """Corners (2, v) [m] (axial, radial), quadrilaterals (4, q), and which (q,) are backing.

    ``arcs``: of every groove, that with its centre at +x first as contacts are counted: corners
    (k,), angles φ there, place of the centre. ``radius`` of the grooves; ``outward`` ±1: sign of
    the radial direction into the material; ``seat``, ``far``: corners on the seat, and at the far
    ends of the backing.
    """

    corners: Array
    quads: NDArray[np.intp]
    backing: NDArray[np.bool_]
    arcs: tuple[tuple[Index, Array, tuple[float, float]], ...]
    radius: float
    outward: float
    seat: Index
    far: Index


def section(grooves: Grooves, ring: ElasticRing, *, inner: bool) -> Section:
    """The section of one ring of a bearing.

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
    corners = body.reshape(-1, 2)
    number = np.arange(len(corners)).reshape(body.shape[:2])
    quads = _quads(number)
    more, grid = _backing(ring, outward, seat[:, 0], number[-1], len(corners))
    corners, beyond = np.concatenate([corners, more]), _quads(grid)
    backing = np.arange(len(quads) + len(beyond)) >= len(quads)
    quads = np.concatenate([quads, beyond])
    on_seat, far = number[-1], np.concatenate([grid[:, 0], grid[:, -1]])
    middle, turned = len(raceway) // 2, len(half)
    first = number[0, middle : middle + turned], half, (-offset, centre)
    second = number[0, middle - turned + 1 : middle + 1], -half[::-1], (offset, centre)
    if offset > 0.0:
        arcs: tuple[tuple[Index, Array, tuple[float, float]], ...] = (second, first)
    else:
        whole = np.concatenate([second[0], first[0][1:]]), np.concatenate([second[1], half[1:]])
        arcs = ((*whole, (0.0, centre)),)
    return Section(
        corners.T, _right_handed(corners, quads).T, backing, arcs, radius, outward, on_seat, far
    )


def _backing(
    ring: ElasticRing, outward: float, seat: Array, taken: Index, count: int
) -> tuple[Array, NDArray[np.intp]]:
    """More corners, from number ``count``, and the grid of all, its first row that of the seat."""
    beside = 0.5 * (ring.length - ring.width)
    x = seat
    columns = 0
    if beside > 1e-6 * ring.width:
        first = ring.width / FIRST
        columns = max(1, math.ceil(math.log1p((WIDER - 1.0) * beside / first) / math.log(WIDER)))
        out = np.cumsum(WIDER ** np.arange(columns))
        out = 0.5 * ring.width + beside * out / out[-1]
        x = np.concatenate([-out[::-1], seat, out])
    start = 0.5 * ring.seat_diameter
    end = 0.5 * ring.backing_diameter
    if outward < 0.0:
        end = max(end, SOLID * start)
    r = np.linspace(start, end, DEEP + 1)
    grid = np.full((DEEP + 1, len(x)), -1, dtype=np.intp)
    grid[0, columns : len(x) - columns] = taken
    new = grid < 0
    grid[new] = count + np.arange(new.sum())
    place = np.stack(np.broadcast_arrays(x, r[:, None]), axis=-1)
    return place[new], grid


def _quads(number: NDArray[np.intp]) -> NDArray[np.intp]:
    sides = (number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1])
    return np.stack([side.ravel() for side in sides], axis=1)


def _right_handed(corners: Array, quads: NDArray[np.intp]) -> NDArray[np.intp]:
    """Quadrilaterals (q, 4) with their corners counter-clockwise."""
    (x, y) = corners[quads].transpose(2, 0, 1)
    area = (x[:, 2] - x[:, 0]) * (y[:, 3] - y[:, 1]) - (x[:, 3] - x[:, 1]) * (y[:, 2] - y[:, 0])
    return np.where((area < 0.0)[:, None], quads[:, ::-1], quads)
