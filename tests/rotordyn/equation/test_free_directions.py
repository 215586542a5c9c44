"""Motions that nothing holds, by what joins the bodies."""

from __future__ import annotations

import numpy as np
import pytest

from rotordyn.equation.free_directions import free_directions
from rotordyn.machine.support import LinearSupport
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.scene import Scene
from tests.oracles.rotors import STEEL, uniform


@pytest.mark.parametrize(
    ("support", "free"),
    [
        (LinearSupport("hinge", 0.1, {}, rigid=("y", "z")), 2),
        (LinearSupport("spring", 0.1, {("y", "y"): 1e5, ("z", "z"): 1e5}), 2),
        (LinearSupport("clamp", 0.1, {}, rigid=("y", "z", "thy", "thz")), 0),
        (LinearSupport("axial", 0.1, {("x", "x"): 1e5}), 4),
    ],
    ids=lambda each: getattr(each, "name", ""),
)
def test_supports_hold_what_they_touch(support: LinearSupport, free: int) -> None:
    """Of the four rigid motions of a shaft in bending."""
    shaft = uniform(0.6, 0.05, STEEL, supports=(support,))
    scene = Scene(shaft, Conditions(), np.array([0.0, 100.0]), 1000.0)
    counts = [
        free_directions(scene.linear(k), np.array([0, 1])) for k in scene.with_motions(("bending",))
    ]
    assert np.sum(counts, axis=0).tolist() == [free, free]
