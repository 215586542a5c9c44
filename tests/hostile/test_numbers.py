"""The judge of numbers sees what has no word, and believes a word only where it holds."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import pytest

from rotordyn.arrays import Array, Words
from rotordyn.results.declaration import Absence, coordinate, quantity
from tests.hostile.numbers import unexplained

NAN, INF = np.nan, np.inf


@dataclass(frozen=True)
class Sample:
    """Two speeds, three peaks."""

    speed: Array = coordinate("speed", unit="rad/s", label="speed")
    outcome: Words = quantity("speed", unit="", label="outcome")
    load: Array = quantity("speed", unit="N", label="load")
    plain: Array = quantity("speed", unit="N", label="plain")
    oil: Array = quantity("speed", unit="1", label="oil", absent=(Absence("without oil"),))
    life: Array = quantity(
        "speed", unit="s", label="life", infinite=(Absence("without load", beside="load"),)
    )
    peak: Array = quantity(
        "speed", "peak", unit="Hz", label="peak", absent=(Absence("fewer", last="peak"),)
    )


WHOLE = Sample(
    speed=np.array([0.0, 1.0]),
    outcome=("", "no solution"),
    load=np.array([0.0, NAN]),
    plain=np.array([1.0, NAN]),
    oil=np.array([NAN, NAN]),
    life=np.array([INF, NAN]),
    peak=np.array([[1.0, 2.0, NAN], [NAN, NAN, NAN]]),
)


def test_what_is_explained_is_allowed() -> None:
    assert [*unexplained(WHOLE)] == []


@pytest.mark.parametrize(
    ("changed", "found"),
    [
        ({"plain": np.array([NAN, NAN])}, "plain absent at 1 of 2, first at (0,)"),
        ({"plain": np.array([INF, NAN])}, "plain infinite at 1 of 2, first at (0,)"),
        ({"outcome": ("", "")}, "load absent at 1 of 2, first at (1,)"),
        ({"oil": np.array([NAN, 2.0]), "outcome": ("", "")}, "oil absent at 1 of 2"),
        ({"load": np.array([5.0, NAN])}, "life infinite at 1 of 2, first at (0,)"),
        ({"life": np.array([NAN, NAN])}, "life absent at 1 of 2, first at (0,)"),
        (
            {"peak": np.array([[1.0, NAN, 2.0], [NAN] * 3])},
            "peak absent at 1 of 6, first at (0, 1)",
        ),
    ],
)
def test_what_is_not_is_found(changed: dict[str, object], found: str) -> None:
    assert any(each.startswith(found) for each in unexplained(replace(WHOLE, **changed)))
