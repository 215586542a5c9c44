"""Points spread evenly within a box."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import qmc

from rotordyn.study.latin_hypercube import latin_hypercube


@pytest.mark.parametrize(("count", "size"), [(1, 1), (1, 3), (7, 1), (32, 6), (1000, 2)])
@pytest.mark.parametrize("seed", [0, 1, (3, 2)])
def test_points_are_those_of_scipy(count: int, size: int, seed: int | tuple[int, int]) -> None:
    expected = qmc.LatinHypercube(size, rng=seed).random(count)
    assert (latin_hypercube(count, size, seed) == expected).all()


def test_every_interval_has_one_point() -> None:
    found = np.floor(latin_hypercube(50, 4, 5) * 50)
    assert (np.sort(found, axis=0) == np.arange(50)[:, None]).all()
