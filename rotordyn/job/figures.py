"""Figures of a case: those of its machine and of its analyses, drawn on demand."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

from rotordyn.analyses.contract import Code
from rotordyn.analyses.registry import analysis, in_order
from rotordyn.figures.draw import Job, titled
from rotordyn.figures.overlays import Scale
from rotordyn.figures.panels import pages
from rotordyn.job.values import machine_of, named_curves, shown_of
from rotordyn.results.described import Described, Shown
from rotordyn.results.headline import Curve
from rotordyn.results.interval import Interval

code = partial(Code, "rotordyn.figures")
Variant = tuple[Described, Mapping[str, Any]]


def figures(case: Described, results: Mapping[str, Any]) -> list[Job]:
    """Name and drawing function of every figure of the results, the slowest ones first.

    Nothing is drawn and matplotlib is not imported before a function is called.
    """
    jobs: list[Job] = []
    if case.spindle is not None:
        loads = case.conditions.loads if case.conditions is not None else ()
        jobs.append(("machine", partial(code("machine:machine_figure"), case.spindle, loads)))
    costs: dict[str, int] = {}
    for name, result in results.items():
        jobs += analysis(name).figures(case, result, results)
        costs |= analysis(name).costs
    return _titled(jobs, _heading([machine_of(case)], case.title or case.name), costs)


def interval_figures(parts: Mapping[str, Variant], intervals: Mapping[str, Interval]) -> list[Job]:
    """Figures of intervals: bands of the headline curves of every part, effects on numbers."""
    jobs: list[Job] = []
    for part, interval in intervals.items():
        case, results = parts[part]
        after = f"_{part}" if part else ""
        by_figure: dict[str, dict[str, Curve]] = {}
        for name, result in results.items():
            for key, curve in named_curves(case, name, result):
                by_figure.setdefault(curve.figure, {})[key] = curve
        made: list[Job] = [
            (f"interval_rules{after}", partial(code("interval:rules_figure"), interval))
        ]
        if interval.path:
            made.append(
                (f"sensitivities{after}", partial(code("interval:slopes_figure"), interval))
            )
        for figure, shown in by_figure.items():
            bands = partial(code("interval:bands_figure"), interval, shown)
            made.append((f"interval_{figure}{after}", bands))
        jobs += _titled(made, _heading([machine_of(case)], case.title or case.name), {})
    return jobs


def comparison_figures(
    variants: Sequence[Variant], title: str = "", scale: Scale | None = None
) -> list[Job]:
    """Name and drawing function of every figure of the variants; ``title`` of the case that
    compares them; ``scale``: the varied number, if there is only one."""
    jobs: list[Job] = []
    costs: dict[str, int] = {}
    for name in in_order(*(results for _, results in variants)):
        shown = [shown_of(case, results[name]) for case, results in variants if name in results]
        spec = variants[0][0].analyses.get(name)
        jobs += [*_side_by_side(name, spec, shown), *_laid_over(name, spec, shown, scale)]
        costs |= analysis(name).costs
    return _titled(jobs, _heading([machine_of(case) for case, _ in variants], title), costs)


def _side_by_side(name: str, spec: Any, shown: Sequence[Shown]) -> Iterator[Job]:
    """Yield pages of small figures, one for each variant."""
    for panel in analysis(name).panels(spec, shown):
        for number, page in enumerate(pages(shown), start=1):
            file = panel.name if number == 1 else f"{panel.name}_{number}"
            yield file, partial(code("panels:panels_figure"), panel, shown, page)


def _laid_over(name: str, spec: Any, shown: Sequence[Shown], scale: Scale | None) -> Iterator[Job]:
    """Yield figures with the curves of all variants; ``scale`` applies if all have results."""
    curves = partial(analysis(name).curves, spec)
    fitting = scale if scale is not None and len(scale.values) == len(shown) else None
    for figure in dict.fromkeys(curve.figure for curve in curves(shown[0])):
        yield figure, partial(code("overlays:overlay_figure"), figure, curves, shown, fitting)


def _titled(jobs: Sequence[Job], words: str, costs: Mapping[str, int]) -> list[Job]:
    """Add ``words`` at the top of each figure, and put the slowest jobs first."""
    named: list[Job] = [(name, partial(titled, draw, words)) for name, draw in jobs]
    return sorted(named, key=lambda job: -costs.get(job[0], 0))


def _heading(machines: Sequence[str], title: str) -> str:
    """Text at the top of a figure: machine, if it is the same for all variants, and case."""
    shared = set(machines) if len(set(machines)) == 1 else set()
    return "  |  ".join(words for words in (*shared, title) if words)
