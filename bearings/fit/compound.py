"""Rings on a rotating shaft: fits, rotation and temperature, as compound thick cylinders.

Bodies are concentric, listed from the axis outward; neighbours share a nominal radius and carry a
radial interference, which presses (p ≥ 0) or leaves a gap, never pulls. In every body
u(r) = A r + B/r + C ω² r³ (Lamé with rotation; Timoshenko & Goodier, *Theory of Elasticity*,
§§28, 32, 150). A stack of n bodies has n + 1 unit loads: the n − 1 pressures of its fits, ω², and
the temperatures as given (1); arrays run over them in this order.

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


def _checked(
    bodies: object, interference: ArrayLike, axial: str
) -> tuple[tuple[Cylinder, ...], Array]:
    if not isinstance(bodies, Iterable) or not all(isinstance(b, Cylinder) for b in bodies):
        raise InvalidBearing(f"bodies must be a list, each a Cylinder, got {shown(bodies)}")
    stack, given = tuple(bodies), real_numbers(interference)
    overlap = np.full(1, np.nan) if given is None else np.atleast_1d(given)
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


def require_inside(cylinder: Cylinder, radius: float) -> None:
    """Refuse a radius outside the body (InvalidBearing)."""
    slack = 1e-9 * cylinder.outer_radius
    if not cylinder.inner_radius - slack <= radius <= cylinder.outer_radius + slack:
        raise InvalidBearing(
            f"radius {radius:g} m lies outside the body, which reaches from "
            f"{cylinder.inner_radius:g} to {cylinder.outer_radius:g} m"
        )


def _plane(material: Material, axial: str) -> tuple[float, float, float]:
    """E, ν and factor on α that turn plane-stress formulae into those of the axial condition."""
    young, nu = material.young_modulus, material.poisson_ratio
    if axial == "plane_stress":
        return young, nu, 1.0
    return young / (1.0 - nu**2), nu / (1.0 - nu), 1.0 + nu


def _surface_pressures(count: int) -> tuple[Array, Array]:
    """Pressure inside and outside each body per unit load (fit pressures, ω², 1): (bodies, …)."""
    unit, none = np.eye(count - 1, count + 1), np.zeros((1, count + 1))
    return np.vstack([none, unit]), np.vstack([unit, none])


def _lame(cylinder: Cylinder, inside: Array, outside: Array) -> tuple[Array, Array]:
    """Mean in-plane stress, and the factor of 1/r² in σθ, from the two surface pressures."""
    ri2, ro2 = cylinder.inner_radius**2, cylinder.outer_radius**2
    return (inside * ri2 - outside * ro2) / (ro2 - ri2), (inside - outside) * ri2 * ro2 / (
        ro2 - ri2
    )


def _axial_force(cylinder: Cylinder, mean: Array) -> Array:
    """E α T − ν ⟨σr + σθ⟩ per unit area and load: E εz when no axial force acts."""
    m = cylinder.material
    force = -2.0 * m.poisson_ratio * mean
    ring = cylinder.outer_radius**2 + cylinder.inner_radius**2
    force[-2] -= m.poisson_ratio * m.density * ring / 2.0
    force[-1] += m.young_modulus * cylinder.expansion * cylinder.temperature_rise
    return force


def _axial_strains(bodies: tuple[Cylinder, ...], axial: str) -> Array:
    """εz of each body per unit load, (bodies, loads); unused (zero) in plane stress."""
    inside, outside = _surface_pressures(len(bodies))
    if axial == "plane_stress":
        return np.zeros_like(inside)
    means = [_lame(b, p, q)[0] for b, p, q in zip(bodies, inside, outside, strict=True)]
    force = np.array([_axial_force(b, m) for b, m in zip(bodies, means, strict=True)])
    young = np.array([[b.material.young_modulus] for b in bodies])
    if axial == "free_ends":
        return force / young
    area = np.array([[b.outer_radius**2 - b.inner_radius**2] for b in bodies])
    return np.broadcast_to((area * force).sum(0) / (area * young).sum(0), inside.shape)


def displacement_fields(bodies: tuple[Cylinder, ...], axial: str) -> tuple[Array, Array, Array]:
    """A, B, C of every body per unit load (fit pressures, ω², 1), each (bodies, loads)."""
    pressures = zip(*_surface_pressures(len(bodies)), strict=True)
    strains = _axial_strains(bodies, axial)
    rows = [_field(b, *p, axial, e) for b, p, e in zip(bodies, pressures, strains, strict=True)]
    linear, inverse, cubic = (np.array(part) for part in zip(*rows, strict=True))
    return linear, inverse, cubic


def _field(
    body: Cylinder, inside: Array, outside: Array, axial: str, strain: Array
) -> tuple[Array, Array, Array]:
    young, nu, heat = _plane(body.material, axial)
    ri2, ro2 = body.inner_radius**2, body.outer_radius**2
    mean, shear = _lame(body, inside, outside)
    linear = (1.0 - nu) / young * mean - body.material.poisson_ratio * strain
    inverse = (1.0 + nu) / young * shear
    cubic = np.zeros_like(linear)
    spin = body.material.density * (3.0 + nu) / (8.0 * young)
    linear[-2] += spin * (1.0 - nu) * (ri2 + ro2)
    inverse[-2] += spin * (1.0 + nu) * ri2 * ro2
    cubic[-2] = -body.material.density * (1.0 - nu**2) / (8.0 * young)
    linear[-1] += heat * body.expansion * body.temperature_rise
    return linear, inverse, cubic


def hoop_stress(bodies: tuple[Cylinder, ...], axial: str, body: int, radius: float) -> Array:
    """σθ of one body at ``radius`` per unit load [Pa].

    A uniform temperature and axial strain add none in the plane.
    """
    cylinder = bodies[body]
    inside, outside = (p[body] for p in _surface_pressures(len(bodies)))
    _, nu, _ = _plane(cylinder.material, axial)
    ri2, ro2, r2 = cylinder.inner_radius**2, cylinder.outer_radius**2, radius**2
    mean, shear = _lame(cylinder, inside, outside)
    bore = 1.0 / r2 if ri2 else 0.0
    stress = mean + shear * bore
    turning = (3.0 + nu) * (ri2 + ro2 + ri2 * ro2 * bore) - (1.0 + 3.0 * nu) * r2
    stress[-2] += cylinder.material.density / 8.0 * turning
    return stress


def openings(bodies: tuple[Cylinder, ...], axial: str) -> tuple[Array, Array]:
    """Outer minus inner u at every fit per unit load (fits, loads), and its pressure block."""
    linear, inverse, cubic = displacement_fields(bodies, axial)
    radius = np.array([[b.outer_radius] for b in bodies[:-1]]).reshape(-1, 1)

    def at(rows: slice) -> Array:
        return linear[rows] * radius + inverse[rows] / radius + cubic[rows] * radius**3

    opening = at(slice(1, None)) - at(slice(None, -1))
    return opening, opening[:, : len(radius)]
