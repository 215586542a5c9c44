"""A share of the calls that make no sense; all of them: python -m tests.hostile --calls 100000."""

from __future__ import annotations

from tests.hostile.calls import of, sample


def test_calls_that_make_no_sense_are_answered_or_refused() -> None:
    assert [*of(sample(200, seed=1))] == []
