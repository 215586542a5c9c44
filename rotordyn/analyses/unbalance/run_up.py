"""Motion while the speed rises or falls evenly through the speeds of a case, past its resonances.

The rotor out of balance is at the angle φ, its speed is φ̇ = ω, and ω̇ = α is constant, so that the
load is f (ω² − iα) e^(iφ), ω² f that of steady rotation. The way is cut into short parts, in each
of which the modes are those of its middle. A mode of pole λ takes part by η(t),

    η̇ = λ η + l f (ω² − iα) e^(iφ) = λ η − l f d²(e^(iφ))/dt²,

which has a closed form for any time: twice by parts it leaves ∫ e^(bs + iαs²/2) ds, an error
function, however fast or slow the run and however small the damping. Displacement and velocity are
continuous from part to part, but for what jumps of steady motion would leave as free vibration. Two
cuts of the way, one with ends of parts in the middle of those of the other, are blended: errors
fall with up to the square of the length of the parts.

Theory: docs/theory/response.md#run-up.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from rotordyn.arrays import Array, Complex, Matrix


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
    ``damping`` D (s, n, n); one of each where they do not change on the way. ``force`` f (n,) per
    ω² [kg·m]; ``begin`` q (n,) of steady rotation at the first speed; ``rows`` (r, n): what of the
    motion is asked for.
    """

    edges: Array
    pole: Complex
    vector: Complex
    left: Complex
    damping: Matrix
    force: Complex
    begin: Complex
    rows: Complex

    def moved(self, run: Run, times: Array) -> Complex:
        """Motion over e^(iφ) (t, r) at ascending ``times`` (t,) [s] of a run that begins in the
        steady state of its first speed."""
        ends = (self.edges - run.first) / run.acceleration
        place = np.searchsorted(times, ends[1:-1])
        displacement, velocity = self.begin, 1j * run.first * self.begin
        found = []
        for k, inside in enumerate(np.split(times, place)):
            at = k % len(self.pole)
            pole, vector, left = self.pole[at], self.vector[at], self.left[at]
            taking = self._of_state(at, displacement, velocity)
            if k and len(self.pole) > 1:  # modes change
                taking = taking + self._followed(k, 0.5 * (ends[k + 1] - ends[k - 1]))
            instants = np.append(inside, ends[k + 1]) - ends[k]
            every = _taking(pole, left @ self.force, taking, self.edges[k], run, instants)
            found.append(every[:-1] @ (self.rows @ vector).T)
            displacement, velocity = vector @ every[-1], vector @ (pole * every[-1])
        return np.concatenate(found)

    def _of_state(self, k: int, displacement: Complex, velocity: Complex) -> Complex:
        """What every mode of a part takes (m,) of a state: l (λ + D) q + l v."""
        left = self.left[k]
        pushed = left @ (self.damping[k] @ displacement + velocity)
        return np.asarray(self.pole[k] * (left @ displacement) + pushed)

    def _steady(self, k: int, omega: float) -> Complex:
        """The same of steady rotation with the modes of a part (m,)."""
        return np.asarray((self.left[k] @ self.force) * omega**2 / (1j * omega - self.pole[k]))

    def _followed(self, k: int, time: float) -> Complex:
        """What the modes of part ``k`` take besides at its begin (m,).

        From part to part steady motion jumps, and all of the jump would go on as free vibration.
        In truth it changes over the ``time`` τ from the middle of one part to that of the next, in
        which modes far from resonance follow. Of a mode with λ − iω = −σ + iν the share
        sin(y)/y · x/sinh(x) of the jump stays free vibration, y = ντ/2, x = στ/2: all of it where
        the mode is slow beside τ, none where it is fast. That is a choice, and vanishes with τ: of
        cases tried, two rotors on linear supports have smaller errors without it, a spindle that
        starts in half a second has smaller ones with it.
        """
        omega, before = self.edges[k], self._steady(k - 1, self.edges[k])
        vector = self.vector[k - 1]
        known = self._of_state(k, vector @ before, vector @ (self.pole[k - 1] * before))
        apart = 0.5 * time * (self.pole[k] - 1j * omega)
        size = np.maximum(np.abs(apart.real), 1e-9)
        kicked = np.sinc(apart.imag / np.pi) * size / np.sinh(np.minimum(size, 300.0))
        return np.asarray((1.0 - kicked) * (self._steady(k, omega) - known))


def blended(even: Complex, between: Complex, share: Array) -> Complex:
    """Motion (t, r) of two cuts of one way, the parts of one ending in the middle of those of the
    other; ``share`` (t,) of the first, 1 in the middle of its parts and 0 at their ends. So the
    modes, too, change linearly from one to the next."""
    return np.asarray(share[:, None] * even + (1.0 - share)[:, None] * between)


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
