"""A cycle of axial force at every speed, after the history of the case.

The force goes to its highest and lowest value once, so that friction stands as it does in every
later cycle; then the falling and the rising branch are taken. Energy lost per cycle, the area
between the branches ∮ F du: what friction takes on the way of every sleeve.
"""

from __future__ import annotations

from collections.abc import Sequence

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
NONE = 1e-9  # of the reach of the cycle: a force that counts as none


def answer(scene: Scene, spec: AxialCycleSpec) -> AxialCycleResult:
    """Positions, loads, friction and stiffness over the cycle.

    Raises
    ------
    TooCostly : that takes more time or memory than is allowed
    """
    preload, rows = scene.preload, scene.bearing_row
    listed = np.linspace(spec.lowest, spec.highest, spec.steps + 1)
    force, at = _places(listed)
    steps = len(preload.speed) * (2 * spec.steps + 3)
    require_history(f"axial_cycle: {steps} steps", 0, steps)
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
            load[row, k] = [state.at.load[path.of_seat] for state in states]
            friction[row, k], stop[row, k] = _sleeves(path, states)
            stiffness[row, k] = _stiffness(path, row, states, force, way=(-1.0, 1.0)[k])
        held[row] = [
            path.force_to_slide(row, state, value, reach)
            for state, value in zip(branches[0], force.tolist(), strict=True)
        ]
    return AxialCycleResult(
        speed=scene.speed,
        branch=BRANCHES,
        force=listed,
        body=preload.network.arrangement.bodies,
        bearing=tuple(seat.name for seat in seats),
        sleeve=tuple(sleeve.name for sleeve in sleeves),
        outcome=tuple(outcome[row] for row in rows),
        position=position[rows][:, :, at],
        axial_load=load[rows][:, :, at],
        friction=friction[rows][:, :, at],
        stop_force=stop[rows][:, :, at],
        stiffness=stiffness[rows][:, :, at],
        held_force=0.5 * held[rows][:, at],
        held_mean=listed + 0.5 * held[rows][:, at],
        no_load_stiffness=_at_no_load(force, stiffness)[rows],
        loss=_loss(position[..., SHAFT + 1 :], [sleeve.friction for sleeve in sleeves])[rows],
    )


def _places(listed: Array) -> tuple[Array, NDArray[np.intp]]:
    """Forces of the path, ascending: those ``listed`` and no force between them; where they are."""
    if not listed[0] < 0.0 < listed[-1] or np.abs(listed).min() <= NONE * np.ptp(listed):
        return listed, np.arange(len(listed))
    force = np.sort(np.append(listed, 0.0))
    return force, np.flatnonzero(force != 0.0)


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
    return stiffness[..., np.abs(force).argmin()]


def _loss(position: Array, limit: Sequence[float]) -> Array:
    """∮ F du over the cycle (speeds,) [J]; ``position`` of sleeves (speeds, branches, forces,
    sleeves), each of which goes one way on a branch, and ``limit`` of their friction [N]."""
    way = np.abs(np.diff(position, axis=2)).sum(axis=(1, 2))
    return np.asarray(way @ np.array(limit))
