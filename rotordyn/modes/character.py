"""Character of a mode: its share of rigid-body motion, its direction of whirl along the shaft."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rotordyn.arrays import Array, Complex
from rotordyn.equation.dofs import position
from rotordyn.equation.linear import Linear
from rotordyn.modes.branches import PLANAR, Branch

MOSTLY = 0.5  # of the kinetic energy
ACROSS = 1e-3  # of the kinetic energy: a mode with less across the axis has none there
FELT = 0.01  # of the squared deflections of all nodes: whirl against the rest by less is ignored


def rigid_share(linear: Linear, branch: Branch) -> Array:
    """Return the share of kinetic energy (speeds,) in motions of rigid rotors, NaN if lost."""
    squares = np.abs(branch.vector) ** 2
    share = squares[:, linear.rigid].sum(axis=1) / squares.sum(axis=1)
    return np.where(branch.column < 0, np.nan, share)


def across(linear: Linear, vector: Complex) -> bool:
    """Return whether a mode ``vector`` (…, n) of shafts bends them, too, at any of its speeds."""
    squares = np.abs(vector) ** 2
    bent = squares[..., linear.energy_of("bending")].sum(axis=-1)
    return bool((bent > ACROSS * squares.sum(axis=-1)).any())


def characters(
    linears: Sequence[Linear], branches: Sequence[Branch], shares: Sequence[Array]
) -> tuple[str, ...]:
    """Return the kinds of modes, each in the system of ``linears``, and whether they are rigid-body
    motions over all speeds: those of the highest shares, no more than rigid shafts have."""
    mean = np.array([np.nanmean(share) for share in shares])
    kinds = [branch.kind for branch in branches]
    remaining: dict[tuple[int, str], int] = {}
    for k in np.argsort(-mean, kind="stable"):
        key, linear = (branches[k].subsystem, kinds[k]), linears[k]
        remaining.setdefault(key, int((linear.rigid & linear.energy_of(kinds[k])).sum()))
        if mean[k] > MOSTLY and remaining[key] > 0:
            remaining[key] -= 1
            kinds[k] = f"rigid-body {kinds[k]}"
    return tuple(kinds)


def whirl_along(linear: Linear, vector: Complex, degree: float) -> str:
    """Return ``"forward"``, ``"backward"``, ``"planar"`` or ``"mixed"`` for a bending mode
    ``vector`` (n,): mixed where some nodes whirl forward and others backward."""
    if abs(degree) < PLANAR:
        return "planar"
    whirl = "forward" if degree > 0.0 else "backward"
    if linear.axisymmetric:
        return whirl
    y, z = (linear.motion[:, position(name)] @ vector for name in ("y", "z"))
    size = np.abs(y) ** 2 + np.abs(z) ** 2
    turn = np.abs(y + 1j * z) ** 2 - np.abs(y - 1j * z) ** 2  # forward less backward
    against = turn * degree < 0.0
    return "mixed" if size[against].sum() > FELT * size.sum() else whirl
