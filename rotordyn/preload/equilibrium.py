"""Axial equilibrium of a network, at all speeds at once: Newton's method on bodies and balls."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rotordyn.arrays import Array, Flags
from rotordyn.preload.network import Network, NetworkState, Response

TOLERANCE = 1e-11  # of the largest force
CONFIRMED = 1e-8  # of the largest force, of an equilibrium whose bearings are solved once more
DIGITS = 1e-13  # of the largest force: more is less with another step
BALLS = 1e-9  # of the largest ball load: what is left of it acts on the rings squared
TOGETHER = 12  # iterations
ITERATIONS = 60
HALVINGS = 12
LONGEST_STEP = 50e-6  # m
LEVEL = 1e-6  # by which the balance may seem worse where it does not change


def solve(
    network: Network, position: Array, held: Flags, limit: Array, near: Response | None = None
) -> NetworkState:
    """Newton from ``position``; bodies ``held`` stay at ``limit`` (speeds or 1, bodies).

    Bodies and balls together; where that fails in shortened steps with every bearing solved by
    itself, and so at the end where balls know two branches. ``near``: bearings close to those
    sought, which only speed the search up.
    """
    springs = network.springs
    fixed = held | springs.fixed
    x = np.where(held, limit, np.where(springs.fixed, springs.rest, position))
    quick = _together(network, x, held, near)
    if network.one_branch and quick.converged.all():
        return quick
    x, response = _apart(network, x, quick, fixed)
    balanced = quick.converged & (x == quick.position).all(axis=1)
    enough = np.where(balanced, CONFIRMED, TOLERANCE)
    stuck = np.zeros(len(x), dtype=bool)
    for _ in range(ITERATIONS):
        miss, error = network.error(x, response, fixed)
        moving = np.isfinite(error) & (error >= enough) & ~stuck
        if not moving.any():
            break
        step = np.where(moving[:, None], _newton(network, response, miss, fixed), 0.0)
        x, response, helped = _advance(network, x, step, response, fixed, miss)
        stuck |= moving & ~helped
    error = network.error(x, response, fixed)[1]
    return NetworkState(x, held, response, error, error < enough)


def _together(network: Network, x: Array, held: Flags, near: Response | None) -> NetworkState:
    """Newton of bodies and balls, no step shortened; none may turn a ball's angles far."""
    fixed = held | network.springs.fixed
    if near is None:
        response, near_by = network.begin(x), np.ones(len(x), dtype=bool)
    else:
        response = network.move(x, near)
        near_by = response.bearings.follows(near.bearings)
    for _ in range(TOGETHER):
        miss, error = network.error(x, response, fixed)
        balanced = response.bearings.imbalance < BALLS
        moving = np.isfinite(error) & ~((error < TOLERANCE) & balanced)
        if not moving.any():
            break
        x = x + np.where(moving[:, None], _newton(network, response, miss, fixed), 0.0)
        before, response = response, network.move(x, response)
        near_by &= response.bearings.follows(before.bearings)
    miss, error = network.error(x, response, fixed)
    with np.errstate(invalid="ignore"):
        rough = np.isfinite(error) & (error > DIGITS)
    if rough.any():  # answers do not say how balls were found
        x = x + np.where(rough[:, None], _newton(network, response, miss, fixed), 0.0)
        response = network.move(x, response)
        error = network.error(x, response, fixed)[1]
    converged = (error < TOLERANCE) & (response.bearings.imbalance < BALLS) & near_by
    return NetworkState(x, held, response, error, converged)


def _apart(network: Network, x: Array, quick: NetworkState, fixed: Flags) -> tuple[Array, Response]:
    """Every bearing solved by itself where ``_together`` has led, or at ``x`` where that is no
    equilibrium of such bearings: balls followed from place to place may be on another branch."""
    there = np.where(quick.converged[:, None], quick.position, x)
    response = network.respond(there)
    error = network.error(there, response, fixed)[1]
    astray = quick.converged & ~(error < CONFIRMED)
    if not astray.any():
        return there, response
    x = np.where(astray[:, None], x, there)
    return x, network.respond(x)


def confirmed(network: Network, net: NetworkState) -> NetworkState:
    """The same equilibrium with every bearing solved anew from its convex start.

    What was found by following neighbours stands only if no neighbour is needed to find it again.
    """
    if not any(np.any(bearing.law.one_branch) for bearing in network.arrangement.bearings):
        return replace(net, converged=net.error < CONFIRMED)  # none was followed at the end
    response = network.respond(net.position)
    error = network.error(net.position, response, net.held | network.springs.fixed)[1]
    return NetworkState(net.position, net.held, response, error, error < CONFIRMED)


def _newton(network: Network, response: Response, miss: Array, fixed: Flags) -> Array:
    """Step that balances the linearised forces; what nothing holds gets a soft spring."""
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

    What counts is ``miss`` [N] itself; its share of the largest load would grow where loads fall.
    Within the play of a bearing the balance stays as it is: such a step is taken whole, towards the
    end of the play. Also the speeds where it helped; at the others nothing moved.
    """
    playing = (near.load == 0.0).any(axis=1)
    here = np.abs(miss).max(axis=1)
    bound = np.where(playing, here * (1.0 + LEVEL), here)
    length = np.ones(len(x))
    idle = (np.abs(step).max(axis=1) < 1e-16) | ~np.isfinite(here)
    for left in range(HALVINGS, -1, -1):
        trial = x + length[:, None] * step
        response = network.respond(trial, near)
        after = np.abs(network.error(trial, response, fixed)[0]).max(axis=1)
        good = idle | (after < bound)
        if good.all():
            break
        length = np.where(good, length, 0.5 * length if left > 1 else 0.0)
    return trial, response, length > 0.0
