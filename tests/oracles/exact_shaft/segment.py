"""Uniform piece of a spinning Timoshenko shaft, solved exactly at one frequency of whirl.

With r = y + i z, φ = θz − i θy turning as e^{iωt}, transverse force Q = S (r′ − φ) + N r′, moment
M = EI φ′, S = κGA, N the axial force, tension positive, and σ = S/(S + N):

    r′ = σ φ + Q/(S + N),   φ′ = M/EI,
    Q′ = −ρA ω² r,          M′ = −σ Q − (ρI (ω² − 2 Ω ω) − σ N) φ

The state (r, φ, Q, M) at the end of a piece is e^{A h} times that at its start. A joins (r, M) to
(φ, Q) only, so that A² obeys z² − p z + q = 0 and the exponential is four scalar power series, free
of cancellation on pieces of moderate |z| h².  (Cf. Banerjee, J. Sound Vib. 247 (2001) 97, for
spinning beams.)
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Inexact = NDArray[np.inexact]
Entries = tuple[Any, Any, Any, Any]

LONGEST = 4.0  # |z| h² of a piece
TERMS = 14  # 4^14 / 28! is below rounding


@dataclass(frozen=True, eq=False, slots=True)
class Segments:
    """Uniform pieces in a row, each field (pieces,) in SI.

    ``length`` [m], ``shear`` κGA [N], ``bending`` EI [N·m²], ``line_mass`` ρA [kg/m],
    ``rotary`` ρI [kg·m], ``tension`` N [N], above −κGA.
    """

    length: Array
    shear: Array
    bending: Array
    line_mass: Array
    rotary: Array
    tension: Array

    def divided(self, parts: NDArray[np.intp]) -> Segments:
        """Every piece cut into equal ``parts`` (pieces,)."""
        values = {f.name: np.repeat(getattr(self, f.name), parts) for f in fields(self)}
        values["length"] = values["length"] / np.repeat(parts, parts)
        return Segments(**values)

    def cut(self, piece: NDArray[np.intp], length: Array) -> Segments:
        """The first ``length`` [m] of some pieces, by number."""
        values = {f.name: getattr(self, f.name)[piece] for f in fields(self)}
        return Segments(**{**values, "length": length})

    def parts(self, omega: float, spin: float) -> NDArray[np.intp]:
        """Into how many each must be cut for whirl up to ``omega`` at ``spin`` [rad/s].

        Short enough for the series, and so short that no piece can vibrate below ``omega`` with
        both ends clamped (``free_of_own_modes``).
        """
        inertia = self._inertia(omega, spin) + self.slope_share * np.abs(self.tension)
        mass, across = self.line_mass * omega**2, self.shear + self.tension
        p = mass / across + inertia / self.bending
        q = mass / self.bending * (self.slope_share**2 + inertia / across)
        series = self.length * np.sqrt((p + np.sqrt(q)) / LONGEST)
        parts = np.maximum(1, np.ceil(series)).astype(np.intp)
        while not (held := self.divided(parts).free_of_own_modes(omega, spin)).all():
            held_pieces = np.logical_and.reduceat(held, np.cumsum(parts) - parts)
            parts = np.where(held_pieces, parts, parts + 1 + parts // 4)
        return parts

    @property
    def slope_share(self) -> Array:
        """σ = κGA/(κGA + N): slope of the axis per tilt of the section, where Q = 0."""
        return np.asarray(self.shear / (self.shear + self.tension))

    @property
    def passage(self) -> float:
        """Time [s] that waves of shear and of bending together take to pass all pieces."""
        slowness = np.sqrt(self.line_mass / self.shear) + np.sqrt(self.rotary / self.bending)
        return float((slowness * self.length).sum())

    def free_of_own_modes(self, omega: float, spin: float) -> NDArray[np.bool_]:
        """Where no mode with clamped ends can lie below ``omega``, backward whirl included.

        From (r′ − φ)² ≥ (1 − 1/a) r′² − (a − 1) φ² for any a > 1 and the inequality of Poincaré,
        with the a that uses up the bending energy.
        """
        wave = (math.pi / self.length) ** 2
        spare = (self.bending * wave - self._inertia(omega, spin)) / self.shear  # a − 1
        sheared = spare / (1.0 + np.maximum(spare, 0.0)) * self.shear
        held = (sheared + self.tension) * wave
        return (spare > 0.0) & (held > self.line_mass * omega**2)

    def _inertia(self, omega: float, spin: float) -> Array:
        return self.rotary * (omega**2 + 2.0 * abs(spin) * abs(omega))


def transfer(segments: Segments, omega: ArrayLike, spin: float) -> Inexact:
    """e^{A h} of every piece at each whirl frequency, shape (*omega.shape, pieces, 4, 4).

    ``omega`` [rad/s]: real, its sign the direction of whirl, or complex, (…,); ``spin`` Ω [rad/s].
    """
    w = np.asarray(omega)[..., None]
    share, across = segments.slope_share, segments.shear + segments.tension
    inertia = segments.rotary * (w * w - 2.0 * spin * w) - share * segments.tension
    mass = segments.line_mass * w * w
    p = -(mass / across + inertia / segments.bending)
    q = -mass / segments.bending * (share**2 - inertia / across)
    c0, c1, c2, c3 = _series(p, q, segments.length)
    ahead = (share, 1.0 / across, -inertia, -share)  # of (r, M)′ by (φ, Q)
    back = (0.0, 1.0 / segments.bending, -mass, 0.0)  # of (φ, Q)′ by (r, M)
    there, around = _product(ahead, back), _product(back, ahead)
    whole = np.empty((*p.shape, 4, 4), dtype=p.dtype)
    whole[..., 0, 0], whole[..., 0, 3], whole[..., 3, 0], whole[..., 3, 3] = _sum(c0, c2, there)
    whole[..., 1, 1], whole[..., 1, 2], whole[..., 2, 1], whole[..., 2, 2] = _sum(c0, c2, around)
    whole[..., 0, 1], whole[..., 0, 2], whole[..., 3, 1], whole[..., 3, 2] = _product(
        _sum(c1, c3, there), ahead
    )
    whole[..., 1, 0], whole[..., 1, 3], whole[..., 2, 0], whole[..., 2, 3] = _product(
        _sum(c1, c3, around), back
    )
    return np.asarray(whole)


def _product(x: Entries, y: Entries) -> Entries:
    """Of two 2×2 matrices by their entries, row by row."""
    a, b, c, d = x
    e, f, g, h = y
    return a * e + b * g, a * f + b * h, c * e + d * g, c * f + d * h


def _sum(one: Inexact, other: Inexact, x: Entries) -> Entries:
    """one·I + other·x."""
    a, b, c, d = x
    return one + other * a, other * b, other * c, one + other * d


def _series(p: Inexact, q: Inexact, h: Array) -> tuple[Inexact, Inexact, Inexact, Inexact]:
    """Coefficients of I, A, A², A³ in e^{A h}, with A⁴ = p A² − q."""
    alpha, beta = np.zeros_like(p), np.ones_like(p)
    even, odd = np.ones_like(h), h.copy()
    c0, c1, c2, c3 = (np.zeros_like(p) for _ in range(4))
    for n in range(TERMS + 1):
        c0, c2 = c0 + beta * even, c2 + alpha * even
        c1, c3 = c1 + beta * odd, c3 + alpha * odd
        alpha, beta = p * alpha + beta, -q * alpha
        even = even * h * h / ((2 * n + 1) * (2 * n + 2))
        odd = odd * h * h / ((2 * n + 2) * (2 * n + 3))
    return c0, c1, c2, c3
