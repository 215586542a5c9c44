"""State of a network between two events: contacts keep their kinds, Newton finds the positions.

Held joints (rigid springs, closed stops, friction that sticks) are constraints C x = c with forces
Cᵀ μ on the bodies. A redundant joint keeps its force: only the sum is determined.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.linalg.lapack import dgesv

from rotordyn.arrays import Array, Flags
from rotordyn.state.network import Forces, Load, Network, Step

Slips = NDArray[np.int_]
ITERATIONS = 80
EXACT = 1e-13  # of the sum of magnitudes: residual of a balance by rounding
ENOUGH = 1e-12  # of the same: largest residual of a balance
SOFTEST = 1e-12  # of the stiffest body: stiffness of a spring on every body, for free ones
STIFF = 1e6  # N/m
LONGEST = 50e-6  # m
PLACED = 1e-17  # m: largest error of a held joint
OVERRUN = 1e-12  # m: largest violation of a closed stop
HALVINGS = 40
TINY = 1e-300
KEPT = 64  # cached sets of held joints, which only events change


@dataclass(frozen=True, eq=False, slots=True)
class State:
    """Positions ``x`` (bodies,) and the kind of every contact, with the forces on the bodies.

    ``slip``: 0 where friction sticks, ±1 direction of sliding; ``friction`` [N]; ``anchor``: where
    it sticks [m]; ``closed`` stops and their forces ``press``, at least 0 [N]; ``rigid``: forces of
    rigid springs [N]; ``piece`` of the law of every bearing: number of kinks passed, 0 unloaded;
    ``at``: all other forces.
    """

    x: Array
    slip: Slips
    friction: Array
    anchor: Array
    closed: Flags
    press: Array
    rigid: Array
    piece: NDArray[np.int_]
    at: Forces

    @property
    def sticks(self) -> Flags:
        """Whether friction sticks (frictions,)."""
        return np.asarray(self.slip == 0)


@dataclass(frozen=True, eq=False, slots=True)
class Held:
    """Constraints row·x = target of the held joints, without redundant ones."""

    row: Array
    target: Array
    rigid: list[int]
    closed: list[int]
    sticks: list[int]

    def forces(self, mu: Array) -> tuple[Array, Array, Array]:
        """Split ``mu`` into the forces of rigid springs, closed stops and sticking friction."""
        first, second = len(self.rigid), len(self.rigid) + len(self.closed)
        return mu[:first], mu[first:second], mu[second:]


def held(network: Network, state: State, gap: Array) -> Held:
    """Constraints of the held joints of a state; ``gap`` of the springs [m]."""
    row, rigid, closed, sticks = _joints(network, state.closed.tobytes(), state.sticks.tobytes())
    target = np.concatenate([gap[rigid], network.stops.limit[closed], state.anchor[sticks]])
    return Held(row, target, rigid, closed, sticks)


@lru_cache(KEPT)
def _joints(
    network: Network, closed: bytes, sticks: bytes
) -> tuple[Array, list[int], list[int], list[int]]:
    """Rows of the held joints without redundant ones; indices of rigid springs, stops, frictions.

    ``closed``, ``sticks``: one byte of each stop and friction.
    """
    springs, stops, frictions = network.springs, network.stops, network.frictions
    stick = np.frombuffer(sticks, bool) & (frictions.limit > 0.0)
    parts = [np.flatnonzero(flag) for flag in (springs.rigid, np.frombuffer(closed, bool), stick)]
    rows = (springs.row, stops.row, frictions.row)
    row = np.concatenate([block[part] for block, part in zip(rows, parts, strict=True)])
    needed = independent(row)
    marks = np.split(needed, np.cumsum([len(part) for part in parts[:2]]))
    rigid, shut, stuck = (part[mark].tolist() for part, mark in zip(parts, marks, strict=True))
    return row[needed], rigid, shut, stuck


def independent(row: Array) -> Flags:
    """Whether each row of ±1 joins two ends that earlier rows have not joined (rows,)."""
    cluster = list(range(row.shape[1] + 1))  # the ground last
    needed = np.zeros(len(row), dtype=bool)
    for k, ends in enumerate(row):
        bodies = np.flatnonzero(ends).tolist()
        first, second = (cluster[body] for body in (*bodies, row.shape[1])[:2])
        needed[k] = first != second
        if first != second:
            cluster = [first if member == second else member for member in cluster]
    return needed


def solve(stiffness: Array, force: Array, row: Array, miss: Array) -> tuple[Array, Array]:
    """Solve K dx − Cᵀ μ = force, C dx = miss for dx, μ; a soft spring restrains free bodies."""
    n, m = len(force), len(row)
    scale = max(float(stiffness.diagonal().max(initial=0.0)), STIFF)
    matrix = np.zeros((n + m, n + m))
    matrix[:n, :n] = stiffness
    matrix.ravel()[: n * (n + m + 1) : n + m + 1] += SOFTEST * scale
    matrix[:n, n:] = -scale * row.T  # scaled for entries of one size, as is μ
    matrix[n:, :n] = scale * row
    solution = dgesv(matrix, np.concatenate([force, scale * miss]))[2]
    return solution[:n], scale * solution[n:]


def contact_forces(network: Network, state: State) -> Array:
    """Forces of friction, stops and rigid springs on the bodies (bodies,) [N]."""
    springs, stops = network.springs, network.stops
    return np.asarray(
        state.friction @ network.frictions.row
        + (stops.side * state.press) @ stops.row
        + state.rigid @ springs.row[springs.rigid]
    )


def hold(step: Step, state: State, share: float, near: Array | None = None) -> State | None:
    """Solve the state at ``share`` of the step with unchanged contacts; None without one.

    ``near``: positions to start from.
    """
    load = step.load(share)
    joints = held(step.network, state, load.gap)
    loose = without_joint_forces(step.network, state, joints)
    fixed = contact_forces(step.network, loose)
    x = state.x if near is None else near
    at = step.forces(x, load)
    best = np.inf
    for _ in range(ITERATIONS):
        force, miss = at.force + fixed, joints.target - joints.row @ x
        dx, mu = solve(at.stiffness, force, joints.row, miss)
        placed = np.abs(miss).max(initial=0.0) <= PLACED
        residual = float(np.abs(force + mu @ joints.row).max()) / (
            at.size + np.abs(fixed).sum() + TINY
        )
        # a balance that rounding keeps from improving any further counts as one, too
        if placed and (residual < EXACT or (best < ENOUGH and residual >= 0.5 * best)):
            solved = with_joint_forces(step.network, loose, joints, x, at, mu)
            return None if _driven_through(step.network, solved) else solved
        best = min(best, residual) if placed else best
        x, at = advance(step, load, fixed, x, dx, at) if placed else _displaced(step, load, x, dx)
    return None


def advance(
    step: Step, load: Load, fixed: Array, x: Array, dx: Array, at: Forces
) -> tuple[Array, Forces]:
    """Move along ``dx``, not so far that the force along it reverses to more than half its size.

    ``fixed``: forces of the contacts. The force falls along ``dx``, as the energy is convex;
    where it reverses to more, the step is shortened.
    """
    dx = dx * min(1.0, LONGEST / max(float(np.abs(dx).max(initial=0.0)), TINY))
    before = float((at.force + fixed) @ dx)
    share = 1.0
    for _ in range(HALVINGS):
        trial, forces = _displaced(step, load, x, share * dx)
        after = float((forces.force + fixed) @ dx)
        if after >= -0.5 * before or before <= 0.0:  # by rounding it may be negative at the end
            break
        share *= min(max(before / (before - after), 0.1), 0.6)
    return trial, forces


def _displaced(step: Step, load: Load, x: Array, dx: Array) -> tuple[Array, Forces]:
    return x + dx, step.forces(x + dx, load)


def without_joint_forces(network: Network, state: State, joints: Held) -> State:
    """Set the forces of the held joints to zero."""
    rigid, press, friction = state.rigid.copy(), state.press.copy(), state.friction.copy()
    rigid[_places(network, joints)] = 0.0
    press[joints.closed] = 0.0
    friction[joints.sticks] = 0.0
    return replace(state, rigid=rigid, press=press, friction=friction)


def with_joint_forces(
    network: Network, loose: State, joints: Held, x: Array, at: Forces, mu: Array
) -> State:
    """Set the positions ``x`` and the forces ``mu`` of the held joints; overwrites ``loose``."""
    rigid, press, friction = joints.forces(mu)
    loose.rigid[_places(network, joints)] = rigid
    loose.press[joints.closed] = network.stops.side[joints.closed] * press
    loose.friction[joints.sticks] = friction
    return replace(loose, x=x, at=at)


def _driven_through(network: Network, state: State) -> bool:
    """Whether a rigid spring drives a body through a closed stop."""
    past = np.abs(network.stops.row @ state.x - network.stops.limit)[state.closed]
    return bool((past > OVERRUN).any())


def _places(network: Network, joints: Held) -> list[int]:
    """Indices of the held rigid springs among all rigid ones."""
    rigid = np.flatnonzero(network.springs.rigid).tolist()
    return [rigid.index(k) for k in joints.rigid]
