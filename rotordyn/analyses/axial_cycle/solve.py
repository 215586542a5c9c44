"""A cycle of axial force at every speed, after the history of the case.

The force goes to its highest and lowest value once, so that friction stands as it does in every
later cycle; then the falling and the rising branch are taken. Energy lost per cycle: the area
between the branches, ∮ F du, by the trapezoidal rule.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rotordyn.allowance import require_history, require_time
from rotordyn.analyses.axial_cycle.result import BRANCHES, AxialCycleResult
from rotordyn.analyses.axial_cycle.spec import AxialCycleSpec
from rotordyn.preload.arrangement import SHAFT
from rotordyn.preload.history import History, history
from rotordyn.scene.scene import Scene
from rotordyn.state import NoEquilibrium
from rotordyn.state.contacts import State

Array = NDArray[np.float64]


def answer(scene: Scene, spec: AxialCycleSpec) -> AxialCycleResult:
    """Positions, loads, friction and stiffness over the cycle.

    Raises
    ------
    InvalidInput : that takes more time or memory than is allowed
    """
    preload, rows = scene.preload, scene.bearing_row
    force = np.linspace(spec.lowest, spec.highest, spec.steps + 1)
    steps = len(preload.speed) * (2 * spec.steps + 3)
    require_history(f"axial_cycle: {steps} steps", 0, steps)
    of_seat = preload.network.arrangement.bearing_of_seat
    path = history(preload, max(abs(spec.lowest), abs(spec.highest)))
    seats, sleeves = scene.spindle.seats, scene.spindle.sleeves
    shape = (len(preload.speed), len(BRANCHES), len(force))
    position = np.full((*shape, len(preload.network.arrangement.bodies)), np.nan)
    load = np.full((*shape, len(seats)), np.nan)
    friction, stop = np.full((2, *shape, len(sleeves)), np.nan)
    stiffness, held = np.full(shape, np.nan), np.full((shape[0], shape[2]), np.nan)
    reach = float(force[-1] - force[0])
    outcome = list(preload.outcome)
    for row, start in enumerate(path.run_up()):
        require_time("axial_cycle", "broken off")
        outcome[row] = outcome[row] or (start if isinstance(start, str) else "")
        if isinstance(start, str) or outcome[row]:
            continue
        try:
            branches = _branches(path, row, start, force)
        except NoEquilibrium as none:
            outcome[row] = f"no cycle: {none}"
            continue
        for k, states in enumerate(branches):
            position[row, k] = [state.x for state in states]
            load[row, k] = [state.at.load[of_seat] for state in states]
            friction[row, k], stop[row, k] = _sleeves(path, states)
            stiffness[row, k] = _stiffness(path, row, states, force, way=(-1.0, 1.0)[k])
        held[row] = [
            path.force_to_slide(row, state, value, reach)
            for state, value in zip(branches[0], force.tolist(), strict=True)
        ]
    return AxialCycleResult(
        speed=scene.speed,
        branch=BRANCHES,
        force=force,
        body=preload.network.arrangement.bodies,
        bearing=tuple(seat.name for seat in seats),
        sleeve=tuple(sleeve.name for sleeve in sleeves),
        outcome=tuple(outcome[row] for row in rows),
        position=position[rows],
        axial_load=load[rows],
        friction=friction[rows],
        stop_force=stop[rows],
        stiffness=stiffness[rows],
        held_force=0.5 * held[rows],
        held_mean=force + 0.5 * held[rows],
        no_load_stiffness=_at_no_load(force, stiffness)[rows],
        loss=_loss(force, position[..., SHAFT])[rows],
    )


def _branches(path: History, row: int, start: State, force: Array) -> list[list[State]]:
    """States at every force, ascending, on the falling and on the rising branch."""
    *_, top = path.loaded(row, start, [force[-1], force[0], force[-1]])
    there = path.under(row, float(force[-1]))
    falling = path.loaded(row, top, force[-2::-1].tolist(), there)
    here = path.under(row, float(force[0]))
    rising = path.loaded(row, falling[-1], force[1:].tolist(), here)
    return [[*falling[::-1], top], [falling[-1], *rising]]


def _sleeves(path: History, states: list[State]) -> tuple[Array, Array]:
    """Friction and stop forces on every sleeve (states, sleeves)."""
    network = path.network
    friction = np.array([state.friction @ network.frictions.row for state in states])
    press = np.array([(network.stops.side * s.press) @ network.stops.row for s in states])
    return friction[:, SHAFT + 1 :], press[:, SHAFT + 1 :]


def _stiffness(path: History, row: int, states: list[State], force: Array, way: float) -> Array:
    """Slope of the force over the displacement of the shaft, going on ``way`` [N/m]."""
    soft = [path.compliance(row, s, f, way) for s, f in zip(states, force.tolist(), strict=True)]
    return 1.0 / np.array(soft)


def _at_no_load(force: Array, stiffness: Array) -> Array:
    """Stiffness where the force is zero; NaN where the cycle does not come there."""
    if not force[0] <= 0.0 <= force[-1]:
        return np.full(stiffness.shape[:-1], np.nan)
    return np.array([[np.interp(0.0, force, branch) for branch in row] for row in stiffness])


def _loss(force: Array, position: Array) -> Array:
    """∮ F du over the cycle (speeds,) [J]."""
    rising, falling = (np.asarray(np.trapezoid(force, position[:, k], axis=-1)) for k in (1, 0))
    return rising - falling
