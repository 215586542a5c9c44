"""The compliance of a ring, computed from its section.

Each ball presses its ring over a short line across the raceway; the deflection of the groove is the
mean normal displacement over that line, weighted like the load: the compliance is symmetric. From
the displacement at the place of a load, the part in Hertz's law is subtracted, that of a half-space
under the same load; the difference converges with few harmonics and a coarse section.

Neighbours of a ring are loaded as it is. Together they store the energy ½ Σ_rs Q C_rs Q, of which
half of the mutual part of two rings counts for each: C = C_00 + ½ Σ_r (C_0r + C_r0).
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
DENSE, SPARSER = 8, 0.25  # number of first harmonics, all solved; step of others over their number
SMOOTH = 3  # first harmonic of the spline: lower ones move the ring as a whole, or make it oval
ANGLES = 9  # points along a groove (Chebyshev)


@lru_cache(maxsize=64)
def compliance(grooves: Grooves, ring: ElasticRing, *, inner: bool) -> Compliance:
    """Compute the compliance of one ring of a bearing with these grooves, once in a process.

    Raises
    ------
    InvalidBearing : as ``outline``
    """
    opposite = tuple(sorted(other._replace(distance=-other.distance) for other in ring.neighbours))
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
    orientations = (False, *(other.mirrored for other in ring.neighbours))
    patches = np.array(
        [
            [
                _down(phi, shape) @ body.patch(k, arc, phi, half_length)
                for arc, phi in _places(angles, mirrored=mirrored)
            ]
            for k, mirrored in enumerate(orientations)
        ]
    )
    z = grooves.balls
    highest = _highest(z)
    responses = _by_harmonics(body, patches, highest)
    around = np.cos(2.0 * np.pi * np.outer(np.arange(z), np.arange(highest + 1)) / z)
    apart = np.einsum("dn,nab->dab", around, responses)
    hertz_part = [
        half_space(grooves.ring_material, half_length, (highest + 0.5) / _radius(shape, arc, phi))
        for arc, phi in _places(angles)
    ]
    local = (np.diagonal(apart[0]) - hertz_part).reshape(angles.shape)
    steps = np.abs(np.subtract.outer(np.arange(z), np.arange(z)))
    between, groove = apart[steps], np.repeat(np.arange(len(angles)), ANGLES)
    balls = np.arange(z)
    between[balls, balls] *= groove[:, None] != groove
    return Compliance(between, local, limits, cardinal, shape.outward)


def _highest(balls: int) -> int:
    """Highest harmonic of the series: midway between two multiples of the number of balls, from
    ``HARMONICS`` on. For equal loads at all balls only multiples contribute, each for all of
    its neighbours, and the half-space is subtracted up to there."""
    turns = math.ceil((HARMONICS + 0.5) / balls - 0.5)
    return round(balls * (turns + 0.5) - 0.5)


def _by_harmonics(body: Body, loads: Array, highest: int) -> Array:
    """Responses (n, k, k) to ``loads`` (rings, k, unknowns), equal on all rings, by all harmonics
    up to the ``highest``. The higher ones are smooth over n: some are solved, the others are
    interpolated by a spline (3e-4 of a deflection)."""
    solved = [*range(DENSE)]
    while solved[-1] < highest:
        solved.append(min(highest, solved[-1] + max(1, round(SPARSER * solved[-1]))))
    sampled = body.responses(loads, solved).sum(axis=1)
    sampled = 0.5 * (sampled + sampled.swapaxes(-1, -2))
    responses = np.empty((highest + 1, *sampled.shape[1:]))
    responses[:SMOOTH] = sampled[:SMOOTH]
    spline = CubicSpline(solved[SMOOTH:], sampled[SMOOTH:])
    responses[SMOOTH:] = spline(np.arange(SMOOTH, highest + 1))
    return responses


def _places(angles: Array, *, mirrored: bool = False) -> list[tuple[int, float]]:
    """List arc and φ of the computed angles (g, k), or those of their mirror images."""
    if mirrored:
        return [(len(angles) - 1 - arc, -phi) for arc, phi in _places(angles)]
    return [(arc, float(phi)) for arc, row in enumerate(angles) for phi in row]


def _down(phi: float, shape: Section) -> Array:
    """Unit vector into the material, normal to the groove, (axial, radial)."""
    return np.array([np.sin(phi), shape.outward * np.cos(phi)])


def _radius(shape: Section, arc: int, phi: float) -> float:
    """Radius of a point of a groove about the axis [m]."""
    return float(shape.arcs[0][arc][2][1] + shape.outward * shape.radius * np.cos(phi))
