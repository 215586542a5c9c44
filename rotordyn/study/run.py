"""Solve a case, and on request the intervals of its results."""

from __future__ import annotations

from dataclasses import replace

from bearings.arguments import typed
from rotordyn.allowance import STOPS, heeding_stops, keeps_finished
from rotordyn.analyses.solving import Progress
from rotordyn.case.asked import asked_of
from rotordyn.case.case import Case
from rotordyn.errors import InvalidInput
from rotordyn.job import solved as job
from rotordyn.job.solved import SolvedResults
from rotordyn.results.interval import Interval


@typed(InvalidInput, besides=["case"])
def run(
    case: Case, progress: Progress = lambda name: None, *, interval: bool = False
) -> SolvedResults:
    """Solve a case: each of its analyses, for each of its variants.

    ``progress`` is called with the name of each analysis as it begins, and with the progress of a
    long one. ``interval``: also solve it over its uncertain parameters, those under ``uncertain``
    in the case, or the usual ones.

    Raises
    ------
    NoSolution : no speed of the case, or of any of its variants, has a physical solution
    InvalidInput : the uncertainties contradict the case
    """
    if not interval:
        return job.run(case, progress)
    from rotordyn.study.interval import interval as interval_of

    if isinstance(case, Case):
        uncertainties = [asked_of(each) for each in case.variants.values() or (case,)]
        if not any(each.hypotheses or each.tolerances or each.steps for each in uncertainties):
            raise InvalidInput(
                "interval: no uncertain value changes this case: name hypotheses or "
                "tolerances of what it gives"
            )
    solution = job.run(case, progress).solution
    intervals: dict[str, Interval] = {}
    try:
        if solution.stop is not None:
            raise solution.stop
        for name, (part, machine) in solution.parts.items():
            with heeding_stops():
                intervals[name] = interval_of(part, machine.results, progress)
    except STOPS as stop:
        if not keeps_finished():
            raise
        solution = replace(solution, stop=stop, missing=(*solution.missing, "interval"))
    return SolvedResults(replace(solution, intervals=intervals))
