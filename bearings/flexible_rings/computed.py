"""The compliance of a ring, computed from its section.

Each ball presses its ring over a short line across the raceway, and the groove gives there by the
mean normal displacement over that line, weighted like the load: the compliance is symmetric. Of
what a load does at its own place, the part is taken out that Hertz's law counts already, the
displacement of a half-space under the same load; the difference converges with few harmonics and a
coarse section.

Neighbours of a ring are loaded as it is. All of them hold the energy ½ Σ_rs Q C_rs Q, of which half
of what two do to one another counts for each: C = C_00 + ½ Σ_r (C_0r + C_r0).
"""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np
from scipy.interpolate import CubicSpline

from bearings.arrays import Array
from bearings.flexible_rings.compliance import Compliance
from bearings.flexible_rings.describe import ElasticRing
from bearings.flexible_rings.half_space import half_space
from bearings.flexible_rings.harmonics import Body
from bearings.flexible_rings.outline import PATCH
from bearings.flexible_rings.section import Section, section
from bearings.grooves import Grooves

HARMONICS = 40
DENSE, SPARSER = 8, 0.25  # the first so many are all solved, then every quarter of their number
SMOOTH = 3  # first harmonic of the spline: lower ones move the ring as a whole, or make it oval
ANGLES = 9  # points along a groove (Chebyshev)


@lru_cache(maxsize=64)
def compliance(grooves: Grooves, ring: ElasticRing, *, inner: bool) -> Compliance:
    """Of one ring of a bearing with such grooves; computed once in a process.

    Raises
    ------
    InvalidBearing : as ``outline``
    """
    opposite = tuple(sorted(each._replace(distance=-each.distance) for each in ring.neighbours))
    if opposite > ring.neighbours:  # front and rear of a set are images of one another
        return compliance(grooves, replace(ring, neighbours=opposite), inner=inner).mirrored()
    shape = section(grooves, ring, inner=inner)
    body = Body(shape, grooves.ring_material, ring.backing_material, held=ring.ends == "clamped")
    half_length = PATCH * grooves.ball_diameter
    margin = half_length / shape.radius
    points = np.cos(np.pi * (np.arange(ANGLES) + 0.5) / ANGLES)
    cardinal = np.zeros((3, ANGLES, ANGLES))
    cardinal[0] = np.linalg.inv(np.polynomial.chebyshev.chebvander(points, ANGLES - 1))
    for order in (1, 2):
        cardinal[order, :-order] = np.polynomial.chebyshev.chebder(cardinal[0], order)
    limits = np.array([(at[0] + margin, at[-1] - margin) for _, at, _ in shape.arcs[0]])
    angles = 0.5 * (limits.sum(axis=1)[:, None] + np.diff(limits, axis=1) * points)
    ways = (False, *(each.mirrored for each in ring.neighbours))
    patches = np.array(
        [
            [
                _down(phi, shape) @ body.patch(k, arc, phi, half_length)
                for arc, phi in _places(angles, mirrored=mirrored)
            ]
            for k, mirrored in enumerate(ways)
        ]
    )
    z = grooves.balls
    highest = _highest(z)
    each = _by_harmonics(body, patches, highest)
    around = np.cos(2.0 * np.pi * np.outer(np.arange(z), np.arange(highest + 1)) / z)
    apart = np.einsum("dn,nab->dab", around, each)
    counted = [
        half_space(grooves.ring_material, half_length, (highest + 0.5) / _radius(shape, arc, phi))
        for arc, phi in _places(angles)
    ]
    own = (np.diagonal(apart[0]) - counted).reshape(angles.shape)
    steps = np.abs(np.subtract.outer(np.arange(z), np.arange(z)))
    between, groove = apart[steps], np.repeat(np.arange(len(angles)), ANGLES)
    every = np.arange(z)
    between[every, every] *= groove[:, None] != groove
    return Compliance(between, own, limits, cardinal, shape.outward)


def _highest(balls: int) -> int:
    """Where the series ends: midway between two multiples of the number of balls, from
    ``HARMONICS`` on. Of loads that are alike at all balls multiples alone count, each for all of
    its neighbours, and the half-space is subtracted up to there."""
    turns = math.ceil((HARMONICS + 0.5) / balls - 0.5)
    return round(balls * (turns + 0.5) - 0.5)


def _by_harmonics(body: Body, loads: Array, highest: int) -> Array:
    """Responses (n, k, k) to ``loads`` (rings, k, unknowns), alike on all rings, by all harmonics
    up to the ``highest``. The higher ones are ever smoother over n: some are solved, the others lie
    on a spline (3e-4 of a deflection)."""
    solved = [*range(DENSE)]
    while solved[-1] < highest:
        solved.append(min(highest, solved[-1] + max(1, round(SPARSER * solved[-1]))))
    known = body.responses(loads, solved).sum(axis=1)
    known = 0.5 * (known + known.swapaxes(-1, -2))
    found = np.empty((highest + 1, *known.shape[1:]))
    found[:SMOOTH] = known[:SMOOTH]
    spline = CubicSpline(solved[SMOOTH:], known[SMOOTH:])
    found[SMOOTH:] = spline(np.arange(SMOOTH, highest + 1))
    return found


def _places(angles: Array, *, mirrored: bool = False) -> list[tuple[int, float]]:
    """Arc and φ of the known angles (g, k); of those at the same places in a mirror."""
    if mirrored:
        return [(len(angles) - 1 - arc, -phi) for arc, phi in _places(angles)]
    return [(arc, float(phi)) for arc, row in enumerate(angles) for phi in row]


def _down(phi: float, shape: Section) -> Array:
    """Into the material, normal to the groove, axial and radial."""
    return np.array([np.sin(phi), shape.outward * np.cos(phi)])


def _radius(shape: Section, arc: int, phi: float) -> float:
    """Of the circle around the axis on which a place of a groove lies [m]."""
    return float(shape.arcs[0][arc][2][1] + shape.outward * shape.radius * np.cos(phi))
