"""Sliding within the contact ellipses: spin, differential slip, gyroscopic creep together.

Coulomb friction under Hertz' pressure. Where the surfaces meet, the velocity of ball against race
is, with ξ along the major and η along the minor half-axis,

    v_ξ = ω_s η + v,    v_η = ω_r (± ξ²/(2 Rd)) − ω_s ξ + c,

ω_s spin, ω_r rolling, Rd = 2 f D/(2 f + 1) the radius of the deformed surface (Heathcote's slip).
v and c follow from the balance of tractions: none along rolling, the race's share of the gyroscopic
moment across it. They minimise the convex ∫ μ p |v| dA − F v; losses of spin, conformity and
gyroscopic moment are not computed apart and added.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bearings.arguments import checked, finite
from bearings.arrays import Array, Flags
from bearings.errors import InvalidBearing, shown
from bearings.ring.motion import contact_motion
from bearings.ring.truncation import half_axes

if TYPE_CHECKING:
    from bearings.ring.state import BearingState

RADIAL, AROUND = 6, 16  # points of the quadrature: within 2.5 % of the integral
FULL_SLIP = 0.95  # largest creep force solved for, over μ Q; beyond it contacts slip as a whole
_SMOOTH = 1e-2  # smoothing of |v| over the largest velocity: the points resolve no sharper corner
_STEPS, _NEWTON = 6, 5  # iterations: reweighted least squares, then Newton's


@dataclass(frozen=True, eq=False)
class Sliding:
    """Losses of the contacts of a state by contact (…, balls, contacts); 0 without load.

    ``power`` [W]: of all sliding; ``spin_power`` [W]: that of the spin alone, Ms |ωs|, contained in
    ``power`` except for the creep; ``spin_moment`` Ms [N·m]. ``friction``: μ. ``slips`` (…, balls,
    contacts): the gyroscopic moment requires more friction than available.
    """

    power: Array
    spin_power: Array
    spin_moment: Array
    slips: Flags
    friction: float


class Contacts(NamedTuple):
    """Contacts in a list (n,): half-axes ``a``, ``b`` and ``radius`` Rd [m]; ``roll``, ``spin``
    [rad/s]; ``slide`` [m/s], NaN where it follows from the balance; ``creep``: transverse force
    over μ Q."""

    a: Array
    b: Array
    radius: Array
    roll: Array
    spin: Array
    slide: Array
    creep: Array


@checked
def sliding(state: BearingState, friction: float) -> Sliding:
    """Power lost by sliding in every contact, ``friction`` μ of the lubricated contact.

    Raises
    ------
    InvalidBearing : a friction that is not positive
    """
    if not (finite(friction) and friction > 0.0):
        raise InvalidBearing(f"friction of a contact must be positive, got {shown(friction)}")
    # under an axial load all balls are equally loaded: one ball represents them
    g, axial = state.operation.geometry, bool(state.operation.axial.all())
    balls = slice(1) if axial else slice(None)
    load = np.asarray(state.contact_load)[..., balls, :]
    motion = contact_motion(state)
    major, minor = half_axes(g, load)
    f = g.by_contact(g.inner_conformity, g.outer_conformity)
    needed = g.by_contact(
        state.inner_required_friction[..., balls, None],
        state.outer_required_friction[..., balls, None],
    )
    omega = np.asarray(state.speed)[..., None, None]
    loads = np.nan_to_num(load)
    turning = (loads > 0.0) & (omega > 0.0)
    # a ball that presses a race in two places cannot roll in both: their slide is given
    pressed = (np.sum(loads[..., race] > 0.0, -1, keepdims=True) for race in g.races)
    shared = g.by_contact(*pressed) > 1
    side = g.by_contact(1.0, -1.0)
    required = needed / friction
    parts = (
        major,
        minor,
        side * 2.0 * f * g.ball_diameter / (2.0 * f + 1.0),
        motion.roll[..., balls, :] * omega,
        motion.spin[..., balls, :] * omega,
        np.where(shared, motion.slide[..., balls, :] * omega, np.nan),
        np.minimum(np.abs(required), FULL_SLIP),
    )
    contacts = Contacts(*(np.broadcast_to(part, loads.shape)[turning] for part in parts))
    power = np.zeros_like(loads)
    power[turning] = friction * loads[turning] * mean_speed(contacts)
    moment = spin_moment(state, friction)
    spins = moment * np.abs(np.nan_to_num(motion.spin)) * omega
    shape = moment.shape
    return Sliding(
        power=np.broadcast_to(power, shape).copy(),
        spin_power=spins,
        spin_moment=moment,
        slips=np.broadcast_to((required >= 1.0) & turning, shape).copy(),
        friction=friction,
    )


@checked
def spin_moment(state: BearingState, friction: float) -> Array:
    """Ms = 3/8 μ Q a E(1 − b²/a²) of every contact (…, balls, contacts) [N·m], exact for Coulomb
    friction under Hertz' pressure that spin alone drives."""
    g, load = state.operation.geometry, np.nan_to_num(np.asarray(state.contact_load))
    integral = g.by_contact(g.inner.second_integral, g.outer.second_integral)
    return np.asarray(0.375 * friction * load * half_axes(g, load)[0] * integral)


