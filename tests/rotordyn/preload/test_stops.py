"""The speed at which a stop is met, from the gap at speeds that are asked for."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from rotordyn.preload.stops import _search


def met(gap: Callable[[np.ndarray], np.ndarray], low: float, high: float) -> float:
    """The speed found between two speeds squared, of a gap over these."""
    search = _search(low, high)
    asked = next(search)
    try:
        while True:
            asked = search.send(gap(asked))
    except StopIteration as end:
        return float(end.value)


@pytest.mark.parametrize("zero", [1.7e5, 4.4e6, 8.999e6])
def test_a_smooth_gap_is_met_at_its_zero(zero: float) -> None:
    found = met(lambda s: np.expm1((zero - s) / 3e6), 1e5, 9e6)
    assert found == pytest.approx(math.sqrt(zero), rel=1e-11)


@pytest.mark.parametrize("edge", [1.7e5, 4.4e6, 8.999e6])
def test_states_that_end_are_met_where_they_end(edge: float) -> None:
    """A gap that never closes, of speeds beyond which nothing balances."""
    found = met(lambda s: np.where(s < edge, 1e-6, -np.inf), 1e5, 9e6)
    assert found == pytest.approx(math.sqrt(edge), rel=1e-11)
