"""What variants have in common is said once."""

from __future__ import annotations

from dataclasses import replace

import pytest

import rotordyn
from rotordyn.case.doubts import doubts
from rotordyn.machine.lumped import PointMass
from rotordyn.results.by_variant import by_variant


@pytest.mark.parametrize(
    ("count", "led"),
    [(1, "v0"), (3, "v0, v1, v2"), (4, "all 4 variants"), (100, "all 100 variants")],
)
def test_who_says_it(count: int, led: str) -> None:
    assert by_variant({f"v{k}": ["low"] for k in range(count)}) == (f"{led}: low",)


def test_some_of_many_and_each_sentence_once() -> None:
    said = {f"v{k}": ["low", "low"] if k else ["hot"] for k in range(101)}
    assert by_variant(said) == ("v0: hot", "v1, v2 and 98 more variants: low")
    assert by_variant({"": ["low", "low"]}) == ("low",)


def test_a_machine_that_variants_share_is_questioned_once() -> None:
    case = rotordyn.load("mfw2310")
    mass = PointMass("pulley", case.spindle.seats[0].x, 1.1, 7.0, 7.0)
    odd = replace(case, spindle=replace(case.spindle, masses=(mass,)))
    alone = [*doubts(odd)]
    assert alone
    both = replace(odd, variants={"a": odd, "b": odd})
    assert [*doubts(both)] == [f"a, b: {sentence}" for sentence in alone]