def mean_speed(contacts: Contacts) -> Array:
    """Mean of the sliding speed |v| over the ellipse, weighted by the pressure (n,) [m/s].

    v and c minimise the functional of this module, smooth at |v| = 0.
    """
    x, y, weight = _points()
    xi, eta = contacts.a[:, None] * x, contacts.b[:, None] * y
    roll, spin = contacts.roll[:, None], contacts.spin[:, None]
    across = spin * eta
    along = roll * xi**2 / (2.0 * contacts.radius[:, None]) - spin * xi
    prescribed = ~np.isnan(contacts.slide)
    largest = np.sqrt((across**2 + along**2).max(axis=1)) + np.abs(np.nan_to_num(contacts.slide))
    least = (_SMOOTH * largest + 1e-300)[:, None]
    c, v = np.where(prescribed, contacts.slide, 0.0), np.zeros_like(contacts.a)
    for step in range(_STEPS + _NEWTON):
        vx, vy = across + v[:, None], along + c[:, None]
        size = np.sqrt(vx * vx + vy * vy + least * least)
        part = weight / size
        total = part.sum(axis=1)
        force_x, force_y = (part * vx).sum(axis=1) - contacts.creep, (part * vy).sum(axis=1)
        if step < _STEPS:  # reweighted least squares: always a descent, but slow near the end
            dv, dc = -force_x / total, -force_y / total
        else:  # Newton: h the second derivatives, kept from being singular
            cube = part / (size * size)
            hxx, hyy = total - (cube * vx * vx).sum(axis=1), total - (cube * vy * vy).sum(axis=1)
            hxy = np.where(prescribed, 0.0, -(cube * vx * vy).sum(axis=1))
            det = np.maximum(hxx * hyy - hxy * hxy, 1e-3 * hxx * hyy)
            dv, dc = (hxy * force_y - hyy * force_x) / det, (hxy * force_x - hxx * force_y) / det
            bound = 0.3 * largest
            dv, dc = np.clip(dv, -bound, bound), np.clip(dc, -bound, bound)
            dv = np.where(prescribed, -force_x / hxx, dv)
        v, c = v + dv, c + np.where(prescribed, 0.0, dc)
    vx, vy = across + v[:, None], along + c[:, None]
    return np.asarray((weight * np.sqrt(vx * vx + vy * vy)).sum(axis=1))


@cache
def _points() -> tuple[Array, Array, Array]:
    """Quadrature points on the unit disk and weights 3/(2π) √(1 − r²) dA, with a sum of 1."""
    node, weights = np.polynomial.legendre.leggauss(RADIAL)
    u, share = 0.5 * (node + 1.0), 0.5 * weights
    r, turn = np.sqrt(1.0 - u**2), 2.0 * np.pi * (np.arange(AROUND) + 0.5) / AROUND
    weight = np.repeat(3.0 * u**2 * share / AROUND, AROUND)
    return (
        np.outer(r, np.cos(turn)).ravel(),
        np.outer(r, np.sin(turn)).ravel(),
        weight / weight.sum(),
    )
