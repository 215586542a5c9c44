"""The equations to solve: states under given loads or displacements."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from bearings.arrays import Array, Flags, Index
from bearings.ball.law import Law
from bearings.ball.laws import Laws
from bearings.ball.plane import Pair
from bearings.ball.race import faced
from bearings.flexible_rings.compliance import Compliance
from bearings.flexible_rings.describe import FlexibleRings
from bearings.geometry import Geometry, groove_origin
from bearings.grooves import Grooves
from bearings.ring.assembly import Assembly, full_assembly
from bearings.ring.operation import Operation
from bearings.ring.tolerances import SLOW

Compliances = tuple[Compliance | None, Compliance | None]  # of inner and outer ring; None: rigid


@dataclass(frozen=True, eq=False)
class Problem:
    """States to solve: all at rest or all turning.

    ``origin`` (2, s): A at zero displacement; ``speed`` (s,) [rad/s]; ``load`` (s, 5) is given on
    the DOF where ``free`` (5,) is true, the displacement on the others. ``loose``: the
    stiffness may be singular; the shortest step is taken. ``compliances``: of rings that
    deform. They couple the balls, and a ball has more unknowns than X: the shift of the inner
    groove against the outer one, or of every groove where a ring has two.
    """

    geometry: Geometry
    law: Law | Laws
    assembly: Assembly
    origin: Array
    speed: Array
    load: Array
    free: Flags
    turning: bool
    loose: bool = False
    compliances: Compliances | None = None

    @classmethod
    def of(cls, o: Operation, assembly: Callable[[Geometry], Assembly]) -> Problem:
        """Build from all operating points, taken as turning; ``assembly`` selects the balls."""
        g = o.geometry
        origin = groove_origin(g, o.static_growth, o.growth)
        rings = compliances(o.grooves)
        chosen = assembly(g)
        if rings is not None and chosen.balls > 1:  # no mirror images
            chosen = full_assembly(g)
        states = (origin, o.speed, o.load, o.free)
        return cls(g, o.law, chosen, *states, turning=True, compliances=rings)

    @property
    def unknowns(self) -> int:
        """Unknowns of a ball: its place, and with rings that deform the shifts of its grooves."""
        g = self.geometry
        if self.compliances is None:
            return 2
        return 4 if g.single else 2 + 2 * (len(g.inner_grooves) + len(g.outer_grooves))

    def centres(self, displacement: Array, ball: Array | None = None) -> Array:
        """A (m, s, n) at a displacement (s, 5); m is 3 with two inner grooves, else 2.

        ``ball`` (u, s, n): its shift of the inner groove is added; None: as of rigid rings.
        """
        centres = self.assembly.centres(self.origin, displacement)
        if ball is not None and len(ball) == 4:
            centres[:2] += ball[2:]
        return centres

    def shifted(self, ball: Array) -> Geometry:
        """Geometry with the grooves shifted by ``ball`` (u, s, n) where a ring has two."""
        g = self.geometry
        if len(ball) <= 4:
            return g
        grooves = [*g.inner_grooves, *g.outer_grooves]
        shifted: Any = [
            groove._replace(along=axial, rise=radial)
            for groove, axial, radial in zip(grooves, ball[2::2], ball[3::2], strict=True)
        ]
        inner = len(g.inner_grooves)
        return g._replace(inner_grooves=(*shifted[:inner],), outer_grooves=(*shifted[inner:],))

    def faced(self, displacement: Array, ball: Array) -> tuple[Pair, Pair]:
        """Vectors along which balls (2, s, n) face the middles of outer and inner groove."""
        return faced(self.geometry, tuple(self.centres(displacement, ball)), (ball[0], ball[1]))

    @property
    def placed(self) -> bool:
        """Whether ball centres are unknowns: not at rest between one groove a ring."""
        return self.turning or not self.geometry.single

    @property
    def full(self) -> float:
        """Blend of the full problem: 1, or 0 where the first stage is the full problem."""
        return 1.0 if self.varying or self.compliances is not None else 0.0

    @property
    def varying(self) -> bool:
        """Whether Fc and Mg follow the angles: not at rest, nor frozen."""
        return self.turning and self.law.dynamics != "frozen"

    @property
    def squared(self) -> Array:
        """ω² (s,), 0 for states at rest."""
        return self.speed**2 if self.turning else 0.0 * self.speed

    def parts(self, chosen: Flags) -> Iterator[tuple[Index, Problem]]:
        """Yield those of the ``chosen`` states (s,) that turn, and those at rest: indices, and
        the problem of these alone."""
        turn = turns(self.geometry, self.speed)
        for turning in (True, False):
            index = np.flatnonzero(chosen & (turn == turning))
            if index.size:
                yield index, replace(self.take(index), turning=turning)

    def take(self, index: Index) -> Problem:
        """Select states by index."""
        return replace(
            self,
            law=self.law.take(index),
            origin=self.origin[:, index],
            speed=self.speed[index],
            load=self.load[index],
        )

    @property
    def scale(self) -> Array:
        """Factors that make the five DOF lengths: 1, 1, 1, Ri, Ri [m]."""
        radius = self.geometry.centre_radius
        return np.array([1.0, 1.0, 1.0, radius, radius])

    @property
    def load_size(self) -> Array:
        """Largest component of every load, as a force (s,) [N]."""
        return np.asarray(np.abs(self.load / self.scale).max(axis=-1))


def compliances(grooves: Grooves) -> Compliances | None:
    """Compute the compliances of the rings of a bearing; None where both are rigid."""
    rings = grooves.rings
    if rings is None:
        return None
    from bearings.flexible_rings.computed import compliance  # finite elements, for these alone

    assert isinstance(rings, FlexibleRings)
    grooves = replace(grooves, rings=None)  # that of a ring does not depend on the other ring
    return (
        None if rings.inner is None else compliance(grooves, rings.inner, inner=True),
        None if rings.outer is None else compliance(grooves, rings.outer, inner=False),
    )


def turns(g: Geometry, speed: Array) -> Flags:
    """Whether the centrifugal force presses a ball measurably into its race (…)."""
    orbit = 0.5 * g.ball_mass * g.pitch_diameter
    depth = (orbit * g.nominal_orbit_ratio_squared * speed**2 / g.outer.stiffness) ** (2.0 / 3.0)
    return np.asarray(depth > SLOW * g.outer_centre_distance)


def first_displacement(problem: Problem, given: Array) -> Array:
    """Initial displacement (s, 5): on the free DOF axial, all balls under an estimated share of the
    load, without tilt; as ``given`` (s, 5) on the others."""
    d = np.where(problem.free, 0.0, given)
    if not problem.free[0]:
        return d
    g = problem.geometry
    thrust = np.abs(problem.load[:, :3]).max(axis=1) + np.abs(problem.load[:, 3:]).max(axis=1) / (
        g.pitch_diameter / 2.0
    )
    share = thrust / (g.balls * max(np.sin(g.free_angle), 0.2))
    length = g.free_distance + (share / g.series_stiffness) ** (2.0 / 3.0)
    radial = np.minimum(np.abs(problem.origin[1]), 0.999 * length)
    side = np.where(problem.load[:, 0] < 0.0, -1.0, 1.0)
    if g.both_ways:
        side *= problem.load[:, 0] != 0.0
    shims = g.inner_grooves[0].offset - g.outer_grooves[-1].offset  # of the arcs thrust loads
    d[:, 0] = side * (np.sqrt(length**2 - radial**2) - shims) - problem.origin[0]
    return d
