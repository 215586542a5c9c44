"""Reported errors of many receptances at once are those of each alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotordyn.analyses.frf.solve import solve
from rotordyn.analyses.frf.spec import FrfSpec
from rotordyn.analyses.measured_response import Port
from rotordyn.machine.housing import RigidHousing
from rotordyn.machine.spindle import Spindle
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.rotors import STEPPED, support
from tests.oracles.spindles import RPM

FREQUENCIES = tuple(np.linspace(20.0, 1500.0, 40))
X = (0.03, 0.11, 0.2)


def machine(kind: str) -> Spindle:
    """Two supports under a rotor that can be asked at three points."""
    even = kind in ("isotropic", "lossy")
    second = 3e7 if even else 5e7
    front = support("front", 0.02, (3e7, second), 2e3)
    rear = support("rear", 0.22, (4e7, 4e7 if even else 2e7), 1e3)
    if not even:
        crossed = {("y", "z"): 4e6, ("z", "y"): -1e6}
        front = replace(front, stiffness={**front.stiffness, **crossed})
    plain = replace(STEPPED, supports=(front, rear), points={f"p{k}": x for k, x in enumerate(X)})
    if kind == "lossy":
        return replace(plain, loss_factor=0.02)
    if kind != "coupled":
        return plain
    hold: dict[tuple[str, str], float] = {
        ("x", "x"): 1e7,
        ("thx", "thx"): 1e3,
        ("x", "y"): 3e5,
        ("z", "x"): 2e5,
    }
    joined = replace(front, stiffness={**front.stiffness, **hold})
    on = RigidHousing("wall", ("front",), front.x, 9.0, {("y", "y"): 8e7, ("z", "z"): 4e7})
    return replace(plain, supports=(joined, rear), housings=(on,))


PAIRS = {
    "one force": [(Port(f"p{k}", way), Port("p0", "y")) for k in range(3) for way in ("y", "thz")],
    "one response": [(Port("p0", "y"), Port(f"p{k}", way)) for k in range(3) for way in ("z", "y")],
    "across": [(Port("p1", "z"), Port("p0", "y")), (Port("p2", "thy"), Port("p1", "z"))],
}
ALONG = [(Port("p1", "x"), Port("p0", "y")), (Port("p2", "x"), Port("p0", "x"))]


@pytest.mark.few(4)
@pytest.mark.parametrize("asked", PAIRS)
@pytest.mark.parametrize("kind", ["isotropic", "uneven", "lossy", "coupled"])
def test_together_as_alone(kind: str, asked: str) -> None:
    spindle, every = machine(kind), PAIRS[asked] + (ALONG if kind == "coupled" else [])

    def error(*pairs: tuple[Port, Port]) -> np.ndarray:
        stations = tuple(spindle.points.values())
        scene = Scene(
            spindle, Conditions(accuracy=1e-3), np.array([9000.0 * RPM]), 1500.0, stations
        )
        return solve(scene, FrfSpec(FREQUENCIES, pairs)).error

    together = error(*every)
    assert (together > 1e-9).all()
    assert together == pytest.approx([error(pair)[0] for pair in every], rel=1e-6)
