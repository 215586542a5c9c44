"""A mixed question has the answer of the pure one, whichever of each pair is given."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from bearings import InvalidBearing
from tests.oracles.known_bearings import VEX70

LOAD = [1000.0, 200.0, -100.0, 1.0, 2.0]


@pytest.mark.parametrize("speed", [0.0, 2000.0])
@pytest.mark.parametrize("by_load", list(itertools.product((True, False), repeat=5)))
def test_every_mix_finds_the_same_state(by_load: tuple[bool, ...], speed: float) -> None:
    pure = VEX70.equilibrium(load=LOAD, speed=speed)
    load = [f if given else None for f, given in zip(pure.load, by_load, strict=True)]
    move = [None if given else d for d, given in zip(pure.displacement, by_load, strict=True)]
    mixed = VEX70.equilibrium(load=load, displacement=move, speed=speed)
    assert mixed.displacement == pytest.approx(pure.displacement, rel=1e-8)
    assert mixed.load == pytest.approx(pure.load, rel=1e-8)


def test_blocked_tilts_stiffen_a_radial_load() -> None:
    """With free tilts the radial deflection is many times that with blocked ones."""
    free = VEX70.equilibrium(load=[1000.0, 100.0, 0.0, 0.0, 0.0])
    nothing = [None, None, None]
    blocked = VEX70.equilibrium(
        load=[1000.0, 100.0, 0.0, None, None], displacement=[*nothing, 0.0, 0.0]
    )
    assert free.displacement[1] > 5.0 * blocked.displacement[1]
    assert blocked.displacement[3:] == pytest.approx([0.0, 0.0], abs=0.0)


def test_batches_are_mixed_alike() -> None:
    load = np.array([[500.0, np.nan, 0, 0, 0], [900.0, np.nan, 0, 0, 0]])
    move = np.array([np.nan, 1e-6, np.nan, np.nan, np.nan])
    found = VEX70.equilibrium(load=load, displacement=move, speed=1000.0)
    assert found.displacement[:, 1] == pytest.approx([1e-6, 1e-6])
    assert (found.load[:, 1] > 0.0).all()


@pytest.mark.parametrize(
    ("load", "move", "words"),
    [
        (LOAD, [0.0] * 5, "Fx or δx: give exactly one, got both"),
        ([1000.0, None, 0, 0, 0], [None] * 5, "Fy or δy: give exactly one, got neither"),
        ([[1e3, 0, 0, 0, 0], [1e3, np.nan, 0, 0, 0]], [None, 0, None, None, None], "same one"),
    ],
)
def test_over_and_under_determined(load: list, move: list, words: str) -> None:
    with pytest.raises(InvalidBearing, match=words):
        VEX70.equilibrium(load=load, displacement=move)
