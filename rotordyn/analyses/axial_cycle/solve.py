"""A cycle of axial force at every speed, after the history of the case.

The force passes its highest and lowest value once, so that friction is in the state of every later
cycle; then the falling and the rising branch are solved. The energy lost per cycle is the area
between the branches, ∮ F du: friction force times path of every sleeve.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rotordyn.allowance import require_history, require_time
from rotordyn.analyses.axial_cycle.result import BRANCHES, AxialCycleResult
from rotordyn.analyses.axial_cycle.spec import AxialCycleSpec
from rotordyn.arrays import Array, Indices
from rotordyn.preload.arrangement import SHAFT
from rotordyn.preload.history import History, history
from rotordyn.scene.scene import Scene
from rotordyn.state import NoEquilibrium
from rotordyn.state.contacts import State

NONE = 1e-9  # of the range of the cycle: a smaller force counts as zero


def solve(scene: Scene, spec: AxialCycleSpec) -> AxialCycleResult:
    """Solve positions, loads, friction and stiffness over the cycle.

    Raises
    ------
    TooCostly : the cycle takes more time or memory than allowed
    """
    preload, rows = scene.preload, scene.bearing_row
    listed = np.linspace(spec.lowest, spec.highest, spec.steps + 1)
    force, listed_rows = _path_forces(listed)
    steps = len(preload.speed) * (2 * spec.steps + 3)
    require_history(f"axial_cycle: {steps} steps", 0, steps)
    path = history(preload, max(abs(spec.lowest), abs(spec.highest)))
    seats, sleeves = scene.spindle.seats, scene.spindle.sleeves
    shape = (len(preload.speed), len(BRANCHES), len(force))
    position = np.full((*shape, len(preload.network.arrangement.bodies)), np.nan)
    load = np.full((*shape, len(seats)), np.nan)
    friction, stop = np.full((2, *shape, len(sleeves)), np.nan)
    stiffness, slide_force = np.full(shape, np.nan), np.full((shape[0], shape[2]), np.nan)
    range_ = float(force[-1] - force[0])
    outcome = list(preload.outcome)
    for row, start in enumerate(path.run_up()):
        require_time("axial_cycle", "broken off")
        outcome[row] = outcome[row] or (start if isinstance(start, str) else "")
        if isinstance(start, str) or outcome[row]:
            continue
        try:
            branches = _branches(path, row, start, force)
        except NoEquilibrium as failure:
            outcome[row] = f"no cycle: {failure}"
            continue
        for k, states in enumerate(branches):
            position[row, k] = [state.x for state in states]
            load[row, k] = [state.at.load[path.of_seat] for state in states]
            friction[row, k], stop[row, k] = _sleeves(path, states)
            stiffness[row, k] = _stiffness(path, row, states, force, way=(-1.0, 1.0)[k])
        slide_force[row] = [
            path.force_to_slide(row, state, value, range_)
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
        position=position[rows][:, :, listed_rows],
        axial_load=load[rows][:, :, listed_rows],
        friction=friction[rows][:, :, listed_rows],
        stop_force=stop[rows][:, :, listed_rows],
        stiffness=stiffness[rows][:, :, listed_rows],
        held_force=0.5 * slide_force[rows][:, listed_rows],
        held_mean=listed + 0.5 * slide_force[rows][:, listed_rows],
        no_load_stiffness=_at_no_load(force, stiffness)[rows],
        loss=_loss(position[..., SHAFT + 1 :], [sleeve.friction for sleeve in sleeves])[rows],
    )


def _path_forces(listed: Array) -> tuple[Array, Indices]:
    """Return ``listed`` forces, ascending, with zero if it is between, and their rows in these."""
    if not listed[0] < 0.0 < listed[-1] or np.abs(listed).min() <= NONE * np.ptp(listed):
        return listed, np.arange(len(listed))
    force = np.sort(np.append(listed, 0.0))
    return force, np.flatnonzero(force != 0.0)


def _branches(path: History, row: int, start: State, force: Array) -> list[list[State]]:
    """Return the states at every force, ascending, on the falling and on the rising branch."""
    *_, top = path.loaded(row, start, [force[-1], force[0], force[-1]])
    at_highest = path.under(row, float(force[-1]))
    falling = path.loaded(row, top, force[-2::-1].tolist(), at_highest)
    at_lowest = path.under(row, float(force[0]))
    rising = path.loaded(row, falling[-1], force[1:].tolist(), at_lowest)
    return [[*falling[::-1], top], [falling[-1], *rising]]


def _sleeves(path: History, states: list[State]) -> tuple[Array, Array]:
    """Return friction and stop forces on every sleeve (states, sleeves)."""
    network = path.network
    friction = np.array([state.friction @ network.frictions.row for state in states])
    press = np.array([(network.stops.side * s.press) @ network.stops.row for s in states])
    return friction[:, SHAFT + 1 :], press[:, SHAFT + 1 :]


def _stiffness(path: History, row: int, states: list[State], force: Array, way: float) -> Array:
    """Return the slope of force over displacement of the shaft in direction ``way`` [N/m]."""
    soft = [path.compliance(row, s, f, way) for s, f in zip(states, force.tolist(), strict=True)]
    return 1.0 / np.array(soft)


def _at_no_load(force: Array, stiffness: Array) -> Array:
    """Return the stiffness at zero force; NaN where the cycle does not reach it."""
    if not force[0] <= 0.0 <= force[-1]:
        return np.full(stiffness.shape[:-1], np.nan)
    return stiffness[..., np.abs(force).argmin()]


def _loss(position: Array, limit: Sequence[float]) -> Array:
    """Return ∮ F du over the cycle (speeds,) [J], from ``position`` of sleeves (speeds, branches,
    forces, sleeves), monotonic on each branch, and ``limit`` of their friction [N]."""
    path_length = np.abs(np.diff(position, axis=2)).sum(axis=(1, 2))
    return np.asarray(path_length @ np.array(limit))
