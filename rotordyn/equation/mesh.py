"""Nodes of a rotor, and geometry and material of the shaft between them."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import accumulate, pairwise
from typing import Any

import numpy as np

from rotordyn.arrays import Array, Indices
from rotordyn.errors import InvalidInput
from rotordyn.machine.cross_section import area_moments, mean_area
from rotordyn.machine.shaft import Shaft
from rotordyn.machine.spindle import Spindle
from rotordyn.machine.support import SPINDLE

COINCIDENT = 1.5e-7  # of the shaft's length: closer stations are one node
ELEMENTS_OVER_LENGTH = 50  # of a shaft, by default
MOST_NODES = 100_000
SOLID = ("young_modulus", "poisson_ratio", "density")


@dataclass(frozen=True, eq=False, slots=True)
class Mesh:
    """Nodes ``x`` (nodes,) [m], ascending; all else per element, shape (nodes − 1,), SI.

    Diameters ``outer`` and ``inner`` (2, nodes − 1) are those at the front end of an element, and
    at its rear end, which differ for a cone. ``further``: meshes of further rotors by name, whose
    nodes are numbered behind these.
    """

    x: Array
    outer: Array
    inner: Array
    young_modulus: Array
    poisson_ratio: Array
    density: Array
    further: Mapping[str, Mesh] = field(default_factory=dict)

    @property
    def nodes(self) -> int:
        """Number of nodes of the shaft."""
        return len(self.x)

    @property
    def of_rotors(self) -> dict[str, Mesh]:
        """Mesh of every rotor by itself, in the order of their nodes."""
        return {SPINDLE: self, **self.further}

    @property
    def spans(self) -> dict[str, slice]:
        """Nodes of every rotor among those of all."""
        ends = [0, *accumulate(mesh.nodes for mesh in self.of_rotors.values())]
        return {
            name: slice(*ends_of)
            for name, ends_of in zip(self.of_rotors, pairwise(ends), strict=True)
        }

    @property
    def stations(self) -> Array:
        """Positions of the nodes of all rotors [m]."""
        return np.concatenate([mesh.x for mesh in self.of_rotors.values()])

    @property
    def rotor(self) -> tuple[str, ...]:
        """Rotor of each of these nodes."""
        return tuple(name for name, mesh in self.of_rotors.items() for _ in mesh.x)

    @property
    def length(self) -> Array:
        """Element lengths [m]."""
        return np.diff(self.x)

    @property
    def middle(self) -> Array:
        """Middle of each element [m]."""
        return np.asarray((self.x[1:] + self.x[:-1]) / 2.0)

    @property
    def steepness(self) -> Array:
        """Ratio of the outer diameters, or of the walls if that is larger, at the ends of each
        element, the larger over the smaller."""
        outer, wall = self.outer, self.outer - self.inner
        return np.asarray(np.maximum(*(d.max(axis=0) / d.min(axis=0) for d in (outer, wall))))

    def diameters(self, xi: Array) -> tuple[Array, Array]:
        """Return outer and inner diameter (elements, places) at ``xi`` on [−1, 1], linear."""
        share = (1.0 + xi) / 2.0
        outer, inner = (a[:, None] + np.outer(b - a, share) for a, b in (self.outer, self.inner))
        return outer, inner

    @property
    def mass(self) -> Array:
        """Mass of each element [kg]."""
        return np.asarray(self.density * mean_area(self.outer, self.inner) * self.length)

    @property
    def weight_line(self) -> Array:
        """Mass per length of each element at both of its ends (elements, 2) [kg/m], linear in
        between, with the mass and the centre of gravity of the element."""
        mean = self.density * mean_area(self.outer, self.inner)
        rise = 12.0 * self.density * area_moments(self.outer, self.inner)[0]
        return np.stack([mean - rise / 2.0, mean + rise / 2.0], axis=1)

    @property
    def centre(self) -> Array:
        """Centre of gravity of each element [m]."""
        front, rear = self.weight_line.T
        return np.asarray(self.middle + (rear - front) / (rear + front) * self.length / 6.0)

    @property
    def shear_modulus(self) -> Array:
        """G = E / (2 (1 + ν)) of each element [Pa]."""
        return self.young_modulus / (2.0 * (1.0 + self.poisson_ratio))

    def node_of(self, x: float) -> int:
        """Return the node at station ``x`` [m].

        Raises
        ------
        InvalidInput : no node is there
        """
        right = min(max(int(np.searchsorted(self.x, x)), 1), len(self.x) - 1)
        node = right - int(x - self.x[right - 1] <= self.x[right] - x)
        if abs(float(self.x[node]) - x) > 2.0 * COINCIDENT * float(self.x[-1] - self.x[0]):
            raise InvalidInput(f"no node at x = {x:g} m; the nearest is at {self.x[node]:g} m")
        return node

    def node_at(self, rotor: str, x: float) -> int:
        """Return the node of a rotor at ``x`` [m] among those of all; raises as ``node_of``."""
        return self.spans[rotor].start + self.of_rotors[rotor].node_of(x)


def build_mesh(spindle: Spindle, element_length: float | None = None) -> Mesh:
    """Return a mesh with nodes at every station, and such that no element exceeds
    ``element_length``.

    Stations are section boundaries, seats, supports, points, masses, discs, joints and those of the
    drawbar; those of a further rotor lie on it. ``element_length`` None is 1/50 of a shaft: then
    the nodes are places at which motion is shown and axial force changes, between which elements
    are as fine as an accuracy requires (``Fineness``). Where a length is given, standard elements
    lie between them.

    Raises
    ------
    InvalidInput : something sits off the shaft, or ``element_length`` is not positive
    """
    parts = spindle.parts
    meshes = {n: _mesh(p, _longest(p.shaft, element_length)) for n, p in parts.items()}
    return replace(meshes.pop(SPINDLE), further=meshes)


def station_mesh(spindle: Spindle) -> Mesh:
    """Return a mesh with nodes at stations only."""
    return _mesh(spindle, 2.0 * (spindle.shaft.end - spindle.shaft.start))


def _mesh(spindle: Spindle, longest: float) -> Mesh:
    shaft, placed = spindle.shaft, list(_placed(spindle))
    nodes = len(shaft.sections) + len(placed) + (shaft.end - shaft.start) / longest
    if nodes > MOST_NODES:
        raise InvalidInput(
            f"too many nodes: given {nodes:.0f} by {len(shaft.sections)} sections, {len(placed)} "
            f"parts on them and the length of elements; allowed: up to {MOST_NODES}; join sections "
            "that are alike, or give longer elements"
        )
    x = _merged(shaft, placed)
    section = np.searchsorted(shaft.boundaries[1:-1], (x[1:] + x[:-1]) / 2.0, side="right")
    left, length = np.array(shaft.boundaries)[section], np.array([s.length for s in shaft.sections])
    share = np.clip((np.stack([x[:-1], x[1:]]) - left) / length[section], 0.0, 1.0)
    rows = [
        (*s.outer, *s.inner, s.material.young_modulus, s.material.poisson_ratio, s.density)
        for s in shaft.sections
    ]
    properties = np.array(rows)[section].T
    ends = _along(properties[:2], share), _along(properties[2:4], share)
    parts = np.maximum(1, np.ceil(np.diff(x) / longest * (1.0 - COINCIDENT))).astype(np.intp)
    return divided(Mesh(x, *ends, *properties[4:]), parts)


def _along(ends: Array, share: Array) -> Array:
    """Interpolate diameters between those at ``ends`` (2, elements) of sections."""
    return np.asarray(ends[0] + share * (ends[1] - ends[0]))


def _longest(shaft: Shaft, element_length: float | None) -> float:
    if element_length is None:
        return (shaft.end - shaft.start) / ELEMENTS_OVER_LENGTH
    if not (math.isfinite(element_length) and element_length > 0.0):
        raise InvalidInput(f"element_length must be a positive length, got {element_length!r} m")
    return element_length


def _placed(spindle: Spindle) -> Iterator[tuple[str, float]]:
    """Yield what sits on the shaft, with a name for messages."""
    for kind in ("seats", "supports", "dampers", "masses", "discs", "joints"):
        for number, item in enumerate(getattr(spindle, kind), start=1):
            yield f"{kind} {number} ({item.name})", item.x
    for x in spindle.drawbar.stations if spindle.drawbar else ():
        yield "drawbar", x
    for name, x in spindle.points.items():
        yield f"point {name}", x


def _merged(shaft: Shaft, placed: Sequence[tuple[str, float]]) -> Array:
    """Return all stations in order, coincident ones once; section boundaries have precedence."""
    edges = shaft.boundaries
    start, end = edges[0], edges[-1]
    tolerance = COINCIDENT * (end - start)
    for name, x in placed:
        if not start - tolerance <= x <= end + tolerance:
            raise InvalidInput(f"{name} at x = {x:g} m is off the shaft ({start:g} to {end:g} m)")
    kept = list(edges)
    further = sorted(x for _, x in placed)
    if (np.diff(edges) <= tolerance).any():
        kept, further = [start, end], [*edges, *further]
    for x in further:
        place = bisect_left(kept, x)
        if all(abs(x - other) > tolerance for other in kept[max(place - 1, 0) : place + 1]):
            kept.insert(place, x)
    return np.array(kept)


def divided(mesh: Mesh, parts: Indices) -> Mesh:
    """Return ``mesh`` with every element cut into equal ``parts`` (elements,)."""
    number = np.arange(parts.sum()) - np.repeat(np.cumsum(parts) - parts, parts)
    inside = number * np.repeat(mesh.length / parts, parts) + np.repeat(mesh.x[:-1], parts)
    x = np.append(inside, mesh.x[-1])
    share = np.stack([number, number + 1]) / np.repeat(parts, parts)
    outer, inner = (_along(np.repeat(d, parts, axis=1), share) for d in (mesh.outer, mesh.inner))
    solid: dict[str, Any] = {name: np.repeat(getattr(mesh, name), parts) for name in SOLID}
    return replace(mesh, x=x, outer=outer, inner=inner, **solid)
