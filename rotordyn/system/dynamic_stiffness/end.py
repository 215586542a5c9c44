"""A freedom of bending at which a force acts, or a response is asked for."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class End:
    """A freedom of a ``node`` of the mesh: ``place`` 0 deflection, 1 tilt; ``plane`` 0 (y) or 1
    (z); ``sign`` −1 where the coordinate is minus the freedom."""

    node: int
    place: int
    plane: int
    sign: float
