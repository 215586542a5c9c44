"""What files of studies and optima hold: a case, what is varied in it, and what is sought (SI)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any

from rotordyn.quantity import Choice, Items, Key, Name, Whole

SAMPLED = ("latin-hypercube", "sobol")
SAMPLINGS = ("grid", "list", *SAMPLED)
SPACINGS = ("linear", "ratio")
MOST_POINTS = 10**15  # of one span, whose values are told apart by 15 digits
MOST_DRAWN = 10_000_000  # points of a sample, which is drawn whole; results that are kept as files
MOST_TRIALS = 100_000
ABSENT = ("violates", "satisfies")
BOUNDS = {"at_least", "at_most", "outside"}


@dataclass(frozen=True, slots=True)
class SpanEntry:
    """Numbers from one end to the other, instead of a list of values."""

    start: Annotated[Any, Key("from"), "lowest value, with its unit"]
    to: Annotated[Any, "highest value"]
    points: Annotated[
        Annotated[int, Whole(2, MOST_POINTS)] | None,
        "number of points, ends included; not for a sample",
    ] = None
    spacing: Annotated[
        str, Choice(SPACINGS), "equal steps (`linear`) or equal ratios (`ratio`)"
    ] = SPACINGS[0]


@dataclass(frozen=True, slots=True)
class StudyFile:
    """A study: one case solved at many points of its varied values."""

    title: Annotated[str, Key(default=""), "one line, shown in summary and figures"]
    case: Annotated[str, "path of a case file, or the name of a case that comes with rotordyn"]
    vary: Annotated[
        Mapping[str, Any],
        "dotted path, as in `override`, to a list of values or a span (from, to, points, spacing)",
    ]
    sampling: Annotated[
        str, Choice(SAMPLINGS), "every combination, values in step, or a sample of so many points"
    ] = SAMPLINGS[0]
    samples: Annotated[
        Annotated[int, Whole(1, MOST_DRAWN)] | None, "points of a sample; of sobol a power of two"
    ] = None
    seed: Annotated[int, Whole(0, 2**31 - 1), "random seed of a sample"] = 0
    analyses: Annotated[
        tuple[Name, ...], Items(0), "analyses of the case that are solved; by default all"
    ] = ()
    results: Annotated[
        tuple[Name, ...],
        Items(0),
        "analyses whose complete results are kept, not only their numbers",
    ] = ()


@dataclass(frozen=True, slots=True)
class GoalEntry:
    """What is to be as high or as low as possible, at its worst: give one of the two."""

    highest: Annotated[
        str | None,
        "numbers to maximise: `analysis: words`, headline numbers that begin so, or "
        "`analysis.variable` of a dataset",
    ] = None
    lowest: Annotated[str | None, "numbers to minimise, given likewise"] = None
    where: Annotated[
        Mapping[str, Any],
        "selection from a variable: coordinate to a word (`*` any letters), a number, "
        "or [from, to]",
    ] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class LimitEntry:
    """What the best machine keeps; one bound or more."""

    of: Annotated[str, "numbers, as in a goal"]
    where: Annotated[Mapping[str, Any], "selection, as in a goal"] = field(default_factory=dict)
    at_least: Annotated[Any, "lowest value, with its unit"] = None
    at_most: Annotated[Any, "highest value, with its unit"] = None
    outside: Annotated[Any, "[from, to]: no value between these"] = None
    absent: Annotated[
        str, Choice(ABSENT), "whether a missing number, such as `none`, satisfies the limit"
    ] = ABSENT[0]


@dataclass(frozen=True, slots=True)
class OptimumFile:
    """An optimum: the best design of one case within given choices and limits."""

    title: Annotated[str, Key(default=""), "one line, shown in summary and figures"]
    case: Annotated[str, "path of a case file, or the name of a case that comes with rotordyn"]
    vary: Annotated[Mapping[str, Any], "dotted path to a list of choices, or to a span (from, to)"]
    goals: Annotated[tuple[GoalEntry, ...], Items(), "one, or two whose trade-off is computed"]
    limits: Annotated[
        tuple[LimitEntry, ...], Items(0), "limits that the best machine satisfies"
    ] = ()
    trials: Annotated[int, Whole(1, MOST_TRIALS), "largest number of machines to solve"] = 300
    seed: Annotated[int, Whole(0, 2**31 - 1), "random seed of the search"] = 0
