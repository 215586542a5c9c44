"""Rings on a rotating shaft: fits, rotation and temperature, as compound thick cylinders.

Bodies are concentric, listed from the axis outward; neighbours share a nominal radius and carry a
radial interference, which presses (p ≥ 0) or leaves a gap, never pulls. In every body
u(r) = A r + B/r + C ω² r³ (Lamé with rotation; Timoshenko & Goodier, *Theory of Elasticity*,
§§28, 32, 150), computed from the stresses by Hooke's law. A stack of n bodies has n + 1 unit loads:
the n − 1 pressures of its fits, ω², and the given temperatures (1); arrays list them in this order.

The axial condition is one of

- ``"plane_stress"``: thin rings, no axial stress anywhere;
- ``"free_ends"``: generalised plane strain, no net axial force in any body (fits slip axially);
- ``"clamped"``: generalised plane strain, one axial strain for all bodies, no net axial force.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bearings.arguments import check_fields, checked, real_numbers
from bearings.arrays import Array, Flags
from bearings.errors import InvalidBearing, shown
from bearings.materials import Material

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

AXIAL_CONDITIONS = ("plane_stress", "free_ends", "clamped")


@dataclass(frozen=True, slots=True)
class Cylinder:
    """One body of the stack.

    Parameters
    ----------
    inner_radius, outer_radius : nominal radii [m]; inner 0 for a solid shaft
    material : elastic constants and density
    temperature_rise : uniform, above the state in which interferences are given [K]
    expansion : thermal expansion coefficient [1/K], needed with a temperature rise

    Raises
    ------
    InvalidBearing : radii not in order, a value not finite, temperature without expansion
    """

    inner_radius: float
    outer_radius: float
    material: Material
    temperature_rise: float = 0.0
    expansion: float = 0.0

    def __post_init__(self) -> None:
        radii = (self.inner_radius, self.outer_radius)
        check_fields(self)
        if not 0.0 <= radii[0] < radii[1]:
            raise InvalidBearing(f"cylinder radii must satisfy 0 <= inner < outer, got {radii} m")
        if self.temperature_rise != 0.0 and self.expansion == 0.0:
            raise InvalidBearing("a temperature_rise needs the expansion coefficient, got 0")


@dataclass(frozen=True, slots=True)
class CompoundState:
    """State of a stack of cylinders at given speeds.

    ``pressure`` of each fit [Pa] and radial ``gap`` where the fit is loose [m], both of shape
    (…, fits): where one is positive the other is zero. ``speed`` (…) [rad/s].
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
        return self._loads() @ displacement(self.bodies, self.axial, radius)[body]

    def hoop_stress(self, radius: float, body: int = -1) -> Array:
        """Circumferential stress of a body at ``radius`` [Pa], shape (…)."""
        require_inside(self.bodies[body], radius)
        return self._loads() @ stress(self.bodies, self.axial, radius)[1][body]

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
    """Solve pressures, gaps and displacements of a stack of concentric bodies.

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
    speeds = real_numbers(speed)
    if speeds is None or not np.isfinite(speeds).all():
        raise InvalidBearing(f"speed must be finite numbers, got {shown(speed)}")
    opening, compliance = openings(stack, axial)
    free = opening[:, -1] - overlap + speeds[..., None] ** 2 * opening[:, -2]
    pressure = _contact_pressure(free, compliance)
    gap = np.where(pressure > 0.0, 0.0, np.maximum(free + pressure @ compliance.T, 0.0))
    return CompoundState(stack, axial, speeds, pressure, gap)


@checked
def release_speed(
    bodies: Sequence[Cylinder], interference: ArrayLike = (), *, axial: str = "plane_stress"
) -> Array:
    """Speed at which each fit first becomes loose [rad/s], shape (fits,).

    0 for a fit loose at rest; infinite for one that never becomes loose. Pressures are
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
    values = np.concatenate(zeros)
    return values[values > 0.0]


def _checked(
    bodies: object, interference: ArrayLike, axial: str
) -> tuple[tuple[Cylinder, ...], Array]:
    if not isinstance(bodies, Iterable) or not all(isinstance(b, Cylinder) for b in bodies):
        raise InvalidBearing(f"bodies must be a list, each a Cylinder, got {shown(bodies)}")
    stack, values = tuple(bodies), real_numbers(interference)
    overlap = np.full(1, np.nan) if values is None else np.atleast_1d(values)
    if axial not in AXIAL_CONDITIONS:
        raise InvalidBearing(f"axial must be one of {AXIAL_CONDITIONS}, got {shown(axial)}")
    if not stack:
        raise InvalidBearing("a stack needs at least one cylinder")
    if overlap.shape != (len(stack) - 1,) or not np.isfinite(overlap).all():
        raise InvalidBearing(
            f"{len(stack)} cylinders need {len(stack) - 1} finite interferences, "
            f"got {shown(interference)}"
        )
    for inside, outside in itertools.pairwise(stack):
        if not math.isclose(inside.outer_radius, outside.inner_radius, rel_tol=1e-9):
            raise InvalidBearing(
                f"a body ends at radius {inside.outer_radius:g} m and the next one starts at "
                f"{outside.inner_radius:g} m; give the difference as interference"
            )
    return stack, overlap


