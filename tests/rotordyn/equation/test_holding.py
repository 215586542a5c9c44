"""Rigid supports against the motions that a rigid shaft has."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rotordyn.equation.holding import holds_twice
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
    assert holds_twice(replace(STEPPED, supports=supports)) == twice
