"""Rolling and spin of a ball: tan β of its rotation axis under four hypotheses, with derivatives.

Everything is written for the angles (αi, αo) and the race weight C = Qi ai Ei / (Qo ao Eo), and
returned with its partial derivatives in that order. Plain expressions of floats or arrays, which
compile as they are.
Sources: Jones (1959) race control; geometric β = (αi + αo)/2; hybrid after Changan, Hongrui &
Ruixia (Mech. Mach. Theory 2010), in the form of the theory page.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from bearings.ball.plane import some, where

FLAT = 1e-6  # cos αi + cos αo below which the axis of a ball counts as radial


class Angles(NamedTuple):
    """Sines and cosines of the two contact angles, γ = D/dm and the race weight C."""

    sin_i: Any
    cos_i: Any
    sin_o: Any
    cos_o: Any
    gamma: float
    weight: Any


class Partial(NamedTuple):
    """A value with its derivatives by αi, αo and C."""

    value: Any
    by_inner: Any
    by_outer: Any
    by_weight: Any


class Rolling(NamedTuple):
    """A value with its derivatives by αi, αo and tan β."""

    value: Any
    by_inner: Any
    by_outer: Any
    by_attitude: Any


def outer_control(a: Angles) -> Partial:
    """tan β without spin on the outer race, sin αo / (cos αo + γ)."""
    below = a.cos_o + a.gamma
    return Partial(a.sin_o / below, 0.0, (1.0 + a.gamma * a.cos_o) / below**2, 0.0)


def inner_control(a: Angles) -> Partial:
    """tan β without spin on the inner race, sin αi / (cos αi − γ)."""
    below = a.cos_i - a.gamma
    return Partial(a.sin_i / below, (1.0 - a.gamma * a.cos_i) / below**2, 0.0, 0.0)


def geometric(a: Angles) -> Partial:
    """tan β of β = (αi + αo)/2, by its half-angle form (sin αi + sin αo)/(cos αi + cos αo)."""
    below = a.cos_i + a.cos_o
    below = where(np.abs(below) < FLAT, FLAT, below)
    slope = (1.0 + a.cos_i * a.cos_o + a.sin_i * a.sin_o) / below**2
    return Partial((a.sin_i + a.sin_o) / below, slope, slope, 0.0)


def hybrid(a: Angles) -> Partial:
    """tan β where both races share control by their weight C; C = 0 is exactly outer control."""
    g, c = a.gamma, a.weight
    inner_gap = 1.0 - g * a.cos_i
    s = (1.0 + g * a.cos_o) / inner_gap
    s_i, s_o = -s * g * a.sin_i / inner_gap, -g * a.sin_o / inner_gap
    cos_d = a.cos_i * a.cos_o + a.sin_i * a.sin_o
    sin_d = a.sin_i * a.cos_o - a.cos_i * a.sin_o
    top = c * (s + 1.0) * a.sin_i + 2.0 * a.sin_o
    below = c * (s + 1.0) * a.cos_i + 2.0 * (a.cos_o + g) + g * c * (cos_d - s)
    top_i = c * (s_i * a.sin_i + (s + 1.0) * a.cos_i)
    top_o = c * s_o * a.sin_i + 2.0 * a.cos_o
    below_i = c * (s_i * a.cos_i - (s + 1.0) * a.sin_i) - g * c * (sin_d + s_i)
    below_o = c * s_o * a.cos_i - 2.0 * a.sin_o + g * c * (sin_d - s_o)
    below_c = (s + 1.0) * a.cos_i + g * (cos_d - s)
    t = top / below
    return Partial(
        t,
        (top_i - t * below_i) / below,
        (top_o - t * below_o) / below,
        ((s + 1.0) * a.sin_i - t * below_c) / below,
    )


def tan_beta(law: Any, a: Angles) -> Partial:
    """tan β by the number of the hypothesis in ``bearings.ball.law.KINEMATICS``."""
    if not some(law != 0):
        return hybrid(a)
    if not some(law != 1):
        return outer_control(a)
    if not some(law != 2):
        return inner_control(a)
    if not some(law != 3):
        return geometric(a)
    h, o, i, g = hybrid(a), outer_control(a), inner_control(a), geometric(a)
    return Partial(
        _by_law(law, h.value, o.value, i.value, g.value),
        _by_law(law, h.by_inner, o.by_inner, i.by_inner, g.by_inner),
        _by_law(law, h.by_outer, o.by_outer, i.by_outer, g.by_outer),
        _by_law(law, h.by_weight, o.by_weight, i.by_weight, g.by_weight),
    )


def _by_law(law: Any, first: Any, second: Any, third: Any, fourth: Any) -> Any:
    """Choose one of four values by the number of the hypothesis, state by state."""
    return where(law == 0, first, where(law == 1, second, where(law == 2, third, fourth)))


def orbit_and_spin(a: Angles, t: Any) -> tuple[Rolling, Rolling]:
    """(ωm/ω, (ωm/ω)·|ωR/ω|·sin β) with derivatives, at tan β = ``t``.

    With po = (cos αo + tan β sin αo)/(1 + γ cos αo) and pi likewise on the inner race,
    ωm/ω = po/(po + pi) and |ωR/ω| sin β = tan β / (γ (po + pi)).
    """
    g = a.gamma
    gap_o, gap_i = 1.0 + g * a.cos_o, 1.0 - g * a.cos_i
    po_t, pi_t = a.sin_o / gap_o, a.sin_i / gap_i
    po, pi = a.cos_o / gap_o + t * po_t, a.cos_i / gap_i + t * pi_t
    po_o = (t * a.cos_o - a.sin_o + po * g * a.sin_o) / gap_o
    pi_i = (t * a.cos_i - a.sin_i - pi * g * a.sin_i) / gap_i
    total = po + pi
    part = where(total != 0.0, 1.0, 0.0) / where(total != 0.0, total, 1.0)
    orbit, roll = po * part, t / g * part
    orbit_i, roll_i = -orbit * pi_i * part, -roll * pi_i * part
    orbit_o, roll_o = (1.0 - orbit) * po_o * part, -roll * po_o * part
    both_t = po_t + pi_t
    orbit_t, roll_t = (po_t - orbit * both_t) * part, (1.0 / g - roll * both_t) * part
    return (
        Rolling(orbit, orbit_i, orbit_o, orbit_t),
        Rolling(
            orbit * roll,
            orbit_i * roll + orbit * roll_i,
            orbit_o * roll + orbit * roll_o,
            orbit_t * roll + orbit * roll_t,
        ),
    )


def inner_share(law: Any, weight: Any) -> tuple[Any, Any]:
    """λi and dλi/dC by the number of the law in ``bearings.ball.law.MOMENT_SHARING``.

    With λi + λo = 2, λi is 1 if both races carry the gyroscopic moment equally, 0 if the outer one
    carries all of it, 2 if the inner one does, or 2C/(1 + C) if each does by its weight.
    """
    fixed = where(law == 0, 1.0, where(law == 1, 0.0, 2.0))
    if not some(law == 3):
        return fixed, 0.0
    by_weight = 2.0 * weight / (1.0 + weight), 2.0 / (1.0 + weight) ** 2
    return where(law == 3, by_weight[0], fixed), where(law == 3, by_weight[1], 0.0)
