"""Motions of a rigid shaft, and rigid supports against them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rotordyn.equation.restraint import (
    free_names,
    has_redundant_supports,
    rigid_motion,
    unrestrained_motions,
)
from rotordyn.machine.support import LinearSupport
from tests.oracles.rotors import STEPPED

HERE = (-0.05, 0.06, 0.24)


@pytest.mark.parametrize(
    ("held", "twice"),
    [
        ([("y",), ("y",)], False),  # a place and, by the second, a slope
        ([("y", "z"), ("y", "z"), ("x",)], False),
        ([("y",), ("y",), ("y",)], True),
        ([("y", "thz")], False),
        ([("y", "thz"), ("y",)], True),
        ([("thy",), ("thy",)], True),
        ([("x",), ("y",), ("x",)], True),
    ],
)
def test_a_rigid_shaft_is_held_once_in_each_motion(
    held: list[tuple[str, ...]], *, twice: bool
) -> None:
    supports = tuple(
        LinearSupport(f"s{k}", x, {}, rigid=ways)
        for k, (x, ways) in enumerate(zip(HERE, held, strict=False))
    )
    assert has_redundant_supports(replace(STEPPED, supports=supports)) == twice


def test_a_rigid_motion_is_a_turn_about_the_front() -> None:
    """u + θ × r at every station, and θ itself."""
    draw = np.random.default_rng(1)
    motion, x = draw.normal(size=6), np.array([-0.1, 0.2, 0.7])
    found = rigid_motion(x, 0.2) @ motion
    for place, moved in zip(x, found, strict=True):
        turned = np.cross(motion[3:], [place - 0.2, 0.0, 0.0])
        assert moved == pytest.approx([*(motion[:3] + turned), *motion[3:]], rel=1e-13, abs=1e-15)


@pytest.mark.parametrize(
    ("along", "free"),
    [(1e3, "thx"), (1.0, "thx"), (1e-15, "x, thx")],  # the last is meant as no spring
)
def test_a_soft_spring_holds_beside_a_stiff_one(along: float, free: str) -> None:
    """A guide along the axis beside 10¹³ N/m across it, which stand for rigid."""
    across = {("x", "x"): along, ("y", "y"): 1e13, ("z", "z"): 1e13}
    supports = tuple(LinearSupport(f"s{k}", x, across) for k, x in enumerate(HERE[:2]))
    assert free_names(unrestrained_motions(replace(STEPPED, supports=supports))) == free
