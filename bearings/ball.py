"""One ball between two grooves: its balance, what it does to the inner ring, and all derivatives.

Arrays are component-first: a plane vector has shape (2, …), axial then radial; ``…`` are balls.
A is the inner groove centre and X the ball centre, both seen from the outer groove centre.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bearings.convex import resting_reaction
from bearings.geometry import Geometry
from bearings.kinematics import (
    HYPOTHESES,
    SHARINGS,
    Angles,
    Partial,
    hybrid,
    masked,
    orbit_and_spin,
    share_hybrid,
)

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, slots=True)
class BallModel:
    """A bearing's constants with the chosen kinematics and sharing of the gyroscopic moment."""

    geometry: Geometry
    hypothesis: Callable[[Angles], Partial]
    sharing: Callable[[Any], tuple[Any, Any]]

    @property
    def weighted(self) -> bool:
        """True where kinematics or sharing depend on the race loads."""
        return self.hypothesis is hybrid or self.sharing is share_hybrid

    @classmethod
    def named(cls, geometry: Geometry, kinematics: str, moment_sharing: str) -> BallModel:
        """Look both names up; KeyError where one is unknown."""
        return cls(geometry, HYPOTHESES[kinematics], SHARINGS[moment_sharing])

    def nominal_centrifugal(self, speed: Array) -> Array:
        """Fc at equal nominal angles, where every hypothesis gives ωm/ω = (1 − γ cos α)/2 [N]."""
        g = self.geometry
        orbit = 0.5 * (1.0 - g.size_ratio * np.cos(g.contact_angle))
        return 0.5 * g.ball_mass * g.pitch_diameter * (orbit * speed) ** 2


@dataclass(frozen=True, eq=False, slots=True)
class Balance:
    """State of balls at given A and X, linearised.

    ``residual`` (2, …) [N]: sum of forces on the ball. ``action`` (3, …): axial force, radial
    force [N] and moment [N·m] of the shaft on the ring through this ball. ``d…_dx`` and ``d…_da``
    are their derivatives by X and A, shape (2 or 3, 2, …).
    """

    residual: Array
    action: Array
    dresidual_dx: Array
    dresidual_da: Array
    daction_dx: Array
    daction_da: Array
    inner_load: Array
    outer_load: Array
    inner_angle: Array
    outer_angle: Array
    centrifugal_force: Array
    gyroscopic_moment: Array
    inner_share: Array


def turning_balance(
    model: BallModel,
    centre: Array,
    ball: Array,
    speed: Array,
    blend: Array,
    *,
    frozen: bool = False,
) -> Balance:
    """Balance of balls on a turning ring (theory: one ball).

    ``blend`` t in [0, 1] leads from the convex problem (Mg = 0, Fc at the nominal angle) to the
    full one; all arguments broadcast against the trailing shape of ``centre`` and ``ball``.
    ``frozen``: the derivatives leave Fc and Mg as they are.
    """
    g = model.geometry
    si, ci, li, so, co, lo = _directions(centre, ball)
    di, do = np.maximum(li - g.inner_reach, 0.0), np.maximum(lo - g.outer_reach, 0.0)
    qi, qi_l = _hertz(g.inner.stiffness, di)
    qo, qo_l = _hertz(g.outer.stiffness, do)
    do_safe = np.where(do > 0.0, do, 1.0)
    weight = g.race_ratio * (di / do_safe) ** 2
    weight_li, weight_lo = 2.0 * g.race_ratio * di / do_safe**2, -2.0 * weight / do_safe
    angles = Angles(si, ci, so, co, g.size_ratio, weight)
    orbit, spin = orbit_and_spin(angles, masked(model.hypothesis(angles), di > 0.0))
    fc, moment, fc_p, moment_p = _inertia_loads(model, orbit, spin, speed, blend)
    share, share_c = model.sharing(weight)
    share, share_c = np.broadcast_to(share, qi.shape), np.broadcast_to(share_c, qi.shape)

    d = g.ball_diameter
    mi, mo = share * moment, (2.0 - share) * moment
    fa, fr = qi * si + mi * ci / d, qi * ci - mi * si / d
    oa, orad = qo * so + mo * co / d, qo * co - mo * so / d
    # rows: fa, fr, outer axial, outer radial, inner moment share, Fc; columns: αi, ℓi, αo, ℓo
    table = np.zeros((6, 4, *qi.shape))

    def inertia(column: int, moment_k: Any, fc_k: Any, share_k: Any) -> None:
        """Derivatives that come from Mg, its sharing, and Fc."""
        mi_k = share * moment_k + share_k * moment
        mo_k = (2.0 - share) * moment_k - share_k * moment
        table[:, column] = mi_k * ci / d, -mi_k * si / d, mo_k * co / d, -mo_k * so / d, mi_k, fc_k

    if not frozen:
        inertia(0, moment_p.by_inner, fc_p.by_inner, 0.0)
        inertia(2, moment_p.by_outer, fc_p.by_outer, 0.0)
    if model.weighted and not frozen:
        for column, slope in ((1, weight_li), (3, weight_lo)):
            inertia(column, moment_p.by_weight * slope, fc_p.by_weight * slope, share_c * slope)
    table[0, 0] += fr
    table[1, 0] -= fa
    table[0, 1] += qi_l * si
    table[1, 1] += qi_l * ci
    table[2, 2] += orad
    table[3, 2] -= oa
    table[2, 3] += qo_l * so
    table[3, 3] += qo_l * co

    by_inner = _chain(table[:, 0], table[:, 1], si, ci, li)
    by_outer = _chain(table[:, 2], table[:, 3], so, co, lo)
    residual_i = by_inner[0:2] - by_inner[2:4]
    residual_o = by_outer[0:2] - by_outer[2:4]
    residual_i[1] += by_inner[5]
    residual_o[1] += by_outer[5]
    action_i, action_o = _action(g, by_inner), _action(g, by_outer)
    return Balance(
        residual=np.stack([fa - oa, fr - orad + fc]),
        action=np.stack([fa, fr, g.centre_radius * fa - g.inner_conformity * mi]),
        dresidual_dx=residual_o - residual_i,
        dresidual_da=residual_i,
        daction_dx=action_o - action_i,
        daction_da=action_i,
        inner_load=qi,
        outer_load=qo,
        inner_angle=np.arctan2(si, ci),
        outer_angle=np.arctan2(so, co),
        centrifugal_force=fc,
        gyroscopic_moment=moment,
        inner_share=share,
    )


