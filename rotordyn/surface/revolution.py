"""The surface of tubes laid end to end: a shaft with its steps and bores, or a disc."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from rotordyn.arrays import Array
from rotordyn.surface.body import Surface, Whole

GENERATORS = 8  # drawn lines along the surface
FACETS = 48  # around the axis: a polygon of 48 sides has 0.3 % less area than its circle
Interval = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Tube:
    """A hollow cylinder from ``left`` to ``right`` between radii ``inner`` and ``outer`` [m].

    It is a cone where radii at its right end are given.
    """

    left: float
    right: float
    inner: float
    outer: float
    right_inner: float | None = None
    right_outer: float | None = None

    @property
    def wall(self) -> Interval:
        """Inner and outer radius at the left end [m]."""
        return self.inner, self.outer

    @property
    def right_wall(self) -> Interval:
        """Inner and outer radius at the right end [m]."""
        inner, outer = self.right_inner, self.right_outer
        return self.inner if inner is None else inner, self.outer if outer is None else outer

    def radii(self, x: float) -> Interval:
        """Return inner and outer radius at ``x`` [m]."""
        share = (x - self.left) / (self.right - self.left)
        if x == self.right:
            return self.right_wall
        inner, outer = (
            a + share * (b - a) for a, b in zip(self.wall, self.right_wall, strict=True)
        )
        return inner, outer


def revolved(
    name: str,
    tubes: Sequence[Tube],
    longest: float = math.inf,
    facets: int = FACETS,
    station: float | None = None,
) -> Surface:
    """Return the closed surface of ``tubes``, the end of each the start of the next.

    ``longest``: distance of rings along the walls [m]; ``facets``: a multiple of ``GENERATORS``;
    ``station`` [m]: the cross-section that moves all of it, by default each point's own x.
    """
    rings = _Rings(facets)
    for tube in tubes:
        xs = _cuts(tube, longest)
        rings.wall([(x, tube.radii(x)[1]) for x in xs])
        if max(tube.inner, tube.right_wall[0]) > 0.0:
            rings.wall([(x, tube.radii(x)[0]) for x in reversed(xs)])
    for before, after in zip([None, *tubes], [*tubes, None], strict=True):
        _faces(rings, before, after)
    points = np.concatenate(rings.points)
    triangles = np.concatenate(rings.triangles)
    return Surface(
        points=points,
        triangles=triangles,
        station=points[:, 0].copy() if station is None else np.full(len(points), station),
        body=np.zeros(len(triangles), np.intp),
        names=(name,),
        lines=(*_generators(rings, tubes, longest), *_edges(rings, tubes)),
    )


def _cuts(tube: Tube, longest: float) -> list[float]:
    count = max(1, math.ceil((tube.right - tube.left) / longest))
    inside = np.linspace(tube.left, tube.right, count + 1)[1:-1].tolist()
    return [tube.left, *inside, tube.right]


def _faces(rings: _Rings, before: Tube | None, after: Tube | None) -> None:
    """Add the uncovered parts of two walls that meet; those of ``before`` face towards +x."""
    x = before.right if before else after.left if after else 0.0
    if before:
        for inner, outer in _uncovered(before.right_wall, after.wall if after else None):
            rings.wall([(x, outer), (x, inner)])
    if after:
        for inner, outer in _uncovered(after.wall, before.right_wall if before else None):
            rings.wall([(x, inner), (x, outer)])


def _uncovered(wall: Interval, against: Interval | None) -> Iterator[Interval]:
    """Yield the parts of ``wall`` that ``against`` does not cover."""
    if against is None or against[0] >= wall[1] or against[1] <= wall[0]:
        yield wall
        return
    if wall[0] < against[0]:
        yield wall[0], against[0]
    if against[1] < wall[1]:
        yield against[1], wall[1]


def _generators(rings: _Rings, tubes: Sequence[Tube], longest: float) -> Iterator[Whole]:
    """Yield lines along the outside at evenly spaced angles."""
    outline = [(x, tube.radii(x)[1]) for tube in tubes for x in _cuts(tube, longest)]
    first = np.array([rings.first[place] for place in dict.fromkeys(outline)])
    for angle in range(0, rings.facets, rings.facets // GENERATORS):
        yield first + angle


def _edges(rings: _Rings, tubes: Sequence[Tube]) -> Iterator[Whole]:
    """Yield circles where tubes begin and end."""
    around = np.append(np.arange(rings.facets), 0)
    ends = {(x, tube.radii(x)[1]): None for tube in tubes for x in (tube.left, tube.right)}
    for place in ends:
        yield rings.first[place] + around


@dataclass(slots=True)
class _Rings:
    """Circles of points by (x, radius), each created once; a radius of zero is a single point."""

    facets: int
    first: dict[Interval, int] = field(default_factory=dict)
    points: list[Array] = field(default_factory=list)
    triangles: list[Whole] = field(default_factory=list)
    _count: int = 0

    def wall(self, places: Sequence[Interval]) -> None:
        """Add bands between places, facing outwards for rising x, to +x for falling radius."""
        for near, far in pairwise(places):
            self.triangles.append(self._band(self._ring(near), self._ring(far)))

    def _ring(self, place: Interval) -> Whole:
        """Return the indices of the points at ``place``, the first one again at the end."""
        x, radius = place
        size = self.facets if radius > 0.0 else 1
        if place not in self.first:
            angle = 2.0 * np.pi * np.arange(size) / self.facets
            circle = (np.full(size, x), radius * np.cos(angle), radius * np.sin(angle))
            self.first[place] = self._count
            self.points.append(np.stack(circle, axis=1))
            self._count += size
        return self.first[place] + np.append(np.arange(self.facets), 0) % size

    def _band(self, near: Whole, far: Whole) -> Whole:
        first = np.stack([near[:-1], near[1:], far[1:]], axis=1)
        second = np.stack([near[:-1], far[1:], far[:-1]], axis=1)
        faces = np.concatenate([first, second])
        flat = (faces == np.roll(faces, 1, axis=1)).any(axis=1)  # degenerate at a point on the axis
        return faces[~flat]
