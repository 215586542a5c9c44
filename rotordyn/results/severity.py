"""How severe a warning is, which decides its place: what a screen omits is the least severe.

A warning has its severity where it is made; one without counts as a doubt. Among equals the order
is that in which they are made.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from enum import IntEnum
from functools import wraps
from typing import ParamSpec

P = ParamSpec("P")


class Severity(IntEnum):
    """Why a designer has to read a warning, the most severe first."""

    NO_STATE = 0  # unstable, or without a solution
    INVALID = 1  # results are unbounded, not valid, or less accurate than asked for
    LOAD = 2  # a contact, ring or fit fails, or a bearing unloads or slips
    DOUBT = 3  # implausible, assumed or not given


class Graded(str):
    """A warning with its severity."""

    severity = Severity.DOUBT


def graded(severity: Severity, sentence: str) -> str:
    """Return a sentence with its severity; one put together from it has none."""
    warning = Graded(sentence)
    warning.severity = severity
    return warning


def severity_of(sentence: str) -> Severity:
    """Severity of a warning; that of a doubt where none is stated."""
    return sentence.severity if isinstance(sentence, Graded) else Severity.DOUBT


def of_severity(
    severity: Severity,
) -> Callable[[Callable[P, Iterable[str]]], Callable[P, list[str]]]:
    """Decorator of functions all of whose warnings are of one severity."""

    def decorated(warnings: Callable[P, Iterable[str]]) -> Callable[P, list[str]]:
        @wraps(warnings)
        def made(*args: P.args, **kwargs: P.kwargs) -> list[str]:
            return [graded(severity, sentence) for sentence in warnings(*args, **kwargs)]

        return made

    return decorated


def severest_first(sentences: Iterable[str]) -> tuple[str, ...]:
    """Warnings in the order of their severity.

    >>> severest_first(["light preload", graded(Severity.NO_STATE, "unstable")])
    ('unstable', 'light preload')
    """
    return tuple(sorted(sentences, key=severity_of))
