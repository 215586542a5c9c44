"""Surfaces of all rotors on an axis, and the motion of their points in one mode."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from rotordyn.arrays import Array, Complex
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import GROUND, SPINDLE
from rotordyn.surface.body import Surface, together
from rotordyn.surface.motion import displacement, section_motion
from rotordyn.surface.revolution import FACETS
from rotordyn.surface.rotor import holder_surface, rotor_surface


def surfaces(spindle: Spindle, facets: int = FACETS) -> dict[str, Surface]:
    """Return the surface of each rotor; bodies of a further one bear its name before their own."""
    rotors = {name: rotor_surface(spindle.part(name), facets) for name in spindle.ratios}
    return {
        name: surface
        if name == SPINDLE
        else replace(surface, names=tuple(f"{name} {body}" for body in surface.names))
        for name, surface in rotors.items()
    }


def holders(spindle: Spindle, facets: int = FACETS) -> Surface | None:
    """Return the surfaces of what holds rotors against ground; none between two of them."""
    parts = []
    for name in spindle.ratios:
        to_ground = {s.name for s in spindle.supports if set(s.ends) == {name, GROUND}}
        part = spindle.part(name)
        grounded = replace(part, supports=tuple(s for s in part.supports if s.name in to_ground))
        parts.append(holder_surface(replace(grounded, housings=()), facets))
    rings = [surface for surface in parts if surface is not None]
    return together(rings) if rings else None


def displacements(
    spindle: Spindle,
    surfaces: Mapping[str, Surface],
    node: Array,
    rotor: Sequence[str],
    shape: Complex,
) -> Complex:
    """Return the complex displacement (n, 3) of all points, one rotor after the other.

    ``rotor`` (nodes,): the rotor of each node; the rest as in ``motion.displacement``.
    """
    parts = [
        displacement(surface, spindle.part(name).shaft, *_nodes(name, node, rotor, shape))
        for name, surface in surfaces.items()
    ]
    return np.concatenate(parts)


def section_motions(
    spindle: Spindle,
    stations: Mapping[str, Array],
    node: Array,
    rotor: Sequence[str],
    shape: Complex,
) -> Complex:
    """Return the six displacements of cross-sections at ``stations`` of all rotors, likewise."""
    parts = [
        section_motion(spindle.part(name).shaft, *_nodes(name, node, rotor, shape), x)
        for name, x in stations.items()
    ]
    return np.concatenate(parts)


def _nodes(name: str, node: Array, rotor: Sequence[str], shape: Complex) -> tuple[Array, Complex]:
    chosen = np.array([owner == name for owner in rotor])
    return node[chosen], shape[chosen]
