"""How grooves give under the loads of all balls: more unknowns beside the ball centres.

With rigid rings every ball depends on the motion of its ring alone. Rings that deform couple the
balls: at each, a groove is where the ring's motion carries it, and shifted by e, which all contact
loads bring about (``bearings.flexible_rings.compliance``). Once balls are eliminated, that is one
linear equation for the shifts of all balls of a state, and the ring sees balls and shifts as
springs. Where one groove a ring is loaded, only the shift of the inner groove against the outer one
matters to a ball.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bearings.arrays import Array
from bearings.ball.condensed import Condensed
from bearings.ball.plane import Motion
from bearings.ball.potential import both_grooves
from bearings.ball.race import hertz
from bearings.flexible_rings.compliance import Compliance, Pressed
from bearings.flexible_rings.describe import FlexibleRings
from bearings.geometry import Geometry, Groove
from bearings.grooves import Grooves


@dataclass(frozen=True, eq=False, slots=True)
class Compliances:
    """Of both rings of a bearing; None: rigid."""

    inner: Compliance | None
    outer: Compliance | None


@dataclass(frozen=True, eq=False, slots=True)
class Give:
    """Shifts of the inner grooves against the outer ones, linearised with the balls.

    ``still`` (2, s, n) [m]: what they still change by with the ring where it is; ``follow``
    (2, s, n, 5): with the ring's displacement. ``error`` (s,): what they miss, as a force.
    """

    still: Array
    follow: Array
    error: Array


def compliances(grooves: Grooves) -> Compliances | None:
    """Of the rings of a bearing; None where both are rigid."""
    rings = grooves.rings
    if rings is None:
        return None
    from bearings.flexible_rings.computed import compliance  # finite elements, for these alone

    assert isinstance(rings, FlexibleRings)

    return Compliances(
        None if rings.inner is None else compliance(grooves, rings.inner, inner=True),
        None if rings.outer is None else compliance(grooves, rings.outer, inner=False),
    )


def given(
    rings: Compliances,
    c: Geometry,
    centre: Motion,
    x: Array,
    balls: Condensed,
    spread: Array,
    blend: Array,
    *,
    placed: bool,
) -> Give:
    """Shifts where grooves stand at ``centre`` and balls at ``x`` (4, s, n), their own part last.

    ``blend`` (s,): share of the compliance that acts; ``spread`` (2, 5, n): motion of the grooves
    with the ring. ``placed``: balls have places of their own; at rest both contacts are in series.
    """
    inner_way = _flat(x[:2] - np.stack(centre[:2])) if placed else _flat(-np.stack(centre[:2]))
    outer_way = _flat(x[:2]) if placed else -inner_way
    grooves = (c.inner_grooves[0], c.outer_grooves[0]) if placed else (both_grooves(c),) * 2
    inner = _pressed(rings.inner, grooves[0], inner_way, blend)
    outer = _pressed(rings.outer, grooves[1], outer_way, blend)
    states, n = inner_way.shape[:2]
    here = _flat(x[2:])
    pending = np.zeros_like(here)
    if placed:
        # The outward ways are those of the ball: dX − dA to the inner groove, dX to the outer one.
        follow, still = _block(balls.follow), _flat(np.stack(balls.still))
        by_inner, by_outer = np.eye(2) - follow, follow
        pending = _by(inner.slope, still) - _by(outer.slope, still)
        tangent = _through(inner.slope, by_inner) + _through(outer.slope, by_outer)
    else:
        tangent = _square(inner.slope) + _square(outer.slope)
    shift = inner.shift - outer.shift
    missing = shift - here + pending
    moved = np.moveaxis(spread[:2], -1, 0).reshape(2 * n, 5)
    right = np.concatenate([missing.reshape(states, 2 * n, 1), -(tangent @ moved)], axis=2)
    solved = np.linalg.solve(np.eye(2 * n) + tangent, right).reshape(states, n, 2, 6)
    solved = np.moveaxis(solved, 2, 0)
    stiffest = np.abs(_block(balls.tangent[:2])).max(axis=(1, 2, 3))
    error = np.abs(shift - here).max(axis=(1, 2)) * stiffest
    return Give(solved[..., 0], solved[..., 1:], error)


def _pressed(ring: Compliance | None, groove: Groove, way: Array, blend: Array) -> Pressed:
    """Shifts (s, n, 2) and their slope (s, n, 2, n, 2) of the groove of one ring."""
    states, n = way.shape[:2]
    if ring is None:
        return Pressed(np.zeros_like(way), np.zeros((states, n, 2, n, 2)))
    length = np.sqrt((way * way).sum(axis=-1))
    load, slope = hertz(groove.stiffness, np.maximum(length - groove.centre_distance, 0.0))
    each = ring.pressed(*(part[:, :, None] for part in (way, load, slope)))
    return Pressed(
        each.shift[:, :, 0] * blend[:, None, None],
        each.slope[:, :, 0, :, :, 0] * blend[:, None, None, None, None],
    )


def _flat(pair: Array) -> Array:
    """(2, s, n) as (s, n, 2)."""
    return np.moveaxis(pair, 0, 2)


def _block(rows: object) -> Array:
    """Two rows of two entries (s, n) as (s, n, 2, 2)."""
    return np.moveaxis(np.asarray(rows), (0, 1), (2, 3))


def _by(slope: Array, motion: Array) -> Array:
    return np.einsum("sixjy,sjy->six", slope, motion)


def _through(slope: Array, turned: Array) -> Array:
    return _square(np.einsum("sixjy,sjyz->sixjz", slope, turned))


def _square(slope: Array) -> Array:
    states, n = slope.shape[:2]
    return slope.reshape(states, 2 * n, 2 * n)