def resting_balance(model: BallModel, centre: Array) -> Balance:
    """Balance of balls at rest, the ball centre eliminated."""
    g = model.geometry
    answer = resting_reaction(g, centre)
    load, angle = np.hypot(*answer.force), np.arctan2(centre[0], centre[1])
    zero = np.zeros_like(load)
    nothing = np.zeros((3, 2, *load.shape))
    one = nothing[:2] + np.eye(2).reshape(2, 2, *(1,) * load.ndim)
    moment = g.centre_radius * answer.force[:1]
    return Balance(
        residual=np.zeros_like(answer.force),
        action=np.concatenate([answer.force, moment]),
        dresidual_dx=one,
        dresidual_da=nothing[:2],
        daction_dx=nothing,
        daction_da=np.concatenate([answer.slope, g.centre_radius * answer.slope[:1]]),
        inner_load=load,
        outer_load=load,
        inner_angle=angle,
        outer_angle=angle,
        centrifugal_force=zero,
        gyroscopic_moment=zero,
        inner_share=zero + 1.0,
    )


def _directions(centre: Array, ball: Array) -> tuple[Array, ...]:
    """sin, cos, length towards the inner and the outer contact."""
    inner = centre - ball
    li, lo = np.hypot(inner[0], inner[1]), np.hypot(ball[0], ball[1])
    return inner[0] / li, inner[1] / li, li, ball[0] / lo, ball[1] / lo, lo


def _hertz(stiffness: float, approach: Array) -> tuple[Array, Array]:
    """Load and its slope by the approach."""
    root = np.sqrt(approach)
    return stiffness * approach * root, 1.5 * stiffness * root


def _inertia_loads(
    model: BallModel, orbit: Partial, spin: Partial, speed: Array, blend: Array
) -> tuple[Array, Array, Partial, Partial]:
    """Fc and Mg at ``blend``, and their partial derivatives by αi, αo and C."""
    g = model.geometry
    full = 0.5 * g.ball_mass * g.pitch_diameter * speed**2
    nominal = model.nominal_centrifugal(speed)
    slope = 2.0 * blend * full * orbit.value
    turn = blend * g.ball_inertia * speed**2
    fc = Partial(
        nominal + blend * (full * orbit.value**2 - nominal), *(slope * part for part in orbit[1:])
    )
    moment = Partial(*(turn * part for part in spin))
    return fc.value, moment.value, fc, moment


def _chain(by_angle: Array, by_length: Array, sin: Array, cos: Array, length: Array) -> Array:
    """Derivatives by a plane vector from those by its angle and length: (rows, 2, …)."""
    return np.stack(
        [by_angle * (cos / length) + by_length * sin, by_length * cos - by_angle * (sin / length)],
        axis=1,
    )


def _action(g: Geometry, by_vector: Array) -> Array:
    """Derivatives of (fa, fr, m) from those of (fa, fr, …, inner moment)."""
    moment = g.centre_radius * by_vector[0] - g.inner_conformity * by_vector[4]
    return np.stack([by_vector[0], by_vector[1], moment])
