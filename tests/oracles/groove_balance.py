"""What a state says of its balls, put into balances written apart from the solver.

Forces of the contact loads at the contact angles, with Fc and Mg of the kinematics from both, must
cancel on every ball and add up to the load of the ring; the segments from the outer groove centres
over the ball to the inner ones, pressed in by what the loads make of Hertz's law, must close.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from tests.oracles.four_point import MICROMETRE, GrooveOracle

Array = NDArray[np.float64]
LEVEL = 1e-12  # cosine of an angle that counts as 90°


class Balanced(NamedTuple):
    """Faults of states (…): of a ball over its bearing's largest contact load or Fc, of the ring
    over the sum of the ball loads or its load, of the geometry [m], of Fc and Mg/D over the same.
    """

    ball: Array
    ring: Array
    gap: Array
    motion: Array


def balanced(oracle: GrooveOracle, state: Any, dynamics: str, shift: float = 0.0) -> Balanced:
    """Recompute a state of any batch shape; ``shift`` [m]: from its zero of δx to the centred."""
    q = np.asarray(state.contact_load)
    ni, b, side = oracle.ni, oracle.drawing, oracle.side
    angle = np.where(q > 0.0, state.contact_angle, 0.0)
    n = np.stack([side * np.sin(angle), np.cos(angle)], axis=-1)
    force = q[..., None] * n
    inner, outer = force[..., :ni, :].sum(-2), force[..., ni:, :].sum(-2)
    fc, mg = np.asarray(state.centrifugal_force), np.asarray(state.gyroscopic_moment)
    qi, qo = np.hypot(*np.moveaxis(inner, -1, 0)), np.hypot(*np.moveaxis(outer, -1, 0))
    ai, ao = np.arctan2(inner[..., 0], inner[..., 1]), np.arctan2(outer[..., 0], outer[..., 1])
    speed = np.asarray(state.speed)[..., None]
    want_fc, want_mg, li, _ = oracle.motion(qi, qo, ai, ao, speed)
    if dynamics == "frozen":
        want_fc, want_mg = oracle.frozen_push(speed) + 0.0 * qi, 0.0 * qi
    ti, to = li * mg / b.ball_diameter, (2.0 - li) * mg / b.ball_diameter
    grip = np.stack([ti * np.cos(ai), -ti * np.sin(ai)], axis=-1)
    ball = inner - outer + grip - np.stack([to * np.cos(ao), -to * np.sin(ao)], axis=-1)
    ball[..., 1] += np.where(q.any(-1), fc, 0.0)
    radial = force[..., :ni, 1]  # friction acts on the line of the resultant
    part = radial / np.where(qi > 0.0, radial.sum(-1), 1.0)[..., None]
    pressed = force[..., :ni, :] + part[..., None] * grip[..., None, :]
    ring = np.einsum("jcak,...jca->...k", oracle.lean, pressed)
    twist = li * b.inner_conformity * mg / (oracle.radius * MICROMETRE)
    ring[..., 3] -= (twist * np.sin(oracle.psi)).sum(-1)
    ring[..., 4] += (twist * np.cos(oracle.psi)).sum(-1)
    load = np.asarray(state.load) / oracle.lever
    size = np.maximum(np.maximum(q.max((-1, -2)), fc.max(-1)), 1e-300)
    total = np.maximum(np.maximum(q[..., :ni].sum((-1, -2)), np.abs(load).max(-1)), size)
    held = qi > 0.0
    apart = np.maximum(np.abs(want_fc - fc), np.abs(want_mg - mg) / b.ball_diameter)
    return Balanced(
        np.abs(ball).max((-1, -2)) / size,
        np.abs(ring - load).max(-1) / total,
        _gap(oracle, q, n, np.asarray(state.displacement) + shift * np.eye(5)[0]),
        np.where(held, apart, 0.0).max(-1) / size,
    )


def _gap(oracle: GrooveOracle, q: Array, n: Array, d: Array) -> Array:
    """How far apart the ball centres lie that the loaded contacts of one ball ask for [m].

    At ±90° a groove goes on straight: its contact says where the ball is along the axis alone, and
    that it is beyond the level of the groove centre.
    """
    ni = oracle.ni
    reach = oracle.free + (q / oracle.k) ** (2.0 / 3.0)
    centre = np.zeros(n.shape)
    centre[..., 0] = oracle.offset
    centre[..., :ni, 1] = oracle.gap
    centre[..., :ni, :] += np.einsum("jcak,...k->...jca", oracle.lean, d / oracle.scale)
    sign = np.where(np.arange(len(oracle.offset)) < ni, -1.0, 1.0)[:, None]
    ball = centre + sign * reach[..., None] * n
    wall = (q > 0.0) & (np.abs(n[..., 1]) < LEVEL)
    loaded = np.stack([q > 0.0, (q > 0.0) & ~wall], axis=-1)
    high = np.where(loaded, ball, -np.inf).max(-2)
    low = np.where(loaded, ball, np.inf).min(-2)
    known = np.isfinite(high[..., 1])  # by a contact that is not straight
    beyond = sign[:, 0] * (centre[..., 1] - np.where(known, low[..., 1], 0.0)[..., None])
    short = np.where(wall & known[..., None], np.maximum(-beyond, 0.0), 0.0).max(-1)
    apart = np.where(np.isfinite(high - low), np.maximum(high - low, 0.0), 0.0).max(-1)
    return np.maximum(apart, short).max(-1) * MICROMETRE
