"""Coordinates in which rotors are joined: what elimination and the whole matrix have in common."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from rotordyn.system.dynamic_stiffness.whirling_shaft import Whirl

Array = NDArray[np.float64]
Values = NDArray[np.inexact[Any]]
Motion = dict[int, Values]


class Dynamic(Protocol):
    """All rotors in a plane at some frequencies: their ``matrix`` (n, n, f), ``doubt`` (f,) of the
    pivots, and ``motion`` of nodes (2, e, f) by that of the coordinates (n, e, f)."""

    @property
    def matrix(self) -> Values: ...
    @property
    def doubt(self) -> Array: ...
    def motion(self, moved: Values, wanted: Collection[int]) -> Motion: ...


class Coordinates(Protocol):
    """n coordinates of all rotors in a plane, and the ``rows`` (2, n) by which a node moves."""

    @property
    def size(self) -> int: ...
    def rows(self, node: int) -> Array: ...
    def dynamic(self, whirl: Whirl, force: Array | None, at: Mapping[int, Values]) -> Dynamic: ...


def side_by_side(matrices: Sequence[Values]) -> Values:
    """Block diagonal of (k, k, f) matrices."""
    if len(matrices) == 1:
        return matrices[0]
    sizes = [len(matrix) for matrix in matrices]
    frequencies = matrices[0].shape[-1]
    kind = np.result_type(*matrices)
    whole = np.zeros((sum(sizes), sum(sizes), frequencies), dtype=kind)
    begin = 0
    for matrix in matrices:
        own = slice(begin, begin + len(matrix))
        whole[own, own] = matrix
        begin = own.stop
    return whole
