"""A case solved, and on request how sure its results are."""

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
    """Solve a case: every analysis that it asks for, of every variant that it compares.

    ``progress`` is called with the name of each analysis as it begins, and of a long one with how
    far it is. ``interval``: solve it over what is uncertain of it, too; what ``uncertain`` of the
    case says, or what is usually uncertain.

    Raises
    ------
    NoSolution : no speed of the case, or of any of its variants, has a physical solution
    InvalidInput : what is uncertain contradicts the case
    """
    if not interval:
        return job.run(case, progress)
    from rotordyn.study.interval import interval as interval_of

    if isinstance(case, Case):
        every = [asked_of(each) for each in case.variants.values() or (case,)]
        if not any(each.hypotheses or each.tolerances or each.steps for each in every):
            raise InvalidInput(
                "interval: nothing that is uncertain changes this case: name hypotheses or "
                "tolerances of what it gives"
            )
    solution = job.run(case, progress).solution
    held: dict[str, Interval] = {}
    try:
        if solution.stop is not None:
            raise solution.stop
        for name, (part, answers) in solution.parts.items():
            with heeding_stops():
                held[name] = interval_of(part, answers.results, progress)
    except STOPS as stop:
        if not keeps_finished():
            raise
        solution = replace(solution, stop=stop, missing=(*solution.missing, "interval"))
    return SolvedResults(replace(solution, intervals=held))
