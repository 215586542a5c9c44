"""The contacts of the balls of a solved state, with more digits than the lengths they come from.

A contact approach of nanometres is the difference of two lengths of millimetres, and of a ball
under a millinewton few of its digits are left. The Newton step that a solved state still asks for
is smaller than these lengths resolve; added to the approaches themselves it is not lost.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from bearings.arrays import Array
from bearings.ball.balance import Balance
from bearings.ball.plane import EPS, Motion, Pair, direction, dot
from bearings.ball.potential import both_grooves
from bearings.ball.race import against, facing, facing_radius, hertz, vector_to
from bearings.geometry import Groove
from bearings.ring import tolerances as tol
from bearings.ring.problem import Problem

Place = tuple[Array, Array]


class Contacts(NamedTuple):
    """Loads (c, s, n) [N] of all contacts of the balls, sines and cosines of their angles."""

    load: Array
    sin: Array
    cos: Array


def contacts(
    problem: Problem, balance: Balance, at: Place, step: Place | None = None
) -> tuple[Balance, Contacts]:
    """Contacts at (d, X), or after a ``step`` (dd, dX) from there; the balance with their loads.

    d and dd (s, 5), X and dX (u, s, n). Fc and Mg notice such a step only where they depend on
    the ratio of the loads; they are left as they are.
    """
    if problem.geometry.single and not (problem.turning and step is not None):
        after = balance if step is None else _at_rest(problem, balance, at, step)
        (si, ci), (so, co) = after.inner_direction, after.outer_direction
        load = np.stack([after.inner_load, after.outer_load])
        return after, Contacts(load, np.stack([si, so]), np.stack([ci, co]))
    c, (d, x) = problem.shifted(at[1]), at
    dd, dx = (np.zeros_like(d), np.zeros_like(x)) if step is None else step
    a, moved = problem.centres(d, x), _moved(problem, dd, dx)
    least = 0.0
    if not problem.turning:
        least = c.inner.stiffness * (tol.IDLE * EPS * c.free_distance) ** 1.5
    place = (x[0], x[1])
    shifts = dx[2:].reshape(-1, 2, *dx.shape[1:]) if len(dx) > 4 else np.zeros((4, 2, 1, 1))
    split = len(c.inner_grooves)
    inner_way, outer_way = moved[:2] - dx[:2] + shifts[:split], dx[:2] - shifts[split:]
    inner = _bearing(c.inner_grooves, against(tuple(a), place), 1.0, inner_way, least)
    outer = _bearing(c.outer_grooves, place, -1.0, outer_way, least)
    qi, si, ci = _resultant(inner, balance.inner_direction)
    qo, so, co = _resultant(outer, balance.outer_direction)
    after = balance._replace(
        inner_load=qi, outer_load=qo, inner_direction=(si, ci), outer_direction=(so, co)
    )
    return after, Contacts(*map(np.concatenate, zip(inner, outer, strict=True)))


def _bearing(
    grooves: tuple[Groove, ...], vector: Motion, side: float, steps: Array, least: float
) -> Contacts:
    """The contacts of a race after steps of each (g, 2, s, n); no load up to ``least`` is one."""
    each = []
    for groove, step in zip(grooves, steps, strict=False):
        along = vector_to(groove, vector, side)
        sin, cos, length = direction(_met(groove, along))
        load = hertz(groove.stiffness, np.maximum(length - groove.centre_distance, 0.0)).load
        load = _loaded(groove.stiffness, load, (sin, cos), (step[0], step[1]))
        moved = _met(groove, (along[0] + step[0], along[1] + step[1]))
        each.append((load, *direction(moved)[:2]))
    load, sin, cos = (np.stack(part) for part in zip(*each, strict=True))
    return Contacts(np.where(load > least, load, 0.0), sin, cos)


def _met(groove: Groove, vector: Pair) -> Pair:
    """A vector as its groove meets it, straight beyond 90°; some direction where there is none."""
    axial, radial = vector[0], facing_radius(groove, vector[1])
    return axial, np.where((axial == 0.0) & (radial == 0.0), groove.centre_distance, radial)


def _resultant(c: Contacts, otherwise: Pair) -> tuple[Array, Array, Array]:
    """Load and direction of the contacts of a race together."""
    axial, radial = (c.load * c.sin).sum(axis=0), (c.load * c.cos).sum(axis=0)
    load = np.hypot(axial, radial)
    some = load > 0.0
    size = np.where(some, load, 1.0)
    return (
        load,
        np.where(some, axial / size, otherwise[0]),
        np.where(some, radial / size, otherwise[1]),
    )


def _at_rest(problem: Problem, balance: Balance, at: Place, step: Place) -> Balance:
    """Loads and directions of balls at rest between one groove a ring: contacts in series."""
    a = problem.centres(at[0] + step[0], at[1] + step[1])
    moved = _moved(problem, *step)
    stiffness, along = problem.geometry.series_stiffness, (moved[0], moved[1])
    load = _loaded(stiffness, balance.inner_load, balance.inner_direction, along)
    way = facing(both_grooves(problem.geometry), (a[0], a[1]))[:2]
    return balance._replace(
        inner_load=load, outer_load=load, inner_direction=way, outer_direction=way
    )


def _moved(problem: Problem, dd: Array, dx: Array) -> Array:
    """What a step adds to A (m, s, n)."""
    moved = problem.assembly.moved(dd)
    if len(dx) == 4:
        moved[:2] += dx[2:]
    return moved


def _loaded(stiffness: float, load: Array, along: Pair, step: Pair) -> Any:
    """k (δ + dδ)^1.5 of contacts that carry ``load``; open ones stay open."""
    approach = (load / stiffness) ** (2.0 / 3.0)
    deeper = np.maximum(approach + dot(along, step), tol.LEAST * approach)
    return np.where(load > 0.0, stiffness * deeper**1.5, 0.0)
