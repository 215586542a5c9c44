"""Results of a solved case in memory."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bearings.arguments import typed
from bearings.errors import shown
from rotordyn.allowance import Stop
from rotordyn.analyses.solving import MachineResults, Progress
from rotordyn.case.case import Case
from rotordyn.case.doubts import unstated_hypotheses
from rotordyn.errors import InvalidInput
from rotordyn.figures.style import USUAL_FORMATS
from rotordyn.job.results import DATE, Origin, Part, Results, inputs_of
from rotordyn.job.solving import labelled, restricted, solve, solve_variants, unsolved
from rotordyn.results.by_variant import by_variant
from rotordyn.results.severity import severest_first

if TYPE_CHECKING:
    import xarray as xr

    from rotordyn.results.interval import Interval


@dataclass(frozen=True, slots=True)
class Solution:
    """A solved case: ``parts`` by the name of their folder, each with its case and results.

    A case without variants is one part, named "". ``lost``: reasons why variants have no solution;
    ``seconds`` by stage; ``intervals`` by part; ``stop``: what ended the run before the analyses
    ``missing`` were solved.
    """

    case: Case
    parts: dict[str, tuple[Case, MachineResults]]
    lost: tuple[str, ...] = ()
    seconds: dict[str, float] = field(default_factory=dict)
    intervals: Mapping[str, Interval] = field(default_factory=dict)
    stop: Stop | None = None
    missing: tuple[str, ...] = ()

    @property
    def unsolved(self) -> tuple[str, ...]:
        """Sentences on what an ended run lacks, and on variants without a solution."""
        if self.stop is None:
            return self.lost
        why = str(self.stop) or "interrupted"
        return f"{', '.join(self.missing)} omitted: {why}", *self.lost

    @property
    def results(self) -> dict[str, Any]:
        """Results by their name in files: ``analysis`` or ``variant/analysis``."""
        return self.by_part(lambda machine: machine.results)

    def by_part(self, mapping: Callable[[MachineResults], Mapping[str, Any]]) -> dict[str, Any]:
        """Join a ``mapping`` of the results of all parts, keys preceded by the variant."""
        return {
            f"{part}/{key}" if part else key: value
            for part, (_, machine) in self.parts.items()
            for key, value in mapping(machine).items()
        }

    def sentences(self, of: Callable[[MachineResults], Iterable[str]]) -> tuple[str, ...]:
        """What is ``of`` of every part, each sentence once, led by the names of its variants."""
        return by_variant({part: of(machine) for part, (_, machine) in self.parts.items()})


class SolvedResults(Results):
    """Results in memory, of a solved case."""

    def __init__(self, solution: Solution) -> None:
        self.solution = solution

    @property
    def case(self) -> Case:
        return self.solution.case

    @cached_property
    def summary(self) -> str:
        return self.summary_with(self.notes)

    def summary_with(self, notes: tuple[str, ...]) -> str:
        """Summary with the given ``notes``."""
        from rotordyn.report.interval import interval_lines
        from rotordyn.report.side_by_side import comparison_summary
        from rotordyn.report.summary import summary

        intervals = self.held_intervals.items()
        sure = [line for part, each in intervals for line in ("", *interval_lines(each, part))]
        if self.case.variants:
            shown = list(self.parts.values())
            text = comparison_summary(self.case, shown, self.warnings, notes, self._lost)
        else:
            results = self.solution.results
            text = summary(self.case, results, self.warnings, notes, self._lost)
        return "\n".join([text, *sure])

    @property
    def held_intervals(self) -> Mapping[str, Interval]:
        return self.solution.intervals

    @cached_property
    def warnings(self) -> tuple[str, ...]:
        from rotordyn.report.warnings import result_warnings

        solution = self.solution
        sentences = solution.sentences(
            lambda machine: (*machine.warnings, *result_warnings(machine.results))
        )
        return (*solution.unsolved, *severest_first(sentences))

    @cached_property
    def notes(self) -> tuple[str, ...]:
        parts = self.solution.parts.items()
        silent = {name: filter(None, [unstated_hypotheses(case)]) for name, (case, _) in parts}
        notes = self.solution.sentences(lambda machine: machine.notes)
        if self.held_intervals:
            return notes
        notes = (*notes, *by_variant(silent))
        if self.case.uncertain is None:
            return notes
        return (*notes, "parts of the case are uncertain: run it with --interval for the ranges")

    @cached_property
    def origin(self) -> Origin:
        from rotordyn.report.manifest import versions

        now = datetime.now(UTC).strftime(DATE)
        return Origin(versions(), now, self.case.digest, inputs_of(self.case))

    @cached_property
    def unsolved(self) -> tuple[str, ...]:
        return (*self.solution.unsolved, *self._lost)

    @property
    def _lost(self) -> tuple[str, ...]:
        """Reasons why speeds have no solution."""
        return self.solution.sentences(lambda machine: unsolved(machine.results))

    @typed(InvalidInput, besides=["formats"])
    def save(
        self,
        folder: str | Path,
        *,
        figures: bool = True,
        formats: Sequence[str] = USUAL_FORMATS,
    ) -> Path:
        """Write the folder that ``rotordyn run`` writes; see ``Results.save``.

        Without ``figures`` nothing is drawn, and matplotlib is not loaded; ``formats``: of the
        figures, among ``figures.style.FORMATS``.

        Raises
        ------
        OutputRefused : ``folder`` holds something that is not a results folder
        InvalidInput : the folder cannot be created
        """
        from rotordyn.job.delivery import write

        return write(self, Path(folder), figures=figures, formats=formats).folder

    @cached_property
    def parts(self) -> dict[str, Part]:
        parts = self.solution.parts.items()
        return {name: Part(case, machine.results) for name, (case, machine) in parts}

    def _names(self) -> tuple[str, ...]:
        return tuple(self.solution.results)

    def _heading(self) -> tuple[str, str]:
        return self.case.name, self.case.title

    def _dataset(self, name: str) -> xr.Dataset:
        from rotordyn.report.datasets import dataset

        return dataset(self.solution.results[name])


def run(case: Case, progress: Progress = lambda name: None) -> SolvedResults:
    """Solve a case: each of its analyses, for each of its variants.

    ``progress`` is called with the name of each analysis as it begins, and with the progress of a
    long one.

    Raises
    ------
    NoSolution : no speed of the case, or of any of its variants, has a physical solution
    """
    if not isinstance(case, Case):
        raise InvalidInput(f"run takes a case, as rotordyn.load gives it; got {shown(case)}")
    begin = time.perf_counter()
    solution = _variants(case, progress) if case.variants else _alone(case, progress)
    solution.seconds["solve, all stages"] = time.perf_counter() - begin
    return SolvedResults(solution)


def _alone(case: Case, progress: Progress) -> Solution:
    machine = solve(case, progress)
    finished, missing = _finished(case, machine)
    return Solution(finished, {"": (finished, machine)}, stop=machine.stop, missing=missing)


def _finished(case: Case, machine: MachineResults) -> tuple[Case, tuple[str, ...]]:
    """``case`` restricted to analyses with results, and names of the others."""
    missing = tuple(name for name in case.analyses if name not in machine.results)
    return restricted(case, tuple(machine.results)) if missing else case, missing


def _variants(case: Case, progress: Progress) -> Solution:
    solved = solve_variants(case, progress)
    first, machine = next(iter(solved.machines.items()))
    finished, analyses = _finished(case, machine)
    cases = labelled(finished)
    parts = {name: (cases[name], machine) for name, machine in solved.machines.items()}
    missing = [f"{name} of variant {first}" for name in analyses]
    if later := [name for name in cases if name not in {*solved.machines, *solved.failed}]:
        after = f" and {len(later) - 1} after it" * (len(later) > 1)
        missing.append(f"variant {later[0]}{after}")
    lost = tuple(solved.failed.values())
    return Solution(finished, parts, lost, stop=solved.stop, missing=tuple(missing))
