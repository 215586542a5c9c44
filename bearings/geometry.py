"""Constants derived from a bearing's description: grooves, contacts, ball mass.

Computed once a bearing: plain numbers in tuples, which the compiled solver takes as they are.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from bearings.arrays import Array, Index
from bearings.contact.hertz import HertzContact, contact
from bearings.grooves import STEEP, WIDEST, Grooves


class Groove(NamedTuple):
    """One groove: k of Q = k δ^1.5 [N/m^1.5], distance ℓ of its centre
    from that of a ball that just touches, and axial place of its centre [m]. ``along``, ``rise``:
    axial and radial shift of that centre by the deformation of the ring.

    ``walls``: sides (−1, +1) on which the groove continues straight from 90°, where it presses a
    ball along the axis alone; () where displacement counts from touching, a full circle. A tuple,
    since its length is known when a function is compiled: the circle costs no branch.
    """

    stiffness: float
    centre_distance: float
    offset: float
    along: float
    rise: float
    walls: tuple[float, ...]


class Geometry(NamedTuple):
    """Derived constants of one bearing (SI); symbols as in the theory page.

    ``inner``, ``outer``: contacts of the races; ``inner_grooves``, ``outer_grooves``: the one or
    two grooves of a ring; ``series_stiffness`` k of both contacts in series. ``free_distance`` BD
    between unloaded groove centres; ``inner_centre_distance``, ``outer_centre_distance``: of the
    ball centre to each groove centre when it just touches; ``centre_radius`` Ri and
    ``outer_centre_radius`` Ro of the circles of inner and outer groove centres; ``size_ratio``
    γ = D/dm; ``race_ratio`` c in C = c (δi/δo)², the weight of the two races in the hybrid
    kinematics. ``orbital_factor`` ½ m dm: Fc is that times (ω ωm/ω)²;
    ``nominal_orbit_ratio_squared``: (ωm/ω)² at equal nominal angles, ((1 − γ cos α)/2)², where all
    hypotheses agree.
    """

    ball_diameter: float
    pitch_diameter: float
    balls: int
    free_angle: float
    inner: HertzContact
    outer: HertzContact
    inner_grooves: tuple[Groove, ...]
    outer_grooves: tuple[Groove, ...]
    series_stiffness: float
    free_distance: float
    radial_gap: float
    touching: bool
    both_ways: bool
    by_side: bool
    inner_centre_distance: float
    outer_centre_distance: float
    centre_radius: float
    outer_centre_radius: float
    inner_conformity: float
    outer_conformity: float
    size_ratio: float
    race_ratio: float
    ball_mass: float
    ball_inertia: float
    orbital_factor: float
    nominal_orbit_ratio_squared: float

    @property
    def single(self) -> bool:
        """Whether a ball has one contact a race."""
        return len(self.inner_grooves) == len(self.outer_grooves) == 1

    @property
    def rings(self) -> tuple[slice, slice]:
        """Places of the inner and of the outer ring among the grooves."""
        split = len(self.inner_grooves)
        return slice(split), slice(split, None)

    @property
    def races(self) -> tuple[slice, slice]:
        """Places of the inner and of the outer race among the contacts of a ball in results."""
        split = 2 if self.by_side else 1
        return slice(split), slice(split, None)

    @property
    def groove_of(self) -> Index:
        """Place of the groove of each contact in results (contacts,)."""
        inner, outer = len(self.inner_grooves), len(self.outer_grooves)
        if not self.by_side:
            return np.arange(2)
        return np.array([0, inner - 1, inner, inner + outer - 1])

    @property
    def sides(self) -> Array:
        """Sign of the axial direction in which the angle of a contact is positive (contacts,)."""
        return np.array([1.0, -1.0, -1.0, 1.0] if self.by_side else [1.0, 1.0])

    def by_contact(self, inner: Any, outer: Any) -> Array:
        """Take ``inner`` at contacts of the inner race, ``outer`` at others: (…, contacts)."""
        return np.where(np.arange(len(self.sides)) < self.races[0].stop, inner, outer)


@lru_cache(maxsize=256)
def geometry(bearing: Grooves) -> Geometry:
    """Derived constants of a bearing with these grooves."""
    diameter, pitch, gap = bearing.ball_diameter, bearing.pitch_diameter, bearing.radial_gap
    inner_f, outer_f = bearing.inner_conformity, bearing.outer_conformity
    mass = bearing.ball_material.density * math.pi * diameter**3 / 6.0
    inner, outer = _race_contact(bearing, inner_f, +1.0), _race_contact(bearing, outer_f, -1.0)
    inner_reach, outer_reach = (inner_f - 0.5) * diameter, (outer_f - 0.5) * diameter
    inner_centres, outer_centres = bearing.centre_radii
    walls = () if bearing.touching else (-1.0, 1.0)
    size_ratio = diameter / pitch
    return Geometry(
        ball_diameter=diameter,
        pitch_diameter=pitch,
        balls=bearing.balls,
        free_angle=bearing.free_angle,
        inner=inner,
        outer=outer,
        inner_grooves=tuple(
            Groove(inner.stiffness, inner_reach, x, 0.0, 0.0, walls) for x in bearing.inner_offsets
        ),
        outer_grooves=tuple(
            Groove(outer.stiffness, outer_reach, x, 0.0, 0.0, walls) for x in bearing.outer_offsets
        ),
        series_stiffness=(inner.stiffness ** (-2 / 3) + outer.stiffness ** (-2 / 3)) ** -1.5,
        free_distance=bearing.free_distance,
        radial_gap=gap,
        touching=bearing.touching,
        both_ways=bearing.both_ways,
        by_side=bearing.by_side,
        inner_centre_distance=inner_reach,
        outer_centre_distance=outer_reach,
        centre_radius=inner_centres,
        outer_centre_radius=outer_centres,
        inner_conformity=inner_f,
        outer_conformity=outer_f,
        size_ratio=size_ratio,
        race_ratio=_race_weight(inner) / _race_weight(outer),
        ball_mass=mass,
        ball_inertia=mass * diameter**2 / 10.0,
        orbital_factor=0.5 * mass * pitch,
        nominal_orbit_ratio_squared=(0.5 * (1.0 - size_ratio * math.cos(bearing.free_angle))) ** 2,
    )


def acting(g: Geometry, dynamics: str) -> Geometry:
    """Set the inertia of rotation of the balls to zero for "centrifugal" (Fc alone), their orbital
    factor for "gyroscopic" (Mg alone), and neither for other ``dynamics``."""
    if dynamics == "centrifugal":
        return g._replace(ball_inertia=0.0)
    return g._replace(orbital_factor=0.0) if dynamics == "gyroscopic" else g


def frozen_force(g: Geometry, squared: Any) -> Any:
    """Fc of a ball on its orbit at the free contact angle, at ω² = ``squared`` [N]."""
    return g.orbital_factor * g.nominal_orbit_ratio_squared * squared


def groove_origin(g: Geometry, static_growth: Array, growth: Array) -> Array:
    """Middle of the inner groove (2, …) at zero displacement, relative to that of the outer one.

    Counted from touching, its axial part is zeroed with the STATIC growth; counted from the centre
    it is 0. The radial part has the growth at speed. NaN where growth leaves no contact angle,
    or opens the grooves beyond ``WIDEST``.
    """
    radial = g.radial_gap + growth
    if not g.touching:
        open_ = np.minimum(radial, g.radial_gap + static_growth) < WIDEST * g.free_distance
        return np.where(open_, np.nan, np.stack([np.zeros_like(radial), radial]))
    cosine = np.cos(g.free_angle) + static_growth / g.free_distance
    possible = np.abs(cosine) <= 1.0
    least = WIDEST if g.free_angle <= STEEP else WIDEST - 1.0
    possible &= radial >= least * g.free_distance
    axial = g.free_distance * np.sqrt(np.where(possible, 1.0 - cosine**2, np.nan))
    return np.stack([axial, radial])


def _race_contact(bearing: Grooves, conformity: float, side: float) -> HertzContact:
    """Ball on one race; ``side`` +1 inner (convex along the rolling direction), −1 outer."""
    ball = 2.0 / bearing.ball_diameter
    gamma = bearing.ball_diameter * math.cos(bearing.free_angle) / bearing.pitch_diameter
    rolling = side * ball * gamma / (1.0 - side * gamma)
    groove = -1.0 / (conformity * bearing.ball_diameter)
    total = 2.0 * ball + rolling + groove
    compliance = bearing.ball_material.contact_compliance + bearing.ring_material.contact_compliance
    return contact(total, (rolling - groove) / total, compliance)


def _race_weight(race: HertzContact) -> float:
    """Q a E of a race over δ²: Q a E = k^(4/3) a₁ E δ², a₁ the major semi-axis at unit load."""
    return race.stiffness ** (4.0 / 3.0) * race.semi_axis_major * race.second_integral
