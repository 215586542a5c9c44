"""A results folder: numbers, tables, figures, record; whole or not at all."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import AbstractContextManager, ExitStack, contextmanager
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

from rotordyn.analyses.registry import analysis, names
from rotordyn.analyses.solving import Answers, Progress
from rotordyn.case.case import Case
from rotordyn.errors import not_installed
from rotordyn.figures.draw import Job, LeftOut, Pictures
from rotordyn.job.figures import comparison_figures
from rotordyn.job.figures import figures as figures_of
from rotordyn.job.solving import solve, solve_variants, unsolved


@dataclass(frozen=True, slots=True)
class Delivery:
    """What a run left behind: the folder, its one-screen summary, how it was solved, speeds without
    a solution. ``moved``: the folder is not the one asked for, which is in use."""

    folder: Path
    summary: str
    plan: str
    unsolved: tuple[str, ...]
    moved: bool = False


@dataclass(frozen=True, slots=True)
class Parcel:
    """What goes into a folder: the case and answers of each part, by the name of its subfolder.

    A case without variants is one part in the folder itself (name ``""``). ``lost``: why variants
    are missing; ``left_out``: figures that are.
    """

    case: Case
    parts: dict[str, tuple[Case, Answers]]
    lost: tuple[str, ...] = ()
    seconds: dict[str, float] = field(default_factory=dict)
    left_out: LeftOut = field(default_factory=LeftOut)

    @property
    def results(self) -> dict[str, Any]:
        """Every result by its place in the files: ``analysis`` or ``variant/analysis``."""
        return {
            f"{part}/{name}" if part else name: result
            for part, (_, answers) in self.parts.items()
            for name, result in answers.results.items()
        }

    @property
    def warnings(self) -> tuple[str, ...]:
        """What a designer should know: why variants are missing, then of each variant."""
        from rotordyn.report.warnings import result_warnings

        found = self._of_parts(lambda own: (*own.warnings, *result_warnings(own.results)))
        return (*self.lost, *found)

    @property
    def notes(self) -> tuple[str, ...]:
        """What was chosen that changes how results read, with the variant it belongs to."""
        return (*self._of_parts(lambda own: own.notes), *self.left_out.sentences)

    @property
    def unsolved(self) -> tuple[str, ...]:
        """Why speeds, or whole variants, have no solution."""
        return (*self.lost, *self._of_parts(lambda own: unsolved(own.results)))

    def _of_parts(self, said: Callable[[Answers], Iterable[str]]) -> tuple[str, ...]:
        """What is ``said`` of every part, each sentence once, led by the name of the variant."""
        found = {
            f"{part}: {sentence}" if part else sentence: None
            for part, (_, answers) in self.parts.items()
            for sentence in said(answers)
        }
        return tuple(found)


def deliver(
    case: Case,
    target: Path,
    progress: Progress = lambda name: None,
    *,
    figures: bool = True,
) -> Delivery:
    """Solve ``case`` and write everything into ``target``, all or nothing.

    Without ``figures`` nothing is drawn, and what draws is not even loaded.

    Raises
    ------
    OutputRefused : ``target`` holds something that is not ours
    NoSolution : no speed (of any variant) has a solution; nothing is written
    """
    from rotordyn.report.folder import check_target, results_folder

    check_target(target)
    seconds: dict[str, float] = {}
    with _timed(seconds, "solve, all stages"):
        parcel = _solved(case, progress, seconds)
    with results_folder(target) as place:
        progress("figures" if figures else "files")
        drawn, left_out = (_drawn if figures else _written)(parcel, place.folder)
        parcel = replace(parcel, left_out=left_out)
        text = _write_summary(parcel, place.folder)
        _write_record(parcel, drawn, place.folder)
    folder = place.target if place.moved else target
    return Delivery(folder, text, _plan(parcel), parcel.unsolved, moved=place.moved)


def _drawn(parcel: Parcel, folder: Path) -> tuple[dict[str, float], LeftOut]:
    """Numbers and figures, made side by side; seconds by figure, and which are missing."""
    from rotordyn.figures.draw import Drawing, load

    lacking = _attempted("figures", load)
    if lacking.figures:
        return {}, _numbers(parcel, folder) | lacking
    with ExitStack() as stack:
        pictures = [stack.enter_context(each) for each in _pictures(parcel, folder.parent)]
        drawing = Drawing(_figures(parcel), folder)
        files = _numbers(parcel, folder)
        with _timed(parcel.seconds, "draw"):
            drawn = drawing.finish()
            for each in pictures:
                drawn |= each.draw(folder)
        for each in pictures:
            files |= each.left_out
        return drawn, files


def _attempted(name: str, write: Callable[[], object]) -> LeftOut:
    """Write ``name`` unless a package of others that this takes is not installed."""
    try:
        write()
    except ModuleNotFoundError as error:
        why = not_installed(error.name)
        if why is None:
            raise
        return LeftOut({name: why}, (f"{name} left out: {why}",))
    return LeftOut()


def _pictures(parcel: Parcel, beside: Path) -> Iterator[AbstractContextManager[Pictures]]:
    """What another process draws meanwhile, its files in ``beside``."""
    for name in {name: None for _, own in parcel.parts.values() for name in own.results}:
        made = analysis(name).pictures
        if made is not None:
            parts = {
                part: (case, own.results[name])
                for part, (case, own) in parcel.parts.items()
                if name in own.results
            }
            yield made(parts, beside)


def _written(parcel: Parcel, folder: Path) -> tuple[dict[str, float], LeftOut]:
    """Numbers alone."""
    return {}, _numbers(parcel, folder) | LeftOut({"figures": "none are asked for"})


def _numbers(parcel: Parcel, folder: Path) -> LeftOut:
    with _timed(parcel.seconds, "write"):
        return _write_numbers(parcel, folder)


def _plan(parcel: Parcel) -> str:
    """How every part was solved, and how long what surrounds it took."""
    from rotordyn.report.plan import plan

    around = {name: own for name, own in parcel.seconds.items() if name in ("write", "draw")}
    texts = []
    for name, (_, own) in parcel.parts.items():
        last = not parcel.case.variants
        skipped = own.skipped | (parcel.left_out.figures if last else {})
        job = around if last else {}
        text = plan(own.seconds, own.asked, own.spared, skipped, job)
        texts.append(f"{name}: {text}" if name else text)
    return "\n".join(texts)


def _solved(case: Case, progress: Progress, seconds: dict[str, float]) -> Parcel:
    if not case.variants:
        return Parcel(case, {"": (case, solve(case, progress))}, (), seconds)
    found = solve_variants(case, progress)
    own = labelled(case)
    parts = {name: (own[name], answers) for name, answers in found.answers.items()}
    return Parcel(case, parts, tuple(found.failed.values()), seconds)


def labelled(case: Case) -> dict[str, Case]:
    """The variants of ``case`` with titles that tell them apart."""
    titles = {name: variant.title.strip() or name for name, variant in case.variants.items()}
    count = Counter(titles.values())
    return {
        name: replace(variant, title=title if count[title] == 1 else f"{title} ({name})")
        for (name, variant), title in zip(case.variants.items(), titles.values(), strict=True)
    }


def _figures(parcel: Parcel) -> list[Job]:
    if not parcel.case.variants:
        return figures_of(parcel.case, parcel.results)
    shown = [(part, answers.results) for part, answers in parcel.parts.values()]
    return comparison_figures(shown)


@contextmanager
def _timed(seconds: dict[str, float], name: str) -> Iterator[None]:
    begin = time.perf_counter()
    yield
    seconds[name] = time.perf_counter() - begin


def _write_numbers(parcel: Parcel, folder: Path) -> LeftOut:
    """Numbers, tables, meshes; returns what lacks a package."""
    from rotordyn.report.netcdf import write_results
    from rotordyn.report.tables import write_tables

    case = parcel.case
    attributes = {"case": case.name, "title": case.title, "digest": case.digest}
    store = partial(write_results, folder / "results.nc", parcel.results, attributes)
    left_out = _attempted("results.nc", store)
    for name, (part, answers) in parcel.parts.items():
        (folder / name).mkdir(exist_ok=True)
        write_tables(folder / name, answers.results)
        left_out |= _write_files(part, answers.results, folder / name)
    return left_out


def _write_summary(parcel: Parcel, folder: Path) -> str:
    """The summary, which is returned."""
    from rotordyn.report.side_by_side import comparison_summary
    from rotordyn.report.summary import summary

    case = parcel.case
    if case.variants:
        shown = [(part, answers.results) for part, answers in parcel.parts.values()]
        text = comparison_summary(case, shown, parcel.warnings, parcel.notes)
    else:
        text = summary(case, parcel.results, parcel.warnings, parcel.notes)
    (folder / "summary.txt").write_text(text + "\n", encoding="utf-8")
    return text


def _write_files(case: Case, results: Mapping[str, Any], folder: Path) -> LeftOut:
    """Further files of the analyses; returns what lacks a package."""
    left_out = LeftOut()
    for name, result in results.items():
        for file, write in analysis(name).files(folder, case, result):
            left_out |= _attempted(file, write)
    return left_out


def _write_record(parcel: Parcel, drawn: Mapping[str, float], folder: Path) -> None:
    from rotordyn.report.manifest import RunRecord, outcomes, write_record

    case = parcel.case
    machine = "spindle" if case.bearing is None else "bearing"
    others = [n for n in names() if analysis(n).machine == machine and n not in case.analyses]
    unasked = dict.fromkeys(others, "the case does not ask for it")
    record = RunRecord(
        case=case.name,
        title=case.title,
        digest=case.digest,
        inputs=tuple(f"{path.parent.name}/{path.name}" for path in case.files),
        settings=_settings(parcel),
        outcomes=outcomes(parcel.results),
        tolerances=_by_part(parcel, "tolerances"),
        stages={**parcel.seconds, **_by_part(parcel, "seconds")},
        figures=drawn,
        skipped={**unasked, **_by_part(parcel, "skipped"), **parcel.left_out.figures},
        warnings=parcel.warnings,
        notes=parcel.notes,
    )
    write_record(folder, record)


def _settings(parcel: Parcel) -> dict[str, Any]:
    settings = {part: asdict(case.conditions) for part, (case, _) in parcel.parts.items()}
    return settings.get("", settings)


def _by_part(parcel: Parcel, name: str) -> dict[str, Any]:
    """A mapping that every part's answers have, the keys led by the name of the variant."""
    return {
        f"{part}/{key}" if part else key: value
        for part, (_, answers) in parcel.parts.items()
        for key, value in getattr(answers, name).items()
    }
