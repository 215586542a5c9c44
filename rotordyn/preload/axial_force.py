"""The axial force in the shaft, from the dynamic preload state.

The shaft is cut at x and all axial forces on the part in front of the cut are added up: bearings,
supports, the external force on the front end, weight, the drawbar. Springs of sleeves act on the
sleeves, and reach the shaft through their bearings only.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rotordyn.arrays import Array
from rotordyn.errors import InvalidInput
from rotordyn.machine.cross_section import area
from rotordyn.machine.inertia import mass_in_front
from rotordyn.machine.spindle import Spindle

PointForces = tuple[tuple[float, float], ...]  # stations [m], forces towards +x [N]
BALANCED = 1e-9  # of the largest force
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(5)


@dataclass(frozen=True, eq=False, slots=True)
class AxialForce:
    """Axial forces along the shaft in every state.

    ``station`` (k,) [m] and ``push`` (states, k) [N]: point forces on the shaft, towards +x;
    ``gravity`` [m/s²], towards +x.
    """

    spindle: Spindle
    station: Array
    push: Array
    gravity: float

    def at(self, x: Array) -> Array:
        """Return the force in the wall at ``x`` (p,) [m], tension positive (states, p) [N]."""
        order = np.argsort(self.station, kind="stable")
        zero = np.zeros((len(self.push), 1))
        cumulative = np.concatenate([zero, np.cumsum(self.push[:, order], axis=1)], axis=1)
        in_front = np.searchsorted(self.station[order], x)
        force = -cumulative[:, in_front]
        if self.gravity:
            force = force - self.gravity * mass_in_front(self.spindle.shaft, x)
        return np.asarray(force)

    def bending(self, x: Array) -> Array:
        """Return the force acting in bending at ``x`` (p,) [m], tension positive (states, p) [N].

        The tension of a drawbar guided everywhere acts too; it cancels the shaft's compression.
        """
        bar = self.spindle.drawbar
        if bar is None or bar.contacts:
            return self.at(x)
        return self.at(x) + bar.force * ((bar.start < x) & (x < bar.end))

    @property
    def compresses(self) -> bool:
        """True if the force that acts in bending is compressive anywhere in any state."""
        ends = np.unique(np.concatenate([self.station, self.spindle.shaft.boundaries]))
        inside = (ends[:-1, None] + np.diff(ends)[:, None] * np.array([1e-6, 1.0 - 1e-6])).ravel()
        force = self.bending(inside)
        return bool((force < -BALANCED * np.nanmax(np.abs(self.push), initial=0.0)).any())


def axial_force(
    spindle: Spindle,
    seat_load: Array,
    force: float = 0.0,
    gravity: float = 0.0,
    tension: float = 0.0,
    point_forces: PointForces = (),
) -> AxialForce:
    """Return the axial force in the shaft of ``spindle`` in every state.

    ``seat_load`` (states, seats) [N]: axial loads of the bearings in their own frames, where the
    shaft pushes the inner ring. ``force`` [N] on the front end of the shaft and ``gravity`` [m/s²],
    both towards +x; ``tension`` [N] pulls at both ends; ``point_forces`` are added. Supports carry
    the remainder in proportion to their axial stiffness, or only those that are rigid along x.

    Raises
    ------
    InvalidInput : the shaft is unrestrained along its axis against ``force`` and weight
    """
    states, bar, shaft = len(seat_load), spindle.drawbar, spindle.shaft
    thrust = np.array([float(seat.thrust) for seat in spindle.seats])
    point_loads = [
        (shaft.start, force - tension),
        (shaft.end, tension),
        *((body.x, gravity * body.mass) for body in spindle.lumped),
        *point_forces,
    ]
    if bar is not None:
        point_loads += [(bar.start, bar.force), (bar.end, -bar.force)]
    push = np.concatenate(
        [-thrust * seat_load, np.tile([value for _, value in point_loads], (states, 1))], axis=1
    )
    weight = 0.0
    if gravity:
        weight = gravity * float(mass_in_front(shaft, np.array([shaft.end]))[0])
    remainder = -(push.sum(axis=1) + weight)
    size, share = max(np.abs(push).max(initial=0.0), abs(weight)), _shares(spindle)
    if not spindle.seats and not share.any() and (np.abs(remainder) > BALANCED * size).any():
        raise InvalidInput(
            "the shaft is unrestrained along its axis against the axial force and its weight: give "
            "a support the stiffness xx or hold x rigidly, or take tension, which pulls both ends"
        )
    forces = AxialForce(
        spindle=spindle,
        station=np.array(
            [seat.x for seat in spindle.seats]
            + [x for x, _ in point_loads]
            + [support.x for support in spindle.supports]
        ),
        push=np.concatenate([push, np.outer(remainder, share)], axis=1),
        gravity=gravity,
    )
    rigid = [k for k, s in enumerate(spindle.supports) if "x" in s.rigid]
    if len(rigid) > 1:
        forces.push[:, push.shape[1] + np.array(rigid)] += _clamped(forces, rigid)
    return forces


def _shares(spindle: Spindle) -> Array:
    """Return the share of each support in an axial force, 0 if none holds the shaft (supports,)."""
    weight = np.array([float("x" in support.rigid) for support in spindle.supports])
    if not weight.any():
        weight = np.array([support.along for support in spindle.supports])
    return weight / weight.sum() if weight.any() else weight


def _clamped(forces: AxialForce, rigid: list[int]) -> Array:
    """Return the additional forces of supports ``rigid`` along x (states, rigid) [N], which keep
    the shaft between two of them as long as without any force."""
    stations = np.array([forces.spindle.supports[k].x for k in rigid])
    order = np.argsort(stations)
    mean = np.zeros((len(forces.push), len(rigid) + 1))  # [N] between them; beyond them none
    for gap, (low, high) in enumerate(pairwise(stations[order]), start=1):
        marks = np.concatenate([forces.station, forces.spindle.shaft.boundaries, [low, high]])
        x, shares = _compliances(forces.spindle, marks[(low <= marks) & (marks <= high)])
        mean[:, gap] = forces.at(x) @ shares / shares.sum()
    pushes = np.empty((len(mean), len(rigid)))
    pushes[:, order] = np.diff(mean, axis=1)
    return pushes


def compliance(spindle: Spindle, start: float, end: float) -> float:
    """Return by how much the shaft gets longer from ``start`` to ``end`` per force [m/N], < 0 where
    the end is in front."""
    low, high = min(start, end), max(start, end)
    inside = [x for x in spindle.shaft.boundaries if low < x < high]
    total = float(_compliances(spindle, np.array([low, *inside, high]))[1].sum())
    return total if end >= start else -total


def _compliances(spindle: Spindle, marks: Array) -> tuple[Array, Array]:
    """Return stations (p,) [m] on the shaft between the first and the last of ``marks``, between
    which its sections are smooth, and the axial compliance of each (p,) [m/N]; joints in between
    are among them."""
    marks = np.unique(marks)
    half = np.diff(marks)[:, None] / 2.0
    x = (marks[:-1, None] + half * (1.0 + POINTS)).ravel()
    within = [joint for joint in spindle.joints if marks[0] < joint.x < marks[-1]]
    return (
        np.concatenate([x, [joint.x for joint in within]]),
        np.concatenate(
            [
                (half * WEIGHTS).ravel() / _rigidity(spindle, x),
                [1.0 / joint.axial for joint in within],
            ]
        ),
    )


def _rigidity(spindle: Spindle, x: Array) -> Array:
    """Return the axial rigidity E A (p,) [N] of the shaft at stations ``x`` (p,) [m]."""
    moduli = [section.material.young_modulus for section in spindle.shaft.sections_at(x)]
    return np.array(moduli) * [area(*spindle.shaft.diameters_at(station)) for station in x.tolist()]