def _contact_pressure(free: Array, compliance: Array) -> Array:
    """Solve p ≥ 0 with free + F p ≥ 0 and p (free + F p) = 0, for free gaps (…, fits).

    F is symmetric up to the radii and positive definite: exactly one set of pressing fits
    qualifies; all sets are tried and the one that violates no condition is taken.
    """
    best = np.zeros_like(free)
    least = np.full(free.shape[:-1], np.inf)
    for choice in itertools.product((False, True), repeat=free.shape[-1]):
        pressure = _pressing(free, compliance, np.array(choice, bool))
        gap = free + pressure @ compliance.T
        violation = np.maximum(-pressure * np.diag(compliance), -np.where(choice, 0.0, gap))
        worst = violation.max(axis=-1, initial=0.0)
        better = worst < least
        best = np.where(better[..., None], pressure, best)
        least = np.where(better, worst, least)
    return np.maximum(best, 0.0)


def _pressing(free: Array, compliance: Array, active: Flags) -> Array:
    """Pressures (…, fits) that close the ``active`` fits, 0 in the others."""
    pressure = np.zeros_like(free)
    if active.any():
        block = compliance[np.ix_(active, active)]
        pressure[..., active] = -np.linalg.solve(block, free[..., active][..., None])[..., 0]
    return pressure


def require_inside(cylinder: Cylinder, radius: float) -> None:
    """Raise InvalidBearing for a radius outside the body."""
    tolerance = 1e-9 * cylinder.outer_radius
    if not cylinder.inner_radius - tolerance <= radius <= cylinder.outer_radius + tolerance:
        raise InvalidBearing(
            f"radius {radius:g} m lies outside the body, which reaches from "
            f"{cylinder.inner_radius:g} to {cylinder.outer_radius:g} m"
        )


def _columns(bodies: tuple[Cylinder, ...]) -> Array:
    """Inner and outer radius, E, ν, ρ and free thermal strain of every body, each (bodies, 1)."""
    rows = [
        (
            body.inner_radius,
            body.outer_radius,
            body.material.young_modulus,
            body.material.poisson_ratio,
            body.material.density,
            body.expansion * body.temperature_rise,
        )
        for body in bodies
    ]
    return np.array(rows).T[:, :, None]


def stress(bodies: tuple[Cylinder, ...], axial: str, radius: Array | float) -> tuple[Array, Array]:
    """σr and σθ of every body at ``radius``, (bodies, 1) or one for all, per unit load [Pa].

    σr = m − s/r² − (3 + ν)/8 ρ ω² r², σθ = m + s/r² − (1 + 3ν)/8 ρ ω² r², m and s after Lamé from
    the pressures on both surfaces, reduced by rotation. A uniform temperature and a uniform axial
    strain cause no stress in the plane.
    """
    ri, ro, _, nu, density, _ = _columns(bodies)
    nu = nu if axial == "plane_stress" else nu / (1.0 - nu)
    spin_r, spin_theta = (3.0 + nu) / 8.0 * density, (1.0 + 3.0 * nu) / 8.0 * density
    surfaces = np.eye(len(bodies) + 1, k=-1)  # pressure on each per unit load, outside none
    surfaces[-1] = 0.0
    inside, outside = surfaces[:-1].copy(), surfaces[1:].copy()
    inside[:, -2:-1] -= spin_r * ri**2
    outside[:, -2:-1] -= spin_r * ro**2
    area, r2 = ro**2 - ri**2, np.square(radius)
    mean = (inside * ri**2 - outside * ro**2) / area
    shear = (inside - outside) * ri**2 * ro**2 / area / np.where(r2 > 0.0, r2, 1.0)  # 0 at r = 0
    sigma_r, sigma_theta = mean - shear, mean + shear
    sigma_r[:, -2:-1] -= spin_r * r2
    sigma_theta[:, -2:-1] -= spin_theta * r2
    return sigma_r, sigma_theta


def _axial_strain(bodies: tuple[Cylinder, ...], axial: str) -> Array:
    """εz of every body per unit load, (bodies, loads), from E εz = E α T − ν ⟨σr + σθ⟩ without an
    axial force; the mean is the value at the mean of r², in which the sum is linear."""
    ri, ro, young, nu, _, heat = _columns(bodies)
    force = -nu * sum(stress(bodies, axial, np.sqrt((ri**2 + ro**2) / 2.0)))
    force[:, -1:] += young * heat
    if axial == "free_ends":
        return np.asarray(force / young)
    area = ro**2 - ri**2
    return np.broadcast_to((area * force).sum(0) / (area * young).sum(0), force.shape)


def displacement(bodies: tuple[Cylinder, ...], axial: str, radius: Array | float) -> Array:
    """u of every body at ``radius``, as in ``stress``, per unit load, (bodies, loads) [m]."""
    _, _, young, nu, _, heat = _columns(bodies)
    sigma_r, sigma_theta = stress(bodies, axial, radius)
    strain = (sigma_theta - nu * sigma_r) / young
    strain[:, -1:] += heat
    if axial != "plane_stress":  # less ν σz/E, σz = E (εz − α T) + ν (σr + σθ)
        strain -= nu * (_axial_strain(bodies, axial) + nu * (sigma_r + sigma_theta) / young)
        strain[:, -1:] += nu * heat
    return np.asarray(radius * strain)


def openings(bodies: tuple[Cylinder, ...], axial: str) -> tuple[Array, Array]:
    """Outer minus inner u at every fit per unit load (fits, loads), and its pressure block."""
    inner, outer = _columns(bodies)[:2]
    opening = displacement(bodies, axial, inner)[1:] - displacement(bodies, axial, outer)[:-1]
    return opening, opening[:, : len(bodies) - 1]
