"""Rings on a rotating shaft: fits, rotation and temperature, as compound thick cylinders.

Bodies are concentric, listed from the axis outward; neighbours share a nominal radius and carry a
radial interference, which presses (p ≥ 0) or leaves a gap, never pulls. The axial conditions are
those of ``bearings.fit.cylinder``.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bearings.arrays import Array, Flags
from bearings.errors import InvalidBearing, shown
from bearings.fit.cylinder import (
    AXIAL_CONDITIONS,
    Cylinder,
    displacement_fields,
    hoop_stress,
    openings,
    require_inside,
)

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True, slots=True)
class CompoundState:
    """A stack of cylinders at given speeds.

    ``pressure`` of each fit [Pa] and ``gap`` left on the radius where it has let go [m], both of
    shape (…, fits): where one is positive the other is zero. ``speed`` (…) [rad/s].
    """

    bodies: tuple[Cylinder, ...]
    axial: str
    speed: Array
    pressure: Array
    gap: Array

    @property
    def holds(self) -> Flags:
        """True where a fit presses, shape (…, fits)."""
        return self.pressure > 0.0

    def radial_growth(self, radius: float, body: int = -1) -> Array:
        """Radial displacement u(r) of a body (the outermost by default) at ``radius`` [m], (…)."""
        require_inside(self.bodies[body], radius)
        linear, inverse, cubic = (c[body] for c in displacement_fields(self.bodies, self.axial))
        return self._loads() @ (linear * radius + inverse / max(radius, 1e-300) + cubic * radius**3)

    def hoop_stress(self, radius: float, body: int = -1) -> Array:
        """Circumferential stress of a body at ``radius`` [Pa], shape (…)."""
        require_inside(self.bodies[body], radius)
        return self._loads() @ hoop_stress(self.bodies, self.axial, body, radius)

    def _loads(self) -> Array:
        spin = self.speed[..., None] ** 2
        return np.concatenate([self.pressure, spin, np.ones_like(spin)], axis=-1)


def compound(
    bodies: Sequence[Cylinder],
    interference: ArrayLike = (),
    speed: ArrayLike = 0.0,
    *,
    axial: str = "plane_stress",
) -> CompoundState:
    """Pressures, gaps and displacements of a stack of concentric bodies.

    Parameters
    ----------
    bodies : from the axis outward, each starting at the nominal radius where the last one ends
    interference : on the RADIUS, one value per fit [m]; negative is clearance
    speed : rotation speed [rad/s], any shape
    axial : one of ``AXIAL_CONDITIONS``

    Raises
    ------
    InvalidBearing : radii that do not meet, wrong number of interferences, non-finite values
    """
    stack, overlap = _checked(bodies, interference, axial)
    speeds = np.asarray(speed, float)
    if not np.isfinite(speeds).all():
        raise InvalidBearing("speed must be finite")
    opening, compliance = openings(stack, axial)
    free = opening[:, -1] - overlap + speeds[..., None] ** 2 * opening[:, -2]
    pressure = _contact_pressure(free, compliance)
    gap = np.where(pressure > 0.0, 0.0, np.maximum(free + pressure @ compliance.T, 0.0))
    return CompoundState(stack, axial, speeds, pressure, gap)


def release_speed(
    bodies: Sequence[Cylinder], interference: ArrayLike = (), *, axial: str = "plane_stress"
) -> Array:
    """Speed at which each fit first lets go [rad/s], shape (fits,).

    0 for a fit that does not press at rest; infinite for one that never lets go. Pressures are
    piecewise linear in ω²: between neighbouring zeros of the pressures and gaps of all sets of
    pressing fits one set presses.
    """
    stack, overlap = _checked(bodies, interference, axial)
    opening, compliance = openings(stack, axial)
    start, slope = opening[:, -1] - overlap, opening[:, -2]
    zeros = [0.0, *_zeros(start, slope, compliance)]
    squared = np.append(np.unique(zeros), 4.0 * max(zeros) + 1.0)
    middle = 0.5 * (squared[:-1] + squared[1:])
    free = _contact_pressure(start + middle[:, None] * slope, compliance) <= 0.0
    return np.where(free.any(axis=0), np.sqrt(squared[np.argmax(free, axis=0)]), np.inf)


def _zeros(start: Array, slope: Array, compliance: Array) -> Array:
    """ω² > 0 at which a pressure or a gap of any set of pressing fits is zero."""
    zeros = []
    for choice in itertools.product((False, True), repeat=len(start)):
        active = np.array(choice, bool)
        p0, p1 = (_pressing(part, compliance, active) for part in (start, slope))
        value = np.where(active, p0, start + compliance @ p0)
        rate = np.where(active, p1, slope + compliance @ p1)
        zeros.append(-value / np.where(rate == 0.0, np.inf, rate))
    each = np.concatenate(zeros)
    return each[each > 0.0]


def thermal_growth(
    pitch_diameter: float,
    ball_diameter: float,
    contact_angle: float,
    *,
    inner_rise: ArrayLike,
    outer_rise: ArrayLike,
    expansion: float,
    ball_rise: ArrayLike = 0.0,
    ball_expansion: float = 0.0,
) -> Array:
    """Δu that temperature alone gives the groove centres of a bearing [m].

    ½ α ((Ti − To) dm − D cos α (Ti + To)) + α_b D cos α T_b, rises above mounting [K] in the inner
    ring, the outer ring and the balls. To first order exact for rings that expand freely in all
    directions: a bearing of one material heated uniformly keeps its contact angle.
    """
    inner, outer, ball = (np.asarray(t, float) for t in (inner_rise, outer_rise, ball_rise))
    chord = ball_diameter * math.cos(contact_angle)
    rings = 0.5 * expansion * ((inner - outer) * pitch_diameter - chord * (inner + outer))
    return rings + ball_expansion * chord * ball


def _checked(
    bodies: Sequence[Cylinder], interference: ArrayLike, axial: str
) -> tuple[tuple[Cylinder, ...], Array]:
    stack, overlap = tuple(bodies), np.atleast_1d(np.asarray(interference, float))
    if axial not in AXIAL_CONDITIONS:
        raise InvalidBearing(f"axial must be one of {AXIAL_CONDITIONS}, got {shown(axial)}")
    if not stack:
        raise InvalidBearing("a stack needs at least one cylinder")
    if overlap.shape != (len(stack) - 1,) or not np.isfinite(overlap).all():
        raise InvalidBearing(
            f"{len(stack)} cylinders need {len(stack) - 1} finite interferences, "
            f"got {overlap.tolist()}"
        )
    for inside, outside in itertools.pairwise(stack):
        if not math.isclose(inside.outer_radius, outside.inner_radius, rel_tol=1e-9):
            raise InvalidBearing(
                f"a body ends at radius {inside.outer_radius:g} m and the next one starts at "
                f"{outside.inner_radius:g} m; give the difference as interference"
            )
    return stack, overlap


def _contact_pressure(free: Array, compliance: Array) -> Array:
    """p ≥ 0 with free + F p ≥ 0 and p (free + F p) = 0, for free gaps (…, fits).

    F is symmetric up to the radii and positive definite: exactly one set of pressing fits
    qualifies; all sets are tried and the one that breaks no condition is taken.
    """
    best = np.zeros_like(free)
    least = np.full(free.shape[:-1], np.inf)
    for choice in itertools.product((False, True), repeat=free.shape[-1]):
        pressure = _pressing(free, compliance, np.array(choice, bool))
        gap = free + pressure @ compliance.T
        wrong = np.maximum(-pressure * np.diag(compliance), -np.where(choice, 0.0, gap))
        worst = wrong.max(axis=-1, initial=0.0)
        better = worst < least
        best = np.where(better[..., None], pressure, best)
        least = np.where(better, worst, least)
    return np.maximum(best, 0.0)


def _pressing(free: Array, compliance: Array, active: Flags) -> Array:
    pressure = np.zeros_like(free)
    if active.any():
        block = compliance[np.ix_(active, active)]
        pressure[..., active] = -np.linalg.solve(block, free[..., active][..., None])[..., 0]
    return pressure
