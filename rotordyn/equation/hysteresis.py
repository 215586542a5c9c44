"""Hysteretic damping: stiffness with a loss factor, whose force leads by a quarter turn.

A motion e^(iωt) against a stiffness K of loss factor η is answered by K (1 + i η sgn ω). What turns
with the shaft sees whirl e^(iωt) as e^(i(ω − Ω)t), so that there the sign is that of ω − Ω (Genta,
*Dynamics of Rotating Systems*, 2005). Over both planes y and z are amplitudes of one e^(iωt), the
sum of forward whirl e^(iωt) and backward whirl e^(−iωt), each with a sign of its own.

Motions of one set of signs are those of a linear system. A free motion e^(λt) has the signs of its
frequency Im λ: in what does not turn, as it is without any loss factor; in the shaft, as it is
without that of the shaft. So every mode has one set of signs, none is missed or found twice, and
one that turns with the shaft has no loss in it. Loss moves frequencies by the square of its factor,
so that a sign is in doubt only that near to its change.

Theory: docs/theory/damping.md#hysteretic-damping.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rotordyn.numerics.continued import collected, conjugate, continued
from rotordyn.numerics.modes import Modes, modes, residual

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Matrix = NDArray[np.inexact[Any]]
Integers = NDArray[np.intp]
MET = 1e-9  # of the larger: frequencies so near are the same
STRAIGHT = 1e-6  # of |pole|: less imaginary part than that is no vibration


class Signs(NamedTuple):
    """Which way the shaft works in itself under motions e^(iωt), −1, 0 or 1.

    ``forward`` sgn(ω − Ω); ``backward`` sgn(ω + Ω), of the backward whirl e^(−iωt) over both
    planes; ``fixed`` sgn ω, in what does not turn.
    """

    forward: int
    backward: int
    fixed: int


SYNCHRONOUS = Signs(0, 1, 1)  # what turns with the shaft does not move in it


@dataclass(frozen=True, eq=False, slots=True)
class Hysteresis:
    """Loss factors times stiffness: ``fixed`` (s or 1, n, n) of what does not turn; ``turning``
    (n, n) of the shaft; ``across`` (n, n): the same from plane z to y, and with opposite sign back,
    None of one complex plane."""

    fixed: Matrix
    turning: Array
    across: Array | None

    def stiffness(self, signs: Signs) -> Complex:
        """What it adds to the stiffness (s or 1, n, n)."""
        ahead, behind, fixed = signs
        if self.across is None:
            return np.asarray(1j * (fixed * self.fixed + ahead * self.turning))
        even = 1j * (fixed * self.fixed + 0.5 * (ahead + behind) * self.turning)
        return np.asarray(even - 0.5 * (ahead - behind) * self.across)

    @property
    def turns(self) -> bool:
        """True where the shaft has a loss factor."""
        return bool(self.turning.any())


class Hysteretic:
    """A system with loss factors at ``spin`` (s,) [rad/s], solved for every set of signs once."""

    def __init__(self, stiffness: Matrix, damping: Matrix, loss: Hysteresis, spin: Array) -> None:
        self.stiffness, self.damping, self.loss, self.spin = stiffness, damping, loss, spin
        self.whirling = loss.across is None
        self._plain = modes(stiffness, damping)
        self._solved: dict[Signs, Modes] = {}

    def answering(self, signs: Signs) -> Modes:
        """Modes of the linear system that answers motions of some signs."""
        if signs not in self._solved:
            added, found = self.loss.stiffness(signs), self._plain
            if added.any():
                found = modes(self.stiffness + added, self.damping)
            self._solved[signs] = found
        return self._solved[signs]

    def free_motions(self) -> Modes:
        """Modes of free motion, in the order of those without loss factors.

        Their stiffness is without loss, so that sums over these modes are no receptances.
        """
        signs = self._signs(self._plain.pole)
        signs[..., 0] = 0
        found = self._continued([signs])
        if not self.loss.turns:
            return found
        onward = self._signs(found.pole)
        onward[..., 1:] = signs[..., 1:]
        return self._continued([signs, onward])

    def receptance(self, omega: Array, responses: Array, excitations: Array) -> Complex:
        """Receptance at i·``omega`` (f,) or (s, f) of paired rows (pairs, n), every frequency with
        its own signs: (s, pairs, f)."""
        omega = np.broadcast_to(omega, (len(self.spin), omega.shape[-1]))
        signs = signs_of(omega, self.spin[:, None], whirling=self.whirling)
        total = np.empty((len(self.spin), len(responses), omega.shape[-1]), dtype=complex)
        for each, at in gathered(signs):
            found = self.answering(each)
            for row in np.flatnonzero(at.any(axis=1)).tolist():
                own, one = at[row], found.at(np.array([row]))
                total[row][:, own] = one.receptance(omega[row, own], responses, excitations)[0]
        return total

    @property
    def residual(self) -> float:
        """Largest relative residual of all eigenpairs solved."""
        return max(residual(m, m.stiffness, m.damping) for m in self._solved.values())

    def _signs(self, pole: Complex) -> Integers:
        """Of free motions (s, k, 3); over both planes those of |Im λ|."""
        omega = np.where(np.abs(pole.imag) > STRAIGHT * np.abs(pole), pole.imag, 0.0)
        one_way = omega if self.whirling else np.abs(omega)
        return signs_of(one_way, self.spin[:, None], whirling=self.whirling)

    def _continued(self, ways: Sequence[Integers]) -> Modes:
        """Every mode led through the systems of its signs, one after another: each of ``ways``
        (s, k, 3). Over both planes a mode with Im λ < 0 is one of the conjugate system."""
        plain = self._plain
        below = (plain.pole.imag < 0.0)[..., None] & (not self.whirling)
        keys = np.concatenate([*ways, below], axis=-1)
        parts = []
        for key in np.unique(keys.reshape(-1, keys.shape[-1]), axis=0).tolist():
            taken = (keys == key).all(axis=-1)
            rows = np.flatnonzero(taken.any(axis=-1))
            before, column = plain, np.tile(np.arange(taken.shape[1]), (len(taken), 1))
            for first in range(0, len(key) - 1, 3):
                after = self.answering(Signs(*key[first : first + 3]))
                after = conjugate(after) if key[-1] else after
                column = np.take_along_axis(continued(before, after, rows), column, axis=-1)
                before = after
            parts.append((before, column, taken))
        return collected(plain, parts)


def signs_of(omega: Array, spin: Array, *, whirling: bool) -> Integers:
    """Signs (…, 3) of motions e^(iωt) at ``spin``; ``whirling``: backward ones stand alone."""
    forward, backward = _sign(omega, spin), _sign(omega, -spin)
    if whirling:
        backward = np.zeros_like(backward)
    still = np.sign(omega + 0.0 * spin).astype(np.intp)
    return np.stack([forward, backward, still], axis=-1)


def gathered(signs: Integers) -> Sequence[tuple[Signs, NDArray[np.bool_]]]:
    """Each set of signs that occurs, and where (…)."""
    every = np.unique(signs.reshape(-1, 3), axis=0)
    return [(Signs(*map(int, one)), (signs == one).all(axis=-1)) for one in every]


def _sign(omega: Array, spin: Array) -> Integers:
    apart = omega - spin
    clear = np.abs(apart) > MET * np.maximum(np.abs(omega), np.abs(spin))
    return np.where(clear, np.sign(apart), 0.0).astype(np.intp)
