"""The equations of motion of several subsystems combined."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from rotordyn.arrays import Array, Indices
from rotordyn.equation.constraint import along
from rotordyn.equation.linear import Linear
from rotordyn.scene.scene import Scene


@dataclass(frozen=True, eq=False, slots=True)
class Joined:
    """Equation q̈ + C q̇ + K q = f of ``parts`` together, in coordinates that rigid supports allow,
    at their speeds (s,)."""

    scene: Scene
    parts: tuple[Linear, ...]

    @classmethod
    def of(cls, scene: Scene, systems: Iterable[int], rows: Indices | None = None) -> Joined:
        """Combine subsystems of a scene at its usable speeds, or at some ``rows`` of them."""
        return cls(scene, tuple(scene.linear(k, rows) for k in systems))

    @property
    def stiffness(self) -> Array:
        """K (s, n, n)."""
        return _blocks([part.allowed_stiffness for part in self.parts])

    @property
    def damping(self) -> Array:
        """C (s, n, n), gyroscopic effect included."""
        return _blocks([part.within(part.damping) for part in self.parts])

    @property
    def gyroscopic(self) -> Array:
        """Part of C per unit of the spindle's speed (n, n)."""
        return _blocks([part.within(part.gyroscopic)[None] for part in self.parts])[0]

    def by_coordinates(self, rows: Callable[[Linear], Array]) -> Array:
        """Combine ``rows`` of each part (…, its coordinates) to rows by all coordinates (…, n)."""
        return np.concatenate([along(rows(part), part.basis) for part in self.parts], axis=-1)

    def displaced(self, places: Iterable[tuple[str | float, str]]) -> Array:
        """Return rows (places, n) of the displacements of points or stations in directions."""
        at = [(*self.scene.spindle.place(point), direction) for point, direction in places]
        return self.by_coordinates(lambda part: np.stack([part.row(*place) for place in at]))


def _blocks(parts: list[Array]) -> Array:
    """Return the block-diagonal matrices (s, n, n) of ``parts``."""
    ends = np.cumsum([0, *(part.shape[-1] for part in parts)])
    matrices = np.zeros((len(parts[0]), ends[-1], ends[-1]))
    for begin, end, part in zip(ends[:-1], ends[1:], parts, strict=True):
        matrices[:, begin:end, begin:end] = part
    return matrices
