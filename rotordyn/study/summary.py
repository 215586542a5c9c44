"""Summary of a study in plain text, and its table with a row for every point."""

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
STEADY = 1e-9  # relative range up to which a number counts as constant
Outcomes = Mapping[int, Outcome]


def summary(study: Study, outcomes: Outcomes) -> str:
    """Summary text: parameters, number of points with a solution, and range of every number."""
    design, case = study.design, study.case
    solved = [row for row in outcomes.values() if row.solved]
    shape = " × ".join(map(str, design.shape))
    points = f"{shape} = {design.count}" if len(design.shape) > 1 else shape
    lines = [f"{case.title or case.name}: {points} points, {len(solved)} with a solution"]
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
    """Lines that name the variants of the case, which a study ignores."""
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
    """Yield the most frequent reasons why points (each called ``one``) are not solved."""
    counts = Counter(filter(None, sentences))
    for sentence, times in counts.most_common(MOST_SENTENCES):
        yield f"not solved ({times} {one}{'s' * (times > 1)}): {sentence}"
    if len(counts) > MOST_SENTENCES:
        yield f"not solved: {len(counts) - MOST_SENTENCES} more reasons, listed in {table}"


def _warnings(outcomes: Outcomes) -> Iterator[str]:
    """Yield the most frequent warnings."""
    kinds = alike(row.warnings for row in outcomes.values())
    for points, sentence in kinds[:MOST_SENTENCES]:
        yield f"WARNING ({points}): {sentence}"
    if len(kinds) > MOST_SENTENCES:
        yield f"WARNING: {len(kinds) - MOST_SENTENCES} more kinds, listed in {TABLE}"


def alike(said: Iterable[Iterable[str]]) -> list[tuple[str, str]]:
    """Group sentences that differ only in their numbers; ``said``: sentences of every point.

    Returns for each group how many points have one, and its first sentence; most frequent first.

    >>> alike([["1 N is low", "2 N is low"], ["1 N is low"], []])
    [('2 points, such as', '1 N is low')]
    """
    kinds: dict[str, list[tuple[int, str]]] = {}
    for point, sentences in enumerate(said):
        for sentence in sentences:
            kinds.setdefault(NUMBER.sub("", sentence), []).append((point, sentence))
    groups = []
    for group in kinds.values():
        points, distinct = len({point for point, _ in group}), {sentence for _, sentence in group}
        such = ", such as" if len(distinct) > 1 else ""
        groups.append((points, f"{points} point{'s' * (points > 1)}{such}", group[0][1]))
    groups.sort(key=lambda group: -group[0])
    return [(counted, first) for _, counted, first in groups]


def _errors(outcomes: Outcomes) -> Iterator[str]:
    """Yield a line on the errors estimated by finer models."""
    errors = [row.error for row in outcomes.values() if row.error]
    if errors:
        points = "point" if len(errors) == 1 else "points"
        part = "more than" if max(errors) > 1.0 else f"at most {100.0 * max(errors):.0f} % of"
        at = f"at {len(errors)} {points}"
        yield f"accuracy   errors by refinement, {at}: {part} the allowed error"


def names(outcomes: Outcomes) -> dict[str, str]:
    """Unit of every headline number by name, in the order of their first occurrence."""
    return {name: unit for k in sorted(outcomes) for name, (_, unit) in outcomes[k].numbers.items()}


def lacking(name: str, outcomes: Outcomes) -> str:
    """Note on how many solved points lack a number; empty if all have it."""
    values = [row.numbers.get(name, (math.nan,))[0] for row in outcomes.values() if row.solved]
    missing = sum(map(math.isnan, values))
    return f"none at {missing} of {len(values)}" if missing else ""


def _ranges(design: Design, outcomes: Outcomes) -> Iterator[tuple[str, ...]]:
    """Yield a row for every number: lowest and highest value, the points where they occur (none if
    constant), and a note on points that lack it."""
    for name, unit in names(outcomes).items():
        rows = {k: row.numbers.get(name, (math.nan,))[0] for k, row in outcomes.items()}
        known = {k: value for k, value in rows.items() if not math.isnan(value)}
        if not known:
            continue
        low, high = min(known, key=known.__getitem__), max(known, key=known.__getitem__)
        ends = known[low], known[high]
        heading = f"{name} [{unit}]" if unit else name
        finite = [abs(end) for end in ends if math.isfinite(end)]
        digits = max(0, 3 - math.floor(math.log10(max(*finite[-1:], 1e-6, 1e-6))))
        steady = ends[0] == ends[1]
        if len(finite) > 1:
            steady = ends[1] - ends[0] <= STEADY * max(finite)
        where = ("", "") if steady else (_where(design, low), _where(design, high))
        texts = ("unbounded" if math.isinf(end) else number(end, min(digits, 6)) for end in ends)
        yield (heading, *texts, *where, lacking(name, outcomes))


def _where(design: Design, point: int) -> str:
    labels = design.labels(point)
    shown = (each.displayed(labels[each.path]) for each in design.parameters)
    return ", ".join(f"{v:.4g}" if isinstance(v, float) else str(v) for v in shown)


def write_points(folder: Path, study: Study, outcomes: Outcomes) -> None:
    """Write ``points.csv``: parameters, every number, why a point has none, warnings."""
    design, numbers = study.design, names(outcomes)
    order = sorted(outcomes)
    labels = [design.labels(k) for k in order]
    columns: list[Column] = [("point", order)]
    for each in design.parameters:
        columns.append((each.heading, [each.displayed(row[each.path]) for row in labels]))
    for name, unit in numbers.items():
        values = [outcomes[k].numbers.get(name, (math.nan,))[0] for k in order]
        heading = f"{name} [{unit}]" if unit else name
        columns.append((heading, ["" if math.isnan(v) else f"{v:.9g}" for v in values]))
    columns.append(("not solved", [outcomes[k].sentence for k in order]))
    columns.append(("warnings", [" | ".join(outcomes[k].warnings) for k in order]))
    write_table(folder / TABLE, columns)
