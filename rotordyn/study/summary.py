"""A study in one screen of plain text, and as a table with a row for every point."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from rotordyn.report.tables import Column, write_table
from rotordyn.results.display import number
from rotordyn.results.text import aligned, wrapped
from rotordyn.study.design import Design
from rotordyn.study.parameter import Parameter
from rotordyn.study.point import Outcome, Study

SUMMARY, TABLE = "summary.txt", "points.csv"
MOST_SENTENCES = 4
NUMBER = re.compile(r"\d[\d.]*")
STEADY = 1e-9  # relative range of a number that nothing changes
Outcomes = Mapping[int, Outcome]


def summary(study: Study, outcomes: Outcomes) -> str:
    """What was varied, how many points have a solution, and the range of every number."""
    design, case = study.design, study.case
    solved = [row for row in outcomes.values() if row.solved]
    shape = " × ".join(map(str, design.shape))
    many = f"{shape} = {design.count}" if len(design.shape) > 1 else shape
    lines = [f"{case.title or case.name}: {many} points, {len(solved)} with a solution"]
    lines += [part for each in design.parameters for part in wrapped(f"varied     {_values(each)}")]
    lines += without(study.left_out)
    lines += [part for line in _unsolved(outcomes) for part in wrapped(line)]
    lines += [part for line in _warnings(outcomes) for part in wrapped(line)]
    lines += [part for line in _errors(outcomes) for part in wrapped(line)]
    rows = [*_ranges(design, outcomes)]
    if rows:
        head = ("", "lowest", "highest", "lowest at", "highest at", "")
        lines += ["", *aligned([head, *rows])]
    return "\n".join(lines)


def without(left_out: Sequence[str]) -> list[str]:
    """Lines that say of which variants of its case a study takes no notice."""
    if not left_out:
        return []
    names = ", ".join(left_out)
    return wrapped(f"note       the case itself is solved, without its variants {names}")


def _values(each: Parameter) -> str:
    if each.ends is not None:
        low, high = (each.displayed(end) for end in each.ends)
        count = f", {len(each.values)} values" if each.values else ""
        return f"{each.heading}: {low:g} to {high:g}{count}"
    shown = [f"{v:g}" if isinstance(v, float) else str(v) for v in map(each.displayed, each.labels)]
    return f"{each.heading}: {', '.join(shown[:12])}{', …' * (len(shown) > 12)}"


def _unsolved(outcomes: Outcomes) -> Iterator[str]:
    yield from reasons((row.sentence for row in outcomes.values()), "point", TABLE)


def reasons(sentences: Iterable[str], one: str, table: str) -> Iterator[str]:
    """Why points (``one`` of them so called) are not solved, the most frequent reasons first."""
    said = Counter(filter(None, sentences))
    for sentence, times in said.most_common(MOST_SENTENCES):
        yield f"not solved ({times} {one}{'s' * (times > 1)}): {sentence}"
    if len(said) > MOST_SENTENCES:
        yield f"not solved: {len(said) - MOST_SENTENCES} more reasons, listed in {table}"


def _warnings(outcomes: Outcomes) -> Iterator[str]:
    """The most frequent ones."""
    found = alike(row.warnings for row in outcomes.values())
    for points, sentence in found[:MOST_SENTENCES]:
        yield f"WARNING ({points}): {sentence}"
    if len(found) > MOST_SENTENCES:
        yield f"WARNING: {len(found) - MOST_SENTENCES} more kinds, listed in {TABLE}"


def alike(said: Iterable[Iterable[str]]) -> list[tuple[str, str]]:
    """Of what is ``said`` of every point, sentences that differ by numbers alone taken together:
    how many points have such, and the first of them, the most frequent kind first.

    >>> alike([["1 N is low", "2 N is low"], ["1 N is low"], []])
    [('2 points, such as', '1 N is low')]
    """
    kinds: dict[str, list[tuple[int, str]]] = {}
    for point, sentences in enumerate(said):
        for sentence in sentences:
            kinds.setdefault(NUMBER.sub("", sentence), []).append((point, sentence))
    found = []
    for each in kinds.values():
        points, words = len({point for point, _ in each}), {sentence for _, sentence in each}
        such = ", such as" if len(words) > 1 else ""
        found.append((points, f"{points} point{'s' * (points > 1)}{such}", each[0][1]))
    found.sort(key=lambda each: -each[0])
    return [(counted, first) for _, counted, first in found]


def _errors(outcomes: Outcomes) -> Iterator[str]:
    """What finer models showed where they were asked."""
    found = [row.error for row in outcomes.values() if row.error]
    if found:
        points = "point" if len(found) == 1 else "points"
        share = "more than" if max(found) > 1.0 else f"at most {100.0 * max(found):.0f} % of"
        yield f"accuracy   errors by refinement, at {len(found)} {points}: {share} what it allows"


def names(outcomes: Outcomes) -> dict[str, str]:
    """Every number and its unit, in order."""
    return {name: unit for k in sorted(outcomes) for name, (_, unit) in outcomes[k].numbers.items()}


def lacking(name: str, outcomes: Outcomes) -> str:
    """At how many of the solved points there is no such number; empty where all have it."""
    solved = [row.numbers.get(name, (math.nan,))[0] for row in outcomes.values() if row.solved]
    none = sum(map(math.isnan, solved))
    return f"none at {none} of {len(solved)}" if none else ""


def _ranges(design: Design, outcomes: Outcomes) -> Iterator[tuple[str, ...]]:
    """Of every number its ends, and at which point they are; constant ones without a place; how
    many points have none."""
    for name, unit in names(outcomes).items():
        rows = {k: row.numbers.get(name, (math.nan,))[0] for k, row in outcomes.items()}
        known = {k: value for k, value in rows.items() if not math.isnan(value)}
        if not known:
            continue
        low, high = min(known, key=known.__getitem__), max(known, key=known.__getitem__)
        ends = known[low], known[high]
        head = f"{name} [{unit}]" if unit else name
        finite = [abs(end) for end in ends if math.isfinite(end)]
        digits = max(0, 3 - math.floor(math.log10(max(*finite[-1:], 1e-6, 1e-6))))
        steady = ends[0] == ends[1]
        if len(finite) > 1:
            steady = ends[1] - ends[0] <= STEADY * max(finite)
        where = ("", "") if steady else (_where(design, low), _where(design, high))
        told = ("unbounded" if math.isinf(end) else number(end, min(digits, 6)) for end in ends)
        yield (head, *told, *where, lacking(name, outcomes))


def _where(design: Design, point: int) -> str:
    labels = design.labels(point)
    shown = (each.displayed(labels[each.path]) for each in design.parameters)
    return ", ".join(f"{v:.4g}" if isinstance(v, float) else str(v) for v in shown)


def write_points(folder: Path, study: Study, outcomes: Outcomes) -> None:
    """``points.csv``: what was varied, every number, why there is none, warnings."""
    design, numbers = study.design, names(outcomes)
    order = sorted(outcomes)
    labels = [design.labels(k) for k in order]
    columns: list[Column] = [("point", order)]
    for each in design.parameters:
        columns.append((each.heading, [each.displayed(own[each.path]) for own in labels]))
    for name, unit in numbers.items():
        values = [outcomes[k].numbers.get(name, (math.nan,))[0] for k in order]
        head = f"{name} [{unit}]" if unit else name
        columns.append((head, ["" if math.isnan(v) else f"{v:.9g}" for v in values]))
    columns.append(("not solved", [outcomes[k].sentence for k in order]))
    columns.append(("warnings", [" | ".join(outcomes[k].warnings) for k in order]))
    write_table(folder / TABLE, columns)
