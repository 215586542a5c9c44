"""The memo of stages: values by what they follow from."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

from rotordyn.scene.stage import Memo, _hash
from tests.oracles.spindles import mfw2310


@dataclass(frozen=True)
class Counted:
    """Counts how often it is compared."""

    value: int
    seen: list[int]

    def __eq__(self, other: object) -> bool:
        self.seen[0] += 1
        return isinstance(other, Counted) and self.value == other.value

    def __hash__(self) -> int:
        return self.value


def test_a_value_is_found_among_many_without_comparing_it_to_them() -> None:
    memo, seen = Memo(), [0]
    for k in range(200):
        memo.keep("stage", (Counted(k, seen), 1.0), k)
    assert memo.known("stage", (Counted(77, seen), 1.0)) == (77,)
    assert memo.known("stage", (Counted(77, seen), 2.0)) is None
    assert memo.known("other", (Counted(77, seen), 1.0)) is None
    assert seen[0] == 1


def test_equal_machines_have_one_number_and_variants_another() -> None:
    """Spindles hold mappings, which have no hash."""
    machine = mfw2310()
    sleeve = machine.sleeves[0]
    other = replace(machine, sleeves=(replace(sleeve, friction=9.0), *machine.sleeves[1:]))
    assert _hash((machine, 1.0)) == _hash((replace(machine), 1.0))
    assert _hash((machine, 1.0)) != _hash((other, 1.0))
    held: Any = MappingProxyType({"a": 1, "b": (2.0, 3.0)})
    assert _hash((held, 2)) == _hash((MappingProxyType({"b": (2.0, 3.0), "a": 1}), 2))
    assert _hash((held, 2)) != _hash((MappingProxyType({"a": 3, "b": (2.0, 3.0)}), 2))


def test_inputs_of_one_number_are_distinguished() -> None:
    memo = Memo()
    memo.keep("stage", ([1],), "one")
    memo.keep("stage", ([2],), "two")
    memo.keep("stage", ([3],), "three")
    assert memo.known("stage", ([2],)) == ("two",)
    memo.forget(1)
    assert memo.known("stage", ([2],)) is None
    assert memo.known("stage", ([3],)) == ("three",)


def test_the_first_and_the_latest_values_are_kept() -> None:
    memo = Memo()
    for k in range(6):
        memo.keep("stage", (k,), k)
    memo.forget(2)
    assert [memo.known("stage", (k,)) for k in range(6)] == [(0,), None, None, None, (4,), (5,)]
