"""A rotating thick cylinder in a compound stack: displacement and stress per unit load.

In every body u(r) = A r + B/r + C ω² r³ (Lamé with rotation; Timoshenko & Goodier, *Theory of
Elasticity*, §§28, 32, 150). A stack of n bodies has n + 1 unit loads: the n − 1 pressures of its
fits, ω², and the temperatures as given (1); arrays run over them in this order.

The axial condition is one of

- ``"plane_stress"``: thin rings, no axial stress anywhere;
- ``"free_ends"``: generalised plane strain, no net axial force in any body (fits slip axially);
- ``"clamped"``: generalised plane strain, one axial strain for all bodies, no net axial force.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from bearings.arrays import Array
from bearings.errors import InvalidBearing
from bearings.materials import Material

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
        if not (all(map(math.isfinite, radii)) and 0.0 <= radii[0] < radii[1]):
            raise InvalidBearing(f"cylinder radii must satisfy 0 <= inner < outer, got {radii} m")
        if not (math.isfinite(self.temperature_rise) and math.isfinite(self.expansion)):
            raise InvalidBearing("temperature_rise and expansion must be finite")
        if self.temperature_rise != 0.0 and self.expansion == 0.0:
            raise InvalidBearing("a temperature_rise needs the expansion coefficient, got 0")


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
