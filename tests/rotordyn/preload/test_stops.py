"""The speed at which a stop is met, from the gap at speeds that are requested."""

from __future__ import annotations

import math
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rotordyn.preload.arrangement import Push
from rotordyn.preload.stops import _search, meeting_speeds


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


@pytest.mark.parametrize("direction", [1, -1])
@pytest.mark.parametrize("last", [60.0, 450.0])
def test_a_sleeve_meets_its_stop_or_the_last_speed_that_balances(
    monkeypatch: pytest.MonkeyPatch, direction: int, last: float
) -> None:
    """It comes 4 µm at 200 rad/s, with the square of speed, to a stop 9 µm off: at 300 rad/s; where
    nothing balances from 60 rad/s on, there."""

    def stand(speed: np.ndarray, limit: np.ndarray, _start: Any) -> Any:
        assert np.isnan(limit[:, 1]).all()
        assert (limit[:, 2] == 1.0).all()
        place = np.zeros((len(speed), 3))
        place[:, 1] = -direction * 4e-6 * (speed / 200.0) ** 2
        return SimpleNamespace(position=place, converged=speed < last)

    monkeypatch.setattr("rotordyn.preload.stops.with_stops", stand)
    limit = np.array([np.nan, -direction * 9e-6, 1.0])
    push = Push(1, direction, 100.0, 1e6, 9e-6)
    found = meeting_speeds(
        lambda speed, _: speed,  # type: ignore[arg-type,return-value]
        np.array([limit, limit]),
        push,
        np.array([[50.0, 500.0], [0.0, 700.0]]),
        np.zeros((2, 2, 3)),
    )
    assert found == pytest.approx([min(300.0, last)] * 2, rel=1e-9)
