"""Intervals of a run in text and tables."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from rotordyn.arrays import Array
from rotordyn.figures.legends import shortened
from rotordyn.report.datasets import restored_as
from rotordyn.report.netcdf import read_results, write_results
from rotordyn.report.tables import Column, number_cells, write_table
from rotordyn.results.display import number, rounded_up
from rotordyn.results.headline import NONE as ABSENT
from rotordyn.results.interval import NARROW, Interval
from rotordyn.results.text import aligned, wrapped

FILE, NAME = "interval.nc", "interval"
MOST = 12  # numbers in the summary
LONGEST, LONGEST_SOURCE = 44, 17  # of their names, and of those of sources
FAR = 0.02  # of the range: tolerances interact, ranges may be wrong by more than 5 %
ROUGH = 0.2  # of the range: a larger interaction makes it doubtful
NONE, DOUBTFUL = "*", "~"  # marks of ranges
UNKNOWN = "a bearing unloaded, no critical speed up to the top speed"
AT = re.compile(r"( at \d+) rpm$")
HEAD = ("speeds in rpm", "nominal", "hypotheses", "tolerances", "ruled by")


def interval_lines(interval: Interval, part: str = "") -> list[str]:
    """Ranges of the numbers that vary most, and what rules them."""
    of = f"of {part} " if part else ""
    lines = wrapped(
        f"interval   {of}over {interval_over(interval)}; machines solved: {interval.runs}"
    )
    rows = interval_ranges(interval)
    if len(rows) > 1:
        lines += aligned(rows)
    if rest := len(interval.number) - len(rows) + 1:
        lines.append(f"… and {rest} more number{'s' * (rest > 1)}: interval.csv")
    lines += [part for sentence in interval_doubts(interval) for part in wrapped(sentence)]
    return lines


def interval_over(interval: Interval) -> str:
    """Hypotheses and tolerances over which the machine is solved, in words."""
    combinations, sources = len(interval.combination), len(interval.source)
    parts = [f"{combinations} combinations of hypotheses"] if combinations > 1 else []
    if sources:
        parts.append(f"{sources} tolerances (95 % of the machines within them)")
    return " and ".join(parts) or "nothing"


def interval_ranges(interval: Interval) -> list[tuple[str, ...]]:
    """Ranges of the numbers that vary most, in their order, below a row of headings."""
    return [HEAD, *(_row(interval, k) for k in _shown(interval))]


def _shown(interval: Interval) -> list[int]:
    return sorted(interval.apart(interval.varying())[:MOST])


def _row(interval: Interval, k: int) -> tuple[str, ...]:
    size = float(
        np.nanmax(np.abs([interval.nominal[k], *interval.tolerances[k], *interval.hypotheses[k]]))
    )
    digits = 0 if size >= 1000.0 else 1 if size >= 10.0 else 3
    ranges = [
        "..".join(number(float(end), digits) for end in ends[k])
        if np.ptp(ends[k]) > NARROW * size
        else "–"
        for ends in (interval.hypotheses, interval.tolerances)
    ]
    for place, without in enumerate((interval.without[k], interval.without_within[k])):
        ranges[place] += NONE if without else ""
    ranges[1] += DOUBTFUL if interval.interaction[k] > ROUGH else ""
    rule = interval.ruling(k)
    ruled = f"{_source(rule[0][0])} {rule[0][1]:.0%}" if rule else ""
    nominal = f"{number(float(interval.nominal[k]), digits)} {interval.unit[k]}".rstrip()
    return shortened(AT.sub(r"\1", interval.number[k]), LONGEST), nominal, *ranges, ruled


def _source(path: str) -> str:
    """Short name of a source: the end of its path."""
    plain = ("*", "model", "spindle", "conditions", "bearings", "sleeves", "spring")
    last = ".".join([step for step in path.split(".") if step not in plain][-2:])
    return last if len(last) <= LONGEST_SOURCE else last.rpartition(".")[2]


def interval_doubts(interval: Interval) -> Iterator[str]:
    """Sentences on what these ranges do not include, each after a leading word."""
    lacking = np.flatnonzero(interval.without + interval.without_within)
    reasons = dict.fromkeys(interval.absent[k] for k in lacking)
    unmet = ", ".join(UNKNOWN if word == ABSENT else word for word in reasons)
    if np.isin(lacking, _shown(interval)).any():
        yield (
            f"{NONE}          some of these machines have no such number: {unmet}; ranges over "
            "tolerances end where one that was solved has it"
        )
    elif lacking.size:
        more = f" and {lacking.size - 1} more of the numbers in interval.csv"
        name = f"{interval.number[lacking[0]]}{more if lacking.size > 1 else ''}"
        yield f"note       some of these machines have no {name}: {unmet}"
    errors = interval.numerical_error[np.isfinite(interval.numerical_error)]
    if errors.size:
        largest = rounded_up(float(errors.max()))
        yield f"numerical  error, within {largest} of these numbers, not included"
    far = np.flatnonzero(np.nan_to_num(interval.interaction) > FAR)
    if far.size:
        worst = max(far, key=lambda k: interval.interaction[k])
        marked = (interval.interaction[_shown(interval)] > ROUGH).any()
        yield (
            f"{DOUBTFUL if marked else 'note':10} tolerances interact: with all of them applied "
            "together, "
            f"{interval.number[worst]} is {interval.interaction[worst]:.0%} of its range from the "
            "sum of their effects; samples give the exact range"
        )
    if interval.narrowed:
        yield f"note       {interval.narrowed}"
    if interval.lost:
        yield f"note       omitted, without a solution: {shortened(interval.lost, 300)}"


def write_interval(folder: Path, interval: Interval) -> None:
    """Write the tables ``interval.csv``, ``interval_effects.csv``, ``interval_hypotheses.csv``,
    ``interval_curves.csv`` and ``sensitivities.csv``, if they have rows."""
    names: list[Column] = [("number", list(interval.number)), ("unit", list(interval.unit))]
    write_table(folder / "interval.csv", names + _numbers(interval))
    if interval.source:
        effects = _pairs(interval, "uncertain number", interval.source)
        effects.append(("tolerance", [*interval.tolerance] * len(interval.number)))
        effects += _by_end(interval, "change at", interval.effect.reshape(-1, len(interval.end)))
        write_table(folder / "interval_effects.csv", effects)
    if len(interval.combination) > 1:
        values = zip(
            interval.combination, map(number_cells, interval.by_combination.T), strict=True
        )
        write_table(folder / "interval_hypotheses.csv", [*names, *values])
    if interval.curve:
        write_table(folder / "interval_curves.csv", _curves(interval))
    if interval.path:
        write_table(folder / "sensitivities.csv", _sensitivities(interval))


def _numbers(interval: Interval) -> list[Column]:
    rules = [interval.ruling(k)[:1] for k in range(len(interval.number))]
    return [
        ("nominal", number_cells(interval.nominal)),
        *_by_end(interval, "hypotheses,", interval.hypotheses),
        *_by_end(interval, "95 % of tolerances,", interval.tolerances),
        *_by_end(interval, "worst case of tolerances,", interval.worst),
        ("ruled by", [rule[0][0] if rule else "" for rule in rules]),
        ("its share", [f"{rule[0][1]:.3g}" if rule else "" for rule in rules]),
        ("not the sum of effects, over the range", number_cells(interval.interaction)),
        ("numerical error", number_cells(interval.numerical_error)),
    ]


def _curves(interval: Interval) -> list[Column]:
    return [
        ("curve", [interval.curve[k] for k in interval.curve_of]),
        ("abscissa", number_cells(interval.x)),
        ("nominal", number_cells(interval.curve_nominal)),
        *_by_end(interval, "hypotheses,", interval.curve_hypotheses),
        *_by_end(interval, "95 % of tolerances,", interval.curve_tolerances),
    ]


def _sensitivities(interval: Interval) -> list[Column]:
    return [
        *_pairs(interval, "by", interval.path),
        ("derivative, by SI unit", number_cells(interval.derivative.ravel())),
        ("relative derivative", number_cells(interval.elasticity.ravel())),
        ("change over the range", number_cells(interval.range_effect.ravel())),
    ]


def _pairs(interval: Interval, head: str, entries: Sequence[str]) -> list[Column]:
    """Columns with a row for every number and each of ``entries``, which are under ``head``."""
    return [
        ("number", [name for name in interval.number for _ in entries]),
        ("unit", [unit for unit in interval.unit for _ in entries]),
        (head, [*entries] * len(interval.number)),
    ]


def _by_end(interval: Interval, words: str, values: Array) -> list[Column]:
    """A column for each end of a range, of ``values`` (rows, ends)."""
    ends = zip(interval.end, values.T, strict=True)
    return [(f"{words} {end}", number_cells(column)) for end, column in ends]


def keep(folder: Path, intervals: Mapping[str, Interval]) -> None:
    """Write all intervals of a run, by part, to one file."""
    by_group = {
        f"{part}/{NAME}" if part else NAME: interval for part, interval in intervals.items()
    }
    write_results(folder / FILE, by_group)


def kept(folder: Path) -> dict[str, Interval]:
    """The intervals in a results folder by part; none where it has none."""
    if not (folder / FILE).exists():
        return {}
    groups = read_results(folder / FILE)
    return {name.rpartition("/")[0]: restored_as(Interval, groups[name]) for name in groups}
