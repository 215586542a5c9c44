"""A closed surface of triangles whose points move with cross-sections of the shaft."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rotordyn.arrays import Array, Indices

Whole = Indices


@dataclass(frozen=True, eq=False, slots=True)
class Surface:
    """One or more closed bodies.

    ``points`` (n, 3) [m] in the axes of the spindle; ``triangles`` (m, 3), counter-clockwise seen
    from outside; ``station`` (n,) [m]: the cross-section that each point moves with; ``body`` (m,):
    place in ``names`` of the body a triangle belongs to. ``lines``: rows of points along the
    generators and the edges, to be drawn.
    """

    points: Array
    triangles: Whole
    station: Array
    body: Whole
    names: tuple[str, ...]
    lines: tuple[Whole, ...]

    def volume(self, name: str) -> float:
        """Return the volume enclosed by the body ``name`` [m³]."""
        a, b, c = self.points[self.triangles[self.body == self.names.index(name)]].swapaxes(0, 1)
        return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0


def together(parts: Sequence[Surface]) -> Surface:
    """Return all bodies of ``parts`` as one surface."""
    shifts = np.cumsum([0, *(len(part.points) for part in parts)]).tolist()
    bodies = np.cumsum([0, *(len(part.names) for part in parts)]).tolist()
    shifted = list(zip(parts, shifts, bodies, strict=False))
    return Surface(
        points=np.concatenate([part.points for part in parts]),
        triangles=np.concatenate([part.triangles + shift for part, shift, _ in shifted]),
        station=np.concatenate([part.station for part in parts]),
        body=np.concatenate([part.body + first for part, _, first in shifted]),
        names=tuple(name for part in parts for name in part.names),
        lines=tuple(line + shift for part, shift, _ in shifted for line in part.lines),
    )
