"""Motion while the speed rises or falls evenly through the speeds of a case, past its resonances.

The rotor out of balance is at the angle φ, its speed is φ̇ = ω, and ω̇ = α is constant, so that the
load is f (ω² − iα) e^(iφ), ω² f that of steady rotation. The way is cut into short parts, in each
of which the modes are those of its middle. A mode of pole λ takes part by η(t),

    η̇ = λ η + l f (ω² − iα) e^(iφ) = λ η − l f d²(e^(iφ))/dt²,

which has a closed form for any time: twice by parts it leaves ∫ e^(bs + iαs²/2) ds, an error
function, however fast or slow the run and however small the damping. Displacement and velocity are
continuous from part to part. That matrices change evenly from middle to middle and not at once acts
on them there, to first order. Two cuts of the way, one with ends of parts in the middle of those of
the other, are blended: errors fall with the square of the length of the parts.

Theory: docs/theory/response.md#run-up.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Complex, Matrix

DECAYED = 1.0  # logarithm: a mode that decays by more in half a part follows by itself
CLOSE = 1e-6  # an exponent, below which a pole is taken as so far from the speed
SMALL = 1e-2  # an exponent, below which a series is the more accurate


class Run(NamedTuple):
    """From ``first`` to ``last`` [rad/s] of the rotor out of balance in ``duration`` [s]."""

    first: float
    last: float
    duration: float

    @property
    def acceleration(self) -> float:
        """[rad/s²]"""
        return (self.last - self.first) / self.duration


@dataclass(frozen=True, eq=False)
class Parts:
    """Modes of one subsystem in parts of the way between the speeds ``edges`` (s + 1,) [rad/s].

    ``pole`` (s, m) [rad/s], ``vector`` (s, n, m) and ``left`` (s, m, n) of q̈ + D q̇ + K q = f with
    ``damping`` D and ``stiffness`` K (s, n, n) of the speeds ``middle`` (s,) [rad/s]; one of each
    where they do not change on the way. ``force`` f (n,) per ω² [kg·m]; ``begin`` q (n,) of steady
    rotation at the first speed. Asked for are ``rows`` (s, r, n) times the displacement, ``rates``
    (s, r, n) times the velocity and ``direct`` (r,) as the load, per ω².
    """

    edges: Array
    middle: Array
    pole: Complex
    vector: Complex
    left: Complex
    damping: Matrix
    stiffness: Matrix
    force: Complex
    begin: Complex
    rows: Matrix
    rates: Matrix
    direct: Complex

    def moved(self, run: Run, times: Array) -> Complex:
        """What is asked for, over e^(iφ) (t, r), at ascending ``times`` (t,) [s] of a run that
        begins in the steady state of its first speed."""
        ends = (self.edges - run.first) / run.acceleration
        place = np.searchsorted(times, ends[1:-1])
        displacement, velocity = self.begin, 1j * run.first * self.begin
        found = []
        for k, inside in enumerate(np.split(times, place)):
            at = k % len(self.pole)
            pole, vector, left = self.pole[at], self.vector[at], self.left[at]
            pushed = left @ (self.damping[at] @ displacement + velocity)
            taking = pole * (left @ displacement) + pushed
            if k and len(self.pole) > 1:  # matrices change
                taking = taking + self._evenly(k, run, taking)
            instants = np.append(inside, ends[k + 1]) - ends[k]
            every = _taking(pole, left @ self.force, taking, self.edges[k], run, instants)
            seen = self.rows[at] @ vector + self.rates[at] @ (vector * pole)
            load = (run.first + run.acceleration * inside) ** 2 - 1j * run.acceleration
            found.append(every[:-1] @ seen.T + load[:, None] * self.direct)
            displacement, velocity = vector @ every[-1], vector @ (pole * every[-1])
        return np.concatenate(found)

    def _evenly(self, k: int, run: Run, taking: Complex) -> Complex:
        """What the modes of part ``k``, ``taking`` so much at its begin, take besides there (m,).

        Matrices that change by ΔK, ΔD at once are off from such that change evenly over the time 2h
        from middle to middle, by the share ± (h − |u|)/2h of the change at the time u after the
        begin. To first order mode i takes l_i (ΔK + λ_j ΔD) v_j of each mode j, weighted over that
        time: with e^((λ_j − λ_i) u) what vibrates freely, with e^((iω − λ_i) u) what is steady.
        """
        pole, vector, left, omega = self.pole[k], self.vector[k], self.left[k], self.edges[k]
        half = 0.5 * (self.middle[k] - self.middle[k - 1]) / run.acceleration
        stiffness, damping = (each[k] - each[k - 1] for each in (self.stiffness, self.damping))
        coupled = left @ (stiffness @ vector + (damping @ vector) * pole)
        away = 1j * omega - pole
        if (np.abs(half * away) < CLOSE).any():  # a limit, where steady motion has none
            away = away + CLOSE / half
        steady = (left @ self.force) * omega**2 / away
        free = (coupled * _uneven(half, pole - pole[:, None])) @ (taking - steady)
        return np.asarray(free + _uneven(half, away) * (coupled @ steady))


def _uneven(half: float, rate: Complex) -> Complex:
    """∫ (h − u)/h sinh(ρu) du over u from 0 to h = ``half`` [s], of the ``rate`` ρ [rad/s]."""
    z = half * rate
    small, held = np.abs(z) < SMALL, np.clip(z.real, -DECAYED, DECAYED) + 1j * z.imag
    grown = (np.sinh(held) - held) / np.where(small, 1.0, z) ** 2
    return np.asarray(half * np.where(small, z / 6.0, grown))


def blended(even: Complex, between: Complex, parts: Array) -> Complex:
    """Motion (t, r) of two cuts of one way, the parts of one ending in the middle of those of the
    other, after so many ``parts`` (t,): of the first cut in the middle of its parts, of the other
    one at their ends. So the modes, too, change linearly from one to the next."""
    share = 1.0 - 2.0 * np.abs(parts % 1.0 - 0.5)[:, None]
    return np.asarray(share * even + (1.0 - share) * between)


def _taking(
    pole: Complex, left: Complex, begin: Complex, omega: float, run: Run, times: Array
) -> Complex:
    """η over e^(iφ) (t, m) at ``times`` (t,) [s] after its ``begin`` (m,), at the speed ``omega``
    [rad/s] then; ``left`` l f (m,)."""
    t, alpha = times[:, None], run.acceleration
    turned = np.exp(1j * (omega * t + 0.5 * alpha * t**2))
    decayed = np.exp(pole * t)
    integral = _decayed_integral(1j * omega - pole, alpha, t, pole)
    forced = (
        (1j * (omega + alpha * t) + pole) * turned
        - (1j * omega + pole) * decayed
        + pole**2 * integral
    )
    return np.asarray((decayed * begin - left * forced) / turned)


def _decayed_integral(slope: Complex, alpha: float, t: Array, pole: Complex) -> Complex:
    """e^(λt) ∫ e^(bs + iαs²/2) ds over s from 0 to ``t``, of the ``slope`` b = iω − λ."""
    if alpha < 0.0:
        return _decayed_integral(slope.conj(), -alpha, t, pole.conj()).conj()
    from scipy.special import wofz

    root = np.sqrt(0.5 * alpha) * np.exp(-0.25j * np.pi)
    ends = root * (-1j * slope / alpha), root * (t - 1j * slope / alpha)
    sides = [np.where(end.real < 0.0, -1.0, 1.0) for end in ends]
    first, last = (side * wofz(1j * side * end) for side, end in zip(sides, ends, strict=True))
    passed = sides[0] != sides[1]  # the resonance lies between
    jump = np.exp(np.where(passed, pole * t + 0.5j * slope**2 / alpha, -np.inf))
    grown = np.exp((slope + pole) * t + 0.5j * alpha * t**2)
    part = 2.0 * jump - grown * last + np.exp(pole * t) * first
    return np.asarray(0.5 * np.sqrt(np.pi) / root * part)
