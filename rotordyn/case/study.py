"""What a study file holds: a case, what is varied in it, and which points are solved (SI)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any

from rotordyn.quantity import Choice, Items, Key, Name, Whole

SAMPLED = ("latin-hypercube", "sobol")
SAMPLINGS = ("grid", "list", *SAMPLED)
SPACINGS = ("linear", "ratio")
MOST_POINTS = 10_000_000


@dataclass(frozen=True, slots=True)
class SpanEntry:
    """Numbers from one end to the other, instead of a list of values."""

    start: Annotated[Any, Key("from"), "lowest value, with its unit"]
    to: Annotated[Any, "highest value"]
    points: Annotated[
        Annotated[int, Whole(2, MOST_POINTS)] | None,
        "how many, ends included; none of a sample",
    ] = None
    spacing: Annotated[str, Choice(SPACINGS), "by equal steps, or by equal ratios"] = SPACINGS[0]


@dataclass(frozen=True, slots=True)
class StudyFile:
    """A study: one case solved at many points of what is varied in it."""

    title: Annotated[str, Key(default=""), "one line, shown in summary and figures"]
    case: Annotated[str, "path of a case file, or the name of a case that comes with rotordyn"]
    vary: Annotated[
        Mapping[str, Any],
        "dotted path, as of `vary`, to a list of values or a span (from, to, points, spacing)",
    ]
    sampling: Annotated[
        str, Choice(SAMPLINGS), "every combination, values in step, or a sample of so many points"
    ] = SAMPLINGS[0]
    samples: Annotated[
        Annotated[int, Whole(1, MOST_POINTS)] | None, "points of a sample; of sobol a power of two"
    ] = None
    seed: Annotated[int, Whole(0, 2**31 - 1), "of a sample"] = 0
    analyses: Annotated[
        tuple[Name, ...], Items(0), "analyses of the case that are solved; by default all"
    ] = ()
    results: Annotated[
        tuple[Name, ...], Items(0), "analyses whose results are kept whole, not only their numbers"
    ] = ()
