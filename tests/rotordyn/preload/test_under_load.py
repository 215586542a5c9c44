"""Loads that grow in strides, as few as lead to the balance under the whole of them."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from rotordyn.preload.under_load import _marched


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


def force(x: np.ndarray) -> np.ndarray:
    return np.asarray(x + x**3)


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


def test_what_no_stride_leads_to_is_no_balance() -> None:
    assert not _marched(Stiffening(0.05), 1.0)[2].any()  # type: ignore[arg-type]
