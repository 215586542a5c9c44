"""Latin hypercube samples of a unit box."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rotordyn.arrays import Array


def latin_hypercube(count: int, size: int, seed: int | Sequence[int]) -> Array:
    """Draw points (count, size) in [0, 1): along each parameter one in every interval of 1/count
    (McKay, Beckman and Conover, Technometrics 21 (1979) 239).

    The points equal those of ``scipy.stats.qmc.LatinHypercube``, whose import takes 0.6 s: as long
    as a dozen points of a study.
    """
    (rng,) = np.random.default_rng(seed).spawn(1)  # as scipy does
    within = rng.uniform(size=(count, size))
    places = np.tile(np.arange(1, count + 1), (size, 1))
    for row in places:
        rng.shuffle(row)
    return np.asarray((places.T - within) / count)
