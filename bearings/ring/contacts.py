"""Contacts of the balls of a solved state, with more digits than the lengths they come from.

A contact approach of nanometres is the difference of two lengths of millimetres, and under a
millinewton few of its digits remain. The Newton step that remains at a solved state is smaller than
the rounding of these lengths; added to the approaches themselves it is not lost.
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
    """Loads (c, s, n) [N] of all contacts of the balls, and sines and cosines of their angles."""

    load: Array
    sin: Array
    cos: Array


def contacts(
    problem: Problem, balance: Balance, at: Place, step: Place | None = None
) -> tuple[Balance, Contacts]:
    """Compute contacts at (d, X), or after a ``step`` (dd, dX) from there; update the balance.

    d and dd (s, 5), X and dX (u, s, n). Fc and Mg change by such a step only where they depend on
    the ratio of the loads; they are not updated.
    """
    if problem.geometry.single and not (problem.turning and step is not None):
        after = balance if step is None else _at_rest(problem, balance, at, step)
        (si, ci), (so, co) = after.inner_direction, after.outer_direction
        load = np.stack([after.inner_load, after.outer_load])
        return after, Contacts(load, np.stack([si, so]), np.stack([ci, co]))
    c, (d, x) = problem.shifted(at[1]), at
    dd, dx = (np.zeros_like(d), np.zeros_like(x)) if step is None else step
    a, centre_step = problem.centres(d, x), _centre_step(problem, dd, dx)
    least = 0.0
    if not problem.turning:
        least = c.inner.stiffness * (tol.IDLE * EPS * c.free_distance) ** 1.5
    place = (x[0], x[1])
    shifts = dx[2:].reshape(-1, 2, *dx.shape[1:]) if len(dx) > 4 else np.zeros((4, 2, 1, 1))
    by_inner, by_outer = (shifts[race] for race in c.rings)
    inner_step, outer_step = centre_step[:2] - dx[:2] + by_inner, dx[:2] - by_outer
    inner = _race_contacts(c.inner_grooves, against(tuple(a), place), 1.0, inner_step, least)
    outer = _race_contacts(c.outer_grooves, place, -1.0, outer_step, least)
    qi, si, ci = _resultant(inner, balance.inner_direction)
    qo, so, co = _resultant(outer, balance.outer_direction)
    after = balance._replace(
        inner_load=qi, outer_load=qo, inner_direction=(si, ci), outer_direction=(so, co)
    )
    return after, Contacts(*map(np.concatenate, zip(inner, outer, strict=True)))


def _race_contacts(
    grooves: tuple[Groove, ...], vector: Motion, side: float, steps: Array, least: float
) -> Contacts:
    """Contacts of a race after ``steps`` (g, 2, s, n); loads up to ``least`` count as none."""
    parts = []
    for groove, step in zip(grooves, steps, strict=False):
        along = vector_to(groove, vector, side)
        sin, cos, length = direction(_met(groove, along))
        load = hertz(groove.stiffness, np.maximum(length - groove.centre_distance, 0.0)).load
        load = _loaded(groove.stiffness, load, (sin, cos), (step[0], step[1]))
        stepped = _met(groove, (along[0] + step[0], along[1] + step[1]))
        parts.append((load, *direction(stepped)[:2]))
    load, sin, cos = (np.stack(part) for part in zip(*parts, strict=True))
    return Contacts(np.where(load > least, load, 0.0), sin, cos)


def _met(groove: Groove, vector: Pair) -> Pair:
    """Vector in the contact law of a groove, straight beyond 90°; arbitrary where it is zero."""
    axial, radial = vector[0], facing_radius(groove, vector[1])
    return axial, np.where((axial == 0.0) & (radial == 0.0), groove.centre_distance, radial)


def _resultant(c: Contacts, otherwise: Pair) -> tuple[Array, Array, Array]:
    """Load and direction of the resultant of a race; direction ``otherwise`` without load."""
    axial, radial = (c.load * c.sin).sum(axis=0), (c.load * c.cos).sum(axis=0)
    load = np.hypot(axial, radial)
    loaded = load > 0.0
    size = np.where(loaded, load, 1.0)
    return (
        load,
        np.where(loaded, axial / size, otherwise[0]),
        np.where(loaded, radial / size, otherwise[1]),
    )


def _at_rest(problem: Problem, balance: Balance, at: Place, step: Place) -> Balance:
    """Loads and directions of balls at rest between one groove a ring: contacts in series."""
    a = problem.centres(at[0] + step[0], at[1] + step[1])
    centre_step = _centre_step(problem, *step)
    stiffness, along = problem.geometry.series_stiffness, (centre_step[0], centre_step[1])
    load = _loaded(stiffness, balance.inner_load, balance.inner_direction, along)
    sin_cos = facing(both_grooves(problem.geometry), (a[0], a[1]))[:2]
    return balance._replace(
        inner_load=load, outer_load=load, inner_direction=sin_cos, outer_direction=sin_cos
    )


def _centre_step(problem: Problem, dd: Array, dx: Array) -> Array:
    """Change of A (m, s, n) by a step."""
    change = problem.assembly.moved(dd)
    if len(dx) == 4:
        change[:2] += dx[2:]
    return change


def _loaded(stiffness: float, load: Array, along: Pair, step: Pair) -> Any:
    """Load k (δ + dδ)^1.5 of contacts that carry ``load``; open ones stay open."""
    approach = (load / stiffness) ** (2.0 / 3.0)
    new_approach = np.maximum(approach + dot(along, step), tol.LEAST * approach)
    return np.where(load > 0.0, stiffness * new_approach**1.5, 0.0)
