"""The mounted state, from which a path starts: restrained bodies with balanced preloads."""

from __future__ import annotations

import numpy as np
from scipy.optimize import lsq_linear

from rotordyn.arrays import Array
from rotordyn.errors import InvalidInput
from rotordyn.state.contacts import State, contact_forces, independent
from rotordyn.state.network import Load, Network, Step, pieces

BALANCED = 1e-6  # of the sum of forces


def mounted_state(parts: Network, load: Load) -> State:
    """Solve the mounted state, every position 0.

    Raises
    ------
    InvalidInput : a body is held by nothing or by friction alone, or not in balance
    """
    _check_restraint(parts)
    step = Step(parts, load, load)
    springs, stops, frictions = parts.springs, parts.stops, parts.frictions
    x = np.zeros(len(parts.bodies))
    at = step.forces(x, load)
    closed = stops.limit == 0.0
    rigid = springs.rigid
    rows = np.concatenate([springs.row[rigid], (stops.side[:, None] * stops.row)[closed]])
    free = at.force + frictions.start @ frictions.row
    least = np.concatenate([np.full(rigid.sum(), -np.inf), np.zeros(closed.sum())])
    carried = lsq_linear(rows.T, -free, (least, np.inf)).x if len(rows) else np.zeros(0)
    press = np.zeros(len(closed))
    press[closed] = carried[rigid.sum() :]
    state = State(
        x=x,
        slip=np.zeros(len(frictions.limit), dtype=int),
        friction=frictions.start.copy(),
        anchor=np.zeros(len(frictions.limit)),
        closed=closed & (press > 0.0),
        press=press,
        rigid=carried[: rigid.sum()],
        piece=pieces(load.laws, at.deflection),
        at=at,
    )
    error = at.force + contact_forces(parts, state)
    if np.abs(error).max() > BALANCED * at.size:
        worst = int(np.abs(error).argmax())
        raise InvalidInput(
            f"body {parts.bodies[worst]}: not in balance at rest, {error[worst]:+.4g} N are left: "
            "make the preloads of its bearings and springs equal and opposite"
        )
    return state


def _check_restraint(parts: Network) -> None:
    """Raise InvalidInput where bearings and springs do not restrain a body."""
    springs = parts.springs
    restraints = np.concatenate([parts.bearings.row, springs.row[springs.stiffness > 0.0]])
    restrained = _reached(restraints, len(parts.bodies))
    rubbing = _reached(np.concatenate([restraints, parts.frictions.row]), len(parts.bodies))
    for name, is_restrained, rubs in zip(parts.bodies, restrained, rubbing, strict=True):
        if not is_restrained:
            what = "restrained by friction alone" if rubs else "unrestrained"
            raise InvalidInput(
                f"body {name}: {what}: join it to the ground by bearings or springs, or to a body "
                "that they restrain"
            )


def _reached(rows: Array, count: int) -> list[bool]:
    """Whether rows of ±1 join each body to the ground: one more joint to it is redundant then."""
    return [not independent(np.vstack([rows, to_ground]))[-1] for to_ground in np.eye(count)]
