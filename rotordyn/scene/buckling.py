"""Buckling of the shaft under its axial force, and the largest force that it withstands."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.arrays import Array, Flags, Indices
from rotordyn.equation.seat import in_spindle_frame
from rotordyn.equation.statics import stays_stable
from rotordyn.equation.term import State
from rotordyn.numerics.crossing import boundary
from rotordyn.results.display import RPM

if TYPE_CHECKING:
    from rotordyn.scene.statics import Statics


@dataclass(frozen=True, eq=False, slots=True)
class Loading:
    """Axial states of a ``machine``: bearing loads (states, seats) [N], tangents in their frames,
    and the ``speed`` (states,) [rad/s] of the shaft. The rotor is built only where the shaft is
    compressed."""

    machine: Statics
    speed: Array
    seat_load: Array
    seat_stiffness: Array

    def outcomes(self) -> tuple[str, ...]:
        """Return a message per state: empty, or that the shaft buckles, and what it withstands."""
        finite = np.asarray(np.isfinite(self.seat_load).all(axis=1))
        along = self.machine.along(self.machine.grounded, self.seat_load)
        if not finite.any() or not along.compresses:
            return ("",) * len(self.speed)
        stable = np.full(len(finite), True)
        stable[finite] = self._withstands(np.flatnonzero(finite), 1.0, 1.0)
        return tuple(
            "" if withstood else self._sentence(row) for row, withstood in enumerate(stable)
        )

    def _withstands(self, rows: Indices, forces: float, bar: float) -> Flags:
        """Return which states ``rows`` are stable under shares of axial ``forces`` and drawbar
        force, ``bar``."""
        spindle, structure = self.machine.grounded, self.machine.rotor
        if spindle.drawbar:
            drawbar = (
                replace(spindle.drawbar, force=bar * spindle.drawbar.force) if bar > 0.0 else None
            )
            spindle = replace(spindle, drawbar=drawbar)
        along = self.machine.along(spindle, self.seat_load[rows], forces)
        stops = np.zeros((len(rows), len(structure.spindle.sleeves)), dtype=bool)
        tangents = in_spindle_frame(spindle.seats, self.seat_stiffness[rows])
        state = State(self.speed[rows], tangents, stops)
        return stays_stable(structure, state, along.bending(structure.shown.middle), bar)

    def _sentence(self, row: int) -> str:
        """Return the message of a state that buckles."""
        rows, rpm, bar = (
            np.array([row]),
            self.speed[row] * RPM.factor,
            self.machine.grounded.drawbar,
        )
        if bar and bar.contacts and self._withstands(rows, 1.0, 0.0)[0]:
            largest, _ = boundary(
                lambda share: bool(self._withstands(rows, 1.0, share)[0]), 0.0, 1.0
            )
            return (
                f"the drawbar force buckles the shaft at {rpm:.0f} rpm: given "
                f"{bar.force / 1e3:.4g} kN, at most {largest * bar.force / 1e3:.4g} kN"
            )
        acting, cause = self.machine.conditions, "axial force"
        if acting.tension < 0.0 and not acting.axial_force and not self.machine.gravity:
            cause = f"tension of {acting.tension / 1e3:.4g} kN"
        largest, _ = boundary(lambda share: bool(self._withstands(rows, share, share)[0]), 0.0, 1.0)
        return (
            f"the {cause} buckles the shaft at {rpm:.0f} rpm, {largest:.3g} times that force "
            "would not: reduce it or support the shaft more stiffly"
        )
