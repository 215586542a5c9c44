"""Time against true error, for elements of any degree and standard ones.

The reference is the exact shaft. Both machines turn from rest to their top speed; errors are the
largest relative ones of all bending frequencies of the band at all speeds. Times, the
fastest of some runs, are those of mesh, reduction and modes, with known bearing states.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

import rotordyn
from benchmarks.processes import ROOT
from rotordyn.analyses.campbell import solve as campbell
from rotordyn.analyses.campbell.spec import CampbellSpec
from rotordyn.equation.free_motion import FreeMotions
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.exact_shaft.bending import exact_poles

Array = NDArray[np.float64]
ACCURACIES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)
PARTS = (13, 25, 50, 100, 200, 400)
RUNS = 9
STAGES = ("mesh", "rotor", "subsystems", "bending system", "bending modes")


@dataclass(frozen=True, slots=True)
class Machine:
    """A machine without modal damping at some speeds [rad/s], up to ``band`` [Hz]."""

    name: str
    spindle: Spindle
    conditions: Conditions
    speed: Array
    band: float

    @classmethod
    def of_case(cls, case: str, name: str, band: float) -> Machine:
        """The machine of a shipped case at seven speeds up to its highest."""
        loaded = rotordyn.load(ROOT / "cases" / f"{case}.yaml")
        if loaded.spindle is None:
            raise ValueError(f"{case} has no spindle")
        spindle = replace(loaded.spindle, rotor_damping=())
        conditions = replace(loaded.conditions, element_length=None)
        return cls(name, spindle, conditions, np.linspace(0.0, loaded.speeds[-1], 7), band)

    def scene(self, **changes: Any) -> Scene:
        """A scene with the bearings solved."""
        scene = Scene(self.spindle, replace(self.conditions, **changes), self.speed, self.band)
        if self.spindle.seats:
            _ = scene.tangents
        return scene


def curves() -> list[dict[str, Any]]:
    """A line per machine and setting of its elements."""
    machines = (
        Machine.of_case("mfw2310", "MFW 2310, to 4 kHz", 4000.0),
        Machine.of_case("lalanne_ferraris", "Lalanne and Ferraris' rotor, to 600 Hz", 600.0),
    )
    return [line for machine in machines for line in _curve(machine)]


def _curve(machine: Machine) -> list[dict[str, Any]]:
    truth = exact_poles(machine.scene(), 1.1 * machine.band)
    length = machine.spindle.shaft.end - machine.spindle.shaft.start
    settings = [("any degree", f"{a:.0e}", {"accuracy": a}) for a in ACCURACIES]
    settings += [("standard", f"1/{n} of the shaft", {"element_length": length / n}) for n in PARTS]
    return [
        {"machine": machine.name, "elements": kind, "setting": name, **_line(machine, truth, asked)}
        for kind, name, asked in settings
    ]


def _line(machine: Machine, truth: Any, asked: dict[str, float]) -> dict[str, Any]:
    seconds = []
    for _ in range(RUNS):
        scene = machine.scene(**asked)
        (bending,) = scene.with_motions(("bending",))
        found = scene.system(bending)
        spent = scene.clock.seconds
        seconds.append(sum(spent[stage] for stage in STAGES if stage in spent))
    result = campbell.solve(scene, CampbellSpec(machine.band, shapes=False, engine_orders=()))
    return {
        "unknowns": found.modes.stiffness.shape[-1],
        "error": _error(machine, found, truth),
        "reported": result.largest_error,
        "seconds": min(seconds),
    }


def _error(machine: Machine, found: FreeMotions, truth: Any) -> float:
    """Largest true relative error of the frequencies in the band."""
    worst, low, high = 0.0, 0.02 * math.pi * machine.band, 2.0 * math.pi * machine.band
    for own, exact in zip(found.pole, truth, strict=True):
        inside = own[(own.imag > low) & (own.imag < high) & (np.abs(own.real) < own.imag)]
        gap = np.abs((exact.real + 1j * np.abs(exact.imag)) - inside[:, None])
        worst = max(worst, float((np.nanmin(gap, axis=1) / np.abs(inside)).max()))
    return worst
