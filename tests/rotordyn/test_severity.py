"""Warnings in the order of their severity: what a screen omits is the least severe."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace

import pytest

import rotordyn
from rotordyn.analyses.life import summary
from rotordyn.cli.screen import MOST_WARNINGS, on_screen
from rotordyn.results.by_variant import by_variant
from rotordyn.results.severity import Severity, graded, severest_first, severity_of
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


def test_variants_keep_the_severity_of_a_sentence() -> None:
    said = {"a": ["low", graded(Severity.LOAD, "loose")], "b": [graded(Severity.NO_STATE, "lost")]}
    ordered = severest_first(by_variant(said))
    assert ordered == ("b: lost", "a: loose", "a: low")
    assert [severity_of(sentence) for sentence in ordered] == [
        Severity.NO_STATE,
        Severity.LOAD,
        Severity.DOUBT,
    ]


def test_bearings_keep_the_severity_of_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    said = [graded(Severity.LOAD, "hot"), "thin film"]
    monkeypatch.setattr(summary, "_of_bearing", lambda result, k: said)
    ordered = severest_first(reversed(summary.warnings(SimpleNamespace(bearing=("a", "b")))))
    assert ordered == ("bearings a, b: hot", "bearings a, b: thin film")


def test_a_screen_omits_the_least_severe() -> None:
    doubts = [f"doubt {k}" for k in range(MOST_WARNINGS)]
    warnings = severest_first([*doubts, graded(Severity.INVALID, "less accurate than asked for")])
    text = "\n".join(opening(warnings, "title", ()))
    shown = on_screen(text, Path("summary.txt"))
    assert "less accurate" in shown
    assert "doubt 0" in shown
    assert f"doubt {MOST_WARNINGS - 1}" not in shown
    assert "WARNING: 1 more in summary.txt" in shown
