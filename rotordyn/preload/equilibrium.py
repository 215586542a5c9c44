"""Axial equilibrium of a network, at all speeds at once: Newton's method on bodies and balls."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rotordyn.arrays import Array, Flags
from rotordyn.preload.network import Network, NetworkState, Response

TOLERANCE = 1e-11  # of the largest force
CONFIRMED = 1e-8  # of the largest force, for an equilibrium whose bearings are solved once more
DIGITS = 1e-13  # of the largest force: another step reduces a larger error
BALLS = 1e-9  # of the largest ball load: its effect on the rings is of second order
TOGETHER = 12  # iterations of bodies and balls together
ITERATIONS = 60  # with every bearing solved by itself
HALVINGS = 12  # of a step, at most
LONGEST_STEP = 50e-6  # m
LEVEL = 1e-6  # relative increase of the error that counts as none, as rounding may cause


def solve(
    network: Network, position: Array, held: Flags, limit: Array, near: Response | None = None
) -> NetworkState:
    """Solve for the equilibrium; bodies ``held`` stay at ``limit`` (speeds or 1, bodies).

    From ``position``, bodies and balls are iterated together; where that fails, or where balls may
    have two branches, every bearing is solved by itself and steps are shortened. ``near``: response
    of bearings close to the solution, which only speeds up the search.
    """
    springs = network.springs
    fixed = held | springs.fixed
    x = np.where(held, limit, np.where(springs.fixed, springs.rest, position))
    joint = _together(network, x, held, near)
    if network.one_branch and joint.converged.all():
        return joint
    x, response = _separately(network, x, joint, fixed)
    balanced = joint.converged & (x == joint.position).all(axis=1)
    tolerance = np.where(balanced, CONFIRMED, TOLERANCE)
    stalled = np.zeros(len(x), dtype=bool)
    for _ in range(ITERATIONS):
        residual, error = network.error(x, response, fixed)
        moving = np.isfinite(error) & (error >= tolerance) & ~stalled
        if not moving.any():
            break
        step = np.where(moving[:, None], _newton(network, response, residual, fixed), 0.0)
        x, response, helped = _advance(network, x, step, response, fixed, residual)
        stalled |= moving & ~helped
    error = network.error(x, response, fixed)[1]
    return NetworkState(x, held, response, error, error < tolerance)


def _together(network: Network, x: Array, held: Flags, near: Response | None) -> NetworkState:
    """Take whole Newton steps of bodies and balls; none may turn a ball's angles far."""
    fixed = held | network.springs.fixed
    if near is None:
        response, close = network.begin(x), np.ones(len(x), dtype=bool)
    else:
        response = network.move(x, near)
        close = response.bearings.follows(near.bearings)
    for _ in range(TOGETHER):
        residual, error = network.error(x, response, fixed)
        balanced = response.bearings.imbalance < BALLS
        moving = np.isfinite(error) & ~((error < TOLERANCE) & balanced)
        if not moving.any():
            break
        x = x + np.where(moving[:, None], _newton(network, response, residual, fixed), 0.0)
        previous, response = response, network.move(x, response)
        close &= response.bearings.follows(previous.bearings)
    residual, error = network.error(x, response, fixed)
    with np.errstate(invalid="ignore"):
        rough = np.isfinite(error) & (error > DIGITS)
    if rough.any():  # results must not depend on the path of the search
        x = x + np.where(rough[:, None], _newton(network, response, residual, fixed), 0.0)
        response = network.move(x, response)
        error = network.error(x, response, fixed)[1]
    converged = (error < TOLERANCE) & (response.bearings.imbalance < BALLS) & close
    return NetworkState(x, held, response, error, converged)


def _separately(
    network: Network, x: Array, quick: NetworkState, fixed: Flags
) -> tuple[Array, Response]:
    """Solve every bearing by itself at the joint solution ``quick``, or at ``x`` where that is not
    an equilibrium of such bearings: balls followed step by step may be on another branch."""
    candidate = np.where(quick.converged[:, None], quick.position, x)
    response = network.respond(candidate)
    error = network.error(candidate, response, fixed)[1]
    astray = quick.converged & ~(error < CONFIRMED)
    if not astray.any():
        return candidate, response
    x = np.where(astray[:, None], x, candidate)
    return x, network.respond(x)


def confirmed(network: Network, net: NetworkState) -> NetworkState:
    """Return the same equilibrium with every bearing solved anew from its convex start.

    A solution found by following neighbours is accepted only if it is reproduced without them.
    """
    if not any(np.any(bearing.law.one_branch) for bearing in network.arrangement.bearings):
        return replace(net, converged=net.error < CONFIRMED)  # all were solved by themselves
    response = network.respond(net.position)
    error = network.error(net.position, response, net.held | network.springs.fixed)[1]
    return NetworkState(net.position, net.held, response, error, error < CONFIRMED)


def _newton(network: Network, response: Response, miss: Array, fixed: Flags) -> Array:
    """Return the step that balances linearised forces; bodies without springs get a soft one."""
    b, stiffness = network.incidence, network.springs.stiffness
    slope = network.tandem * np.where(response.slope > 0.0, response.slope, 0.0)
    k = np.einsum("jn,sj,jm->snm", b, slope, b)
    diagonal = np.arange(k.shape[-1])
    soft = 1e-9 * np.abs(k).max(axis=(1, 2)) + 1e3
    k[:, diagonal, diagonal] += stiffness + soft[:, None] * (stiffness == 0.0)
    k = np.where(fixed[:, :, None] | fixed[:, None, :], 0.0, k)
    k[:, diagonal, diagonal] += fixed
    step = np.linalg.solve(k, np.where(np.isfinite(miss), miss, 0.0)[..., None])[..., 0]
    longest = np.abs(step).max(axis=1, keepdims=True)
    return step * np.minimum(1.0, LONGEST_STEP / np.maximum(longest, 1e-300))


def _advance(
    network: Network, x: Array, step: Array, near: Response, fixed: Flags, miss: Array
) -> tuple[Array, Response, Flags]:
    """Take the step, halved at the speeds where the balance would get worse or no state exists.

    The criterion is ``miss`` [N] itself; its share of the largest load would grow where loads fall.
    Within the play of a bearing the balance does not change: such a step is taken whole, towards
    the end of the play. Also returns where the step helped; elsewhere nothing moved.
    """
    in_play = (near.load == 0.0).any(axis=1)
    current = np.abs(miss).max(axis=1)
    bound = np.where(in_play, current * (1.0 + LEVEL), current)
    length = np.ones(len(x))
    idle = (np.abs(step).max(axis=1) < 1e-16) | ~np.isfinite(current)
    for remaining in range(HALVINGS, -1, -1):
        trial = x + length[:, None] * step
        response = network.respond(trial, near)
        new = np.abs(network.error(trial, response, fixed)[0]).max(axis=1)
        accepted = idle | (new < bound)
        if accepted.all():
            break
        length = np.where(accepted, length, 0.5 * length if remaining > 1 else 0.0)
    return trial, response, length > 0.0
