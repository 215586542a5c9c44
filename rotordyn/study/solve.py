"""Solve all points of a study, on all processors; resume an interrupted one."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

from bearings.arguments import typed
from rotordyn.case.case import Case
from rotordyn.case.study import MOST_DRAWN
from rotordyn.errors import InvalidInput
from rotordyn.field import shown
from rotordyn.job.solving import restricted
from rotordyn.numerics.threads import processors
from rotordyn.quantity import suggestion
from rotordyn.study import record
from rotordyn.study.dataset import gathered
from rotordyn.study.design import design, one_machine
from rotordyn.study.journal import Journal
from rotordyn.study.parameter import require_whole
from rotordyn.study.point import Outcome, Study, solve_points
from rotordyn.study.processes import start
from rotordyn.study.workers import pack, solved_here, solved_on_cluster

if TYPE_CHECKING:
    import xarray as xr

HOUR, DAY, YEAR = 3600.0, 86400.0, 365.25 * 86400.0  # s
KEPT, HELD = 1.5, 4.0  # disk and memory needed at the end, over the size of the journal
LONG = HOUR  # longest time without `yes`
TOGETHER, BLOCK = 32, 2.0  # largest number of points solved together, and s that they may take
LOOKED = 3  # points solved before a study is called long: the first ones load libraries
Progress = Callable[[int, int], None]


def study_of(
    case: Case,
    varied: Mapping[str, object],
    *,
    sampling: str = "grid",
    samples: int | None = None,
    seed: int = 0,
    analyses: Sequence[str] = (),
    results: Sequence[str] = (),
) -> Study:
    """Build a study and check it against its case; see ``sweep``."""
    if not isinstance(case, Case):
        raise InvalidInput(f"a study takes a case, as rotordyn.load gives it; got {shown(case)}")
    _require("analyses", analyses, case)
    if len(analyses):
        case = restricted(case, tuple(analyses))
    _require("results", results, case)
    left_out, case = tuple(case.variants), one_machine(case, varied)
    points = design(case, varied, sampling, samples, seed)
    if len(results) and points.count > MOST_DRAWN:
        raise InvalidInput(
            f"results: given {', '.join(results)}; allowed for up to {MOST_DRAWN:g} points, since "
            "each is kept as a file: leave them out, numbers are kept of any study"
        )
    return Study(case, points, tuple(results), left_out)


def _require(key: str, given: Sequence[str], case: Case) -> None:
    for name in given:
        if name not in case.analyses:
            raise InvalidInput(
                f"{key}: given {shown(name)}; this study has the analyses "
                f"{', '.join(case.analyses)}{suggestion(name, case.analyses)}"
            )


@typed(InvalidInput, besides=["case"])
def sweep(  # noqa: PLR0913 - all of it describes one study
    case: Case,
    varied: Mapping[str, object],
    *,
    sampling: str = "grid",
    samples: int | None = None,
    seed: int = 0,
    analyses: Sequence[str] = (),
    results: Sequence[str] = (),
    workers: int | None = None,
    cluster: str | None = None,
    folder: str | Path | None = None,
    progress: Progress = lambda done, of: None,
    yes: bool = False,
) -> xr.Dataset:
    """Solve a case at many points and return its headline numbers as one Dataset.

    Parameters
    ----------
    varied : lists of values or ``Span`` by dotted path, as ``rotordyn.vary`` takes them
    sampling : "grid" (every combination; the dimensions are the paths), "list" (the values of all
        paths in step), "latin-hypercube" or "sobol" (``samples`` points within spans and lists)
    seed : of a sample
    analyses : of the case, by name; all of them by default
    results : analyses whose whole datasets are kept too, as ``analysis: variable``
    workers : processes; as many as there are processors by default
    cluster : address of a dask scheduler that solves instead (extra ``cluster``)
    folder : where points are kept as they are solved; the same study resumes from there
    progress : called with the number of points solved and of all
    yes : solve it even if it takes more than an hour

    Returns
    -------
    Dataset : a variable for each headline number (NaN where a point has none), ``sentence`` (why),
        ``warnings`` (how many); numbers in the units of summaries, coordinates in SI units

    Raises
    ------
    InvalidInput : an invalid path, value or number, before anything is solved; a folder of another
        study; more than an hour without ``yes``; no scheduler
    """
    study = study_of(
        case,
        varied,
        sampling=sampling,
        samples=samples,
        seed=seed,
        analyses=analyses,
        results=results,
    )
    return solved(study, workers, cluster, folder, progress, yes=yes)[0]


def solved(
    study: Study,
    workers: int | None = None,
    cluster: str | None = None,
    folder: str | Path | None = None,
    progress: Progress = lambda done, of: None,
    *,
    yes: bool = False,
) -> tuple[xr.Dataset, dict[int, Outcome]]:
    """Solve a study; return its Dataset and the outcome of every point. See ``sweep``."""
    if workers is not None:
        require_whole("workers", workers, 1)
    count, processes = study.design.count, 1 if cluster else workers or processors()
    with _place(folder) as place:
        journal = Journal(place, study)
        with record.alone(place, "points"):
            if cluster is None and count > 1 and not journal.begun:
                start(min(processes, processors(), count))
                import xarray  # noqa: F401 - gathers the outcomes; meanwhile the processes load
            outcomes = journal.begin()
            progress(len(outcomes), count)
            try:
                for outcome in _outcomes(journal, outcomes, processes, cluster, yes=yes):
                    journal.add(outcome)
                    outcomes[outcome.number] = outcome
                    progress(len(outcomes), count)
            finally:
                if not outcomes:  # another study finds its folder free
                    journal.withdraw()
        return gathered(study, outcomes, journal.datasets), outcomes


def _outcomes(
    journal: Journal, known: Mapping[int, Outcome], workers: int, cluster: str | None, *, yes: bool
) -> Iterator[Outcome]:
    """Yield outcomes of points not yet solved; estimate the time of all from the first ones."""
    study = journal.study
    count, begun_here = study.design.count, not known
    total = count - len(known)
    left = (k for k in range(count) if k not in known)  # one by one: they may be any number
    packed, least, looked = pack(study), math.inf, 0
    pace, share = math.inf, 2 * workers if workers > 1 else 1
    unasked = yes or (cluster is not None and count <= MOST_DRAWN)

    def blocks() -> Iterator[tuple[int, ...]]:
        """Yield blocks of points: single ones until the time per point is known; as many as were
        solved so far while all are refused."""
        remaining = total
        while remaining:
            size = int(BLOCK / pace) if pace < math.inf else looked
            size = min(TOGETHER, remaining // share, size) if total - remaining >= LOOKED else 1
            block = tuple(islice(left, max(1, size)))
            yield block
            remaining -= len(block)

    def on_cluster(address: str) -> Generator[Sequence[Outcome], None, None]:
        """Solve the first points in this process if they may be too many, then all on the cluster,
        which takes thousands at once."""
        local = 0 if unasked else min(LOOKED, total)
        yield from (solve_points(packed, (number,)) for number in islice(left, local))
        yield from ((each,) for each in solved_on_cluster(packed, left, address, total - local))

    found: Generator[Sequence[Outcome], None, None]
    if cluster is not None:
        found = on_cluster(cluster)
    else:
        found = solved_here(packed, blocks(), workers, solve_points, total=total)
    with closing(found):  # whoever is still solving ends with a refusal
        for block in found:
            yield from block
            solved = [outcome.seconds for outcome in block if outcome.solved]
            if solved:  # the time of a refused point says nothing of others
                pace = max(*solved, pace / 2.0 if pace < math.inf else 0.0)
            looked += len(block)
            least = min(least, *(outcome.seconds for outcome in block))
            seconds = least * (total - looked) / workers
            if looked >= min(LOOKED, total) and seconds > LONG and not unasked:
                sentence = _too_long(journal, count, total - looked, seconds, workers)
                if begun_here:
                    journal.withdraw()
                raise InvalidInput(sentence)


def _too_long(journal: Journal, count: int, left: int, seconds: float, workers: int) -> str:
    size = journal.size / (count - left)
    return (
        f"the study has {count} points, {left} of them to solve: about {_long(seconds)} with "
        f"{workers} worker{'s' * (workers > 1)}, {_large(KEPT * size * count)} on disk "
        f"({_large(journal.room)} are free) and {_large(HELD * size * count)} of memory at its "
        "end; confirm it (--yes), or take fewer points"
    )


def _long(seconds: float) -> str:
    """Format a time in hours, days or years."""
    for unit, length in (("years", YEAR), ("days", DAY)):
        if seconds >= 2.0 * length:
            return f"{seconds / length:.3g} {unit}"
    return f"{seconds / HOUR:.1f} h"


def _large(size: float) -> str:
    """Format a number of bytes."""
    return f"{size / 1e12:.3g} TB" if size >= 1e12 else f"{size / 1e9:.3g} GB"


@contextmanager
def _place(folder: str | Path | None) -> Iterator[Path]:
    if folder is not None:
        yield Path(folder)
        return
    with tempfile.TemporaryDirectory(prefix="rotordyn_study_") as temporary:
        yield Path(temporary) / "study"
