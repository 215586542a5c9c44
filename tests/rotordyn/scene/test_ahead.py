"""Preload states of machines to come, solved together before and left in their memo."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rotordyn.analyses import Lubrication
from rotordyn.machine.spindle import Spindle
from rotordyn.preload import together
from rotordyn.preload.together import dynamic_preload
from rotordyn.scene.ahead import solve_ahead
from rotordyn.scene.conditions import Conditions
from rotordyn.scene.heat_flow import SpindleHeatFlow
from rotordyn.scene.scene import Scene
from rotordyn.scene.stage import Memo
from tests.oracles.rotors import STEEL, support, uniform
from tests.oracles.spindles import RPM, conditions, mfw2310, with_sleeve

SPEED = np.array([0.0, 12000.0, 24000.0]) * RPM
FLOW = SpindleHeatFlow(3.0, 6.0, 30.0, 25.0, 30.0, lubricant=Lubrication(32e-6, 5.4e-6, 50.0))


def stopped(travel: float) -> Spindle:
    return with_sleeve(mfw2310(), "front", stop_travel=travel)


@pytest.fixture
def counted(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """How many machines were solved by each call."""
    calls: list[int] = []
    solve = together._solved

    def noted(machines: Any, joined: Any) -> Any:
        calls.append(len(machines))
        return solve(machines, joined)

    monkeypatch.setattr(together, "_solved", noted)
    return calls


def scenes(memo: Memo, *travels: float, **how: Any) -> list[Scene]:
    return [Scene(stopped(each), conditions(**how), SPEED, memo=memo) for each in travels]


def test_each_machine_takes_its_own_state(counted: list[int]) -> None:
    memo = Memo()
    machines = scenes(memo, 30e-6, 45e-6, 60e-6)
    solve_ahead(machines, memo)
    found = [machine.preload for machine in machines[::-1]][::-1]
    assert counted == [3]
    for machine, state in zip(machines, found, strict=True):
        alone = dynamic_preload(machine.grounded, SPEED, machine.law)
        assert state.seat_load() == pytest.approx(alone.seat_load(), rel=1e-10)
    assert len({state.seat_load()[2, 2] for state in found}) == 3


def test_another_machine_is_solved_alone(counted: list[int]) -> None:
    memo = Memo()
    solve_ahead(scenes(memo, 30e-6, 45e-6), memo)
    (other,) = scenes(memo, 31e-6)
    assert other.preload.usable.all()
    assert counted == [2, 1]


def test_equal_machines_are_solved_once_and_one_is_no_batch(counted: list[int]) -> None:
    memo = Memo()
    solve_ahead(scenes(memo, 30e-6, 30e-6, 45e-6), memo)
    assert counted == [2]
    solve_ahead(scenes(memo, 30e-6, 30e-6), memo)
    assert counted == [2]
    assert memo.ahead == []


def test_what_is_known_already_is_not_solved_again(counted: list[int]) -> None:
    memo = Memo()
    machines = scenes(memo, 30e-6, 45e-6, 60e-6)
    assert machines[0].preload.usable.all()
    solve_ahead(machines, memo)
    assert counted == [1, 2]


def test_states_that_follow_from_heat_are_not_solved_ahead(counted: list[int]) -> None:
    memo = Memo()
    solve_ahead(scenes(memo, 30e-6, 45e-6, heat_flow=FLOW), memo)
    assert counted == []


def test_where_one_cannot_be_solved_each_is_left_to_itself(
    counted: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    from rotordyn.errors import InvalidInput

    memo, refuse = Memo(), together.arrangement

    def arranged(spindle: Spindle, *how: Any) -> Any:
        if spindle.sleeves[0].stop_travel == 45e-6:
            raise InvalidInput("this one")
        return refuse(spindle, *how)

    monkeypatch.setattr(together, "arrangement", arranged)
    one, other = scenes(memo, 30e-6, 45e-6)
    solve_ahead([one, other], memo)
    assert memo.ahead == []
    assert one.preload.usable.all()
    with pytest.raises(InvalidInput, match="this one"):
        assert other.preload


def test_a_machine_without_bearings_is_passed_over() -> None:
    held = (support("a", 0.0, (5e7, 5e7)), support("b", 0.6, (5e7, 5e7)))
    memo = Memo()
    bare = [
        Scene(uniform(0.6, d, STEEL, supports=held), Conditions(), SPEED, memo=memo)
        for d in (0.05, 0.06)
    ]
    solve_ahead(bare, memo)
    assert memo.ahead == []
