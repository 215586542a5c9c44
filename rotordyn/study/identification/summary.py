"""An identification in one screen of plain text."""

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
MOST_WRITTEN = 14  # unknowns of which figures and pages write every correlation


def summary(found: Identification) -> str:
    """Values with their intervals, predictions, models by evidence, the verdict."""
    return "\n".join(_lines(found))


def _lines(found: Identification) -> Iterator[str]:
    best = found.explained
    yield found.title or found.name
    points = best.problem.count
    solved = sum(each.evaluations for model in found.models for each in model.searches)
    solved += sum(each.evaluations for each in found.profiles.values())
    of = f", {best.name}" if len(found.models) > 1 else ""
    counts = (points, "point"), (len(best.problem.unknowns), "unknown"), (solved, "machine")
    many = ", ".join(f"{count} {one}{'s' * (count != 1)}" for count, one in counts)
    yield f"{many} solved{of}"
    if found.stopped:
        yield "stopped before the end: the best so far"
    yield from without(found.left_out)
    yield ""
    yield from _table([*_values(found)])
    if found.predictions:
        yield ""
        yield from _predictions(found)
    yield ""
    yield from _table([("measurement", "points", "mean difference", "noise"), *_differences(best)])
    for beside in best.beside:
        yield ""
        yield from _table([beside.head, *beside.rows[:MOST_ROWS]])
        if len(beside.rows) > MOST_ROWS:
            yield f"… and {len(beside.rows) - MOST_ROWS} more: {beside.name}.csv"
    if len(found.models) > 1:
        yield ""
        yield from _table(
            [("model", "BIC above", f"mean [{found.criterion.unit}]", ""), *_models(found)]
        )
    for name, why in found.failed.items():
        yield from wrapped(f"no machine: {name}: {why}")
    yield ""
    for sentence in found.verdict:
        yield from wrapped(sentence)


def _predictions(found: Identification) -> Iterator[str]:
    """Numbers of the best model, and their range over all that survive."""
    several = any(each.least is not None for each in found.predictions)
    beside = any(each.measured is not None for each in found.predictions)
    over = ("over surviving models",) if several else ()
    rows: list[tuple[str, ...]] = [("predicted", "value", "95 %", *over, "measured" * beside)]
    for each in found.predictions:
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
    for each in found.predictions:
        if each.lacking and not np.isnan(each.value):
            yield from wrapped(f"no {each.name} of {'; '.join(each.lacking)}, which survive too")


def _profiled(found: Identification, unknown: Sought, digits: int) -> str:
    """The interval by profile; ``bound`` before an end that is one."""
    profile = found.profiles.get(unknown.path)
    if profile is None:
        return ""
    shown = [unknown.shown(end) for end in profile.interval]
    words = [
        f"{AT_BOUND if why == AT_BOUND else ''} {sized(end, digits, *shown)}".strip()
        for end, why in zip(shown, profile.why, strict=True)
    ]
    return " to ".join(words)


def _values(found: Identification) -> Iterator[tuple[str, ...]]:
    model, sure = found.explained, found.explained.sure
    yield "", "value", "95 %", *(("by profile",) if found.profiles else ()), ""
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
        profile = (_profiled(found, unknown, digits),) if found.profiles else ()
        yield unknown.heading, shown, between, *profile, word


def decimals(low: float, high: float, value: float) -> int:
    """With which half of an interval has two digits; where there is none, a value four."""
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


def _models(found: Identification) -> Iterator[tuple[str, ...]]:
    rows = list(zip(found.models, found.evidence, strict=True))
    for model, above in rows[:MOST_MODELS]:
        mean = found.criterion.mean_difference(model.problem, model.residuals)
        bound = model.on_bounds
        words = f"{ON_A_BOUND}: {', '.join(bound)}" if bound else ""
        yield model.name, f"{above:.1f}", f"{mean:.3g}", words
    if len(rows) > MOST_MODELS:
        yield f"… and {len(rows) - MOST_MODELS} more: models.csv", "", "", ""


def _table(rows: Sequence[tuple[str, ...]]) -> Iterator[str]:
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    for row in rows:
        yield "  ".join(cell.ljust(w) for cell, w in zip(row, widths, strict=True)).rstrip()
