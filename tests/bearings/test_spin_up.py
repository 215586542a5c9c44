"""The first gap of speed, searched for where it is known."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from bearings.ring.condition import first_gaps
from bearings.ring.request import solved
from bearings.ring.spin_up import Gap, spin_up
from benchmarks.random_bearings import rings

Array = NDArray[np.float64]
ASKED = 1000.0
Law = Callable[[Array], NDArray[np.bool_]]


def searched(there: Law, touch: Law, *, jumps: bool = True) -> tuple[Gap, int]:
    """What is found where states and the contact of one ball are known; the speeds looked at."""
    search, count = spin_up(ASKED, jumps=jumps), 0
    speed = next(search)
    while True:
        count += len(speed)
        assert ((speed >= 0.0) & (speed < ASKED)).all()
        try:
            speed = search.send((there(speed), touch(speed)[:, None]))
        except StopIteration as end:
            return end.value, count


def never(speed: Array) -> NDArray[np.bool_]:
    return np.zeros(speed.shape, dtype=bool)


@pytest.mark.parametrize("end", [3.3, 77.7, 500.0, 999.9])
def test_states_end_once_and_for_all(end: float) -> None:
    gap, count = searched(lambda w: w < end, never)
    assert end - ASKED / 16384.0 <= gap.low < end
    assert gap.again is None
    assert count < 130


def test_no_state_but_at_rest() -> None:
    gap, _ = searched(lambda w: w == 0.0, never)
    assert gap == Gap(0.0)


@pytest.mark.parametrize("first", [100.0, 333.3, 700.1])
def test_a_gap_much_narrower_than_the_grid_where_a_contact_opens(first: float) -> None:
    """1/1000 of the way: a grid of 64 steps over it, and so does the search without jumps."""

    def there(speed: Array) -> NDArray[np.bool_]:
        return ((speed < first) | (speed > first + 1.0)) & (speed < 800.0)

    def touch(speed: Array) -> NDArray[np.bool_]:
        return speed < first + 0.5

    gap, _ = searched(there, touch)
    assert first - ASKED / 1024.0 <= gap.low <= first
    assert gap.again is not None
    assert first + 1.0 < gap.again[0] < first + 20.0
    assert 799.0 < gap.again[1] < 800.0
    over, _ = searched(there, touch, jumps=False)
    assert over.low == pytest.approx(800.0, abs=0.1)


def test_states_again_and_again() -> None:
    def there(speed: Array) -> NDArray[np.bool_]:
        return (
            (speed < 200.0) | ((speed > 300.0) & (speed < 400.0)) | (np.abs(speed - 700.0) < 50.0)
        )

    gap, _ = searched(there, never)
    assert gap.low == pytest.approx(200.0, abs=0.1)
    assert gap.again == pytest.approx((300.0, 750.0), abs=ASKED / 400.0)  # 1/25 split by 16
    assert gap.broken


@pytest.mark.few(1)
@pytest.mark.parametrize(("number", "index"), [(83, 1), (126, 6)])
def test_states_exist_up_to_the_reported_speed_and_again_above(number: int, index: int) -> None:
    """The first: without states only from 4.3 to 4.6 % of its speed, then up to 11.7 %."""
    state = rings.draw_states(number).solve()
    assert state.outcome[index] == "no equilibrium"
    gap = first_gaps(state.operation, np.array([index]))[0]
    assert gap.again is not None
    below = gap.low * np.array([0.25, 0.5, 0.75, 0.95, 1.0])
    speed = np.array([*below, gap.low + state.speed[index] / 8192.0, *gap.again])
    there = solved(state.operation.repeated(index, speed)).outcome == ""
    assert there.tolist() == [True] * 5 + [False] + [True] * 2
