"""Motion during a run-up or run-down at constant acceleration, through resonances.

The rotor out of balance is at the angle φ, its speed is φ̇ = ω, and ω̇ = α is constant, so that the
load is f (ω² − iα) e^(iφ), ω² f that of steady rotation. The speed range is divided into short
parts, each with the modes of its middle. A mode of pole λ has the modal coordinate η(t),

    η̇ = λ η + l f (ω² − iα) e^(iφ) = λ η − l f d²(e^(iφ))/dt²,

which has a closed form for any time: integrated by parts twice it leaves ∫ e^(bs + iαs²/2) ds, an
error function, at any acceleration and damping. Displacement and velocity are continuous from part
to part. A first-order correction there makes matrices vary linearly from middle to middle instead
of by steps. Two divisions of the range, one with ends of parts in the middle of those of the other,
are blended: errors fall with the square of the length of the parts.

Theory: docs/theory/response.md#run-up.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Complex, Matrix

DECAYED = 1.0  # largest exponent of decay in half a part: faster modes follow by themselves
CLOSE = 1e-6  # least exponent by the distance of a pole from the speed, to avoid division by 0
SMALL = 1e-2  # exponent below which a series is more accurate


class Run(NamedTuple):
    """Run of the rotor out of balance from ``first`` to ``last`` [rad/s] in ``duration`` [s]."""

    first: float
    last: float
    duration: float

    @property
    def acceleration(self) -> float:
        """Angular acceleration [rad/s²]."""
        return (self.last - self.first) / self.duration


@dataclass(frozen=True, eq=False)
class Parts:
    """Modes of one subsystem in parts of a run between the speeds ``edges`` (s + 1,) [rad/s].

    ``pole`` (s, m) [rad/s], ``vector`` (s, n, m) and ``left`` (s, m, n) of q̈ + D q̇ + K q = f with
    ``damping`` D and ``stiffness`` K (s, n, n) of the speeds ``middle`` (s,) [rad/s]; one of each
    if they do not change during the run. ``force`` f (n,) per ω² [kg·m]; ``begin`` q (n,) of steady
    rotation at the first speed. Outputs are ``rows`` (s, r, n) times the displacement plus
    ``rates`` (s, r, n) times the velocity plus ``direct`` (r,) times ω² − iα.
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
        """Return outputs over e^(iφ) (t, r) at ascending ``times`` (t,) [s] of a run that begins in
        the steady state of its first speed."""
        ends = (self.edges - run.first) / run.acceleration
        place = np.searchsorted(times, ends[1:-1])
        displacement, velocity = self.begin, 1j * run.first * self.begin
        outputs = []
        for k, instants_of in enumerate(np.split(times, place)):
            at = k % len(self.pole)
            pole, vector, left = self.pole[at], self.vector[at], self.left[at]
            by_velocity = left @ (self.damping[at] @ displacement + velocity)
            eta = pole * (left @ displacement) + by_velocity
            if k and len(self.pole) > 1:  # where matrices change
                eta = eta + self._correction(k, run, eta)
            since = np.append(instants_of, ends[k + 1]) - ends[k]
            path = _modal_coordinates(pole, left @ self.force, eta, self.edges[k], run, since)
            output_rows = self.rows[at] @ vector + self.rates[at] @ (vector * pole)
            load = (run.first + run.acceleration * instants_of) ** 2 - 1j * run.acceleration
            outputs.append(path[:-1] @ output_rows.T + load[:, None] * self.direct)
            displacement, velocity = vector @ path[-1], vector @ (pole * path[-1])
        return np.concatenate(outputs)

    def _correction(self, k: int, run: Run, eta: Complex) -> Complex:
        """Return the correction (m,) to modal coordinates ``eta`` (m,) at the start of part ``k``.

        Matrices that change by a step ΔK, ΔD differ from matrices that change linearly over the
        time 2h from middle to middle by the share ± (h − |u|)/2h of the change at the time u after
        the step. To first order mode i gets l_i (ΔK + λ_j ΔD) v_j of each mode j, weighted over
        that time: with e^((λ_j − λ_i) u) for free vibration, e^((iω − λ_i) u) for steady motion.
        """
        pole, vector, left, omega = self.pole[k], self.vector[k], self.left[k], self.edges[k]
        half = 0.5 * (self.middle[k] - self.middle[k - 1]) / run.acceleration
        stiffness, damping = (a[k] - a[k - 1] for a in (self.stiffness, self.damping))
        coupled = left @ (stiffness @ vector + (damping @ vector) * pole)
        distance = 1j * omega - pole
        if (np.abs(half * distance) < CLOSE).any():  # finite instead of an unbounded steady motion
            distance = distance + CLOSE / half
        steady = (left @ self.force) * omega**2 / distance
        free = (coupled * _weight(half, pole - pole[:, None])) @ (eta - steady)
        return np.asarray(free + _weight(half, distance) * (coupled @ steady))


