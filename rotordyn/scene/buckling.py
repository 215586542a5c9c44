"""Buckling of the shaft under its axial force, and the largest force that it withstands."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from rotordyn.arrays import Array, Flags, Indices
from rotordyn.equation.seat import in_spindle_frame
from rotordyn.equation.statics import stays_stable
from rotordyn.equation.structure import Structure
from rotordyn.equation.term import State
from rotordyn.machine.spindle import Spindle
from rotordyn.preload.axial_force import AxialForce
from rotordyn.results.display import RPM

HALVINGS = 30


@dataclass(frozen=True, eq=False, slots=True)
class Loading:
    """Axial states of a machine: bearing loads (states, seats) [N] and tangents in their frames.

    ``speed`` (states,) [rad/s]: of the shaft. ``structure`` is called only where the shaft is
    compressed. ``along``: force in a shaft under bearing loads and a share of all axial forces;
    ``cause``: the name of these.
    """

    spindle: Spindle
    speed: Array
    structure: Callable[[], Structure]
    seat_load: Array
    seat_stiffness: Array
    along: Callable[[Spindle, Array, float], AxialForce]
    cause: str

    def outcomes(self) -> tuple[str, ...]:
        """Return a message per state: empty, or that the shaft buckles, and what it withstands."""
        finite = np.asarray(np.isfinite(self.seat_load).all(axis=1))
        if not finite.any() or not self.along(self.spindle, self.seat_load, 1.0).compresses:
            return ("",) * len(self.speed)
        stable = np.full(len(finite), True)
        stable[finite] = self.at(np.flatnonzero(finite))._withstands(1.0, 1.0)
        return tuple(
            "" if withstood else self.at(np.array([row]))._sentence(self.speed[row] * RPM.factor)
            for row, withstood in enumerate(stable)
        )

    def at(self, index: Indices) -> Loading:
        """Select states by index."""
        load, stiffness = self.seat_load[index], self.seat_stiffness[index]
        return replace(self, speed=self.speed[index], seat_load=load, seat_stiffness=stiffness)

    def _withstands(self, forces: float, bar: float) -> Flags:
        """Return states that are stable under shares of axial ``forces`` and drawbar force,
        ``bar``."""
        spindle, structure = self.spindle, self.structure()
        if spindle.drawbar:
            drawbar = (
                replace(spindle.drawbar, force=bar * spindle.drawbar.force) if bar > 0.0 else None
            )
            spindle = replace(spindle, drawbar=drawbar)
        force = self.along(spindle, self.seat_load, forces).bending(structure.shown.middle)
        stops = np.zeros((len(self.speed), len(structure.spindle.sleeves)), dtype=bool)
        tangents = in_spindle_frame(spindle.seats, self.seat_stiffness)
        state = State(self.speed, tangents, stops)
        return stays_stable(structure, state, force, bar)

    def _sentence(self, rpm: float) -> str:
        """Return the message of a single state that buckles."""
        bar = self.spindle.drawbar
        if bar and bar.contacts and self._withstands(1.0, 0.0)[0]:
            largest = _largest(lambda share: bool(self._withstands(1.0, share)[0]))
            return (
                f"the drawbar force buckles the shaft at {rpm:.0f} rpm: given "
                f"{bar.force / 1e3:.4g} kN, at most {largest * bar.force / 1e3:.4g} kN"
            )
        largest = _largest(lambda share: bool(self._withstands(share, share)[0]))
        return (
            f"the {self.cause} buckles the shaft at {rpm:.0f} rpm, {largest:.3g} times that force "
            "would not: reduce it or support the shaft more stiffly"
        )


def _largest(stands: Callable[[float], bool]) -> float:
    """Return the largest share below 1 at which the shaft is stable, by bisection."""
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if stands(middle) else (low, middle)
    return low
