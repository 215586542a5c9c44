"""The numbers of a bearing that the balance of its balls takes, as plain tuples."""

from __future__ import annotations

from typing import NamedTuple

from bearings.geometry import Geometry

EPS = 2.0**-52  # rounding of a number of size 1


class Groove(NamedTuple):
    """One groove: k of Q = k δ^1.5 [N/m^1.5], reach ℓ and axial place of its centre [m]."""

    stiffness: float
    reach: float
    offset: float


class BallConstants(NamedTuple):
    """SI, as in ``bearings.geometry``; ``inner`` and ``outer``: the one or two grooves of a ring.

    Stiffnesses k of a contact of either race and of both in series. ``orbit`` ½ m dm: Fc is that
    times (ω ωm/ω)²; ``nominal``: (ωm/ω)² at equal nominal angles, ((1 − γ cos α)/2)², where all
    hypotheses agree; ``limit`` μ D: the moment that friction holds per load of a race, 0 where it
    is not limited.
    """

    inner: tuple[Groove, ...]
    outer: tuple[Groove, ...]
    inner_stiffness: float
    outer_stiffness: float
    series_stiffness: float
    inner_reach: float
    outer_reach: float
    ball_diameter: float
    size_ratio: float
    race_ratio: float
    centre_radius: float
    inner_conformity: float
    ball_inertia: float
    orbit: float
    nominal: float
    limit: float


def ball_constants(g: Geometry, friction: float | None) -> BallConstants:
    """Of a bearing; without a limit of ``friction`` μ none is set."""
    half = 0.5 * (1.0 - g.size_ratio * g.cosine)
    ki, ko = float(g.inner.stiffness), float(g.outer.stiffness)
    return BallConstants(
        inner=tuple(Groove(ki, g.inner_reach, x) for x in g.inner_offsets),
        outer=tuple(Groove(ko, g.outer_reach, x) for x in g.outer_offsets),
        inner_stiffness=ki,
        outer_stiffness=ko,
        series_stiffness=float(g.series_stiffness),
        inner_reach=g.inner_reach,
        outer_reach=g.outer_reach,
        ball_diameter=g.ball_diameter,
        size_ratio=g.size_ratio,
        race_ratio=float(g.race_ratio),
        centre_radius=g.centre_radius,
        inner_conformity=g.inner_conformity,
        ball_inertia=g.ball_inertia,
        orbit=0.5 * g.ball_mass * g.pitch_diameter,
        nominal=half**2,
        limit=0.0 if friction is None else float(friction) * g.ball_diameter,
    )
