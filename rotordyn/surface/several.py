"""All rotors on an axis as surfaces, and how their points move in one mode."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import GROUND, SPINDLE
from rotordyn.surface.body import Array, Surface, together
from rotordyn.surface.motion import Complex, displacement, section_motion
from rotordyn.surface.revolution import FACETS
from rotordyn.surface.rotor import holder_surface, rotor_surface


def surfaces(spindle: Spindle, facets: int = FACETS) -> dict[str, Surface]:
    """What turns, by rotor; bodies of a further one bear its name before their own."""
    rotors = {name: rotor_surface(spindle.part(name), facets) for name in spindle.ratios}
    return {
        name: surface
        if name == SPINDLE
        else replace(surface, names=tuple(f"{name} {body}" for body in surface.names))
        for name, surface in rotors.items()
    }


def holders(spindle: Spindle, facets: int = FACETS) -> Surface | None:
    """What holds rotors against ground; nothing is drawn between two of them."""
    parts = []
    for name in spindle.ratios:
        held = {s.name for s in spindle.supports if set(s.ends) == {name, GROUND}}
        part = spindle.part(name)
        held_part = replace(part, supports=tuple(s for s in part.supports if s.name in held))
        parts.append(holder_surface(replace(held_part, housings=()), facets))
    rings = [surface for surface in parts if surface is not None]
    return together(rings) if rings else None


def displacements(
    spindle: Spindle,
    surfaces: Mapping[str, Surface],
    node: Array,
    rotor: Sequence[str],
    shape: Complex,
) -> Complex:
    """Complex displacement (n, 3) of all points, one rotor behind the other.

    ``rotor`` (nodes,): the one that each node is of; else as ``motion.displacement``.
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
    """The six displacements of the cross-sections at ``stations`` of every rotor, likewise."""
    parts = [
        section_motion(spindle.part(name).shaft, *_nodes(name, node, rotor, shape), x)
        for name, x in stations.items()
    ]
    return np.concatenate(parts)


def _nodes(name: str, node: Array, rotor: Sequence[str], shape: Complex) -> tuple[Array, Complex]:
    chosen = np.array([each == name for each in rotor])
    return node[chosen], shape[chosen]
