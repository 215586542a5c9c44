"""Loads that grow in strides, as few as lead to the balance under the whole of them."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rotordyn.machine.limits import HIGHEST_PRESSURE
from rotordyn.preload import under_load
from rotordyn.preload.under_load import _marched, _pushed_apart, _why


class Stiffening:
    """One coordinate, held by x + x³; a balance is found from one whose load is at most ``reach``
    away, at once."""

    def __init__(self, reach: float) -> None:
        self.reach = reach
        self.start, self.held = np.zeros((1, 1)), np.zeros((1, 1), dtype=bool)
        self.tried: list[float] = []

    def evaluate(self, coordinates: np.ndarray, _: Any) -> Any:
        return SimpleNamespace(coordinates=coordinates, pressure=np.zeros(1), bearings=[])

    def per_newton(self, here: Any, _: Any) -> np.ndarray:
        return np.asarray(1.0 / (1.0 + 3.0 * here.coordinates**2))

    def slack(self, _: Any) -> np.ndarray:
        return np.zeros(1, dtype=bool)

    def balls_along(self, *_: Any) -> list[np.ndarray]:
        return []

    def where(self, *_: Any) -> Stiffening:
        return self

    def error(self, there: Any, load: float) -> np.ndarray:
        return np.asarray(np.abs(force(there.coordinates[:, 0]) - load) / load)

    def solved(self, guess: Any, here: Any, load: float, _: Any) -> Any:
        self.tried.append(float(load))
        far = np.abs(load - force(here.coordinates[:, 0])) > self.reach
        real = [root.real for root in np.roots([1.0, 0.0, 1.0, -load]) if abs(root.imag) < 1e-9]
        there = guess[0] if far.any() else np.array([real])
        return self, self.evaluate(there, None), ~far


@pytest.fixture
def stiffening(monkeypatch: pytest.MonkeyPatch) -> None:
    """Balances are those that the coordinate finds."""
    monkeypatch.setattr(under_load, "balanced", Stiffening.solved)


def force(x: np.ndarray) -> np.ndarray:
    return np.asarray(x + x**3)


@pytest.mark.usefixtures("stiffening")
@pytest.mark.parametrize("size", [2.0, -30.0])
@pytest.mark.parametrize(("reach", "strides"), [(1.01, 1), (0.3, 4), (0.07, 16)])
def test_loads_grow_to_their_size_in_equal_strides(size: float, reach: float, strides: int) -> None:
    """The fewest of 1, 4 or 16 that suffice; the balance is that of the whole loads."""
    spring = Stiffening(reach * abs(size))
    _, there, good = _marched(spring, size)  # type: ignore[arg-type]
    assert good.all()
    assert force(there.coordinates) == pytest.approx(np.array([[size]]), rel=1e-12)
    assert spring.tried[-strides:] == pytest.approx(
        [size * (k + 1) / strides for k in range(strides)]
    )


@pytest.mark.usefixtures("stiffening")
def test_what_no_stride_leads_to_is_no_balance() -> None:
    assert not _marched(Stiffening(0.05), 1.0)[2].any()  # type: ignore[arg-type]


def row_of_states() -> Any:
    seats = [SimpleNamespace(name=name, thrust=sign) for name, sign in (("a", 1), ("b", -1))]
    return SimpleNamespace(
        speed=np.array([0.0, 1500.0 * np.pi / 30.0]),
        spindle=SimpleNamespace(seats=seats),
        network=SimpleNamespace(both_ways=np.array([False, False])),
    )


def test_words_say_speed_pressure_and_loads() -> None:
    there: Any = SimpleNamespace(pressure=np.array([3e9, 12.34e9]))
    assert HIGHEST_PRESSURE == 10e9
    calm, heavy = (_why(row_of_states(), there, row, 7500.0) for row in (0, 1))
    assert calm.startswith("nothing balances the loads of 7500 N on the shaft at 0 rpm")
    assert "overloaded under the loads of 7500 N on the shaft at 1500 rpm" in heavy
    assert "peak pressure 12.3 GPa, at most 10 GPa" in heavy


@pytest.mark.parametrize(("load", "named"), [((30.0, 40.0), "b"), ((-30.0, -40.0), "a")])
def test_a_bearing_whose_thrust_turns_over_is_pushed_apart(
    load: tuple[float, float], named: str
) -> None:
    """Loads towards +x in the spindle press a bearing of thrust +1 and pull at one of −1."""
    there: Any = SimpleNamespace(load=np.array([[[0.0], [0.0]], [[load[0]], [load[1]]]]))
    balance: Any = SimpleNamespace(bearings=[0, 1])
    assert _pushed_apart(row_of_states(), balance, there, 0) == ""
    word = _pushed_apart(row_of_states(), balance, there, 1)
    assert word.startswith(f"the loads push bearing {named} apart at 1500 rpm")
