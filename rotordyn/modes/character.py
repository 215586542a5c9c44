"""What a mode is: how much of it a rigid shaft could do, which way it whirls along the shaft."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rotordyn.arrays import Array, Complex
from rotordyn.equation.dofs import position
from rotordyn.equation.linear import Linear
from rotordyn.modes.branches import PLANAR, Branch, circular_share

MOSTLY = 0.5  # of the kinetic energy
ACROSS = 1e-3  # of the kinetic energy: a mode that has less across the axis has none there
FELT = 1e-3  # of the largest deflection squared: where less moves, no direction is seen


def rigid_share(linear: Linear, branch: Branch) -> Array:
    """Share of the kinetic energy of a mode (speeds,) in motions of rigid rotors, NaN if lost."""
    squares = np.abs(branch.vector) ** 2
    share = squares[:, linear.rigid].sum(axis=1) / squares.sum(axis=1)
    return np.where(branch.column < 0, np.nan, share)


def across(linear: Linear, vector: Complex) -> bool:
    """Whether a mode ``vector`` (…, n) of shafts bends them, too, at any of its speeds."""
    squares = np.abs(vector) ** 2
    bent = squares[..., linear.energy_of("bending")].sum(axis=-1)
    return bool((bent > ACROSS * squares.sum(axis=-1)).any())


def characters(
    linears: Sequence[Linear], branches: Sequence[Branch], shares: Sequence[Array]
) -> tuple[str, ...]:
    """The kinds of modes, each in the system of ``linears``, and whether they are rather rigid-body
    motions, over all speeds: those of the highest shares, no more than rigid shafts have."""
    mean = np.array([np.nanmean(share) for share in shares])
    words = [branch.kind for branch in branches]
    left: dict[tuple[int, str], int] = {}
    for k in np.argsort(-mean, kind="stable"):
        own, linear = (branches[k].subsystem, words[k]), linears[k]
        left.setdefault(own, int((linear.rigid & linear.energy_of(words[k])).sum()))
        if mean[k] > MOSTLY and left[own] > 0:
            left[own] -= 1
            words[k] = f"rigid-body {words[k]}"
    return tuple(words)


def whirl_along(linear: Linear, vector: Complex, degree: float) -> str:
    """``"forward"``, ``"backward"``, ``"planar"`` or ``"mixed"`` for a bending mode ``vector``
    (n,): mixed where some nodes go round one way and others the other."""
    if abs(degree) < PLANAR:
        return "planar"
    forward = "forward" if degree > 0.0 else "backward"
    if linear.isotropic:
        return forward
    y, z = (linear.motion[:, position(name)] @ vector for name in ("y", "z"))
    size = np.abs(y) ** 2 + np.abs(z) ** 2
    felt = size > FELT * size.max()
    turn = circular_share(y[felt, None], z[felt, None])
    return "mixed" if turn.min() < -PLANAR and turn.max() > PLANAR else forward
