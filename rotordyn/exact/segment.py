"""Uniform piece of a spinning Timoshenko shaft, solved exactly at one frequency of whirl.

With r = y + i z, φ = θz − i θy turning as e^{iωt}, shear force Q = κGA (r′ − φ), moment M = EI φ′:

    r′ = φ + Q/κGA,   φ′ = M/EI,   Q′ = −ρA ω² r,   M′ = −Q − ρI (ω² − 2 Ω ω) φ

The state (r, φ, Q, M) at the end of a piece is e^{A h} times that at its start. A² obeys
z² − p z + q = 0, so that the exponential is four scalar power series, free of cancellation on
pieces of moderate |z| h².  (Cf. Banerjee, J. Sound Vib. 247 (2001) 97, for spinning beams.)
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Inexact = NDArray[np.inexact]

LONGEST = 4.0  # |z| h² of a piece
TERMS = 14  # 4^14 / 28! is below rounding


@dataclass(frozen=True, eq=False, slots=True)
class Segments:
    """Uniform pieces in a row, each field (pieces,) in SI.

    ``length`` [m], ``shear`` κGA [N], ``bending`` EI [N·m²], ``line_mass`` ρA [kg/m],
    ``rotary`` ρI [kg·m].
    """

    length: Array
    shear: Array
    bending: Array
    line_mass: Array
    rotary: Array

    def divided(self, parts: NDArray[np.intp]) -> Segments:
        """Every piece cut into equal ``parts`` (pieces,)."""
        values = {f.name: np.repeat(getattr(self, f.name), parts) for f in fields(self)}
        values["length"] = values["length"] / np.repeat(parts, parts)
        return Segments(**values)

    def parts(self, omega: float, spin: float) -> NDArray[np.intp]:
        """Into how many each must be cut for whirl up to ``omega`` at ``spin`` [rad/s].

        Short enough for the series, and so short that no piece can vibrate below ``omega`` with
        both ends clamped (``free_of_own_modes``).
        """
        inertia = self.rotary * (omega**2 + 2.0 * abs(spin) * abs(omega))
        mass = self.line_mass * omega**2
        p = mass / self.shear + inertia / self.bending
        q = mass / self.bending * (1.0 + inertia / self.shear)
        series = self.length * np.sqrt((p + np.sqrt(q)) / LONGEST)
        parts = np.maximum(1, np.ceil(series)).astype(np.intp)
        while not (held := self.divided(parts).free_of_own_modes(omega, spin)).all():
            held_pieces = np.logical_and.reduceat(held, np.cumsum(parts) - parts)
            parts = np.where(held_pieces, parts, parts + 1 + parts // 4)
        return parts

    def free_of_own_modes(self, omega: float, spin: float) -> NDArray[np.bool_]:
        """Where no mode with clamped ends can lie below ``omega``, backward whirl included.

        From (r′ − φ)² ≥ (1 − 1/a) r′² − (a − 1) φ² for any a > 1 and the inequality of Poincaré,
        with the a that uses up the bending energy.
        """
        wave = (math.pi / self.length) ** 2
        inertia = self.rotary * (omega**2 + 2.0 * abs(spin) * abs(omega))
        spare = (self.bending * wave - inertia) / self.shear  # a − 1
        held = spare / (1.0 + np.maximum(spare, 0.0)) * self.shear * wave
        return (spare > 0.0) & (held > self.line_mass * omega**2)


def transfer(segments: Segments, omega: ArrayLike, spin: float) -> Inexact:
    """e^{A h} of every piece at each whirl frequency, shape (*omega.shape, pieces, 4, 4).

    ``omega`` [rad/s]: real, its sign the direction of whirl, or complex, (…,); ``spin`` Ω [rad/s].
    """
    w = np.asarray(omega)[..., None]
    inertia = segments.rotary * (w * w - 2.0 * spin * w)
    mass = segments.line_mass * w * w
    a = _generator(segments, mass, inertia)
    square = a @ a
    p = -(mass / segments.shear + inertia / segments.bending)
    q = -mass / segments.bending * (1.0 - inertia / segments.shear)
    c0, c1, c2, c3 = (c[..., None, None] for c in _series(p, q, segments.length))
    return np.asarray(c0 * np.eye(4) + c1 * a + c2 * square + c3 * (a @ square))


def _generator(segments: Segments, mass: Inexact, inertia: Inexact) -> Inexact:
    a = np.zeros((*mass.shape, 4, 4), dtype=mass.dtype)
    a[..., 0, 1] = 1.0
    a[..., 0, 2] = 1.0 / segments.shear
    a[..., 1, 3] = 1.0 / segments.bending
    a[..., 2, 0] = -mass
    a[..., 3, 1] = -inertia
    a[..., 3, 2] = -1.0
    return a


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
