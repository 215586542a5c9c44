"""Continuation of modes: which mode each becomes after a small change of the stiffness."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import fields

import numpy as np

from rotordyn.arrays import Complex, Flags, Indices
from rotordyn.numerics.follow import mac
from rotordyn.numerics.modes import Modes

FARTHEST = 1.0  # of a pole: a larger predicted change is ignored
NEARNESS = 4.0  # weight of the relative distance of poles against the MAC


def continued(before: Modes, after: Modes, rows: Iterable[int]) -> Indices:
    """Return the column of ``after`` for each of ``before`` (speeds, k), each once, at ``rows``.

    A pole λ with the right vector v and the left one w is expected at λ − w ΔK v; of all pairings
    of expected and new poles the one with the least sum of distance and 1 − MAC is taken. Other
    rows stay in their order.
    """
    from scipy.optimize import linear_sum_assignment

    column = np.tile(np.arange(before.pole.shape[-1]), (len(before.pole), 1))
    if before is after:
        return column
    expected = _expected(before, after)
    for row in rows:
        poles, new = expected[row], after.pole[row]
        distance = np.abs(poles[:, None] - new)
        size = np.abs(poles)[:, None] + np.abs(new)
        assurance = mac(before.vector[row], after.vector[row])
        cost = NEARNESS * distance / np.where(size > 0.0, size, 1.0) - assurance
        row_of, partner = linear_sum_assignment(cost)
        column[row, row_of] = partner
    return column


def _expected(before: Modes, after: Modes) -> Complex:
    """Return poles (speeds, k) to first order; unchanged where that is no small change."""
    added = after.stiffness - before.stiffness
    with np.errstate(invalid="ignore", over="ignore"):
        step = np.einsum("snk,skn->sk", added @ before.vector, before.participation)
        small = np.abs(step) < FARTHEST * np.abs(before.pole)
    return np.where(small, before.pole - step, before.pole)


def conjugate(modes: Modes) -> Modes:
    """Return the modes of the conjugate system."""
    return Modes(*(getattr(modes, field.name).conj() for field in fields(modes)))


def collected(base: Modes, parts: Iterable[tuple[Modes, Indices, Flags]]) -> Modes:
    """Return ``base`` with modes of other systems in place of its own.

    Each of ``parts`` gives modes, their column for every mode of the base (speeds, k), and where
    they are taken (speeds, k). The systems stay those of the base.
    """
    pole, vector, left, condition = base.pole, base.vector, base.participation, base.condition
    for modes, column, taken in parts:
        pole = np.where(taken, np.take_along_axis(modes.pole, column, -1), pole)
        part = np.take_along_axis(modes.vector, column[:, None, :], -1)
        vector = np.where(taken[:, None, :], part, vector)
        part = np.take_along_axis(modes.participation, column[:, :, None], -2)
        left = np.where(taken[:, :, None], part, left)
        condition = np.maximum(condition, np.where(taken.any(axis=-1), modes.condition, 0.0))
    return Modes(base.stiffness, base.damping, pole, vector, left, condition)
