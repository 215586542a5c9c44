"""The state of the machine at every temperature difference, each solved independently."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rotordyn.analyses.thermal_preload.result import ThermalPreloadResult
from rotordyn.analyses.thermal_preload.spec import ThermalPreloadSpec
from rotordyn.machine.temperatures import MEASURED, Temperatures
from rotordyn.scene.scene import Scene


def solve(scene: Scene, spec: ThermalPreloadSpec) -> ThermalPreloadResult:
    """Axial loads and ring growth over speed and difference; NaN without a usable state."""
    base = scene.conditions.temperatures or Temperatures(shaft=MEASURED)
    rows, cold = scene.bearing_row, np.array(scene.outcome, dtype=str)
    loads, growths, states = [], [], []
    for difference in spec.differences:
        warmer = replace(scene.conditions, temperatures=base.turning_warmer(difference))
        state = scene.under(warmer).preload
        usable = state.usable[:, None]
        loads.append(np.where(usable, state.seat_load(), np.nan)[rows])
        growths.append(np.where(usable, state.seat_growth(), np.nan)[rows])
        states.append(np.where(cold == "", np.array(state.outcome, dtype=str)[rows], cold))
    solved = (cold == "")[:, None, None]
    return ThermalPreloadResult(
        speed=scene.speed,
        difference=np.array(spec.differences),
        bearing=tuple(seat.name for seat in scene.spindle.seats),
        outcome=scene.outcome,
        state=np.stack(states, axis=1),
        axial_load=np.where(solved, np.stack(loads, axis=1), np.nan),
        growth=np.where(solved, np.stack(growths, axis=1), np.nan),
    )
