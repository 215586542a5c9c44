"""How grave a warning is, which decides its place: what a screen omits is the least grave.

A warning has its gravity where it is made; one without counts as a doubt. Among equals the order is
that in which they are made.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from enum import IntEnum
from functools import wraps
from typing import ParamSpec

P = ParamSpec("P")


class Gravity(IntEnum):
    """Why a designer has to read a warning, the gravest first."""

    NO_STATE = 0  # unstable, or without a solution
    INVALID = 1  # results are unbounded, not valid, or less accurate than asked for
    LOAD = 2  # a contact, ring or fit fails, or a bearing unloads or slips
    DOUBT = 3  # implausible, assumed or not given


class Graded(str):
    """A warning with its gravity."""

    gravity = Gravity.DOUBT


def graded(gravity: Gravity, sentence: str) -> str:
    """The sentence with its gravity."""
    warning = Graded(sentence)
    warning.gravity = gravity
    return warning


def gravity_of(sentence: str) -> Gravity:
    """Gravity of a warning; that of a doubt where none is stated."""
    return sentence.gravity if isinstance(sentence, Graded) else Gravity.DOUBT


def of_gravity(
    gravity: Gravity,
) -> Callable[[Callable[P, Iterable[str]]], Callable[P, list[str]]]:
    """Decorator of functions all of whose warnings are of one gravity."""

    def decorated(warnings: Callable[P, Iterable[str]]) -> Callable[P, list[str]]:
        @wraps(warnings)
        def made(*args: P.args, **kwargs: P.kwargs) -> list[str]:
            return [graded(gravity, sentence) for sentence in warnings(*args, **kwargs)]

        return made

    return decorated


def gravest_first(sentences: Iterable[str]) -> tuple[str, ...]:
    """Warnings in the order of their gravity.

    >>> gravest_first(["light preload", graded(Gravity.NO_STATE, "unstable")])
    ('unstable', 'light preload')
    """
    return tuple(sorted(sentences, key=gravity_of))
