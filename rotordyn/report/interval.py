"""How sure a run is, in text and tables."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from rotordyn.figures.legends import shortened
from rotordyn.report.datasets import restored_as
from rotordyn.report.netcdf import read_results, write_results
from rotordyn.report.tables import Column, number_cells, write_table
from rotordyn.results.display import number, rounded_up
from rotordyn.results.headline import NONE as ABSENT
from rotordyn.results.interval import NARROW, Interval
from rotordyn.results.kinds import Array
from rotordyn.results.text import aligned, wrapped

FILE, NAME = "interval.nc", "interval"
MOST = 12  # numbers in the summary
LONGEST, LONGEST_SOURCE = 44, 17  # of their names, and of those of sources
FAR = 0.02  # of the range: tolerances act on one another, ranges may be off by more than 5 %
ROUGH = 0.2  # of the range: one that says little
NONE, DOUBTFUL = "*", "~"  # marks of ranges
UNKNOWN = "a bearing unloaded, no critical speed up to the top speed"
AT = re.compile(r"( at \d+) rpm$")
HEAD = ("speeds in rpm", "nominal", "hypotheses", "tolerances", "ruled by")


def interval_lines(held: Interval, part: str = "") -> list[str]:
    """Ranges of the numbers that vary most, and what rules them."""
    of = f"of {part} " if part else ""
    lines = wrapped(f"interval   {of}over {interval_over(held)}; machines solved: {held.runs}")
    rows = interval_ranges(held)
    if len(rows) > 1:
        lines += aligned(rows)
    if rest := len(held.number) - len(rows) + 1:
        lines.append(f"… and {rest} more number{'s' * (rest > 1)}: interval.csv")
    lines += [part for sentence in interval_doubts(held) for part in wrapped(sentence)]
    return lines


def interval_over(held: Interval) -> str:
    """What the machine was solved over, in words."""
    combinations, sources = len(held.combination), len(held.source)
    words = [f"{combinations} combinations of hypotheses"] if combinations > 1 else []
    if sources:
        words.append(f"{sources} tolerances (95 % of the machines within them)")
    return " and ".join(words) or "nothing"


def interval_ranges(held: Interval) -> list[tuple[str, ...]]:
    """Ranges of the numbers that vary most, in their order, below a row of headings."""
    return [HEAD, *(_row(held, k) for k in _shown(held))]


def _shown(held: Interval) -> list[int]:
    return sorted(held.apart(held.varying())[:MOST])


def _row(held: Interval, k: int) -> tuple[str, ...]:
    size = float(np.nanmax(np.abs([held.nominal[k], *held.tolerances[k], *held.hypotheses[k]])))
    digits = 0 if size >= 1000.0 else 1 if size >= 10.0 else 3
    ranges = [
        "..".join(number(float(end), digits) for end in each[k])
        if np.ptp(each[k]) > NARROW * size
        else "–"
        for each in (held.hypotheses, held.tolerances)
    ]
    for place, without in enumerate((held.without[k], held.without_within[k])):
        ranges[place] += NONE if without else ""
    ranges[1] += DOUBTFUL if held.interaction[k] > ROUGH else ""
    rule = held.ruling(k)
    ruled = f"{_source(rule[0][0])} {rule[0][1]:.0%}" if rule else ""
    nominal = f"{number(float(held.nominal[k]), digits)} {held.unit[k]}".rstrip()
    return shortened(AT.sub(r"\1", held.number[k]), LONGEST), nominal, *ranges, ruled


def _source(path: str) -> str:
    """The end of a path, by which it is known."""
    plain = ("*", "model", "spindle", "conditions", "bearings", "sleeves", "spring")
    last = ".".join([step for step in path.split(".") if step not in plain][-2:])
    return last if len(last) <= LONGEST_SOURCE else last.rpartition(".")[2]


def interval_doubts(held: Interval) -> Iterator[str]:
    """What these ranges do not hold, a sentence each below a word."""
    lacking = np.flatnonzero(held.without + held.without_within)
    words = dict.fromkeys(held.absent[k] for k in lacking)
    unmet = ", ".join(UNKNOWN if word == ABSENT else word for word in words)
    if np.isin(lacking, _shown(held)).any():
        yield (
            f"{NONE}          some of these machines have no such number: {unmet}; ranges over "
            "tolerances end where one that was solved has it"
        )
    elif lacking.size:
        more = f" and {lacking.size - 1} more of the numbers in interval.csv"
        name = f"{held.number[lacking[0]]}{more if lacking.size > 1 else ''}"
        yield f"note       some of these machines have no {name}: {unmet}"
    errors = held.numerical_error[np.isfinite(held.numerical_error)]
    if errors.size:
        most = rounded_up(float(errors.max()))
        yield f"beside it  the numerical error, within {most} of these numbers"
    far = np.flatnonzero(np.nan_to_num(held.interaction) > FAR)
    if far.size:
        worst = max(far, key=lambda k: held.interaction[k])
        marked = (held.interaction[_shown(held)] > ROUGH).any()
        yield (
            f"{DOUBTFUL if marked else 'note':10} tolerances act on one another: with all off at "
            "once, "
            f"{held.number[worst]} is {held.interaction[worst]:.0%} of its range from the sum of "
            "their effects; samples tell"
        )
    if held.narrowed:
        yield f"note       {held.narrowed}"
    if held.lost:
        yield f"note       left out, without a solution: {shortened(held.lost, 300)}"


def write_interval(folder: Path, held: Interval) -> None:
    """The tables ``interval.csv``, ``interval_effects.csv``, ``interval_hypotheses.csv``,
    ``interval_curves.csv`` and ``sensitivities.csv``, those that have rows."""
    named: list[Column] = [("number", list(held.number)), ("unit", list(held.unit))]
    write_table(folder / "interval.csv", named + _numbers(held))
    if held.source:
        effects = _pairs(held, "uncertain number", held.source)
        effects.append(("tolerance", [*held.tolerance] * len(held.number)))
        effects += _by_end(held, "change at", held.effect.reshape(-1, len(held.end)))
        write_table(folder / "interval_effects.csv", effects)
    if len(held.combination) > 1:
        values = zip(held.combination, map(number_cells, held.by_combination.T), strict=True)
        write_table(folder / "interval_hypotheses.csv", [*named, *values])
    if held.curve:
        write_table(folder / "interval_curves.csv", _curves(held))
    if held.path:
        write_table(folder / "sensitivities.csv", _sensitivities(held))


def _numbers(held: Interval) -> list[Column]:
    rules = [held.ruling(k)[:1] for k in range(len(held.number))]
    return [
        ("nominal", number_cells(held.nominal)),
        *_by_end(held, "hypotheses,", held.hypotheses),
        *_by_end(held, "95 % of tolerances,", held.tolerances),
        *_by_end(held, "worst case of tolerances,", held.worst),
        ("ruled by", [rule[0][0] if rule else "" for rule in rules]),
        ("its share", [f"{rule[0][1]:.3g}" if rule else "" for rule in rules]),
        ("not the sum of effects, over the range", number_cells(held.interaction)),
        ("numerical error", number_cells(held.numerical_error)),
    ]


def _curves(held: Interval) -> list[Column]:
    return [
        ("curve", [held.curve[k] for k in held.curve_of]),
        ("abscissa", number_cells(held.x)),
        ("nominal", number_cells(held.curve_nominal)),
        *_by_end(held, "hypotheses,", held.curve_hypotheses),
        *_by_end(held, "95 % of tolerances,", held.curve_tolerances),
    ]


def _sensitivities(held: Interval) -> list[Column]:
    return [
        *_pairs(held, "by", held.path),
        ("derivative, by SI unit", number_cells(held.derivative.ravel())),
        ("relative derivative", number_cells(held.elasticity.ravel())),
        ("change over the range", number_cells(held.range_effect.ravel())),
    ]


def _pairs(held: Interval, head: str, others: Sequence[str]) -> list[Column]:
    """A row for every number and each of ``others``, which stand under ``head``."""
    return [
        ("number", [name for name in held.number for _ in others]),
        ("unit", [unit for unit in held.unit for _ in others]),
        (head, [*others] * len(held.number)),
    ]


def _by_end(held: Interval, words: str, values: Array) -> list[Column]:
    """A column for each end of a range, of ``values`` (rows, ends)."""
    ends = zip(held.end, values.T, strict=True)
    return [(f"{words} {end}", number_cells(each)) for end, each in ends]


def keep(folder: Path, held: Mapping[str, Interval]) -> None:
    """All intervals of a run in one file, by part."""
    named = {f"{part}/{NAME}" if part else NAME: each for part, each in held.items()}
    write_results(folder / FILE, named)


def kept(folder: Path) -> dict[str, Interval]:
    """The intervals in a results folder by part; none where it has none."""
    if not (folder / FILE).exists():
        return {}
    groups = read_results(folder / FILE)
    return {name.rpartition("/")[0]: restored_as(Interval, groups[name]) for name in groups}
