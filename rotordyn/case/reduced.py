"""What a reduced model of a housing is, once read; how it is read: ``case.reduced_files``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


class NoModel(Exception):
    """A file that holds no reduced model; the message says why."""


@dataclass(frozen=True, eq=False, slots=True)
class ReducedModel:
    """Matrices (n, n) and ``shape`` (places, n), as in ``machine.housing.ReducedHousing``."""

    places: tuple[str, ...]
    shape: Array
    mass: Array
    stiffness: Array
    damping: Array
