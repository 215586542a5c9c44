"""Hysteretic damping: stiffness with a loss factor, whose force leads by a quarter turn.

Against a motion e^(iωt) a stiffness K of loss factor η is K (1 + i η sgn ω). Parts that rotate with
the shaft see whirl e^(iωt) as e^(i(ω − Ω)t), so that there the sign is that of ω − Ω (Genta,
*Dynamics of Rotating Systems*, 2005). Over both planes y and z are amplitudes of one e^(iωt), the
sum of forward whirl e^(iωt) and backward whirl e^(−iωt), each with a sign of its own.

Motions of one set of signs are those of a linear system. A free motion e^(λt) has the signs of its
frequency Im λ: in fixed parts, as it is without any loss factor; in the shaft, as it is without
that of the shaft. So every mode has one set of signs, none is missed or repeated, and one that
rotates with the shaft has no loss in it. Loss moves frequencies by the square of its factor, so
that a sign is in doubt only that near to its change.

Theory: docs/theory/damping.md#hysteretic-damping.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from rotordyn.allowance import require_corrections
from rotordyn.arrays import Array, Complex, Flags, Indices, Matrix
from rotordyn.equation.connection import at_rows
from rotordyn.numerics.continued import collected, conjugate, continued
from rotordyn.numerics.correct import corrected, participation
from rotordyn.numerics.follow import mac
from rotordyn.numerics.modes import Modes, modes, oscillates, residual

MET = 1e-9  # of the larger: frequencies this close are the same
WIDE = 0.3  # of a frequency, which a loss factor of 1 moves by 0.1: farther off its sign is clear
ALIKE, FARTHEST = 0.3, 0.5  # MAC, and share of a pole: a mode with less or farther is another
REAL = 1e-9  # of a pole: less imaginary part is rounding


class Signs(NamedTuple):
    """Signs of the frequency seen by shaft and fixed parts, −1, 0 or 1; of many motions (k, 1, 1).

    ``forward`` sgn(ω − Ω); ``backward`` sgn(ω + Ω), of the backward whirl e^(−iωt) over both
    planes; ``fixed`` sgn ω, in fixed parts.
    """

    forward: Any
    backward: Any
    fixed: Any


SYNCHRONOUS = Signs(0, 1, 1)  # a motion that rotates with the shaft does not strain it cyclically


class Hysteresis(NamedTuple):
    """Loss factors times stiffness: ``fixed`` (s or 1, n, n) of fixed parts; ``turning`` (n, n) of
    shafts in bending; ``across`` (n, n): the same from plane z to y, and with opposite sign back,
    None of one complex plane."""

    fixed: Matrix
    turning: Matrix
    across: Matrix | None

    def at(self, rows: Indices) -> Hysteresis:
        """Return the loss at the speeds ``rows``."""
        return self._replace(fixed=at_rows(self.fixed, rows))

    def stiffness(self, signs: Signs) -> Complex:
        """Return the added stiffness (s or 1, n, n); of many signs (k, n, n) at one speed."""
        forward, backward, fixed = signs
        if self.across is None:
            return np.asarray(1j * (fixed * self.fixed + forward * self.turning))
        even = 1j * (fixed * self.fixed + 0.5 * (forward + backward) * self.turning)
        return np.asarray(even - 0.5 * (forward - backward) * self.across)

    @property
    def turns(self) -> bool:
        """True if the shaft has a loss factor."""
        return bool(self.turning.any())


class Hysteretic:
    """A system with loss factors at ``spin`` (s,) [rad/s].

    Free motions below ``ceiling`` [rad/s] are corrected one by one from those without loss. Whole
    systems are solved, once for every set of signs, where that does not lead to one mode each, and
    for receptances; for all, ``friswell_internal_damping`` takes 1.6 times as long. ``plain``:
    modes without loss, if known.
    """

    def __init__(
        self,
        stiffness: Matrix,
        damping: Matrix,
        loss: Hysteresis,
        spin: Array,
        ceiling: float = math.inf,
        plain: Modes | None = None,
    ) -> None:
        self.stiffness, self.damping, self.loss, self.spin = stiffness, damping, loss, spin
        self.ceiling, self.whirling = ceiling, loss.across is None
        self._plain = plain or modes(stiffness, damping)
        self._solved: dict[Signs, Modes] = {}

    def with_signs(self, signs: Signs) -> Modes:
        """Return the modes of the linear system for motions of some signs."""
        if signs not in self._solved:
            added, solved = self.loss.stiffness(signs), self._plain
            if added.any():
                solved = modes(self.stiffness + added, self.damping)
            self._solved[signs] = solved
        return self._solved[signs]

    def free_motions(self) -> Modes:
        """Return modes of free motion, in the order of those without loss factors; beyond the
        ceiling they are without loss.

        Their stiffness is without loss, so that sums over these modes are no receptances.
        """
        plain = self._plain
        solved = replace(
            plain,
            pole=plain.pole.copy(),
            vector=plain.vector.copy(),
            participation=plain.participation.copy(),
        )
        size = np.abs(plain.pole)
        frequency = np.where(oscillates(plain.pole), np.abs(plain.pole.imag), size)
        chosen = (frequency < self.ceiling) & ~plain.at_rest()
        chosen &= (plain.pole.imag >= 0.0) | self.whirling
        count = chosen.sum(axis=1)
        require_corrections(int(count.sum()), int(count.max()), plain.vector.shape[1])
        rows = range(len(self.spin))
        doubtful = [row for row in rows if not self._correct(solved, row, chosen[row])]
        if not doubtful:
            return solved
        replacement = self._part(np.array(doubtful))._of_whole_systems()
        for name in ("pole", "vector", "participation"):
            getattr(solved, name)[doubtful] = getattr(replacement, name)
        return solved

    def _correct(self, solved: Modes, row: int, chosen: Flags) -> bool:
        """Replace ``chosen`` modes by those with loss at one speed; return False, and change
        nothing, where one of them is not clearly the same mode."""
        column, spin = np.flatnonzero(chosen), self.spin[row]
        if not column.size:
            return True
        before, plain = solved.pole[row, column], solved.vector[row][:, column]
        signs, at, vector = self._signs(before[None], spin)[0], before.copy(), plain.T.copy()
        if self.loss.turns:
            frequency = before.imag if self.whirling else np.abs(before.imag)
            close = np.abs(frequency - spin) <= WIDE * np.abs(frequency)
            fixed_signs = signs[close] * (0, 1, 1)
            at[close], vector[close], converged = corrected(
                self._stiffness_for(row, fixed_signs), self.damping[row], at[close], vector[close]
            )
            if not converged.all():
                return False
            signs[close, 0] = self._signs(at[None, close], spin)[0][:, 0]
        stiffness = self._stiffness_for(row, signs)
        at, vector, converged = corrected(stiffness, self.damping[row], at, vector)
        if not converged.all():
            return False
        straight = (before.imag == 0.0) & (not self.whirling)
        at = np.where(straight & (np.abs(at.imag) <= REAL * np.abs(at)), at.real, at)
        same = mac(plain, vector.T).diagonal() > ALIKE
        same &= (np.abs(at - before) < FARTHEST * np.abs(before)) & ((at.imag == 0.0) | ~straight)
        equal = np.abs(at[:, None] - at) <= MET * np.abs(at)
        if not same.all() or equal.sum() > len(at):
            return False
        left = participation(stiffness, self.damping[row], at, vector)
        pairs = np.flatnonzero(~(straight | self.whirling))
        conjugates = np.abs(solved.pole[row] - before[pairs, None].conj()).argmin(axis=1)
        columns = np.append(column, conjugates)
        solved.pole[row, columns] = np.append(at, at[pairs].conj())
        solved.vector[row][:, columns] = np.concatenate([vector, vector[pairs].conj()]).T
        solved.participation[row, columns] = np.concatenate([left, left[pairs].conj()])
        return True

    def _stiffness_for(self, row: int, signs: Indices) -> Complex:
        """Return the stiffness (k, n, n) for each of ``signs`` (k, 3) at one speed."""
        loss = self.loss.at(np.array([row]))
        return self.stiffness[row] + loss.stiffness(Signs(*signs.T[:, :, None, None]))

    def _part(self, rows: Indices) -> Hysteretic:
        """Return the system at some of the speeds."""
        system = self.stiffness[rows], self.damping[rows], self.loss.at(rows)
        return Hysteretic(*system, self.spin[rows], plain=self._plain.at(rows))

    def _of_whole_systems(self) -> Modes:
        """Return modes of free motion from all modes of every set of signs."""
        signs = self._signs(self._plain.pole)
        signs[..., 0] = 0
        solved = self._continued([signs])
        if not self.loss.turns:
            return solved
        with_shaft = self._signs(solved.pole)
        with_shaft[..., 1:] = signs[..., 1:]
        return self._continued([signs, with_shaft])

    def receptance(self, omega: Array, responses: Array, excitations: Array) -> Complex:
        """Return receptances of paired rows (pairs, n) at i·``omega`` (f,) or (s, f), every
        frequency with its own signs: (s, pairs, f)."""
        omega = np.broadcast_to(omega, (len(self.spin), omega.shape[-1]))
        signs = signs_of(omega.real, self.spin[:, None], whirling=self.whirling)
        total = np.empty((len(self.spin), len(responses), omega.shape[-1]), dtype=complex)
        for key, at in gathered(signs):
            motions = self.with_signs(key)
            for row in np.flatnonzero(at.any(axis=1)).tolist():
                places, system = at[row], motions.at(np.array([row]))
                total[row][:, places] = system.receptance(
                    omega[row, places], responses, excitations
                )[0]
        return total

    @property
    def residual(self) -> float:
        """Largest relative residual of all eigenpairs of whole systems; modes corrected one by one
        have converged to rounding."""
        systems = [self._plain, *self._solved.values()]
        return max(residual(m, m.stiffness, m.damping) for m in systems)

    def _signs(self, pole: Complex, spin: Array | None = None) -> Indices:
        """Return the signs of free motions (s, k, 3); over both planes those of |Im λ|."""
        omega = np.where(oscillates(pole), pole.imag, 0.0)
        one_way = omega if self.whirling else np.abs(omega)
        spins = self.spin[:, None] if spin is None else spin
        return signs_of(one_way, spins, whirling=self.whirling)

    def _continued(self, stages: Sequence[Indices]) -> Modes:
        """Continue every mode through the systems of its signs, in order: each of ``stages``
        (s, k, 3). Over both planes a mode with Im λ < 0 is one of the conjugate system."""
        plain = self._plain
        below = (plain.pole.imag < 0.0)[..., None] & (not self.whirling)
        keys = np.concatenate([*stages, below], axis=-1)
        parts = []
        for key in np.unique(keys.reshape(-1, keys.shape[-1]), axis=0).tolist():
            taken = (keys == key).all(axis=-1)
            rows = np.flatnonzero(taken.any(axis=-1))
            before, column = plain, np.tile(np.arange(taken.shape[1]), (len(taken), 1))
            for start in range(0, len(key) - 1, 3):
                after = self.with_signs(Signs(*key[start : start + 3]))
                after = conjugate(after) if key[-1] else after
                column = np.take_along_axis(continued(before, after, rows), column, axis=-1)
                before = after
            parts.append((before, column, taken))
        return collected(plain, parts)


def signs_of(omega: Array, spin: Array, *, whirling: bool) -> Indices:
    """Return signs (…, 3) of motions e^(iωt) at ``spin``; ``whirling``: backward is separate."""
    forward, backward = _sign(omega, spin), _sign(omega, -spin)
    if whirling:
        backward = np.zeros_like(backward)
    fixed = np.sign(omega + 0.0 * spin).astype(np.intp)
    return np.stack([forward, backward, fixed], axis=-1)


def signs_at(omega: float, *, whirling: bool = False) -> Signs:
    """Return the signs of a motion at ``omega`` times the spin."""
    return Signs(*map(int, signs_of(np.array(omega), np.array(1.0), whirling=whirling)))


def gathered(signs: Indices) -> Sequence[tuple[Signs, Flags]]:
    """Group ``signs`` (…, 3): each combination that occurs, with a mask (…) of its places."""
    sets = np.unique(signs.reshape(-1, 3), axis=0)
    return [(Signs(*map(int, key)), (signs == key).all(axis=-1)) for key in sets]


def _sign(omega: Array, spin: Array) -> Indices:
    difference = omega - spin
    clear = np.abs(difference) > MET * np.maximum(np.abs(omega), np.abs(spin))
    return np.where(clear, np.sign(difference), 0.0).astype(np.intp)
