"""Linear equation of motion along and across the axis, with rows of forces, points and rings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rotordyn.analyses.time_response.spec import DIRECTIONS, TimeResponseSpec
from rotordyn.analyses.time_response.stops import Stops
from rotordyn.arrays import Array, Indices
from rotordyn.equation.linear import Linear
from rotordyn.scene.joined import Joined
from rotordyn.scene.linearity import ring_rows
from rotordyn.scene.scene import Scene


@dataclass(frozen=True, eq=False, slots=True)
class Equation:
    """Equation q̈ + C q̇ + K q = L g of all motion along and across the axis, at some speeds (s,).

    ``stiffness`` K, ``damping`` C (s, n, n). ``inputs`` L (n, ports): of the forces at the ports of
    the spec. ``speed`` (s, unbalances) [rad/s]: of the rotors of the unbalances. By the
    coordinates: ``points`` (3·points, n), displacements; ``rings`` (5·seats, n), displacement of
    every inner ring against its outer ring in the frame of the bearing; ``sleeves`` (sleeves, n),
    displacement along the axis, which springs and stops that stay closed resist with a stiffness
    ``held`` (s, sleeves) [N/m]. ``stops``: stops that close and open; K includes the closed ones.
    """

    stiffness: Array
    damping: Array
    inputs: Array
    speed: Array
    points: Array
    rings: Array
    sleeves: Array
    held: Array
    stops: Stops

    @classmethod
    def of(cls, scene: Scene, spec: TimeResponseSpec, rows: Indices | None = None) -> Equation:
        """Return the equation at all usable speeds of a scene, or at some ``rows`` of them."""
        joined = Joined.of(scene, scene.with_motions(("bending", "axial")), rows)
        spindle, stiffness = scene.spindle, joined.stiffness
        sleeves = joined.by_coordinates(lambda part: _sleeves(scene, part))
        fixed = np.sum([_stiffness(scene, part) for part in joined.parts], axis=0)
        stops = Stops.of(scene, spec.stop_stiffness, rows)
        if stops.act.any():
            springs = np.array([sleeve.spring.stiffness for sleeve in spindle.sleeves])
            resistance = np.where(stops.act, springs + stops.stiffness * stops.closed, fixed)
            stiffness += np.einsum("sk,kn,km->snm", resistance - fixed, sleeves, sleeves)
            fixed = np.where(stops.act, springs, fixed)
        ratios = [spindle.ratios[spindle.place(load.at).rotor] for load in spec.unbalances]
        return cls(
            stiffness=stiffness,
            damping=joined.damping,
            inputs=joined.displaced(spec.ports).T,
            speed=joined.parts[0].speed[:, None] * np.array(ratios),
            points=joined.displaced((point, axis) for point in spec.points for axis in DIRECTIONS),
            rings=joined.by_coordinates(lambda part: ring_rows(scene, part).reshape(-1, part.size)),
            sleeves=sleeves,
            held=fixed,
            stops=stops,
        )


def _sleeves(scene: Scene, part: Linear) -> Array:
    """Return rows (sleeves, n): displacement of every sleeve along the axis by the coordinates of a
    subsystem."""
    motions = {connection.link.name: connection.motions[0] for connection in part.connections}
    none = np.zeros(part.size)
    names = [f"sleeve {sleeve.name}" for sleeve in scene.spindle.sleeves]
    return np.array([motions.get(name, none) for name in names]).reshape(-1, part.size)


def _stiffness(scene: Scene, part: Linear) -> Array:
    """Return stiffness (s, sleeves) [N/m] of springs and closed stops of sleeves in a subsystem."""
    links = {connection.link.name: connection.matrices.stiffness for connection in part.connections}
    stiffness = np.zeros((len(part.speed), len(scene.spindle.sleeves)))
    for k, sleeve in enumerate(scene.spindle.sleeves):
        if f"sleeve {sleeve.name}" in links:
            stiffness[:, k] = links[f"sleeve {sleeve.name}"][:, 0, 0]
    return stiffness
