"""Systems with loss factors: free motions and receptances, each with its own signs.

Motions of one set of signs are those of a linear system. A free motion e^(λt) has the signs of its
frequency Im λ: in what does not turn, as it is without any loss factor; in the shaft, as it is
without that of the shaft. So every mode has one set of signs, none is missed or found twice, and
one that turns with the shaft has no loss in it. Loss moves frequencies by the square of its factor,
so that a sign is in doubt only that near to its change.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rotordyn.numerics.continued import collected, conjugate, continued
from rotordyn.numerics.modes import Modes, modes, residual
from rotordyn.system.coupled import CoupledSystem
from rotordyn.system.hysteresis import Hysteresis, Integers, Signs, gathered, signs_of
from rotordyn.system.lateral import LateralSystem
from rotordyn.system.longitudinal import RodSystem

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
System = LateralSystem | RodSystem | CoupledSystem
STRAIGHT = 1e-6  # of |pole|: less imaginary part than that is no vibration


class Hysteretic:
    """A system with loss factors at ``spin`` (speeds,) [rad/s], solved for every set of signs once.

    ``loss``: what its loss factors add.
    """

    def __init__(self, system: System, loss: Hysteresis, spin: Array) -> None:
        self.system, self.loss, self.spin = system, loss, spin
        self.whirling = isinstance(system, LateralSystem) and system.isotropic
        still = np.zeros_like(spin)
        self.frame = still if isinstance(system, CoupledSystem) else system.frame
        self._plain = modes(system.stiffness, system.damping)
        self._solved: dict[Signs, tuple[System, Modes]] = {}

    def answering(self, signs: Signs) -> tuple[System, Modes]:
        """The linear system that answers motions of some signs, and its modes."""
        if signs not in self._solved:
            linear, found = self.system.answering(signs), self._plain
            if self.loss.stiffness(signs).any():
                found = modes(linear.stiffness, linear.damping)
            self._solved[signs] = linear, found
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
        """Receptance at i·``omega`` (f,) of paired rows (pairs, n), every frequency with its own
        signs: (speeds, pairs, f)."""
        seen = omega + self.frame[:, None]
        signs = signs_of(seen, self.spin[:, None], whirling=self.whirling)
        total = np.empty((len(self.spin), len(responses), len(omega)), dtype=complex)
        for each, at in gathered(signs):
            found = self.answering(each)[1]
            for row in np.flatnonzero(at.any(axis=1)).tolist():
                own, one = at[row], found.at(np.array([row]))
                total[row][:, own] = one.receptance(omega[own], responses, excitations)[0]
        return total

    def regions(self) -> list[tuple[Signs, Array, Array]]:
        """Signs of motions with ``low`` < ω < ``high`` (speeds,) [rad/s]: of both directions in the
        complex form, else of ω > 0; none with ``low`` = ``high``."""
        still, far = np.zeros_like(self.spin), np.full_like(self.spin, np.inf)
        turn = self.spin if self.loss.turns else still
        behind = 0 if self.whirling else 1
        found = [(Signs(1, behind, 1), turn, far), (Signs(-1, behind, 1), still, turn)]
        if self.whirling:
            found.append((Signs(-1, 0, -1), -far, still))
        return found

    @property
    def residual(self) -> float:
        """Largest relative residual of all eigenpairs solved."""
        return max(residual(m, m.stiffness, m.damping) for _, m in self._solved.values())

    def _signs(self, pole: Complex) -> Integers:
        """Of free motions (speeds, k, 3); of the real form those of |Im λ|."""
        seen = pole + 1j * self.frame[:, None]
        omega = np.where(np.abs(seen.imag) > STRAIGHT * np.abs(seen), seen.imag, 0.0)
        one_way = omega if self.whirling else np.abs(omega)
        return signs_of(one_way, self.spin[:, None], whirling=self.whirling)

    def _continued(self, ways: Sequence[Integers]) -> Modes:
        """Every mode led through the systems of its signs, one after another: each of ``ways``
        (speeds, k, 3).

        In the real form a mode with Im λ < 0 is one of the conjugate system.
        """
        plain = self._plain
        below = (plain.pole.imag < 0.0)[..., None] & (not self.whirling)
        keys = np.concatenate([*ways, below], axis=-1)
        parts = []
        for key in np.unique(keys.reshape(-1, keys.shape[-1]), axis=0).tolist():
            taken = (keys == key).all(axis=-1)
            rows = np.flatnonzero(taken.any(axis=-1))
            before, column = plain, np.tile(np.arange(taken.shape[1]), (len(taken), 1))
            for first in range(0, len(key) - 1, 3):
                after = self.answering(Signs(*key[first : first + 3]))[1]
                after = conjugate(after) if key[-1] else after
                column = np.take_along_axis(continued(before, after, rows), column, axis=-1)
                before = after
            parts.append((before, column, taken))
        return collected(plain, parts)
