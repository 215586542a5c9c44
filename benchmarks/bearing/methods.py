"""The five ways to solve a bearing and to compute its K that Noël (2013), Tab. 2.3, compares."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from bearings import AngularContactBallBearing, stiffness
from bearings.ring.state import BearingState
from benchmarks.bearing.reference import largest
from benchmarks.bearing.subject import LOAD, SPEED, VEX70, solver
from benchmarks.bearing.timing import fastest


class Method(NamedTuple):
    """``by_load``: load → displacement; ``published``: cost over that of the first, Tab. 2.4."""

    by_load: bool
    stiffness: str
    published: float


METHODS = (
    Method(False, "frozen", 1.00),
    Method(True, "frozen", 6.01),
    Method(False, "complete", 1.05),
    Method(True, "complete", 6.34),
    Method(False, "difference", 5.73),
)
COPIES = 200  # states of a batch


def measure_methods(copies: int = COPIES, repeats: int = 7) -> list[dict[str, Any]]:
    """µs per state of each: one state and a batch in numpy, one compiled; the error of its K."""
    bearing = VEX70
    with solver(compiled=False):
        shift = bearing.equilibrium(load=LOAD, speed=SPEED).displacement
        exact = bearing.equilibrium(displacement=shift, speed=SPEED).stiffness()
    half = bearing.pitch_diameter / 2.0
    lever = np.array([1.0, 1.0, 1.0, 1.0 / half, 1.0 / half])
    lines = []
    for number, method in enumerate(METHODS, 1):
        given = {"load": LOAD} if method.by_load else {"displacement": shift}
        many = {name: np.tile(value, (copies, 1)) for name, value in given.items()}
        with solver(compiled=False):
            one = fastest(_work(bearing, given, method), repeats)
            batch = fastest(_work(bearing, many, method), repeats) / copies
            k = _work(bearing, given, method)()
        with solver(compiled=True):
            compiled = fastest(_work(bearing, given, method), repeats)
        apart = largest((k - exact) * lever, exact * lever, lever[:, None])
        lines.append(
            {
                "number": number,
                **method._asdict(),
                "one": 1e6 * one,
                "compiled": 1e6 * compiled,
                "batch": 1e6 * batch,
                "k_apart": apart,
            }
        )
    return lines


def _work(
    bearing: AngularContactBallBearing, given: dict[str, Any], method: Method
) -> Callable[[], Any]:
    def solved() -> Any:
        state: BearingState = bearing.equilibrium(speed=SPEED, **given)
        return stiffness(state, method.stiffness)

    return solved
