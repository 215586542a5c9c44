"""How far the rings of a solved bearing deform under its balls."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from bearings.arguments import checked
from bearings.arrays import Array
from bearings.geometry import geometry
from bearings.ring.assembly import full_assembly
from bearings.ring.groove_shifts import groove_shifts
from bearings.ring.problem import Problem, turns
from bearings.ring.state import BearingState


@dataclass(frozen=True, eq=False, slots=True)
class RingDeflection:
    """Of rings that deform; zero of rigid ones, NaN where there is no state.

    By contact, in the order of the bearing's ``contact_names``: ``shift`` (…, balls, contacts, 2)
    [m] of the groove centre, axial and radial; ``normal`` (…, balls, contacts) [m]: how far the
    raceway gives along the normal of the contact, beyond what Hertz's law counts. ``inner``,
    ``outer`` (…, balls): the farthest contact of each ring.
    """

    shift: Array
    normal: Array
    split: int

    @property
    def inner(self) -> Array:
        """Of the inner raceway at every ball."""
        return np.asarray(self.normal[..., : self.split].max(axis=-1))

    @property
    def outer(self) -> Array:
        """Of the outer raceway at every ball."""
        return np.asarray(self.normal[..., self.split :].max(axis=-1))


@checked
def ring_deflection(state: BearingState) -> RingDeflection:
    """Deflection of both rings of a state at every ball."""
    operation = state.operation
    g = geometry(operation.grooves)
    good = state.outcome.reshape(-1) == ""
    count = len(g.inner_grooves) + len(g.outer_grooves)
    shift = np.full((good.size, g.balls, count, 2), np.nan)
    normal = np.full(shift.shape[:3], np.nan)
    shift[good], normal[good] = 0.0, 0.0
    if operation.grooves.rings is not None:
        whole = Problem.of(operation, full_assembly)
        d, x = state.displacement.reshape(-1, 5), state.ball_centre
        x, turning = x.reshape(len(x), good.size, -1), turns(g, operation.speed)
        for there in (turning, ~turning):
            rows = np.flatnonzero(good & there)
            if rows.size:
                part = replace(whole.take(rows), turning=bool(turning[rows[0]]))
                way, moved = groove_shifts(part, d[rows], x[:, rows])
                length = np.sqrt((way * way).sum(axis=-1))
                along = (way * moved).sum(axis=-1)
                shift[rows] = moved
                normal[rows] = along / np.where(length > 0.0, length, 1.0)
    shape = state.outcome.shape
    return RingDeflection(
        shift.reshape(*shape, *shift.shape[1:]),
        normal.reshape(*shape, *normal.shape[1:]),
        len(g.inner_grooves),
    )
