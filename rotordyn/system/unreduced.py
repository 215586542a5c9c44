"""What stands between a reduced rotor and its assembled matrices.

Beside the m coordinates of a plane the assembled system has c more, chosen (K + σM)-orthonormal and
(K + σM)-orthogonal to them (``Complement``). Forces at bearings, supports and contacts of the
drawbar, which the coordinates answer, then hardly reach these c.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import astuple, dataclass, field, replace
from functools import cached_property
from itertools import accumulate

import numpy as np
from numpy.typing import NDArray

from rotordyn.machine.spindle import Spindle
from rotordyn.numerics.reduction import Complement, RitzBasis, side_by_side
from rotordyn.numerics.sparse import Matrix, block_diagonal, wider

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class MaterialDamping:
    """Of the rotor itself: Rayleigh's ``mass`` [1/s] and ``stiffness`` [s], the largest damping
    ``ratio`` of its modes, and at how many times the speed it ``turns``, the share that does."""

    mass: float = 0.0
    stiffness: float = 0.0
    ratio: float = 0.0
    turns: float = 0.0

    @classmethod
    def of(cls, spindle: Spindle, turning: float = 0.0) -> MaterialDamping:
        """``turning``: the share that turns."""
        rayleigh, ratio = spindle.rayleigh, max(spindle.rotor_damping, default=0.0)
        return cls(rayleigh.mass, rayleigh.stiffness, ratio, turning)

    @classmethod
    def most(cls, every: Iterable[MaterialDamping]) -> MaterialDamping:
        """No less than any of them."""
        return cls(*map(max, zip(*map(astuple, every), strict=True)))


@dataclass(frozen=True, eq=False)
class Unreduced:
    """The assembled rotor in one plane, n freedoms, and the ``basis`` that it was reduced to.

    ``at_nodes`` (rows, n): motion of the nodes of the mesh; ``polar`` (n, n): None without
    gyroscopic effect; ``slope`` (places, n): slopes v′ times the root of the length that each
    stands for, None where axial force does nothing; ``spans``: rows of the two ends and stiffness
    of every straight part of the drawbar; ``dampers``: freedom and damping of every joint that
    damps; ``turning``: at how many times the speed each of these turns; ``more``: coordinates of
    the reduced system that are none of the rotor's; ``material``: the rotor's own damping.
    """

    basis: RitzBasis
    at_nodes: Matrix
    polar: Matrix | None = None
    slope: Matrix | None = None
    spans: Sequence[tuple[int, int, float]] = ()
    dampers: Mapping[int, float] = field(default_factory=dict)
    turning: tuple[float, ...] = ()
    more: int = 0
    material: MaterialDamping = MaterialDamping()

    @cached_property
    def rest(self) -> Complement:
        """The c coordinates left out."""
        return self.basis.complement

    def at_ratio(self, ratio: float) -> Unreduced:
        """The same rotor at ``ratio`` times the speed."""
        polar = None if self.polar is None else ratio * self.polar
        material = replace(self.material, turns=abs(ratio) * self.material.turns)
        turning = (ratio,) * len(self.dampers)
        return replace(self, polar=polar, turning=turning, material=material)

    def beside(self, others: Sequence[Unreduced]) -> Unreduced:
        """With other rotors, on which neither axial force nor a drawbar acts."""
        every = (self, *others)
        size = sum(len(one.basis.vectors) for one in others)
        polar = None if self.polar is None else block_diagonal([one.polar for one in every])
        first = accumulate((len(one.basis.vectors) for one in every), initial=0)
        dampers = {
            begin + row: damping
            for begin, one in zip(first, every, strict=False)
            for row, damping in one.dampers.items()
        }
        return replace(
            self,
            basis=side_by_side([one.basis for one in every]),
            at_nodes=block_diagonal([one.at_nodes for one in every]),
            polar=polar,
            dampers=dampers,
            turning=tuple(ratio for one in every for ratio in one.turning),
            slope=None if self.slope is None else wider(self.slope, size),
            material=MaterialDamping.most(one.material for one in every),
        )

    @property
    def shift(self) -> float:
        """σ [1/s²], the largest of rotors side by side: what is bounded by it grows with it."""
        return float(np.max(self.basis.shift, initial=0.0))

    @cached_property
    def mass_coupling(self) -> Array:
        """ΨᵀMΦ (c, m)."""
        return self._widened(self.rest.coupling)

    @cached_property
    def polar_coupling(self) -> Array:
        """ΨᵀPΦ (c, m)."""
        if self.polar is None:
            return np.zeros_like(self.mass_coupling)
        return self._widened(self.rest.vectors.T @ (self.polar @ self.basis.vectors))

    @cached_property
    def answers(self) -> Array:
        """1 for coordinates (m,) that are no modes, which modal damping couples to the others."""
        return np.pad((~self.basis.are_modes).astype(float), (0, self.more))

    @cached_property
    def frequencies(self) -> Array:
        """Roots of the stiffness of the coordinates (m,) [rad/s]."""
        return np.pad(np.sqrt(self.basis.values), (0, self.more))

    @cached_property
    def seen(self) -> Array:
        """Motion of the nodes by what is left out (rows, c)."""
        return np.asarray(self.at_nodes @ self.rest.vectors)

    @cached_property
    def mass_norm(self) -> float:
        """Of ΨᵀMΨ, on vectors of unit stiffness [s²]."""
        return self.rest.mass_norm

    @cached_property
    def polar_norm(self) -> float:
        """Of ΨᵀPΨ [s²]."""
        return 0.0 if self.polar is None else self.rest.norm(self.polar)

    @cached_property
    def slope_norm(self) -> float:
        """Of the slopes by what is left out, the root of ∫ v′² dx at most [N^-½]."""
        return 0.0 if self.slope is None else self.rest.reach(self.slope)

    @cached_property
    def bar_rows(self) -> tuple[Array, Array]:
        """Root of the stiffness times the stretch of every part of the drawbar: by what is left
        out (spans, c), by the coordinates (spans, m)."""
        moved = self.at_nodes @ self.basis.vectors
        return self._stretch(self.seen), self._widened(self._stretch(moved))

    @cached_property
    def damper_rows(self) -> tuple[Array, Array]:
        """Root of the damping times the motion of every joint that damps: by what is left out
        (dampers, c), by the coordinates (dampers, m)."""
        rows, root = list(self.dampers), np.sqrt(list(self.dampers.values()))[:, None]
        left_out, own = self.rest.vectors[rows], self.basis.vectors[rows]
        return root * left_out, self._widened(root * own)

    def _stretch(self, moved: Array) -> Array:
        rows = [np.sqrt(k) * (moved[right] - moved[left]) for left, right, k in self.spans]
        return np.array(rows).reshape(len(rows), moved.shape[1])

    def _widened(self, matrix: Array) -> Array:
        return np.pad(matrix, ((0, 0), (0, self.more)))
