"""Warnings in the order of their gravity: what a screen omits is the least grave."""

from __future__ import annotations

from pathlib import Path

import rotordyn
from rotordyn.cli.screen import MOST_WARNINGS, on_screen
from rotordyn.results.by_variant import by_variant
from rotordyn.results.gravity import Gravity, graded, gravest_first, gravity_of
from rotordyn.results.text import opening


def test_an_unstable_machine_comes_before_a_doubtful_number() -> None:
    """Which is found first: a number is checked before anything is solved."""
    viscous = rotordyn.load("friswell_internal_damping").variants["viscous"]
    doubtful = viscous.vary({"speeds": (0.0, 300.0), "damping.rotor": (0.25,)})
    warnings = rotordyn.run(doubtful).warnings
    assert [warning.startswith("damping.rotor") for warning in warnings] == [False, False, True]
    assert "unstable at 1 of 2 speeds" in warnings[0]
    both = doubtful.vary({"variants": {"a": viscous.vary({"speeds": (0.0, 300.0)}), "b": doubtful}})
    first, *_, last = rotordyn.run(both).warnings
    assert first.startswith("a: unstable")
    assert last.startswith("b: damping.rotor")


def test_variants_keep_the_gravity_of_a_sentence() -> None:
    said = {"a": ["low", graded(Gravity.LOAD, "loose")], "b": [graded(Gravity.NO_STATE, "lost")]}
    ordered = gravest_first(by_variant(said))
    assert ordered == ("b: lost", "a: loose", "a: low")
    assert [gravity_of(sentence) for sentence in ordered] == [
        Gravity.NO_STATE,
        Gravity.LOAD,
        Gravity.DOUBT,
    ]


def test_a_screen_omits_the_least_grave() -> None:
    doubts = [f"doubt {k}" for k in range(MOST_WARNINGS)]
    warnings = gravest_first([*doubts, graded(Gravity.INVALID, "less accurate than asked for")])
    text = "\n".join(opening(warnings, "title", ()))
    shown = on_screen(text, Path("summary.txt"))
    assert "less accurate" in shown
    assert "doubt 0" in shown
    assert f"doubt {MOST_WARNINGS - 1}" not in shown
    assert "WARNING: 1 more in summary.txt" in shown