def _weight(half: float, rate: Complex) -> Complex:
    """Return ∫ (h − u)/h sinh(ρu) du for u from 0 to h, ``half`` [s]; ``rate`` ρ [rad/s]."""
    z = half * rate
    is_small, clipped = np.abs(z) < SMALL, np.clip(z.real, -DECAYED, DECAYED) + 1j * z.imag
    closed = (np.sinh(clipped) - clipped) / np.where(is_small, 1.0, z) ** 2
    return np.asarray(half * np.where(is_small, z / 6.0, closed))


def blended(even: Complex, between: Complex, parts: Array) -> Complex:
    """Blend the motions (t, r) by two divisions of one run, the parts of one ending in the middle
    of those of the other, after ``parts`` (t,): ``even`` at the middle of its parts, ``between``
    at their ends. Thus the modes, too, change linearly from one to the next."""
    share = 1.0 - 2.0 * np.abs(parts % 1.0 - 0.5)[:, None]
    return np.asarray(share * even + (1.0 - share) * between)


def _modal_coordinates(
    pole: Complex, left: Complex, begin: Complex, omega: float, run: Run, times: Array
) -> Complex:
    """Return η over e^(iφ) (t, m) at ``times`` (t,) [s] after its start at ``begin`` (m,) and the
    speed ``omega`` [rad/s]; ``left``: l f (m,)."""
    t, alpha = times[:, None], run.acceleration
    rotation = np.exp(1j * (omega * t + 0.5 * alpha * t**2))
    decay = np.exp(pole * t)
    integral = _decayed_integral(1j * omega - pole, alpha, t, pole)
    forced = (
        (1j * (omega + alpha * t) + pole) * rotation
        - (1j * omega + pole) * decay
        + pole**2 * integral
    )
    return np.asarray((decay * begin - left * forced) / rotation)


def _decayed_integral(slope: Complex, alpha: float, t: Array, pole: Complex) -> Complex:
    """Return e^(λt) ∫ e^(bs + iαs²/2) ds over s from 0 to ``t``, with ``slope`` b = iω − λ."""
    if alpha < 0.0:
        return _decayed_integral(slope.conj(), -alpha, t, pole.conj()).conj()
    from scipy.special import wofz

    root = np.sqrt(0.5 * alpha) * np.exp(-0.25j * np.pi)
    ends = root * (-1j * slope / alpha), root * (t - 1j * slope / alpha)
    sides = [np.where(end.real < 0.0, -1.0, 1.0) for end in ends]
    first, last = (side * wofz(1j * side * end) for side, end in zip(sides, ends, strict=True))
    passed = sides[0] != sides[1]  # the resonance lies between
    jump = np.exp(np.where(passed, pole * t + 0.5j * slope**2 / alpha, -np.inf))
    growth = np.exp((slope + pole) * t + 0.5j * alpha * t**2)
    part = 2.0 * jump - growth * last + np.exp(pole * t) * first
    return np.asarray(0.5 * np.sqrt(np.pi) / root * part)
