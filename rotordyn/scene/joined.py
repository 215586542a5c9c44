"""The equations of motion of several subsystems as one."""

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
    """q̈ + C q̇ + K q = f of ``parts`` side by side, in the motions that rigid supports allow, at
    their speeds (s,)."""

    scene: Scene
    parts: tuple[Linear, ...]

    @classmethod
    def of(cls, scene: Scene, systems: Iterable[int], rows: Indices | None = None) -> Joined:
        """Some subsystems of a scene at its usable speeds, or at some ``rows`` of them."""
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
        """What of C is per unit of the spindle's speed (n, n)."""
        return _blocks([part.within(part.gyroscopic)[None] for part in self.parts])[0]

    def by_coordinates(self, rows: Callable[[Linear], Array]) -> Array:
        """``rows`` of each part (…, its own coordinates) by the coordinates of all (…, n)."""
        return np.concatenate([along(rows(part), part.basis) for part in self.parts], axis=-1)

    def displaced(self, places: Iterable[tuple[str | float, str]]) -> Array:
        """Displacements of points or stations in directions by the coordinates (places, n)."""
        at = [(*self.scene.spindle.place(point), way) for point, way in places]
        return self.by_coordinates(lambda part: np.stack([part.row(*each) for each in at]))


def _blocks(parts: list[Array]) -> Array:
    """Matrices (s, n, n) side by side on the diagonal of one."""
    ends = np.cumsum([0, *(part.shape[-1] for part in parts)])
    whole = np.zeros((len(parts[0]), ends[-1], ends[-1]))
    for begin, end, part in zip(ends[:-1], ends[1:], parts, strict=True):
        whole[:, begin:end, begin:end] = part
    return whole
