"""Summary of an identification in plain text."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from rotordyn.results.display import sized
from rotordyn.results.text import wrapped
from rotordyn.study.identification.certainty import ON_A_BOUND, UNFINISHED
from rotordyn.study.identification.profile import AT_BOUND
from rotordyn.study.identification.unknown import Sought
from rotordyn.study.summary import without

if TYPE_CHECKING:
    from rotordyn.study.identification.identification import Explained, Identification

MOST_MODELS, MOST_ROWS = 12, 20
MOST_WRITTEN = 14  # largest number of unknowns whose correlations are printed as numbers


def summary(result: Identification) -> str:
    """Summary text: values with intervals, predictions, models by evidence, verdict."""
    return "\n".join(_lines(result))


def _lines(result: Identification) -> Iterator[str]:
    best = result.explained
    yield result.title or result.name
    points = best.problem.count
    solved = sum(each.evaluations for model in result.models for each in model.searches)
    solved += sum(each.evaluations for each in result.profiles.values())
    of = f", {best.name}" if len(result.models) > 1 else ""
    counts = (points, "point"), (len(best.problem.unknowns), "unknown"), (solved, "machine")
    counted = ", ".join(f"{count} {one}{'s' * (count != 1)}" for count, one in counts)
    yield f"{counted} solved{of}"
    if result.stopped:
        yield "stopped before the end: the best so far"
    yield from without(result.left_out)
    yield ""
    yield from _table([*_values(result)])
    if result.predictions:
        yield ""
        yield from _predictions(result)
    yield ""
    yield from _table([("measurement", "points", "mean difference", "noise"), *_differences(best)])
    for beside in best.beside:
        yield ""
        yield from _table([beside.head, *beside.rows[:MOST_ROWS]])
        if len(beside.rows) > MOST_ROWS:
            yield f"… and {len(beside.rows) - MOST_ROWS} more: {beside.name}.csv"
    if len(result.models) > 1:
        yield ""
        yield from _table(
            [("model", "BIC above", f"mean [{result.criterion.unit}]", ""), *_models(result)]
        )
    for name, reason in result.failed.items():
        yield from wrapped(f"no machine: {name}: {reason}")
    yield ""
    for sentence in result.verdict:
        yield from wrapped(sentence)


def _predictions(result: Identification) -> Iterator[str]:
    """Yield the table of predictions, with their range over surviving models."""
    several = any(each.least is not None for each in result.predictions)
    beside = any(each.measured is not None for each in result.predictions)
    over = ("over surviving models",) if several else ()
    rows: list[tuple[str, ...]] = [("predicted", "value", "95 %", *over, "measured" * beside)]
    for each in result.predictions:
        measured = "" if each.measured is None else f"{each.measured:.4g}"
        sizes = each.low, each.high, each.value
        digits = decimals(*sizes)
        value, low, high, least, most = (
            "" if v is None else sized(v, digits, *sizes)
            for v in (each.value, each.low, each.high, each.least, each.most)
        )
        heading = f"{each.name} [{each.unit}]" if each.unit else each.name
        between = (f"{least} to {most}",) if several else ()
        ends = "–" if np.isnan(each.low) else f"{low} to {high}"
        ends = f"–, {', '.join(each.bound)} {ON_A_BOUND}" if each.bound else ends
        rows.append((heading, value, ends, *between, measured))
    yield from _table(rows)
    for each in result.predictions:
        if each.lacking and not np.isnan(each.value):
            of = "; ".join(each.lacking)
            yield from wrapped(f"no {each.name} of {of}, which the data do not rule out either")


def _profiled(result: Identification, unknown: Sought, digits: int) -> str:
    """Text of the interval by profile; an end that is a bound is marked."""
    profile = result.profiles.get(unknown.path)
    if profile is None:
        return ""
    shown = [unknown.shown(end) for end in profile.interval]
    words = [
        f"{AT_BOUND if why == AT_BOUND else ''} {sized(end, digits, *shown)}".strip()
        for end, why in zip(shown, profile.why, strict=True)
    ]
    return " to ".join(words)


def _values(result: Identification) -> Iterator[tuple[str, ...]]:
    model, sure = result.explained, result.explained.sure
    yield "", "value", "95 %", *(("by profile",) if result.profiles else ()), ""
    for unknown, value, ends, word in zip(
        model.problem.unknowns,
        sure.values.tolist(),
        sure.interval.tolist(),
        sure.words,
        strict=True,
    ):
        sizes = [*map(unknown.shown, (*ends, value))]
        digits = decimals(*sizes)
        shown = sized(sizes[-1], digits, *sizes)
        between = (
            ""
            if word in (ON_A_BOUND, UNFINISHED)
            else " to ".join(
                f"{AT_BOUND if end == bound else ''} {sized(size, digits, *sizes)}".strip()
                for end, bound, size in zip(
                    ends, (unknown.low, unknown.high), sizes[:2], strict=True
                )
            )
        )
        profile = (_profiled(result, unknown, digits),) if result.profiles else ()
        yield unknown.heading, shown, between, *profile, word


def decimals(low: float, high: float, value: float) -> int:
    """Number of decimals that gives half of an interval two digits; without one, the value four."""
    half, size = abs(high - low) / 2.0, abs(value)
    known = 0.0 < half < np.inf
    if not known and not 0.0 < size < np.inf:
        return 0
    last = np.floor(np.log10(half)) - 1 if known else np.floor(np.log10(size)) - 3
    return int(np.clip(-last, 0, 6))


def _differences(model: Explained) -> Iterator[tuple[str, ...]]:
    for each, residual in zip(model.problem.measurements, model.residuals, strict=True):
        data = each.data
        mean = float(np.abs(residual).mean()) * data.factor
        noise = float(data.deviation.mean()) * data.factor
        yield data.name, str(len(residual)), f"{mean:.3g} {data.unit}", f"{noise:.3g} {data.unit}"


def _models(result: Identification) -> Iterator[tuple[str, ...]]:
    rows = list(zip(result.models, result.evidence, strict=True))
    for model, above in rows[:MOST_MODELS]:
        mean = result.criterion.mean_difference(model.problem, model.residuals)
        bound = model.on_bounds
        words = f"{ON_A_BOUND}: {', '.join(bound)}" if bound else ""
        yield model.name, f"{above:.1f}", f"{mean:.3g}", words
    if len(rows) > MOST_MODELS:
        yield f"… and {len(rows) - MOST_MODELS} more: models.csv", "", "", ""


def _table(rows: Sequence[tuple[str, ...]]) -> Iterator[str]:
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    for row in rows:
        yield "  ".join(cell.ljust(w) for cell, w in zip(row, widths, strict=True)).rstrip()
